//! Points, exact predicates, and near-queries.
//!
//! Every sign in the project comes from [`predicates`]; every tolerance from [`tolerance`].

pub mod near;
pub mod predicates;
pub mod segment_grid;
pub mod segments;
pub mod tolerance;

pub use glam::DVec2;

/// Counter-clockwise angle from `u` to `v` in (0, 2π], rounded: for measuring, not for deciding signs.
pub fn turn(u: DVec2, v: DVec2) -> f64 {
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
    /// The box that holds nothing; growing it by a point gives that point.
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

    /// The largest coordinate of its points by magnitude.
    pub fn largest_coordinate(self) -> f64 {
        self.min.abs().max(self.max.abs()).max_element()
    }

    /// Length of the diagonal; the scale tolerances are relative to.
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
