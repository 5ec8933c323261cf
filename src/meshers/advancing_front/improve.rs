//! Optional improvement of a finished mesh: edge swaps to Delaunay, and smoothing. Both off by default.

use super::AdvancingFront;
use crate::geometry::predicates::{in_circle, orient2d};
use crate::geometry::{DVec2, turn};
use crate::mesh::{Adjacency, Lists, Mesh, NONE};

/// Swaps edges until all but the pieces are Delaunay, if that is asked for.
pub(super) fn swap(method: &AdvancingFront, mut mesh: Mesh) -> Mesh {
    if method.swap {
        swap_to_delaunay(&mut mesh);
    }
    mesh
}

/// Smooths the nodes inside the domain, if that is asked for; between sweeps edges are swapped if that is asked for too.
pub(super) fn smooth(method: &AdvancingFront, mut mesh: Mesh) -> Mesh {
    if method.smooth == 0 {
        return mesh;
    }
    for _ in 0..method.smooth {
        let around = triangles_around(&mesh);
        let is_fixed = fixed(&mesh);
        for node in (0..mesh.points.len()).filter(|&node| !is_fixed[node]) {
            move_to_middle(&mut mesh, node, around.get(node));
        }
        if method.swap {
            swap_to_delaunay(&mut mesh);
        }
    }
    mesh
}

/// Lawson's algorithm: each swap makes the triangulation more Delaunay, so it ends.
fn swap_to_delaunay(mesh: &mut Mesh) {
    let adjacency = mesh.adjacency();
    let mut across = adjacency.neighbours(&mesh.triangles);
    for piece in &mesh.pieces {
        cut(&adjacency, &mesh.triangles, &mut across, piece.a, piece.b);
    }
    let mut waiting: Vec<(u32, u32)> = (0..mesh.triangles.len() as u32)
        .rev()
        .flat_map(|triangle| [(triangle, 0), (triangle, 1), (triangle, 2)])
        .collect();
    while let Some((triangle, side)) = waiting.pop() {
        if let Some(other) = swap_side(mesh, &mut across, triangle as usize, side as usize) {
            waiting.extend([triangle, other].into_iter().flat_map(|t| [(t, 0), (t, 1), (t, 2)]));
        }
    }
}

/// Removes the links between the triangles on both sides of a piece.
fn cut(adjacency: &Adjacency, triangles: &[[u32; 3]], across: &mut [[u32; 3]], a: u32, b: u32) {
    let Some(edge) = adjacency.find(a, b).map(|edge| adjacency.edges()[edge]) else {
        return;
    };
    for triangle in [edge.left, edge.right].into_iter().filter(|triangle| *triangle != NONE) {
        let corners = triangles[triangle as usize];
        for side in 0..3 {
            let ends = [corners[side], corners[(side + 1) % 3]];
            if ends.contains(&a) && ends.contains(&b) {
                across[triangle as usize][side] = NONE;
            }
        }
    }
}

/// Swaps the side of a triangle if it is not Delaunay, and returns the other triangle.
fn swap_side(mesh: &mut Mesh, across: &mut [[u32; 3]], triangle: usize, side: usize) -> Option<u32> {
    let other = across[triangle][side];
    if other == NONE {
        return None;
    }
    let rolled = |values: [u32; 3], side: usize| [values[side], values[(side + 1) % 3], values[(side + 2) % 3]];
    let back = across[other as usize].iter().position(|&t| t == triangle as u32)?;
    let [a, b, c] = rolled(mesh.triangles[triangle], side);
    let d = mesh.triangles[other as usize][(back + 2) % 3];
    let at = |node: u32| mesh.points[node as usize];
    if in_circle(at(a), at(b), at(c), at(d)) <= 0.0 {
        return None;
    }
    // d lies within the circle of abc beyond ab: the quadrilateral adbc is convex.
    let [_, beyond_bc, beyond_ca] = rolled(across[triangle], side);
    let [_, beyond_ad, beyond_db] = rolled(across[other as usize], back);
    mesh.triangles[triangle] = [a, d, c];
    mesh.triangles[other as usize] = [d, b, c];
    across[triangle] = [beyond_ad, other, beyond_ca];
    across[other as usize] = [beyond_db, beyond_bc, triangle as u32];
    for (neighbour, from, to) in [(beyond_ad, other, triangle as u32), (beyond_bc, triangle as u32, other)] {
        if neighbour != NONE {
            let entries = &mut across[neighbour as usize];
            entries.iter_mut().filter(|t| **t == from).for_each(|t| *t = to);
        }
    }
    Some(other)
}

/// The triangles around each node.
fn triangles_around(mesh: &Mesh) -> Lists {
    let pairs = (0u32..)
        .zip(&mesh.triangles)
        .flat_map(|(index, corners)| corners.map(|corner| (corner, index)));
    Lists::group(mesh.points.len(), pairs)
}

/// Nodes that may not move: input vertices and nodes on pieces.
fn fixed(mesh: &Mesh) -> Vec<bool> {
    let mut fixed = vec![false; mesh.points.len()];
    fixed[..mesh.input_vertices].fill(true);
    for piece in &mesh.pieces {
        fixed[piece.a as usize] = true;
        fixed[piece.b as usize] = true;
    }
    fixed
}

/// Moves a node to the mean of its neighbours, or half the way there, if that makes the smallest angle around it
/// larger.
fn move_to_middle(mesh: &mut Mesh, node: usize, around: &[u32]) {
    let old = mesh.points[node];
    let others = |triangle: u32| {
        mesh.triangles[triangle as usize]
            .into_iter()
            .filter(|&corner| corner != node as u32)
    };
    let sum: DVec2 = around
        .iter()
        .flat_map(|&t| others(t))
        .map(|corner| mesh.points[corner as usize])
        .sum();
    // Each neighbour of an inner node is in two of its triangles.
    let middle = sum / (2 * around.len()) as f64;
    let before = smallest_angle(mesh, around);
    for place in [middle, old.midpoint(middle)] {
        mesh.points[node] = place;
        if smallest_angle(mesh, around) > before {
            return;
        }
    }
    mesh.points[node] = old;
}

/// The smallest angle of some triangles; negative unless all are counter-clockwise.
fn smallest_angle(mesh: &Mesh, triangles: &[u32]) -> f64 {
    let of = |triangle: &u32| {
        let [a, b, c] = mesh.corners(*triangle as usize);
        if orient2d(a, b, c) <= 0.0 {
            return -1.0;
        }
        turn(b - a, c - a).min(turn(c - b, a - b)).min(turn(a - c, b - c))
    };
    triangles.iter().map(of).fold(f64::INFINITY, f64::min)
}
