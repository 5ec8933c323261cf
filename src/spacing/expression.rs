//! `expr:EXPRESSION`: f given by a formula in x and y.
//!
//! # Guarantee
//! * [`Spacing::lipschitz`] is a proved upper bound of ‖∇f‖ over the domain's bounding box, found by best-first
//!   subdivision with interval gradients, within 1 % of the supremum where that is reached within the budget; infinite
//!   where no bound was found. The box is convex, so the bound is a Lipschitz constant there.
//! * [`Spacing::lower_bound`] and [`Spacing::upper_bound`] are interval enclosures: the better of the natural extension
//!   and the mean-value form f(c) + ∇f(cell) · (cell − c).
//!
//! # Reference
//! A. Neumaier, "Interval Methods for Systems of Equations", 1990: both forms and their convergence.

use super::gradient::Gradient;
use super::grammar::{self, GrammarError};
use super::program::Program;
use super::{Rect, Spacing};
use crate::geometry::DVec2;
use crate::geometry::interval::Interval;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Cells a bound may cost: some 20 ms.
const BUDGET: usize = 10_000;

/// A bound this close above a value that is taken, relatively, is good enough.
const GAP: f64 = 0.01;

/// f(x, y) by a formula.
#[derive(Clone, Debug)]
pub struct Expression {
    program: Program,
    bounds: Rect,
    lipschitz: f64,
    range: Interval,
}

impl Expression {
    /// Compiles `text` and bounds it on the box `bounds`.
    ///
    /// # Errors
    /// [`GrammarError`] with the column.
    pub fn new(text: &str, bounds: Rect) -> Result<Self, GrammarError> {
        let program = grammar::compile(text)?;
        let mut expression = Self {
            program,
            bounds,
            lipschitz: f64::INFINITY,
            range: Interval::WHOLE,
        };
        let point = |x: DVec2| Rect { min: x, max: x };
        let slope = |cell| expression.gradient(cell).slope();
        let lipschitz = supremum(bounds, slope, |x| slope(point(x)));
        let high = supremum(bounds, |cell| expression.enclosure(cell).high, |x| expression.at(x));
        let low = -supremum(bounds, |cell| -expression.enclosure(cell).low, |x| -expression.at(x));
        expression.lipschitz = lipschitz;
        expression.range = Interval::new(low, high);
        Ok(expression)
    }

    fn gradient(&self, cell: Rect) -> Gradient {
        let side = |axis: usize| Interval::new(cell.min[axis], cell.max[axis]);
        self.program.run(Gradient::x(side(0)), Gradient::y(side(1)))
    }

    fn enclosure(&self, cell: Rect) -> Interval {
        let centre = cell.centre();
        let gradient = self.gradient(cell);
        let middle: Interval = self.program.run(Interval::point(centre.x), Interval::point(centre.y));
        let offset = |axis: usize| Interval::new(cell.min[axis], cell.max[axis]) - Interval::point(centre[axis]);
        let mean_value = middle + gradient.dx * offset(0) + gradient.dy * offset(1);
        gradient.value.meet(mean_value)
    }
}

impl Spacing for Expression {
    fn at(&self, x: DVec2) -> f64 {
        self.program.run(x.x, x.y)
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
fn supremum(root: Rect, bound: impl Fn(Rect) -> f64, value: impl Fn(DVec2) -> f64) -> f64 {
    let mut reached = f64::NEG_INFINITY;
    let mut heap = BinaryHeap::from([Waiting {
        bound: bound(root),
        age: 0,
        cell: root,
    }]);
    let mut age = 0;
    while let Some(top) = heap.pop() {
        reached = reached.max(value(top.cell.centre()));
        if top.bound - reached <= GAP * reached.abs() || age >= BUDGET {
            return top.bound;
        }
        for cell in top.cell.quarters() {
            age += 1;
            // A part is never bounded worse than the whole.
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
    use exmex::{Differentiate, Express, FlatEx};
    use proptest::prelude::*;

    const BOX: Rect = Rect {
        min: DVec2::ZERO,
        max: DVec2::ONE,
    };

    /// Formulas that exmex reads as we do, so that its values and symbolic derivatives are an oracle.
    const SMOOTH: [&str; 8] = [
        "0.004*(1+0.5*sin(20*x)*sin(20*y))",
        "0.1+x*x*y-y/(2+x)",
        "exp(0-3*(x-0.5)^2)+cos(y*7)",
        "sqrt(0.01+(x-0.3)^2+(y-0.2)^2)",
        "ln(1.5+x)*tan(0.5*y)",
        "(x+2)^(y+0.5)",
        "tanh(3*x-y)+atan(4*y)",
        "x^3/(1+y^4)+2^x",
    ];

    fn gradient_by_exmex(text: &str, at: DVec2) -> (f64, DVec2) {
        let f = FlatEx::<f64>::parse(text).unwrap();
        let part = |index: usize| f.clone().partial(index).unwrap().eval(&[at.x, at.y]).unwrap();
        (f.eval(&[at.x, at.y]).unwrap(), DVec2::new(part(0), part(1)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn values_and_gradients_are_those_of_exmex(index in 0..SMOOTH.len(), x in 0.0f64..1.0, y in 0.0f64..1.0) {
            let f = Expression::new(SMOOTH[index], BOX).unwrap();
            let at = DVec2::new(x, y);
            let (value, gradient) = gradient_by_exmex(SMOOTH[index], at);
            prop_assert!((f.at(at) - value).abs() <= 1e-14 * (1.0 + value.abs()));
            let found = f.gradient(Rect { min: at, max: at });
            for (component, expected) in [(found.dx, gradient.x), (found.dy, gradient.y)] {
                prop_assert!(component.high - component.low <= 1e-11 * (1.0 + expected.abs()));
                prop_assert!(component.low - 1e-12 <= expected && expected <= component.high + 1e-12);
            }
            prop_assert!(gradient.length() <= f.lipschitz() * (1.0 + 1e-12));
            prop_assert!(found.slope() <= gradient.length() * (1.0 + 1e-9) + 1e-9);
        }

        #[test]
        fn a_cell_encloses_its_values(
            index in 0..SMOOTH.len() + 3, x in 0.0f64..0.9, y in 0.0f64..0.9, size in 0.0f64..0.1,
            u in 0.0f64..1.0, v in 0.0f64..1.0,
        ) {
            let kinked = ["abs(x-0.4)+min(x,y,0.3)", "max(x*y,0.2-x)", "hypot(x-0.5,y-0.5)"];
            let text = SMOOTH.iter().chain(&kinked).nth(index).unwrap();
            let f = Expression::new(text, BOX).unwrap();
            let cell = Rect { min: DVec2::new(x, y), max: DVec2::new(x + size, y + size) };
            let value = f.at(cell.min + DVec2::new(u, v) * cell.size());
            prop_assert!(f.lower_bound(cell) <= value && value <= f.upper_bound(cell));
            let slope = f.gradient(cell).slope();
            let other = f.at(cell.min + DVec2::new(v, u) * cell.size());
            let apart = (DVec2::new(u, v) * size).distance(DVec2::new(v, u) * size);
            prop_assert!((value - other).abs() <= slope * apart + 1e-15);
        }
    }

    #[test]
    fn lipschitz_constants_are_proved_and_close() {
        for (text, expected) in [
            ("0.3", 0.0),
            ("0.1+0.5*x", 0.5),
            ("0.1+0.3*x-0.4*y", 0.5),
            ("0.004*(1+0.5*sin(20*x)*sin(20*y))", 0.04),
            ("0.002+0.2*sqrt(x^2+y^2)", 0.2),
            ("0.01+0.1*abs(x-0.5)", 0.1),
            ("min(0.1+x, 0.5)", 1.0),
            ("(1+x)^2", 4.0),
        ] {
            let found = Expression::new(text, BOX).unwrap().lipschitz();
            assert!(
                expected <= found && found <= 1.011 * expected,
                "{text}: {found}, expected {expected}"
            );
        }
        assert_eq!(Expression::new("0.1+sqrt(x)", BOX).unwrap().lipschitz(), f64::INFINITY);
        assert_eq!(Expression::new("1/(x-0.5)^2", BOX).unwrap().lipschitz(), f64::INFINITY);
    }

    /// Within 1 % of the supremum where cells tell, the budget where they never do.
    #[test]
    fn a_supremum_is_bounded_from_above_and_closely() {
        let cells = std::cell::Cell::new(0);
        let counted = |bound: f64| {
            cells.set(cells.get() + 1);
            bound
        };
        // The largest value of x + y over a cell is that at its upper right corner; at the centre it is smaller.
        let corner = |cell: Rect| counted(cell.max.x + cell.max.y);
        let found = supremum(BOX, corner, |x| x.x + x.y);
        assert!((2.0..=2.0 * 1.011).contains(&found) && cells.take() < 100, "{found}");
        let below = supremum(BOX, |cell| counted(cell.max.x - 5.0), |x| x.x - 5.0);
        assert!((-4.0..=-4.0 * 0.989).contains(&below) && cells.take() < 100, "{below}");
        // A bound that is far off everywhere stays what it is, and costs no more than the budget.
        assert_eq!(supremum(BOX, |_| counted(3.0), |_| 1.0), 3.0);
        let cost = cells.take();
        assert!((BUDGET..BUDGET + 10).contains(&cost), "{cost}");
        // Parts bounded worse than the whole are not believed.
        let worse = |cell: Rect| counted(2.0 / cell.size().x);
        assert_eq!(supremum(BOX, worse, |_| 1.0), 2.0);
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

    #[test]
    fn bounds_on_the_box_itself_are_the_close_ones() {
        // Over the whole box the mean-value form gives 0.75 ± 1, refined it is the range [½, 1].
        let f = Expression::new("0.5+0.5*sin(PI*x)*sin(PI*y)", BOX).unwrap();
        let (low, high) = (f.lower_bound(BOX), f.upper_bound(BOX));
        assert!(
            (0.49..=0.5).contains(&low) && (1.0..1.011).contains(&high),
            "{low} {high}"
        );
        // A small cell away from the origin is bounded by the mean-value form: 1 + 2 (x − y) with x, y about 0.5.
        let f = Expression::new("(1+x-y)^2", BOX).unwrap();
        let (size, at) = (1e-4, 0.5);
        let cell = Rect {
            min: DVec2::splat(at - size),
            max: DVec2::splat(at + size),
        };
        let (low, high) = (f.lower_bound(cell), f.upper_bound(cell));
        assert!((1.0 - 4.01 * size..=1.0 - 3.99 * size).contains(&low), "{low}");
        assert!((1.0 + 3.99 * size..=1.0 + 4.01 * size).contains(&high), "{high}");
        // Where a variable appears twice, that is closer than the natural extension, x − x² being flat at ½.
        let f = Expression::new("1+x-x*x", BOX).unwrap();
        let cell = Rect {
            min: DVec2::new(0.49, 0.0),
            max: DVec2::new(0.51, 1.0),
        };
        assert!(
            f.upper_bound(cell) < 1.2503 && f.lower_bound(cell) > 1.2497,
            "{}",
            f.upper_bound(cell)
        );
    }

    /// Found by fuzzing: at whole y a power of a negative number has a value, which the bounds took for positive.
    #[test]
    fn powers_of_negative_numbers_prove_nothing() {
        let f = Expression::new("tan(11)^-y+96", BOX).unwrap();
        assert!(f.lower_bound(BOX) <= f.at(DVec2::ONE) && f.at(DVec2::ONE) < 96.0);
        assert_eq!(f.lipschitz(), f64::INFINITY);
    }

    #[test]
    fn signs_and_powers_follow_mathematics() {
        let at = |text: &str| Expression::new(text, BOX).unwrap().at(DVec2::new(0.5, 0.25));
        assert_eq!(at("-x^2"), -0.25);
        assert_eq!(at("2^3^2"), 512.0);
        assert_eq!(at("2^-1"), 0.5);
        assert_eq!(at("8-4-2"), 2.0);
        assert_eq!(at("8/4/2"), 1.0);
        assert_eq!(at("2*-x"), -1.0);
        assert_eq!(at("1.5e-3*2E3"), 3.0);
        assert_eq!(at("min(max(x, y), max(x, 2))"), 0.5);
        assert_eq!(at("pow(x, 2)+hypot(3*x, 4*x)"), 2.75);
        assert_eq!(at("cos(2*PI)+ln(E)"), 2.0);
    }

    #[test]
    fn errors_say_the_column() {
        let error = |text: &str| grammar::compile(text).unwrap_err().to_string();
        assert_eq!(
            error("1+*2"),
            "column 3: a number, x, y or a function expected, found `*`"
        );
        assert_eq!(error("2x"), "column 2: an operator is missing before `x`");
        assert_eq!(
            error("(1+x"),
            "column 5: `)` expected to close the parenthesis, found the end"
        );
        assert_eq!(error("1+x)"), "column 4: `)` without `(`");
        assert_eq!(error("sin x"), "column 5: `(` expected after sin, found `x`");
        assert_eq!(error("1 + 3 # 4"), "column 7: `#` has no meaning here");
        assert_eq!(
            error("hypot(x)"),
            "column 8: `,` expected between the arguments of hypot, found `)`"
        );
        assert_eq!(
            error(""),
            "column 1: a number, x, y or a function expected, found the end"
        );
        assert!(error("é+1").starts_with("column 1: `é` is unknown; there are x, y, PI, E, sin"));
        assert!(error(&"(".repeat(1000)).ends_with("nested too deeply"));
        assert!(error(&format!("{}x{}", "x+(".repeat(40), ")".repeat(40))).ends_with("nested too deeply"));
    }
}
