//! nsf by hand, enclosed, and held against the error that it promises.

use crate::domain::{Domain, gallery};
use crate::geometry::DVec2;
use crate::spacing::Spacing;
use crate::spacing::expression::hessian::*;
use crate::spacing::testing::bitten;
use proptest::prelude::*;
use std::sync::OnceLock;

const BOX: Rect = Rect {
    min: DVec2::ZERO,
    max: DVec2::ONE,
};

fn tolerance(eps: f64) -> Tolerance {
    Tolerance {
        eps,
        min: None,
        max: None,
    }
}

fn nsf(text: &str, eps: f64) -> Hessian {
    Hessian::new(text, &tolerance(eps), BOX).unwrap()
}

#[test]
fn spacings_are_those_found_by_hand() {
    // u = x² + y²: λ = 2 twice, f = √(6 eps / 2).
    let f = nsf("x^2+y^2", 1e-4);
    assert!((f.at(DVec2::new(0.3, 0.7)) - (3e-4f64).sqrt()).abs() < 1e-15);
    assert!(f.lipschitz() < 1e-9, "{}", f.lipschitz());
    // u = x³ y: H = [[6xy, 3x²], [3x², 0]], at (1, 1) λ = 3 ± √18.
    let expected = (6e-3 / (3.0 + 18f64.sqrt())).sqrt();
    assert!((nsf("x^3*y", 1e-3).at(DVec2::ONE) - expected).abs() < 1e-15);
}

#[test]
fn a_plane_has_the_largest_spacing_and_a_singularity_the_smallest() {
    let at = |text: &str, x: f64| nsf(text, 1e-3).at(DVec2::new(x, 0.0));
    assert!((at("1+2*x-3*y", 0.5) - 1.0).abs() < 1e-12);
    assert!((at("(x^2+y^2)^(1/3)", 0.0) - SMALLEST).abs() < 1e-15);
    assert!((at("sqrt(x)", 0.0) - SMALLEST).abs() < 1e-15);
    assert!(at("ln(x)", 0.0).is_nan() && at("sqrt(x-0.5)", 0.2).is_nan());
    let given = Tolerance {
        min: Some(0.01),
        max: Some(0.2),
        ..tolerance(1e-3)
    };
    let f = Hessian::new("x^40", &given, BOX).unwrap();
    assert!((f.at(DVec2::ZERO) - 0.2).abs() < 1e-15 && (f.at(DVec2::X) - 0.01).abs() < 1e-15);
    assert!(f.lower_bound(BOX) >= 0.01 * 0.99 && f.upper_bound(BOX) <= 0.2 * 1.01);
}

#[test]
fn bounds_by_default_are_those_of_the_box_and_never_crossed() {
    let range = |min, max| {
        Tolerance {
            min,
            max,
            ..tolerance(1.0)
        }
        .range(Rect {
            min: DVec2::ZERO,
            max: DVec2::new(4.0, 2.0),
        })
    };
    assert_eq!(range(None, None), [4e-4, 4.0]);
    assert_eq!(range(Some(0.1), None), [0.1, 4.0]);
    assert_eq!(range(Some(10.0), None), [10.0, 10.0]);
    assert_eq!(range(None, Some(1e-6)), [1e-6, 1e-6]);
}

#[test]
fn the_constant_is_sharp_on_an_equilateral_triangle() {
    // u = ½ ‖x‖² with M = 1 around the centre of an equilateral triangle: the error there is h² / 6, nowhere more.
    let h = 0.3;
    let corners = [90.0f64, 210.0, 330.0].map(|degrees| h / 3f64.sqrt() * DVec2::from_angle(degrees.to_radians()));
    assert!((corners[0].distance(corners[1]) - h).abs() < 1e-15);
    let u = |x: DVec2| 0.5 * x.length_squared();
    let error = |weights: [f64; 3]| {
        let x = (0..3).map(|k| weights[k] * corners[k]).sum::<DVec2>();
        (0..3).map(|k| weights[k] * u(corners[k])).sum::<f64>() - u(x)
    };
    assert!((error([1.0 / 3.0; 3]) - h * h / INTERPOLATION).abs() < 1e-15);
    for a in 0..=20 {
        for b in 0..=20 - a {
            let [a, b] = [a, b].map(|share| f64::from(share) / 20.0);
            assert!(error([a, b, 1.0 - a - b]) <= h * h / INTERPOLATION + 1e-15);
        }
    }
}

/// What the module's docs say of a mesh: R ≤ c_b f / (1 − t), so the error is at most 3 (c_b / (1 − t))² eps, for a constant H
/// and triangles whose circumcentre lies in the domain; and that it is of the order of eps.
#[test]
fn a_bitten_mesh_keeps_the_error() {
    let square = Domain::new(gallery::pslg("unit-square").unwrap().unwrap()).unwrap();
    let eps = 1e-3;
    let mesh = bitten(&square, &format!("hessian:x^2+y^2;eps={eps}"), [0.25, 0.75]);
    let mut worst = 0.0f64;
    for t in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(t);
        let twice = (b - a).perp_dot(c - a);
        let radius = a.distance(b) * b.distance(c) * c.distance(a) / (2.0 * twice);
        // Both eigenvalues are 2: the error at the circumcentre is R², where that lies in the triangle.
        let is_acute = [[a, b, c], [b, c, a], [c, a, b]]
            .iter()
            .all(|[p, q, r]| (*q - *p).dot(*r - *p) > 0.0);
        if is_acute {
            worst = worst.max(radius * radius);
        }
    }
    assert!((0.3 * eps..=3.0 * eps).contains(&worst), "{worst}");
}

const SOLUTIONS: [&str; 7] = [
    "tanh((x-0.5)/0.1)+y^2",
    "sin(5*x)*cos(3*y)",
    "(x^2+y^2)^(1/3)*cos(2/3*atan(y/(1+x)))",
    "exp(-((x-0.4)^2+(y-0.3)^2)/0.02)",
    "abs(x-0.3)*x+max(y^2, x)",
    "x^4*y-y^3",
    "atan((hypot(x+0.1, y+0.1)-0.7)/0.05)",
];

/// The spacing of each of [`SOLUTIONS`], which takes a while to bound.
static ALL: OnceLock<[Hessian; 7]> = OnceLock::new();

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn cells_enclose_the_spacing_and_slopes_bound_it(
        k in 0..SOLUTIONS.len(), x in 0.0f64..0.9, y in 0.0f64..0.9, size in 0.0f64..0.1, u in 0.0f64..=1.0, v in 0.0f64..=1.0,
    ) {
        let f = &ALL.get_or_init(|| SOLUTIONS.map(|u| nsf(u, 1e-3)))[k];
        let cell = Rect { min: DVec2::new(x, y), max: DVec2::new(x + size, y + size) };
        let [one, two] = [DVec2::new(u, v), DVec2::new(v, u)].map(|share| cell.min + share * cell.size());
        let values = [one, two].map(|x| f.at(x));
        for value in values {
            prop_assert!(f.lower_bound(cell) <= value * (1.0 + 1e-12) && value <= f.upper_bound(cell) * (1.0 + 1e-12));
            prop_assert!(f.lower_bound(BOX) <= value * (1.0 + 1e-12) && value <= f.upper_bound(BOX) * (1.0 + 1e-12));
        }
        let apart = one.distance(two);
        let slope = f.gradient(cell).slope().min(f.lipschitz());
        prop_assert!(slope.is_infinite() || (values[0] - values[1]).abs() <= slope * apart + 1e-12);
    }
}

#[test]
fn enclosures_close_in_on_the_spacing() {
    let f = nsf("sin(5*x)*cos(3*y)+x^2*y", 1e-3);
    let at = DVec2::new(0.31, 0.72);
    let width = |size: f64| {
        let half = DVec2::splat(0.5 * size);
        let cell = Rect {
            min: at - half,
            max: at + half,
        };
        (f.upper_bound(cell) - f.lower_bound(cell)) / f.at(at)
    };
    assert!(
        width(1e-2) < 0.1 && width(1e-4) < 1e-3,
        "{} {}",
        width(1e-2),
        width(1e-4)
    );
    // |λ|max = 4e^{2x} here: f = √(1.5e-3) e^{-x}, as steep as √(1.5e-3).
    let gentle = nsf("exp(2*x)+y^2", 1e-3).lipschitz();
    assert!(
        (1.5e-3f64.sqrt()..1.05 * 1.5e-3f64.sqrt()).contains(&gentle),
        "{gentle}"
    );
    // A formula that is steep where H changes sign claims nothing.
    assert_eq!(nsf("tanh((x+y-1)/0.1)", 0.02).lipschitz(), f64::INFINITY);
}
