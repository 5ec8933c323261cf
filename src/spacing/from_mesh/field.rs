//! `field:FILE;eps=E`: the numerical spacing nsf of §2.2 for a u that is known at the vertices of an earlier mesh.
//!
//! # Idea
//! The Hessian is recovered at each vertex (`recover.rs`), turned into a length by the constant of `hessian.rs`, within the
//! same bounds, and the lengths are interpolated linearly on that mesh ([`Nodal`]).
//!
//! # Guarantee
//! Cells enclose the function as it is evaluated: it is linear on each triangle, and [`crate::spacing::from_mesh::old_mesh`]
//! finds the triangles that count. Its slopes are known, but a domain need not be convex, so no Lipschitz constant is
//! claimed; gradient limiting gives it one.
//!
//! # Cost
//! Recovery is linear in the mesh, a query O(log n).

use crate::geometry::DVec2;
use crate::mesh::Mesh;
use crate::spacing::expression::hessian::Tolerance;
use crate::spacing::expression::jet::largest_eigenvalue;
use crate::spacing::from_mesh::old_mesh::OldMesh;
use crate::spacing::from_mesh::recover::hessians;
use crate::spacing::{Rect, Spacing};

/// Room for rounding in a bound of a linear function, as a share of its largest value.
const ROUNDING: f64 = 1e-12;

/// |λ|max of the Hessian recovered at each point of `mesh`, where u has `values`; 0 at points that no triangle uses.
///
/// # Errors
/// A message that says what is wrong with the mesh.
pub fn recovered_eigenvalues(mesh: &Mesh, values: &[f64]) -> Result<Vec<f64>, String> {
    let (old, kept) = OldMesh::new(mesh)?;
    let own: Vec<f64> = kept.iter().map(|&k| values[k]).collect();
    let mut eigenvalues = vec![0.0; mesh.points.len()];
    for (hessian, k) in hessians(&old, &own)?.into_iter().zip(kept) {
        eigenvalues[k] = largest_eigenvalue(hessian);
    }
    Ok(eigenvalues)
}

/// f by its values at the vertices of a mesh, linear on each triangle.
#[derive(Clone, Debug)]
pub struct Nodal {
    mesh: OldMesh,
    values: Vec<f64>,
    /// The largest value by magnitude.
    scale: f64,
}

impl Nodal {
    /// The function with these values at the points of `mesh`.
    ///
    /// # Errors
    /// A message that says what is wrong with the mesh.
    pub fn new(mesh: &Mesh, values: &[f64]) -> Result<Self, String> {
        let (mesh, kept) = OldMesh::new(mesh)?;
        let values: Vec<f64> = kept.into_iter().map(|k| values[k]).collect();
        let scale = values.iter().map(|value| value.abs()).fold(0.0, f64::max);
        Ok(Self { mesh, values, scale })
    }

    /// nsf of a u with these values at the points of `mesh`, for a domain with the box `bounds`.
    ///
    /// # Errors
    /// A message that says what is wrong with the mesh.
    pub fn for_field(mesh: &Mesh, values: &[f64], tolerance: &Tolerance, bounds: Rect) -> Result<Self, String> {
        let eigenvalues = recovered_eigenvalues(mesh, values)?;
        let lengths: Vec<f64> = eigenvalues
            .into_iter()
            .map(|eigenvalue| tolerance.length(eigenvalue, bounds))
            .collect();
        Self::new(mesh, &lengths)
    }

    /// Smallest and largest value at the corners of a triangle.
    fn range(&self, t: usize) -> [f64; 2] {
        let values = self.mesh.triangles[t].map(|k| self.values[k as usize]);
        [
            values.into_iter().fold(f64::INFINITY, f64::min),
            values.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ]
    }

    /// The linear function of a triangle: its value at `x`, and its gradient.
    fn linear(&self, t: usize, x: DVec2) -> (f64, DVec2) {
        let [a, b, c] = self.mesh.corners(t);
        let [f, g, h] = self.mesh.triangles[t].map(|k| self.values[k as usize]);
        let (u, v) = (b - a, c - a);
        let gradient = ((g - f) * v.perp() - (h - f) * u.perp()) / v.perp().dot(u);
        (f + gradient.dot(x - a), gradient)
    }

    fn value(&self, t: usize, x: DVec2) -> f64 {
        let [low, high] = self.range(t);
        self.linear(t, x).0.clamp(low, high)
    }

    /// Bounds of the linear function of a triangle on the part of it in a cell.
    fn bounds(&self, t: usize, cell: Rect) -> [f64; 2] {
        let (middle, gradient) = self.linear(t, cell.centre());
        let swing = gradient.abs().dot(0.5 * cell.size()) + ROUNDING * self.scale;
        let [low, high] = self.range(t);
        [(middle - swing).max(low), (middle + swing).min(high)]
    }
}

impl Spacing for Nodal {
    fn at(&self, x: DVec2) -> f64 {
        let mut least = f64::INFINITY;
        self.mesh.holding(x, |t, x| least = least.min(self.value(t, x)));
        least
    }

    fn lipschitz(&self) -> f64 {
        f64::INFINITY
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        let mut least = f64::INFINITY;
        self.mesh
            .deciding(cell, |t, part| least = least.min(self.bounds(t, part)[0]));
        least
    }

    fn upper_bound(&self, cell: Rect) -> f64 {
        let mut most = f64::NEG_INFINITY;
        self.mesh
            .deciding(cell, |t, part| most = most.max(self.bounds(t, part)[1]));
        most
    }
}

#[cfg(test)]
mod tests;
