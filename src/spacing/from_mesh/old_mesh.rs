//! A mesh that carries a spacing: which of its triangles hold a point, and which decide what happens in a cell.
//!
//! A point that no triangle holds, such as one that rounding puts beside the boundary, has the value of the nearest triangle at
//! its nearest point.

use crate::geometry::boxes::BoxTree;
use crate::geometry::predicates::{orient2d, triangle_holds};
use crate::geometry::segments::closest_on_segment;
use crate::geometry::{DVec2, Rect};
use crate::mesh::{Adjacency, Mesh};

/// Points and counter-clockwise triangles with an index over them.
#[derive(Clone, Debug)]
pub struct OldMesh {
    /// Vertices that triangles use.
    pub points: Vec<DVec2>,
    /// Corners as indices into `points`.
    pub triangles: Vec<[u32; 3]>,
    tree: BoxTree,
    /// Whether a triangle touches the mesh's boundary, even if only at a corner.
    outer: Vec<bool>,
}

impl OldMesh {
    /// Indexes the triangles of `mesh`, turned counter-clockwise, and leaves out vertices that none uses. Returns for each
    /// vertex that is left its index in `mesh` too.
    ///
    /// # Errors
    /// A message that says what is wrong with the mesh: no triangles, triangles without area, coordinates that are not finite.
    pub fn new(mesh: &Mesh) -> Result<(Self, Vec<usize>), String> {
        let mut place = vec![u32::MAX; mesh.points.len()];
        let mut kept = Vec::new();
        let mut triangles = Vec::with_capacity(mesh.triangles.len());
        for (t, corners) in mesh.triangles.iter().enumerate() {
            let [a, b, c] = mesh.corners(t);
            let turn = orient2d(a, b, c);
            if turn == 0.0 || !turn.is_finite() {
                return Err(format!("triangle {t} has no area; repair the mesh"));
            }
            let [a, b, c] = corners.map(|corner| {
                let corner = corner as usize;
                if place[corner] == u32::MAX {
                    place[corner] = kept.len() as u32;
                    kept.push(corner);
                }
                place[corner]
            });
            triangles.push(if turn > 0.0 { [a, b, c] } else { [a, c, b] });
        }
        if triangles.is_empty() {
            return Err("it has no triangles".into());
        }
        let points: Vec<DVec2> = kept.iter().map(|&k| mesh.points[k]).collect();
        let corners = |triangle: &[u32; 3]| triangle.map(|k| points[k as usize]);
        let tree = BoxTree::new(triangles.iter().map(|triangle| Rect::around(corners(triangle))));
        let outer = touching_the_boundary(&triangles, points.len());
        let old = Self {
            points,
            triangles,
            tree,
            outer,
        };
        Ok((old, kept))
    }

    /// Corners of triangle `t`.
    pub fn corners(&self, t: usize) -> [DVec2; 3] {
        self.triangles[t].map(|k| self.points[k as usize])
    }

    /// Length of the longest edge of triangle `t`.
    pub fn longest_edge(&self, t: usize) -> f64 {
        let [a, b, c] = self.corners(t);
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    }

    /// Visits the closed triangles that hold `x`, each with `x`; if there is none, the nearest triangles, each with its nearest
    /// point.
    pub fn holding(&self, x: DVec2, mut visit: impl FnMut(usize, DVec2)) {
        let mut is_held = false;
        self.tree.near(x, 0.0, |t| {
            if triangle_holds(self.corners(t), x) {
                is_held = true;
                visit(t, x);
            }
            0.0
        });
        if is_held {
            return;
        }
        let mut nearest = f64::INFINITY;
        let mut found: Vec<(usize, DVec2)> = Vec::new();
        self.tree.near(x, f64::INFINITY, |t| {
            let point = closest(self.corners(t), x);
            let distance = point.distance(x);
            if distance < nearest {
                found.clear();
                nearest = distance;
            }
            if distance <= nearest {
                found.push((t, point));
            }
            nearest
        });
        found.into_iter().for_each(|(t, point)| visit(t, point));
    }

    /// Visits every triangle that [`OldMesh::holding`] visits for some point of the cell, and perhaps a few more, each with
    /// the box that contains the points of it that count.
    pub fn deciding(&self, cell: Rect, mut visit: impl FnMut(usize, Rect)) {
        let mut met = Vec::new();
        self.meeting(cell, |t| met.push(t));
        // A cell that the mesh holds in part is met by its boundary, and so by an outer triangle.
        if !met.is_empty() && !met.iter().any(|&t| self.outer[t]) {
            met.into_iter().for_each(|t| visit(t, cell));
            return;
        }
        // A point outside is at most half a diagonal farther from the mesh than the centre.
        let mut away = f64::INFINITY;
        self.tree.near(cell.centre(), f64::INFINITY, |t| {
            let corners = self.corners(t);
            let distance = match triangle_holds(corners, cell.centre()) {
                true => 0.0,
                false => closest(corners, cell.centre()).distance(cell.centre()),
            };
            away = away.min(distance);
            away
        });
        let reach = DVec2::splat((away + 0.5 * cell.diagonal()) * (1.0 + 1e-12));
        let wide = Rect {
            min: cell.min - reach,
            max: cell.max + reach,
        };
        self.meeting(wide, |t| visit(t, wide));
    }

    /// Visits the triangles that have a point in common with `cell`, decided exactly.
    fn meeting(&self, cell: Rect, mut visit: impl FnMut(usize)) {
        let (low, high) = (cell.min, cell.max);
        let ends = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        self.tree.meeting(cell, |t| {
            let [a, b, c] = self.corners(t);
            let beyond = |p: DVec2, q: DVec2| ends.iter().all(|end| orient2d(p, q, *end) < 0.0);
            if !beyond(a, b) && !beyond(b, c) && !beyond(c, a) {
                visit(t);
            }
        });
    }
}

fn touching_the_boundary(triangles: &[[u32; 3]], points: usize) -> Vec<bool> {
    let adjacency = Adjacency::of(triangles, points);
    let mut is_outer = vec![false; points];
    for edge in adjacency.edges().iter().filter(|edge| edge.is_boundary()) {
        edge.ends.iter().for_each(|&end| is_outer[end as usize] = true);
    }
    let touches = |corners: &[u32; 3]| corners.iter().any(|&corner| is_outer[corner as usize]);
    triangles.iter().map(touches).collect()
}

/// The point of the triangle's boundary nearest to `x`.
fn closest([a, b, c]: [DVec2; 3], x: DVec2) -> DVec2 {
    let points = [[a, b], [b, c], [c, a]].map(|ends| closest_on_segment(ends, x));
    let nearer = |p: DVec2, q: DVec2| if q.distance(x) < p.distance(x) { q } else { p };
    nearer(nearer(points[0], points[1]), points[2])
}
