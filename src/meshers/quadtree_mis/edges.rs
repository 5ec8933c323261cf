//! Step 3, first half: the independent set on the input vertices and along the segments, and how its gaps along these
//! are closed.
//!
//! All input vertices belong to the mesh. On the segments a candidate is chosen unless a circle chosen before covers
//! it. Gaps that no circle covers can be left between candidates, shorter than their distance. They are closed, with a
//! circle at the middle if one is enough: an interior point in such a gap would lie close to a long piece of the
//! boundary and form a flat triangle.

use super::Field;
use super::circles::OnSegment;
use super::independent_set::Order;
use crate::geometry::near::{Disc, DiscGrid, Near};
use crate::geometry::{DVec2, tolerance};
use crate::mesh::Piece;
use crate::meshers::MeshError;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

/// The circles on the input boundary.
pub(super) struct Boundary<'a, 'b> {
    field: &'b Field<'a>,
    /// All circles: those of the input vertices first, in order.
    pub circles: DiscGrid,
    /// Those on each segment by position.
    cuts: Vec<Vec<(f64, u32)>>,
    near: Vec<Near>,
}

impl<'a, 'b> Boundary<'a, 'b> {
    /// The circles of the input vertices.
    pub fn vertices(field: &'b Field<'a>) -> Result<Self, MeshError> {
        let mut boundary = Self {
            field,
            circles: DiscGrid::new(field.sizing.t()),
            cuts: vec![Vec::new(); field.domain.segments().len()],
            near: Vec::new(),
        };
        for &centre in field.domain.vertices() {
            let disc = boundary.disc_at(centre)?;
            boundary.insert(disc)?;
        }
        Ok(boundary)
    }

    fn insert(&mut self, disc: Disc) -> Result<u32, MeshError> {
        self.field
            .monitor
            .placed(self.circles.len() + 1, disc.centre, disc.radius)?;
        Ok(self.circles.insert(disc))
    }

    fn choose(&mut self, segment: usize, position: f64, disc: Disc) -> Result<(), MeshError> {
        let id = self.insert(disc)?;
        self.cuts[segment].push((position, id));
        Ok(())
    }

    fn covering(&mut self, disc: Disc) -> &[Near] {
        self.circles
            .covering(disc.centre, disc.radius, tolerance::COVERED, &mut self.near);
        &self.near
    }

    /// Chooses a maximal independent set of the candidates, which are given in the order of insertion.
    pub fn edges(&mut self, mut candidates: Vec<OnSegment>) -> Result<(), MeshError> {
        match self.field.mesher.order {
            Order::Insertion => {}
            Order::Random => candidates.shuffle(&mut Pcg64::seed_from_u64(self.field.seed)),
            Order::Spacing => candidates.sort_by(|one, other| one.disc.radius.total_cmp(&other.disc.radius)),
            Order::Degree => {
                let degrees = degrees(&candidates, self.field.sizing.t());
                let mut ranked: Vec<(u32, OnSegment)> = degrees.into_iter().zip(candidates).collect();
                ranked.sort_by_key(|(degree, _)| *degree);
                candidates = ranked.into_iter().map(|(_, candidate)| candidate).collect();
            }
        }
        for OnSegment {
            segment,
            position,
            disc,
            ..
        } in candidates
        {
            if self.covering(disc).is_empty() {
                self.choose(segment, position, disc)?;
            }
        }
        Ok(())
    }

    /// Closes every gap that the circles leave along a segment. Returns how many circles this took.
    pub fn close_gaps(&mut self) -> Result<usize, MeshError> {
        let known = self.circles.len();
        for segment in 0..self.field.domain.segments().len() {
            let [start, end] = self.field.domain.ends(segment);
            let length = start.distance(end);
            let direction = (end - start) / length;
            let mut low = 0.0;
            while let Some((from, to)) = self.gap(start, direction, [low, length])? {
                let at_from = self.disc_at(start + direction * from)?;
                let (position, disc) = if to - from > at_from.radius {
                    (from, at_from)
                } else {
                    let middle = 0.5 * (from + to);
                    (middle, self.disc_at(start + direction * middle)?)
                };
                self.choose(segment, position, disc)?;
                low = from;
            }
        }
        Ok(self.circles.len() - known)
    }

    fn disc_at(&self, centre: DVec2) -> Result<Disc, MeshError> {
        Ok(Disc {
            centre,
            radius: self.field.sizing.at(centre)?,
        })
    }

    /// The first stretch of a ray, between two distances from its start, that no circle covers. It may extend beyond
    /// what the circle at its beginning would cover. Circles count as a little smaller than they are, so two that touch
    /// leave a gap of that size.
    fn gap(&mut self, start: DVec2, direction: DVec2, [low, high]: [f64; 2]) -> Result<Option<(f64, f64)>, MeshError> {
        let mut from = low;
        while from <= high {
            let disc = self.disc_at(start + direction * from)?;
            self.circles.meeting(disc.centre, disc.radius, &mut self.near);
            let chords = self
                .near
                .iter()
                .filter_map(|near| chord(disc.centre + near.offset - start, near.radius, direction));
            let (exit, entry) = chords.fold((from, f64::INFINITY), |(exit, entry), (enters, leaves)| {
                if enters > from {
                    (exit, entry.min(enters))
                } else {
                    (exit.max(leaves), entry)
                }
            });
            if exit == from {
                return Ok(Some((from, entry.min(high))));
            }
            from = exit;
        }
        Ok(None)
    }

    /// Takes the cuts, and returns the chains of mesh edges along all segments.
    pub fn pieces(&mut self) -> Vec<Piece> {
        Piece::chains(self.field.domain, std::mem::take(&mut self.cuts))
    }
}

/// Where a ray from the origin enters and leaves a circle, shrunk by [`tolerance::COVERED`].
fn chord(centre: DVec2, radius: f64, direction: DVec2) -> Option<(f64, f64)> {
    let (along, across) = (centre.dot(direction), centre.perp_dot(direction));
    let radius = radius * (1.0 - tolerance::COVERED);
    let half_squared = (radius - across.abs()) * (radius + across.abs());
    (half_squared > 0.0).then(|| (along - half_squared.sqrt(), along + half_squared.sqrt()))
}

/// For each candidate, the number of candidates whose circles cover it.
fn degrees(candidates: &[OnSegment], t: f64) -> Vec<u32> {
    let mut circles = DiscGrid::new(t);
    candidates.iter().for_each(|candidate| {
        circles.insert(candidate.disc);
    });
    let mut near = Vec::new();
    let degree = |candidate: &OnSegment| {
        circles.covering(candidate.disc.centre, candidate.disc.radius, 0.0, &mut near);
        near.len() as u32
    };
    candidates.iter().map(degree).collect()
}
