//! Angles and circles of triangles, in plain floating point: numbers to report, never signs to decide by.

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

/// Centre of the circle through the corners; not finite where they are collinear.
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
}
