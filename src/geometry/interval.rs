//! Interval arithmetic rounded outwards: the proof behind every bound on an expression.
//!
//! # Guarantee
//! For every operation ∘ and all reals a ∈ A, b ∈ B for which a ∘ b is defined, a ∘ b lies in A ∘ B. If some pair has no
//! value (division by 0, ln of a negative number), the result is [`Interval::WHOLE`], so that nothing is ever proved
//! from an undefined value.
//!
//! # Reference
//! R. E. Moore, "Interval Analysis", 1966.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The elementary functions of the standard library are accurate to about 1 ulp; bounds step out by this larger share.
const LIBRARY_ERROR: f64 = 4.0 * f64::EPSILON;

/// Beyond this, an argument of sin or cos is known too coarsely (in multiples of π) to say where it peaks.
const LARGEST_ANGLE: f64 = 1e6;

/// A closed interval of reals; ends may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// All reals: nothing is known.
    pub const WHOLE: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// The interval from `low` to `high`; [`Interval::WHOLE`] if either is not a number.
    pub fn new(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            Self::WHOLE
        } else {
            Self { low, high }
        }
    }

    /// The single real `value`.
    pub fn point(value: f64) -> Self {
        Self::new(value, value)
    }

    /// The interval stepped out to the next floats, which covers an operation that IEEE 754 rounds correctly.
    fn outward(low: f64, high: f64) -> Self {
        Self::new(low.next_down(), high.next_up())
    }

    /// The interval stepped out by [`LIBRARY_ERROR`].
    fn loosely(low: f64, high: f64) -> Self {
        Self::outward(low - LIBRARY_ERROR * low.abs(), high + LIBRARY_ERROR * high.abs())
    }

    /// Largest absolute value.
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// Whether 0 lies in the interval.
    pub fn has_zero(self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }

    /// The smallest interval around both.
    pub fn hull(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.max(other.high))
    }

    /// The intersection; `self` if rounding left nothing in common.
    pub fn meet(self, other: Self) -> Self {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        if low <= high { Self { low, high } } else { self }
    }

    /// |a|.
    pub fn abs(self) -> Self {
        if self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            -self
        } else {
            Self::new(0.0, self.magnitude())
        }
    }

    /// min(a, b).
    pub fn min(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.min(other.high))
    }

    /// max(a, b).
    pub fn max(self, other: Self) -> Self {
        Self::new(self.low.max(other.low), self.high.max(other.high))
    }

    /// √a.
    pub fn sqrt(self) -> Self {
        if self.low < 0.0 {
            return Self::WHOLE;
        }
        Self::new(self.low.sqrt().next_down().max(0.0), self.high.sqrt().next_up())
    }

    /// e^a.
    pub fn exp(self) -> Self {
        let bounds = Self::loosely(self.low.exp(), self.high.exp());
        Self::new(bounds.low.max(0.0), bounds.high)
    }

    /// ln a.
    pub fn ln(self) -> Self {
        if self.low < 0.0 {
            return Self::WHOLE;
        }
        Self::loosely(self.low.ln(), self.high.ln())
    }

    /// Whether the interval holds offset + 2πk for some whole k, by a count of turns, which up to [`LARGEST_ANGLE`] is off by less
    /// than 1e-9. An extremum of sin missed by that little differs by 1e-18 from the end beside it, which
    /// [`Interval::loosely`] covers.
    fn holds_angle(self, offset: f64) -> bool {
        let turns = |angle: f64| (angle - offset) / TAU;
        turns(self.high).floor() >= turns(self.low).ceil()
    }

    fn wave(self, peak: f64, function: fn(f64) -> f64) -> Self {
        if self.magnitude() > LARGEST_ANGLE {
            return Self::new(-1.0, 1.0);
        }
        let (first, last) = (function(self.low), function(self.high));
        let bounds = Self::loosely(first.min(last), first.max(last));
        Self::new(
            if self.holds_angle(peak + PI) {
                -1.0
            } else {
                bounds.low.max(-1.0)
            },
            if self.holds_angle(peak) {
                1.0
            } else {
                bounds.high.min(1.0)
            },
        )
    }

    /// sin a.
    pub fn sin(self) -> Self {
        self.wave(FRAC_PI_2, f64::sin)
    }

    /// cos a.
    pub fn cos(self) -> Self {
        self.wave(0.0, f64::cos)
    }

    /// tan a.
    pub fn tan(self) -> Self {
        if self.cos().has_zero() {
            return Self::WHOLE;
        }
        Self::loosely(self.low.tan(), self.high.tan())
    }

    /// atan a.
    pub fn atan(self) -> Self {
        Self::loosely(self.low.atan(), self.high.atan())
    }

    /// tanh a.
    pub fn tanh(self) -> Self {
        let bounds = Self::loosely(self.low.tanh(), self.high.tanh());
        Self::new(bounds.low.max(-1.0), bounds.high.min(1.0))
    }

    /// a² with both factors the same, so never negative.
    pub fn square(self) -> Self {
        let size = self.abs();
        let bounds = Self::outward(size.low * size.low, size.high * size.high);
        Self::new(bounds.low.max(0.0), bounds.high)
    }

    /// a^n for a whole n.
    pub fn power_whole(self, n: i32) -> Self {
        match n {
            0 => Self::point(1.0),
            1 => self,
            2 => self.square(),
            n if n < 0 => Self::point(1.0) / self.power_whole(-n),
            n if n % 2 == 0 => self.power_whole(n / 2).square(),
            n => {
                // Odd powers grow with their base.
                let end = |value: f64| Self::point(value) * Self::point(value).power_whole(n - 1);
                Self::new(end(self.low).low, end(self.high).high)
            }
        }
    }

    /// a^p for any fixed p; defined for a ≥ 0 only, as for reals.
    pub fn power(self, p: f64) -> Self {
        if self.low < 0.0 || (p < 0.0 && self.low == 0.0) {
            return Self::WHOLE;
        }
        let (first, last) = (self.low.powf(p), self.high.powf(p));
        let bounds = Self::loosely(first.min(last), first.max(last));
        Self::new(bounds.low.max(0.0), bounds.high)
    }

    /// a^b for a power that varies; defined for a ≥ 0 only, as for reals.
    pub fn power_varying(self, exponent: Self) -> Self {
        if self.low < 0.0 {
            return Self::WHOLE;
        }
        (exponent * self.ln()).exp()
    }

    /// √(a² + b²).
    pub fn hypot(self, other: Self) -> Self {
        (self.square() + other.square()).sqrt()
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = Self::outward(self.low + other.low, self.high + other.high);
        if self.low >= 0.0 && other.low >= 0.0 {
            Self {
                low: sum.low.max(0.0),
                ..sum
            }
        } else {
            sum
        }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::outward(self.low - other.high, self.high - other.low)
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.high, -self.low)
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // 0 · ∞ counts as 0: the infinity bounds reals, none of which is infinite.
        let times = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let products = [
            times(self.low, other.low),
            times(self.low, other.high),
            times(self.high, other.low),
            times(self.high, other.high),
        ];
        let [low, high] = extremes(products);
        let zero = Self { low: 0.0, high: 0.0 };
        let product = Self::outward(low, high);
        if self == zero || other == zero {
            zero
        } else if self.low >= 0.0 && other.low >= 0.0 {
            // Rounding must not make a product of sizes negative: a root may follow.
            Self::new(product.low.max(0.0), product.high)
        } else {
            product
        }
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.has_zero() {
            return Self::WHOLE;
        }
        let quotients = [
            self.low / other.low,
            self.low / other.high,
            self.high / other.low,
            self.high / other.high,
        ];
        if quotients.iter().any(|q| q.is_nan()) {
            return Self::WHOLE;
        }
        let [low, high] = extremes(quotients);
        Self::outward(low, high)
    }
}

/// The least and the largest of four numbers.
fn extremes([a, b, c, d]: [f64; 4]) -> [f64; 2] {
    [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
}

#[cfg(test)]
mod tests;
