//! Delaunay refinement: adds points where triangles are bad, until none is.
//!
//! # Idea
//! Start from the constrained Delaunay triangulation of the input. A triangle that is skinny or too large is broken by
//! a point at its circumcentre. This point is far from all vertices, since the circumcircle holds none. A point that
//! would come too near to a piece of the boundary is not inserted: the piece is split instead. No two vertices ever
//! come much nearer to each other than the input or the spacing asks for, so this ends, and the triangles that are left
//! have no small angle.
//!
//! # Steps
//! 1. [`Refinable::new`] triangulates the input vertices, with the segments as pieces;
//! 2. [`refiner::Refiner::split_encroached`] splits the pieces that a vertex encroaches upon;
//! 3. [`refiner::Refiner::insert_circumcentres`] takes bad triangles, shortest edge first ([`queue`]). It inserts the
//!    circumcentre or off-centre of each ([`triangles::NewPoint`]) or, if that encroaches upon pieces, splits these
//!    instead, as in step 2;
//! 4. [`Refinable::into_mesh`] carves outside and holes away. The triangulation is constrained Delaunay all along.
//!
//! # Guarantee
//! Of the certificate: `constrained-delaunay`. The paper's bounds are only measured.
//!
//! Every triangle has the angle and the size asked for, except those that are counted:
//! * `left_at_acute_vertex`: the angle is the input's, or mending it would shorten the pieces at an acute vertex below
//!   [`pieces::SHELL_FLOOR`], and so on for ever;
//! * `left_by_rounding`: coordinates do not resolve the point;
//! * `left_by_floor`: edges would become shorter than [`pieces::FLOOR`] of what input and sizes ask for.
//!
//! The floors end the work on every domain and at every angle. Without them, refinement is proved to end up to 20.7° for
//! circumcentres, diametral circles and input angles of at least 60°, and up to 25.7° (28.6° without good grading) for
//! lenses. In practice it ends up to about 33°.
//!
//! # Cost
//! O(1) per point in practice: a short walk, the cavity, and about six triangles tested. In most cases s at the corners
//! of a triangle decides whether it is too large, so s is evaluated little more than once per point. The queue has
//! buckets, so it costs no logarithm.
//!
//! # Deviations from the paper (and why)
//! * Sizes: by default, too large means an area above √3/4 s², with s at the centroid, as users of Triangle ask for
//!   ([`SizeRule`]).
//! * Order: shortest edge first, as in Triangle 1.6; Ruppert leaves the order open. Short edges then breed shorter ones
//!   only where longer ones have not been spoilt yet.
//! * Lenses have Triangle's angle: a vertex encroaches if it sees a piece under more than 180° less twice the bound, which
//!   is Chew's lens at 30°. As Chew does, splitting then removes the free vertices in the diametral circle that see the piece.
//! * Small input angles: pieces at a vertex of an acute angle are split at a distance from it that is a power of two,
//!   so that two of them end at one distance and do not encroach upon each other (Ruppert's shells, as Shewchuk has
//!   them). Miller, Pav and Walkington leave every skinny triangle whose shortest edge joins two segments at one
//!   distance from their common vertex; that ends, but leaves small angles well away from the vertex. Here such
//!   triangles are mended, and the floor of the pieces at the vertex ends the work: once they are that short, a point
//!   may encroach upon them, since all triangles that it spoils touch the vertex (`insert_beside`). Between segments a
//!   few degrees apart, some triangles near the vertex still keep small angles.
//!
//! # Reference
//! J. Ruppert, "A Delaunay Refinement Algorithm for Quality 2-Dimensional Mesh Generation", 1995. L. P. Chew,
//! "Guaranteed-Quality Mesh Generation for Curved Surfaces", 1993. J. R. Shewchuk, "Delaunay Refinement Algorithms for
//! Triangular Mesh Generation", 2002. G. L. Miller, S. E. Pav, N. J. Walkington, "When and Why Delaunay Refinement
//! Algorithms Work", 2005. A. Üngör, "Off-centers: A New Type of Steiner Points for Computing Size-Optimal
//! Quality-Guaranteed Delaunay Triangulations", 2009.

mod insert;
mod pieces;
mod queue;
mod refiner;
#[cfg(test)]
mod tests;
mod triangles;

use super::{Entry, MeshError, Mesher, Parameter, Request, Trace, from_parameters, within};
use crate::delaunay::Refinable;
use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::spacing::Spacing;
use crate::theory::{Claim, Guarantee};
use serde::{Deserialize, Serialize};

/// Where a bad triangle is broken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Insertion {
    /// At its circumcentre (Ruppert, Chew).
    Circumcentre,
    /// At its off-centre, if that is nearer (Üngör): fewer points.
    #[default]
    OffCentre,
}

/// When a vertex is too near to a piece that it sees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Encroachment {
    /// Inside the circle that has the piece as diameter (Ruppert): the mesh is Delaunay, not only constrained Delaunay,
    /// except for what is left at acute vertices.
    DiametralCircle,
    /// Inside the lens from which the piece is seen under at least 180° less twice the angle asked for (Chew's second):
    /// fewer points.
    #[default]
    Lens,
}

/// What "too large for s" means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SizeRule {
    /// Area over √3/4 s², s at the centroid: the equilateral triangle's.
    #[default]
    Area,
    /// Longest edge over s, s at its middle. Pieces longer than s are split, whatever is beside them.
    Edge,
    /// Circumradius over s / √3, s at the centroid: the equilateral triangle's.
    Radius,
    /// Sizes do not matter, angles only.
    None,
}

/// The largest angle that may be asked for, degrees: in practice refinement ends up to this angle.
pub const LARGEST_ANGLE: f64 = 34.0;

/// Delaunay refinement and its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DelaunayRefinement {
    /// Smallest angle asked for, degrees, at least 0 and at most [`LARGEST_ANGLE`]. Up to the default, Chew's second
    /// algorithm is proved to end for sizes well below the features.
    pub angle: f64,
    /// Where a bad triangle is broken.
    pub insertion: Insertion,
    /// When a vertex is too near to a piece.
    pub encroachment: Encroachment,
    /// What "too large for s" means.
    pub size_rule: SizeRule,
}

impl Default for DelaunayRefinement {
    fn default() -> Self {
        Self {
            angle: 28.6,
            insertion: Insertion::default(),
            encroachment: Encroachment::default(),
            size_rule: SizeRule::default(),
        }
    }
}

pub(super) const ENTRY: Entry = Entry {
    name: "delaunay-refinement",
    summary: "circumcentres or off-centres of bad triangles (Ruppert, Chew, Üngör)",
    parameters: &[
        Parameter {
            name: "angle",
            values: "degrees from 0 to 34",
            default: "28.6",
            help: "smallest angle away from acute vertices (proved: 20.7 Ruppert, 28.6 Chew for small sizes)",
        },
        Parameter {
            name: "insertion",
            values: "circumcentre, off-centre",
            default: "off-centre",
            help: "where a bad triangle is broken (Ruppert; Üngör: fewer points)",
        },
        Parameter {
            name: "encroachment",
            values: "diametral-circle, lens",
            default: "lens",
            help: "when a vertex is too near to a boundary piece (Ruppert; Chew's second: fewer points)",
        },
        Parameter {
            name: "size_rule",
            values: "area, edge, radius, none",
            default: "area",
            help: "what may not exceed that of the equilateral triangle with edge s; none: angles only",
        },
    ],
    make: from_parameters::<DelaunayRefinement>,
};

impl Mesher for DelaunayRefinement {
    fn guarantees(&self) -> Vec<Guarantee> {
        vec![Guarantee::always(Claim::ConstrainedDelaunay)]
    }

    fn check(&self) -> Result<(), String> {
        within(&[("angle", self.angle, 0.0, LARGEST_ANGLE)])
    }

    fn mesh(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Mesh, MeshError> {
        let start = trace.step("constrained_delaunay", || Refinable::new(domain))?;
        let mut refiner = refiner::Refiner::new(self, start, domain, spacing, request)?;
        trace.step("split_encroached", || refiner.split_encroached())?;
        trace.step("insert_circumcentres", || refiner.insert_circumcentres())?;
        refiner.count(trace);
        Ok(trace.step("carve", || refiner.triangulation.into_mesh(domain)))
    }
}
