//! The front: the boundary of what is not meshed yet, as directed edges with the unmeshed side on their left.
//!
//! Each edge has links to its neighbours along the front, and each node to the front edges that leave and enter it. A
//! node where the front touches itself has several of each. Edges are indexed in space by [`SegmentGrid`]. A vertex
//! that no segment touches is a front of its own: an edge from the node to itself, which disappears when the node is
//! connected.

use super::queue::Queue;
use super::{AdvancingFront, Tally};
use crate::domain::Domain;
use crate::geometry::predicates::orient2d;
use crate::geometry::segment_grid::SegmentGrid;
use crate::geometry::{DVec2, turn};
use crate::meshers::sizing::Sizing;
use crate::meshers::{MeshError, Monitor};
use std::cmp::Ordering;

/// No node, edge or triangle.
pub(super) const NONE: u32 = u32::MAX;

/// A node of the mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub at: DVec2,
    /// s there, so that it is evaluated once per node.
    pub size: f64,
    /// The first of the front edges that leave it, and the first of those that enter it.
    first_out: u32,
    first_in: u32,
}

/// A directed edge of the front.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub from: u32,
    pub to: u32,
    /// Neighbours along the front.
    pub next: u32,
    pub before: u32,
    /// Next edge that leaves `from`, and next one that enters `to`.
    next_out: u32,
    next_in: u32,
    /// The triangle on the right; [`NONE`] on the boundary.
    pub right: u32,
    /// The domain's face on the left.
    pub face: u32,
    /// Distinguishes the edge from earlier ones in its slot; [`NONE`] once it is gone.
    pub serial: u32,
    /// The row in which it was made: 0 on the boundary.
    pub row: u32,
    /// How often it could not be closed, at most [`super::attempt::ATTEMPTS`].
    pub attempts: u8,
    /// Whether it joins two parts of the front that were far from each other along it.
    pub bridges: bool,
}

/// A triangle, and what lies across its sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Counter-clockwise; all [`NONE`] once it is deleted.
    pub corners: [u32; 3],
    /// Across ab, bc, ca: a triangle, or [`NONE`] on the boundary, or [`OPEN`] on the front.
    pub across: [u32; 3],
    pub face: u32,
    /// Whether it joined parts of the front that were far from each other along it.
    pub is_seam: bool,
}

/// The mark across a side of a triangle beyond which nothing is meshed yet.
pub(super) const OPEN: u32 = u32::MAX - 1;

impl Triangle {
    pub fn is_deleted(&self) -> bool {
        self.corners[0] == NONE
    }

    /// Which of the sides ab, bc, ca goes from `from` to `to`.
    pub fn side(&self, from: u32, to: u32) -> Option<usize> {
        (0..3).find(|&k| self.corners[k] == from && self.corners[(k + 1) % 3] == to)
    }
}

/// The front, and the mesh behind it.
pub(super) struct Front<'a> {
    pub method: &'a AdvancingFront,
    pub domain: &'a Domain,
    pub sizing: Sizing<'a>,
    pub monitor: Monitor,
    pub nodes: Vec<Node>,
    pub edges: Vec<Edge>,
    free: Vec<u32>,
    /// The number of edges.
    pub length: usize,
    pub grid: SegmentGrid,
    pub queue: Queue,
    serials: u32,
    pub triangles: Vec<Triangle>,
    /// The places where the front was opened up.
    pub openings: SegmentGrid,
    pub opened_at: Vec<DVec2>,
    pub tally: Tally,
}

impl<'a> Front<'a> {
    pub fn new(method: &'a AdvancingFront, domain: &'a Domain, sizing: Sizing<'a>, monitor: Monitor) -> Self {
        Self {
            method,
            domain,
            sizing,
            monitor,
            nodes: Vec::new(),
            edges: Vec::new(),
            free: Vec::new(),
            length: 0,
            grid: SegmentGrid::default(),
            queue: Queue::new(method.advance),
            serials: 0,
            triangles: Vec::new(),
            openings: SegmentGrid::default(),
            opened_at: Vec::new(),
            tally: Tally::default(),
        }
    }

    pub fn at(&self, node: u32) -> DVec2 {
        self.nodes[node as usize].at
    }

    pub fn edge(&self, edge: u32) -> &Edge {
        &self.edges[edge as usize]
    }

    /// Whether the slot `edge` still holds the edge with that serial number.
    pub fn stands(&self, edge: u32, serial: u32) -> bool {
        self.edges[edge as usize].serial == serial
    }

    /// All edges of the front.
    pub fn live(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.edges.len() as u32).filter(|&edge| self.edges[edge as usize].serial != NONE)
    }

    pub fn add_node(&mut self, at: DVec2, size: f64) -> Result<u32, MeshError> {
        self.nodes.push(Node {
            at,
            size,
            first_out: NONE,
            first_in: NONE,
        });
        self.monitor.placed(self.nodes.len(), at, size)?;
        Ok((self.nodes.len() - 1) as u32)
    }

    /// Adds an edge that is not linked to its neighbours yet. An edge from a node to itself stands for a node that no
    /// other edge touches.
    pub fn add_edge(&mut self, from: u32, to: u32, face: u32, right: u32) -> u32 {
        let slot = self.free.pop().unwrap_or(self.edges.len() as u32);
        let edge = Edge {
            from,
            to,
            next: slot,
            before: slot,
            next_out: self.nodes[from as usize].first_out,
            next_in: self.nodes[to as usize].first_in,
            right,
            face,
            serial: self.serials,
            row: 0,
            attempts: 0,
            bridges: false,
        };
        self.serials += 1;
        self.length += 1;
        self.nodes[from as usize].first_out = slot;
        self.nodes[to as usize].first_in = slot;
        let (p, q) = (self.at(from), self.at(to));
        let extent = if from == to {
            self.nodes[from as usize].size
        } else {
            p.distance(q)
        };
        self.grid.insert(slot, p.midpoint(q), extent);
        match self.edges.get_mut(slot as usize) {
            Some(known) => *known = edge,
            None => self.edges.push(edge),
        }
        slot
    }

    pub fn remove_edge(&mut self, slot: u32) {
        let edge = self.edges[slot as usize];
        self.unlist(slot, edge.from, edge.to);
        self.edges[slot as usize].serial = NONE;
        self.free.push(slot);
        self.length -= 1;
        self.grid.remove(slot);
    }

    /// Takes an edge out of the lists of its nodes.
    fn unlist(&mut self, slot: u32, from: u32, to: u32) {
        let edge = self.edges[slot as usize];
        let out = &mut self.nodes[from as usize].first_out;
        if *out == slot {
            *out = edge.next_out;
        } else {
            let mut at = *out;
            while self.edges[at as usize].next_out != slot {
                at = self.edges[at as usize].next_out;
            }
            self.edges[at as usize].next_out = edge.next_out;
        }
        let into = &mut self.nodes[to as usize].first_in;
        if *into == slot {
            *into = edge.next_in;
        } else {
            let mut at = *into;
            while self.edges[at as usize].next_in != slot {
                at = self.edges[at as usize].next_in;
            }
            self.edges[at as usize].next_in = edge.next_in;
        }
    }

    /// The front edges that leave a node.
    pub fn leaving(&self, node: u32) -> impl Iterator<Item = u32> + '_ {
        let mut edge = self.nodes[node as usize].first_out;
        std::iter::from_fn(move || {
            let found = (edge != NONE).then_some(edge);
            edge = found.map_or(NONE, |edge| self.edges[edge as usize].next_out);
            found
        })
    }

    /// The front edges that enter a node.
    pub fn entering(&self, node: u32) -> impl Iterator<Item = u32> + '_ {
        let mut edge = self.nodes[node as usize].first_in;
        std::iter::from_fn(move || {
            let found = (edge != NONE).then_some(edge);
            edge = found.map_or(NONE, |edge| self.edges[edge as usize].next_in);
            found
        })
    }

    /// The front edge from one node to another.
    pub fn between(&self, from: u32, to: u32) -> Option<u32> {
        self.leaving(from).find(|&edge| self.edges[edge as usize].to == to)
    }

    /// Makes `next` follow `edge` along the front.
    pub fn link(&mut self, edge: u32, next: u32) {
        self.edges[edge as usize].next = next;
        self.edges[next as usize].before = edge;
    }

    /// Links all edges at a node anew. Counter-clockwise from an edge that leaves lies what is not meshed, up to the
    /// next edge: that one enters the node, and comes before the leaving one along the front.
    pub fn relink(&mut self, node: u32) {
        let centre = self.at(node);
        let mut around: Vec<(DVec2, bool, u32)> = Vec::new();
        around.extend(self.leaving(node).map(|e| (self.at(self.edge(e).to), true, e)));
        around.extend(self.entering(node).map(|e| (self.at(self.edge(e).from), false, e)));
        // If both sides of a segment are open, the edge that enters closes the sector before.
        around.sort_by(|p, q| by_angle(centre, p.0, q.0).then(p.1.cmp(&q.1)));
        for (k, &(_, leaves, edge)) in around.iter().enumerate() {
            let (_, other_leaves, other) = around[(k + 1) % around.len()];
            if leaves && !other_leaves {
                self.link(other, edge);
            }
        }
    }

    /// The angle of what is not meshed, in radians, between an edge and the next one.
    pub fn wedge(&self, edge: u32) -> f64 {
        let (this, next) = (self.edge(edge), self.edge(self.edge(edge).next));
        let tip = self.at(this.to);
        turn(self.at(next.to) - tip, self.at(this.from) - tip)
    }

    /// The edge that leaves `node`, other than `except`, in whose wedge `towards` lies, decided exactly.
    pub fn wedge_towards(&self, node: u32, towards: DVec2, except: u32) -> Option<u32> {
        let tip = self.at(node);
        self.leaving(node).filter(|&out| out != except).find(|&out| {
            let low = self.at(self.edge(out).to);
            let high = self.at(self.edge(self.edge(out).before).from);
            if orient2d(tip, low, high) > 0.0 {
                orient2d(tip, low, towards) > 0.0 && orient2d(tip, towards, high) > 0.0
            } else {
                orient2d(tip, high, towards) < 0.0 || orient2d(tip, towards, low) < 0.0
            }
        })
    }

    /// Puts an edge in the queue as a base, and as a cleft if the next edge forms one with it.
    pub fn enqueue(&mut self, edge: u32) {
        let this = self.edges[edge as usize];
        let length = self.at(this.from).distance(self.at(this.to));
        self.queue.push_base(&this, edge, length);
        self.enqueue_cleft(edge);
    }

    /// Puts an edge in the queue ahead of others if it forms a cleft with the next one.
    pub fn enqueue_cleft(&mut self, edge: u32) {
        let this = self.edges[edge as usize];
        if this.next != edge && self.wedge(edge) < self.method.cleft.to_radians() {
            let next = self.edge(this.next).to;
            let [p, q] = [this.from, next].map(|end| self.at(end).distance(self.at(this.to)));
            self.queue.push_cleft(&this, edge, p.min(q));
        }
    }
}

/// Counter-clockwise order of two points around `centre`, from the direction of +x, decided exactly.
fn by_angle(centre: DVec2, p: DVec2, q: DVec2) -> Ordering {
    let lower = |p: DVec2| !(p.y > centre.y || (p.y == centre.y && p.x > centre.x));
    lower(p)
        .cmp(&lower(q))
        .then_with(|| 0.0f64.total_cmp(&(orient2d(centre, p, q) + 0.0)))
}
