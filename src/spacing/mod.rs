//! Control spacing f (§2): positive, finite, α-Lipschitz.

use crate::geometry::{DVec2, Rect};

/// A control spacing function f.
pub trait Spacing: Send + Sync {
    /// f(x): finite and positive on the domain, in the length unit of the domain.
    fn at(&self, x: DVec2) -> f64;

    /// α: |f(x) − f(y)| ≤ α ‖x − y‖ for all x, y, proved for the function as evaluated, never sampled.
    /// Infinite where nothing is proved; gradient limiting makes it finite.
    fn lipschitz(&self) -> f64;

    /// A proved lower bound of f on the closed box: by default what the Lipschitz constant gives from the centre.
    fn lower_bound(&self, cell: Rect) -> f64 {
        self.at(cell.centre()) - self.lipschitz() * 0.5 * cell.diagonal()
    }
}
