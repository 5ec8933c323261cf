//! The front: what biting has left uncovered, as arcs of biting circles with their vertices.
//!
//! # Idea
//! The front is the boundary of what no biting circle covers yet. Once the input boundary is bitten, the front consists
//! of arcs of biting circles only, and two neighbouring arcs meet at a front vertex. So the front is kept as its
//! vertices, each filed under its two circles; the arcs of a circle run between the vertices filed under it. A new bite
//! meets a bounded number of circles, all of them near and of similar radius ([`DiscGrid`]). The vertices filed under
//! those circles and inside the bite are removed. The points where the new circle leaves those circles become new
//! vertices, unless another circle covers them.
//!
//! # Cost
//! O(1) per bite, however graded the spacing is; nothing is scanned globally or rebuilt.

use crate::domain::Domain;
use crate::geometry::near::{Disc, DiscGrid, Near};
use crate::geometry::{DVec2, tolerance};
use crate::meshers::biting::Biting;
use crate::meshers::biting::beyond::corners::Cuts;
use crate::meshers::biting::beyond::inside::Inside;
use crate::meshers::biting::beyond::notches::Notches;
use crate::meshers::biting::beyond::rule::Meeting;
use crate::meshers::biting::order::{Queue, RANK_STEP, Ticket};
use crate::meshers::sizing::Sizing;
use crate::meshers::{Bite, MeshError, Monitor, Reason, Request, Waiting};
use crate::spacing::Spacing;
use crate::theory::Rule;

/// A point where the arcs of two biting circles meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrontVertex {
    pub point: DVec2,
    /// By the rule of the later point, g there: every bitten point nearer than that has eaten it.
    pub reach: Option<f64>,
    /// The two circles that meet there.
    pub discs: [u32; 2],
    /// Their centres, relative to the point.
    pub centres: [DVec2; 2],
}

impl FrontVertex {
    /// Cosine of the angle under which the vertex sees its two centres; the uneaten wedge is π minus that angle.
    pub fn cosine_at_front(&self) -> f64 {
        cosine(self.centres[0], self.centres[1])
    }

    /// 2 |area| / Σ edge² of the triangle of the vertex and its two centres: at most 1 / (2 √3), if equilateral.
    pub fn shape_with_centres(&self) -> f64 {
        let [first, second] = self.centres;
        let squares = first.length_squared() + second.length_squared() + first.distance_squared(second);
        first.perp_dot(second).abs() / squares
    }
}

fn cosine(u: DVec2, v: DVec2) -> f64 {
    u.dot(v) / (u.length_squared() * v.length_squared()).sqrt()
}

/// A stored front vertex, filed under two circles by two linked lists.
#[derive(Clone, Copy, Debug)]
struct Slot {
    point: DVec2,
    reach: Option<f64>,
    discs: [u32; 2],
    /// The next vertex under each of the two circles.
    next: [u32; 2],
    /// Distinguishes this vertex from earlier ones in its slot; [`NONE`] once it is bitten away.
    serial: u32,
}

const NONE: u32 = u32::MAX;

/// All biting circles so far and the front they leave.
pub(super) struct Front<'a> {
    pub domain: &'a Domain,
    /// The corners that are cut off.
    pub cuts: &'a Cuts,
    /// The notches, across which circles cover nothing.
    notches: &'a Notches,
    /// For each circle, whether it may hold points that its centre cannot see.
    pub beside_notch: Vec<bool>,
    /// What circles reach inside the domain, if only that counts.
    inside: Option<Inside>,
    pub radii: Sizing<'a>,
    pub rule: Rule,
    /// The biting circles, in the order of bites.
    pub bitten: DiscGrid,
    /// The number of them that are centred on the input boundary; they come first.
    boundary_count: u32,
    /// First front vertex filed under each circle.
    first_vertex: Vec<u32>,
    slots: Vec<Slot>,
    free_slots: Vec<u32>,
    serials: u32,
    queue: Queue,
    near: Vec<Near>,
    /// The two circles on which the vertex taken last lies.
    parents: [u32; 2],
    monitor: Monitor,
    /// The list of all bites, if they are to be noted.
    pub log: Option<Vec<Bite>>,
}

impl<'a> Front<'a> {
    /// The front before the first bite: the boundary of the domain.
    pub fn new(
        domain: &'a Domain,
        cuts: &'a Cuts,
        (notches, inside): (&'a Notches, Option<Inside>),
        spacing: &'a dyn Spacing,
        biting: &Biting,
        request: &Request,
    ) -> Self {
        let radii = Sizing::new(domain, spacing, request);
        Self {
            domain,
            cuts,
            notches,
            beside_notch: Vec::new(),
            inside,
            radii,
            rule: biting.rule,
            bitten: DiscGrid::new(radii.t()),
            boundary_count: u32::MAX,
            first_vertex: Vec::new(),
            slots: Vec::new(),
            free_slots: Vec::new(),
            serials: 0,
            queue: Queue::new(biting.order, request.seed),
            near: Vec::new(),
            parents: [0; 2],
            monitor: Monitor::new(&request.budget),
            log: None,
        }
    }

    /// c_b f(x). Refused if f breaks its contract or the coordinates cannot resolve it.
    pub fn radius_at(&self, x: DVec2) -> Result<f64, MeshError> {
        self.radii.at(x)
    }

    /// Bites at a point of the input boundary and returns the number of the mesh vertex. [`Front::open`] adds the arcs,
    /// once the boundary is covered.
    pub fn bite_boundary(&mut self, disc: Disc, reason: Reason) -> Result<u32, MeshError> {
        // Vertices cut off are mesh vertices too, but get no circle.
        Ok(self.insert(disc, reason)? + self.cuts.count as u32)
    }

    /// The mesh vertices: the input's, then all other centres in the order in which they were bitten.
    pub fn centres(&self) -> Vec<DVec2> {
        let input = self.domain.vertices();
        let others = self.bitten.discs().skip(input.len() - self.cuts.count);
        input.iter().copied().chain(others.map(|disc| disc.centre)).collect()
    }

    /// Whether a bitten disc covers a point that it holds: no notch stands between its centre and the point and, if
    /// distances are measured inside the domain, the disc reaches the point.
    pub fn sees(&self, id: u32, point: DVec2) -> bool {
        let is_parted = self.beside_notch[id as usize] && self.notches.part(self.bitten.disc(id).centre, point);
        !is_parted && self.inside.as_ref().is_none_or(|inside| inside.reaches(id, point))
    }

    /// Starts the front once the input boundary is covered: its vertices are those between boundary circles inside the
    /// domain.
    pub fn open(&mut self) -> Result<(), MeshError> {
        self.boundary_count = self.bitten.len() as u32;
        for id in 0..self.boundary_count {
            let disc = self.bitten.disc(id);
            let mut near = std::mem::take(&mut self.near);
            self.near_bite(disc, &mut near);
            near.retain(|other| other.id != id);
            let result = self.add_vertices(disc, id, &near, |other| other < id);
            self.near = near;
            result?;
        }
        Ok(())
    }

    /// Takes the next front vertex in the order of bites.
    pub fn next_vertex(&mut self) -> Option<DVec2> {
        while let Some(ticket) = self.queue.pop() {
            let slot = &self.slots[ticket.slot as usize];
            if slot.serial == ticket.serial {
                self.parents = slot.discs;
                return Some(slot.point);
            }
        }
        None
    }

    /// Bites at the front vertex `x`: removes the part of the front inside the new circle, and adds the circle's arcs.
    pub fn bite(&mut self, x: DVec2) -> Result<(), MeshError> {
        let disc = Disc {
            centre: x,
            radius: self.radius_at(x)?,
        };
        for parent in self.parents.map(|id| self.bitten.disc(id)) {
            self.radii.agree([x, parent.centre], [disc.radius, parent.radius])?;
        }
        let mut near = std::mem::take(&mut self.near);
        self.near_bite(disc, &mut near);
        let id = self.insert(disc, Reason::FrontVertex)?;
        self.remove_vertices(disc, id, &near);
        let result = self.add_vertices(disc, id, &near, |_| true);
        self.near = near;
        result
    }

    fn insert(&mut self, disc: Disc, reason: Reason) -> Result<u32, MeshError> {
        self.monitor.placed(self.bitten.len() + 1, disc.centre, disc.radius)?;
        if let Some(log) = &mut self.log {
            log.push(Bite::new(disc.centre, disc.radius, reason));
        }
        self.first_vertex.push(NONE);
        self.beside_notch.push(self.notches.are_near(self.around_bite(disc)));
        self.inside.iter_mut().for_each(|inside| inside.add(disc));
        Ok(self.bitten.insert(disc))
    }

    /// Removes the front vertices inside `disc`. Both circles of such a vertex meet `disc`, so both are in `near`: the
    /// first visit takes the vertex out of one list, the second takes it out of the other and frees its slot.
    fn remove_vertices(&mut self, disc: Disc, id: u32, near: &[Near]) {
        for other in near {
            let mut before = None;
            let mut index = self.first_vertex[other.id as usize];
            while index != NONE {
                let slot = self.slots[index as usize];
                let side = usize::from(slot.discs[1] == other.id);
                let next = slot.next[side];
                let inside = (slot.reach.unwrap_or(disc.radius) * (1.0 - tolerance::COVERED)).powi(2);
                if slot.point.distance_squared(disc.centre) < inside && self.sees(id, slot.point) {
                    if slot.serial == NONE {
                        self.free_slots.push(index);
                    } else if let Some(bite) = self.log.as_mut().and_then(|log| log.last_mut()) {
                        bite.bite_away(slot.serial, slot.point);
                    }
                    self.slots[index as usize].serial = NONE;
                    match before {
                        None => self.first_vertex[other.id as usize] = next,
                        Some((previous, side)) => self.slots[previous as usize].next[side] = next,
                    }
                } else {
                    before = Some((index, side));
                }
                index = next;
            }
        }
    }

    /// Adds the points where the circle `id` leaves the circles `near` (those that `wanted` admits), unless another
    /// circle covers them or they lie outside what is to be bitten.
    fn add_vertices(
        &mut self,
        disc: Disc,
        id: u32,
        near: &[Near],
        wanted: impl Fn(u32) -> bool,
    ) -> Result<(), MeshError> {
        // The boundary is covered, so a circle that reaches across it meets a circle centred on it.
        let near_boundary = id < self.boundary_count || near.iter().any(|other| other.id < self.boundary_count);
        for (index, other) in near.iter().enumerate() {
            if !wanted(other.id) {
                continue;
            }
            for Meeting { relative, reach } in self.meetings(disc, near, index)? {
                let point = disc.centre + relative;
                let is_covered = self.is_covered(relative, point, reach, near, index);
                if is_covered || !self.sees(id, point) || !self.sees(other.id, point) {
                    continue;
                }
                if near_boundary && (!self.domain.contains(point) || self.cuts.hold(point)) {
                    continue;
                }
                let vertex = FrontVertex {
                    point,
                    reach,
                    discs: [id, other.id],
                    centres: [-relative, other.offset - relative],
                };
                self.file(&vertex)?;
            }
        }
        Ok(())
    }

    /// Files a front vertex under its two circles and queues it.
    fn file(&mut self, vertex: &FrontVertex) -> Result<(), MeshError> {
        let serial = self.serials;
        self.serials += 1;
        let next = vertex.discs.map(|disc| self.first_vertex[disc as usize]);
        let slot = Slot {
            point: vertex.point,
            reach: vertex.reach,
            discs: vertex.discs,
            next,
            serial,
        };
        let index = match self.free_slots.pop() {
            Some(index) => {
                self.slots[index as usize] = slot;
                index
            }
            None => {
                self.slots.push(slot);
                (self.slots.len() - 1) as u32
            }
        };
        vertex
            .discs
            .iter()
            .for_each(|&disc| self.first_vertex[disc as usize] = index);
        let (spacing, point) = (self.radii.spacing, vertex.point);
        let rank = self
            .queue
            .push(Ticket { serial, slot: index }, vertex, || spacing.at(point));
        if let Some(bite) = self.log.as_mut().and_then(|log| log.last_mut()) {
            bite.appeared.push(Waiting {
                serial,
                point,
                circles: vertex.discs,
                rank: rank as f64 * RANK_STEP,
            });
        }
        Ok(())
    }

    /// Whether a disc of `near` other than the one at `except` covers the point. Radii count as a little smaller than
    /// they are, so that a vertex on several circles at once is kept.
    fn is_covered(&self, relative: DVec2, point: DVec2, reach: Option<f64>, near: &[Near], except: usize) -> bool {
        near.iter().enumerate().any(|(index, other)| {
            let shrunk = reach.unwrap_or(other.radius) * (1.0 - tolerance::COVERED);
            index != except && relative.distance_squared(other.offset) < shrunk * shrunk && self.sees(other.id, point)
        })
    }
}
