//! The paper's bounds and the values compared with them, on meshes small enough to work out.

use super::*;
use crate::theory::Claim;

fn check(domain: &Domain, mesh: &Mesh, bounds: &Bounds, claim: Claim) -> Check {
    judge(domain, mesh, Some(bounds)).1.check(claim).unwrap().clone()
}

fn assert_near(found: Option<f64>, expected: f64, what: impl std::fmt::Display) {
    let found = found.unwrap_or(f64::NAN);
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
        "{what}: {found}, expected {expected}"
    );
}

#[test]
fn every_bound_is_what_the_paper_says_for_t_a_quarter_and_c_b_a_half() {
    let spacing = Linear {
        base: 1.0,
        slope: p(0.0, 0.5),
    };
    let bounds = Bounds {
        integral: Some(Integral {
            value: 2.0,
            error: 0.25,
            evaluations: 0,
        }),
        ..bounds(&spacing, 0.5)
    };
    let (_, certificate) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.5)), Some(&bounds));
    for (claim, expected) in [
        (Claim::PackingDisjoint, 1.0),
        (Claim::Coverage, 0.0),
        // (9): ¾ √((1/16 − 1 + 7) (1 − 1/16)) / 4.
        (Claim::BoundaryHeight, 0.75 * (97f64 * 15.0).sqrt() / 64.0),
        (Claim::MinAngle, 0.25f64.asin().to_degrees()),
        (Claim::MinAngleBeyondCorners, 0.25f64.asin().to_degrees()),
        (Claim::CornerAngles, 1.0),
        (Claim::NnVertexLower, 0.375),
        (Claim::NnVertexUpper, 4.0 / 3.0),
        (Claim::NnPointLower, 0.2),
        (Claim::NnPointUpper, 22.0 / 9.0),
        // (9/16) · 2 / (π / 4) less a quarter, and 4 · (25/16) · 2 / (π / 4) plus a quarter.
        (Claim::VerticesLower, 3.375 / std::f64::consts::PI),
        (Claim::VerticesUpper, 62.5 / std::f64::consts::PI),
    ] {
        assert_near(certificate.check(claim).unwrap().bound, expected, claim);
    }
}

#[test]
fn without_t_under_1_there_is_no_upper_bound() {
    for (slope, is_bounded) in [(0.875, true), (1.0, false), (2.0, false)] {
        let spacing = Linear {
            base: 1.0,
            slope: p(0.0, slope),
        };
        let (_, certificate) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.5)), Some(&bounds(&spacing, 1.0)));
        for claim in [Claim::NnVertexUpper, Claim::NnPointUpper] {
            let check = certificate.check(claim).unwrap();
            assert_eq!(check.bound.is_some(), is_bounded, "{claim}, t = {slope}");
            assert!(check.holds && check.applies == is_bounded);
        }
        let lowest = certificate.check(Claim::VerticesLower).unwrap().bound;
        assert_near(
            lowest,
            (1.0 - slope).max(0.0).powi(2) / std::f64::consts::PI,
            Claim::VerticesLower,
        );
        assert_eq!(certificate.check(Claim::VerticesLower).unwrap().applies, is_bounded);
    }
}

/// At a vertex, nn is the distance to the nearest other vertex; elsewhere, to the second nearest.
#[test]
fn ratios_of_nn_are_those_of_a_graded_spacing() {
    let spacing = Linear {
        base: 1.0,
        slope: p(0.0, 0.5),
    };
    let (square, fan) = (domain(&SQUARE, &[]), fan(p(0.5, 0.5)));
    let worst = |claim: Claim| check(&square, &fan, &bounds(&spacing, 0.5), claim).worst;
    let half = 0.5f64.sqrt();
    assert_near(worst(Claim::NnVertexLower), half / 1.5, "upper corners");
    assert_near(worst(Claim::NnVertexUpper), half, "lower corners");
    // Middles of spokes at heights ¼ and ¾, of sides at 0, ½ and 1, which are circumcentres too.
    assert_near(worst(Claim::NnPointLower), 0.5 * half / 1.375, "upper spokes");
    assert_near(worst(Claim::NnPointUpper), 0.5, "the lower side");
    // c_p = ½ / (2 + ¼), and for their size the upper corners are nearest to the middle.
    assert_near(worst(Claim::PackingDisjoint), half / (2.0 / 9.0 * 2.75), "upper spokes");
}

#[test]
fn centres_are_granted_the_rounding_of_their_coordinates() {
    let half = 0.5f64.sqrt();
    // The relative room is a billionth and, at coordinates of a million, 10 ulp (2.22e-9) over what they are compared
    // with.
    for (claim, c_b, at_origin, far_away) in [
        (Claim::PackingDisjoint, half, 1e-9, 4.14e-9),
        (Claim::NnVertexLower, half, 1e-9, 4.14e-9),
        (Claim::NnVertexUpper, -0.5 * half, 1e-9, 4.14e-9),
        (Claim::NnPointLower, half, 1e-9, 7.28e-9),
        (Claim::NnPointUpper, -0.5 / 3.0, 1e-9, 5.44e-9),
    ] {
        for (shift, room) in [(0.0, at_origin), (1e6, far_away)] {
            let far = |points: &[DVec2]| points.iter().map(|x| *x + DVec2::splat(shift)).collect::<Vec<_>>();
            let mut mesh = fan(p(0.5, 0.5));
            mesh.points = far(&mesh.points);
            let square = domain(&far(&SQUARE), &[]);
            // c_b is negative for claims that break as it falls; only the product of c_b and f counts.
            for (share, holds, f) in [
                (0.95, true, 1.0),
                (1.05, false, 1.0),
                (0.95, true, 4.0),
                (1.05, false, 4.0),
            ] {
                let c_b = c_b.abs() / f * (1.0 + c_b.signum() * share * room);
                let spacing = Linear { base: f, ..UNIFORM };
                let found = check(&square, &mesh, &bounds(&spacing, c_b), claim);
                assert_eq!(found.holds, holds, "{claim} at {shift}, {share} of the room: {found:?}");
            }
        }
    }
}

/// Vertices count by the share of their packing circles that surely lies in the domain.
#[test]
fn packing_circles_count_by_what_surely_lies_inside() {
    let shares = |ring: &[DVec2], inner: &[DVec2], points: &[DVec2], c_b: f64| {
        let (domain, mesh) = (domain(ring, inner), mesh(&[ring, points].concat(), &[]));
        check(&domain, &mesh, &bounds(&UNIFORM, c_b), Claim::VerticesUpper).worst
    };
    // c_p = 0.1. The four corners together make one circle.
    assert_near(shares(&SQUARE, &[], &[], 0.2), 1.0, "corners");
    for (point, share) in [
        (p(0.5, 0.5), 1.0),
        (p(0.5, 0.0), 0.5),
        (p(0.5, 0.05), 0.5),
        (p(0.05, 0.5), 0.5),
        (p(0.5, 0.101), 1.0),
        (p(0.05, 0.06), 0.0),
    ] {
        assert_near(shares(&SQUARE, &[], &[point], 0.2), 1.0 + share, point.to_string());
    }
    // Segments inside the domain do not count; at the ends of one, its two angles do.
    let across = [SQUARE[0], SQUARE[2]];
    assert_near(
        shares(&SQUARE, &across, &[p(0.5, 0.5)], 0.2),
        2.0,
        "on an inner segment",
    );
    // Circles of corners that meet further sides may lie outside.
    assert_near(shares(&SQUARE, &[], &[], 2.5), 0.0, "large circles");
    let bar = [p(0.0, 0.0), p(9.0, 0.0), p(9.0, 0.5), p(0.0, 0.5), p(0.0, 0.2)];
    // Corners below and right count a quarter, the straight one a half; those 0.3 and 0.2 from it meet a third side or do not.
    assert_near(shares(&bar, &[], &[], 0.3), 1.5, "a straight corner");
    assert_near(shares(&bar, &[], &[], 0.5), 0.75, "a third side");
    assert_near(shares(&L, &[], &[], 0.2), 5.0 * 0.25 + 0.75, "an inward corner");
    // With a graded spacing, t = 1 and so c_p = 1/6. At (½, y), f = 1 + 2y: the circle meets the lower side up to y =
    // ¼, and not above.
    let graded = Linear {
        base: 1.0,
        slope: p(0.0, 2.0),
    };
    for (y, share) in [(0.2, 0.5), (0.24, 0.5), (0.26, 1.0), (0.3, 1.0)] {
        let points = [&SQUARE[..], &[p(0.5, y)]].concat();
        let found = check(
            &domain(&SQUARE, &[]),
            &mesh(&points, &[]),
            &bounds(&graded, 0.5),
            Claim::VerticesUpper,
        )
        .worst;
        assert_near(found, 1.0 + share, "graded");
    }
}

#[test]
fn angles_at_a_corner_are_compared_with_the_smallest_input_angle_there() {
    // Half of an equilateral triangle: input angles of 30°, 60° and 90°.
    let half = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0 / 3f64.sqrt())];
    let domain = domain(&half, &[]);
    let corner = |points: &[DVec2], triangles: &[[u32; 3]]| {
        let (_, certificate) = judge(&domain, &mesh(points, triangles), Some(&bounds(&UNIFORM, 0.3)));
        certificate.check(Claim::CornerAngles).unwrap().clone()
    };
    let whole = corner(&half, &[[0, 1, 2]]);
    assert!(
        whole.holds && whole.applies && (whole.worst.unwrap() - 1.0).abs() < 1e-12,
        "{whole:?}"
    );
    let split = corner(
        &[half[0], half[1], half[2], p(1.0, (15f64).to_radians().tan())],
        &[[0, 1, 3], [0, 3, 2]],
    );
    assert!(
        !split.holds && split.broken == 2 && (split.worst.unwrap() - 0.5).abs() < 1e-12,
        "{split:?}"
    );
}
