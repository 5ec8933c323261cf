//! The least value of a quantity over all configurations that hypotheses allow, proved by interval branch and bound.
//!
//! # Idea
//! A configuration is a point of a box of unknowns. Interval arithmetic bounds the quantity over a whole box from below, and
//! proves that a constraint fails throughout a box; such boxes are dropped, the others halved, the most promising first.
//! Where all constraints hold throughout a box and the quantity has a slope of one sign, only a side of it matters. What is
//! left at the end brackets the least value: no configuration is below [`Optimum::proved`], one is at [`Optimum::found`].
//!
//! # Reference
//! R. E. Moore, "Interval Analysis", 1966; E. Hansen, "Global Optimization Using Interval Analysis", 1992.

use super::linear::{Linear, middle};
use super::slopes::Number;
use crate::geometry::interval::Interval;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A function of the parameter (t, or α) and the unknowns.
pub type Quantity = fn(Number, &[Number]) -> Number;

/// The configurations that some hypotheses allow, and what is asked of them.
#[derive(Clone, Copy)]
pub struct Problem {
    /// What the unknowns are, each with its range for the parameter's value.
    pub unknowns: &'static [Unknown],
    /// Each is at least 0 where the hypotheses hold.
    pub constraints: &'static [Constraint],
    /// The quantity that the statement bounds.
    pub quantity: Quantity,
}

/// One unknown of a configuration.
#[derive(Clone, Copy)]
pub struct Unknown {
    /// What it is.
    pub name: &'static str,
    /// Its least and its largest value.
    pub range: fn(f64) -> (f64, f64),
}

/// One hypothesis.
#[derive(Clone, Copy)]
pub struct Constraint {
    /// In words.
    pub says: &'static str,
    /// At least 0 where it holds.
    pub slack: Quantity,
}

/// Which way a statement bounds its quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// From below: its optimum is the least value.
    AtLeast,
    /// From above: its optimum is the largest value.
    AtMost,
}

impl Sense {
    /// 1 or −1: times it, the optimum of either sense is a least value.
    pub fn sign(self) -> f64 {
        match self {
            Self::AtLeast => 1.0,
            Self::AtMost => -1.0,
        }
    }

    /// Whether a bound is kept by a value, but for a share of the bound.
    pub fn allows(self, bound: f64, value: f64, share: f64) -> bool {
        self.sign() * (value - bound) >= -share * bound.abs().max(1.0)
    }
}

/// An optimum and how far it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    /// No configuration is beyond this.
    pub proved: f64,
    /// A configuration has this value.
    pub found: f64,
    /// The unknowns of that configuration.
    pub at: Vec<f64>,
    /// How many boxes were examined.
    pub boxes: usize,
}

/// How far to go.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Enough when `proved` and `found` are this near to each other.
    pub gap: f64,
    /// Most boxes.
    pub most_boxes: usize,
}

impl Effort {
    /// What suffices for most.
    pub const USUAL: Self = Self {
        gap: 2e-5,
        most_boxes: 30_000,
    };

    /// To be content with less.
    pub const fn within(gap: f64) -> Self {
        Self { gap, ..Self::USUAL }
    }
}

/// A box of unknowns with a bound of the quantity over it; the lowest is the greatest, for a heap.
struct Part {
    least: f64,
    ranges: Vec<Interval>,
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Part {}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Part {
    fn cmp(&self, other: &Self) -> Ordering {
        other.least.total_cmp(&self.least)
    }
}

impl Problem {
    /// The optimum for a value of the parameter; none if no configuration was found.
    pub fn optimum(&self, sense: Sense, parameter: f64, effort: Effort) -> Option<Optimum> {
        let ranges = self.unknowns.iter().map(|unknown| (unknown.range)(parameter));
        Run {
            problem: self,
            sign: sense.sign(),
            parameter: Interval::point(parameter),
            root: ranges.map(|(least, most)| Interval::new(least, most)).collect(),
            best: f64::INFINITY,
            at: Vec::new(),
        }
        .optimum(effort)
    }

    /// All constraints over a box; none if one fails throughout.
    fn slacks(&self, parameter: Interval, ranges: &[Interval]) -> Option<Vec<Linear>> {
        let slacks = self.constraints.iter();
        let slacks = slacks.map(|constraint| Linear::over(constraint.slack, parameter, ranges));
        slacks.map(|slack| (slack.value.high >= 0.0).then_some(slack)).collect()
    }
}

struct Run<'a> {
    problem: &'a Problem,
    sign: f64,
    parameter: Interval,
    root: Vec<Interval>,
    best: f64,
    at: Vec<f64>,
}

impl Run<'_> {
    fn optimum(mut self, effort: Effort) -> Option<Optimum> {
        let mut heap = BinaryHeap::new();
        self.consider(self.root.clone(), &mut heap);
        let mut boxes = 1;
        let mut proved = f64::NEG_INFINITY;
        while let Some(part) = heap.pop() {
            proved = part.least;
            if proved >= self.best - effort.gap || boxes >= effort.most_boxes {
                heap.push(part);
                break;
            }
            for half in halves(&part.ranges) {
                self.consider(half, &mut heap);
                boxes += 1;
            }
            if heap.is_empty() {
                proved = self.best;
            }
        }
        self.best.is_finite().then(|| Optimum {
            proved: self.sign * proved.min(self.best),
            found: self.sign * self.best,
            at: self.at,
            boxes,
        })
    }

    /// Examines a box: its middle may be a better configuration, and it is kept if better ones may be in it.
    fn consider(&mut self, mut ranges: Vec<Interval>, heap: &mut BinaryHeap<Part>) {
        let Some(slacks) = self.problem.slacks(self.parameter, &ranges) else {
            return;
        };
        let mut over = self.over(&ranges);
        if slacks.iter().all(|slack| slack.value.low >= 0.0) && shrink(&mut ranges, &over) {
            over = self.over(&ranges);
        }
        let least = over.least_where(&slacks, &ranges);
        if least >= self.best {
            return;
        }
        let mut better = self.try_point(ranges.iter().copied().map(middle).collect());
        // An unknown whose slope is known may be best at the end that constraints allow.
        let downhill = |(range, slope): (&Interval, &Interval)| match middle(*slope) {
            slope if slope > 0.0 => range.low,
            slope if slope < 0.0 => range.high,
            _ => middle(*range),
        };
        better |= self.try_point(ranges.iter().zip(&over.slopes).map(downhill).collect());
        if better {
            self.polish();
        }
        heap.push(Part { least, ranges });
    }

    /// Takes a configuration if it is better than the best so far.
    fn try_point(&mut self, unknowns: Vec<f64>) -> bool {
        let point: Vec<Interval> = unknowns.iter().copied().map(Interval::point).collect();
        let value = middle(self.over(&point).value);
        let better = value < self.best && value.is_finite() && self.problem.slacks(self.parameter, &point).is_some();
        if better {
            self.best = value;
            self.at = unknowns;
        }
        better
    }

    /// Goes on from the best configuration, one unknown at a time by shorter and shorter steps, while that helps.
    fn polish(&mut self) {
        let mut share = 0.25;
        while share > 1e-9 {
            let mut better = false;
            for k in 0..self.root.len() {
                let range = self.root[k];
                let step = share * (range.high - range.low);
                for moved in [self.at[k] + step, self.at[k] - step] {
                    let mut unknowns = self.at.clone();
                    unknowns[k] = moved.clamp(range.low, range.high);
                    better |= self.try_point(unknowns);
                }
            }
            if !better {
                share *= 0.5;
            }
        }
    }

    fn over(&self, ranges: &[Interval]) -> Linear {
        let over = Linear::over(self.problem.quantity, self.parameter, ranges);
        if self.sign > 0.0 {
            return over;
        }
        Linear {
            at_middle: -over.at_middle,
            slopes: over.slopes.map(|slope| -slope),
            value: -over.value,
        }
    }
}

/// Puts unknowns in which the quantity only grows, or only falls, at the end where it is least; whether there were any.
fn shrink(ranges: &mut [Interval], over: &Linear) -> bool {
    let mut shrunk = false;
    for (range, slope) in ranges.iter_mut().zip(over.slopes) {
        let end = if slope.low >= 0.0 {
            range.low
        } else if slope.high <= 0.0 {
            range.high
        } else {
            continue;
        };
        shrunk |= range.low < range.high;
        *range = Interval::point(end);
    }
    shrunk
}

/// A box cut in two across its widest unknown.
fn halves(ranges: &[Interval]) -> [Vec<Interval>; 2] {
    let width = |range: &Interval| range.high - range.low;
    let widest = (0..ranges.len())
        .max_by(|&a, &b| width(&ranges[a]).total_cmp(&width(&ranges[b])))
        .unwrap_or(0);
    let [mut lower, mut upper] = [ranges.to_vec(), ranges.to_vec()];
    if let Some(range) = ranges.get(widest) {
        let middle = middle(*range);
        lower[widest] = Interval::new(range.low, middle);
        upper[widest] = Interval::new(middle, range.high);
    }
    [lower, upper]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x² + y² on [−1, 2]² where x + y ≥ 1: 1/2 at the middle of the line, 8 at the far corner.
    const CIRCLE: Problem = Problem {
        unknowns: &[
            Unknown {
                name: "x",
                range: |_| (-1.0, 2.0),
            },
            Unknown {
                name: "y",
                range: |_| (-1.0, 2.0),
            },
        ],
        constraints: &[Constraint {
            says: "x + y ≥ p",
            slack: |p, v| v[0] + v[1] - p,
        }],
        quantity: |_, v| v[0].square() + v[1].square(),
    };

    #[test]
    fn least_and_largest_are_bracketed() {
        let effort = Effort {
            gap: 1e-4,
            most_boxes: 400_000,
        };
        let least = CIRCLE.optimum(Sense::AtLeast, 1.0, effort).expect("a configuration");
        assert!(least.proved <= 0.5 && least.found >= 0.5 - 1e-12, "{least:?}");
        assert!(least.found - least.proved <= 1e-4, "{least:?}");
        let largest = CIRCLE.optimum(Sense::AtMost, 1.0, effort).expect("a configuration");
        assert_eq!((largest.found, largest.at), (8.0, vec![2.0, 2.0]));
        assert!(largest.proved >= 8.0 && largest.proved < 8.0 + 1e-4);
    }

    #[test]
    fn nothing_is_found_where_nothing_is_allowed() {
        assert_eq!(CIRCLE.optimum(Sense::AtLeast, 5.0, Effort::USUAL), None);
    }

    #[test]
    fn little_effort_still_brackets() {
        let few = Effort {
            gap: 1e-12,
            most_boxes: 9,
        };
        let least = CIRCLE.optimum(Sense::AtLeast, 1.0, few).expect("a configuration");
        assert!(least.proved <= 0.5 && least.found >= 0.5 && least.boxes <= 11);
    }
}
