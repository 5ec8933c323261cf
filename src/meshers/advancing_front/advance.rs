//! One step: the triangle over the base, and the front around it.

use super::candidates::Apex;
use super::front::{Front, NONE, OPEN, Triangle};
use super::ideal_point::Base;
use crate::meshers::MeshError;

/// Nodes up to this number of edges away along the front are near neighbours of the base: connecting to them is not a seam.
const NEIGHBOURS: usize = 4;

impl Front<'_> {
    /// Makes the triangle of the base and an apex. Sides that were on the front leave it; the others join it and are
    /// returned.
    pub fn advance(&mut self, base: &Base, apex: Apex) -> Result<[Option<u32>; 2], MeshError> {
        let [a, b] = base.ends;
        let node = match apex {
            Apex::Node(node) => node,
            Apex::New(at, size) => {
                let size = if size.is_finite() { size } else { self.sizing.at(at)? };
                for end in [a, b].map(|end| self.nodes[end as usize]) {
                    self.sizing.agree([at, end.at], [size, end.size])?;
                }
                self.add_node(at, size)?
            }
        };
        let closed = [self.between(b, node), self.between(node, a)];
        let is_seam = self.joins_fronts(base, apex, closed);
        let triangle = self.add_triangle(base.edge, [a, b, node], closed, is_seam);
        let edge = *self.edge(base.edge);
        let sides = [(closed[0], node, b), (closed[1], a, node)].map(|(closed, from, to)| {
            closed.is_none().then(|| {
                let side = self.add_edge(from, to, edge.face, triangle);
                self.edges[side as usize].row = edge.row + 1;
                self.edges[side as usize].bridges = is_seam;
                side
            })
        });
        let changed = self.join(base.edge, node, closed, sides);
        self.remove_edge(base.edge);
        closed.into_iter().flatten().for_each(|edge| self.remove_edge(edge));
        sides.into_iter().flatten().for_each(|side| self.enqueue(side));
        changed.into_iter().flatten().for_each(|edge| self.enqueue_cleft(edge));
        Ok(sides)
    }

    /// Adds the triangle to the mesh, and notes it across the sides of its neighbours.
    fn add_triangle(&mut self, base: u32, corners: [u32; 3], closed: [Option<u32>; 2], is_seam: bool) -> u32 {
        let triangle = self.triangles.len() as u32;
        let mut across = [OPEN; 3];
        for (side, edge) in [Some(base), closed[0], closed[1]].into_iter().enumerate() {
            if let Some(edge) = edge {
                let edge = *self.edge(edge);
                across[side] = edge.right;
                self.set_across(edge.right, edge.to, edge.from, triangle);
            }
        }
        self.triangles.push(Triangle {
            corners,
            across,
            face: self.edge(base).face,
            is_seam,
        });
        triangle
    }

    /// Notes what lies across the side of a triangle that goes from `from` to `to`.
    pub fn set_across(&mut self, triangle: u32, from: u32, to: u32, what: u32) {
        if triangle != NONE {
            let triangle = &mut self.triangles[triangle as usize];
            if let Some(side) = triangle.side(from, to) {
                triangle.across[side] = what;
            }
        }
    }

    /// Links the new sides (from the apex to b, from a to the apex) into the front, before the base and the closed
    /// edges leave it, and returns the edges whose wedge with the next one changed.
    fn join(&mut self, base: u32, node: u32, closed: [Option<u32>; 2], sides: [Option<u32>; 2]) -> [Option<u32>; 2] {
        let (before, next) = (self.edge(base).before, self.edge(base).next);
        match (sides, closed) {
            ([Some(to_b), Some(from_a)], _) => {
                let into = self.wedge_at_apex(node, to_b, from_a);
                self.link(before, from_a);
                self.link(to_b, next);
                match into {
                    Some((into, out)) => {
                        self.link(into, to_b);
                        self.link(from_a, out);
                        self.remove_lonely(node);
                        [Some(before), (into != from_a).then_some(into)]
                    }
                    None => {
                        self.link(from_a, to_b);
                        self.remove_lonely(node);
                        [Some(before), None]
                    }
                }
            }
            ([None, Some(from_a)], [Some(closed), _]) => {
                self.link(before, from_a);
                self.link(from_a, self.edge(closed).next);
                [Some(before), None]
            }
            ([Some(to_b), None], [_, Some(closed)]) => {
                let into = self.edge(closed).before;
                self.link(into, to_b);
                self.link(to_b, next);
                [Some(into), None]
            }
            (_, [Some(first), Some(second)]) => {
                let (into, out) = (self.edge(second).before, self.edge(first).next);
                if first != into {
                    self.link(into, out);
                    return [Some(into), None];
                }
                [None, None]
            }
            _ => [None, None],
        }
    }

    /// The edges that enter and leave the apex on both sides of the triangle; none if nothing else touches the apex.
    fn wedge_at_apex(&self, node: u32, to_b: u32, from_a: u32) -> Option<(u32, u32)> {
        let towards = self.at(self.edge(from_a).from);
        let mut others = self
            .leaving(node)
            .filter(|&out| out != to_b && self.edge(out).to != node);
        let first = others.next()?;
        let out = match others.next() {
            None => first,
            Some(_) => self.wedge_towards(node, towards, to_b)?,
        };
        Some((self.edge(out).before, out))
    }

    /// Removes the edge from a node to itself.
    fn remove_lonely(&mut self, node: u32) {
        if let Some(lonely) = self.between(node, node) {
            self.remove_edge(lonely);
        }
    }

    /// Whether the triangle joins parts of the front that were far from each other along it: its apex is not a near
    /// neighbour of the base, or it continues such a triangle.
    fn joins_fronts(&self, base: &Base, apex: Apex, closed: [Option<u32>; 2]) -> bool {
        let Apex::Node(node) = apex else { return false };
        let bridges = |edge: u32| self.edge(edge).bridges;
        if bridges(base.edge) || closed.into_iter().flatten().any(bridges) {
            return true;
        }
        let (mut ahead, mut behind) = (base.edge, base.edge);
        for _ in 0..NEIGHBOURS {
            ahead = self.edge(ahead).next;
            behind = self.edge(behind).before;
            if self.edge(ahead).to == node || self.edge(behind).from == node {
                return false;
            }
        }
        true
    }
}
