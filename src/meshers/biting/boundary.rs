//! Boundary protection (§5.1 steps 3 and 4, §6.2): bites at the input vertices, then along the input segments.

use super::front::Front;
use crate::geometry::near::{Disc, Near};
use crate::geometry::{DVec2, tolerance};
use crate::mesh::Piece;
use crate::meshers::{MeshError, Reason};
use std::collections::VecDeque;

/// Bites all input vertices that are not cut off.
pub(super) fn vertex_protection(front: &mut Front) -> Result<(), MeshError> {
    let vertices = front.domain.vertices().iter().enumerate();
    vertices
        .filter(|(v, _)| !front.cuts.is_cut(*v))
        .try_for_each(|(_, &centre)| {
            let radius = front.radius_at(centre)?;
            front
                .bite_boundary(Disc { centre, radius }, Reason::InputVertex)
                .map(|_| ())
        })
}

/// Bites where corners are cut off, and returns for each segment those centres on it with their distances from its first
/// end.
fn corner_protection(front: &mut Front) -> Result<Vec<Vec<(f64, u32)>>, MeshError> {
    let (domain, cuts) = (front.domain, front.cuts);
    let mut placed = vec![Vec::new(); domain.segments().len()];
    for (s, (segment, placed)) in domain.segments().iter().zip(&mut placed).enumerate() {
        for v in [segment.a, segment.b].into_iter().filter(|&v| cuts.is_cut(v)) {
            let centre = cuts.point(domain, s, v);
            let radius = front.radius_at(centre)?;
            let along = domain.vertices()[segment.a].distance(centre);
            let disc = Disc { centre, radius };
            placed.push((along, front.bite_boundary(disc, Reason::CutCorner)?));
        }
    }
    // Points between the segments of a corner are on none.
    for &centre in &cuts.between {
        let radius = front.radius_at(centre)?;
        front.bite_boundary(Disc { centre, radius }, Reason::CutCorner)?;
    }
    Ok(placed)
}

/// Bites along the input segments until every point of them is covered, and returns the pieces the centres cut them into.
///
/// The uncovered gaps of all segments take turns, and a gap is bitten at its two ends in turn, so that the boundary is
/// eaten in layers from the vertices inward. Every point is tested against all circles bitten so far, those of other
/// segments too.
pub(super) fn edge_protection(front: &mut Front) -> Result<Vec<Piece>, MeshError> {
    let segments = 0..front.domain.segments().len();
    let mut cuts = corner_protection(front)?;
    let mut gaps: VecDeque<Gap> = segments.map(|segment| Gap::whole(front, segment)).collect();
    while let Some(gap) = gaps.pop_front() {
        let Some((gap, circle)) = gap.trimmed(front)? else {
            continue;
        };
        let (position, disc, reason) = gap.next_bite(front, circle, &mut gaps)?;
        cuts[gap.segment].push((gap.along_segment(position), front.bite_boundary(disc, reason)?));
        gaps.extend(gap.without(position, disc.radius));
    }
    Ok(Piece::chains(front.domain, cuts))
}

/// A part of a segment that may be uncovered, seen from the end at which it is bitten next.
#[derive(Clone, Copy, Debug)]
struct Gap {
    segment: usize,
    /// The segment's end nearer to `low`, and the unit vector from it to the other end.
    start: DVec2,
    direction: DVec2,
    length: f64,
    /// Whether `start` is the segment's second vertex.
    reversed: bool,
    /// The part, by distance from `start`: its end q₁ at which it is bitten, and its far end.
    low: f64,
    high: f64,
}

impl Gap {
    fn whole(front: &Front, segment: usize) -> Self {
        let [start, end] = front.domain.ends(segment);
        let length = start.distance(end);
        let ends = front.domain.segments()[segment];
        Self {
            segment,
            start,
            direction: (end - start) / length,
            length,
            reversed: false,
            low: front.cuts.distance(ends.a),
            high: length - front.cuts.distance(ends.b),
        }
    }

    /// The same gap seen from its other end.
    fn turned(self) -> Self {
        Self {
            start: self.start + self.direction * self.length,
            direction: -self.direction,
            reversed: !self.reversed,
            low: self.length - self.high,
            high: self.length - self.low,
            ..self
        }
    }

    fn at(&self, position: f64) -> DVec2 {
        self.start + self.direction * position
    }

    fn circle_at(&self, front: &Front, position: f64) -> Result<Disc, MeshError> {
        let centre = self.at(position);
        Ok(Disc {
            centre,
            radius: front.radius_at(centre)?,
        })
    }

    /// `position` as distance from the segment's first vertex.
    fn along_segment(&self, position: f64) -> f64 {
        if self.reversed {
            self.length - position
        } else {
            position
        }
    }

    /// Where the segment enters and leaves a circle near `circle`, shrunk by [`tolerance::COVERED`].
    fn chord(&self, circle: Disc, near: &Near) -> Option<(f64, f64)> {
        let to_centre = circle.centre + near.offset - self.start;
        let (along, across) = (to_centre.dot(self.direction), to_centre.perp_dot(self.direction));
        let radius = near.radius * (1.0 - tolerance::COVERED);
        let half_squared = radius * radius - across * across;
        (half_squared > 0.0).then(|| (along - half_squared.sqrt(), along + half_squared.sqrt()))
    }

    /// The gap with its low end q₁ moved out of the circles that cover it, and the biting circle there; none where
    /// nothing is left of it.
    fn trimmed(mut self, front: &Front) -> Result<Option<(Self, Disc)>, MeshError> {
        while self.low <= self.high {
            let circle = self.circle_at(front, self.low)?;
            let seen = |near: &&Near| front.sees(near.id, circle.centre);
            let near = front.covering(circle);
            let exits = near.iter().filter(seen).filter_map(|near| {
                let (_, exit) = self.chord(circle, near)?;
                front.sees(near.id, self.at(exit.min(self.high))).then_some(exit)
            });
            let exit = exits.fold(self.low, f64::max);
            if exit == self.low {
                return Ok(Some((self, circle)));
            }
            self.low = exit;
        }
        Ok(None)
    }

    /// Step 4: the next bite of an uncovered gap, as its position, circle and reason, given the circle at q₁.
    ///
    /// Let q₂ be the next covered point of the segment. Where the circle at q₁ does not reach it, bite at q₁; else,
    /// where the circle at q₂ does not reach q₁, bite at q₂; else bite at the middle of q₁ q₂. If the circle that
    /// covers q₂ ends within the gap, the part behind it is queued as a gap of its own.
    fn next_bite(
        &self,
        front: &Front,
        at_low: Disc,
        gaps: &mut VecDeque<Gap>,
    ) -> Result<(f64, Disc, Reason), MeshError> {
        let (far, behind) = self.far_side(front, at_low);
        let progressive = Reason::Progressive { segment: self.segment };
        if far - self.low > at_low.radius {
            return Ok((self.low, at_low, progressive));
        }
        if behind < self.high {
            gaps.push_back(Self { low: behind, ..*self });
        }
        let at_far = self.circle_at(front, far)?;
        if far - self.low > at_far.radius {
            return Ok((far, at_far, progressive));
        }
        let middle = 0.5 * (self.low + far);
        let reason = Reason::Middle {
            segment: self.segment,
            between: [self.low, far].map(|position| self.at(position)),
        };
        Ok((middle, self.circle_at(front, middle)?, reason))
    }

    /// q₂, the next covered point behind the low end as far as the circle there can tell, and where the circle that
    /// covers it is left again.
    fn far_side(&self, front: &Front, at_low: Disc) -> (f64, f64) {
        let near = front.meeting(at_low);
        let chords = near.iter().filter_map(|near| {
            let chord = self.chord(at_low, near)?;
            front.sees(near.id, self.at(chord.0)).then_some(chord)
        });
        chords
            .filter(|&(entry, _)| self.low <= entry && entry < self.high)
            .fold((self.high, self.high), |nearest, chord| {
                if chord.0 < nearest.0 { chord } else { nearest }
            })
    }

    /// What a bite leaves of the gap, to be seen from the other end next.
    fn without(self, position: f64, radius: f64) -> impl Iterator<Item = Self> {
        let before = Self {
            high: position - radius,
            ..self
        };
        let after = Self {
            low: position + radius,
            ..self
        };
        [before, after]
            .into_iter()
            .filter(|part| part.low <= part.high)
            .map(Self::turned)
    }
}
