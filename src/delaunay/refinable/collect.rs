//! From the triangulation in the making to a [`Mesh`].

use super::Refinable;
use crate::domain::Domain;
use crate::geometry::predicates::in_circle;
use crate::mesh::{Mesh, NONE};

impl Refinable {
    /// The mesh: outside and holes carved away, removed vertices left out, pieces in order along each segment.
    pub fn into_mesh(mut self, domain: &Domain) -> Mesh {
        let forced_pieces = self.pieces.iter().filter(|span| self.is_forced(span.edge)).count();
        let mut number = vec![NONE; self.points.len()];
        let mut points = Vec::with_capacity(self.points.len());
        for (vertex, &at) in self.points.iter().enumerate() {
            if self.out[vertex] != NONE {
                number[vertex] = points.len() as u32;
                points.push(at);
            }
        }
        let inside = (0..self.triangle_count() as u32).filter(|&triangle| self.is_inside(triangle));
        let (triangles, regions) = inside
            .map(|triangle| {
                let face = self.face_of[triangle as usize];
                let corners = self.triangle(triangle).map(|vertex| number[vertex as usize]);
                (corners, domain.faces()[face as usize].region)
            })
            .unzip();
        self.pieces.sort_by(|one, other| {
            let segments = one.piece.segment.cmp(&other.piece.segment);
            segments.then(one.shares[0].total_cmp(&other.shares[0]))
        });
        let mut pieces: Vec<_> = self.pieces.iter().map(|span| span.piece).collect();
        for piece in &mut pieces {
            (piece.a, piece.b) = (number[piece.a as usize], number[piece.b as usize]);
        }
        let marker = |segment: u32| domain.segments()[segment as usize].marker;
        let mut mesh = Mesh {
            points,
            triangles,
            regions,
            piece_markers: pieces.iter().map(|piece| marker(piece.segment)).collect(),
            pieces,
            input_vertices: self.input_vertices,
            forced_pieces,
            ..Mesh::default()
        };
        mesh.mark_points(domain.vertex_markers());
        mesh
    }

    /// Whether a piece is not a Delaunay edge: the far corner of one triangle lies inside the circle of the other.
    fn is_forced(&self, edge: u32) -> bool {
        let twin = self.twin[edge as usize];
        let [a, b] = self.ends(edge).map(|vertex| self.point(vertex));
        twin != NONE && in_circle(a, b, self.point(self.apex(edge)), self.point(self.apex(twin))) > 0.0
    }
}
