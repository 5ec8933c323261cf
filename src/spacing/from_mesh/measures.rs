//! `el:FILE` and `nn:FILE`: the spacing functions of a mesh (§2.1), by which one mesh sets the sizes of the next.
//!
//! * el_M(x): the longest edge of the triangles that hold x, decided exactly. It jumps from triangle to triangle, so it has no
//!   Lipschitz constant; gradient limiting gives it one.
//! * nn_M(x): the distance to the second nearest mesh point, which at a mesh point is its nearest other one. The distance to
//!   the k-th nearest of any points is 1-Lipschitz.
//!
//! Both may be multiplied: `nn:FILE;factor=0.5` asks for half the distances.
//!
//! # Lemma 2.2
//! c₁ el ≤ nn ≤ c₂ el. No point of a triangle is farther from a corner than the longest edge is long, so c₂ = 1 for every mesh,
//! attained at the vertices of equilateral triangles. c₁ depends on the shape: in the middle of a shortest edge, nn is half its
//! length. On meshes of the gallery by biting at the defaults of t and c_b, measured in the corners, middles and insides of
//! triangles, c₁ lies between 0.19 and 0.27 (the tests check this).
//!
//! # Cost
//! O(log n) per query, by a tree of boxes.

use crate::geometry::DVec2;
use crate::geometry::boxes::BoxTree;
use crate::mesh::Mesh;
use crate::spacing::from_mesh::old_mesh::OldMesh;
use crate::spacing::{Rect, Spacing};

/// el_M.
#[derive(Clone, Debug)]
pub struct EdgeLength {
    mesh: OldMesh,
    lengths: Vec<f64>,
}

impl EdgeLength {
    /// Measures a mesh.
    ///
    /// # Errors
    /// A message that says what is wrong with the mesh.
    pub fn new(mesh: &Mesh) -> Result<Self, String> {
        let (mesh, _) = OldMesh::new(mesh)?;
        let lengths = (0..mesh.triangles.len()).map(|t| mesh.longest_edge(t)).collect();
        Ok(Self { mesh, lengths })
    }
}

impl Spacing for EdgeLength {
    fn at(&self, x: DVec2) -> f64 {
        let mut longest = f64::NEG_INFINITY;
        self.mesh.holding(x, |t, _| longest = longest.max(self.lengths[t]));
        longest
    }

    fn lipschitz(&self) -> f64 {
        f64::INFINITY
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        let mut least = f64::INFINITY;
        self.mesh.deciding(cell, |t, _| least = least.min(self.lengths[t]));
        least
    }

    fn upper_bound(&self, cell: Rect) -> f64 {
        let mut most = f64::NEG_INFINITY;
        self.mesh.deciding(cell, |t, _| most = most.max(self.lengths[t]));
        most
    }
}

/// nn_M.
#[derive(Clone, Debug)]
pub struct NearestNeighbour {
    points: Vec<DVec2>,
    tree: BoxTree,
    /// Half the smallest distance of two points: nn is nowhere less.
    least: f64,
}

impl NearestNeighbour {
    /// Measures a mesh.
    ///
    /// # Errors
    /// A message that says what is wrong with the mesh, such as two vertices in one place.
    pub fn new(mesh: &Mesh) -> Result<Self, String> {
        let (OldMesh { points, .. }, kept) = OldMesh::new(mesh)?;
        let tree = BoxTree::new(points.iter().map(|&point| Rect { min: point, max: point }));
        let mut nn = Self {
            points,
            tree,
            least: 0.0,
        };
        let distances = || nn.points.iter().map(|&point| nn.at(point));
        if let Some(double) = distances().position(|distance| distance == 0.0) {
            return Err(format!("vertex {} has the place of another; join them", kept[double]));
        }
        // Distances are rounded by less than an ulp.
        nn.least = 0.5 * (1.0 - 4.0 * f64::EPSILON) * distances().fold(f64::INFINITY, f64::min);
        Ok(nn)
    }
}

impl Spacing for NearestNeighbour {
    fn at(&self, x: DVec2) -> f64 {
        let (mut nearest, mut second) = (f64::INFINITY, f64::INFINITY);
        self.tree.near(x, f64::INFINITY, |k| {
            let distance = self.points[k].distance(x);
            if distance < nearest {
                (nearest, second) = (distance, nearest);
            } else {
                second = second.min(distance);
            }
            second
        });
        second
    }

    fn lipschitz(&self) -> f64 {
        1.0
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        (self.at(cell.centre()) - 0.5 * cell.diagonal()).max(self.least)
    }
}

#[cfg(test)]
mod tests;
