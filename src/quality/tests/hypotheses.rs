//! What the bounds need, up to the limits.

use super::*;
use crate::domain::InputSegment;
use crate::theory::Claim;
use crate::theory::{FLAT_T, GEODESIC_T, Promises};

const RIGHT: Hypotheses = Hypotheses {
    t: 0.3,
    c_b: 0.5,
    rule: Rule::Earlier,
    lfs_cap: true,
    smallest_segment_angle_deg: 90.0,
    low_head_on: 0,
    single_corners: true,
    is_geodesic: false,
    corners_hide: false,
};

/// The claims that do not follow from some hypotheses.
fn missing(hypotheses: Hypotheses) -> Vec<Claim> {
    CLAIMS.into_iter().filter(|claim| !hypotheses.imply(*claim)).collect()
}

#[test]
fn every_claim_needs_what_the_table_says() {
    let angles = [Claim::BoundaryHeight, Claim::MinAngle];
    let of_section_6 = [angles[0], angles[1], Claim::MinAngleBeyondCorners];
    let of_packing = [
        Claim::PackingDisjoint,
        Claim::BoundaryHeight,
        Claim::MinAngle,
        Claim::MinAngleBeyondCorners,
        Claim::NnVertexLower,
        Claim::NnVertexUpper,
        Claim::NnPointLower,
        Claim::NnPointUpper,
        Claim::VerticesUpper,
    ];
    let third = 1.0 / 3.0f64;
    for (hypotheses, expected) in [
        (RIGHT, &[][..]),
        (Hypotheses { t: third, ..RIGHT }, &[]),
        (
            Hypotheses {
                t: third.next_up(),
                ..RIGHT
            },
            &of_section_6,
        ),
        (Hypotheses { c_b: 1.0, ..RIGHT }, &[]),
        (
            Hypotheses {
                c_b: 1f64.next_up(),
                ..RIGHT
            },
            &of_packing,
        ),
        (
            Hypotheses {
                lfs_cap: false,
                ..RIGHT
            },
            &of_packing,
        ),
        (
            Hypotheses {
                low_head_on: 1,
                ..RIGHT
            },
            &[Claim::MinAngle],
        ),
        (
            Hypotheses {
                single_corners: false,
                ..RIGHT
            },
            &[Claim::CornerAngles],
        ),
        (
            Hypotheses {
                smallest_segment_angle_deg: 90.0 - 0.9e-6,
                ..RIGHT
            },
            &[],
        ),
        (
            Hypotheses {
                smallest_segment_angle_deg: 90.0 - 1.1e-6,
                ..RIGHT
            },
            &angles,
        ),
    ] {
        assert_eq!(missing(hypotheses), expected, "{hypotheses:?}");
    }
    // At t = 1 only the claims that need nothing of t are left; just below, only those that need t ≤ 1/3 are missing.
    let steep = Hypotheses {
        t: 1f64.next_down(),
        ..RIGHT
    };
    assert_eq!(missing(steep), of_section_6);
    for t in [1.0, 1.5] {
        let left = CLAIMS
            .into_iter()
            .filter(|claim| Hypotheses { t, ..RIGHT }.imply(*claim));
        assert_eq!(
            left.collect::<Vec<_>>(),
            [Claim::PackingDisjoint, Claim::CornerAngles, Claim::VerticesUpper]
        );
    }
}

/// With a flat spacing the bound beyond corners follows only if no corner has to be cut off.
#[test]
fn corners_of_a_flat_spacing_can_be_cut_only_where_circles_leave_room_and_no_angle_is_small() {
    let holds = |hypotheses: Hypotheses| hypotheses.imply(Claim::MinAngleBeyondCorners);
    let flat = Hypotheses { t: 0.03125, ..RIGHT };
    assert!(holds(flat) && holds(Hypotheses { c_b: 0.96875, ..flat }));
    assert!(!holds(Hypotheses { c_b: 0.97, ..flat }));
    assert!(!holds(Hypotheses {
        smallest_segment_angle_deg: 80.0,
        ..flat
    }));
    for t in [FLAT_T, 0.3] {
        assert!(holds(Hypotheses {
            t,
            c_b: 0.97,
            smallest_segment_angle_deg: 80.0,
            ..RIGHT
        }));
    }
}

#[test]
fn hypotheses_are_those_of_domain_and_spacing() {
    let spacing = Linear {
        base: 1.0,
        slope: p(0.3, 0.4),
    };
    let square = domain(&SQUARE, &[]);
    let bounds = Bounds {
        lfs_cap: false,
        ..bounds(&spacing, 0.25)
    };
    let expected = Hypotheses {
        t: 0.125,
        c_b: 0.25,
        lfs_cap: false,
        low_head_on: 7,
        ..RIGHT
    };
    assert_eq!(hypotheses(&square, &bounds, 7), expected);
    // A vertex with two angles inside is single only if both are 90° or more.
    let single = |domain: &Domain| hypotheses(domain, &bounds, 0).single_corners;
    assert!(!single(&domain(&SQUARE, &[SQUARE[0], SQUARE[2]])));
    let ring = [SQUARE[0], p(0.5, 0.0), SQUARE[1], SQUARE[2], p(0.5, 1.0), SQUARE[3]];
    assert!(single(&domain(&ring, &[ring[1], ring[4]])));
    assert!(!single(&domain(&ring, &[ring[0], ring[4]])));
}

#[test]
fn the_angle_bound_is_that_of_theorem_6_8() {
    let bounds = [0.0, 0.25, 0.5, 0.75].map(|t| Promises { rule: Rule::Earlier, t }.min_angle_deg());
    let expected = [30.0, 14.477_512_185_929_925, 0.0, 0.0];
    for (found, expected) in bounds.into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}

#[test]
fn a_certificate_lists_what_applies_and_does_not_hold() {
    let check = |claim: Claim, applies, holds| Check {
        claim,
        lemma: String::new(),
        applies,
        worst: None,
        bound: None,
        holds,
        broken: usize::from(!holds),
        at: None,
        witnesses: Vec::new(),
    };
    let checks = vec![
        check(Claim::Area, true, true),
        check(Claim::Coverage, true, false),
        check(Claim::MinAngle, false, false),
        check(Claim::CornerAngles, false, true),
    ];
    let certificate = Certificate {
        holds: false,
        excused: 0,
        low_head_on: 0,
        checks,
    };
    assert_eq!(
        certificate.broken().map(|check| check.claim).collect::<Vec<_>>(),
        [Claim::Coverage]
    );
    assert_eq!(certificate.check(Claim::MinAngle), Some(&certificate.checks[2]));
    assert_eq!(certificate.check(Claim::VerticesUpper), None);
}

#[test]
fn checks_apply_only_under_their_hypotheses() {
    let implied = |hypotheses: Hypotheses| CLAIMS.into_iter().filter(|claim| hypotheses.imply(*claim)).count();
    assert_eq!(implied(RIGHT), 12);
    assert_eq!(
        implied(Hypotheses {
            low_head_on: 1,
            ..RIGHT
        }),
        11
    );
    assert_eq!(
        implied(Hypotheses {
            smallest_segment_angle_deg: 80.0,
            ..RIGHT
        }),
        10
    );
    assert_eq!(implied(Hypotheses { t: 0.4, ..RIGHT }), 9);
    assert_eq!(implied(Hypotheses { c_b: 1.2, ..RIGHT }), 3);
    assert_eq!(
        implied(Hypotheses {
            lfs_cap: false,
            ..RIGHT
        }),
        3
    );
    assert_eq!(implied(Hypotheses { t: 1.0, ..RIGHT }), 3);
    let flat = Hypotheses { t: 0.04, ..RIGHT };
    let flat_and_acute = Hypotheses {
        smallest_segment_angle_deg: 80.0,
        single_corners: false,
        ..flat
    };
    assert_eq!(implied(flat), 12);
    assert!(!flat_and_acute.imply(Claim::MinAngleBeyondCorners) && !flat_and_acute.imply(Claim::CornerAngles));
    let (square, good) = (domain(&SQUARE, &[]), fan(p(0.5, 0.5)));
    let none = Bounds {
        guaranteed: &[],
        ..bounds(&UNIFORM, 0.3)
    };
    let (_, certificate) = judge(&square, &good, Some(&none));
    assert!(certificate.holds && !certificate.check(Claim::Coverage).unwrap().holds);
}

#[test]
fn distances_inside_the_domain_need_a_small_t_and_the_rule_of_the_paper() {
    let inside = Hypotheses {
        is_geodesic: true,
        ..RIGHT
    };
    assert_eq!(missing(inside), missing(RIGHT));
    let steep = Hypotheses {
        t: 1.001 * GEODESIC_T,
        ..inside
    };
    let later = Hypotheses {
        rule: Rule::Later,
        ..inside
    };
    let hiding = Hypotheses {
        corners_hide: true,
        ..inside
    };
    for none in [steep, later, hiding] {
        assert_eq!(missing(none), CLAIMS);
    }
    // The largest t itself is enough.
    assert_ne!(
        missing(Hypotheses {
            t: GEODESIC_T,
            ..inside
        }),
        CLAIMS
    );
    assert_eq!(
        missing(Hypotheses {
            corners_hide: true,
            ..RIGHT
        }),
        missing(RIGHT)
    );
}

/// A vertex with corners of 45° and 225° inside and two angles of 45° outside; and one without the larger corner.
#[test]
fn a_corner_hides_what_lies_behind_it_where_the_angle_outside_is_below_180_degrees() {
    let bounds = bounds(&UNIFORM, 0.5);
    let hides = |domain: &Domain| hypotheses(domain, &bounds, 0).corners_hide;
    let corner = |ends: &[(f64, f64)]| {
        let mut pslg = Pslg::new("corner");
        pslg.add_ring(ends.iter().map(|&(x, y)| DVec2::new(x, y)), 1);
        Domain::new(pslg).expect("a valid domain")
    };
    assert!(!hides(&corner(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0)])));
    // No corner is cut off at a vertex with an angle of about 200° inside.
    assert!(!hides(&corner(&[(0.0, 0.0), (-3.0, -1.0), (0.0, 4.0), (3.0, -1.0)])));
    let two_rings = |first: &[(f64, f64)], others: &[(f64, f64)]| {
        let mut pslg = Pslg::new("two corners");
        pslg.add_ring(first.iter().copied().map(DVec2::from), 1);
        let others: Vec<usize> = others.iter().map(|&x| pslg.add_vertex(x.into())).collect();
        let ring: Vec<usize> = std::iter::once(0).chain(others).collect();
        let sides = (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()]));
        pslg.segments
            .extend(sides.map(|(a, b)| InputSegment { a, b, marker: 1 }));
        Domain::new(pslg).expect("a valid domain")
    };
    // Nor at a vertex where two squares meet.
    let squares = two_rings(
        &[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)],
        &[(-2.0, 0.0), (-2.0, -2.0), (0.0, -2.0)],
    );
    assert!(!hides(&squares));
    // Outside a straight side nothing hides, although an inner segment makes a corner on it.
    let mut pslg = Pslg::new("on a side");
    pslg.add_ring(
        [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (-2.0, 2.0), (-2.0, 0.0)].map(DVec2::from),
        1,
    );
    pslg.segments.push(InputSegment { a: 0, b: 2, marker: 1 });
    assert!(!hides(&Domain::new(pslg).expect("a valid domain")));
    let corners = two_rings(
        &[(0.0, 0.0), (2.0, -0.8), (2.0, 0.8)],
        &[(1.0, 1.0), (-2.0, 2.0), (-2.0, -2.0), (1.0, -1.0)],
    );
    assert!(hides(&corners));
}
