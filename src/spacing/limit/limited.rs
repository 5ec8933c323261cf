//! F(x) = min over cells C of v_C + α · dist(x, C), evaluated by branch and bound over a quadtree or, once there are lists of the
//! terms that matter in each part of the plane, by a walk down to one of these.

use crate::domain::Domain;
use crate::geometry::{DVec2, Rect};
use crate::spacing::Spacing;
use crate::spacing::limit::waiting::Waiting;
use listed::Listed;
use std::ops::Range;

mod listed;

/// A term of F, or the box around several with the smallest v among them.
#[derive(Clone, Copy, Debug)]
pub struct Branch {
    centre: DVec2,
    half: DVec2,
    lowest: f64,
    first: u32,
    parts: u32,
}

impl Branch {
    /// A term: a square cell and its v. Or a box around several terms, the smallest v among them, and their places in the list; the
    /// box contains them even after its centre is rounded.
    pub fn new(cell: Rect, lowest: f64, parts: Range<usize>) -> Self {
        let half = if parts.is_empty() {
            DVec2::splat(0.5 * cell.size().max_element())
        } else {
            0.5 * cell.size() + 2.0 * f64::EPSILON * cell.largest_coordinate()
        };
        Self {
            centre: cell.centre(),
            half,
            lowest,
            first: parts.start as u32,
            parts: parts.len() as u32,
        }
    }

    #[inline]
    fn at(&self, x: DVec2, alpha: f64) -> f64 {
        self.lowest + alpha * beyond(x - self.centre, self.half)
    }

    #[inline]
    fn is_term(&self) -> bool {
        self.parts == 0
    }

    /// The places of its parts in the list.
    fn range(&self) -> Range<u32> {
        self.first..self.first + self.parts
    }

    /// From the point of the cell nearest to `x` to `x`.
    fn offset(&self, x: DVec2) -> DVec2 {
        let offset = x - self.centre;
        offset - offset.clamp(-self.half, self.half)
    }
}

/// The distance to a box with these half sides from the place at `offset` from its centre.
#[inline]
fn beyond(offset: DVec2, half: DVec2) -> f64 {
    (offset.abs() - half).max(DVec2::ZERO).length()
}

/// The gradient-limited spacing F: α-Lipschitz everywhere, since each term is, and so is their minimum (Lemma 2.3).
#[derive(Clone, Debug)]
pub struct Limited {
    alpha: f64,
    branches: Vec<Branch>,
    listed: Option<Listed>,
}

impl Limited {
    /// `branches` starts with the root; parts follow one another.
    pub fn new(alpha: f64, branches: Vec<Branch>) -> Self {
        Self {
            alpha,
            branches,
            listed: None,
        }
    }

    /// The same function, with lists of the terms that matter everywhere in `domain`: the lists take some time to make; queries on
    /// coasts are four to six times as fast for α up to 1/2, and gain less beyond.
    pub fn listed(mut self, domain: &Domain) -> Self {
        self.listed = Some(Listed::new(&self, domain));
        self
    }

    /// The lowest of `best` and the terms below a branch, at `x`, each with its term.
    #[inline]
    fn lowest(&self, from: u32, x: DVec2, best: (f64, u32)) -> (f64, u32) {
        let branch = &self.branches[from as usize];
        let bound = branch.at(x, self.alpha);
        if bound >= best.0 {
            best
        } else if branch.is_term() {
            (bound, from)
        } else {
            self.lowest_below((bound, from), x, best)
        }
    }

    /// The same, for a branch that is not a term, with its bound there.
    fn lowest_below(&self, from: (f64, u32), x: DVec2, mut best: (f64, u32)) -> (f64, u32) {
        let mut waiting = Waiting::new(from.0, from.1);
        while let Some((bound, index)) = waiting.next() {
            if bound >= best.0 {
                continue;
            }
            let branch = &self.branches[index as usize];
            if branch.is_term() {
                best = (bound, index);
                continue;
            }
            for part in branch.range() {
                let bound = self.branches[part as usize].at(x, self.alpha);
                if bound < best.0 {
                    waiting.file(bound, part);
                }
            }
        }
        best
    }

    /// Number of terms, and of cells above them; 48 bytes each.
    pub fn size(&self) -> (usize, usize) {
        let terms = self.branches.iter().filter(|branch| branch.is_term()).count();
        (terms, self.branches.len() - terms)
    }
}

impl Spacing for Limited {
    fn at(&self, x: DVec2) -> f64 {
        let listed = self.listed.as_ref().and_then(|listed| listed.at(x, self));
        listed.unwrap_or_else(|| self.lowest(0, x, (f64::INFINITY, 0)).0)
    }

    fn lipschitz(&self) -> f64 {
        self.alpha
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        // The root's v is the smallest of all.
        (self.at(cell.centre()) - self.alpha * 0.5 * cell.diagonal()).max(self.branches[0].lowest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Pslg;
    use proptest::prelude::*;

    const ROOT: Rect = Rect {
        min: DVec2::new(1.0, 2.0),
        max: DVec2::new(3.0, 4.0),
    };

    /// ROOT as a domain.
    fn square() -> Domain {
        let mut pslg = Pslg::new("square");
        pslg.add_ring(
            [
                ROOT.min,
                DVec2::new(ROOT.max.x, ROOT.min.y),
                ROOT.max,
                DVec2::new(ROOT.min.x, ROOT.max.y),
            ],
            1,
        );
        Domain::new(pslg).expect("a square")
    }

    /// Splits the cells that `choices` name, one after another; `values` are those of the cells without parts. Returns the
    /// terms too.
    fn limited(choices: &[usize], values: &[f64], alpha: f64) -> (Limited, Vec<(Rect, f64)>) {
        let mut cells = vec![(ROOT, 0..0)];
        for choice in choices {
            let leaves: Vec<usize> = (0..cells.len()).filter(|&k| cells[k].1.is_empty()).collect();
            let split = leaves[choice % leaves.len()];
            let quarters = cells[split].0.quarters().into_iter().skip(choice % 3);
            let first = cells.len();
            cells.extend(quarters.map(|rect| (rect, 0..0)));
            cells[split].1 = first..cells.len();
        }
        let mut lowest: Vec<f64> = (0..cells.len()).map(|k| values[k % values.len()]).collect();
        for k in (0..cells.len()).rev().filter(|&k| !cells[k].1.is_empty()) {
            lowest[k] = lowest[cells[k].1.clone()].iter().copied().fold(f64::INFINITY, f64::min);
        }
        let terms = (0..cells.len())
            .filter(|&k| cells[k].1.is_empty())
            .map(|k| (cells[k].0, lowest[k]));
        let terms = terms.collect();
        let branches = cells
            .iter()
            .zip(&lowest)
            .map(|((cell, parts), lowest)| Branch::new(*cell, *lowest, parts.clone()));
        (Limited::new(alpha, branches.collect()), terms)
    }

    #[test]
    fn an_offset_leads_from_the_nearest_point_of_the_cell() {
        let cell = Rect {
            min: DVec2::ZERO,
            max: DVec2::new(4.0, 4.0),
        };
        let term = Branch::new(cell, 1.0, 0..0);
        for (x, expected) in [
            ((1.0, 3.0), (0.0, 0.0)),
            ((6.0, 3.0), (2.0, 0.0)),
            ((-1.0, 7.0), (-1.0, 3.0)),
        ] {
            assert_eq!(term.offset(x.into()), expected.into());
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]

        #[test]
        fn f_is_the_minimum_over_its_terms(
            choices in prop::collection::vec(0usize..1000, 0..20),
            values in prop::collection::vec(0.1f64..1.0, 97),
            x in (0.0f64..4.0, 1.0f64..5.0),
        ) {
            let (limited, terms) = limited(&choices, &values, 0.6);
            let at = |x: DVec2| terms.iter().map(|(cell, v)| v + 0.6 * cell.distance(x)).fold(9.0, f64::min);
            let x = DVec2::new(x.0, x.1);
            prop_assert!((limited.at(x) - at(x)).abs() < 1e-15, "{} {}", limited.at(x), at(x));
            prop_assert_eq!(limited.size(), (terms.len(), choices.len()));
            prop_assert_eq!(limited.lipschitz(), 0.6);
            // With lists, to the last bit.
            let listed = limited.clone().listed(&square());
            prop_assert_eq!(listed.at(x), limited.at(x));
            for (cell, _) in &terms {
                prop_assert_eq!(listed.at(cell.centre()), limited.at(cell.centre()));
            }
            // No lower than α allows from the centre, nor than the lowest term.
            let cell = Rect { min: x, max: x + DVec2::new(0.3, 0.4) };
            let lowest = terms.iter().map(|term| term.1).fold(9.0, f64::min);
            let expected = (at(cell.centre()) - 0.6 * 0.25).max(lowest);
            prop_assert!((limited.lower_bound(cell) - expected).abs() < 1e-15);
        }
    }
}
