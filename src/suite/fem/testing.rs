//! Meshes of known shape, and oracles too slow for anything but tests.

use super::element;
use super::matrix::Matrix;
use super::{Problem, system};
use crate::geometry::{DVec2, Rect};
use crate::mesh::Mesh;

pub(super) const UNIT: Rect = Rect {
    min: DVec2::ZERO,
    max: DVec2::ONE,
};

/// The unit square in n × n squares, each cut along a diagonal; directions alternate, so that no symmetry flatters.
pub(super) fn square(n: u32) -> Mesh {
    let at = |column: u32, row: u32| row * (n + 1) + column;
    let mut mesh = Mesh::default();
    for row in 0..=n {
        for column in 0..=n {
            mesh.points
                .push(DVec2::new(f64::from(column), f64::from(row)) / f64::from(n));
        }
    }
    for row in 0..n {
        for column in 0..n {
            let [a, b, c, d] = [
                at(column, row),
                at(column + 1, row),
                at(column + 1, row + 1),
                at(column, row + 1),
            ];
            let cut = if (row + 2 * column) % 3 == 0 {
                [[a, b, d], [b, c, d]]
            } else {
                [[a, b, c], [a, c, d]]
            };
            mesh.triangles.extend(cut);
        }
    }
    mesh.regions = vec![0.0; mesh.triangles.len()];
    mesh.point_markers = vec![0; mesh.points.len()];
    mesh
}

/// [`square`] with its inner vertices moved by up to a fifth of an edge.
pub(super) fn shaken(n: u32) -> Mesh {
    let mut mesh = square(n);
    for (k, point) in mesh.points.iter_mut().enumerate() {
        if point.min_element() > 0.0 && point.max_element() < 1.0 {
            let angle = 2.4 * k as f64;
            *point += 0.2 / f64::from(n) * DVec2::new(angle.cos(), (1.7 * angle).sin());
        }
    }
    mesh
}

/// [`square`] of 8 × 8 with one vertex moved to a distance of `height` from the edge opposite it, over the edge's middle.
pub(super) fn with_sliver(height: f64) -> Mesh {
    let mut mesh = square(8);
    let inside = |t: &usize| {
        let corners = mesh.corners(*t);
        corners.iter().all(|p| p.min_element() > 0.2 && p.max_element() < 0.8)
    };
    let t = (0..mesh.triangles.len()).find(inside).unwrap();
    let corners = mesh.corners(t);
    // The corner at the right angle goes towards the longest side, which keeps its other triangles right.
    let around = |k: usize| [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
    let is_right = |k: &usize| {
        let [p, q, r] = around(*k);
        (q - p).dot(r - p).abs() < 1e-12
    };
    let k = (0..3).find(is_right).unwrap();
    let [p, q, r] = around(k);
    let middle = 0.5 * (q + r);
    mesh.points[mesh.triangles[t][k] as usize] = middle + height * (p - middle).normalize();
    mesh
}

/// The stiffness matrix of the free vertices, as rows of numbers.
pub(super) fn dense(mesh: &Mesh, problem: &Problem) -> Vec<Vec<f64>> {
    let elements = element::all(mesh).unwrap();
    rows(&system::assemble(mesh, &elements, problem).unwrap().matrix)
}

fn rows(matrix: &Matrix) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; matrix.size()]; matrix.size()];
    for (row, values) in rows.iter_mut().enumerate() {
        for (column, value) in matrix.row(row) {
            values[column] = value;
        }
    }
    rows
}

/// D^(−1/2) A D^(−1/2).
pub(super) fn preconditioned(matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let scale = |i: usize, j: usize| (matrix[i][i] * matrix[j][j]).sqrt();
    let size = 0..matrix.len();
    size.clone()
        .map(|i| size.clone().map(|j| matrix[i][j] / scale(i, j)).collect())
        .collect()
}

/// Smallest and largest eigenvalue of a symmetric matrix, by Jacobi's rotations until next to nothing is left beside the
/// diagonal; they converge for every symmetric matrix.
pub(super) fn extremes_by_rotations(mut matrix: Vec<Vec<f64>>) -> [f64; 2] {
    let size = matrix.len();
    let beside = |matrix: &[Vec<f64>]| -> f64 {
        let pairs = (0..size).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| matrix[i][j].abs()).fold(0.0, f64::max)
    };
    let negligible = 1e-12 * beside(&matrix);
    while beside(&matrix) > negligible {
        for p in 0..size {
            for q in p + 1..size {
                rotate(&mut matrix, p, q);
            }
        }
    }
    let diagonal = (0..size).map(|k| matrix[k][k]);
    [
        diagonal.clone().fold(f64::INFINITY, f64::min),
        diagonal.fold(f64::NEG_INFINITY, f64::max),
    ]
}

fn rotate(matrix: &mut [Vec<f64>], p: usize, q: usize) {
    if matrix[p][q] == 0.0 {
        return;
    }
    let half = 0.5 * (2.0 * matrix[p][q]).atan2(matrix[q][q] - matrix[p][p]);
    let (sine, cosine) = half.sin_cos();
    for row in matrix.iter_mut() {
        (row[p], row[q]) = (cosine * row[p] - sine * row[q], sine * row[p] + cosine * row[q]);
    }
    let (above, below) = matrix.split_at_mut(q);
    for (one, other) in above[p].iter_mut().zip(&mut below[0]) {
        (*one, *other) = (cosine * *one - sine * *other, sine * *one + cosine * *other);
    }
}
