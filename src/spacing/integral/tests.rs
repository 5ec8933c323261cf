use crate::domain::{Fill, InputSegment, Pslg};
use crate::spacing::integral::*;
use crate::spacing::testing::gallery;
use crate::spacing::{Expression, Lfs, Options, Uniform, build, lfs_of};

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

/// A spacing that counts how often it is evaluated.
struct Counted<'a> {
    inner: &'a dyn Spacing,
    count: std::sync::atomic::AtomicUsize,
}

impl Spacing for Counted<'_> {
    fn at(&self, x: DVec2) -> f64 {
        self.count.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        self.inner.at(x)
    }

    fn lipschitz(&self) -> f64 {
        self.inner.lipschitz()
    }

    fn lower_bound(&self, cell: crate::geometry::Rect) -> f64 {
        self.inner.lower_bound(cell)
    }
}

#[test]
fn evaluations_are_counted() {
    let domain = gallery("unit-square");
    let f = Expression::new("0.05+0.5*x", domain.bounds()).unwrap();
    for tolerance in [1.0, 1e-6, 1e-8] {
        let counted = Counted {
            inner: &f,
            count: 0.into(),
        };
        start::triangles(&counted, &domain).unwrap();
        let before = counted.count.swap(0, std::sync::atomic::Ordering::Relaxed);
        let told = integrate(&counted, &domain, tolerance).unwrap().evaluations;
        assert_eq!(told, counted.count.into_inner() - before, "{tolerance}");
    }
}

#[test]
fn a_tolerance_out_of_reach_is_told_with_the_error_that_was_reached() {
    let domain = gallery("unit-square");
    let f = Expression::new("0.05+0.5*x", domain.bounds()).unwrap();
    let parts = |domain: &Domain| -> Vec<Part> {
        let triangles = start::triangles(&f, domain).unwrap().into_iter();
        triangles
            .map(|t| Part::new(&f, t, rule(&f, &t).unwrap(), 0.0).unwrap())
            .collect()
    };
    let first = parts(&domain).len() * EVALUATIONS_A_PART;
    let (reached, wanted) = (integrate(&f, &domain, 1.0).unwrap(), 1e-12);
    let told = refine(&f, parts(&domain), wanted, first - 1);
    assert_eq!(
        told,
        Err(SpacingError::NotConverged {
            tolerance: wanted,
            error: reached.error
        })
    );
    // So many are not more than so many: parts are split once more.
    let Err(SpacingError::NotConverged { error, .. }) = refine(&f, parts(&domain), wanted, first) else {
        panic!("1e-12 is out of reach");
    };
    assert!(
        error > 0.0 && error < 0.5 * reached.error,
        "{error} after {}",
        reached.error
    );
    assert!(refine(&f, parts(&domain), 1e-6, MAX_EVALUATIONS).is_ok());
    // In one round those are split that hold 60 % of the error, at four times the rule on four quarters each.
    let counted = Counted {
        inner: &f,
        count: 0.into(),
    };
    assert!(refine(&counted, parts(&domain), wanted, first).is_err());
    let errors: f64 = parts(&domain).iter().map(|part| part.error).sum();
    let split = largest(&parts(&domain), 0.6 * errors).len();
    assert_eq!(counted.count.into_inner(), split * 16 * POINTS);
    assert!(split < parts(&domain).len() / 2);
}

/// 1 / f² = (1 + ax + by)⁵ where f is this to the power of −5/2.
struct Quintic([f64; 2]);

impl Spacing for Quintic {
    fn at(&self, x: DVec2) -> f64 {
        (1.0 + self.0[0] * x.x + self.0[1] * x.y).powf(-2.5)
    }

    fn lipschitz(&self) -> f64 {
        f64::INFINITY
    }
}

#[test]
fn radons_rule_is_exact_for_degree_5() {
    // ∫ u⁵ over a triangle with u = p, q, r at its corners is 2 area · 5! / 7! · the sum of all p^i q^j r^k of degree 5.
    let exact = |triangle: &Triangle, coefficients: [f64; 2]| {
        let [p, q, r] = triangle.map(|x| 1.0 + coefficients[0] * x.x + coefficients[1] * x.y);
        let powers = (0..=5).flat_map(|i| (0..=5 - i).map(move |j| (i, j)));
        let terms = powers
            .map(|(i, j)| p.powi(i) * q.powi(j) * r.powi(5 - i - j))
            .sum::<f64>();
        let [a, b, c] = *triangle;
        (b - a).perp_dot(c - a).abs() * terms / 42.0
    };
    for corners in [
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)],
        [(2.0, 1.0), (-1.0, 3.0), (0.5, -2.0)],
        [(0.0, 3.0), (1.0, 1.0), (4.0, 1.0)],
    ] {
        let triangle = corners.map(DVec2::from);
        for coefficients in [[0.0, 0.0], [0.1, 0.05], [-0.05, 0.2]] {
            let (found, expected) = (
                rule(&Quintic(coefficients), &triangle).unwrap(),
                exact(&triangle, coefficients),
            );
            assert!((found / expected - 1.0).abs() < 1e-14, "{found}, expected {expected}");
        }
    }
}

#[test]
fn the_error_of_a_part_is_a_third_of_the_difference_and_at_least_a_fiftieth_of_what_it_inherits() {
    let triangle = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(DVec2::from);
    let f = Quintic([0.1, 0.2]);
    let whole = rule(&f, &triangle).unwrap();
    // The rule is exact here, so a value that is off by 0.3 differs from the quarters by as much, either way.
    for off in [0.3, -0.3] {
        let error = |inherited: f64| Part::new(&f, triangle, whole + off, inherited).unwrap().error;
        assert!((error(0.0) - 0.1).abs() < 1e-12 && (error(4.0) - 0.1).abs() < 1e-12 && error(50.0) == 1.0);
    }
    let part = Part::new(&f, triangle, whole, 0.0).unwrap();
    assert!((part.quarters.iter().sum::<f64>() / whole - 1.0).abs() < 1e-14);
    for (quarter, value) in part.split(&f).unwrap().iter().zip(part.quarters) {
        assert_eq!(rule(&f, &quarter.corners).unwrap(), value);
        let area = |[a, b, c]: Triangle| (b - a).perp_dot(c - a);
        assert_eq!(4.0 * area(quarter.corners), area(triangle));
    }
}

#[test]
fn the_parts_to_split_are_the_worst_that_hold_what_is_wanted() {
    let part = |error: f64| Part {
        corners: [DVec2::ZERO; 3],
        quarters: [0.0; 4],
        error,
    };
    let parts = [1.0, 4.0, 0.0, 2.0, 4.0, 1.0].map(part);
    for (wanted, expected) in [
        (0.0, &[][..]),
        (0.5, &[1]),
        (4.0, &[1]),
        (4.5, &[1, 4]),
        (8.5, &[1, 4, 3]),
        (10.5, &[1, 4, 3, 0]),
    ] {
        assert_eq!(largest(&parts, wanted), expected, "{wanted}");
    }
    // Those without an error are never split.
    assert_eq!(largest(&parts, 100.0), [1, 4, 3, 0, 5]);
}

#[test]
fn sums_lose_nothing_that_shows() {
    assert_eq!(sum([1e16, 1.0, -1e16].into_iter()), 1.0);
    assert_eq!(sum([1.0, 1e16, 1.0, -1e16].into_iter()), 2.0);
    assert_eq!(sum((0..10).map(|_| 0.1)), 1.0);
    assert_eq!(sum(std::iter::empty()), 0.0);
}

#[test]
fn f_is_looked_at_before_it_is_squared() {
    assert_eq!(checked(&Uniform(2.0), DVec2::X), Ok(2.0));
    for value in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let told = checked(&Uniform(value), DVec2::new(3.0, 4.0));
        assert!(
            matches!(told, Err(SpacingError::NotPositive { x: 3.0, y: 4.0, .. })),
            "{value}: {told:?}"
        );
    }
}

mod starting;
