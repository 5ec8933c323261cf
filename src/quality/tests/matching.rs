//! How a domain is found in a mesh, and how far coordinates may be off.

use super::*;
use crate::quality::boundary::Boundary;
use crate::theory::Claim;

/// What is broken if the lower side of the square is cut at a point near (½, 0).
fn cut_at(middle: DVec2, shift: DVec2) -> Vec<Claim> {
    let ring = SQUARE.map(|x| x + shift);
    let points = [&ring[..], &[middle + shift]].concat();
    broken(
        &domain(&ring, &[]),
        &mesh(&points, &[[0, 4, 3], [4, 2, 3], [4, 1, 2]]),
        None,
    )
}

#[test]
fn a_piece_lies_along_its_segment_to_a_billionth_of_its_length() {
    let off = [Claim::InputSegments, Claim::BoundaryOnSegments];
    for sign in [1.0, -1.0] {
        assert_eq!(cut_at(p(0.5, sign * 0.4e-9), DVec2::ZERO), []);
        assert_eq!(cut_at(p(0.5, sign * 0.6e-9), DVec2::ZERO), off);
        // Short pieces may be off by four ulp of the largest coordinate, here 8.9e-16, and by no more.
        assert_eq!(cut_at(p(1e-8, sign * 8e-16), DVec2::ZERO), []);
        let loose = cut_at(p(1e-8, sign * 1e-15), DVec2::ZERO);
        assert!(loose.contains(&off[0]), "{loose:?}");
    }
    // At a million an ulp is 1.2e-10.
    let far = DVec2::splat((1u32 << 20) as f64);
    let ulp = (1u32 << 20) as f64 * f64::EPSILON;
    assert_eq!(cut_at(p(0.5, 4.0 * ulp), far), []);
    let loose = cut_at(p(0.5, 8.0 * ulp), far);
    assert!(loose.contains(&off[0]), "{loose:?}");
}

#[test]
fn a_vertex_is_found_within_four_ulp_of_the_largest_coordinate_and_no_further() {
    // The square turned into a kite, its vertices shuffled, and one of them moved by `ulps` ulp of 4.
    let kite = [p(0.0, 0.0), p(2.0, -1.0), p(4.0, 0.0), p(2.0, 1.0)];
    let ulp = 4.0 * f64::EPSILON;
    for moved in 0..4 {
        for axis in [DVec2::X, DVec2::Y] {
            for (ulps, expected) in [(4.0, true), (5.0, false)] {
                for sign in [1.0, -1.0] {
                    let mut points = [kite[2], kite[3], kite[1], kite[0]];
                    points[moved] += sign * ulps * ulp * axis;
                    let is_found = !broken(&domain(&kite, &[]), &mesh(&points, &[[3, 2, 1], [2, 0, 1]]), None)
                        .contains(&Claim::InputVertices);
                    // Above 4, doubles are coarser.
                    assert!(
                        is_found == expected || points[moved].x > 4.0,
                        "{moved} by {ulps} ulp along {axis}"
                    );
                }
            }
        }
    }
}

/// Of vertices with the same x the right one is found, exact or not.
#[test]
fn vertices_above_one_another_are_distinguished() {
    let ring = [
        p(0.0, 0.0),
        p(1.0, 0.0),
        p(1.0, 3.0),
        p(0.0, 3.0),
        p(0.0, 2.0),
        p(0.0, 1.0),
    ];
    let order = [4, 2, 0, 5, 1, 3];
    for nudge in [0.0, 4e-16, -4e-16] {
        let points: Vec<DVec2> = order.iter().map(|k| ring[*k] + p(nudge, nudge)).collect();
        let at = |k: usize| order.iter().position(|known| *known == k).unwrap() as u32;
        let triangles = [[0, 1, 5], [5, 1, 4], [4, 1, 2], [4, 2, 3]].map(|corners| corners.map(&at));
        let found = broken(&domain(&ring, &[]), &mesh(&points, &triangles), None);
        assert!(
            !found.iter().any(|claim| claim.name().starts_with("input")),
            "{nudge}: {found:?}"
        );
    }
}

/// A segment that no chain of edges follows is reported with the place up to which one does.
#[test]
fn a_broken_chain_is_reported_where_it_breaks() {
    let points = [&SQUARE[..], &[p(0.25, 0.0), p(0.75, 0.0), p(0.5, 0.5)]].concat();
    let square = domain(&SQUARE, &[]);
    // Nothing joins the two points on the lower side.
    let open = mesh(&points, &[[0, 4, 6], [5, 1, 6], [1, 2, 6], [2, 3, 6], [3, 0, 6]]);
    let (_, certificate) = judge(&square, &open, None);
    let check = certificate.check(Claim::InputSegments).unwrap();
    assert_eq!((check.worst, check.broken, check.at), (Some(1.0), 1, Some([0.25, 0.0])));
    assert_eq!(check.witnesses, [[0.25, 0.0]]);
    // A missing vertex is reported by the place where it should be.
    let without = mesh(&SQUARE[..3], &[[0, 1, 2]]);
    let (_, certificate) = judge(&square, &without, None);
    assert_eq!(certificate.check(Claim::InputVertices).unwrap().witnesses, [[0.0, 1.0]]);
    assert_eq!(certificate.check(Claim::InputSegments).unwrap().broken, 2);
}

/// Edges beyond the end, backwards, or beside the segment are not pieces of it.
#[test]
fn a_chain_takes_the_edge_that_follows_the_segment_best_and_no_further_than_its_end() {
    // Segment 0 ends at (1, 0), and the ring goes on straight to (2, 0): the whole lower side as one edge is not a
    // chain.
    let ring = [p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(2.0, 1.0), p(0.0, 1.0)];
    let jumped = mesh(&ring, &[[0, 2, 3], [0, 3, 4]]);
    let found = broken(&domain(&ring, &[]), &jumped, None);
    assert_eq!(
        found,
        [Claim::VerticesUsed, Claim::InputSegments, Claim::BoundaryOnSegments]
    );
    let whole = mesh(&ring, &[[0, 1, 4], [1, 3, 4], [1, 2, 3]]);
    assert_eq!(broken(&domain(&ring, &[]), &whole, None), []);
}

/// Of two points within four ulp, the one with exactly the coordinates is the vertex.
#[test]
fn a_vertex_is_the_point_with_exactly_its_coordinates_if_there_is_one() {
    let ring = [
        p(1.0, 0.0),
        p(2.0, 0.0),
        p(2.0, 3.0),
        p(1.0, 3.0),
        p(1.0, 2.0),
        p(1.0, 1.0),
    ];
    // To the left of each, so that it comes first.
    let beside = ring.map(|x| x - p(2.0 * f64::EPSILON, 0.0));
    let (first, above) = ([p(7.0, 7.0)], ring.map(|x| x + p(0.0, 9.0)));
    for points in [
        [&first[..], &beside, &ring].concat(),
        [&first[..], &above, &beside].concat(),
    ] {
        let domain = domain(&ring, &[]);
        let mesh = mesh(&points, &[]);
        let found = Boundary::find(&domain, &mesh, &mesh.adjacency()).vertex;
        assert_eq!(found, (7..13).map(Some).collect::<Vec<_>>());
    }
}

/// Along a segment there may be a sliver. Its outer side is the chain: there the edges turn least from the segment.
#[test]
fn of_edges_that_all_follow_a_segment_the_chain_takes_the_straightest() {
    // The point of the sliver nearer to the segment need not be on the straighter edge.
    for [outer, inner] in [[p(0.5, 0.0), p(0.5, 0.4e-9)], [p(0.5, 0.2e-9), p(0.3, 0.18e-9)]] {
        for [m, n] in [[4, 5], [5, 4]] {
            let middles = if m == 4 { [outer, inner] } else { [inner, outer] };
            let points = [&SQUARE[..], &middles].concat();
            let triangles = [[0, m, n], [m, 1, n], [0, n, 3], [n, 2, 3], [n, 1, 2]];
            let found = broken(&domain(&SQUARE, &[]), &mesh(&points, &triangles), None);
            assert!(
                !found.iter().any(|claim| claim.name().ends_with("segments")),
                "{found:?}"
            );
        }
    }
}

#[test]
fn two_vertices_in_one_place_are_judged_and_no_walk_goes_round_between_them() {
    let points = [&SQUARE[..], &[SQUARE[0], p(0.5, 0.5)]].concat();
    let twice = mesh(&points, &[[0, 1, 5], [1, 2, 5], [2, 3, 5], [3, 4, 5], [4, 0, 5]]);
    let found = broken(&domain(&SQUARE, &[]), &twice, None);
    // The left side ends at the second of the two: an edge of no length leads nowhere.
    assert_eq!(
        found,
        [
            Claim::PositiveOrientation,
            Claim::InputSegments,
            Claim::BoundaryOnSegments
        ]
    );
}
