//! Domains drawn by rule.

use crate::domain::Pslg;
use crate::geometry::DVec2;
use std::f64::consts::TAU;

/// A ring through the points of a polygon given as coordinate pairs.
fn polygon(name: &str, points: &[(f64, f64)]) -> Pslg {
    let mut pslg = Pslg::new(name);
    pslg.add_ring(points.iter().map(|&(x, y)| DVec2::new(x, y)), 1);
    pslg
}

/// Points evenly around a circle.
fn circle(centre: DVec2, radius: f64, count: usize) -> impl Iterator<Item = DVec2> {
    (0..count).map(move |k| centre + radius * DVec2::from_angle(TAU * k as f64 / count as f64))
}

pub(super) fn unit_square() -> Pslg {
    polygon("unit-square", &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
}

pub(super) fn l_shape() -> Pslg {
    polygon(
        "l-shape",
        &[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)],
    )
}

pub(super) fn plate_hole() -> Pslg {
    let mut pslg = unit_square();
    pslg.name = "plate-hole".to_owned();
    pslg.source.file.clone_from(&pslg.name);
    pslg.add_ring(circle(DVec2::splat(0.5), 0.2, 64), 2);
    pslg.add_hole(DVec2::splat(0.5));
    pslg
}

pub(super) fn annulus() -> Pslg {
    let mut pslg = Pslg::new("annulus");
    pslg.add_ring(circle(DVec2::ZERO, 1.0, 96), 1);
    pslg.add_ring(circle(DVec2::ZERO, 0.4, 96), 2);
    pslg.add_hole(DVec2::ZERO);
    pslg
}

/// Twelve teeth of width 0.04 that stand 0.04 apart on a back of height 0.2.
pub(super) fn comb() -> Pslg {
    let (teeth, width, back, tip) = (12, 0.04, 0.2, 1.0);
    let mut points = vec![DVec2::ZERO, DVec2::new(f64::from(2 * teeth - 1) * width, 0.0)];
    for tooth in (0..teeth).rev() {
        let left = f64::from(2 * tooth) * width;
        let right = f64::from(2 * tooth + 1) * width;
        points.extend([DVec2::new(right, tip), DVec2::new(left, tip)]);
        if tooth > 0 {
            points.extend([DVec2::new(left, back), DVec2::new(left - width, back)]);
        }
    }
    let mut pslg = Pslg::new("comb");
    pslg.add_ring(points, 1);
    pslg
}

/// A U whose arms, of width 0.3 and length 2, leave a gap of 0.02.
pub(super) fn two_arms() -> Pslg {
    polygon(
        "two-arms",
        &[
            (0.0, 0.0),
            (0.62, 0.0),
            (0.62, 2.3),
            (0.32, 2.3),
            (0.32, 0.3),
            (0.3, 0.3),
            (0.3, 2.3),
            (0.0, 2.3),
        ],
    )
}
