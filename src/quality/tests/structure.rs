//! Worst values, places and tolerances of the structural checks.

use super::*;
use crate::quality::structure::Structure;
use crate::quality::subject::Subject;
use crate::theory::Claim;

fn checked(domain: &Domain, mesh: &Mesh, claim: Claim) -> Check {
    judge(domain, mesh, None).1.check(claim).unwrap().clone()
}

fn moved(points: &[DVec2], shift: DVec2, scale: f64) -> Vec<DVec2> {
    points.iter().map(|x| scale * *x + shift).collect()
}

#[test]
fn the_smallest_signed_area_is_reported_with_its_triangle() {
    let square = domain(&SQUARE, &[]);
    let check = checked(&square, &fan(p(0.5, 0.25)), Claim::PositiveOrientation);
    assert_eq!((check.worst, check.bound, check.holds), (Some(0.125), Some(0.0), true));
    let outside = checked(&square, &fan(p(0.5, -0.5)), Claim::PositiveOrientation);
    assert_eq!((outside.worst, outside.broken), (Some(-0.25), 1));
    let [x, y] = outside.at.unwrap();
    assert!(p(x, y).distance(p(0.5, -0.5 / 3.0)) < 1e-15);
}

#[test]
fn areas_are_compared_relative_to_the_domains() {
    for (scale, shift) in [(1.0, DVec2::ZERO), (3.0, DVec2::ZERO), (0.25, p(2.0, -3.0))] {
        let square = domain(&moved(&SQUARE, shift, scale), &[]);
        let mut mesh = fan(p(0.5, 0.5));
        mesh.points = moved(&mesh.points, shift, scale);
        let whole = checked(&square, &mesh, Claim::Area);
        assert!(
            whole.holds && whole.worst.unwrap() < 1e-15 && whole.bound == Some(1e-9),
            "{whole:?}"
        );
        mesh.triangles.pop();
        let part = checked(&square, &mesh, Claim::Area);
        assert!(
            (part.worst.unwrap() - 0.25).abs() < 1e-12 && part.broken == 1,
            "{part:?}"
        );
        assert!(part.at.is_none() && part.witnesses.is_empty());
        mesh.triangles.extend([[3, 0, 4], [3, 0, 4]]);
        let double = checked(&square, &mesh, Claim::Area);
        assert!(
            (double.worst.unwrap() - 0.25).abs() < 1e-12 && !double.holds,
            "{double:?}"
        );
    }
    // An area that is not a number breaks the claim.
    let mut none = fan(p(0.5, 0.5));
    none.points[4] = DVec2::NAN;
    assert!(!checked(&domain(&SQUARE, &[]), &none, Claim::Area).holds);
}

/// Far from the origin the boundary may lie four ulp beside its segments, and the area may be off by that times their
/// length.
#[test]
fn the_area_may_be_off_by_what_lies_beside_segments() {
    let (shift, scale) = ((1u32 << 24) as f64, 2.0);
    let ring = moved(&SQUARE, DVec2::splat(shift), scale);
    // Four ulp · perimeter / area; the ulp of coordinates just over 2^24 is 2^-28.
    let allowed = 4.0 / (1u32 << 28) as f64 * 8.0 / 4.0;
    for inner in [&[][..], &[ring[0], ring[2]]] {
        let mut mesh = fan(p(0.5, 0.5));
        mesh.points = moved(&mesh.points, DVec2::splat(shift), scale);
        let check = checked(&domain(&ring, inner), &mesh, Claim::Area);
        assert!(
            (check.bound.unwrap() / allowed - 1.0).abs() < 1e-9,
            "{check:?}, expected {allowed}"
        );
    }
}

#[test]
fn places_that_should_not_be_there_are_counted() {
    let square = domain(&SQUARE, &[]);
    let mut more = fan(p(0.5, 0.5));
    more.points.extend([p(0.25, 0.3), p(0.75, 0.3)]);
    let unused = checked(&square, &more, Claim::VerticesUsed);
    assert_eq!((unused.worst, unused.bound, unused.broken), (Some(2.0), Some(0.0), 2));
    assert_eq!(unused.witnesses, [[0.25, 0.3], [0.75, 0.3]]);
    // The place is reported only if the check is broken.
    let whole = fan(p(0.5, 0.5));
    for claim in [Claim::ManifoldEdges, Claim::ConstrainedDelaunay] {
        let check = checked(&square, &whole, claim);
        assert!(check.holds && check.at.is_none(), "{check:?}");
    }
    let mut thrice = whole.clone();
    thrice.triangles.extend([[0, 1, 4], [0, 1, 4]]);
    let check = checked(&square, &thrice, Claim::ManifoldEdges);
    assert_eq!((check.worst, check.bound, check.broken), (Some(4.0), Some(2.0), 3));
    assert!(check.at.is_some());
    let mut open = whole;
    open.triangles.remove(0);
    let strays = checked(&square, &open, Claim::BoundaryOnSegments);
    assert_eq!(
        (strays.worst, strays.witnesses),
        (Some(2.0), vec![[0.25, 0.25], [0.75, 0.25]])
    );
}

#[test]
fn an_edge_is_not_delaunay_by_as_much_as_its_opposite_angles_exceed_180_degrees() {
    let kite = [p(0.0, 0.0), p(2.0, -1.0), p(4.0, 0.0), p(2.0, 2.0)];
    let check = checked(
        &domain(&kite, &[]),
        &mesh(&kite, &[[0, 1, 2], [0, 2, 3]]),
        Claim::ConstrainedDelaunay,
    );
    // 2 atan 2 below, 90° above.
    let excess = 2.0 * 2f64.atan().to_degrees() + 90.0 - 180.0;
    assert!(
        (check.worst.unwrap() - excess).abs() < 1e-12 && check.broken == 1,
        "{check:?}"
    );
    assert_eq!(check.at, Some([2.0, 0.0]));
    // Four vertices on a circle are Delaunay either way; if one is inside the circle, by however little, they are not.
    let on_circle = |inward: f64| {
        let ring = [p(0.0, 0.0), p(1.0, 0.0), p(1.0 - inward, 1.0 - inward), p(0.0, 1.0)];
        checked(
            &domain(&ring, &[]),
            &mesh(&ring, &[[0, 1, 3], [1, 2, 3]]),
            Claim::ConstrainedDelaunay,
        )
    };
    assert_eq!((on_circle(0.0).worst, on_circle(0.0).holds), (Some(0.0), true));
    let barely = on_circle(f64::EPSILON);
    assert!(!barely.holds && barely.worst.unwrap() > 0.0, "{barely:?}");
    // This check does not examine triangles that are not counter-clockwise.
    let folded = [p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0), p(0.0, 4.0), p(2.0, -1.0)];
    let check = checked(
        &domain(&folded[..4], &[]),
        &mesh(&folded, &[[0, 2, 1], [0, 2, 3]]),
        Claim::ConstrainedDelaunay,
    );
    assert!(check.holds, "{check:?}");
}

#[test]
fn a_mesh_need_not_be_delaunay_where_nobody_claims_it() {
    let kite = [p(0.0, 0.0), p(2.0, -1.0), p(4.0, 0.0), p(2.0, 1.0)];
    let (domain, long) = (domain(&kite, &[]), mesh(&kite, &[[0, 1, 2], [0, 2, 3]]));
    let (_, certificate) = judge(&domain, &long, None);
    assert!(certificate.holds && !certificate.check(Claim::ConstrainedDelaunay).unwrap().holds);
    let (_, certificate) = judge(&domain, &long, Some(&bounds(&UNIFORM, 0.5)));
    assert!(!certificate.holds);
}

#[test]
fn triangles_turned_over_missing_or_twice_do_not_make_up_the_domain() {
    let (square, good) = (domain(&SQUARE, &[]), fan(p(0.5, 0.5)));
    let is_whole = |change: &dyn Fn(&mut Mesh)| {
        let mut mesh = good.clone();
        change(&mut mesh);
        Structure::of(&Subject::new(&square, &mesh, None)).is_whole()
    };
    assert!(is_whole(&|_| {}));
    assert!(
        is_whole(&|mesh| mesh.points.push(p(0.3, 0.3))),
        "a vertex in no triangle"
    );
    assert!(!is_whole(&|mesh| mesh.triangles[0] = [1, 0, 4]));
    assert!(!is_whole(&|mesh| mesh.triangles.truncate(3)));
    assert!(!is_whole(&|mesh| mesh.triangles.push([0, 1, 4])));
    assert!(
        !is_whole(&|mesh| mesh.points[2] = p(1.0, 1.0 + 1e-12)),
        "off the segments"
    );
}
