//! The bounds by the rule of the later point: coverage compared with sampling, and every bound by hand.

use super::*;
use crate::theory::Claim;

fn by_later(spacing: &dyn Spacing, c_b: f64) -> Bounds<'_> {
    Bounds {
        rule: Rule::Later,
        ..bounds(spacing, c_b)
    }
}

fn coverage(domain: &Domain, mesh: &Mesh, bounds: &Bounds) -> Check {
    judge(domain, mesh, Some(bounds))
        .1
        .check(Claim::Coverage)
        .unwrap()
        .clone()
}

#[test]
fn the_middles_of_sides_are_the_last_covered() {
    // They are ½ from two corners and from the middle.
    let (square, fan) = (domain(&SQUARE, &[]), fan(p(0.5, 0.5)));
    for (c_b, holds) in [(0.5, true), (0.51, true), (0.499, false)] {
        let check = coverage(&square, &fan, &by_later(&UNIFORM, c_b));
        assert_eq!((check.holds, check.broken > 0, check.applies), (holds, !holds, true));
        assert!((check.worst.unwrap() - 0.5 / c_b).abs() < 1e-9 && check.bound == Some(1.0));
    }
}

#[test]
fn what_the_point_itself_asks_for_decides() {
    // In the middle of the left side g is 0.3. Three vertices are ½ from there, and the circle of one of them, of
    // radius 0.6, holds it.
    let spacing = Linear {
        base: 0.3,
        slope: p(0.6, 0.0),
    };
    let (square, fan) = (domain(&SQUARE, &[]), fan(p(0.5, 0.5)));
    let (earlier, later) = (bounds(&spacing, 1.0), by_later(&spacing, 1.0));
    assert!(coverage(&square, &fan, &earlier).holds && !coverage(&square, &fan, &later).holds);
    let check = coverage(&square, &fan, &later);
    assert!((check.worst.unwrap() - 5.0 / 3.0).abs() < 1e-9, "{check:?}");
    assert_eq!(check.at, Some([0.0, 0.5]));
}

#[test]
fn triangles_that_are_not_the_domain_cover_nothing() {
    let mut half = fan(p(0.5, 0.5));
    half.triangles.truncate(2);
    assert!(!coverage(&domain(&SQUARE, &[]), &half, &by_later(&UNIFORM, 1.0)).holds);
}

#[test]
fn every_bound_by_hand_for_t_a_quarter_and_c_b_a_half() {
    let spacing = Linear {
        base: 1.0,
        slope: p(0.0, 0.5),
    };
    let (_, certificate) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.5)), Some(&by_later(&spacing, 0.5)));
    for (claim, expected) in [
        (Claim::PackingDisjoint, 1.0),
        (Claim::Coverage, 1.0),
        (Claim::MinAngle, 0.375f64.asin().to_degrees()),
        (Claim::MinAngleBeyondCorners, 0.375f64.asin().to_degrees()),
        (Claim::NnVertexLower, 0.4),
        (Claim::NnVertexUpper, 4.0 / 3.0),
        (Claim::NnPointLower, 2.0 / 9.0),
        (Claim::NnPointUpper, 13.0 / 6.0),
    ] {
        let check = certificate.check(claim).unwrap();
        assert!((check.bound.unwrap() - expected).abs() < 1e-12, "{claim}: {check:?}");
    }
    assert!(!certificate.check(Claim::BoundaryHeight).unwrap().applies);
}

#[test]
fn any_t_under_1_is_enough_and_circles_may_meet_head_on() {
    let hypotheses = |t: f64| Hypotheses {
        t,
        c_b: 1.0,
        rule: Rule::Later,
        lfs_cap: true,
        smallest_segment_angle_deg: 90.0,
        low_head_on: 3,
        single_corners: true,
        is_geodesic: false,
        corners_hide: false,
    };
    assert!(hypotheses(0.99).imply(Claim::MinAngle) && !hypotheses(1.0).imply(Claim::MinAngle));
    assert!(
        hypotheses(0.5).imply(Claim::MinAngleBeyondCorners) && !hypotheses(0.6).imply(Claim::MinAngleBeyondCorners)
    );
    let acute = Hypotheses {
        smallest_segment_angle_deg: 80.0,
        ..hypotheses(0.25)
    };
    assert!(!acute.imply(Claim::MinAngle) && acute.imply(Claim::Coverage) && acute.imply(Claim::MinAngleBeyondCorners));
    let earlier = Hypotheses {
        rule: Rule::Earlier,
        ..hypotheses(0.25)
    };
    assert!(!earlier.imply(Claim::MinAngle) && earlier.imply(Claim::BoundaryHeight));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn coverage_agrees_with_dense_sampling(
        points in prop::collection::vec((0.01f64..0.99, 0.01f64..0.99), 1..25),
        base in 0.1f64..0.6, slope in (-0.15f64..0.15, -0.15f64..0.15),
    ) {
        let spacing = Linear { base: base + 0.4, slope: p(slope.0, slope.1) };
        let square = domain(&SQUARE, &[]);
        let all: Vec<DVec2> = SQUARE.into_iter().chain(points.iter().map(|&(x, y)| p(x, y))).collect();
        let pieces = (0..4u32).map(|k| Piece { a: k, b: (k + 1) % 4, segment: k }).collect();
        let mesh = triangulate(&square, all.clone(), pieces).unwrap();
        let check = coverage(&square, &mesh, &by_later(&spacing, 0.5));
        let ratio = |x: DVec2| {
            let nearest = all.iter().map(|y| y.distance(x)).fold(f64::INFINITY, f64::min);
            nearest / (0.5 * spacing.at(x))
        };
        let samples = (0..=100).flat_map(|i| (0..=100).map(move |j| p(f64::from(i), f64::from(j)) / 100.0));
        let sampled = samples.map(ratio).fold(0.0, f64::max);
        prop_assert!(check.holds || check.worst.unwrap() > 1.0);
        prop_assert!(!check.holds || sampled <= 1.0 + 1e-8, "sampled {sampled}, {check:?}");
        // One step of the grid changes the ratio only a little.
        prop_assert!(check.holds || sampled > 0.85, "sampled {sampled}, {check:?}");
        let [x, y] = check.at.unwrap();
        prop_assert!((ratio(p(x, y)) - check.worst.unwrap()).abs() < 1e-9);
    }
}
