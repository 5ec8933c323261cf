//! Enclosed gradients against finite differences, and at kinks.

use crate::spacing::expression::gradient::*;
use crate::spacing::expression::grammar::compile;
use proptest::prelude::*;

fn over(text: &str, x: (f64, f64), y: (f64, f64)) -> Gradient {
    let program = compile(text).unwrap();
    program.run(
        Gradient::x(Interval::new(x.0, x.1)),
        Gradient::y(Interval::new(y.0, y.1)),
    )
}

fn holds(bounds: Interval, value: f64, slack: f64) -> bool {
    bounds.low - slack <= value && value <= bounds.high + slack
}

/// Smooth for x and y in [½, 1½], values and slopes of a few units at most.
const FORMULAS: [&str; 20] = [
    "x+y*3",
    "x-2*y",
    "x*y*0.5",
    "x/(y+1)",
    "-x+y",
    "sin(2*x)*cos(y)",
    "tan(0.5*x)+atan(3*y)",
    "tanh(x*y)+exp(-x)",
    "ln(x+y)*sqrt(x)",
    "abs(x-3)+abs(y+1)",
    "x^3-y^-2",
    "x^0-y^1",
    "x^2.5+y^-0.5",
    "(x+1)^(y-0.5)",
    "2^(x*y)",
    "x^(0*y+2)",
    "min(x, y+2)+min(y+2, x)",
    "max(x, y+2)*max(y+2, x)",
    "hypot(x, 2*y)",
    "hypot(x+y, x-y)+hypot(x, 3)+hypot(3, y)",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn small_cells_enclose_the_gradient_closely(index in 0..FORMULAS.len(), x in 0.5f64..1.5, y in 0.5f64..1.5) {
        let text = FORMULAS[index];
        let program = compile(text).unwrap();
        let step = 1e-5;
        let dx = (program.run(x + step, y) - program.run(x - step, y)) / (2.0 * step);
        let dy = (program.run(x, y + step) - program.run(x, y - step)) / (2.0 * step);
        let found = over(text, (x - step, x + step), (y - step, y + step));
        prop_assert!(holds(found.value, program.run(x, y), 0.0), "{text}");
        for (bounds, expected) in [(found.dx, dx), (found.dy, dy)] {
            prop_assert!(holds(bounds, expected, 1e-8), "{text}: {bounds:?}, differences {expected}");
            prop_assert!(bounds.high - bounds.low < 2e-3, "{text}: {bounds:?}");
        }
        let length = dx.hypot(dy);
        let slope = found.slope();
        prop_assert!(slope >= length - 1e-8 && slope <= length + 3e-3, "{text}: {slope}, differences {length}");
    }

    /// On cells of any size the slope is a Lipschitz constant.
    #[test]
    fn the_slope_of_a_cell_is_a_lipschitz_constant(
        index in 0..FORMULAS.len(), corner in (0.5f64..1.2, 0.5f64..1.2), size in 0.0f64..0.3,
        u in (0.0f64..1.0, 0.0f64..1.0), v in (0.0f64..1.0, 0.0f64..1.0),
    ) {
        let text = FORMULAS[index];
        let program = compile(text).unwrap();
        let (one, other) = ((corner.0 + size * u.0, corner.1 + size * u.1), (corner.0 + size * v.0, corner.1 + size * v.1));
        let change = (program.run(one.0, one.1) - program.run(other.0, other.1)).abs();
        let slope = over(text, (corner.0, corner.0 + size), (corner.1, corner.1 + size)).slope();
        prop_assert!(change <= slope * (one.0 - other.0).hypot(one.1 - other.1) + 1e-12, "{text}");
    }
}

#[test]
fn at_a_kink_the_derivatives_of_all_sides_are_enclosed() {
    let whole = |low: f64, high: f64| Interval::new(low, high);
    for (text, x, expected) in [
        ("abs(x)", (-1.0, 1.0), whole(-1.0, 1.0)),
        ("abs(x)", (0.0, 1.0), whole(-1.0, 1.0)),
        ("abs(x)", (-1.0, 0.0), whole(-1.0, 1.0)),
        ("abs(x)", (0.5, 1.0), whole(1.0, 1.0)),
        ("abs(x)", (-1.0, -0.5), whole(-1.0, -1.0)),
        ("min(x, 0.5)", (0.0, 0.25), whole(1.0, 1.0)),
        ("min(x, 0.5)", (0.0, 0.5), whole(0.0, 1.0)),
        ("min(x, 0.5)", (0.5, 1.0), whole(0.0, 1.0)),
        ("min(x, 0.5)", (0.75, 1.0), whole(0.0, 0.0)),
        ("min(0.5, x)", (0.0, 0.25), whole(1.0, 1.0)),
        ("min(0.5, x)", (0.0, 0.5), whole(0.0, 1.0)),
        ("min(0.5, x)", (0.5, 1.0), whole(0.0, 1.0)),
        ("min(0.5, x)", (0.75, 1.0), whole(0.0, 0.0)),
        ("max(x, 0.5)", (0.0, 0.25), whole(0.0, 0.0)),
        ("max(x, 0.5)", (0.0, 0.5), whole(0.0, 1.0)),
        ("max(x, 0.5)", (0.5, 1.0), whole(0.0, 1.0)),
        ("max(x, 0.5)", (0.75, 1.0), whole(1.0, 1.0)),
        ("max(0.5, x)", (0.0, 0.25), whole(0.0, 0.0)),
        ("max(0.5, x)", (0.0, 0.5), whole(0.0, 1.0)),
        ("max(0.5, x)", (0.5, 1.0), whole(0.0, 1.0)),
        ("max(0.5, x)", (0.75, 1.0), whole(1.0, 1.0)),
    ] {
        let found = over(text, x, (0.0, 0.0));
        // Rounding steps out by no more than a float or two.
        assert!(
            holds(expected, found.dx.low, 1e-15) && holds(expected, found.dx.high, 1e-15),
            "{text} on {x:?}: {:?}",
            found.dx
        );
        assert!(
            holds(found.dx, expected.low, 0.0) && holds(found.dx, expected.high, 0.0),
            "{text} on {x:?}: {:?}",
            found.dx
        );
        let steepest = expected.magnitude();
        assert!(
            found.slope() >= steepest && found.slope() <= steepest + 1e-15,
            "{text} on {x:?}: {}",
            found.slope()
        );
    }
    // Either side may be the steeper one.
    assert!(
        over("min(x, 3*y)", (0.0, 1.0), (0.0, 1.0)).slope() >= 3.0
            && over("max(4*x, y)", (0.0, 1.0), (0.0, 1.0)).slope() >= 4.0
    );
}

#[test]
fn a_distance_has_slope_1_even_around_the_point_itself() {
    for text in ["hypot(x, y)", "sqrt(x^2+y^2)", "hypot(y, x)"] {
        for cell in [
            ((-1.0, 1.0), (-1.0, 1.0)),
            ((0.0, 0.0), (0.0, 0.0)),
            ((0.0, 1.0), (0.5, 1.0)),
        ] {
            let slope = over(text, cell.0, cell.1).slope();
            assert!((1.0..1.0 + 1e-14).contains(&slope), "{text} {cell:?}: {slope}");
        }
    }
    let around = over("hypot(x, y)", (-1.0, 1.0), (-1.0, 1.0));
    for bounds in [around.dx, around.dy] {
        assert!(holds(bounds, -1.0, 0.0) && holds(bounds, 1.0, 0.0), "{bounds:?}");
    }
    // Of the Jacobian of (3x, 4y) the largest column sum is 4, and so is the largest row sum.
    let slope = over("hypot(3*x, 4*y)", (-1.0, 1.0), (-1.0, 1.0)).slope();
    assert!((4.0..4.0 + 1e-13).contains(&slope), "{slope}");
    // Of (x + y, 2y) they are 3 and 2: √6.
    let slope = over("hypot(x+y, 2*y)", (-1.0, 1.0), (-1.0, 1.0)).slope();
    assert!((6f64.sqrt()..6f64.sqrt() + 1e-13).contains(&slope), "{slope}");
    // Away from the point shares are known: x / r and y / r.
    let found = over("hypot(x, y)", (3.0, 3.0), (4.0, 4.0));
    assert!(holds(found.dx, 0.6, 0.0) && holds(found.dy, 0.8, 0.0) && found.dx.high - found.dx.low < 1e-14);
}

#[test]
fn constants_have_no_slope_whatever_they_are_multiplied_with() {
    for text in ["3", "0*y", "3+0*x", "x^0", "0*ln(x)", "0/(1+x^2)"] {
        assert_eq!(over(text, (0.0, 1.0), (0.0, 1.0)).slope(), 0.0, "{text}");
    }
    assert_eq!(
        (up(0.0), up(1.0), scaled(0.0, f64::INFINITY), scaled(f64::INFINITY, 0.0)),
        (0.0, 1f64.next_up(), 0.0, 0.0)
    );
    assert_eq!(scaled(3.0, 0.1), (3.0f64 * 0.1).next_up());
    assert_eq!(over("sqrt(x)", (0.0, 1.0), (0.0, 0.0)).slope(), f64::INFINITY);
    assert_eq!(
        (
            over("x", (0.0, 1.0), (0.0, 1.0)).slope(),
            over("y", (0.0, 1.0), (0.0, 1.0)).slope()
        ),
        (1.0, 1.0)
    );
}
