//! Lists of the terms of F that matter in each part of a domain: the leaves of a quadtree (§2.3, end).
//!
//! The paper suggests interpolation from the corners of a leaf; here F itself is evaluated, and so stays α-Lipschitz across leaves
//! of any sizes. The quadtree need not be balanced, and is not.

use crate::domain::Domain;
use crate::geometry::{DVec2, Rect};
use crate::spacing::cover::Cell;
use crate::spacing::lfs::items::{Asked, Items};
use crate::spacing::lfs::shortlist::Shortlists;
use crate::spacing::limit::limited::{Branch, Limited, beyond};
use std::hint::select_unpredictable;
use std::ops::Range;

/// Branches larger than this share of a cell's side are not in its list: their parts are.
const COARSE: f64 = 0.02;

/// A list as short as this is not split further, nor is a longer one once its cell's radius is this share of F or, the longer
/// the list, a smaller one: with finer cells lists would take longer to make than queries gain.
const FINEST: f64 = 0.4;
const SHORT: usize = 48;

/// Branch and bound over all terms is faster than a list longer than this.
const LONGEST: usize = 192;

/// A term of F in half a line of the cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Term {
    centre: DVec2,
    half: f64,
    lowest: f64,
}

impl Term {
    #[inline]
    fn at(&self, x: DVec2, alpha: f64) -> f64 {
        self.lowest + alpha * beyond(x - self.centre, DVec2::splat(self.half))
    }
}

/// The terms in the order of their tree, so that those of a list are near one another, and the lists.
#[derive(Clone, Debug)]
pub struct Listed {
    terms: Vec<Term>,
    /// Lists of numbers of terms and, beyond these, of branches, which come last in a list.
    lists: Shortlists,
}

impl Listed {
    pub fn new(limited: &Limited, domain: &Domain) -> Self {
        let root = Cell::root(domain).rect;
        let lists = Shortlists::new(&Terms { limited, domain }, &[0], root);
        let mut terms = Vec::new();
        let mut numbers = vec![None; limited.branches.len()];
        let mut pending = vec![0];
        while let Some(index) = pending.pop() {
            let branch = &limited.branches[index as usize];
            if branch.is_term() {
                numbers[index as usize] = Some(terms.len() as u32);
                terms.push(Term {
                    centre: branch.centre,
                    half: branch.half.x,
                    lowest: branch.lowest,
                });
            }
            pending.extend(branch.range().rev());
        }
        let first_branch = terms.len() as u32;
        let lists = lists.renumbered(|index| numbers[index as usize].unwrap_or(first_branch + index));
        Self { terms, lists }
    }

    /// F at `x`; none outside the domain, or where a list would be long.
    #[inline]
    pub fn at(&self, x: DVec2, limited: &Limited) -> Option<f64> {
        let list = self.lists.at(x).filter(|list| !list.is_empty())?;
        let first_branch = self.terms.len() as u32;
        let is_branch = |&&number: &&u32| number >= first_branch;
        let (terms, branches) = list.split_at(list.len() - list.iter().rev().take_while(is_branch).count());
        // Which term is lower cannot be predicted.
        let lower = |best: f64, value: f64| select_unpredictable(value < best, value, best);
        let at = |&term: &u32| self.terms[term as usize].at(x, limited.alpha);
        let lowest = terms.iter().map(at).fold(f64::INFINITY, lower);
        let or_of_branch = |best, &number: &u32| limited.lowest(number - first_branch, x, best);
        Some(branches.iter().fold((lowest, 0), or_of_branch).0)
    }
}

/// The terms of F as items, for the lists of a domain.
struct Terms<'a> {
    limited: &'a Limited,
    domain: &'a Domain,
}

impl Terms<'_> {
    fn branch(&self, item: u32) -> &Branch {
        &self.limited.branches[item as usize]
    }
}

impl Items for Terms<'_> {
    fn decide(&self, list: &[u32], x: DVec2) -> (f64, [u32; 2]) {
        let or_of = |best, &from: &u32| self.limited.lowest(from, x, best);
        let (value, term) = list.iter().fold((f64::INFINITY, 0), or_of);
        (value, [term; 2])
    }

    #[inline]
    fn offset(&self, item: u32, x: DVec2) -> (DVec2, f64) {
        let branch = self.branch(item);
        (branch.offset(x), branch.lowest)
    }

    fn slope(&self) -> f64 {
        self.limited.alpha
    }

    fn parts(&self, item: u32, cell: &Rect) -> Option<Range<u32>> {
        let branch = self.branch(item);
        let is_large = branch.half.max_element() > COARSE * cell.size().max_element();
        (is_large && !branch.is_term()).then(|| branch.range())
    }

    fn is_single(&self, item: u32) -> bool {
        self.branch(item).is_term()
    }

    fn asked_in(&self, cell: &Rect) -> Asked {
        let centre = cell.centre();
        let mut is_near = false;
        self.domain
            .index()
            .nearest_first(centre, 0.5 * cell.diagonal(), |_, _| {
                is_near = true;
                // No farther.
                -1.0
            });
        if is_near {
            Asked::InPart
        } else if self.domain.contains(centre) {
            Asked::Everywhere
        } else {
            Asked::Nowhere
        }
    }

    fn is_fine(&self, share: f64, count: usize) -> bool {
        share * count.min(LONGEST) as f64 <= FINEST * SHORT as f64
    }

    fn longest(&self) -> usize {
        LONGEST
    }

    fn short(&self) -> usize {
        SHORT
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::gallery;
    use crate::spacing::testing::pseudo_random_points;

    /// A term in each of 4⁶ cells, whose v rises by less than α from one corner on, but for that corner's own, which is lower.
    fn rising(root: Rect, alpha: f64) -> Limited {
        let mut cells = vec![(root, 0..0)];
        for index in 0..(4usize.pow(6) - 1) / 3 {
            cells[index].1 = cells.len()..cells.len() + 4;
            cells.extend(cells[index].0.quarters().map(|quarter| (quarter, 0..0)));
        }
        let branch = |(cell, parts): (Rect, Range<usize>)| {
            let rise = 0.3 * cell.distance(root.min);
            Branch::new(cell, if rise == 0.0 { 0.01 } else { 0.1 + rise }, parts)
        };
        Limited::new(alpha, cells.into_iter().map(branch).collect())
    }

    #[test]
    fn lists_are_where_the_domain_is() {
        let domain = gallery::domain("star").unwrap().unwrap();
        let root = Cell::root(&domain).rect;
        let (mut inside, mut outside) = (0, 0);
        for alpha in [0.5, 5.0] {
            let limited = rising(root, alpha);
            let listed = Listed::new(&limited, &domain);
            // As many places near the lower corner, where the lowest term decides, as everywhere.
            let shares = pseudo_random_points(400).into_iter();
            for x in shares.flat_map(|share| [1.0, 0.25].map(|part| root.min + part * share * root.size())) {
                let expected = limited.lowest(0, x, (f64::INFINITY, 0)).0;
                let found = listed.at(x, &limited);
                let (_, distance) = domain.index().nearest(x).expect("a boundary");
                if domain.contains(x) {
                    assert_eq!(found, Some(expected), "{x}");
                    inside += 1;
                } else if distance > 0.1 * root.size().x {
                    assert_eq!(found, None, "{x}");
                    outside += 1;
                }
            }
        }
        assert!(inside > 100 && outside > 10, "{inside} {outside}");
    }
}
