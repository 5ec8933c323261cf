//! The state of a refinement: what is known of vertices, pieces and triangles; how encroached pieces are split.

use super::DelaunayRefinement;
use super::pieces::{FLOOR, Left, Nearness, Shells, in_diametral_circle};
use super::queue::{Queue, Ticket};
use super::triangles::{Bounds, Flaw, NewPoint, Shape};
use crate::delaunay::{Cavity, Refinable, following};
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::meshers::sizing::Sizing;
use crate::meshers::{MeshError, Monitor, Request, Trace};
use crate::spacing::Spacing;
use std::collections::VecDeque;

/// A piece to be split, with its ends, which show whether it is still there, and the reason of the split.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encroached {
    pub piece: u32,
    pub ends: [u32; 2],
    pub flaw: Flaw,
}

/// The state of a refinement.
pub(super) struct Refiner<'a> {
    pub triangulation: Refinable,
    pub(super) bounds: Bounds<'a>,
    pub(super) new_point: NewPoint,
    pub(super) nearness: Nearness,
    pub(super) shells: Shells,
    pub(super) monitor: Monitor,
    /// Coordinates do not resolve points closer than this well enough.
    pub(super) resolution: f64,
    pub(super) encroached: VecDeque<Encroached>,
    pub(super) queue: Queue,
    /// Whether bad triangles are queued yet: not before all pieces that the input encroaches upon are split.
    pub(super) tests_triangles: bool,
    pub(super) cavity: Cavity,
    /// s at each vertex.
    pub(super) sizes: Vec<f64>,
    /// At each vertex, how near another one may come to improve an angle; it grows with slope [`FLOOR`] at most.
    pub(super) floors: Vec<f64>,
    /// Pieces that cannot be split because of rounding.
    pub(super) unsplittable: Vec<(u32, [u32; 2])>,
    pub(super) left: Vec<(Ticket, Left)>,
    pub(super) circumcentres: usize,
    pub(super) splits: usize,
    pub(super) removed: usize,
}

/// Twice the sine of half the smallest input angle at a vertex that opens into the domain, at most 1: the length of the edge
/// between two segments at distance 1.
fn sharpness(domain: &Domain, vertex: usize) -> f64 {
    let inside = domain.wedges(vertex).iter().filter(|wedge| wedge.inside);
    inside.fold(1.0, |least, wedge| least.min(2.0 * (0.5 * wedge.angle).sin()))
}

impl<'a> Refiner<'a> {
    /// Measures how small edges may become, and queues the pieces upon which the input encroaches.
    pub fn new(
        parameters: &DelaunayRefinement,
        triangulation: Refinable,
        domain: &Domain,
        spacing: &'a dyn Spacing,
        request: &Request,
    ) -> Result<Self, MeshError> {
        let sizing = Sizing::new(domain, spacing, request);
        let bounds = Bounds::new(parameters, sizing);
        let sizes = domain.vertices().iter().map(|&x| bounds.size_at_vertex(x));
        let mut refiner = Self {
            sizes: sizes.collect::<Result<_, _>>()?,
            shells: Shells::new(domain, |x| bounds.size_at_vertex(x))?,
            floors: Vec::new(),
            triangulation,
            bounds,
            new_point: NewPoint::new(parameters),
            nearness: Nearness::new(parameters),
            monitor: Monitor::new(&request.budget),
            resolution: sizing.smallest(),
            encroached: VecDeque::new(),
            queue: Queue::new(),
            tests_triangles: false,
            cavity: Cavity::default(),
            unsplittable: Vec::new(),
            left: Vec::new(),
            circumcentres: 0,
            splits: 0,
            removed: 0,
        };
        refiner.floors = (0..domain.vertices().len() as u32)
            .map(|vertex| FLOOR * refiner.room(vertex) * sharpness(domain, vertex as usize))
            .collect();
        for piece in 0..refiner.triangulation.piece_count() as u32 {
            refiner.test_piece(piece)?;
        }
        Ok(refiner)
    }

    /// Distance from a vertex to the nearest of its neighbours and of the pieces opposite to it.
    fn room(&self, vertex: u32) -> f64 {
        let x = self.triangulation.point(vertex);
        let mut room = f64::INFINITY;
        for edge in self.triangulation.around(vertex) {
            let [a, b] = self.opposite(edge);
            room = room.min(x.distance(a)).min(x.distance(b));
            let facing = (x - a).dot(b - a) > 0.0 && (x - b).dot(a - b) > 0.0;
            if facing {
                room = room.min((b - a).perp_dot(x - a).abs() / a.distance(b));
            }
        }
        room
    }

    /// The ends of the edge opposite to the vertex at which a half-edge starts.
    fn opposite(&self, edge: u32) -> [DVec2; 2] {
        let [_, next] = self.triangulation.ends(edge);
        [next, self.triangulation.apex(edge)].map(|vertex| self.triangulation.point(vertex))
    }

    pub(super) fn piece_ends(&self, piece: u32) -> ([u32; 2], [DVec2; 2]) {
        let piece = self.triangulation.piece(piece);
        let ends = [piece.a, piece.b];
        (ends, ends.map(|vertex| self.triangulation.point(vertex)))
    }

    /// Queues a piece if it is too long by itself, or if the apex of a triangle beside it encroaches upon it.
    pub(super) fn test_piece(&mut self, piece: u32) -> Result<(), MeshError> {
        let (ends, places) = self.piece_ends(piece);
        let flaw = if self.bounds.is_too_long(places)? {
            Flaw::Size
        } else {
            let mut sides = self.triangulation.inner_sides(piece);
            let apex = |side| self.triangulation.point(self.triangulation.apex(side));
            if !sides.any(|side| self.nearness.encroaches(places, apex(side))) {
                return Ok(());
            }
            Flaw::Angle
        };
        self.encroached.push_back(Encroached { piece, ends, flaw });
        Ok(())
    }

    /// Queues a triangle of the domain that is bad.
    pub(super) fn test_triangle(&mut self, triangle: u32) -> Result<(), MeshError> {
        if !self.tests_triangles || !self.triangulation.is_inside(triangle) {
            return Ok(());
        }
        let corners = self.triangulation.triangle(triangle);
        let places = corners.map(|vertex| self.triangulation.point(vertex));
        let sizes = corners.map(|vertex| self.sizes[vertex as usize]);
        let shape = Shape::of(places);
        let Some(flaw) = self.bounds.flaw(places, sizes, &shape)? else {
            return Ok(());
        };
        let ticket = Ticket {
            triangle,
            corners,
            flaw,
        };
        // Of the edges ab, bc, ca, the two other than the shortest meet at the smallest angle.
        let beside = [1, 2].map(|k| 3 * triangle + (shape.shortest as u32 + k) % 3);
        if flaw == Flaw::Angle && beside.iter().all(|&edge| self.triangulation.piece_on(edge).is_some()) {
            self.left.push((ticket, Left::AtAcuteVertex));
        } else {
            self.queue.push(ticket, shape.length_squared);
        }
        Ok(())
    }

    /// Splits pieces until none is encroached upon, except those that may not be split.
    pub fn split_encroached(&mut self) -> Result<(), MeshError> {
        while let Some(Encroached { piece, ends, flaw }) = self.encroached.pop_front() {
            if self.piece_ends(piece).0 == ends && self.may_split(piece, flaw).is_ok() {
                if self.nearness.clears {
                    self.clear_diametral_circle(piece)?;
                }
                self.split(piece, flaw)?;
            }
        }
        Ok(())
    }

    pub(super) fn may_split(&self, piece: u32, flaw: Flaw) -> Result<(), Left> {
        let (ends, places) = self.piece_ends(piece);
        let split = self.shells.split(&self.triangulation, piece);
        let floor = ends.map(|vertex| self.floors[vertex as usize]);
        if places[0].distance(places[1]) < 2.0 * self.resolution || self.unsplittable.contains(&(piece, ends)) {
            return Err(Left::ByRounding);
        }
        split.check(flaw, floor[0].min(floor[1]))
    }

    /// Removes the free vertices inside the diametral circle of a piece that see it (Chew).
    fn clear_diametral_circle(&mut self, piece: u32) -> Result<(), MeshError> {
        let (_, places) = self.piece_ends(piece);
        while let Some(vertex) = self.free_vertex_in_circle(piece, places) {
            self.triangulation.remove(vertex);
            self.removed += 1;
            self.test_changed()?;
        }
        Ok(())
    }

    fn free_vertex_in_circle(&self, piece: u32, places: [DVec2; 2]) -> Option<u32> {
        let apexes = self
            .triangulation
            .inner_sides(piece)
            .map(|side| self.triangulation.apex(side));
        let mut near = apexes.filter(|&apex| in_diametral_circle(places, self.triangulation.point(apex)));
        near.find(|&apex| self.triangulation.is_free(apex))
    }

    fn split(&mut self, piece: u32, flaw: Flaw) -> Result<(), MeshError> {
        let (ends, places) = self.piece_ends(piece);
        let split = self.shells.split(&self.triangulation, piece);
        let Some(vertex) = self.triangulation.split(piece, split.share) else {
            self.unsplittable.push((piece, ends));
            return Ok(());
        };
        self.splits += 1;
        let star: Vec<u32> = self.triangulation.around(vertex).collect();
        let x = self.triangulation.point(vertex);
        let around = star.iter().map(|&edge| self.triangulation.ends(edge)[1]);
        let floor = self.floor_at(x, around.chain(ends));
        let nearest = if flaw == Flaw::Size {
            FLOOR * x.distance(places[0]).min(x.distance(places[1]))
        } else {
            f64::INFINITY
        };
        self.add_vertex(x, floor.min(nearest))?;
        let behind = self.triangulation.piece_count() as u32 - 1;
        self.test_piece(piece)?;
        self.test_piece(behind)?;
        for edge in star {
            if let Some(piece) = self.triangulation.piece_on(following(edge)) {
                self.test_piece(piece)?;
            }
        }
        self.test_changed()
    }

    pub(super) fn floor_at(&self, x: DVec2, around: impl Iterator<Item = u32>) -> f64 {
        around.fold(f64::INFINITY, |floor, vertex| {
            let distance = x.distance(self.triangulation.point(vertex));
            floor.min(self.floors[vertex as usize] + FLOOR * distance)
        })
    }

    /// Notes size and floor of the vertex made last.
    pub(super) fn add_vertex(&mut self, x: DVec2, floor: f64) -> Result<(), MeshError> {
        let size = self.bounds.size_at_vertex(x)?;
        self.sizes.push(size);
        self.floors.push(floor);
        self.monitor.placed(self.sizes.len() - self.removed, x, size)
    }

    pub(super) fn test_changed(&mut self) -> Result<(), MeshError> {
        for k in 0..self.triangulation.changed().len() {
            self.test_triangle(self.triangulation.changed()[k])?;
        }
        Ok(())
    }

    /// Notes what was done, and how many triangles are left bad for which reason.
    pub fn count(&self, trace: &mut Trace) {
        trace.count("circumcentres", self.circumcentres as f64);
        trace.count("splits", self.splits as f64);
        trace.count("removed", self.removed as f64);
        let stands = |ticket: &Ticket| self.triangulation.triangle(ticket.triangle) == ticket.corners;
        for (name, reason) in [
            ("left_at_acute_vertex", Left::AtAcuteVertex),
            ("left_by_rounding", Left::ByRounding),
            ("left_by_floor", Left::ByFloor),
        ] {
            let left = self
                .left
                .iter()
                .filter(|(ticket, left)| *left == reason && stands(ticket));
            trace.count(name, left.count() as f64);
        }
    }
}
