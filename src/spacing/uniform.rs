//! `uniform:H`: f = H everywhere.

use crate::geometry::{DVec2, Rect};
use crate::spacing::Spacing;

/// f(x) = H.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform(
    /// H, positive, in the domain's length unit.
    pub f64,
);

impl Spacing for Uniform {
    fn at(&self, _x: DVec2) -> f64 {
        self.0
    }

    fn lipschitz(&self) -> f64 {
        0.0
    }

    fn lower_bound(&self, _cell: Rect) -> f64 {
        self.0
    }

    fn upper_bound(&self, _cell: Rect) -> f64 {
        self.0
    }
}
