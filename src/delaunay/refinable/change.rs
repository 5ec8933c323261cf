//! The changes: a point into a cavity, a piece in two, and the flips that make edges Delaunay again.

use super::{Cavity, Refinable, following, previous};
use crate::geometry::{DVec2, predicates};
use crate::mesh::{NONE, Piece};

impl Refinable {
    /// Finds the cavity of the point `x`, which lies strictly inside `triangle` or on an edge of it that is not a piece.
    ///
    /// The triangles whose circumcircles hold `x`, reached without crossing a piece: their union is star-shaped from x.
    pub fn dig(&self, triangle: u32, x: DVec2, cavity: &mut Cavity) {
        cavity.point = x;
        cavity.triangles.clear();
        cavity.rim.clear();
        cavity.triangles.push(triangle);
        cavity.stack.extend([3 * triangle + 2, 3 * triangle + 1, 3 * triangle]);
        while let Some(edge) = cavity.stack.pop() {
            let twin = self.twin[edge as usize];
            let closed = self.piece_of[edge as usize] != NONE || twin == NONE;
            if closed || !self.circle_holds(twin / 3, x) {
                cavity.rim.push(edge);
            } else {
                cavity.triangles.push(twin / 3);
                cavity.stack.extend([previous(twin), following(twin)]);
            }
        }
    }

    fn circle_holds(&self, triangle: u32, x: DVec2) -> bool {
        let [a, b, c] = self.triangle(triangle).map(|vertex| self.point(vertex));
        predicates::in_circle(a, b, c, x) > 0.0
    }

    /// Puts the point into its cavity, and returns the new vertex.
    pub fn insert(&mut self, cavity: &Cavity) -> u32 {
        let vertex = self.points.len() as u32;
        self.points.push(cavity.point);
        self.out.push(NONE);
        let face = self.face_of[cavity.triangles[0] as usize];
        let rim = cavity.rim.iter().map(|&edge| {
            (
                self.origin[edge as usize],
                self.twin[edge as usize],
                self.piece_of[edge as usize],
            )
        });
        let rim: Vec<(u32, u32, u32)> = rim.collect();
        self.changed.clear();
        self.changed.extend(&cavity.triangles);
        while self.changed.len() < rim.len() {
            let triangle = self.new_triangle(face);
            self.changed.push(triangle);
        }
        let changed = std::mem::take(&mut self.changed);
        for (k, (&triangle, &(from, outer, piece))) in changed.iter().zip(&rim).enumerate() {
            let (after, before) = ((k + 1) % rim.len(), (k + rim.len() - 1) % rim.len());
            let edge = 3 * triangle;
            self.set_origins(triangle, [from, rim[after].0, vertex]);
            self.link(edge, outer, piece);
            self.twin[edge as usize + 1] = 3 * changed[after] + 2;
            self.twin[edge as usize + 2] = 3 * changed[before] + 1;
            self.piece_of[edge as usize + 1] = NONE;
            self.piece_of[edge as usize + 2] = NONE;
        }
        self.changed = changed;
        vertex
    }

    /// The point at a share of a segment from its first vertex, as exactly as rounding allows.
    pub fn point_on(&self, piece: u32, share: f64) -> DVec2 {
        let [from, to] = self.segment_ends[self.piece(piece).segment as usize].map(|vertex| self.point(vertex));
        if share <= 0.5 {
            from + (to - from) * share
        } else {
            to + (from - to) * (1.0 - share)
        }
    }

    /// Splits a piece at a share of its segment, and returns the new vertex. Returns `None`, and changes nothing, if rounding
    /// would turn a triangle of the domain over. The part behind the new vertex is the last piece.
    pub fn split(&mut self, piece: u32, share: f64) -> Option<u32> {
        let x = self.point_on(piece, share);
        let edge = self.pieces[piece as usize].edge;
        let twin = self.twin[edge as usize];
        let turned = [edge, twin].map(|side| side != NONE && !self.can_split(side, x));
        if [edge, twin]
            .into_iter()
            .zip(turned)
            .any(|(side, turned)| turned && self.is_inside(side / 3))
        {
            return None;
        }
        self.has_overturned |= turned.contains(&true);
        let (vertex, behind) = (self.points.len() as u32, self.pieces.len() as u32);
        self.points.push(x);
        self.out.push(NONE);
        let mut span = self.pieces[piece as usize];
        let from = self.origin[edge as usize];
        // Of the two parts, the one at piece.a keeps the number.
        let (first, second) = if span.piece.a == from {
            (piece, behind)
        } else {
            (behind, piece)
        };
        self.pieces.push(super::Span {
            piece: Piece {
                a: vertex,
                ..span.piece
            },
            shares: [share, span.shares[1]],
            edge: NONE,
        });
        span.piece.b = vertex;
        span.shares[1] = share;
        self.pieces[piece as usize] = span;
        self.changed.clear();
        let halves = self.halve(edge, vertex);
        let other = if twin == NONE {
            [NONE; 2]
        } else {
            self.halve(twin, vertex)
        };
        self.link(halves[0], other[1], first);
        self.link(halves[1], other[0], second);
        let mut todo = Vec::with_capacity(8);
        for side in halves.into_iter().chain(other).filter(|&side| side != NONE) {
            todo.extend([following(side), previous(side)]);
        }
        self.legalise(todo);
        Some(vertex)
    }

    fn can_split(&self, edge: u32, x: DVec2) -> bool {
        let [a, b] = self.ends(edge).map(|vertex| self.point(vertex));
        let c = self.point(self.apex(edge));
        predicates::orient2d(a, x, c) > 0.0 && predicates::orient2d(x, b, c) > 0.0
    }

    /// Halves the triangle of a half-edge a b at a vertex on it; returns the half-edges a x and x b, not yet linked.
    fn halve(&mut self, edge: u32, vertex: u32) -> [u32; 2] {
        let (old, far) = (edge / 3, following(edge));
        let (b, c) = (self.origin[far as usize], self.apex(edge));
        let (outer, piece) = (self.twin[far as usize], self.piece_of[far as usize]);
        let new = self.new_triangle(self.face_of[old as usize]);
        self.set_origins(new, [vertex, b, c]);
        self.link(3 * new + 1, outer, piece);
        self.origin[far as usize] = vertex;
        self.link(far, 3 * new + 2, NONE);
        self.out[vertex as usize] = far;
        self.out[c as usize] = previous(edge);
        self.changed.extend([old, new]);
        [edge, 3 * new]
    }

    /// Flips edges that are not pieces until each of `todo`, and each that a flip concerns, is Delaunay; then reports what
    /// changed.
    pub(super) fn legalise(&mut self, mut todo: Vec<u32>) {
        while let Some(edge) = todo.pop() {
            let twin = self.twin[edge as usize];
            if twin == NONE || self.piece_of[edge as usize] != NONE || self.is_overturned([edge, twin]) {
                continue;
            }
            if self.circle_holds(edge / 3, self.point(self.apex(twin))) {
                self.flip(edge, twin);
                // The four edges around the pair, by their half-edges in it.
                todo.extend([edge, following(edge), twin, following(twin)]);
                self.changed.extend([edge / 3, twin / 3]);
            }
        }
        self.changed.sort_unstable();
        self.changed.dedup();
    }

    /// Whether one of two triangles on a common edge is an outside one that a split has turned over.
    fn is_overturned(&self, edges: [u32; 2]) -> bool {
        let is_turned = |edge: u32| {
            let [a, b] = self.ends(edge).map(|vertex| self.point(vertex));
            predicates::orient2d(a, b, self.point(self.apex(edge))) <= 0.0
        };
        self.has_overturned && !self.is_inside(edges[0] / 3) && edges.into_iter().any(is_turned)
    }

    /// Turns the diagonal a b of the quadrilateral a d b c into c d: its triangles are then (d, b, c) and (c, a, d).
    fn flip(&mut self, edge: u32, twin: u32) {
        let (c, d) = (self.apex(edge), self.apex(twin));
        let (after, twin_after) = (following(edge), following(twin));
        let sides = [previous(edge), previous(twin)].map(|k| (self.twin[k as usize], self.piece_of[k as usize]));
        let (a, b) = (self.origin[edge as usize], self.origin[twin as usize]);
        self.origin[edge as usize] = d;
        self.origin[twin as usize] = c;
        self.link(edge, sides[1].0, sides[1].1);
        self.link(twin, sides[0].0, sides[0].1);
        self.link(previous(edge), previous(twin), NONE);
        self.out[a as usize] = twin_after;
        self.out[b as usize] = after;
        self.out[c as usize] = twin;
        self.out[d as usize] = edge;
    }

    /// A triangle of that face whose other fields are still to be set.
    pub(super) fn new_triangle(&mut self, face: u32) -> u32 {
        if let Some(triangle) = self.unused.pop() {
            self.face_of[triangle as usize] = face;
            return triangle;
        }
        let triangle = self.face_of.len() as u32;
        self.face_of.push(face);
        for list in [&mut self.origin, &mut self.twin, &mut self.piece_of] {
            list.extend([NONE; 3]);
        }
        triangle
    }

    pub(super) fn set_origins(&mut self, triangle: u32, corners: [u32; 3]) {
        for (edge, corner) in (3 * triangle..).zip(corners) {
            self.origin[edge as usize] = corner;
            self.out[corner as usize] = edge;
        }
    }

    /// Makes two half-edges each other's twins, on a piece or on none.
    pub(super) fn link(&mut self, edge: u32, twin: u32, piece: u32) {
        self.twin[edge as usize] = twin;
        self.piece_of[edge as usize] = piece;
        if twin != NONE {
            self.twin[twin as usize] = edge;
            self.piece_of[twin as usize] = piece;
        }
        if piece != NONE {
            self.pieces[piece as usize].edge = edge;
        }
    }
}
