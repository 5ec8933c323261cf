//! A quantity over a box of unknowns, bounded by its value in the middle and its slopes.

use super::search::Quantity;
use super::slopes::{MOST_UNKNOWNS, Number};
use crate::geometry::interval::Interval;

/// A quantity over a box, by its value in the middle and its slopes.
pub(super) struct Linear {
    /// In the middle of the box.
    pub at_middle: Interval,
    pub slopes: [Interval; MOST_UNKNOWNS],
    /// Over the box: the better of the quantity's own interval and that from middle and slopes.
    pub value: Interval,
}

impl Linear {
    /// Over a box.
    pub fn over(quantity: Quantity, parameter: Interval, ranges: &[Interval]) -> Self {
        let parameter = Number::fixed(parameter);
        let over = |ranges: &[Interval]| {
            let mut unknowns = [parameter; MOST_UNKNOWNS];
            for (k, range) in ranges.iter().enumerate() {
                unknowns[k] = Number::unknown(k, *range);
            }
            quantity(parameter, &unknowns[..ranges.len()])
        };
        let whole = over(ranges);
        let mut points = [parameter.value; MOST_UNKNOWNS];
        for (point, range) in points.iter_mut().zip(ranges) {
            *point = Interval::point(middle(*range));
        }
        let linear = Self {
            at_middle: over(&points[..ranges.len()]).value,
            slopes: whole.slopes,
            value: whole.value,
        };
        Self {
            value: whole.value.meet(linear.less(None, 0.0, ranges)),
            ..linear
        }
    }

    /// This less `factor` times another, over the box.
    fn less(&self, other: Option<&Self>, factor: f64, ranges: &[Interval]) -> Interval {
        let factor = Interval::point(factor);
        let less = |own: Interval, other: Option<Interval>| other.map_or(own, |other| own - factor * other);
        let mut sum = less(self.at_middle, other.map(|other| other.at_middle));
        for (k, range) in ranges.iter().enumerate() {
            let slope = less(self.slopes[k], other.map(|other| other.slopes[k]));
            sum = sum + slope * (*range - Interval::point(middle(*range)));
        }
        sum
    }

    /// A lower bound over the part of the box where the slacks are not negative, by Lagrange's multipliers: for any factor ≥ 0
    /// the quantity is at least itself less the factor times a slack. The factors tried are those that cancel a slope.
    pub fn least_where(&self, slacks: &[Self], ranges: &[Interval]) -> f64 {
        let mut least = self.value.low;
        for slack in slacks.iter().filter(|slack| slack.value.low < 0.0) {
            for k in 0..ranges.len() {
                let factor = middle(self.slopes[k]) / middle(slack.slopes[k]);
                if factor > 0.0 && factor.is_finite() {
                    least = least.max(self.less(Some(slack), factor, ranges).low);
                }
            }
        }
        least
    }
}

/// The middle of an interval.
pub(super) fn middle(range: Interval) -> f64 {
    0.5 * (range.low + range.high)
}
