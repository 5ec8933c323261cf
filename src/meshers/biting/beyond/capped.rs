//! The spacing that biting uses: f, held down where corners are cut off and where circles would meet low.

use crate::geometry::DVec2;
use crate::geometry::segments::SegmentIndex;
use crate::spacing::Spacing;

/// An upper bound of s = c_b f along a line segment: `size + slope · y` at distance y from its start, and growing with
/// slope t away from the line segment.
#[derive(Clone, Copy, Debug)]
pub(in crate::meshers::biting) struct Cap {
    pub start: DVec2,
    /// A unit vector.
    pub direction: DVec2,
    pub length: f64,
    pub size: f64,
    pub slope: f64,
}

impl Cap {
    /// A bound at one point.
    pub fn point(at: DVec2, size: f64) -> Self {
        Self {
            start: at,
            direction: DVec2::X,
            length: 0.0,
            size,
            slope: 0.0,
        }
    }

    /// min over y in [0, length] of size + slope · y + t ‖x − (start + y direction)‖.
    fn at(&self, x: DVec2, t: f64) -> f64 {
        let to = x - self.start;
        let (along, across) = (to.dot(self.direction), to.perp_dot(self.direction).abs());
        let steeper = t * t - self.slope * self.slope;
        let best = if steeper > 0.0 {
            (along - across * self.slope / steeper.sqrt()).clamp(0.0, self.length)
        } else {
            0.0
        };
        self.size + self.slope * best + t * (along - best).hypot(across)
    }
}

/// min(f, caps / c_b): Lipschitz with t / c_b, since each of its terms is (Lemma 2.3).
pub(in crate::meshers::biting) struct Capped<'a> {
    inner: &'a dyn Spacing,
    c_b: f64,
    t: f64,
    caps: Vec<Cap>,
    index: SegmentIndex,
    smallest: f64,
}

impl<'a> Capped<'a> {
    /// Caps `inner`. `t` must be at least that of `inner`, unless there are no caps.
    pub fn new(inner: &'a dyn Spacing, c_b: f64, t: f64, caps: Vec<Cap>) -> Self {
        let ends = |cap: &Cap| [cap.start, cap.start + cap.direction * cap.length];
        Self {
            inner,
            c_b,
            t,
            index: SegmentIndex::new(caps.iter().map(ends)),
            smallest: caps.iter().map(|cap| cap.size).fold(f64::INFINITY, f64::min),
            caps,
        }
    }

    /// Whether nothing is capped.
    pub fn is_empty(&self) -> bool {
        self.caps.is_empty()
    }
}

impl Spacing for Capped<'_> {
    fn at(&self, x: DVec2) -> f64 {
        let inner = self.inner.at(x);
        let mut least = self.c_b * inner;
        let mut is_capped = false;
        // A cap farther away than that is above s, whatever its slope.
        let reach = |least: f64| (least - self.smallest) / self.t;
        self.index.nearest_first(x, reach(least), |cap, _| {
            let size = self.caps[cap].at(x, self.t);
            if size < least {
                least = size;
                is_capped = true;
            }
            reach(least)
        });
        if is_capped { least / self.c_b } else { inner }
    }

    fn lipschitz(&self) -> f64 {
        if self.caps.is_empty() {
            self.inner.lipschitz()
        } else {
            self.t / self.c_b
        }
    }

    fn is_geodesic(&self) -> bool {
        self.inner.is_geodesic()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spacing::Uniform;

    /// The least of a cap's values over many of its points, by a loop.
    fn slow(cap: &Cap, x: DVec2, t: f64) -> f64 {
        let values = (0..=10_000).map(|k| {
            let y = cap.length * f64::from(k) / 10_000.0;
            cap.size + cap.slope * y + t * x.distance(cap.start + cap.direction * y)
        });
        values.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_cap_is_the_least_over_its_points() {
        for (slope, t) in [(0.1, 0.25), (0.25, 0.25), (0.9, 0.25), (0.0, 0.3)] {
            let cap = Cap {
                start: DVec2::new(0.2, -0.1),
                direction: DVec2::new(0.6, 0.8),
                length: 2.0,
                size: 0.05,
                slope,
            };
            for x in [
                DVec2::ZERO,
                DVec2::new(1.0, 1.5),
                DVec2::new(3.0, -1.0),
                DVec2::new(1.4, 1.5),
            ] {
                let (fast, slow) = (cap.at(x, t), slow(&cap, x, t));
                assert!(
                    (fast - slow).abs() < 1e-6 && fast <= slow + 1e-15,
                    "{slope} {x}: {fast} {slow}"
                );
            }
        }
    }

    #[test]
    fn caps_hold_where_they_bind_and_the_spacing_elsewhere() {
        let uniform = Uniform(1.0);
        let capped = Capped::new(&uniform, 0.5, 0.25, vec![Cap::point(DVec2::ZERO, 0.1)]);
        assert_eq!(capped.at(DVec2::ZERO), 0.1 / 0.5);
        assert!((capped.at(DVec2::X) - (0.1 + 0.25) / 0.5).abs() < 1e-15);
        assert_eq!(capped.at(DVec2::X * 10.0), 1.0);
        assert!(capped.lipschitz() == 0.5 && !capped.is_empty());
        assert_eq!(Capped::new(&uniform, 0.5, 0.25, Vec::new()).lipschitz(), 0.0);
    }
}
