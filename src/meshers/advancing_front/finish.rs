//! The mesh: live triangles and their nodes, input vertices first, and which triangles lie where fronts met.

use super::front::{Front, NONE};
use crate::mesh::{Mesh, Piece};

impl Front<'_> {
    /// The mesh behind the front, once nothing is left of it.
    pub fn into_mesh(self, pieces: Vec<Piece>) -> Mesh {
        let domain = self.domain;
        // Nodes of deleted elements may be in no element now; nodes on the boundary always are in one.
        let mut number = vec![NONE; self.nodes.len()];
        let live = || self.triangles.iter().filter(|triangle| !triangle.is_deleted());
        for corner in live().flat_map(|triangle| triangle.corners) {
            number[corner as usize] = 0;
        }
        let mut points = Vec::with_capacity(self.nodes.len());
        for (node, number) in self.nodes.iter().zip(&mut number).filter(|(_, number)| **number == 0) {
            *number = points.len() as u32;
            points.push(node.at);
        }
        let name = |node: u32| number[node as usize];
        let mut mesh = Mesh {
            points,
            triangles: live().map(|triangle| triangle.corners.map(name)).collect(),
            regions: live()
                .map(|triangle| domain.faces()[triangle.face as usize].region)
                .collect(),
            pieces: pieces
                .into_iter()
                .map(|piece| Piece {
                    a: name(piece.a),
                    b: name(piece.b),
                    ..piece
                })
                .collect(),
            input_vertices: domain.vertices().len(),
            ..Mesh::default()
        };
        mesh.piece_markers = mesh
            .pieces
            .iter()
            .map(|piece| domain.segments()[piece.segment as usize].marker)
            .collect();
        mesh.mark_points(domain.vertex_markers());
        let joined: Vec<bool> = live().map(|triangle| triangle.is_seam).collect();
        mesh.seams = ring_around(&mesh, &joined);
        mesh
    }
}

/// The marked triangles and all that share a vertex with them.
fn ring_around(mesh: &Mesh, marked: &[bool]) -> Vec<u32> {
    let mut touched = vec![false; mesh.points.len()];
    for (triangle, _) in mesh.triangles.iter().zip(marked).filter(|(_, marked)| **marked) {
        triangle.iter().for_each(|&corner| touched[corner as usize] = true);
    }
    let near = |triangle: &[u32; 3]| triangle.iter().any(|&corner| touched[corner as usize]);
    (0u32..)
        .zip(&mesh.triangles)
        .filter(|(_, triangle)| near(triangle))
        .map(|(index, _)| index)
        .collect()
}
