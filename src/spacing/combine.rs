//! Spacings made of spacings: the smallest of several, and a multiple (Lemma 2.3).

use crate::geometry::{DVec2, Rect};
use crate::spacing::Spacing;
use std::sync::Arc;

/// `min(A, B)`: f(x) = min(A(x), B(x)), Lipschitz with the larger of the two constants (Lemma 2.3).
#[derive(Clone)]
pub struct Min {
    parts: Vec<Arc<dyn Spacing>>,
}

impl Min {
    /// The smallest of `parts` on `bounds`. A part that is proved to be nowhere below another one there is left out, so that
    /// it does not raise the Lipschitz constant; a single part may be left.
    pub fn of(parts: Vec<Arc<dyn Spacing>>, bounds: Rect) -> Arc<dyn Spacing> {
        let mut kept: Vec<Arc<dyn Spacing>> = Vec::with_capacity(parts.len());
        for part in parts {
            let lowest = part.lower_bound(bounds);
            if kept.iter().any(|other| other.upper_bound(bounds) <= lowest) {
                continue;
            }
            let highest = part.upper_bound(bounds);
            kept.retain(|other| other.lower_bound(bounds) < highest);
            kept.push(part);
        }
        if kept.len() == 1 {
            kept.swap_remove(0)
        } else {
            Arc::new(Self { parts: kept })
        }
    }

    fn lowest(&self, value: impl Fn(&dyn Spacing) -> f64) -> f64 {
        self.parts
            .iter()
            .map(|part| value(part.as_ref()))
            .fold(f64::INFINITY, smaller)
    }
}

/// The smaller of two values, not a number if one of them is not.
fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b { a } else { b }
}

impl Spacing for Min {
    fn at(&self, x: DVec2) -> f64 {
        self.lowest(|part| part.at(x))
    }

    fn lipschitz(&self) -> f64 {
        self.parts.iter().map(|part| part.lipschitz()).fold(0.0, f64::max)
    }

    fn is_geodesic(&self) -> bool {
        // No way inside the domain is shorter than the straight line, so the constants of the others hold too.
        self.parts.iter().any(|part| part.is_geodesic())
    }

    fn in_plane(&self) -> Option<Arc<dyn Spacing>> {
        let parts: Vec<_> = self.parts.iter().map(|part| part.in_plane()).collect();
        let is_any = parts.iter().any(Option::is_some);
        let each = parts
            .into_iter()
            .zip(&self.parts)
            .map(|(plane, part)| plane.unwrap_or_else(|| part.clone()));
        is_any.then(|| Arc::new(Self { parts: each.collect() }) as Arc<dyn Spacing>)
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        self.lowest(|part| part.lower_bound(cell))
    }

    fn upper_bound(&self, cell: Rect) -> f64 {
        self.lowest(|part| part.upper_bound(cell))
    }
}

/// f(x) = factor · g(x). With a factor under 1 this is the cheapest way to a smaller Lipschitz constant.
#[derive(Clone)]
pub struct Scaled {
    factor: f64,
    inner: Arc<dyn Spacing>,
}

impl Scaled {
    /// `factor` positive.
    pub fn new(factor: f64, inner: Arc<dyn Spacing>) -> Self {
        Self { factor, inner }
    }
}

impl Spacing for Scaled {
    fn at(&self, x: DVec2) -> f64 {
        self.factor * self.inner.at(x)
    }

    fn lipschitz(&self) -> f64 {
        self.factor * self.inner.lipschitz()
    }

    fn is_geodesic(&self) -> bool {
        self.inner.is_geodesic()
    }

    fn in_plane(&self) -> Option<Arc<dyn Spacing>> {
        let inner = self.inner.in_plane()?;
        Some(Arc::new(Self::new(self.factor, inner)))
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        self.factor * self.inner.lower_bound(cell)
    }

    fn upper_bound(&self, cell: Rect) -> f64 {
        self.factor * self.inner.upper_bound(cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spacing::{Expression, Uniform};

    const BOX: Rect = Rect {
        min: DVec2::ZERO,
        max: DVec2::ONE,
    };

    fn expression(text: &str) -> Arc<dyn Spacing> {
        Arc::new(Expression::new(text, BOX).unwrap())
    }

    #[test]
    fn a_scaled_spacing_is_a_multiple_in_everything() {
        let inner = expression("1 + x");
        let scaled = Scaled::new(0.25, inner.clone());
        assert_eq!(scaled.at(DVec2::new(0.5, 0.0)), 0.375);
        assert_eq!(scaled.lipschitz(), 0.25 * inner.lipschitz());
        assert_eq!(scaled.lower_bound(BOX), 0.25 * inner.lower_bound(BOX));
        assert_eq!(scaled.upper_bound(BOX), 0.25 * inner.upper_bound(BOX));
        assert!(scaled.lower_bound(BOX) > 0.24 && scaled.upper_bound(BOX) < 0.51);
    }

    #[test]
    fn the_smallest_of_several_has_the_smallest_bounds_and_the_largest_constant() {
        let parts = [expression("0.5 + x"), expression("0.5 + 2*y")];
        let min = Min::of(parts.to_vec(), BOX);
        assert_eq!(min.at(DVec2::new(0.25, 0.5)), 0.75);
        assert_eq!(min.at(DVec2::new(0.75, 0.25)), 1.0);
        assert_eq!(min.lipschitz(), parts[1].lipschitz());
        let cell = Rect {
            min: DVec2::new(0.5, 0.0),
            max: DVec2::new(0.75, 0.25),
        };
        assert_eq!(min.lower_bound(cell), parts[1].lower_bound(cell));
        assert_eq!(min.upper_bound(cell), parts[1].upper_bound(cell));
    }

    #[test]
    fn parts_that_never_decide_are_left_out_in_either_order() {
        let steep = expression("2 + x");
        let flat: Arc<dyn Spacing> = Arc::new(Uniform(1.0));
        for parts in [[steep.clone(), flat.clone()], [flat.clone(), steep]] {
            assert_eq!(Min::of(parts.to_vec(), BOX).lipschitz(), 0.0);
        }
        // Where they only touch, the earlier stays.
        let equal: Vec<Arc<dyn Spacing>> = vec![flat, Arc::new(Uniform(1.0)), expression("1 + x")];
        assert_eq!(Min::of(equal, BOX).at(DVec2::X), 1.0);
    }

    /// Known by its bounds alone.
    struct Between(f64, f64);

    impl Spacing for Between {
        fn at(&self, _: DVec2) -> f64 {
            self.1
        }

        fn lipschitz(&self) -> f64 {
            7.0
        }

        fn lower_bound(&self, _: Rect) -> f64 {
            self.0
        }

        fn upper_bound(&self, _: Rect) -> f64 {
            self.1
        }
    }

    #[test]
    fn a_part_that_is_nowhere_below_another_is_left_out_and_no_other() {
        let constant = |low: f64, high: f64, first: bool| {
            let mut parts: Vec<Arc<dyn Spacing>> = vec![Arc::new(Between(low, high)), Arc::new(Uniform(1.0))];
            if !first {
                parts.reverse();
            }
            Min::of(parts, BOX).lipschitz()
        };
        for first in [true, false] {
            // Above, touching from above, overlapping, touching from below, below.
            let found = [(1.5, 2.0), (1.0, 2.0), (0.5, 2.0), (0.5, 1.0), (0.25, 0.5)]
                .map(|(low, high)| constant(low, high, first));
            assert_eq!(found, [0.0, 0.0, 7.0, 7.0, 7.0], "{first}");
        }
        assert_eq!(
            Min::of(vec![Arc::new(Between(0.5, 1.0)), Arc::new(Uniform(1.0))], BOX).at(DVec2::X),
            1.0
        );
    }

    #[test]
    fn what_is_not_a_number_is_not_hidden() {
        assert!(smaller(f64::NAN, 1.0).is_nan() && smaller(1.0, f64::NAN).is_nan());
        assert_eq!((smaller(1.0, 2.0), smaller(2.0, 1.0)), (1.0, 1.0));
    }
}
