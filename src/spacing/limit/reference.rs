//! The largest α-Lipschitz function below f, at a point: dense, slow, and independent, to hold the limiter against.
//!
//! # Idea
//! f_α(x) = min over y ∈ Ω of f(y) + α‖x − y‖ (§2.3). On a cell C that is at least (lower bound of f on C) + α · dist(x, C), and
//! at any point y of C it is at most f(y) + α‖x − y‖. Cells are split, the one with the lowest bound first, until the two agree.
//!
//! # Guarantee
//! f_α(x) lies in the interval that is returned. Nothing is shared with the limiter but the cells that meet Ω.

use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::spacing::Spacing;
use crate::spacing::cover::{Cell, DEPTH};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Most cells visited for a point: where f rises as fast as α, many have nearly the same bound.
const BUDGET: usize = 2_000_000;

/// The interval in which the largest `alpha`-Lipschitz function below a positive `f` on `domain` lies at `x`: within a share `gap`
/// if [`BUDGET`] cells are enough.
fn largest_at(f: &dyn Spacing, domain: &Domain, alpha: f64, x: DVec2, gap: f64) -> [f64; 2] {
    let value = |y: DVec2| f.at(y) + alpha * x.distance(y);
    let mut most = if domain.contains(x) { f.at(x) } else { f64::INFINITY };
    let mut cells = vec![Some((Cell::root(domain), 0))];
    // The lowest bound first. Bounds are not negative, so their bits have the same order.
    let mut waiting = BinaryHeap::from([Reverse((0f64.to_bits(), 0))]);
    while let Some(Reverse((bits, index))) = waiting.pop() {
        let above = f64::from_bits(bits);
        let Some((cell, depth)) = cells[index].take().filter(|_| above < (1.0 - gap) * most) else {
            return [above.min(most), most];
        };
        if depth == DEPTH || cells.len() > BUDGET {
            return [above.min(most), most];
        }
        for part in cell.split(domain) {
            most = most.min(value(part.point(domain)));
            // At least that of the whole.
            let bound = (f.lower_bound(part.rect) + alpha * part.rect.distance(x)).max(above);
            if bound < most {
                waiting.push(Reverse((bound.to_bits(), cells.len())));
                cells.push(Some((part, depth + 1)));
            }
        }
    }
    [most, most]
}

mod tests {
    use super::*;
    use crate::spacing::testing::{gallery, points_inside};
    use crate::spacing::{Options, Uniform, build, lfs_of};
    use proptest::prelude::*;

    /// How near the reference is to be.
    const GAP: f64 = 1e-3;

    #[test]
    fn below_a_constant_it_is_that_constant() {
        let domain = gallery("comb");
        let x = domain.vertices()[0];
        assert_eq!(largest_at(&Uniform(0.5), &domain, 0.3, x, 1e-3), [0.5, 0.5]);
    }

    /// By hand: in the unit square lfs is 1/2 in the middle and at the middles of the sides, and 1 at the corners; with α = 1/4 the
    /// middle of the nearest side decides at a corner.
    #[test]
    fn at_a_corner_of_the_square_the_middle_of_a_side_decides() {
        let domain = gallery("unit-square");
        let lfs = lfs_of(&domain).unwrap();
        let [least, most] = largest_at(&lfs, &domain, 0.25, domain.vertices()[0], 1e-4);
        assert!(least <= 0.625 && 0.625 <= most && most - least < 1e-4, "{least} {most}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// As measured once on the coast of norway, at 600 points for each of nine α: at least 0.900 of the largest function,
        /// up to all of it.
        #[test]
        fn the_limiter_is_below_it_and_within_its_factor(seed in 0u64..1000, alpha in 0.05f64..1.05) {
            let domain = gallery(&format!("random-simple:n=16,seed={seed}"));
            let lfs = lfs_of(&domain).unwrap();
            let options = Options::with_alpha(alpha);
            let limited = build("lfs", &domain, &options).unwrap().function;
            let along = |s: usize| { let [a, b] = domain.ends(s); a.lerp(b, 0.3) };
            let edges = (0..domain.segments().len()).map(along);
            for x in points_inside(&domain, 16).into_iter().chain(edges) {
                let [least, most] = largest_at(&lfs, &domain, alpha, x, GAP);
                let value = limited.at(x);
                prop_assert!(most <= (1.0 + 2.0 * GAP) * least, "{x}: in {least} {most}");
                prop_assert!(options.limit_factor * least <= value && value <= most * (1.0 + 1e-12), "{x}: {value} in {least} {most}");
            }
        }
    }
}
