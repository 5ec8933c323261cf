//! The graded spacing of several benches.

use biting::geometry::DVec2;
use biting::spacing::Spacing;

/// f = scale (1 + ½ sin 20x sin 20y); |∇f| ≤ 10 scale.
pub struct Waves {
    /// The mean of f.
    pub scale: f64,
}

impl Spacing for Waves {
    fn at(&self, x: DVec2) -> f64 {
        self.scale * (1.0 + 0.5 * (20.0 * x.x).sin() * (20.0 * x.y).sin())
    }

    fn lipschitz(&self) -> f64 {
        10.0 * self.scale
    }
}
