//! Figure 4.

use super::super::figure4::{self, Figure4, Obtuse};
use super::super::run::Run;
use super::{ROUNDING, is_biting, is_inside, material};
use crate::geometry::DVec2;

fn figure() -> Figure4<'static> {
    figure4::find(material().runs()).unwrap()
}

/// Whether an input segment lies between two points, by Cramer's rule.
fn is_hidden(run: &Run, from: DVec2, to: DVec2) -> bool {
    let between = |segment: usize| {
        let [a, b] = run.case.domain.ends(segment);
        let (sight, wall) = (to - from, b - a);
        let determinant = sight.perp_dot(wall);
        if determinant == 0.0 {
            return false;
        }
        let along_sight = (a - from).perp_dot(wall) / determinant;
        let along_wall = (a - from).perp_dot(sight) / determinant;
        (1e-9..1.0 - 1e-9).contains(&along_sight) && (0.0..=1.0).contains(&along_wall)
    };
    (0..run.case.domain.segments().len()).any(between)
}

/// The share of a triangle that its circumcentre sees.
fn seen(run: &Run, found: &Obtuse) -> f64 {
    let [a, b, c] = found.corners;
    let steps = 12;
    let (mut seen, mut all) = (0, 0);
    for i in 1..steps {
        for j in 1..steps - i {
            let (u, v) = (f64::from(i) / f64::from(steps), f64::from(j) / f64::from(steps));
            all += 1;
            seen += usize::from(!is_hidden(run, found.circle.centre, (1.0 - u - v) * a + u * b + v * c));
        }
    }
    seen as f64 / all as f64
}

fn is_delaunay(run: &Run, found: &Obtuse) -> bool {
    let on_circle = |corner: DVec2| {
        (corner.distance(found.circle.centre) - found.circle.radius).abs() < ROUNDING * found.circle.radius
    };
    let is_empty = |point: &DVec2| point.distance(found.circle.centre) > found.circle.radius * (1.0 - ROUNDING);
    found.corners.into_iter().all(on_circle) && run.mesh.points.iter().all(is_empty)
}

fn is_of_mesh(run: &Run, found: &Obtuse) -> bool {
    let same = |t: usize| found.corners.iter().all(|corner| run.mesh.corners(t).contains(corner));
    (0..run.mesh.triangles.len()).any(same)
}

#[test]
fn all_are_triangles_of_their_mesh_with_empty_circumcircles() {
    let figure = figure();
    for (run, found) in [figure.seen, figure.cut_off, figure.cut_off_inside] {
        assert!(is_of_mesh(run, &found) && is_delaunay(run, &found), "{found:?}");
    }
}

#[test]
fn a_sees_its_circumcentre_which_is_bitten() {
    let figure = figure();
    let (run, found) = figure.seen;
    assert_eq!(seen(run, &found), 1.0);
    assert!(is_inside(run, found.circle.centre) && is_biting(run, &figure.covering));
    assert!(found.circle.centre.distance(figure.covering.centre) <= figure.covering.radius);
}

#[test]
fn b_is_cut_off_from_its_circumcentre_by_the_boundary() {
    let figure = figure();
    let (run, found) = figure.cut_off;
    assert_eq!(seen(run, &found), 0.0, "the piece is a side of the triangle");
    assert!(!is_inside(run, found.circle.centre));
    let [a, b, _] = found.corners;
    let is_piece = run.mesh.pieces.iter().any(|piece| {
        let ends = [piece.a, piece.b].map(|end| run.mesh.points[end as usize]);
        ends.contains(&a) && ends.contains(&b)
    });
    assert!(is_piece, "p1 p2 are neighbours on the boundary");
}

#[test]
fn c_is_cut_off_though_its_circumcentre_is_in_the_domain() {
    let figure = figure();
    let (run, found) = figure.cut_off_inside;
    assert!(seen(run, &found) < 1.0 && is_inside(run, found.circle.centre));
    let segment = found.cut_by.unwrap();
    let [a, b] = run.case.domain.ends(segment);
    let across = 1e-6 * (b - a).perp();
    let middle = a.midpoint(b);
    assert!(
        [middle + across, middle - across]
            .iter()
            .all(|&point| is_inside(run, point)),
        "the domain is on both sides"
    );
    assert_eq!(figure.one_sided, 0, "what the caption proves");
}
