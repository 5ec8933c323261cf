//! Removing a free vertex: its star is cut into ears, then made Delaunay.

use super::{Refinable, following};
use crate::geometry::predicates::{orient2d, triangle_holds};
use crate::mesh::NONE;

/// A side of the polygon that a removed vertex leaves: where it starts, what is beyond it, and the piece on it.
#[derive(Clone, Copy)]
struct Side {
    from: u32,
    outer: u32,
    piece: u32,
}

impl Refinable {
    /// Whether a vertex is neither an input vertex nor on a piece.
    pub fn is_free(&self, vertex: u32) -> bool {
        let on_piece = || self.around(vertex).any(|edge| self.piece_of[edge as usize] != NONE);
        vertex as usize >= self.input_vertices && !on_piece()
    }

    /// Removes a vertex that [`Self::is_free`].
    ///
    /// Whatever ears come first, a simple polygon has one as long as it has more than three sides; flips do the rest.
    pub fn remove(&mut self, vertex: u32) {
        let star: Vec<u32> = self.around(vertex).collect();
        let face = self.face_of[star[0] as usize / 3];
        let side = |&edge: &u32| {
            let far = following(edge) as usize;
            Side {
                from: self.origin[far],
                outer: self.twin[far],
                piece: self.piece_of[far],
            }
        };
        let mut polygon: Vec<Side> = star.iter().map(side).collect();
        for edge in &star {
            let triangle = edge / 3;
            self.origin[3 * triangle as usize..3 * triangle as usize + 3].fill(NONE);
            self.unused.push(triangle);
        }
        self.out[vertex as usize] = NONE;
        self.changed.clear();
        let mut cuts = Vec::new();
        while polygon.len() > 3 {
            let tip = (0..polygon.len()).find(|&tip| self.is_ear(&polygon, tip)).unwrap_or(0);
            let count = polygon.len();
            let (before, after) = ((tip + count - 1) % count, (tip + 1) % count);
            let triangle = self.fill(face, [polygon[before], polygon[tip]], polygon[after].from);
            polygon[before].outer = 3 * triangle + 2;
            polygon[before].piece = NONE;
            polygon.remove(tip);
            cuts.push(3 * triangle + 2);
        }
        let triangle = self.fill(face, [polygon[0], polygon[1]], polygon[2].from);
        self.link(3 * triangle + 2, polygon[2].outer, polygon[2].piece);
        self.legalise(cuts);
    }

    /// A triangle on two sides of the polygon that follow each other, its third side not yet linked.
    fn fill(&mut self, face: u32, sides: [Side; 2], end: u32) -> u32 {
        let triangle = self.new_triangle(face);
        self.set_origins(triangle, [sides[0].from, sides[1].from, end]);
        self.link(3 * triangle, sides[0].outer, sides[0].piece);
        self.link(3 * triangle + 1, sides[1].outer, sides[1].piece);
        self.changed.push(triangle);
        triangle
    }

    /// Whether the corner `tip` turns left and its closed triangle holds no further corner.
    fn is_ear(&self, polygon: &[Side], tip: usize) -> bool {
        let count = polygon.len();
        let corner = |k: usize| self.point(polygon[k % count].from);
        let [a, b, c] = [corner(tip + count - 1), corner(tip), corner(tip + 1)];
        let holds = |k: usize| triangle_holds([a, b, c], corner(k));
        orient2d(a, b, c) > 0.0 && !(tip + 2..tip + count - 1).any(holds)
    }
}
