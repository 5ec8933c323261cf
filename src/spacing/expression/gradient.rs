//! Forward-mode differentiation over intervals: a box of values together with a box of gradients.
//!
//! # Guarantee
//! Run over a cell, a program of [`Gradient`]s encloses the value and both partial derivatives at each of its points
//! where they exist, and [`Gradient::slope`] bounds ‖∇f‖ there. Where abs, min or max has a kink, the enclosure holds the
//! derivatives of all sides, so `slope` is a Lipschitz constant of f on the (convex) cell. Where f has no bounded
//! derivative, the slope is infinite.

use crate::geometry::interval::Interval;
use crate::spacing::expression::program::{Binary, Number, Unary};

/// Value and gradient, each enclosed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// f.
    pub value: Interval,
    /// ∂f/∂x.
    pub dx: Interval,
    /// ∂f/∂y.
    pub dy: Interval,
    /// An upper bound of ‖∇f‖, often sharper than what the two components give.
    norm: f64,
}

/// a + b, a · b and so on for sizes: rounded upwards.
fn up(size: f64) -> f64 {
    if size == 0.0 { 0.0 } else { size.next_up() }
}

fn scaled(factor: f64, size: f64) -> f64 {
    // 0 · ∞ counts as 0: a constant operand has no slope whatever it is multiplied with.
    if factor == 0.0 || size == 0.0 {
        0.0
    } else {
        up(factor * size)
    }
}

impl Gradient {
    /// The variable x over `range`.
    pub fn x(range: Interval) -> Self {
        Self {
            value: range,
            dx: Interval::point(1.0),
            dy: Interval::point(0.0),
            norm: 1.0,
        }
    }

    /// The variable y over `range`.
    pub fn y(range: Interval) -> Self {
        Self {
            value: range,
            dx: Interval::point(0.0),
            dy: Interval::point(1.0),
            norm: 1.0,
        }
    }

    /// An upper bound of ‖∇f‖.
    pub fn slope(self) -> f64 {
        let components = up(up(up(self.dx.magnitude().powi(2)) + up(self.dy.magnitude().powi(2))).sqrt());
        self.norm.min(components)
    }

    /// The chain rule for g(f) with value g and outer derivative g′.
    fn chain(self, value: Interval, outer: Interval) -> Self {
        let norm = scaled(outer.magnitude(), self.slope());
        Self {
            value,
            dx: outer * self.dx,
            dy: outer * self.dy,
            norm,
        }
    }

    /// The chain rule for g(f, h) with outer derivatives ∂g/∂f and ∂g/∂h.
    fn chain_two(self, other: Self, value: Interval, first: Interval, second: Interval) -> Self {
        Self {
            value,
            dx: first * self.dx + second * other.dx,
            dy: first * self.dy + second * other.dy,
            norm: up(scaled(first.magnitude(), self.slope()) + scaled(second.magnitude(), other.slope())),
        }
    }

    /// Everything either side allows.
    fn either(self, other: Self, value: Interval) -> Self {
        let norm = self.slope().max(other.slope());
        Self {
            value,
            dx: self.dx.hull(other.dx),
            dy: self.dy.hull(other.dy),
            norm,
        }
    }

    fn constant_like(value: Interval) -> Self {
        Self {
            value,
            dx: Interval::point(0.0),
            dy: Interval::point(0.0),
            norm: 0.0,
        }
    }

    /// Somewhere in `value`, with jumps.
    pub fn anywhere(value: Interval) -> Self {
        Self {
            value,
            dx: Interval::WHOLE,
            dy: Interval::WHOLE,
            norm: f64::INFINITY,
        }
    }

    /// √(f² + h²): its gradient is J^T u with a unit vector u, so at most ‖J‖₂ ≤ √(‖J‖₁ ‖J‖_∞) of the Jacobian J.
    fn hypot(self, other: Self) -> Self {
        let value = self.value.hypot(other.value);
        let unit = Interval::new(-1.0, 1.0);
        let share = |part: Interval| {
            if value.low > 0.0 {
                (part / value).meet(unit)
            } else {
                unit
            }
        };
        let joined = self.chain_two(other, value, share(self.value), share(other.value));
        let sum = |a: Interval, b: Interval| match (a.magnitude(), b.magnitude()) {
            (only, 0.0) | (0.0, only) => only,
            (first, second) => up(first + second),
        };
        let columns = sum(self.dx, other.dx).max(sum(self.dy, other.dy));
        let rows = sum(self.dx, self.dy).max(sum(other.dx, other.dy));
        let spectral = if columns == rows {
            columns
        } else {
            up(up(columns * rows).sqrt())
        };
        Self {
            norm: joined.norm.min(spectral),
            ..joined
        }
    }
}

impl Number for Gradient {
    fn constant(value: f64) -> Self {
        Self::constant_like(Interval::point(value))
    }

    fn unary(self, function: Unary) -> Self {
        let f = self.value;
        let value = f.unary(function);
        let one = Interval::point(1.0);
        let outer = match function {
            Unary::Negate => Interval::point(-1.0),
            Unary::Sin => f.cos(),
            Unary::Cos => -f.sin(),
            Unary::Tan => one + value.square(),
            Unary::Atan => one / (one + f.square()),
            Unary::Tanh => (one - value.square()).max(Interval::point(0.0)),
            Unary::Exp => value,
            Unary::Ln => one / f,
            Unary::Sqrt => one / (value + value),
            Unary::Abs if f.low > 0.0 => one,
            Unary::Abs if f.high < 0.0 => -one,
            Unary::Abs => Interval::new(-1.0, 1.0),
        };
        self.chain(value, outer)
    }

    fn binary(self, function: Binary, other: Self) -> Self {
        let (f, h) = (self.value, other.value);
        let one = Interval::point(1.0);
        let value = f.binary(function, h);
        match function {
            Binary::Add => self.chain_two(other, value, one, one),
            Binary::Subtract => self.chain_two(other, value, one, -one),
            Binary::Multiply => self.chain_two(other, value, h, f),
            Binary::Divide => self.chain_two(other, value, one / h, -(f / h.square())),
            Binary::Power => self.chain_two(other, value, h * f.power_varying(h - one), value * f.ln()),
            Binary::Min if f.high < h.low => self,
            Binary::Min if h.high < f.low => other,
            Binary::Max if f.low > h.high => self,
            Binary::Max if h.low > f.high => other,
            Binary::Min | Binary::Max => self.either(other, value),
            Binary::Hypot => self.hypot(other),
        }
    }

    fn power_whole(self, exponent: i32) -> Self {
        if exponent == 0 {
            return Self::constant(1.0);
        }
        let outer = Interval::point(f64::from(exponent)) * self.value.power_whole(exponent - 1);
        self.chain(self.value.power_whole(exponent), outer)
    }

    fn power_fixed(self, exponent: f64) -> Self {
        let outer = Interval::point(exponent) * self.value.power(exponent - 1.0);
        self.chain(self.value.power(exponent), outer)
    }
}

#[cfg(test)]
mod tests;
