//! Writes Triangle's `.poly` files.

use crate::domain::{Domain, Place};
use crate::geometry::DVec2;
use std::fmt::Write;

impl Domain {
    /// The domain as a `.poly` file, counted from 0: vertices and segments with markers, one hole point for each bounded
    /// face that is outside, one region line for each inside face that has an attribute or an area bound.
    ///
    /// Coordinates are written so that reading them back gives the same numbers.
    pub fn to_poly(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write_poly(&mut out);
        out
    }

    fn write_poly(&self, out: &mut String) -> std::fmt::Result {
        writeln!(out, "{} 2 0 1", self.vertices().len())?;
        for (v, (p, marker)) in self.vertices().iter().zip(self.vertex_markers()).enumerate() {
            writeln!(out, "{v} {} {} {marker}", p.x, p.y)?;
        }
        writeln!(out, "{} 1", self.segments().len())?;
        for (s, segment) in self.segments().iter().enumerate() {
            writeln!(out, "{s} {} {} {}", segment.a, segment.b, segment.marker)?;
        }
        let inner_points = self.face_points();
        let bounded = || self.faces().iter().zip(&inner_points).skip(1);
        let holes: Vec<DVec2> = bounded()
            .filter(|(face, _)| !face.inside)
            .filter_map(|(_, &point)| point)
            .collect();
        writeln!(out, "{}", holes.len())?;
        for (h, hole) in holes.iter().enumerate() {
            writeln!(out, "{h} {} {}", hole.x, hole.y)?;
        }
        let regions: Vec<_> = bounded()
            .filter(|(face, _)| face.inside && (face.region != 0.0 || face.max_area.is_some()))
            .filter_map(|(face, point)| point.map(|point| (face, point)))
            .collect();
        if !regions.is_empty() {
            writeln!(out, "{}", regions.len())?;
        }
        for (r, (face, point)) in regions.iter().enumerate() {
            writeln!(
                out,
                "{r} {} {} {} {}",
                point.x,
                point.y,
                face.region,
                face.max_area.unwrap_or(-1.0)
            )?;
        }
        Ok(())
    }

    /// For every bounded face a point inside it, well away from its segments; `None` for face 0, and for a face so thin
    /// that no floating-point number was found in it.
    ///
    /// A ray goes from the middle of a segment straight into the face; the point is half-way to where the ray first hits.
    /// The longest segments are tried first, and what is found is checked exactly.
    pub fn face_points(&self) -> Vec<Option<DVec2>> {
        let mut points = vec![None; self.faces().len()];
        let mut order: Vec<usize> = (0..self.segments().len()).collect();
        let length = |s: usize| {
            let [a, b] = self.ends(s);
            a.distance_squared(b)
        };
        order.sort_by(|&r, &s| length(s).total_cmp(&length(r)).then(r.cmp(&s)));
        for s in order {
            let segment = self.segments()[s];
            let [a, b] = self.ends(s);
            for (face, normal) in [(segment.left, (b - a).perp()), (segment.right, -(b - a).perp())] {
                if face == 0 || points[face].is_some() {
                    continue;
                }
                let middle = 0.5 * (a + b);
                let Some((_, share)) = self.index().first_hit(middle, normal, |other| other != s) else {
                    continue;
                };
                let point = middle + 0.5 * share * normal;
                if self.place(point) == Place::Face(face) {
                    points[face] = Some(point);
                }
            }
        }
        points
    }
}
