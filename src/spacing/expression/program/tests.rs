//! What is folded, and what a program computes.

use crate::spacing::expression::grammar::compile;
use crate::spacing::expression::program::*;

/// The steps of an expression.
fn steps(text: &str) -> Vec<Step> {
    compile(text).unwrap().steps
}

fn interval(text: &str, low: f64, high: f64) -> Interval {
    compile(text)
        .unwrap()
        .run(Interval::new(low, high), Interval::new(low, high))
}

#[test]
fn constants_are_folded() {
    for (text, value) in [
        ("1+2", 3.0),
        ("1-2", -1.0),
        ("3*2", 6.0),
        ("1/2", 0.5),
        ("2^3", 8.0),
        ("-(2)", -2.0),
        ("sqrt(4)+abs(-3)", 5.0),
        ("min(4, 3)", 3.0),
        ("max(4, 3)", 4.0),
        ("hypot(3, 4)", 5.0),
        ("exp(0)+ln(1)+sin(0)+tan(0)+atan(0)+tanh(0)+cos(0)", 2.0),
    ] {
        assert_eq!(steps(text), [Step::Constant(value)], "{text}");
    }
    assert_eq!(
        steps("x+1*2"),
        [Step::X, Step::Constant(2.0), Step::Binary(Binary::Add)]
    );
}

#[test]
fn powers_with_small_whole_exponents_are_whole() {
    for (text, exponent) in [
        ("x^3", 3),
        ("x^-2", -2),
        ("x^64", 64),
        ("x^-64", -64),
        ("x^(1+1)", 2),
        ("x*x", 2),
    ] {
        assert_eq!(steps(text), [Step::X, Step::PowerWhole(exponent)], "{text}");
    }
    for (text, exponent) in [("x^0.5", 0.5), ("x^65", 65.0), ("x^-65", -65.0), ("x^2.5", 2.5)] {
        assert_eq!(steps(text), [Step::X, Step::PowerFixed(exponent)], "{text}");
    }
    assert_eq!(steps("x^y"), [Step::X, Step::Y, Step::Binary(Binary::Power)]);
    for (text, value) in [
        ("x^3", -8.0),
        ("x^-2", 0.25),
        ("x^2", 4.0),
        ("x*x", 4.0),
        ("(3-x)^0.5", 5f64.sqrt()),
    ] {
        assert_eq!(compile(text).unwrap().run(-2.0, 0.0), value, "{text}");
    }
}

#[test]
fn the_same_twice_multiplied_is_a_square() {
    let square = Step::PowerWhole(2);
    assert_eq!(
        steps("(x+y)*(x+y)"),
        [Step::X, Step::Y, Step::Binary(Binary::Add), square]
    );
    assert_eq!(
        steps("y*(x*x)"),
        [Step::Y, Step::X, square, Step::Binary(Binary::Multiply)]
    );
    assert_eq!(steps("y+x*x"), [Step::Y, Step::X, square, Step::Binary(Binary::Add)]);
    for text in ["x*y", "(x+y)*(x-y)", "(x+y)*(y+x)", "(y+x)*x", "x+x", "x-x"] {
        assert!(!steps(text).contains(&square), "{text}");
    }
    assert!(interval("x*x", -1.0, 1.0).low == 0.0 && interval("x*y", -1.0, 1.0).low <= -1.0);
}

#[test]
fn a_root_of_two_squares_is_a_hypot() {
    let hypot = Step::Binary(Binary::Hypot);
    assert_eq!(steps("sqrt(x^2+y^2)"), [Step::X, Step::Y, hypot]);
    assert_eq!(
        steps("sqrt(x*x+(y-1)^2)"),
        [
            Step::X,
            Step::Y,
            Step::Constant(1.0),
            Step::Binary(Binary::Subtract),
            hypot
        ]
    );
    let sum = [Step::X, Step::Y, Step::Binary(Binary::Add)];
    assert_eq!(steps("sqrt((x+y)^2+y^2)"), [&sum[..], &[Step::Y, hypot]].concat());
    for text in [
        "sqrt(x^2-y^2)",
        "sqrt(x^3+y^2)",
        "sqrt(x^2+y^3)",
        "sqrt(x^2+y)",
        "sqrt(x+y^2)",
        "sqrt(x^2*y^2)",
        "exp(x^2+y^2)",
        "sqrt(x)",
    ] {
        assert!(!steps(text).contains(&hypot), "{text}");
    }
    for (text, value) in [
        ("sqrt(x^2+y^2)", 5.0),
        ("hypot(x, y)", 5.0),
        ("sqrt(y^2+x+x*y)", 31f64.sqrt()),
        ("2+sqrt(x^2+(y+8)^2)-x", 11.36931687685298),
    ] {
        assert!((compile(text).unwrap().run(3.0, 4.0) - value).abs() < 1e-12, "{text}");
    }
}

#[test]
fn a_program_is_refused_where_it_needs_more_stack_than_there_is() {
    let nested = |count: usize| format!("{}x{}", "x+(".repeat(count), ")".repeat(count));
    assert_eq!(compile(&nested(STACK - 1)).unwrap().run(1.0, 0.0), STACK as f64);
    let error = compile(&nested(STACK)).unwrap_err().to_string();
    assert_eq!(error, "column 1: the expression is nested too deeply");
    // What is folded needs none: sums may be long.
    for term in [
        "1",
        "sin(1)",
        "x",
        "x^2",
        "x^0.5",
        "x*x",
        "2*3",
        "-x",
        "sqrt(x^2+y^2)",
        "min(x, y, 1)",
        "2^x",
    ] {
        let sum = vec![term; 200].join("+");
        let (one, all) = (compile(term).unwrap(), compile(&sum).unwrap());
        assert!((all.run(0.5, 0.25) / one.run(0.5, 0.25) - 200.0).abs() < 1e-9, "{term}");
        assert!(
            all.highest <= one.highest.max(2) + 1 && all.height == 1,
            "{term}: {}",
            all.highest
        );
    }
}

#[test]
fn floats_compute_what_functions_are_called() {
    let f = |function: Unary, x: f64| Number::unary(x, function);
    let pairs = [
        (Unary::Negate, -0.5),
        (Unary::Sin, 0.5f64.sin()),
        (Unary::Cos, 0.5f64.cos()),
        (Unary::Tan, 0.5f64.tan()),
    ];
    let more = [
        (Unary::Atan, 0.5f64.atan()),
        (Unary::Tanh, 0.5f64.tanh()),
        (Unary::Exp, 0.5f64.exp()),
    ];
    let rest = [
        (Unary::Ln, 0.5f64.ln()),
        (Unary::Sqrt, 0.5f64.sqrt()),
        (Unary::Abs, 0.5),
    ];
    for (function, value) in pairs.into_iter().chain(more).chain(rest) {
        assert_eq!(f(function, 0.5), value);
        let bounds = Interval::point(0.5).unary(function);
        assert!(
            bounds.low <= value && value <= bounds.high && bounds.high - bounds.low < 1e-14,
            "{function:?}"
        );
    }
    for (function, value) in [
        (Binary::Add, 2.5),
        (Binary::Subtract, -1.5),
        (Binary::Multiply, 1.0),
        (Binary::Divide, 0.25),
        (Binary::Power, 0.25),
        (Binary::Min, 0.5),
        (Binary::Max, 2.0),
        (Binary::Hypot, 4.25f64.sqrt()),
    ] {
        assert_eq!(0.5f64.binary(function, 2.0), value);
        let bounds = Interval::point(0.5).binary(function, Interval::point(2.0));
        assert!(
            bounds.low <= value && value <= bounds.high && bounds.high - bounds.low < 1e-14,
            "{function:?}"
        );
    }
}
