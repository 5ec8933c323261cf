//! Figure 3.

use super::super::figure3;
use super::{ROUNDING, is_biting, is_inside, material};
use crate::geometry::DVec2;

#[test]
fn figure_3_has_the_papers_radii() {
    let figure = figure3::find(material().runs()).unwrap();
    let (c_b, t) = (figure.run.asked.c_b, figure.run.case.t());
    assert!(is_biting(figure.run, &figure.x) && is_biting(figure.run, &figure.other));
    let f = figure.run.case.spacing.function.at(figure.x.centre);
    assert!((figure.packing.radius - c_b / (2.0 + t) * f).abs() < ROUNDING * f);
    assert!((figure.extended.radius - 2.0 * c_b / (1.0 - t) * f).abs() < ROUNDING * f);
    assert!((t - c_b * figure.run.case.spacing.function.lipschitz()).abs() < 1e-15);
}

#[test]
fn packing_circles_are_disjoint() {
    let figure = figure3::find(material().runs()).unwrap();
    let share = 1.0 / (2.0 + figure.run.case.t());
    let bites = &figure.run.bites;
    for (k, one) in bites.iter().enumerate() {
        for other in &bites[..k] {
            let apart = one.centre.distance(other.centre) - share * (one.radius + other.radius);
            assert!(apart >= -ROUNDING * one.radius, "{} and {}", one.centre, other.centre);
        }
    }
}

#[test]
fn y_is_in_two_biting_circles() {
    let figure = figure3::find(material().runs()).unwrap();
    for disc in [figure.x, figure.other] {
        assert!(figure.y.distance(disc.centre) < disc.radius);
    }
    let bites = figure.run.bites.iter();
    let covering = bites
        .filter(|bite| figure.y.distance(bite.centre) < bite.radius)
        .count();
    assert_eq!((covering, figure.covering), (2, 2));
}

#[test]
fn z_is_in_the_extended_circle_which_is_in_the_domain() {
    let figure = figure3::find(material().runs()).unwrap();
    let others = figure.run.mesh.points.iter().filter(|point| **point != figure.x.centre);
    let distances: Vec<f64> = others.map(|point| point.distance(figure.x.centre)).collect();
    let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(nearest, figure.nearest.centre.distance(figure.x.centre));
    assert!(
        nearest <= figure.extended.radius
            && nearest >= (1.0 - figure.run.case.t()) * figure.x.radius * (1.0 - ROUNDING)
    );
    assert_eq!(
        distances
            .iter()
            .filter(|distance| **distance < figure.extended.radius)
            .count(),
        figure.within
    );
    for step in 0..360 {
        let out = figure.extended.radius * DVec2::from_angle(f64::from(step).to_radians());
        assert!(is_inside(figure.run, figure.extended.centre + 0.999 * out));
    }
}
