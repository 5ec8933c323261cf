//! F(x) = min over cells C of v_C + α · dist(x, C), evaluated by branch and bound over a quadtree.

use super::Spacing;
use super::cover::DEPTH;
use crate::geometry::{DVec2, Rect};

/// Most branches waiting in a query: three a level, and the four that are being entered.
const STACK: usize = 3 * DEPTH + 8;

/// A cell of the quadtree: a term of F where it has no parts, else the smallest v among its parts.
#[derive(Clone, Copy, Debug)]
pub struct Branch {
    centre: DVec2,
    half: f64,
    lowest: f64,
    first: u32,
    parts: u32,
}

impl Branch {
    /// A square cell, its v, and where its parts stand.
    pub fn new(cell: Rect, lowest: f64, parts: std::ops::Range<usize>) -> Self {
        let half = 0.5 * cell.size().max_element();
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
        let outside = ((x - self.centre).abs() - DVec2::splat(self.half)).max(DVec2::ZERO);
        self.lowest + alpha * outside.length()
    }
}

/// The gradient-limited spacing F: α-Lipschitz everywhere, since each term is and a minimum keeps that (Lemma 2.3).
#[derive(Clone, Debug)]
pub struct Limited {
    alpha: f64,
    branches: Vec<Branch>,
}

impl Limited {
    /// `branches` starts with the root; parts follow one another.
    pub fn new(alpha: f64, branches: Vec<Branch>) -> Self {
        Self { alpha, branches }
    }

    /// Number of terms, and of cells above them; 40 bytes each.
    pub fn size(&self) -> (usize, usize) {
        let terms = self.branches.iter().filter(|branch| branch.parts == 0).count();
        (terms, self.branches.len() - terms)
    }
}

impl Spacing for Limited {
    fn at(&self, x: DVec2) -> f64 {
        let mut best = f64::INFINITY;
        let mut stack = [(0.0, 0u32); STACK];
        stack[0].0 = self.branches[0].at(x, self.alpha);
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (bound, index) = stack[height];
            if bound >= best {
                continue;
            }
            let branch = &self.branches[index as usize];
            if branch.parts == 0 {
                best = bound;
                continue;
            }
            let mut entered = height;
            for part in branch.first..branch.first + branch.parts {
                let bound = self.branches[part as usize].at(x, self.alpha);
                if bound < best {
                    // Kept in descending order, so that the most promising part is entered first.
                    let mut place = entered;
                    while place > height && stack[place - 1].0 < bound {
                        stack[place] = stack[place - 1];
                        place -= 1;
                    }
                    stack[place] = (bound, part);
                    entered += 1;
                }
            }
            height = entered;
        }
        best
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
    use proptest::prelude::*;

    const ROOT: Rect = Rect {
        min: DVec2::new(1.0, 2.0),
        max: DVec2::new(3.0, 4.0),
    };

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
            // No lower than α allows from the centre, nor than the lowest term.
            let cell = Rect { min: x, max: x + DVec2::new(0.3, 0.4) };
            let lowest = terms.iter().map(|term| term.1).fold(9.0, f64::min);
            let expected = (at(cell.centre()) - 0.6 * 0.25).max(lowest);
            prop_assert!((limited.lower_bound(cell) - expected).abs() < 1e-15);
        }
    }
}
