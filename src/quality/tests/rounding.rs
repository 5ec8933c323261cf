//! A claim holds if its value misses the bound by less than a share of a billionth; it breaks if the value misses by
//! more.

use super::*;
use crate::theory::Claim;

fn holds(domain: &Domain, mesh: &Mesh, spacing: &dyn Spacing, c_b: f64, claim: Claim) -> bool {
    judge(domain, mesh, Some(&bounds(spacing, c_b)))
        .1
        .check(claim)
        .unwrap()
        .holds
}

/// A triangle with an angle of 30° less a share.
fn thirty(share: f64, shift: DVec2) -> [DVec2; 3] {
    [
        p(0.0, 0.0),
        p(1.0, 0.0),
        p(1.0, (30.0 * (1.0 - share)).to_radians().tan()),
    ]
    .map(|x| x + shift)
}

#[test]
fn the_smallest_angle_may_be_a_billionth_under_the_bound() {
    for (share, expected) in [(0.9e-9, true), (1.1e-9, false)] {
        let points = [&SQUARE[..], &thirty(share, DVec2::ZERO)].concat();
        let one = mesh(&points, &[[4, 5, 6]]);
        for claim in [Claim::MinAngle, Claim::MinAngleBeyondCorners] {
            assert_eq!(
                holds(&domain(&SQUARE, &[]), &one, &UNIFORM, 0.5, claim),
                expected,
                "{claim} {share}"
            );
        }
    }
}

#[test]
fn an_angle_at_a_corner_may_be_a_billionth_and_the_rounding_of_its_shortest_side_under_the_input_angle() {
    // At 2^20, four ulp over the shortest side, which is tan 30°, are another 1.61e-9.
    for (shift, room) in [(0.0, 1e-9), ((1u32 << 20) as f64, 2.61e-9)] {
        let shift = DVec2::splat(shift);
        let domain = domain(&thirty(0.0, shift), &[]);
        for (share, expected) in [(0.8, true), (1.2, false)] {
            let points = [&thirty(0.0, shift)[..], &thirty(share * room, shift)[2..]].concat();
            for corners in [[0, 1, 3], [1, 3, 0], [3, 0, 1]] {
                let found = holds(&domain, &mesh(&points, &[corners]), &UNIFORM, 0.3, Claim::CornerAngles);
                assert_eq!(found, expected, "{share} of the room at {shift}");
            }
        }
    }
}

#[test]
fn circles_may_meet_a_billionth_lower_than_9() {
    // With t = 0, circles of radius ⅓ around points ½ apart meet at √7 / 4 of their radius. If the radius is smaller by
    // a share, they meet lower by 9/7 of that share.
    let cut = mesh(
        &[&SQUARE[..], &[p(0.5, 0.0)]].concat(),
        &[[0, 4, 3], [4, 2, 3], [4, 1, 2]],
    );
    for (share, expected) in [(0.7e-9, true), (0.85e-9, false)] {
        let c_b = (1.0 - share) / 3.0;
        assert_eq!(
            holds(&domain(&SQUARE, &[]), &cut, &UNIFORM, c_b, Claim::BoundaryHeight),
            expected,
            "{share}"
        );
    }
    // Uncut sides whose circles meet as low are counted apart.
    for (share, expected) in [(0.7e-9, 0), (0.85e-9, 4)] {
        let c_b = 2.0 * (1.0 - share) / 3.0;
        let (_, certificate) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.5)), Some(&bounds(&UNIFORM, c_b)));
        assert_eq!(certificate.low_head_on, expected, "{share}");
    }
}

#[test]
fn heights_are_over_the_smaller_radius() {
    // The sides at the left and right are so short that their circles meet high.
    let ring = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 0.1), p(0.0, 0.1)];
    let cut = mesh(
        &[&ring[..], &[p(0.5, 0.0)]].concat(),
        &[[0, 4, 3], [4, 2, 3], [4, 1, 2]],
    );
    let graded = Linear {
        base: 1.0,
        slope: p(1.0, 0.0),
    };
    let (_, certificate) = judge(&domain(&ring, &[]), &cut, Some(&bounds(&graded, 0.5)));
    let check = certificate.check(Claim::BoundaryHeight).unwrap();
    // Along the upper side the radii are ½ and 1: by Pythagoras the foot is ⅛ behind the first. Around (½, 0) and (1,
    // 0) the radii are ¾ and 1: the foot is 3/16 before the first, and the height is the same share. Elsewhere circles
    // meet higher.
    let height = (0.25f64 - 1.0 / 64.0).sqrt() / 0.5;
    assert!(
        (check.worst.unwrap() - height).abs() < 1e-12,
        "{check:?}, expected {height}"
    );
}
