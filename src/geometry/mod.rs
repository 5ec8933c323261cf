//! Points, exact predicates, and near-queries.
//!
//! Every sign in the project comes from [`predicates`]; every tolerance from [`tolerance`].

pub(crate) mod boxes;
pub(crate) mod interval;
pub(crate) mod near;
pub(crate) mod predicates;
pub(crate) mod segment_grid;
pub(crate) mod segments;
pub(crate) mod tolerance;

pub use glam::DVec2;

/// Counter-clockwise angle from `u` to `v` in (0, 2π], rounded: for measuring, not for deciding signs.
pub(crate) fn turn(u: DVec2, v: DVec2) -> f64 {
    let angle = u.perp_dot(v).atan2(u.dot(v));
    if angle > 0.0 {
        angle
    } else {
        angle + std::f64::consts::TAU
    }
}

/// An axis-aligned box, closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Lower left corner.
    pub min: DVec2,
    /// Upper right corner.
    pub max: DVec2,
}

impl Rect {
    /// The empty box; growing it by a point gives that point.
    pub const EMPTY: Self = Self {
        min: DVec2::INFINITY,
        max: DVec2::NEG_INFINITY,
    };

    /// The smallest box around `points`.
    pub fn around(points: impl IntoIterator<Item = DVec2>) -> Self {
        points.into_iter().fold(Self::EMPTY, |r, p| Self {
            min: r.min.min(p),
            max: r.max.max(p),
        })
    }

    /// Width and height.
    pub fn size(self) -> DVec2 {
        self.max - self.min
    }

    /// The middle of the box.
    pub fn centre(self) -> DVec2 {
        0.5 * (self.min + self.max)
    }

    /// The largest magnitude of a coordinate in the box.
    pub fn largest_coordinate(self) -> f64 {
        self.min.abs().max(self.max.abs()).max_element()
    }

    /// Length of the diagonal.
    pub fn diagonal(self) -> f64 {
        self.size().length()
    }

    /// Euclidean distance from `x` to the box, 0 inside.
    pub fn distance(self, x: DVec2) -> f64 {
        (self.min - x).max(x - self.max).max(DVec2::ZERO).length()
    }

    /// Whether `x` lies in the closed box.
    pub fn contains(self, x: DVec2) -> bool {
        x.cmpge(self.min).all() && x.cmple(self.max).all()
    }

    /// Whether the two closed boxes have a point in common.
    pub fn meets(self, other: Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// The four quarters: lower left, lower right, upper left, upper right.
    pub fn quarters(self) -> [Self; 4] {
        let centre = self.centre();
        let columns = [(self.min.x, centre.x), (centre.x, self.max.x)];
        let rows = [(self.min.y, centre.y), (centre.y, self.max.y)];
        [0, 1, 2, 3].map(|quarter| {
            let ((left, right), (bottom, top)) = (columns[quarter & 1], rows[quarter >> 1]);
            Self {
                min: DVec2::new(left, bottom),
                max: DVec2::new(right, top),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    #[test]
    fn turns_are_counter_clockwise_and_never_zero() {
        let at = |degrees: f64| 2.0 * DVec2::from_angle(degrees.to_radians());
        for (from, to) in [(10.0, 100.0), (350.0, 80.0), (-170.0, -80.0)] {
            assert!((turn(at(from), at(to)) - FRAC_PI_2).abs() < 1e-12);
            assert!((turn(at(to), at(from)) - 3.0 * FRAC_PI_2).abs() < 1e-12);
        }
        assert_eq!(turn(DVec2::X, DVec2::X), TAU);
        assert_eq!(turn(DVec2::X, -DVec2::X), PI);
    }

    #[test]
    fn a_box_measures_itself() {
        let points = [DVec2::new(1.0, 6.0), DVec2::new(4.0, 2.0), DVec2::new(2.0, 3.0)];
        let bounds = Rect::around(points);
        assert_eq!((bounds.min, bounds.max), (DVec2::new(1.0, 2.0), DVec2::new(4.0, 6.0)));
        assert_eq!(bounds.size(), DVec2::new(3.0, 4.0));
        assert_eq!(bounds.centre(), DVec2::new(2.5, 4.0));
        assert_eq!(bounds.diagonal(), 5.0);
        assert_eq!(bounds.largest_coordinate(), 6.0);
        assert_eq!(
            Rect::around([DVec2::new(-7.0, 1.0), DVec2::ONE]).largest_coordinate(),
            7.0
        );
        let quarters = bounds.quarters();
        assert_eq!(quarters.map(|quarter| quarter.size()), [DVec2::new(1.5, 2.0); 4]);
        let corners = quarters.map(|quarter| quarter.min);
        assert_eq!(
            corners,
            [(1.0, 2.0), (2.5, 2.0), (1.0, 4.0), (2.5, 4.0)].map(DVec2::from)
        );
    }

    #[test]
    fn distances_to_a_box_are_to_its_nearest_point() {
        let bounds = Rect {
            min: DVec2::new(1.0, 2.0),
            max: DVec2::new(4.0, 6.0),
        };
        for (x, y, distance) in [
            (2.0, 3.0, 0.0),
            (1.0, 6.0, 0.0),
            (0.0, 3.0, 1.0),
            (6.0, 3.0, 2.0),
            (2.0, 1.5, 0.5),
            (2.0, 9.0, 3.0),
            (7.0, 10.0, 5.0),
            (-2.0, -2.0, 5.0),
        ] {
            assert_eq!(bounds.distance(DVec2::new(x, y)), distance, "({x}, {y})");
            assert_eq!(bounds.contains(DVec2::new(x, y)), distance == 0.0, "({x}, {y})");
        }
    }
}
