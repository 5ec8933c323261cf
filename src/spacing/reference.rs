//! The largest α-Lipschitz function below f, at a point: dense, slow, and of its own.
//!
//! # Idea
//! f_α(x) = min over y ∈ Ω of f(y) + α‖x − y‖ (§2.3). On a cell C that is at least (lower bound of f on C) + α · dist(x, C), and
//! at any point y of C it is at most f(y) + α‖x − y‖. Cells are split, the one with the lowest bound first, until the two agree.
//!
//! # Guarantee
//! f_α(x) lies in the interval that is returned. Nothing is shared with the limiter but the cells that meet Ω, so that each checks
//! the other.

use super::Spacing;
use super::cover::{Cell, DEPTH};
use crate::domain::Domain;
use crate::geometry::DVec2;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Cells that are looked at for a point: where f rises as fast as α many say nearly the same.
const BUDGET: usize = 2_000_000;

/// The interval in which the largest `alpha`-Lipschitz function below `f` on `domain` lies at `x`: within a share `gap` where so
/// many cells as there is patience for are enough.
pub fn largest_at(f: &dyn Spacing, domain: &Domain, alpha: f64, x: DVec2, gap: f64) -> [f64; 2] {
    let value = |y: DVec2| f.at(y) + alpha * x.distance(y);
    // The bound of a part is at least that of the whole.
    let waiting = |cell: Cell, depth: usize, above: f64| Waiting {
        bound: (f.lower_bound(cell.rect) + alpha * cell.rect.distance(x)).max(above),
        cell,
        depth,
    };
    let mut most = if domain.contains(x) { f.at(x) } else { f64::INFINITY };
    let mut pending = BinaryHeap::from([waiting(Cell::root(domain), 0, 0.0)]);
    for _ in 0..BUDGET {
        let Some(least) = pending.pop() else {
            return [most, most];
        };
        if least.bound >= (1.0 - gap) * most || least.depth == DEPTH {
            return [least.bound.min(most), most];
        }
        for part in least.cell.split(domain) {
            most = most.min(value(part.point(domain)));
            let part = waiting(part, least.depth + 1, least.bound);
            if part.bound < most {
                pending.push(part);
            }
        }
    }
    [pending.pop().map_or(most, |least| least.bound.min(most)), most]
}

/// A cell that may hold the point where the minimum is taken; the lowest bound comes first.
struct Waiting {
    cell: Cell,
    depth: usize,
    bound: f64,
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

#[cfg(test)]
mod tests {
    use super::super::{Options, build, lfs_of};
    use super::*;
    use crate::domain::gallery;
    use crate::spacing::Uniform;

    #[test]
    fn below_a_constant_it_is_that_constant() {
        let domain = gallery::domain("comb").unwrap().unwrap();
        let x = domain.vertices()[0];
        assert_eq!(largest_at(&Uniform(0.5), &domain, 0.3, x, 1e-3), [0.5, 0.5]);
    }

    /// By hand: in the unit square lfs is 1/2 in the middle and at the middles of the sides, and 1 at the corners; with α = 1/4 the
    /// middle of the nearest side decides at a corner.
    #[test]
    fn at_a_corner_of_the_square_the_middle_of_a_side_decides() {
        let domain = gallery::domain("unit-square").unwrap().unwrap();
        let lfs = lfs_of(&domain).unwrap();
        let [least, most] = largest_at(&lfs, &domain, 0.25, domain.vertices()[0], 1e-4);
        assert!(least <= 0.625 && 0.625 <= most && most - least < 1e-4, "{least} {most}");
    }

    #[test]
    fn the_limiter_is_below_it_and_within_its_factor() {
        let domain = gallery::domain("gear").unwrap().unwrap();
        let lfs = lfs_of(&domain).unwrap();
        for alpha in [0.2, 0.6] {
            let limited = build("lfs", &domain, &Options::with_alpha(alpha)).unwrap().function;
            for &x in &domain.vertices()[..12] {
                let [least, most] = largest_at(&lfs, &domain, alpha, x, 1e-3);
                let value = limited.at(x);
                assert!(
                    0.9 * least <= value && value <= most,
                    "{alpha} {x}: {value} in {least} {most}"
                );
            }
        }
    }
}
