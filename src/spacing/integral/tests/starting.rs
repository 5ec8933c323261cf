//! The triangles and pieces that integration starts from.

use crate::spacing::integral::start::{base, bisect, cut, inner_points, longest_edge, middles, narrowest, triangles};
use crate::spacing::integral::tests::*;

fn area([a, b, c]: &Triangle) -> f64 {
    0.5 * (*b - *a).perp_dot(*c - *a)
}

fn longest(triangle: &Triangle) -> f64 {
    (0..3)
        .map(|k| triangle[k].distance(triangle[(k + 1) % 3]))
        .fold(0.0, f64::max)
}

#[test]
fn the_longest_edge_is_cut_in_its_middle() {
    let corners = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0)].map(DVec2::from);
    for turned in 0..3 {
        let triangle = [0, 1, 2].map(|k| corners[(k + turned) % 3]);
        assert_eq!(triangle[longest_edge(&triangle)], corners[0], "turned by {turned}");
        let halves = bisect(&triangle);
        let expected = [
            [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0)],
            [(2.0, 0.0), (4.0, 0.0), (1.0, 1.0)],
        ];
        assert_eq!(halves, expected.map(|corners| corners.map(DVec2::from)));
    }
    // Of equals the first.
    let even = [(0.0, 0.0), (2.0, 0.0), (1.0, 2.0)].map(DVec2::from);
    assert_eq!(longest_edge(&even), 1);
    assert_eq!(longest_edge(&[even[1], even[2], even[0]]), 0);
    assert_eq!(longest_edge(&[even[2], even[0], even[1]]), 0);
}

#[test]
fn triangles_are_cut_until_none_is_longer_than_f_over_its_constant_and_no_further() {
    let domain = gallery("l-shape");
    let whole = base(&domain, |_| Ok(f64::INFINITY), usize::MAX).unwrap().unwrap();
    let reach = |x: DVec2| 0.1 + 0.2 * x.x;
    let cut_to = |most: usize| cut(whole.clone(), |x| Ok(reach(x)), most).unwrap();
    let parts = cut_to(usize::MAX).unwrap();
    assert!(
        parts
            .iter()
            .all(|part| longest(part) <= reach(centroid(part)) && area(part) > 0.0)
    );
    assert!((parts.iter().map(area).sum::<f64>() - domain.area()).abs() < 1e-12);
    // Each is a half of one that was too long.
    assert!(parts.iter().all(|part| longest(part) > 0.3 * reach(centroid(part))));
    let count = parts.len();
    assert!(count > whole.len() && cut_to(count).is_some() && cut_to(count - 1).is_none());
    let refused = cut(
        whole.clone(),
        |x| {
            Err(SpacingError::NotPositive {
                value: 0.0,
                x: x.x,
                y: x.y,
            })
        },
        9,
    );
    assert!(refused.is_err());
}

#[test]
fn segments_are_cut_into_pieces_no_longer_than_f_over_its_constant() {
    let (a, b) = (DVec2::new(1.0, 2.0), DVec2::new(4.0, 6.0));
    let reach = |x: DVec2| 0.05 + 0.1 * (x.x - 1.0);
    let points = |room: usize| inner_points([a, b], |x| Ok(reach(x)), room).unwrap();
    let inner = points(usize::MAX).unwrap();
    let chain: Vec<DVec2> = [&[a], &inner[..], &[b]].concat();
    for piece in chain.windows(2) {
        let (length, most) = (piece[0].distance(piece[1]), reach(piece[0].midpoint(piece[1])));
        assert!(length <= most && length > 0.2 * most, "{piece:?}");
        assert!((piece[1] - piece[0]).dot(b - a) > 0.0 && (piece[1] - a).perp_dot(b - a).abs() < 1e-12);
    }
    assert_eq!(inner_points([a, b], |_| Ok(5.0), 0).unwrap(), Some(Vec::new()));
    // Room for the pieces that are still looked at, too.
    assert_eq!(points(inner.len() + 1), Some(inner.clone()));
    assert_eq!(points(inner.len() - 1), None);
    // Where f vanishes, points end where coordinates do.
    let fine = inner_points([DVec2::ONE, DVec2::ONE + 8.0 * f64::EPSILON], |_| Ok(0.0), 100)
        .unwrap()
        .unwrap();
    assert_eq!(
        fine,
        (1..8)
            .map(|k| DVec2::ONE + f64::from(k) * f64::EPSILON)
            .collect::<Vec<_>>()
    );
    assert_eq!(inner_points([a, b], |_| Ok(0.0), 1000).unwrap(), None);
}

#[test]
fn cells_that_no_segment_meets_have_their_middles_as_vertices() {
    let domain = gallery("unit-square");
    let inside = |reach: f64, room: usize| middles(&domain, |_| Ok(reach), room).unwrap();
    // Quarters have diagonals of 0.71, and all of them meet a side; of their quarters the inner four do not.
    assert_eq!(inside(0.8, 100), Some(Vec::new()));
    let mut found = inside(0.4, 100).unwrap();
    found.sort_by(|one, other| one.x.total_cmp(&other.x).then(one.y.total_cmp(&other.y)));
    let expected = [(0.375, 0.375), (0.375, 0.625), (0.625, 0.375), (0.625, 0.625)];
    assert_eq!(found, expected.map(DVec2::from));
    // Room for the cells that are still looked at, too.
    assert!(inside(0.4, 16).is_some() && inside(0.4, 15).is_none());
    let count = |reach: f64, most: usize| base(&domain, |_| Ok(reach), most).unwrap().map(|parts| parts.len());
    // Eight vertices on the boundary and none inside; 16 and 4.
    assert_eq!((count(0.8, 1000), count(0.4, 1000)), (Some(6), Some(22)));
    // Two triangles a point: those 16, and the 16 cells.
    assert_eq!((count(0.4, 64), count(0.4, 63)), (Some(22), None));
    assert_eq!(count(1e-9, 1000), None);
    assert!(base(&domain, |_| Err(SpacingError::NoFeatures), 1000).is_err());
}

#[test]
fn triangles_are_no_longer_than_a_share_of_the_domain_either() {
    let domain = gallery("unit-square");
    let coarsest = domain.bounds().diagonal() / 32.0;
    for (f, reach) in [(Uniform(1.0), coarsest), (Uniform(1e-3), coarsest)] {
        let parts = triangles(&f, &domain).unwrap();
        assert!(
            parts
                .iter()
                .all(|part| longest(part) <= reach && longest(part) > 0.4 * reach)
        );
    }
    let steep = Quintic([1.0, 1.0]);
    assert!(
        triangles(&steep, &domain)
            .unwrap()
            .iter()
            .all(|part| longest(part) <= coarsest)
    );
    let graded = Expression::new("0.05+4*x", domain.bounds()).unwrap();
    let parts = triangles(&graded, &domain).unwrap();
    let reach = |part: &Triangle| coarsest.min(graded.at(centroid(part)) / graded.lipschitz());
    assert!(
        parts
            .iter()
            .all(|part| longest(part) <= reach(part) && longest(part) > 0.3 * reach(part))
    );
}

#[test]
fn where_there_are_too_many_the_smallest_f_along_the_boundary_is_told() {
    let domain = gallery("unit-square");
    // Smallest in the middle of the right side.
    let f = Expression::new("0.1+(x-1)^2+(y-0.5)^2", domain.bounds()).unwrap();
    assert_eq!(
        narrowest(&f, &domain),
        SpacingError::TooSmall {
            value: 0.1,
            x: 1.0,
            y: 0.5
        }
    );
    let f = Expression::new("0.1+x+y", domain.bounds()).unwrap();
    assert_eq!(
        narrowest(&f, &domain),
        SpacingError::TooSmall {
            value: 0.1,
            x: 0.0,
            y: 0.0
        }
    );
}
