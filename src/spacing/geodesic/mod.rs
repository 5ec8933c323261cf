//! `lfs:geodesic`: local feature size by distances inside the domain (the footnote of Definition 2.1).
//!
//! # Idea
//! Two arms of a domain that are close in the plane but far apart inside it need not be refined for each other's sake. So a
//! disc B(x, r) meets here only what it *reaches*: R(x, r), the connected part of B(x, r) ∩ Ω that holds x ([`Reach`]).
//! lfs_Ω(x) is the smallest r for which R(x, r) meets two features that are not incident.
//!
//! # Guarantee
//! With d(x, y) the length of the shortest way from x to y inside Ω, infinite if there is none:
//! * lfs_Ω ≥ lfs, since R(x, r) ⊂ B(x, r); and they are equal wherever the disc of lfs reaches all of Ω that it meets.
//! * lfs_Ω is 1-Lipschitz in d. A shortest way from y to x lies in B(y, d), and B(x, r) in B(y, d + r). So what x reaches with r
//!   is reached by y with d + r, and lfs_Ω(y) ≤ lfs_Ω(x) + d.
//! * lfs_Ω is nowhere below half the smallest lfs_Ω of a vertex. Let x reach two features that are not incident with r.
//!   If it reaches a vertex v, R(x, r) ⊂ R(v, 2r) and lfs_Ω(v) ≤ 2r. Else R(x, r) is a disc less half planes, and sees a point
//!   on each of two segments, at most 2r apart. Slide the line between them along the segments, to where it does not
//!   grow, up to the first vertex: that is within 2r of a segment not incident to it.
//!
//! Both hold in a closed domain with inner segments, which may be crossed, and with vertices at which it touches itself.
//!
//! # How it is limited
//! The limited spacing is the larger of the limited lfs of the plane and a function that is linear on each triangle of a mesh
//! of Ω ([`limit`]).

mod cones;
mod limit;
mod slopes;
#[cfg(test)]
mod tests;

pub use limit::limit;

use crate::delaunay::Reach;
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::tolerance::RESOLUTION;
use crate::spacing::{Lfs, Rect, Spacing, SpacingError};
use std::sync::Arc;

/// lfs by distances inside the domain.
#[derive(Clone, Debug)]
pub struct GeodesicLfs {
    reach: Reach,
    in_plane: Arc<Lfs>,
    /// A lower bound on the whole domain: half the smallest value at a vertex.
    smallest: f64,
}

impl GeodesicLfs {
    /// For a domain with this lfs.
    ///
    /// # Errors
    /// [`SpacingError::NoFeatures`], [`SpacingError::Unresolved`] as for [`crate::spacing::Lfs`],
    /// [`SpacingError::Triangulation`] if the domain cannot be triangulated.
    pub fn new(domain: &Domain, in_plane: Arc<Lfs>) -> Result<Self, SpacingError> {
        let reach = Reach::new(domain)?;
        let at_vertices = domain.vertices().iter().map(|&v| (reach.smallest_apart(v), v));
        let lowest = at_vertices.reduce(|lowest, next| if next.0 < lowest.0 { next } else { lowest });
        let (value, at) = lowest.ok_or(SpacingError::NoFeatures)?;
        if value.is_infinite() {
            return Err(SpacingError::NoFeatures);
        }
        if value < RESOLUTION * domain.bounds().largest_coordinate() {
            return Err(SpacingError::Unresolved {
                value,
                x: at.x,
                y: at.y,
            });
        }
        let smallest = 0.5 * value * (1.0 - 8.0 * f64::EPSILON);
        Ok(Self {
            reach,
            in_plane,
            smallest,
        })
    }
}

impl Spacing for GeodesicLfs {
    fn at(&self, x: DVec2) -> f64 {
        self.reach.smallest_apart(x)
    }

    fn lipschitz(&self) -> f64 {
        1.0
    }

    fn is_geodesic(&self) -> bool {
        true
    }

    fn in_plane(&self) -> Option<Arc<dyn Spacing>> {
        Some(self.in_plane.clone())
    }

    /// The same for all cells: two points of a cell may be far apart inside the domain.
    fn lower_bound(&self, _: Rect) -> f64 {
        self.smallest
    }

    fn upper_bound(&self, _: Rect) -> f64 {
        f64::INFINITY
    }
}
