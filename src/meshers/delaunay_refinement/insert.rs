//! Inserts points into bad triangles, one at a time.

use super::pieces::{FLOOR, Left};
use super::queue::Ticket;
use super::refiner::{Encroached, Refiner};
use super::triangles::{Flaw, NewPoint, Shape};
use crate::delaunay::{Cavity, Location};
use crate::geometry::DVec2;
use crate::meshers::MeshError;

/// A point that encroaches upon a piece at an acute vertex must not be nearer to it than this share of the point's
/// distance to the nearest vertex.
const CLEARANCE: f64 = 0.5;

impl Refiner<'_> {
    /// Breaks bad triangles until none is left but those that must stay as they are.
    pub fn insert_circumcentres(&mut self) -> Result<(), MeshError> {
        self.tests_triangles = true;
        for triangle in 0..self.triangulation.triangle_count() as u32 {
            self.test_triangle(triangle)?;
        }
        while let Some(ticket) = self.queue.pop() {
            if self.triangulation.triangle(ticket.triangle) == ticket.corners {
                if let Err(left) = self.insert_circumcentre(ticket)? {
                    self.left.push((ticket, left));
                }
                self.split_encroached()?;
            }
        }
        Ok(())
    }

    /// Inserts the circumcentre or off-centre of a bad triangle. If that encroaches upon pieces, queues these to be
    /// split, and the triangle again.
    fn insert_circumcentre(&mut self, ticket: Ticket) -> Result<Result<(), Left>, MeshError> {
        let places = ticket.corners.map(|vertex| self.triangulation.point(vertex));
        let shape = Shape::of(places);
        let x = self.new_point.of(places, &shape);
        let triangle = match self.triangulation.locate(ticket.triangle, x) {
            Location::Vertex(_) => return Ok(Err(Left::ByRounding)),
            Location::Piece(piece) => return self.split_instead(&[piece], ticket, places, &shape),
            Location::Triangle(triangle) => triangle,
        };
        let mut cavity = std::mem::take(&mut self.cavity);
        self.triangulation.dig(triangle, x, &mut cavity);
        let near = self.encroached_from(&cavity, x);
        let result = if near.is_empty() {
            self.fill(&cavity, x, ticket.flaw)
        } else {
            self.split_instead(&near, ticket, places, &shape)
        };
        self.cavity = cavity;
        result
    }

    /// Pieces on the rim of a cavity that its point encroaches upon.
    fn encroached_from(&self, cavity: &Cavity, x: DVec2) -> Vec<u32> {
        let on_rim = cavity
            .rim()
            .iter()
            .filter_map(|&edge| self.triangulation.piece_on(edge));
        on_rim
            .filter(|&piece| self.nearness.encroaches(self.piece_ends(piece).1, x))
            .collect()
    }

    /// Queues those of the pieces that may be split, and the triangle again.
    fn split_instead(
        &mut self,
        pieces: &[u32],
        ticket: Ticket,
        places: [DVec2; 3],
        shape: &Shape,
    ) -> Result<Result<(), Left>, MeshError> {
        let mut refused = Ok(());
        let queued = self.encroached.len();
        for &piece in pieces {
            match self.may_split(piece, ticket.flaw) {
                Ok(()) => {
                    let (ends, flaw) = (self.piece_ends(piece).0, ticket.flaw);
                    self.encroached.push_back(Encroached { piece, ends, flaw });
                }
                Err(left) => refused = Err(left),
            }
        }
        if self.encroached.len() > queued {
            self.queue.push(ticket, shape.length_squared);
            return Ok(Ok(()));
        }
        let is_excused = ticket.corners.iter().any(|&corner| self.shells.is_acute(corner));
        if refused == Err(Left::AtAcuteVertex) && !is_excused {
            return self.insert_beside(ticket, places, shape);
        }
        Ok(refused)
    }

    /// Inserts a point although it encroaches upon pieces at an acute vertex that will not be split: all triangles that
    /// it spoils touch that vertex. If the usual point is too near to such a piece, or behind it, the point is instead
    /// one that is at most as far from the shortest edge as that is long.
    fn insert_beside(
        &mut self,
        ticket: Ticket,
        places: [DVec2; 3],
        shape: &Shape,
    ) -> Result<Result<(), Left>, MeshError> {
        let mut cavity = Cavity::default();
        for x in [self.new_point.of(places, shape), NewPoint::BESIDE.of(places, shape)] {
            let Location::Triangle(triangle) = self.triangulation.locate(ticket.triangle, x) else {
                continue;
            };
            self.triangulation.dig(triangle, x, &mut cavity);
            let near = self.encroached_from(&cavity, x);
            let room = CLEARANCE * self.nearest_on_rim(&cavity, x);
            let is_clear = |&piece: &u32| {
                let [a, b] = self.piece_ends(piece).1;
                (b - a).perp_dot(x - a).abs() >= room * a.distance(b)
            };
            if near.iter().all(is_clear) {
                let result = self.fill(&cavity, x, ticket.flaw)?;
                near.into_iter().try_for_each(|piece| self.test_piece(piece))?;
                return Ok(result);
            }
        }
        Ok(Err(Left::AtAcuteVertex))
    }

    fn nearest_on_rim(&self, cavity: &Cavity, x: DVec2) -> f64 {
        let rim = cavity.rim().iter().map(|&edge| self.triangulation.ends(edge)[0]);
        let distances = rim.map(|vertex| x.distance_squared(self.triangulation.point(vertex)));
        distances.fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Puts the point into its cavity, if that is not too near to another vertex.
    fn fill(&mut self, cavity: &Cavity, x: DVec2, flaw: Flaw) -> Result<Result<(), Left>, MeshError> {
        let nearest = self.nearest_on_rim(cavity, x);
        let rim = cavity.rim().iter().map(|&edge| self.triangulation.ends(edge)[0]);
        let mut floor = self.floor_at(x, rim);
        if nearest < self.resolution {
            return Ok(Err(Left::ByRounding));
        }
        match flaw {
            Flaw::Angle if nearest < floor => return Ok(Err(Left::ByFloor)),
            Flaw::Angle => {}
            Flaw::Size => floor = floor.min(FLOOR * nearest),
        }
        self.triangulation.insert(cavity);
        self.circumcentres += 1;
        self.add_vertex(x, floor)?;
        self.test_changed()?;
        Ok(Ok(()))
    }
}
