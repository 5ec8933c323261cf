//! The one door for signs: exact orientation and in-circle tests.
//!
//! Reference: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
//! by way of the `robust` crate, which spade uses too.

use super::DVec2;
use robust::Coord;

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// Positive where `a`, `b`, `c` turn left, negative where they turn right, 0 exactly where they are collinear.
/// The magnitude approximates twice the signed area of the triangle.
pub fn orient2d(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// Whether the closed counter-clockwise triangle holds `x`, decided exactly.
#[inline]
pub fn triangle_holds([a, b, c]: [DVec2; 3], x: DVec2) -> bool {
    orient2d(a, b, x) >= 0.0 && orient2d(b, c, x) >= 0.0 && orient2d(c, a, x) >= 0.0
}

/// Positive where `d` lies inside the circle through the counter-clockwise triangle `a`, `b`, `c`; 0 exactly on it.
pub fn in_circle(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> f64 {
    robust::incircle(coord(a), coord(b), coord(c), coord(d))
}

/// How two closed segments meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meeting {
    /// No common point.
    Apart,
    /// One point, inside both.
    Cross,
    /// A common point that is an end of at least one of them.
    Touch,
    /// Collinear with more than a point in common.
    Overlap,
}

/// How the closed segments `a b` and `c d` meet, decided exactly.
pub fn segments_meet(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> Meeting {
    let (abc, abd) = (orient2d(a, b, c), orient2d(a, b, d));
    let (cda, cdb) = (orient2d(c, d, a), orient2d(c, d, b));
    if abc == 0.0 && abd == 0.0 && cda == 0.0 && cdb == 0.0 {
        // Collinear: compare along the axis in which the segments extend most.
        let along = |p: DVec2| {
            if (a.x - b.x).abs().max((c.x - d.x).abs()) >= (a.y - b.y).abs().max((c.y - d.y).abs()) {
                p.x
            } else {
                p.y
            }
        };
        let (low, high) = (
            along(a).min(along(b)).max(along(c).min(along(d))),
            along(a).max(along(b)).min(along(c).max(along(d))),
        );
        return if low > high {
            Meeting::Apart
        } else if low == high {
            Meeting::Touch
        } else {
            Meeting::Overlap
        };
    }
    // Signs, not products: those of small coordinates vanish.
    let alike = |s: f64, t: f64| (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0);
    if alike(abc, abd) || alike(cda, cdb) {
        return Meeting::Apart;
    }
    let opposite = |s: f64, t: f64| (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0);
    if opposite(abc, abd) && opposite(cda, cdb) {
        Meeting::Cross
    } else {
        Meeting::Touch
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orientation_is_exact_next_to_a_line() {
        let (a, b) = (DVec2::new(0.1, 0.1), DVec2::new(0.3, 0.3));
        assert_eq!(orient2d(a, b, DVec2::new(0.7, 0.7)), 0.0);
        assert!(orient2d(a, b, DVec2::new(0.7, 0.7f64.next_up())) > 0.0);
        assert!(orient2d(a, b, DVec2::new(0.7, 0.7f64.next_down())) < 0.0);
    }

    #[test]
    fn in_circle_is_exact_on_the_circle() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        assert_eq!(in_circle(square[0], square[1], square[2], square[3]), 0.0);
        assert!(in_circle(square[0], square[1], square[2], DVec2::new(0.0, 1.0f64.next_down())) > 0.0);
    }

    #[test]
    fn far_segments_of_tiny_domains_are_apart() {
        let p = |x: f64, y: f64| 1e-95 * DVec2::new(x, y);
        assert_eq!(
            segments_meet(p(0.0, 0.0), p(2.0, 0.3), p(0.1, 1.0), p(2.0, 1.7)),
            Meeting::Apart
        );
    }

    #[test]
    fn segments_meet_in_each_way() {
        let p = DVec2::new;
        let base = (p(0.0, 0.0), p(2.0, 0.0));
        for (c, d, expected) in [
            (p(1.0, -1.0), p(1.0, 1.0), Meeting::Cross),
            (p(1.0, 0.0), p(1.0, 1.0), Meeting::Touch),
            (p(2.0, 0.0), p(3.0, 1.0), Meeting::Touch),
            (p(2.0, 0.0), p(3.0, 0.0), Meeting::Touch),
            (p(1.0, 0.0), p(3.0, 0.0), Meeting::Overlap),
            (p(3.0, 0.0), p(4.0, 0.0), Meeting::Apart),
            (p(0.0, 1.0), p(2.0, 1.0), Meeting::Apart),
            (p(3.0, -1.0), p(3.0, 1.0), Meeting::Apart),
            (p(2.0, 1.0), p(2.0, 2.0), Meeting::Apart),
            (p(0.5, 0.0), p(1.5, 0.0), Meeting::Overlap),
            // Points.
            (p(1.0, 1.0), p(1.0, 1.0), Meeting::Apart),
            (p(2.0, 1.0), p(2.0, 1.0), Meeting::Apart),
            (p(3.0, 0.0), p(3.0, 0.0), Meeting::Apart),
            (p(1.0, 0.0), p(1.0, 0.0), Meeting::Touch),
        ] {
            // Mirrored, turned, small and far from the origin they meet alike.
            let moves: [fn(DVec2) -> DVec2; 6] = [
                |x| x,
                |x| -x,
                |x| DVec2::new(x.x, -x.y),
                |x| x.perp(),
                |x| x / 16.0 + 5.0,
                |x| x.perp() / 16.0 + 5.0,
            ];
            for (k, place) in moves.iter().enumerate() {
                let [a, b, c, d] = [base.0, base.1, c, d].map(place);
                for [a, b, c, d] in [[a, b, c, d], [a, b, d, c], [c, d, b, a], [d, c, b, a]] {
                    assert_eq!(segments_meet(a, b, c, d), expected, "move {k}: {a} {b} {c} {d}");
                }
            }
        }
    }
}
