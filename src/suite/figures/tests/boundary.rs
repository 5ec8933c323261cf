//! Figures 2 and 5.

use super::super::{figure2, figure5};
use super::{ROUNDING, is_biting, is_inside, is_on_circle, is_on_segment, material};
use crate::geometry::DVec2;
use crate::suite::lemmas::statements::least_progressive_height;
use crate::theory::least_meeting_height;

#[test]
fn figure_2_is_edge_protection() {
    let figure = figure2::find(material().runs()).unwrap();
    let (run, found, p0) = (figure.run, figure.found, figure.p0);
    let ends = run.case.domain.ends(found.segment);
    for (name, disc) in [
        ("p0", p0),
        ("p1", found.p1),
        ("p2", found.p2),
        ("q", found.q),
        ("q1", found.q1),
        ("q2", found.q2),
    ] {
        assert!(is_on_segment(disc.centre, ends), "{name} is on the boundary");
        assert!(is_biting(run, &disc), "{name} has its biting circle");
    }
    assert!(
        is_on_circle(found.p1.centre, &p0),
        "p1 is where B(p0) meets the boundary"
    );
    assert!(is_on_circle(found.q1.centre, &found.p1), "q1 is where B(p1) does");
    assert!(is_on_circle(found.q2.centre, &found.p2), "q2 is where B(p2) does");
    let middle = 0.5 * (found.q1.centre + found.q2.centre);
    assert!(
        found.q.centre.distance(middle) <= 1e-12 * found.q.radius,
        "q is the middle of q1 q2"
    );
    for (one, other) in [(found.q1, found.p2), (found.q2, found.p1)] {
        assert!(
            one.centre.distance(other.centre) < one.radius + other.radius,
            "the tried circles meet the far ones"
        );
    }
    let order = [p0, found.p1, found.q1, found.q, found.q2, found.p2].map(|disc| disc.centre.x);
    assert!(order.is_sorted() || order.iter().rev().is_sorted(), "{order:?}");
    let position = |centre: DVec2| run.bites.iter().position(|bite| bite.centre == centre).unwrap();
    assert!(
        position(p0.centre) < position(found.p1.centre),
        "p0 is bitten before p1"
    );
    assert!(
        [found.p1, found.p2]
            .iter()
            .all(|disc| position(disc.centre) < position(found.q.centre))
    );
    let tried = [found.q1.centre, found.q2.centre];
    let is_tried = |centre: DVec2| tried.contains(&centre);
    assert!(
        !run.bites.iter().any(|bite| is_tried(bite.centre)),
        "neither q1 nor q2 is bitten"
    );
}

#[test]
fn figure_5_has_r_on_both_circles_and_its_distance() {
    let figure = figure5::find(material().runs()).unwrap();
    let (run, a) = figure.progressive;
    let (other_run, b) = figure.middle;
    for (run, segment, p1, q, r, h_r, least) in [
        (
            run,
            a.segment,
            a.p1,
            a.q,
            a.r,
            a.h_r,
            least_progressive_height(run.case.t()),
        ),
        (
            other_run,
            b.segment,
            b.p1,
            b.q,
            b.r,
            b.h_r,
            least_meeting_height(other_run.case.t()),
        ),
    ] {
        assert!(is_on_circle(r, &p1) && is_on_circle(r, &q) && is_inside(run, r));
        assert!(is_biting(run, &p1) && is_biting(run, &q));
        let ends = run.case.domain.ends(segment);
        assert!(is_on_segment(p1.centre, ends) && is_on_segment(q.centre, ends));
        // Twice the area of the triangle p1 q r over its base.
        let sides = [
            p1.centre.distance(q.centre),
            q.centre.distance(r),
            r.distance(p1.centre),
        ];
        let half = 0.5 * sides.iter().sum::<f64>();
        let area = (half * (half - sides[0]) * (half - sides[1]) * (half - sides[2])).sqrt();
        assert!((h_r - 2.0 * area / sides[0]).abs() < 1e-9 * p1.radius);
        assert!(
            h_r / p1.radius >= least * (1.0 - ROUNDING),
            "Lemmas 6.3 and 6.4: {} and {least}",
            h_r / p1.radius
        );
    }
    assert!(is_on_circle(a.q.centre, &a.p1), "q of (a) is on the circle of p1");
    assert!(b.q.centre.distance(b.q1.centre.midpoint(b.q2.centre)) <= 1e-12 * b.q.radius);
    assert!(is_on_circle(b.q1.centre, &b.p1) && is_on_circle(b.q2.centre, &b.p2));
    let reaches = b.q1.centre.distance(b.q2.centre) <= b.q1.radius.min(b.q2.radius);
    assert!(reaches, "each of the circles at q1 and q2 reaches the other point");
}

#[test]
fn the_lemmas_bounds_are_those_of_equal_circles_where_t_is_0() {
    assert!((least_progressive_height(0.0) - 3f64.sqrt() / 2.0).abs() < 1e-15);
    assert!((least_meeting_height(0.0) - 7f64.sqrt() / 4.0).abs() < 1e-15);
}
