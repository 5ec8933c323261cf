//! The Hessian of a u that is known at the vertices of a mesh alone, recovered there.
//!
//! # Idea
//! Around each vertex, least squares find the quadratic that fits u best at the vertices nearby; its second derivatives are the
//! Hessian. The patch is the vertices within two edges, or more if these are fewer than [`PATCH`] or lie on a conic, as
//! near the boundary.
//!
//! # Why this and not twice Zienkiewicz–Zhu
//! A quadratic is recovered exactly, on any mesh and at the boundary too. Averaging gradients twice is exact for quadratics
//! only where the mesh is regular, and loses an order at the boundary, where layers and singularities are.
//!
//! # Order
//! For nodal values of a smooth u the error of |λ|max is of first order in the edge length at least, since the fit leaves out
//! the cubic terms. On meshes by biting, most of whose patches are nearly symmetric, so that cubic terms cancel, its root mean
//! square is of order 1.7 from edges of 0.1 to 0.0125, the boundary included; the tests demand 1.5.
//!
//! # Reference
//! Z. Zhang, A. Naga, "A new finite element gradient recovery method: superconvergence property", SIAM J. Sci. Comput. 26,
//! 2005: fits of higher degree to nodal values.

use crate::geometry::DVec2;
use crate::mesh::Adjacency;
use crate::spacing::from_mesh::old_mesh::OldMesh;
use rayon::prelude::*;

/// Coefficients of a quadratic in two variables.
const TERMS: usize = 6;

/// Fewest vertices of a patch, the one in the middle included: twice as many as a quadratic needs, so that the small errors of
/// a finite element solution are smoothed.
const PATCH: usize = 12;

/// Most rings of edges around the vertex of a patch.
const RINGS: usize = 6;

/// A column that keeps less than this share of its length beside the earlier ones counts as dependent on them.
const INDEPENDENT: f64 = 1e-6;

/// The second derivatives by xx, xy and yy at each vertex of `mesh`, where u has `values`.
///
/// # Errors
/// A message if the mesh has fewer vertices than a quadratic has coefficients.
pub fn hessians(mesh: &OldMesh, values: &[f64]) -> Result<Vec<[f64; 3]>, String> {
    let count = mesh.points.len();
    if count < TERMS {
        return Err(format!(
            "it has {count} vertices; second derivatives need {TERMS} or more"
        ));
    }
    let neighbours = Adjacency::of(&mesh.triangles, count).vertex_neighbours();
    let at = |vertex: usize| {
        let mut patch = vec![vertex];
        let mut ring = 0..1;
        let mut found = None;
        for rings in 1..=RINGS {
            for place in ring.clone() {
                for &next in neighbours.get(patch[place]) {
                    if !patch.contains(&(next as usize)) {
                        patch.push(next as usize);
                    }
                }
            }
            ring = ring.end..patch.len();
            let is_last = rings == RINGS || ring.is_empty();
            if patch.len() >= PATCH || is_last {
                found = fit(mesh, values, &patch, is_last);
            }
            if found.is_some() {
                break;
            }
        }
        found.unwrap_or_default()
    };
    Ok((0..count).into_par_iter().map(at).collect())
}

/// The Hessian of the quadratic that fits best on a patch around its first vertex; none if the patch leaves a coefficient
/// open, unless open ones are to be 0.
fn fit(mesh: &OldMesh, values: &[f64], patch: &[usize], open_is_zero: bool) -> Option<[f64; 3]> {
    let centre = mesh.points[patch[0]];
    let offset = |vertex: &usize| mesh.points[*vertex] - centre;
    let size = patch.iter().map(|v| offset(v).length()).fold(0.0, f64::max);
    let terms = |x: DVec2| [1.0, x.x, x.y, x.x * x.x, x.x * x.y, x.y * x.y];
    let rows: Vec<[f64; TERMS]> = patch.iter().map(|v| terms(offset(v) / size)).collect();
    // u less its value in the middle, so that large constants do not drown the rest.
    let wanted: Vec<f64> = patch.iter().map(|&v| values[v] - values[patch[0]]).collect();
    let [.., xx, xy, yy] = least_squares(&rows, wanted, open_is_zero)?;
    let scale = 1.0 / (size * size);
    Some([2.0 * xx * scale, xy * scale, 2.0 * yy * scale])
}

/// The coefficients with which the columns of `rows` come nearest to `wanted`, by modified Gram-Schmidt; none if the columns are
/// dependent, unless dependent ones are to get the coefficient 0.
fn least_squares(rows: &[[f64; TERMS]], mut wanted: Vec<f64>, open_is_zero: bool) -> Option<[f64; TERMS]> {
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let mut columns: [Vec<f64>; TERMS] = std::array::from_fn(|k| rows.iter().map(|row| row[k]).collect());
    let mut upper = [[0.0; TERMS]; TERMS];
    let mut right = [0.0; TERMS];
    for k in 0..TERMS {
        let before = dot(&columns[k], &columns[k]).sqrt();
        for j in 0..k {
            upper[j][k] = dot(&columns[j], &columns[k]);
            let (earlier, later) = columns.split_at_mut(k);
            for (value, part) in later[0].iter_mut().zip(&earlier[j]) {
                *value -= upper[j][k] * part;
            }
        }
        let length = dot(&columns[k], &columns[k]).sqrt();
        let is_open = length <= INDEPENDENT * before;
        if is_open && !open_is_zero {
            return None;
        }
        // A column of none takes part in nothing that follows.
        let share = if is_open { 0.0 } else { 1.0 / length };
        columns[k].iter_mut().for_each(|value| *value *= share);
        upper[k][k] = length;
        right[k] = dot(&columns[k], &wanted);
        for (value, part) in wanted.iter_mut().zip(&columns[k]) {
            *value -= right[k] * part;
        }
    }
    let mut found = [0.0; TERMS];
    for k in (0..TERMS).rev() {
        let known: f64 = (k + 1..TERMS).map(|j| upper[k][j] * found[j]).sum();
        let is_open = columns[k].iter().all(|value| *value == 0.0);
        found[k] = if is_open { 0.0 } else { (right[k] - known) / upper[k][k] };
    }
    Some(found)
}

#[cfg(test)]
mod tests;
