//! Angles and circles of triangles, in plain floating point: numbers to report, never signs by which to decide.

use crate::geometry::DVec2;

/// The three angles in degrees, at the first, second and third corner.
pub fn angles_deg([a, b, c]: [DVec2; 3]) -> [f64; 3] {
    let angle = |u: DVec2, v: DVec2| u.perp_dot(v).abs().atan2(u.dot(v)).to_degrees();
    [angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)]
}

/// Mean of the corners.
pub fn centroid(corners: [DVec2; 3]) -> DVec2 {
    corners.iter().sum::<DVec2>() / 3.0
}

/// Centre of the circle through the corners; not finite if they are collinear.
pub fn circumcentre([a, b, c]: [DVec2; 3]) -> DVec2 {
    let (u, v) = (b - a, c - a);
    a + (v.perp() * u.length_squared() - u.perp() * v.length_squared()) / (-2.0 * u.perp_dot(v))
}

/// Circumradius over shortest edge.
pub fn radius_edge([a, b, c]: [DVec2; 3]) -> f64 {
    let (u, v, w) = (b - a, c - b, a - c);
    let product = u.length() * v.length() * w.length();
    product / (2.0 * u.perp_dot(v).abs()) / u.length().min(v.length()).min(w.length())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_triangle() {
        let corners = [DVec2::new(1.0, 1.0), DVec2::new(3.0, 1.0), DVec2::new(1.0, 3.0)];
        assert!(circumcentre(corners).distance(DVec2::new(2.0, 2.0)) < 1e-15);
        assert_eq!(angles_deg(corners), [90.0, 45.0, 45.0]);
        assert!((radius_edge(corners) - 0.5f64.sqrt()).abs() < 1e-15);
        let [a, b, c] = corners;
        assert!(circumcentre([a, c, b]).distance(DVec2::new(2.0, 2.0)) < 1e-15);
    }

    #[test]
    fn the_triangle_with_sides_13_14_15() {
        // Its area is 84, so its circumradius 13 · 14 · 15 / (4 · 84) = 8.125.
        let corners = [(0.0, 0.0), (14.0, 0.0), (5.0, 12.0)].map(DVec2::from);
        for turned in [0, 1, 2] {
            let [a, b, c] = [0, 1, 2].map(|k| corners[(k + turned) % 3]);
            for [a, b, c] in [[a, b, c], [c, b, a]] {
                assert!(centroid([a, b, c]).distance(DVec2::new(19.0 / 3.0, 4.0)) < 1e-14);
                assert!(circumcentre([a, b, c]).distance(DVec2::new(7.0, 4.125)) < 1e-14);
                assert!((radius_edge([a, b, c]) - 8.125 / 13.0).abs() < 1e-15);
                let law_of_cosines = |at: DVec2, p: DVec2, q: DVec2| {
                    let (u, v, w) = (at.distance(p), at.distance(q), p.distance(q));
                    ((u * u + v * v - w * w) / (2.0 * u * v)).acos().to_degrees()
                };
                let expected = [
                    law_of_cosines(a, b, c),
                    law_of_cosines(b, c, a),
                    law_of_cosines(c, a, b),
                ];
                for (found, expected) in angles_deg([a, b, c]).into_iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-12, "{found} {expected}");
                }
            }
        }
        assert!(!circumcentre([DVec2::ZERO, DVec2::X, 3.0 * DVec2::X]).is_finite());
    }
}
