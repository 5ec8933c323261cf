//! Gradient limiting (§2.3): the nearly largest α-Lipschitz function below a given one.
//!
//! # Idea
//! The largest α-Lipschitz function below f on Ω is f_α(x) = min over y ∈ Ω of f(y) + α‖x − y‖ (Miller, Talmor, Teng).
//! A minimum over finitely many samples y exceeds f between the samples; here it is a minimum over cells,
//!
//! > F(x) = min over cells C of v_C + α · dist(x, C), where v_C ≤ f on C ∩ Ω is proved.
//!
//! # Guarantee
//! * F is α-Lipschitz everywhere: each term is, and so is their minimum (Lemma 2.3).
//! * F ≤ f on Ω. In a kept cell C, F ≤ v_C ≤ f. A cell D is dropped only when some sample y ∈ Ω outside it has
//!   f(y) + α max over x ∈ D of ‖x − y‖ ≤ v_D, so f(x) ≥ f(y) + α‖x − y‖ on D ∩ Ω: it is enough that F(y) ≤ f(y).
//!   Now y may itself lie in a dropped cell, but f(y) < f(x), and there are finitely many samples: following them ends
//!   in a kept cell.
//! * F ≥ k f_α on Ω with k = [`crate::spacing::Options::limit_factor`]. A cell is kept only when v_C ≥ k (U + α r), where r is
//!   its radius and U = min over samples y of f(y) + α‖c − y‖ is at least f_α at its centre c. Then at distance d from C
//!   v_C + α d ≥ k (U + α r + α d) ≥ k f_α.
//!
//! # Steps
//! [`envelope`] refines the cells that meet Ω level by level. A cell is kept, or split into four, by the samples of all levels
//! so far ([`Samples`]); then, from below, kept cells are dropped that a sample dominates, and cells are joined again where the
//! joined cell may be kept.
//!
//! # Cost
//! Only cells near valleys and local minima of f survive, where f rises more slowly than α: about (their length) /
//! ((1 − k) f) along them. Evaluation is branch and bound in their quadtree ([`Limited`]), or, for small α, a walk down
//! to a list of the terms that matter.

#[cfg(test)]
mod domain_tests;
pub(super) mod envelope;
pub(super) mod limited;
#[cfg(test)]
mod reference;
mod samples;
mod waiting;

use crate::domain::Domain;
use crate::geometry::tolerance::LOWER_BOUND;
use crate::geometry::{DVec2, Rect};
use crate::spacing::cover::{Cell, DEPTH};
use crate::spacing::limit::limited::{Branch, Limited};
use crate::spacing::limit::samples::Samples;
use crate::spacing::{Scaled, Spacing, SpacingError, geodesic};
use rayon::prelude::*;
use std::sync::Arc;

/// Most cells that may be visited: about 1.2 GB.
const MAX_CELLS: usize = 12_000_000;

/// The largest α for which F is given its lists ([`Limited::listed`]). Measured on the coasts of norway, iceland and aegean,
/// setting up included: meshing takes 0.80 to 0.91 of the time for α up to 1/3, 0.83 to 0.95 at 0.4, 0.96 to 1.09 at 1/2, and
/// 1.3 times at 5/6, where a long list is little better than the search and takes long to make. F is the same to the last bit
/// either way.
const LISTED_UP_TO: f64 = 0.4;

/// A function at most `function` on Ω, at least `factor` of the largest α-Lipschitz one below it, and α-Lipschitz.
///
/// If α ≥ λ, the constant of `function` itself, this is `function`; if α ≥ factor · λ it is (α / λ) · `function`;
/// otherwise it is a [`Limited`], or a `GeodesicLimited` if distances are measured inside the domain.
///
/// # Errors
/// [`SpacingError::NotPositive`] if `function` is not positive on Ω, [`SpacingError::Unresolved`] if it is too small
/// for any cell, [`SpacingError::TooManyCells`] if the envelope needs too many.
pub fn limit(
    function: Arc<dyn Spacing>,
    domain: &Domain,
    alpha: f64,
    factor: f64,
) -> Result<Arc<dyn Spacing>, SpacingError> {
    let own = function.lipschitz();
    if alpha >= factor * own {
        crate::spacing::cover::check_positive(function.as_ref(), domain)?;
        return Ok(if alpha >= own {
            function
        } else {
            Arc::new(Scaled::new(alpha / own, function))
        });
    }
    if function.is_geodesic() {
        return Ok(Arc::new(geodesic::limit(function.as_ref(), domain, alpha, factor)?));
    }
    let limited = envelope(function.as_ref(), domain, [alpha, factor], MAX_CELLS)?;
    Ok(Arc::new(if alpha <= LISTED_UP_TO {
        limited.listed(domain)
    } else {
        limited
    }))
}

/// The fate of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fate {
    /// Dominated, or outside Ω.
    Dropped,
    /// A term of F.
    Kept,
    /// Replaced by its four quarters.
    Split,
}

/// The cells of the envelope as they are refined, level by level; indices are those of [`Samples`].
struct Refinement<'a> {
    function: &'a dyn Spacing,
    domain: &'a Domain,
    alpha: f64,
    factor: f64,
    /// Most cells that may be visited.
    most: usize,
    /// Room for rounding in a lower bound, a length.
    slack: f64,
    samples: Samples,
    lowest: Vec<f64>,
    fates: Vec<Fate>,
}

fn envelope(
    function: &dyn Spacing,
    domain: &Domain,
    [alpha, factor]: [f64; 2],
    most: usize,
) -> Result<Limited, SpacingError> {
    let bounds = domain.bounds();
    let root = Cell::root(domain);
    let mut refinement = Refinement {
        function,
        domain,
        alpha,
        factor,
        most,
        slack: LOWER_BOUND * bounds.largest_coordinate(),
        samples: Samples::new(root.rect, alpha),
        lowest: Vec::new(),
        fates: Vec::new(),
    };
    let seeds = refinement.seeds();
    let levels = refinement.refine(root, &seeds)?;
    refinement.join(&levels);
    Ok(Limited::new(alpha, refinement.pack()))
}

/// A point where f tends to be low, with f there.
#[derive(Clone, Copy)]
struct Seed {
    at: DVec2,
    value: f64,
}

impl Refinement<'_> {
    /// The ends and the middle of each segment: lfs has its minima there.
    fn seeds(&self) -> Vec<[Seed; 3]> {
        let seed = |at: DVec2| Seed {
            at,
            value: self.function.at(at),
        };
        let of_segment = |s: usize| {
            let [a, b] = self.domain.ends(s);
            [seed(a), seed(0.5 * (a + b)), seed(b)]
        };
        (0..self.domain.segments().len())
            .into_par_iter()
            .map(of_segment)
            .collect()
    }

    /// The best sample of a cell, and the lower bound of f on it.
    fn look(&self, cell: &Cell, seeds: &[[Seed; 3]]) -> (Seed, f64) {
        let at = cell.point(self.domain);
        let value = self.function.at(at);
        let lowest = if at == cell.rect.centre() {
            self.function.lower_bound_from(cell.rect, value)
        } else {
            self.function.lower_bound(cell.rect)
        };
        let mut best = Seed { at, value };
        for seed in cell.crossing.iter().flat_map(|&s| &seeds[s as usize]) {
            if seed.value < best.value && cell.rect.contains(seed.at) {
                best = *seed;
            }
        }
        (best, lowest - self.slack)
    }

    /// Keeps and splits cells until none is left to split. Returns where each level starts.
    fn refine(&mut self, root: Cell, seeds: &[[Seed; 3]]) -> Result<Vec<usize>, SpacingError> {
        let mut level = vec![root];
        let mut starts = Vec::new();
        while !level.is_empty() {
            let start = self.fates.len();
            starts.push(start);
            let looks: Vec<(Seed, f64)> = level.par_iter().map(|cell| self.look(cell, seeds)).collect();
            for (index, (seed, lowest)) in looks.iter().enumerate() {
                let (value, [x, y]) = (seed.value, seed.at.to_array());
                if !(value > 0.0 && value.is_finite()) {
                    return Err(SpacingError::NotPositive { value, x, y });
                }
                if starts.len() > DEPTH {
                    return Err(SpacingError::Unresolved { value, x, y });
                }
                self.samples.set(start + index, seed.at, seed.value);
                self.lowest.push(*lowest);
            }
            let fates: Vec<Fate> = (start..self.lowest.len())
                .into_par_iter()
                .map(|node| self.fate(node))
                .collect();
            self.fates.extend_from_slice(&fates);
            level = self.next_level(start, &level)?;
        }
        Ok(starts)
    }

    /// Whether `lowest` is at least `share` of an upper bound of f_α on the cell of `node`, that is of U + α r.
    fn reaches(&self, lowest: f64, share: f64, node: usize) -> bool {
        let cell = self.samples.cell(node);
        let rise = self.alpha * 0.5 * cell.diagonal();
        self.samples
            .any(cell.centre(), node, |value| lowest >= share * (value + rise))
    }

    /// The fate of a node when all samples are those of its level and the levels above.
    fn fate(&self, node: usize) -> Fate {
        if self.reaches(self.lowest[node], self.factor, node) {
            Fate::Kept
        } else {
            Fate::Split
        }
    }

    /// The quarters of the cells that are split, entered into the tree of samples.
    fn next_level(&mut self, start: usize, level: &[Cell]) -> Result<Vec<Cell>, SpacingError> {
        let split = |(index, cell): (usize, &Cell)| -> Vec<Cell> {
            if self.fates[start + index] == Fate::Split {
                cell.split(self.domain).collect()
            } else {
                Vec::new()
            }
        };
        let parts: Vec<Vec<Cell>> = level.par_iter().enumerate().map(split).collect();
        let mut next = Vec::with_capacity(parts.iter().map(Vec::len).sum());
        for (index, part) in parts.into_iter().enumerate() {
            if !part.is_empty() {
                self.samples.add_children(start + index, &part);
                next.extend(part);
            }
        }
        if self.samples.len() > self.most {
            let worst = next[0].rect.centre();
            return Err(SpacingError::TooManyCells {
                cells: self.most,
                alpha: self.alpha,
                x: worst.x,
                y: worst.y,
            });
        }
        Ok(next)
    }

    /// Drops kept cells that samples dominate, and joins quarters into their cell if that may be kept.
    fn join(&mut self, starts: &[usize]) {
        let mut end = self.fates.len();
        for &start in starts.iter().rev() {
            let judged: Vec<(Fate, f64)> = (start..end).into_par_iter().map(|node| self.judge(node)).collect();
            for (node, (fate, lowest)) in (start..end).zip(judged) {
                if self.fates[node] == Fate::Split && fate == Fate::Kept {
                    self.samples
                        .children(node)
                        .for_each(|child| self.fates[child] = Fate::Dropped);
                }
                self.fates[node] = fate;
                self.lowest[node] = lowest;
            }
            end = start;
        }
    }

    /// The fate of a node when those below are settled. A joined cell takes the lowest value of its kept quarters: the dropped
    /// ones are dominated whatever this value is.
    fn judge(&self, node: usize) -> (Fate, f64) {
        let children = self.samples.children(node);
        let kept = children.clone().filter(|&child| self.fates[child] == Fate::Kept);
        let joined = kept.map(|child| self.lowest[child]).fold(f64::INFINITY, f64::min);
        match self.fates[node] {
            Fate::Kept if self.reaches(self.lowest[node], 1.0, node) => (Fate::Dropped, f64::INFINITY),
            Fate::Split if children.clone().any(|child| self.fates[child] == Fate::Split) => (Fate::Split, 0.0),
            Fate::Split if joined.is_infinite() => (Fate::Dropped, f64::INFINITY),
            Fate::Split if self.reaches(joined, self.factor, node) => (Fate::Kept, joined),
            settled => (settled, self.lowest[node]),
        }
    }

    /// The kept cells as terms, in boxes that are no larger than their terms need and have two parts or more, level by level.
    fn pack(&self) -> Vec<Branch> {
        // The box around the terms of each cell, with the lowest v among them; none if nothing is kept.
        let mut tight: Vec<Option<(Rect, f64)>> = vec![None; self.fates.len()];
        for node in (0..tight.len()).rev() {
            tight[node] = match self.fates[node] {
                Fate::Kept => Some((self.samples.cell(node), self.lowest[node])),
                Fate::Dropped => None,
                Fate::Split => self
                    .samples
                    .children(node)
                    .filter_map(|child| tight[child])
                    .reduce(around),
            };
        }
        let parts = |node: usize| -> Vec<usize> {
            match self.fates[node] {
                Fate::Split => self
                    .samples
                    .children(node)
                    .filter(|&child| tight[child].is_some())
                    .collect(),
                _ => Vec::new(),
            }
        };
        let mut queue = vec![0];
        let mut branches = Vec::new();
        while branches.len() < queue.len() {
            let mut node = queue[branches.len()];
            let mut own = parts(node);
            while let [only] = own[..] {
                node = only;
                own = parts(node);
            }
            let first = queue.len();
            queue.extend(own);
            let (cell, lowest) = tight[node].expect("only what has terms is in the queue");
            branches.push(Branch::new(cell, lowest, first..queue.len()));
        }
        branches
    }
}

/// The box around two, with the lower of their values.
fn around((a, low): (Rect, f64), (b, lower): (Rect, f64)) -> (Rect, f64) {
    let both = Rect {
        min: a.min.min(b.min),
        max: a.max.max(b.max),
    };
    (both, low.min(lower))
}

#[cfg(test)]
mod tests;
