//! `expr:EXPRESSION`: f given by a formula in x and y, with the bounds of [`Proved`].

pub(super) mod gradient;
pub(super) mod grammar;
pub(super) mod hessian;
pub(super) mod jet;
mod program;
mod proved;

use crate::spacing::Rect;
use crate::spacing::expression::grammar::GrammarError;
use crate::spacing::expression::jet::Scalar;
use crate::spacing::expression::program::Program;
use crate::spacing::expression::proved::{Formula, Proved};

/// f(x, y) by a formula.
///
/// ```
/// use biting::geometry::{DVec2, Rect};
/// use biting::spacing::{Expression, Spacing};
///
/// let unit_square = Rect { min: DVec2::ZERO, max: DVec2::ONE };
/// let f = Expression::new("0.1 + 0.3*abs(x - 0.5)", unit_square)?;
/// assert_eq!(f.at(DVec2::new(0.5, 0.2)), 0.1);
/// // Proved on the box, never sampled.
/// assert!((f.lipschitz() - 0.3).abs() < 1e-9);
/// # Ok::<(), biting::spacing::GrammarError>(())
/// ```
pub type Expression = Proved<Program>;

impl Formula for Program {
    /// About 20 ms.
    const BUDGET: usize = 10_000;

    fn run<N: Scalar>(&self, x: N, y: N) -> N {
        Program::run(self, x, y)
    }
}

impl Expression {
    /// Compiles `text` and bounds it on the box `bounds`.
    ///
    /// # Errors
    /// [`GrammarError`] with the column.
    pub fn new(text: &str, bounds: Rect) -> Result<Self, GrammarError> {
        Ok(Self::on(grammar::compile(text)?, bounds))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::DVec2;
    use crate::spacing::Spacing;
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
