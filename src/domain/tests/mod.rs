//! Faces and inside tests against what they are by definition.

use super::gallery;
use super::{Domain, FaultKind, InputSegment, Place, Pslg};
use crate::geometry::DVec2;

mod faults;
mod files;
mod oracle;

fn square(pslg: &mut Pslg, low: f64, high: f64) {
    let corners = [(low, low), (high, low), (high, high), (low, high)];
    pslg.add_ring(corners.map(|(x, y)| DVec2::new(x, y)), 1);
}

#[test]
fn a_hole_an_island_and_a_crack() {
    let mut pslg = Pslg::new("nested");
    square(&mut pslg, 0.0, 10.0);
    square(&mut pslg, 2.0, 8.0);
    square(&mut pslg, 4.0, 6.0);
    pslg.add_hole(DVec2::splat(3.0));
    pslg.add_chain([DVec2::new(0.5, 0.5), DVec2::new(1.5, 0.5), DVec2::new(1.0, 1.0)], 7);
    pslg.add_vertex(DVec2::splat(5.0));
    pslg.add_vertex(DVec2::splat(2.5));
    let domain = Domain::new(pslg).unwrap();
    assert_eq!(domain.area(), 100.0 - 36.0 + 4.0);
    assert_eq!(domain.vertices().len(), 12 + 3 + 1);
    assert_eq!(domain.isolated(), [15]);
    assert_eq!(domain.notes().len(), 1);
    assert!(domain.contains(DVec2::splat(5.0)) && domain.contains(DVec2::splat(1.0)));
    assert!(!domain.contains(DVec2::splat(3.0)) && !domain.contains(DVec2::splat(-1.0)));
    assert!(domain.contains(DVec2::new(2.0, 5.0)) && domain.contains(DVec2::new(10.0, 10.0)));
    assert!(!domain.is_boundary(12) && domain.is_boundary(0));
    assert_eq!(domain.smallest_input_angle_deg(), 45.0);
    assert_eq!(domain.acute_vertices(), [13]);
    let points = domain.face_points();
    for (face, point) in points.iter().enumerate().skip(1) {
        assert_eq!(domain.place(point.unwrap()), Place::Face(face));
    }
}

#[test]
fn faces_that_left_out_segments_separate_become_one() {
    let mut pslg = Pslg::new("split hole");
    square(&mut pslg, 0.0, 10.0);
    square(&mut pslg, 2.0, 8.0);
    pslg.segments.push(InputSegment { a: 4, b: 6, marker: 0 });
    pslg.add_hole(DVec2::new(3.0, 2.5));
    pslg.add_hole(DVec2::new(2.5, 3.0));
    let domain = Domain::new(pslg).unwrap();
    assert_eq!((domain.segments().len(), domain.faces().len()), (8, 3));
    assert_eq!(domain.area(), 64.0);
    assert_eq!(domain.smallest_input_angle_deg(), 90.0);
}

#[test]
fn open_and_empty_boundaries_are_told_apart() {
    let mut open = Pslg::new("open");
    open.add_chain(
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y)),
        1,
    );
    let error = Domain::new(open).unwrap_err();
    assert_eq!(error.faults()[0].kind, FaultKind::NotClosed);
    assert_eq!(error.faults()[0].vertices, [0, 3]);
    let mut hole = Pslg::new("hole");
    square(&mut hole, 0.0, 1.0);
    hole.add_hole(DVec2::splat(0.5));
    assert_eq!(
        Domain::new(hole).unwrap_err().faults()[0].kind,
        FaultKind::NothingInside
    );
}

#[test]
fn gallery_areas_are_those_of_the_formulas() {
    let area = |name: &str| gallery::domain(name).unwrap().unwrap().area();
    assert_eq!(area("unit-square"), 1.0);
    assert_eq!(area("l-shape"), 3.0);
    let ngon = |n: f64, r: f64| 0.5 * n * r * r * (std::f64::consts::TAU / n).sin();
    assert!((area("plate-hole") - (1.0 - ngon(64.0, 0.2))).abs() < 1e-12);
    assert!((area("annulus") - (ngon(96.0, 1.0) - ngon(96.0, 0.4))).abs() < 1e-12);
    assert!((area("comb") - (23.0 * 0.04 * 0.2 + 12.0 * 0.04 * 0.8)).abs() < 1e-12);
    assert!((area("two-arms") - (0.62 * 0.3 + 2.0 * 0.3 * 2.0)).abs() < 1e-12);
}
