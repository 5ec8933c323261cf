//! How high above the boundary the circles of neighbouring boundary vertices meet (§6.2), on which Theorem 6.8 rests.
//!
//! Lemmas 6.3 and 6.4 bound that height if step 4 put one of the two centres there: on the other's circle, or in the
//! middle of a gap. Nothing bounds it if step 4 had nothing to do, because the circles of the two input vertices of a
//! segment together cover it already. They may overlap arbitrarily little, and the front vertex above their overlap
//! then makes a flat triangle with them. The paper excludes that case without saying so. It cannot occur if c_b + t ≤
//! 1: with m the middle of a segment of length L, f(m) ≤ lfs(m) ≤ L/2, so the two radii are at most c_b (L/2 + α L/2)
//! each and add up to at most (c_b + t) L.

use super::boundary::{Boundary, NO_SEGMENT};
use super::tally::{Tally, Worst};
use super::{Bounds, Check};
use crate::domain::Domain;
use crate::geometry::near::meeting_height;
use crate::geometry::tolerance::CERTIFICATE;
use crate::mesh::{Adjacency, Mesh};
use crate::theory::Claim;
use crate::theory::least_meeting_height;

/// The heights at which neighbouring boundary circles meet, over the smaller of their radii.
pub struct Heights {
    /// Those at edges where step 4 put one of the two centres.
    protected: Tally,
    /// Segments bitten at their two input vertices only, whose circles meet lower than the bound.
    pub low_head_on: usize,
    bound: f64,
}

impl Heights {
    /// The heights at all mesh edges on input segments.
    pub fn measure(
        domain: &Domain,
        mesh: &Mesh,
        adjacency: &Adjacency,
        boundary: &Boundary,
        bounds: &Bounds,
        at_vertex: &[f64],
    ) -> Self {
        let bound = least_meeting_height((bounds.c_b * bounds.spacing.lipschitz()).min(1.0));
        let mut heights = Self {
            protected: Tally::new(Worst::Smallest),
            low_head_on: 0,
            bound,
        };
        for (edge, &segment) in adjacency.edges().iter().zip(&boundary.segment) {
            if segment == NO_SEGMENT {
                continue;
            }
            let [x, y] = edge.ends.map(|k| mesh.points[k as usize]);
            let [a, b] = edge.ends.map(|k| bounds.c_b * at_vertex[k as usize]);
            let height = meeting_height(x.distance(y), a, b) / a.min(b);
            let is_low = height < bound * (1.0 - CERTIFICATE);
            let input = &domain.segments()[segment as usize];
            let is_whole = edge
                .ends
                .iter()
                .all(|&k| [input.a, input.b].iter().any(|&v| boundary.vertex[v] == Some(k)));
            if is_whole && is_low {
                heights.low_head_on += 1;
            } else {
                heights.protected.see(height, x.midpoint(y), is_low);
            }
        }
        heights
    }

    /// `boundary-height`.
    pub fn check(&self, applies: bool) -> Check {
        self.protected.clone().check(Claim::BoundaryHeight, applies, self.bound)
    }
}
