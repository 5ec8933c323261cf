//! Domains drawn by rule.

use crate::domain::{InputSegment, Pslg, Region};
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
    let (teeth, back, tip) = (12u32, 0.2, 1.0);
    let line = |k: u32| f64::from(k) * 0.04;
    let mut points = vec![DVec2::ZERO, DVec2::new(line(2 * teeth - 1), 0.0)];
    for tooth in (0..teeth).rev() {
        let (left, right) = (line(2 * tooth), line(2 * tooth + 1));
        points.extend([DVec2::new(right, tip), DVec2::new(left, tip)]);
        if tooth > 0 {
            points.extend([DVec2::new(left, back), DVec2::new(line(2 * tooth - 1), back)]);
        }
    }
    let mut pslg = Pslg::new("comb");
    pslg.add_ring(points, 1);
    pslg
}

/// The pentagram's outline: five tips of 36° on the unit circle.
pub(super) fn star() -> Pslg {
    let inner = 2.0 - 2.0 * (0.1 * TAU).cos();
    let radius = [1.0, inner];
    let corner = |k: usize| radius[k % 2] * DVec2::from_angle(TAU * (0.25 + k as f64 / 10.0));
    let mut pslg = Pslg::new("star");
    pslg.add_ring((0..10).map(corner), 1);
    pslg
}

/// Twenty teeth, a third narrower at the tip than at the root so that no corner is acute, and a bore of 48 sides.
pub(super) fn gear() -> Pslg {
    let (root, tip, teeth) = (0.8, 1.0, 20);
    let pitch = TAU / f64::from(teeth);
    let mut points = Vec::new();
    for tooth in 0..teeth {
        let middle = f64::from(tooth) * pitch;
        for (radius, offset) in [(root, -0.3), (tip, -0.16), (tip, 0.16), (root, 0.3)] {
            points.push(radius * DVec2::from_angle(middle + offset * pitch));
        }
    }
    let mut pslg = Pslg::new("gear");
    pslg.add_ring(points, 1);
    pslg.add_ring(circle(DVec2::ZERO, 0.25, 48), 2);
    pslg.add_hole(DVec2::ZERO);
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

/// A box of three chords around an airfoil of chord 1, its 128 points spaced by cosine, its trailing edge closed.
///
/// Half thickness at x: 0.6 (0.2969 √x − 0.1260 x − 0.3516 x² + 0.2843 x³ − 0.1036 x⁴).
/// Reference: E. N. Jacobs, K. E. Ward, R. M. Pinkerton, NACA Report 460, 1933; the last coefficient is the usual one
/// for a closed trailing edge.
pub(super) fn naca0012() -> Pslg {
    const PER_SIDE: usize = 64;
    let half_thickness =
        |x: f64| 0.6 * (0.2969 * x.sqrt() + x * (-0.1260 + x * (-0.3516 + x * (0.2843 + x * -0.1036))));
    // From the trailing edge along the upper side to the leading edge, and back below.
    let point = |k: usize| {
        let share = if k <= PER_SIDE { k } else { 2 * PER_SIDE - k } as f64 / PER_SIDE as f64;
        let x = 0.5 * (1.0 + (0.5 * TAU * share).cos());
        let side = if k <= PER_SIDE { 1.0 } else { -1.0 };
        if k == 0 {
            DVec2::X
        } else {
            DVec2::new(x, side * half_thickness(x))
        }
    };
    let mut pslg = polygon("naca0012", &[(-1.0, -1.5), (2.0, -1.5), (2.0, 1.5), (-1.0, 1.5)]);
    pslg.add_ring((0..2 * PER_SIDE).map(point), 2);
    pslg.add_hole(DVec2::new(0.3, 0.0));
    pslg
}

/// Koch's snowflake on a triangle of side 1 after four steps: 768 segments.
pub(super) fn koch() -> Pslg {
    let mut points: Vec<DVec2> = circle(DVec2::ZERO, 3f64.sqrt().recip(), 3).collect();
    for _ in 0..4 {
        let count = points.len();
        let bend = |k: usize| {
            let (a, b) = (points[k], points[(k + 1) % count]);
            let third = (b - a) / 3.0;
            let outward = DVec2::from_angle(-TAU / 6.0).rotate(third);
            [a, a + third, a + third + outward, b - third]
        };
        points = (0..count).flat_map(bend).collect();
    }
    let mut pslg = Pslg::new("koch");
    pslg.add_ring(points, 1);
    pslg
}

/// A square cut in two regions by a polyline, with a crack from the boundary, a crack that hangs free, and a vertex on
/// no segment. Every angle is at least a right one.
pub(super) fn interface() -> Pslg {
    let mut pslg = polygon(
        "interface",
        &[
            (0.0, 0.0),
            (1.5, 0.0),
            (3.0, 0.0),
            (3.0, 2.0),
            (3.0, 3.0),
            (0.0, 3.0),
            (0.0, 2.0),
        ],
    );
    let mut chain = |points: &[(f64, f64)], from: Option<usize>, to: Option<usize>, marker: i32| {
        let first = pslg.vertices.len();
        pslg.add_chain(points.iter().map(|&(x, y)| DVec2::new(x, y)), marker);
        let last = pslg.vertices.len() - 1;
        pslg.segments.extend(from.map(|a| InputSegment { a, b: first, marker }));
        pslg.segments.extend(to.map(|b| InputSegment { a: last, b, marker }));
    };
    chain(&[(0.8, 2.0), (1.2, 1.7), (1.8, 1.7), (2.2, 2.0)], Some(6), Some(3), 2);
    chain(&[(1.5, 0.5), (1.7, 0.9)], Some(1), None, 3);
    chain(&[(1.1, 2.4), (1.5, 2.5), (1.9, 2.4)], None, None, 4);
    pslg.add_vertex(DVec2::new(0.6, 0.9));
    let region = |x, y, attribute| Region {
        point: DVec2::new(x, y),
        attribute,
        max_area: None,
    };
    pslg.regions = vec![region(0.2, 0.2, 1.0), region(0.2, 2.8, 2.0)];
    pslg
}
