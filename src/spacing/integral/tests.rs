use super::super::testing::gallery;
use super::super::{Expression, Lfs, Options, Uniform, build, lfs_of};
use super::*;
use crate::domain::{Fill, InputSegment, Pslg};

fn of_expression(text: &str, tolerance: f64) -> Integral {
    let domain = gallery("unit-square");
    let f = Expression::new(text, domain.bounds()).unwrap();
    integrate(&f, &domain, tolerance).unwrap()
}

fn assert_is(found: Integral, expected: f64, tolerance: f64) {
    let off = (found.value / expected - 1.0).abs();
    assert!(found.error <= tolerance);
    assert!(
        off <= found.error.max(1e-13),
        "{found:?}, expected {expected}: off by {off}"
    );
}

#[test]
fn constants_are_area_over_their_square() {
    for name in ["unit-square", "comb", "annulus"] {
        let domain = gallery(name);
        assert_is(
            integrate(&Uniform(0.1), &domain, 1e-6).unwrap(),
            domain.area() * 100.0,
            1e-6,
        );
    }
}

#[test]
fn closed_forms_are_met_within_the_error() {
    // ∫ dx / (a + bx)² = 1 / (a (a + b)).
    for tolerance in [1e-3, 1e-6, 1e-9] {
        assert_is(of_expression("0.05+0.5*x", tolerance), 1.0 / (0.05 * 0.55), tolerance);
        // A kink along a line that no edge follows: 2 ∫₀^½ du / (a + bu)² across it.
        assert_is(
            of_expression("0.1+0.3*abs(x-0.5)", tolerance),
            1.0 / (0.1 * 0.25),
            tolerance,
        );
    }
}

/// ∫ dA / lfs² on the unit square by brute force: a fine midpoint rule.
fn brute_force(lfs: &Lfs, side: usize) -> f64 {
    let step = 1.0 / side as f64;
    let at = |i: usize, j: usize| lfs.at(step * DVec2::new(i as f64 + 0.5, j as f64 + 0.5));
    let column = |i: usize| (0..side).map(|j| at(i, j).powi(-2)).sum::<f64>();
    (0..side).map(column).sum::<f64>() * step * step
}

#[test]
fn lfs_of_the_square_is_that_of_brute_force() {
    let domain = gallery("unit-square");
    let lfs = lfs_of(&domain).unwrap();
    let reference = brute_force(&lfs, 800);
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let found = integrate(&lfs, &domain, tolerance).unwrap();
        assert!(
            (found.value / reference - 1.0).abs() <= found.error + 1e-5,
            "{found:?}, {reference}"
        );
    }
}

#[test]
fn a_tighter_tolerance_stays_within_the_looser_error() {
    for name in ["l-shape", "plate-hole", "naca0012"] {
        let domain = gallery(name);
        for alpha in [0.2, 1.0] {
            let f = build("lfs", &domain, &Options::with_alpha(alpha)).unwrap().function;
            let loose = integrate(f.as_ref(), &domain, 3e-3).unwrap();
            let tight = integrate(f.as_ref(), &domain, 1e-4).unwrap();
            assert!(
                (loose.value / tight.value - 1.0).abs() <= loose.error + tight.error,
                "{loose:?} {tight:?}"
            );
        }
    }
}

#[test]
fn the_result_does_not_depend_on_threads() {
    let domain = gallery("gear");
    let lfs = lfs_of(&domain).unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| integrate(&lfs, &domain, 1e-3).unwrap())
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn a_spacing_of_zero_is_an_error() {
    let domain = gallery("unit-square");
    let f = Expression::new("x-0.5", domain.bounds()).unwrap();
    assert!(matches!(
        integrate(&f, &domain, 1e-3),
        Err(SpacingError::NotPositive { .. })
    ));
}

#[test]
fn a_spacing_whose_square_vanishes_is_an_error() {
    let told = integrate(&Uniform(1e-300), &gallery("unit-square"), 1e-3);
    assert!(
        matches!(told, Err(SpacingError::TooSmall { x, .. }) if x.is_finite()),
        "{told:?}"
    );
}

#[test]
fn equilateral_triangles_are_counted() {
    // A square of side 1 holds 4 / √3 · 10⁴ triangles of edge 0.01.
    let estimate = estimate_triangles(1e6, 0.1);
    assert!((estimate / (4.0 / 3f64.sqrt() * 1e8) - 1.0).abs() < 1e-12);
}

/// A comb of `teeth`, one tooth a unit of length, over one long segment.
fn long_comb(teeth: u32) -> Domain {
    let mut ring = vec![[0.0, -1.0], [f64::from(teeth), -1.0], [f64::from(teeth), 0.0]];
    for tooth in (0..teeth).rev().map(f64::from) {
        let sides = [tooth + 0.75, tooth + 0.25];
        ring.extend([[sides[0], 0.0], [sides[0], 1.0], [sides[1], 1.0], [sides[1], 0.0]]);
    }
    ring.push([0.0, 0.0]);
    let count = ring.len();
    let segments = (0..count).map(|k| InputSegment {
        a: k,
        b: (k + 1) % count,
        marker: 1,
    });
    Domain::new(Pslg {
        vertices: ring.into_iter().map(DVec2::from).collect(),
        segments: segments.collect(),
        fill: Fill::EvenOdd {
            flips: vec![true; count],
        },
        ..Pslg::default()
    })
    .unwrap()
}

/// Each tooth made a needle as long as the comb, and each needle was cut into as many parts as that is long; round outlines
/// made needles as long as the domain.
#[test]
fn triangles_to_begin_with_are_as_many_as_the_integral_is_large() {
    let per_unit = |domain: &Domain| {
        let lfs = lfs_of(domain).unwrap();
        let parts = start::triangles(&lfs, domain).unwrap().len();
        parts as f64 / integrate(&lfs, domain, 1e-2).unwrap().value
    };
    for domain in [long_comb(32), long_comb(256), gallery("annulus"), regular(2000)] {
        let parts = per_unit(&domain);
        assert!(parts < 25.0, "{parts} parts for each unit of {}", domain.name());
    }
}

fn regular(corners: usize) -> Domain {
    let mut pslg = Pslg::new("regular");
    let at = |k: usize| DVec2::from_angle(std::f64::consts::TAU * k as f64 / corners as f64);
    pslg.add_ring((0..corners).map(at), 1);
    Domain::new(pslg).unwrap()
}
