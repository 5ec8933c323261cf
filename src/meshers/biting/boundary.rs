//! Boundary protection (§5.1 steps 3 and 4, §6.2): bites at the input vertices, then along the input segments.

use crate::geometry::near::{Disc, Near};
use crate::mesh::Piece;
use crate::meshers::biting::front::Front;
use crate::meshers::biting::gap::Gap;
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

/// Bites where corners are cut off, and returns for each segment the centres on it, with their distances from its first
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
    // Points between the segments of a corner are on no segment.
    for &centre in &cuts.between {
        let radius = front.radius_at(centre)?;
        front.bite_boundary(Disc { centre, radius }, Reason::CutCorner)?;
    }
    Ok(placed)
}

/// Bites along the input segments until every point of them is covered, and returns the pieces into which the centres
/// cut them.
///
/// The uncovered gaps of all segments take turns, and a gap is bitten at its two ends in turn, so that the boundary is
/// eaten in layers from the vertices inward. Every point is tested against all circles bitten so far, including those
/// of other segments.
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
        gaps.extend(gap.without(front, position, disc)?);
    }
    Ok(Piece::chains(front.domain, cuts))
}

impl Gap {
    /// The gap with its low end q₁ moved out of the circles that cover it, and the biting circle there; none if nothing
    /// is left of it.
    fn trimmed(mut self, front: &Front) -> Result<Option<(Self, Disc)>, MeshError> {
        while self.low <= self.high {
            let circle = self.circle_at(front, self.low)?;
            let seen = |near: &&Near| front.sees(near.id, circle.centre);
            let mut exit = self.low;
            for near in front.covering(circle).iter().filter(seen) {
                let left = self.exit(front, circle, near)?;
                if front.sees(near.id, self.at(left.min(self.high))) {
                    exit = exit.max(left);
                }
            }
            if exit == self.low {
                return Ok(Some((self, circle)));
            }
            self.low = exit;
        }
        Ok(None)
    }

    /// Step 4: the next bite of an uncovered gap, as its position, circle and reason, given the circle at q₁.
    ///
    /// Let q₂ be the next covered point of the segment. If a bite at q₁ does not reach q₂, bite at q₁; else, if a bite
    /// at q₂ does not reach q₁, bite at q₂; else bite at the middle of q₁ q₂. If the circle that covers q₂ ends within
    /// the gap, the part behind it is queued as a gap of its own.
    fn next_bite(
        &self,
        front: &Front,
        at_low: Disc,
        gaps: &mut VecDeque<Gap>,
    ) -> Result<(f64, Disc, Reason), MeshError> {
        let (far, behind) = self.far_side(front, at_low)?;
        let progressive = Reason::Progressive { segment: self.segment };
        let eats = |biter: Disc, other: Disc| {
            let radius = front.rule.of(biter, other).radius;
            far - self.low <= radius
        };
        let at_far = self.circle_at(front, far)?;
        if !eats(at_low, at_far) {
            return Ok((self.low, at_low, progressive));
        }
        if behind < self.high {
            gaps.push_back(self.behind(behind));
        }
        if !eats(at_far, at_low) {
            return Ok((far, at_far, progressive));
        }
        let middle = 0.5 * (self.low + far);
        let reason = Reason::Middle {
            segment: self.segment,
            between: [self.low, far].map(|position| self.at(position)),
        };
        Ok((middle, self.circle_at(front, middle)?, reason))
    }

    /// q₂, the next covered point behind the low end among the circles that a bite there meets, and the point where the
    /// segment leaves the circle that covers q₂.
    fn far_side(&self, front: &Front, at_low: Disc) -> Result<(f64, f64), MeshError> {
        let mut nearest = (self.high, self.high);
        let mut near = Vec::new();
        front.near_bite(at_low, &mut near);
        for near in &near {
            if let Some((entry, exit)) = self.eaten(front, at_low, near)? {
                let is_ahead = self.low <= entry && entry < self.high;
                if is_ahead && entry < nearest.0 && front.sees(near.id, self.at(entry)) {
                    nearest = (entry, exit);
                }
            }
        }
        Ok(nearest)
    }
}
