//! Numbers that carry bounds of their value and of their derivatives by the unknowns: interval arithmetic with forward
//! differentiation.
//!
//! Over a small box a function is bounded much better by its value in the middle and its slopes than by its own interval,
//! and slopes of one sign show at which end of the box it is least.

use crate::geometry::interval::Interval;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Most unknowns of a problem.
pub const MOST_UNKNOWNS: usize = 5;

const ZERO: Interval = Interval { low: 0.0, high: 0.0 };

/// A bound of a function over a box, with bounds of its slopes there (of its generalised slopes where it has kinks).
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// Of the value.
    pub value: Interval,
    /// Of the derivative by each unknown.
    pub slopes: [Interval; MOST_UNKNOWNS],
}

impl Number {
    /// What depends on no unknown.
    pub fn fixed(value: Interval) -> Self {
        Self {
            value,
            slopes: [ZERO; MOST_UNKNOWNS],
        }
    }

    /// The unknown with this index, over a range.
    pub fn unknown(index: usize, range: Interval) -> Self {
        let mut slopes = [ZERO; MOST_UNKNOWNS];
        slopes[index] = Interval::point(1.0);
        Self { value: range, slopes }
    }

    /// A function of this number, given its value and its derivative there.
    fn chain(self, value: Interval, slope: Interval) -> Self {
        Self {
            value,
            slopes: self.slopes.map(|inner| slope * inner),
        }
    }

    fn with(self, other: Self, value: Interval, join: impl Fn(Interval, Interval) -> Interval) -> Self {
        let mut slopes = self.slopes;
        for (slope, other) in slopes.iter_mut().zip(other.slopes) {
            *slope = join(*slope, other);
        }
        Self { value, slopes }
    }

    /// a².
    pub fn square(self) -> Self {
        self.chain(self.value.square(), Interval::point(2.0) * self.value)
    }

    /// √a of the part of a that has a root.
    pub fn root(self) -> Self {
        let value = Interval::new(self.value.low.max(0.0), self.value.high.max(0.0)).sqrt();
        self.chain(value, Interval::point(0.5) / value)
    }

    /// |a|.
    pub fn abs(self) -> Self {
        let slope = if self.value.low >= 0.0 {
            Interval::point(1.0)
        } else if self.value.high <= 0.0 {
            Interval::point(-1.0)
        } else {
            Interval::new(-1.0, 1.0)
        };
        self.chain(self.value.abs(), slope)
    }

    /// cos a.
    pub fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }

    /// The smaller of two.
    pub fn min(self, other: Self) -> Self {
        if self.value.high < other.value.low {
            self
        } else if other.value.high < self.value.low {
            other
        } else {
            self.with(other, self.value.min(other.value), Interval::hull)
        }
    }

    /// The larger of two.
    pub fn max(self, other: Self) -> Self {
        -(-self).min(-other)
    }
}

impl Add for Number {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.with(other, self.value + other.value, Interval::add)
    }
}

impl Sub for Number {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.with(other, self.value - other.value, Interval::sub)
    }
}

impl Neg for Number {
    type Output = Self;
    fn neg(self) -> Self {
        self.chain(-self.value, Interval::point(-1.0))
    }
}

impl Mul for Number {
    type Output = Self;
    // The product's slope is a sum.
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn mul(self, other: Self) -> Self {
        let (left, right) = (self.value, other.value);
        self.with(other, left * right, |a, b| a * right + b * left)
    }
}

impl Div for Number {
    type Output = Self;
    // The quotient's slope has a difference and a product.
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        self.with(other, quotient, |a, b| (a - quotient * b) / other.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One expression with every operation, and its value and slopes by hand at a point.
    fn all(x: Number, y: Number) -> Number {
        let two = Number::fixed(Interval::point(2.0));
        ((x * y + two).root() - (x / y).cos())
            .max(-x.square())
            .min((y - two * x).abs() + two + two)
    }

    #[test]
    fn values_and_slopes_hold_those_of_difference_quotients() {
        for (x, y) in [(0.3, 0.8), (-0.4, 1.7), (1.1, 0.9)] {
            let around = |value: f64, width: f64| Interval::new(value - width, value + width);
            let over = all(Number::unknown(0, around(x, 1e-3)), Number::unknown(1, around(y, 1e-3)));
            let at = |x: f64, y: f64| {
                let number = all(
                    Number::unknown(0, Interval::point(x)),
                    Number::unknown(1, Interval::point(y)),
                );
                0.5 * (number.value.low + number.value.high)
            };
            let step = 1e-6;
            let slopes = [(at(x + step, y) - at(x - step, y)), (at(x, y + step) - at(x, y - step))];
            assert!(over.value.low <= at(x, y) && at(x, y) <= over.value.high);
            for (slope, bound) in slopes
                .map(|difference| difference / (2.0 * step))
                .iter()
                .zip(over.slopes)
            {
                assert!(
                    bound.low - 1e-6 <= *slope && *slope <= bound.high + 1e-6,
                    "{slope} in {bound:?}"
                );
                assert!(bound.high - bound.low < 0.1);
            }
        }
    }

    #[test]
    fn at_a_kink_slopes_hold_both_sides() {
        let x = Number::unknown(0, Interval::new(-1.0, 2.0));
        let fixed = Number::fixed(Interval::point(0.5));
        let near = |slope: Interval, low: f64, high: f64| (slope.low - low).abs() + (slope.high - high).abs() < 1e-12;
        assert!(near(x.min(fixed).slopes[0], 0.0, 1.0));
        assert!(near(x.abs().slopes[0], -1.0, 1.0));
        // Below 3 throughout, so that the larger of the two does not depend on it.
        assert!(near(x.max(Number::fixed(Interval::point(3.0))).slopes[0], 0.0, 0.0));
    }
}
