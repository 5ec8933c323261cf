//! Spacing texts.

use biting::geometry::{DVec2, Rect};
use biting::spacing::{Expression, Hessian, Spacing, Spec, Tolerance};

/// A SPEC: what is read is written so that it reads back.
pub fn spec(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    match Spec::parse(&text) {
        Ok(spec) => assert_eq!(Spec::parse(&spec.to_string()), Ok(spec)),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// An expression, as f and as u: where it has finite values, its bounds on a cell enclose them.
pub fn expression(data: &[u8]) {
    let whole = Rect {
        min: DVec2::new(-1.0, 0.0),
        max: DVec2::new(1.0, 2.0),
    };
    let text = String::from_utf8_lossy(data);
    let Ok(expression) = Expression::new(&text, whole) else {
        return;
    };
    check_bounds(&expression, whole);
    let tolerance = Tolerance {
        eps: 0.01,
        min: None,
        max: None,
    };
    let nsf = Hessian::new(&text, &tolerance, whole).expect("what is an f is a u");
    check_bounds(&nsf, whole);
}

/// Compares bounds on sixteen cells with values in them.
fn check_bounds(f: &impl Spacing, whole: Rect) {
    let size = (whole.max - whole.min) / 4.0;
    for k in 0..16 {
        let min = whole.min + size * DVec2::new(f64::from(k % 4), f64::from(k / 4));
        let cell = Rect { min, max: min + size };
        let (low, high) = (f.lower_bound(cell), f.upper_bound(cell));
        for x in [cell.min, cell.centre(), cell.max, min + size * DVec2::new(0.3, 0.8)] {
            let value = f.at(x);
            assert!(
                !value.is_finite() || (low <= value && value <= high),
                "{value} at {x} is not from {low} to {high}"
            );
        }
    }
}
