//! Arcs, stretches and triangles that discs cover, compared with sampling.

use super::*;
use crate::domain::gallery;
use proptest::prelude::*;

fn uncovered_stretch(ends: [DVec2; 2], circles: &DiscTree) -> (f64, DVec2) {
    super::uncovered_stretch(ends, circles, |_, _| true)
}

fn disc(x: f64, y: f64, radius: f64) -> Disc {
    Disc {
        centre: DVec2::new(x, y),
        radius,
        id: 0,
    }
}

fn tree(discs: &[(f64, f64, f64)]) -> DiscTree {
    DiscTree::new(discs.iter().map(|&(x, y, radius)| (DVec2::new(x, y), radius)))
}

fn unit_square() -> Domain {
    gallery::domain("unit-square").unwrap().unwrap()
}

const SAMPLES: usize = 720;
const STEP: f64 = TAU / SAMPLES as f64;

/// Angles in [−π, π) all around a circle.
fn around() -> impl Iterator<Item = f64> {
    (0..SAMPLES).map(|k| (k as f64 + 0.5) * STEP - PI)
}

fn is_within(angle: f64, (from, to): (f64, f64)) -> bool {
    [angle, angle + TAU].iter().any(|angle| (from..=to).contains(angle))
}

/// The longest run of samples that are `open`, in a row or around a circle.
fn longest_run(open: &[bool], is_circle: bool) -> usize {
    let twice = [open, if is_circle { open } else { &[] }].concat();
    let runs = twice.split(|is_open| !is_open).map(<[bool]>::len);
    runs.max().unwrap_or(0).min(open.len())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn the_covered_part_of_a_circle_is_where_its_points_are_covered(
        x in -2.0f64..2.0, y in -2.0f64..2.0, radius in 0.05f64..3.0,
    ) {
        let (disc, other) = (disc(0.3, -0.2, 1.0), disc(x, y, radius));
        prop_assume!(disc.centre.distance(other.centre) <= disc.radius + other.radius);
        let arc = covered_arc(&disc, &other);
        if let Arc::Part(from, to) = arc {
            prop_assert!((-PI..PI).contains(&from) && from <= to && to <= from + TAU);
        }
        for angle in around() {
            let point = disc.centre + disc.radius * DVec2::from_angle(angle);
            let depth = other.radius - point.distance(other.centre);
            let is_covered = match arc {
                Arc::None => false,
                Arc::All => true,
                Arc::Part(from, to) => is_within(angle, (from, to)),
            };
            prop_assert!(depth.abs() < 1e-9 || is_covered == (depth > 0.0), "at {angle}");
        }
    }

    #[test]
    fn the_largest_gap_is_the_longest_run_of_uncovered_samples(
        arcs in prop::collection::vec((-PI..PI, 0.01f64..2.5), 1..7),
    ) {
        let mut arcs: Vec<(f64, f64)> = arcs.into_iter().map(|(from, length)| (from, from + length)).collect();
        let open: Vec<bool> = around().map(|angle| arcs.iter().all(|&arc| !is_within(angle, arc))).collect();
        let expected = longest_run(&open, true) as f64 * STEP;
        let found = largest_gap(&disc(0.5, 0.5, 0.4), &mut arcs, &unit_square());
        prop_assert!((found - expected).abs() <= 1.001 * STEP, "{found}, sampled {expected}");
        // Outside the domain nothing need be covered.
        prop_assert_eq!(largest_gap(&disc(5.0, 0.5, 0.4), &mut arcs, &unit_square()), 0.0);
    }

    #[test]
    fn the_uncovered_stretch_is_the_longest_run_of_uncovered_samples(
        discs in prop::collection::vec((-0.3f64..1.3, -0.3f64..0.3, 0.02f64..0.4), 0..8),
    ) {
        let (a, b) = (DVec2::new(1.0, 2.0), DVec2::new(4.0, 6.0));
        let along = b - a;
        let place = |x: f64, y: f64| a + x * along + y * along.perp();
        let discs: Vec<_> = discs.into_iter().map(|(x, y, radius)| (place(x, y), 5.0 * radius)).collect();
        let (found, at) = uncovered_stretch([a, b], &DiscTree::new(discs.iter().copied()));
        let is_open = |share: f64| discs.iter().all(|(centre, radius)| place(share, 0.0).distance(*centre) > *radius);
        let open: Vec<bool> = (0..SAMPLES).map(|k| is_open((k as f64 + 0.5) / SAMPLES as f64)).collect();
        let expected = longest_run(&open, false) as f64 / SAMPLES as f64;
        prop_assert!((found - expected).abs() <= 1.001 / SAMPLES as f64, "{found}, sampled {expected}");
        if found > 0.0 {
            let middle = (at - a).dot(along) / along.length_squared();
            prop_assert!(place(middle, 0.0).distance(at) < 1e-12);
            for share in [-0.499, -0.25, 0.0, 0.25, 0.499] {
                prop_assert!(is_open(middle + share * found), "{middle} {share} {found}");
            }
        }
    }

    #[test]
    fn a_circle_passes_through_the_places_that_are_no_further_from_it_than_their_radius(
        radius in 0.1f64..2.0, places in prop::collection::vec((-2.0f64..2.0, -2.0f64..2.0, 0.0f64..0.3), 0..4),
    ) {
        let disc = disc(0.1, 0.2, radius);
        let away = |x: f64, y: f64| (disc.centre.distance(DVec2::new(x, y)) - radius).abs();
        let expected = places.iter().any(|&(x, y, reach)| away(x, y) <= reach);
        prop_assert_eq!(passes_through(&disc, &tree(&places)), expected);
    }

    #[test]
    fn a_triangle_counts_as_covered_if_its_points_are_covered_with_room_to_spare(
        discs in prop::collection::vec((-0.2f64..1.2, -0.2f64..1.2, 0.1f64..0.9), 1..7),
    ) {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let covered = |room: f64| {
            let samples = (0..=40).flat_map(|i| (0..=40 - i).map(move |j| DVec2::new(f64::from(i), f64::from(j)) / 40.0));
            samples.into_iter().all(|s| discs.iter().any(|&(x, y, r)| s.distance(DVec2::new(x, y)) <= r - room))
        };
        let found = is_covered(corners, &tree(&discs), QUARTERINGS);
        prop_assert!(!found || covered(0.0));
        // A sample is within 0.02 of any point, a part within 0.012 of its middle.
        prop_assert!(found || !covered(0.035));
    }
}

#[test]
fn a_triangle_is_quartered_no_more_often_than_asked() {
    let corners = [DVec2::ZERO, DVec2::X, DVec2::Y];
    // The furthest corner is √5 / 3 from the centroid.
    let one = |radius: f64| is_covered(corners, &tree(&[(1.0 / 3.0, 1.0 / 3.0, radius)]), 0);
    assert!(one(0.746) && !one(0.745));
    // Discs around the middles of the four quarters: as large as half the triangle's own.
    let middles = [(1.0, 1.0), (4.0, 1.0), (1.0, 4.0), (2.0, 2.0)];
    let four: Vec<_> = middles.iter().map(|&(x, y)| (x / 6.0, y / 6.0, 0.373)).collect();
    assert!(!is_covered(corners, &tree(&four), 0) && is_covered(corners, &tree(&four), 1));
    for without in 0..4 {
        let mut three = four.clone();
        three.remove(without);
        assert!(!is_covered(corners, &tree(&three), 1), "without {without}");
    }
}

#[test]
fn the_disc_around_a_triangle_is_around_its_centroid_and_through_its_furthest_corner() {
    for turned in 0..3 {
        let corners = [0, 1, 2].map(|k| [(0.0, 0.0), (6.0, 0.0), (0.0, 3.0)][(k + turned) % 3]);
        let (centre, radius) = disc_around(corners.map(DVec2::from));
        assert!(centre.distance(DVec2::new(2.0, 1.0)) < 1e-15 && (radius - 17f64.sqrt()).abs() < 1e-14);
    }
}

#[test]
fn what_touches_counts_as_covered_and_as_passed_through() {
    let unit = disc(0.0, 0.0, 1.0);
    assert!(passes_through(&unit, &tree(&[(0.5, 0.0, 0.5)])) && passes_through(&unit, &tree(&[(1.5, 0.0, 0.5)])));
    assert!(!passes_through(&unit, &tree(&[(0.5, 0.0, 0.4375)])) && !passes_through(&unit, &tree(&[])));
    assert!(matches!(covered_arc(&unit, &disc(1.0, 0.0, 2.0)), Arc::All));
    assert!(matches!(covered_arc(&unit, &disc(0.5, 0.0, 0.5)), Arc::None));
    // A disc that touches a segment covers one point of it.
    let ends = [DVec2::ZERO, DVec2::X];
    assert_eq!(uncovered_stretch(ends, &tree(&[(0.5, 0.25, 0.25)])).0, 0.5);
    assert_eq!(uncovered_stretch(ends, &tree(&[])), (1.0, DVec2::new(0.5, 0.0)));
    assert_eq!(
        uncovered_stretch(ends, &tree(&[(0.0, 0.0, 0.5), (1.0, 0.0, 0.5)])).0,
        0.0
    );
    // Of equal stretches the first.
    assert_eq!(
        uncovered_stretch(ends, &tree(&[(0.5, 0.0, 0.25)])),
        (0.25, DVec2::new(0.125, 0.0))
    );
    let all = uncovered_stretch(ends, &tree(&[(0.0, 0.0, 0.5), (1.0, 0.0, 0.5)]));
    assert_eq!(all, (0.0, DVec2::new(0.5, 0.0)));
    // Radii 4 and 5 around centres 3 apart: half the circle, from −π on.
    let half = covered_arc(&disc(0.0, 0.0, 4.0), &disc(0.0, -3.0, 5.0));
    assert!(matches!(half, Arc::Part(from, to) if from == -PI && to == 0.0));
    let beside = uncovered_stretch(ends, &tree(&[(0.0, 0.0, 0.25), (1.0, 0.0, 0.25)]));
    assert_eq!(beside, (0.5, DVec2::new(0.5, 0.0)));
}

#[test]
fn a_circle_that_meets_no_disc_is_a_whole_gap_inside_the_domain_and_none_outside() {
    let square = unit_square();
    assert_eq!(largest_gap(&disc(0.5, 0.5, 0.25), &mut [], &square), TAU);
    assert_eq!(largest_gap(&disc(0.5, 0.5, 2.0), &mut [], &square), 0.0);
    // Around a point of the left side: the part to the left of it, from ½π on, does not count.
    let mut arcs = [(0.5, 0.5 * PI), (-0.5 * PI, -0.5)];
    assert_eq!(largest_gap(&disc(0.0, 0.5, 0.4), &mut arcs, &square), 1.0);
}
