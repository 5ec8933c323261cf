//! A formula with proved bounds: what [`crate::spacing::Expression`] and [`crate::spacing::Hessian`] have in common.
//!
//! # Guarantee
//! * [`Spacing::lipschitz`] is a proved upper bound of ‖∇f‖ over the domain's bounding box, found by best-first
//!   subdivision with interval gradients, within 1 % of the supremum if the budget is enough for that; infinite
//!   if no bound was found. The box is convex, so the bound is a Lipschitz constant there.
//! * [`Spacing::lower_bound`] and [`Spacing::upper_bound`] are interval enclosures: the better of the natural extension
//!   and the mean-value form f(c) + ∇f(cell) · (cell − c).
//!
//! # Reference
//! A. Neumaier, "Interval Methods for Systems of Equations", 1990: both forms and their convergence.

use crate::geometry::DVec2;
use crate::geometry::interval::Interval;
use crate::spacing::expression::gradient::Gradient;
use crate::spacing::expression::jet::Scalar;
use crate::spacing::{Rect, Spacing};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A bound is good enough if it is above a value of the function by no more than this share.
const GAP: f64 = 0.01;

/// f(x, y), computed in the same way with floats, intervals and interval gradients.
pub trait Formula: Send + Sync {
    /// Cells that each bound on the whole box may cost.
    const BUDGET: usize;

    /// A Lipschitz constant beyond this counts as none: code that walks in steps of f over the constant, as integration does, takes
    /// the longer the worse the bound is, and copes with none at all.
    const STEEPEST: f64 = f64::INFINITY;

    /// The value at (x, y).
    fn run<N: Scalar>(&self, x: N, y: N) -> N;
}

/// A formula as a spacing.
#[derive(Clone, Debug)]
pub struct Proved<F> {
    formula: F,
    bounds: Rect,
    lipschitz: f64,
    range: Interval,
}

impl<F: Formula> Proved<F> {
    /// Bounds `formula` on the box `bounds`.
    pub fn on(formula: F, bounds: Rect) -> Self {
        let mut proved = Self {
            formula,
            bounds,
            lipschitz: f64::INFINITY,
            range: Interval::WHOLE,
        };
        let point = |x: DVec2| Rect { min: x, max: x };
        let slope = |cell| proved.gradient(cell).slope();
        let lipschitz = supremum(F::BUDGET, bounds, slope, |x| slope(point(x)));
        let high = supremum(F::BUDGET, bounds, |cell| proved.enclosure(cell).high, |x| proved.at(x));
        let low = -supremum(F::BUDGET, bounds, |cell| -proved.enclosure(cell).low, |x| -proved.at(x));
        proved.lipschitz = if lipschitz > F::STEEPEST {
            f64::INFINITY
        } else {
            lipschitz
        };
        proved.range = Interval::new(low, high);
        proved
    }

    /// Value and gradient, enclosed on a cell.
    pub(super) fn gradient(&self, cell: Rect) -> Gradient {
        let side = |axis: usize| Interval::new(cell.min[axis], cell.max[axis]);
        self.formula.run(Gradient::x(side(0)), Gradient::y(side(1)))
    }

    fn enclosure(&self, cell: Rect) -> Interval {
        let centre = cell.centre();
        let gradient = self.gradient(cell);
        let middle: Interval = self.formula.run(Interval::point(centre.x), Interval::point(centre.y));
        let offset = |axis: usize| Interval::new(cell.min[axis], cell.max[axis]) - Interval::point(centre[axis]);
        let mean_value = middle + gradient.dx * offset(0) + gradient.dy * offset(1);
        gradient.value.meet(mean_value)
    }
}

impl<F: Formula> Spacing for Proved<F> {
    fn at(&self, x: DVec2) -> f64 {
        self.formula.run(x.x, x.y)
    }

    fn lipschitz(&self) -> f64 {
        self.lipschitz
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        if cell == self.bounds {
            self.range.low
        } else {
            self.enclosure(cell).low
        }
    }

    fn upper_bound(&self, cell: Rect) -> f64 {
        if cell == self.bounds {
            self.range.high
        } else {
            self.enclosure(cell).high
        }
    }
}

/// A cell waiting to be split, ordered by the bound on it, then by age so that the order is always the same.
struct Waiting {
    bound: f64,
    age: usize,
    cell: Rect,
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound).then(other.age.cmp(&self.age))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

/// An upper bound of a function on `root`, by best-first subdivision: `bound` bounds it on a cell, `value` is its value
/// or a lower bound of its supremum at a point.
fn supremum(budget: usize, root: Rect, bound: impl Fn(Rect) -> f64, value: impl Fn(DVec2) -> f64) -> f64 {
    let mut reached = f64::NEG_INFINITY;
    let mut heap = BinaryHeap::from([Waiting {
        bound: bound(root),
        age: 0,
        cell: root,
    }]);
    let mut age = 0;
    while let Some(top) = heap.pop() {
        reached = reached.max(value(top.cell.centre()));
        if top.bound - reached <= GAP * reached.abs() || age >= budget {
            return top.bound;
        }
        for cell in top.cell.quarters() {
            age += 1;
            // The bound of a part is never worse than that of the whole.
            heap.push(Waiting {
                bound: bound(cell).min(top.bound),
                age,
                cell,
            });
        }
    }
    f64::INFINITY
}

#[cfg(test)]
mod tests {
    use super::*;

    const BUDGET: usize = 10_000;

    const BOX: Rect = Rect {
        min: DVec2::ZERO,
        max: DVec2::ONE,
    };

    /// Within 1 % of the supremum if cells are informative; the whole budget if they never are.
    #[test]
    fn a_supremum_is_bounded_from_above_and_closely() {
        let cells = std::cell::Cell::new(0);
        let counted = |bound: f64| {
            cells.set(cells.get() + 1);
            bound
        };
        // The largest value of x + y over a cell is that at its upper right corner; at the centre it is smaller.
        let corner = |cell: Rect| counted(cell.max.x + cell.max.y);
        let found = supremum(BUDGET, BOX, corner, |x| x.x + x.y);
        assert!((2.0..=2.0 * 1.011).contains(&found) && cells.take() < 100, "{found}");
        let below = supremum(BUDGET, BOX, |cell| counted(cell.max.x - 5.0), |x| x.x - 5.0);
        assert!((-4.0..=-4.0 * 0.989).contains(&below) && cells.take() < 100, "{below}");
        // A bound that is far off everywhere stays what it is, and costs no more than the budget.
        assert_eq!(supremum(BUDGET, BOX, |_| counted(3.0), |_| 1.0), 3.0);
        let cost = cells.take();
        assert!((BUDGET..BUDGET + 10).contains(&cost), "{cost}");
        // Parts bounded worse than the whole are not believed.
        let worse = |cell: Rect| counted(2.0 / cell.size().x);
        assert_eq!(supremum(BUDGET, BOX, worse, |_| 1.0), 2.0);
    }

    #[test]
    fn cells_wait_by_bound_and_then_by_age() {
        let cell = |bound: f64, age: usize| Waiting { bound, age, cell: BOX };
        let mut heap = BinaryHeap::from([cell(1.0, 3), cell(2.0, 2), cell(2.0, 1), cell(0.5, 0)]);
        let order: Vec<_> = std::iter::from_fn(|| heap.pop())
            .map(|top| (top.bound, top.age))
            .collect();
        assert_eq!(order, [(2.0, 1), (2.0, 2), (1.0, 3), (0.5, 0)]);
        assert!(cell(1.0, 3) == cell(1.0, 3) && cell(1.0, 3) != cell(1.0, 4) && cell(1.0, 3) < cell(1.5, 3));
    }
}
