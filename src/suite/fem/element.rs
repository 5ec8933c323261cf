//! Linear triangles: gradients of the barycentric coordinates, and the checks that make them safe to use.

use super::FemError;
use crate::geometry::{DVec2, predicates::orient2d};
use crate::mesh::Mesh;

/// A linear triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    /// Corners, counter-clockwise.
    pub corners: [DVec2; 3],
    /// Indices of the corners in the mesh.
    pub vertices: [usize; 3],
    /// Area.
    pub area: f64,
    /// ∇λ of each corner's barycentric coordinate λ.
    pub gradients: [DVec2; 3],
}

impl Element {
    fn of(mesh: &Mesh, t: usize) -> Result<Self, FemError> {
        let triangle = mesh.triangles[t];
        if let Some(vertex) = triangle.into_iter().find(|v| *v as usize >= mesh.points.len()) {
            return Err(FemError::UnknownVertex {
                triangle: t,
                vertex,
                vertices: mesh.points.len(),
            });
        }
        let corners = mesh.corners(t);
        // Exact in sign and good to the last digits, where the product of two edges of a thin triangle has none right.
        let double_area = orient2d(corners[0], corners[1], corners[2]);
        let gradients = [0, 1, 2].map(|k| (corners[(k + 2) % 3] - corners[(k + 1) % 3]).perp() / double_area);
        let element = Self {
            corners,
            vertices: triangle.map(|v| v as usize),
            area: 0.5 * double_area,
            gradients,
        };
        let is_finite = (0..3).all(|k| element.stiffness(k, k).is_finite());
        if double_area > 0.0 && is_finite {
            Ok(element)
        } else {
            Err(FemError::Degenerate {
                triangle: t,
                double_area,
            })
        }
    }

    /// ∫ ∇λ_i · ∇λ_j.
    pub fn stiffness(&self, i: usize, j: usize) -> f64 {
        self.area * self.gradients[i].dot(self.gradients[j])
    }

    /// The barycentric coordinates of a point.
    pub fn barycentric(&self, x: DVec2) -> [f64; 3] {
        [0, 1, 2].map(|k| self.gradients[k].dot(x - self.corners[(k + 1) % 3]))
    }

    /// The gradient of the linear function with these values at the corners.
    pub fn gradient(&self, values: [f64; 3]) -> DVec2 {
        // Differences first: a large constant in the values must not come out as rounding.
        (values[1] - values[0]) * self.gradients[1] + (values[2] - values[0]) * self.gradients[2]
    }
}

/// All triangles of the mesh, checked.
pub(super) fn all(mesh: &Mesh) -> Result<Vec<Element>, FemError> {
    if mesh.triangles.is_empty() {
        return Err(FemError::Empty);
    }
    (0..mesh.triangles.len()).map(|t| Element::of(mesh, t)).collect()
}
