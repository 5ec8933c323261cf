//! Every query against a loop over all segments.

use super::*;
use proptest::prelude::*;

/// Points of a coarse lattice, so that touching, collinear and horizontal cases come up all the time.
fn lattice_point() -> impl Strategy<Value = DVec2> {
    (0..12i32, 0..12i32).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)))
}

fn lattice_segments() -> impl Strategy<Value = Vec<[DVec2; 2]>> {
    prop::collection::vec([lattice_point(), lattice_point()], 0..60)
}

/// Whether two closed convex sets are disjoint, by clipping: the naive counterpart of separating axes.
fn clipped_is_empty(ends: [DVec2; 2], bounds: Rect) -> bool {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    let along = ends[1] - ends[0];
    for axis in 0..2 {
        for (limit, sign) in [(bounds.min[axis], 1.0), (bounds.max[axis], -1.0)] {
            let (start, speed) = (sign * (ends[0][axis] - limit), sign * along[axis]);
            if speed > 0.0 {
                from = from.max(-start / speed);
            } else if speed < 0.0 {
                to = to.min(start / -speed);
            } else if start < 0.0 {
                return true;
            }
        }
    }
    from > to + 1e-12
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn in_box_finds_what_a_loop_finds(segments in lattice_segments(), corners in [lattice_point(), lattice_point()]) {
        let index = SegmentIndex::new(segments.iter().copied());
        let bounds = Rect::around(corners);
        let mut found = Vec::new();
        index.in_box(bounds, |s| found.push(s));
        found.sort_unstable();
        let expected: Vec<usize> = (0..segments.len()).filter(|&s| !clipped_is_empty(segments[s], bounds)).collect();
        prop_assert_eq!(found, expected);
    }

    #[test]
    fn nearest_and_within_find_what_a_loop_finds(segments in lattice_segments(), x in lattice_point(), odd: bool) {
        let index = SegmentIndex::new(segments.iter().copied());
        let accept = |s: usize| !odd || s % 2 == 1;
        let distance = |s: usize| closest_on_segment(segments[s], x).distance(x);
        let expected = (0..segments.len()).filter(|&s| accept(s)).map(|s| (s, distance(s))).reduce(|best, next| {
            if next.1 < best.1 { next } else { best }
        });
        prop_assert_eq!(index.nearest_where(x, accept), expected);
        prop_assert_eq!(index.nearest(x), index.nearest_where(x, |_| true));
        let mut found = Vec::new();
        index.within(x, 3.0, |s, d| found.push((s, d)));
        found.sort_by_key(|&(s, _)| s);
        let expected: Vec<_> = (0..segments.len()).map(|s| (s, distance(s))).filter(|&(_, d)| d <= 3.0).collect();
        prop_assert_eq!(found, expected);
    }

    #[test]
    fn first_hit_finds_what_a_loop_finds(
        segments in lattice_segments(),
        origin in lattice_point(),
        direction in (-3..4i32, -3..4i32),
    ) {
        let direction = DVec2::new(f64::from(direction.0), f64::from(direction.1));
        // On both sides of the axes.
        let segments: Vec<[DVec2; 2]> = segments.iter().map(|ends| ends.map(|end| end - 6.0)).collect();
        let origin = origin - 6.0;
        let index = SegmentIndex::new(segments.iter().copied());
        let share = |[a, b]: [DVec2; 2]| {
            let cross = direction.perp_dot(b - a);
            let share = (a - origin).perp_dot(b - a) / cross;
            let other = (a - origin).perp_dot(direction) / cross;
            (cross != 0.0 && share >= 0.0 && (0.0..=1.0).contains(&other)).then_some(share)
        };
        // The first of equals.
        let hits = segments.iter().enumerate().filter_map(|(s, &ends)| Some((s, share(ends)?)));
        let expected = hits.reduce(|best, next| if next.1 < best.1 { next } else { best });
        prop_assert_eq!(index.first_hit(origin, direction, |_| true), expected);
    }

    /// A fan of segments that do not cross: what a point sees is what a loop over x at its height sees.
    #[test]
    fn right_of_finds_what_a_loop_finds(
        heights in prop::collection::vec((0..9i32, 0..9i32), 1..12),
        x in (-1..13i32, 0..9i32),
    ) {
        // Segment k runs within the strip k ≤ x ≤ k + 1, so no two cross; neighbours may touch.
        let segment = |(k, &(from, to)): (usize, &(i32, i32))| {
            [DVec2::new(k as f64, f64::from(from)), DVec2::new((k + 1) as f64, f64::from(to))]
        };
        let segments: Vec<[DVec2; 2]> = heights.iter().enumerate().map(segment).collect();
        let x = DVec2::new(f64::from(x.0), f64::from(x.1));
        let on: Vec<usize> =
            (0..segments.len()).filter(|&s| closest_on_segment(segments[s], x).distance(x) < 1e-12).collect();
        let crossed = |&s: &usize| {
            let [a, b] = segments[s];
            a.y.min(b.y) <= x.y && x.y < a.y.max(b.y) && a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x) > x.x
        };
        let seen = SegmentIndex::new(segments.iter().copied()).right_of(x);
        if on.is_empty() {
            let first = (0..segments.len()).find(crossed);
            let expected = first.map_or(Seen::Nothing, |s| Seen::Segment(s, segments[s][0].y < segments[s][1].y));
            prop_assert_eq!(seen, expected);
        } else {
            prop_assert!(matches!(seen, Seen::On(s) if on.contains(&s)), "{:?}", seen);
        }
    }
}

#[test]
fn the_order_of_segments_seen_is_exact() {
    // Two segments that share their upper end and differ by an ulp below: no rounded x tells them apart.
    let top = DVec2::new(1.0, 1.0);
    let (left, right) = (DVec2::new(0.1, 0.0), DVec2::new(0.1f64.next_up(), 0.0));
    for segments in [[[left, top], [right, top]], [[top, right], [top, left]]] {
        let index = SegmentIndex::new(segments);
        let Seen::Segment(s, on_left) = index.right_of(DVec2::new(-1.0, 0.999)) else {
            panic!("sees nothing")
        };
        assert!(segments[s].contains(&left));
        assert_eq!(on_left, segments[s][1] == top);
    }
}

#[test]
fn the_closest_point_is_an_end_or_the_foot() {
    let ends = [DVec2::new(1.0, 1.0), DVec2::new(5.0, 3.0)];
    for ((x, y), closest) in [
        ((0.0, 0.0), (1.0, 1.0)),
        ((2.0, -1.0), (1.0, 1.0)),
        ((2.0, 4.0), (3.0, 2.0)),
        ((5.0, -2.0), (3.0, 2.0)),
        ((4.5, 1.5), (4.0, 2.5)),
        ((4.0, 5.0), (5.0, 3.0)),
        ((9.0, 4.0), (5.0, 3.0)),
    ] {
        let found = closest_on_segment(ends, DVec2::new(x, y));
        assert!(found.distance(closest.into()) < 1e-15, "({x}, {y}): {found}");
        assert!(closest_on_segment([ends[1], ends[0]], DVec2::new(x, y)).distance(closest.into()) < 1e-15);
    }
    assert_eq!(closest_on_segment([ends[0]; 2], DVec2::ZERO), ends[0]);
}

#[test]
fn a_segment_whose_box_is_flat_is_hit() {
    for ends in [[(5.0, -1.0), (5.0, 3.0)], [(4.0, 1.0), (1.0, 1.0)]] {
        let index = SegmentIndex::new([ends.map(DVec2::from)]);
        let (s, share) = index.first_hit(DVec2::ZERO, DVec2::new(3.0, 1.0), |_| true).unwrap();
        assert!(s == 0 && (share * 3.0 - 5.0).abs().min((share - 1.0).abs()) < 1e-15);
    }
}

#[test]
fn of_segments_that_share_their_lower_end_the_left_one_is_seen() {
    let low = DVec2::new(1.0, 0.0);
    for (left, right) in [(1.0, 1.0), (1.0, 3.0), (3.0, 1.0)] {
        let fan = [[low, DVec2::new(0.5, left)], [low, DVec2::new(2.0, right)]];
        for [first, second] in [[fan[0], fan[1]], [fan[1], fan[0]]] {
            let Seen::Segment(s, _) = SegmentIndex::new([first, second]).right_of(DVec2::new(-1.0, 0.5)) else {
                panic!("sees nothing")
            };
            assert_eq!([first, second][s], fan[0], "heights {left} and {right}");
        }
    }
}
