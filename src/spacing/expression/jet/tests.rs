//! Hessians by hand, by exmex, and enclosed.

use crate::spacing::expression::grammar::compile;
use crate::spacing::expression::jet::*;
use exmex::{Differentiate, Express, FlatEx};
use proptest::prelude::*;

fn at(text: &str, x: f64, y: f64) -> Jet<f64> {
    compile(text).unwrap().run(Jet::x(x), Jet::y(y))
}

fn over(text: &str, x: [f64; 2], y: [f64; 2]) -> Jet<Interval> {
    let side = |[low, high]: [f64; 2]| Interval::new(low, high);
    compile(text).unwrap().run(Jet::x(side(x)), Jet::y(side(y)))
}

#[test]
fn hessians_are_those_found_by_hand() {
    let r2 = "(x^2+y^2)";
    let cases: [(String, [f64; 3]); 8] = [
        ("3*x^2-2*x*y+5*y^2+7*x-1".into(), [6.0, -2.0, 10.0]),
        ("x*y".into(), [0.0, 1.0, 0.0]),
        // r at (3, 4): [y², −xy, x²] / r³.
        ("hypot(x, y)".into(), [16.0 / 125.0, -12.0 / 125.0, 9.0 / 125.0]),
        (format!("sqrt{r2}"), [16.0 / 125.0, -12.0 / 125.0, 9.0 / 125.0]),
        // ln r: [y² − x², −2xy, x² − y²] / r⁴.
        (format!("ln{r2}/2"), [7.0 / 625.0, -24.0 / 625.0, -7.0 / 625.0]),
        // x / y: [0, −1/y², 2x/y³].
        ("x/y".into(), [0.0, -1.0 / 16.0, 6.0 / 64.0]),
        // max takes x³, min and abs their side.
        ("max(x^3, y)+min(x, y^2)-abs(x-y*y)".into(), [18.0, 0.0, -2.0]),
        ("x^1*y^0+x^-1".into(), [2.0 / 27.0, 0.0, 0.0]),
    ];
    for (text, expected) in cases {
        let found = at(&text, 3.0, 4.0).bend;
        for k in 0..3 {
            assert!((found[k] - expected[k]).abs() < 1e-13, "{text}: {found:?}");
        }
    }
}

#[test]
fn eigenvalues_are_those_of_the_matrix() {
    let of = largest_eigenvalue::<f64>;
    assert_eq!(of([2.0, 0.0, -5.0]), 5.0);
    assert_eq!(of([0.0, 3.0, 0.0]), 3.0);
    // [[4, 2], [2, 1]] has 5 and 0; [[1, 2], [2, −2]] has 2 and −3.
    assert_eq!((of([4.0, 2.0, 1.0]), of([1.0, 2.0, -2.0])), (5.0, 3.0));
}

/// Smooth for x and y in [½, 1½]; exmex reads them as we do.
const FORMULAS: [&str; 12] = [
    "x*x*y-y/(2+x)",
    "sin(2*x)*cos(y)",
    "tan(0.5*x)+atan(3*y)",
    "tanh(x*y)+exp(0-x)",
    "ln(x+y)*sqrt(x)",
    "x^3/(1+y^4)+2^x",
    "(x+1)^(y-0.5)",
    "x^2.5+y^0.5",
    "sqrt(x*x+(y-0.2)^2)",
    "tanh((x-y)/0.1)",
    "atan((sqrt(x*x+y*y)-1)/0.05)",
    "exp(0-((x-1)^2+(y-1)^2)/0.01)",
];

fn by_exmex(text: &str, x: f64, y: f64) -> [f64; 3] {
    let u = FlatEx::<f64>::parse(text).unwrap();
    [[0, 0], [0, 1], [1, 1]].map(|[i, j]| {
        let twice = u.clone().partial(i).unwrap().partial(j).unwrap();
        twice.eval(&[x, y]).unwrap()
    })
}

fn sized(values: [f64; 3]) -> f64 {
    1.0 + values.iter().map(|value| value.abs()).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn points_have_the_derivatives_of_exmex(k in 0..FORMULAS.len(), x in 0.5f64..1.5, y in 0.5f64..1.5) {
        let expected = by_exmex(FORMULAS[k], x, y);
        let found = at(FORMULAS[k], x, y).bend;
        for (found, expected_one) in found.into_iter().zip(expected) {
            prop_assert!((found - expected_one).abs() <= 1e-9 * sized(expected), "{}: {found} {expected_one}", FORMULAS[k]);
        }
    }

    #[test]
    fn cells_enclose_the_derivatives_at_their_points(
        k in 0..FORMULAS.len() + 4, x in 0.5f64..1.4, y in 0.5f64..1.4, size in 0.0f64..0.1, s in 0.0f64..=1.0, t in 0.0f64..=1.0,
    ) {
        let kinked = ["abs(x-y)*x", "max(x*x, y*y*y)", "min(x*y, 1)+hypot(x-1, y-1)", "(abs(x-1)+1)^y"];
        let text = FORMULAS.iter().chain(&kinked).nth(k).unwrap();
        let cell = over(text, [x, x + size], [y, y + size]);
        let point = at(text, x + s * size, y + t * size);
        let pairs = cell.bend.into_iter().zip(point.bend).chain(cell.slope.into_iter().zip(point.slope));
        for (bounds, value) in pairs.chain([(cell.value, point.value)]) {
            prop_assert!(bounds.low <= value && value <= bounds.high || value.is_nan(), "{text}: {value} in {bounds:?}");
        }
        let (bounds, value) = (largest_eigenvalue(cell.bend), largest_eigenvalue(point.bend));
        prop_assert!(bounds.low <= value && value <= bounds.high || value.is_nan(), "{text}: {value} in {bounds:?}");
    }
}

#[test]
fn a_kink_has_the_derivatives_of_both_sides_and_no_slope_of_them() {
    let cell = over("abs(x)*x", [-0.1, 0.1], [0.0, 1.0]);
    assert!(cell.bend[0].low <= -2.0 && cell.bend[0].high >= 2.0);
    let side = |low: f64, high: f64| Interval::new(low, high);
    let program = compile("max(x, x*x*x)").unwrap();
    let smooth: Jet<Gradient> = program.run(Jet::x(Gradient::x(side(1.1, 1.2))), Jet::y(Gradient::y(side(0.0, 1.0))));
    assert!((smooth.bend[0].slope() - 6.0).abs() < 1e-12);
    let across: Jet<Gradient> = program.run(Jet::x(Gradient::x(side(0.9, 1.1))), Jet::y(Gradient::y(side(0.0, 1.0))));
    assert!(across.value.slope() < 4.0 && across.bend[0].slope() == f64::INFINITY);
    assert!(across.bend[0].value.low <= 0.0 && across.bend[0].value.high >= 6.6);
}

#[test]
fn a_constant_times_what_has_no_derivative_has_one() {
    // √(0 x) = 0 for all x: 0 · ∞ by the chain rule, at the point and over the cell.
    assert_eq!(at("sqrt(0*x)", 0.0, 0.0).bend, [0.0; 3]);
    assert_eq!(at("sqrt(x)", 0.0, 0.0).bend[0], f64::NEG_INFINITY);
    assert_eq!(over("sqrt(x)", [0.0, 1.0], [0.0, 1.0]).bend[0], Interval::WHOLE);
}
