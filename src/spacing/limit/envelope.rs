//! The envelope of sizes at points (§2.3): the largest α-Lipschitz function that is nowhere above them.
//!
//! F(x) = min over samples of f_k + α‖x − x_k‖, exactly: each sample is a cell without extent among the terms of a [`Limited`], in
//! a tree that halves the samples by their places, so that a query visits few of them.
//!
//! # Cost
//! O(n log n) to build; a query is branch and bound, as for a limited spacing.

use crate::domain::LARGEST_COORDINATE;
use crate::geometry::{DVec2, Rect};
use crate::spacing::Limited;
use crate::spacing::limit::limited::Branch;

/// The envelope of `values` at `points`.
///
/// # Errors
/// A message that says what is wrong: no points, a value that is not positive, coordinates that no domain may have, or no finite α.
pub fn of_samples(alpha: f64, points: &[DVec2], values: &[f64]) -> Result<Limited, String> {
    if !(alpha > 0.0 && alpha.is_finite()) {
        return Err(format!(
            "alpha is {alpha}: by how much sizes grow between points must be positive and finite"
        ));
    }
    if points.is_empty() || points.len() != values.len() {
        return Err(format!("{} sizes at {} points", values.len(), points.len()));
    }
    for (k, (point, value)) in points.iter().zip(values).enumerate() {
        if !(point.is_finite() && point.abs().max_element() <= LARGEST_COORDINATE) {
            return Err(format!(
                "point {k} is at ({:?}, {:?}): coordinates must be finite and at most {LARGEST_COORDINATE:?} in size",
                point.x, point.y
            ));
        }
        if !(*value > 0.0 && value.is_finite()) {
            return Err(format!(
                "the size of point {k} at ({}, {}) is {value}: it must be finite and positive",
                point.x, point.y
            ));
        }
    }
    let mut order: Vec<usize> = (0..points.len()).collect();
    let lowest = |part: &[usize]| part.iter().map(|&k| values[k]).fold(f64::INFINITY, f64::min);
    let around = |part: &[usize]| Rect::around(part.iter().map(|&k| points[k]));
    let mut branches = Vec::with_capacity(2 * points.len());
    let mut queue: Vec<_> = std::iter::once(0..points.len()).collect();
    while branches.len() < queue.len() {
        let range = queue[branches.len()].clone();
        let first = queue.len();
        let part = &mut order[range.clone()];
        if part.len() > 1 {
            halve(part, points);
            let middle = part.len() / 2;
            queue.extend([range.start..range.start + middle, range.start + middle..range.end]);
        }
        let part = &order[range];
        branches.push(Branch::new(around(part), lowest(part), first..queue.len()));
    }
    Ok(Limited::new(alpha, branches))
}

/// Puts the half that is lower along the longer side first.
fn halve(part: &mut [usize], points: &[DVec2]) {
    let size = Rect::around(part.iter().map(|&k| points[k])).size();
    let axis = usize::from(size.y > size.x);
    let middle = part.len() / 2;
    part.select_nth_unstable_by(middle, |&a, &b| points[a][axis].total_cmp(&points[b][axis]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::gallery;
    use crate::spacing::testing::pseudo_random_points;
    use crate::spacing::{Options, Spacing, build};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]

        /// It is the minimum over all samples, so it is below each, α-Lipschitz, and no function that is both is above it.
        #[test]
        fn it_is_the_largest_lipschitz_function_below_the_samples(
            samples in prop::collection::vec(((-1.0f64..1.0, -1.0f64..1.0), 0.01f64..1.0), 1..60),
            alpha in 0.05f64..2.0,
            x in (-2.0f64..2.0, -2.0f64..2.0),
            y in (-2.0f64..2.0, -2.0f64..2.0),
        ) {
            let points: Vec<DVec2> = samples.iter().map(|(point, _)| DVec2::from(*point)).collect();
            let values: Vec<f64> = samples.iter().map(|sample| sample.1).collect();
            let envelope = of_samples(alpha, &points, &values).unwrap();
            let naive = |x: DVec2| points.iter().zip(&values).map(|(p, v)| v + alpha * p.distance(x)).fold(f64::INFINITY, f64::min);
            let [x, y] = [x, y].map(DVec2::from);
            prop_assert!((envelope.at(x) - naive(x)).abs() <= 1e-14 * naive(x));
            prop_assert!((envelope.at(x) - envelope.at(y)).abs() <= alpha * x.distance(y) + 1e-14);
            for (point, value) in points.iter().zip(&values) {
                prop_assert!(envelope.at(*point) <= *value);
            }
            prop_assert_eq!(envelope.size().0, points.len());
        }
    }

    /// lfs sampled densely, and lfs limited as a function: the limiter is below the samples' envelope, which is above the largest
    /// function by no more than samples are apart, and not below its share of that.
    #[test]
    fn envelope_of_many_samples_and_limiter_agree() {
        let domain = gallery::domain("l-shape").unwrap().unwrap();
        let lfs = crate::spacing::lfs_of(&domain).unwrap();
        let (bounds, side) = (domain.bounds(), 400);
        let place = |k: usize| {
            bounds.min + bounds.size() * DVec2::new((k % side) as f64, (k / side) as f64) / (side - 1) as f64
        };
        let points: Vec<DVec2> = (0..side * side).map(place).filter(|&x| domain.contains(x)).collect();
        let values: Vec<f64> = points.iter().map(|&x| lfs.at(x)).collect();
        let apart = bounds.diagonal() / (side - 1) as f64;
        for alpha in [0.1, 0.3, 0.7] {
            let envelope = of_samples(alpha, &points, &values).unwrap();
            let limited = build("lfs", &domain, &Options::with_alpha(alpha)).unwrap().function;
            for x in pseudo_random_points(300)
                .into_iter()
                .map(|x| bounds.min + bounds.size() * x)
            {
                if domain.contains(x) {
                    let (above, value) = (envelope.at(x), limited.at(x));
                    assert!(
                        value <= above && value >= 0.9 * (above - (1.0 + alpha) * apart),
                        "{alpha} {x}: {value} {above}"
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_no_size_is_refused() {
        let refused = |alpha: f64, points: &[DVec2], values: &[f64]| of_samples(alpha, points, values).unwrap_err();
        assert!(refused(f64::INFINITY, &[DVec2::ZERO], &[1.0]).contains("alpha is inf"));
        assert_eq!(refused(0.5, &[], &[]), "0 sizes at 0 points");
        assert!(refused(0.5, &[DVec2::X], &[-1.0]).contains("point 0 at (1, 0) is -1"));
        assert!(refused(0.5, &[DVec2::NAN], &[1.0]).contains("point 0 is at (NaN, NaN)"));
        // Found by fuzzing: its box has no finite centre.
        let far = DVec2::new(0.0, 1e308);
        assert!(refused(0.5, &[DVec2::ZERO, far], &[1.0; 2]).contains("point 1 is at (0.0, 1e308): coordinates"));
        // Many in one place.
        let envelope = of_samples(0.5, &[DVec2::X; 9], &[2.0; 9]).unwrap();
        assert_eq!(envelope.at(DVec2::ZERO), 2.5);
    }
}
