//! `hessian:EXPRESSION;eps=E`: the numerical spacing nsf of §2.2 for a known u.
//!
//! # Idea
//! > f(x) = √(C eps / |λ|max(H(x))), C = 6, not below `min` and not above `max`,
//!
//! H being the Hessian of u at x, by automatic differentiation of second order (`jet.rs`).
//!
//! # The constant
//! Let M bound |vᵀ H v| for all unit vectors v, let T be a triangle with corners vᵢ, Πu the linear function that equals u
//! there, and x in T with barycentric coordinates bᵢ. Taylor's formula at x, for a quadratic u exact, reads
//! u(vᵢ) = u(x) + ∇u · (vᵢ − x) + ½ qᵢ with |qᵢ| ≤ M ‖vᵢ − x‖². Weighted by bᵢ the linear terms cancel:
//!
//! > |Πu(x) − u(x)| ≤ ½ M Σ bᵢ ‖vᵢ − x‖² = ½ M (R² − ‖x − c‖²)
//!
//! with circumcentre c and circumradius R, since Σ bᵢ ‖vᵢ − c‖² = R² is also Σ bᵢ ‖vᵢ − x‖² + ‖x − c‖². Its largest value over
//! T is ½ M ρ², ρ the radius of the smallest circle around T: R, or half the longest edge of an obtuse triangle. By
//! Jung's theorem ρ ≤ h / √3 for a longest edge h, so the error is at most M h² / 6. This is sharp: u = ½ M ‖x‖² on an
//! equilateral triangle attains it. (On an edge alone it would be M h² / 8.)
//!
//! C belongs to the longest edge h, and not to R, which would give C = 2, because f is the length that the mesh's edges are asked
//! to have: a mesh of equilateral triangles with edges f has the error eps, no more and no less. A mesher's edges are about
//! c_b f long. What biting guarantees: the circumcentre of a triangle without the boundary nearby lies in a biting circle, so
//! R ≤ c_b f / (1 − t) and the error is at most 3 (c_b / (1 − t))² eps, as far as H is constant there; at the defaults of t and
//! c_b that is 3 eps.
//!
//! # Bounds
//! Where H vanishes f = `max`; where H is infinite, as at the singularity of a corner, f = `min`. By default `max` is the
//! longer side of the domain's box, since larger spacings mean the same, and `min` is [`SMALLEST`] of it.
//! Kinks of abs, min and max in u count by their sides alone. If u itself has no finite value somewhere, there is no spacing.
//!
//! # Guarantee
//! As in `proved.rs`: cells enclose f, and the Lipschitz constant is proved if one of reasonable size was found,
//! and infinite otherwise; gradient limiting makes it finite.
//!
//! # Reference
//! S. Waldron, "The error in linear interpolation at the vertices of a simplex", SIAM J. Numer. Anal. 35, 1998, for the sharp
//! bound; §2.2 and [29] of the paper for the use of the largest eigenvalue.

use crate::spacing::Rect;
use crate::spacing::expression::grammar::{self, GrammarError};
use crate::spacing::expression::jet::{Jet, Scalar, largest_eigenvalue};
use crate::spacing::expression::program::{Binary, Program, Unary};
use crate::spacing::expression::proved::{Formula, Proved};

/// C: the square of a longest edge times |λ|max, over the error of linear interpolation, at its smallest.
pub const INTERPOLATION: f64 = 6.0;

/// `min` as a share of the longer side of the domain's box, if none is given: there would be 10⁸ triangles if f were so small
/// everywhere, and 30 000 if along a line across.
pub const SMALLEST: f64 = 1e-4;

/// What turns |λ|max into a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// The error of interpolation that is allowed, in the unit of u; positive.
    pub eps: f64,
    /// f is nowhere smaller, in the domain's unit of length; by default 1e-4 of the longer side of its box.
    pub min: Option<f64>,
    /// f is nowhere larger; by default the longer side of the domain's box, or `min` if that is larger.
    pub max: Option<f64>,
}

impl Tolerance {
    /// The bounds of f on a domain with that box.
    pub fn range(&self, bounds: Rect) -> [f64; 2] {
        let longer = bounds.size().max_element();
        let smallest = |largest: f64| (SMALLEST * longer).min(largest);
        match (self.min, self.max) {
            (Some(min), max) => [min, max.unwrap_or(longer).max(min)],
            (None, max) => {
                let max = max.unwrap_or(longer);
                [smallest(max), max]
            }
        }
    }

    /// f for a given |λ|max on a domain with that box; infinite and undefined ones count as too large.
    pub fn length(&self, eigenvalue: f64, bounds: Rect) -> f64 {
        Numerical::length(self.eps, self.range(bounds), eigenvalue)
    }
}

/// nsf of a formula u.
pub type Hessian = Proved<Numerical>;

impl Hessian {
    /// Compiles u and bounds its spacing on the box `bounds` of a domain.
    ///
    /// # Errors
    /// [`GrammarError`] with the column.
    pub fn new(text: &str, tolerance: &Tolerance, bounds: Rect) -> Result<Self, GrammarError> {
        let solution = grammar::compile(text)?;
        let (eps, range) = (tolerance.eps, tolerance.range(bounds));
        Ok(Self::on(Numerical { solution, eps, range }, bounds))
    }
}

/// √(C eps / |λ|max(H)) within a range, for the Hessian H of `solution`.
#[derive(Clone, Debug)]
pub struct Numerical {
    solution: Program,
    eps: f64,
    range: [f64; 2],
}

impl Numerical {
    fn length<N: Scalar>(eps: f64, [min, max]: [f64; 2], eigenvalue: N) -> N {
        let for_length = |length: f64| N::constant(INTERPOLATION * eps / (length * length));
        // In this order, what is not a number counts as large.
        let most = eigenvalue.binary(Binary::Min, for_length(min));
        let within = most.binary(Binary::Max, for_length(max));
        let square = N::constant(INTERPOLATION * eps).binary(Binary::Divide, within);
        square.unary(Unary::Sqrt)
    }
}

impl Formula for Numerical {
    /// A cell costs ten times as much as that of an expression.
    const BUDGET: usize = 1_000;

    /// Ten times the limit of other formulas: where H changes sign or is singular, f is steep in few places, and cells bound
    /// it better.
    const STEEPEST: f64 = 10.0;

    fn run<N: Scalar>(&self, x: N, y: N) -> N {
        let u = self.solution.run(Jet::x(x), Jet::y(y));
        if u.value.range().magnitude().is_finite() {
            Self::length(self.eps, self.range, largest_eigenvalue(u.bend))
        } else {
            N::unknown()
        }
    }
}

#[cfg(test)]
mod tests;
