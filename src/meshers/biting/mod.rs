//! Biting: an advancing front that packs circles instead of building elements (§5.1).
//!
//! # Idea
//! Put a point on the front, remove ("bite away") the circle of radius c_b f around it from what is left of the domain,
//! repeat until nothing is left. No later point falls into an earlier circle, so the points are well spaced; every
//! point of the domain is in some circle, so there are no gaps; and the Delaunay triangulation of such points is well
//! shaped.
//!
//! # Steps
//! 1. the control spacing is prepared before ([`crate::spacing`]);
//! 2. the initial front is the boundary of the domain ([`front::Front::new`]);
//! 3. [`boundary::vertex_protection`] bites every input vertex;
//! 4. [`boundary::edge_protection`] bites along the input segments until they are covered;
//! 5. [`interior::interior_biting`] bites at front vertices until the front is empty;
//! 6. [`triangulate`] makes the constrained Delaunay triangulation of the centres.
//!
//! # Guarantee
//! With t = α c_b, each a check of the certificate: packing circles of radius c_b f / (2 + t) are disjoint (Lemma 5.4,
//! `packing-disjoint`); every point of the domain is covered by a biting circle (Theorem 5.5, `coverage`); the
//! smallest angle is at least asin(1/2 − t) (Theorem 6.8, `min-angle`); nearest-neighbour distances are within
//! constants of f (Lemmas 5.7 and 5.8, `nn-vertex-*`, `nn-point-*`). What each needs besides is in [`crate::quality`]:
//! the angle bound, for one, needs c_b + t ≤ 1, which the paper does not say.
//!
//! # Cost
//! O(1) a bite plus one evaluation of f, plus a point-in-domain query for front vertices next to the boundary;
//! O(n log n) for the triangulation.
//!
//! # Deviations from the paper (and why)
//! * The paper does not say which front vertex is bitten next: [`Order`] is a parameter. Its default, the largest spacing
//!   first, has the largest smallest angles and nearly the fewest triangles on lfs in the sweep.
//! * The paper leaves open the order along the boundary: gaps are bitten at their two ends in turn.
//! * A middle circle closes every gap, also one of length 0 where two circles touch: without it the front would have
//!   a vertex on the boundary itself, which Lemmas 6.3 and 6.4 exclude without saying so.
//! * The triangulation is constrained: the paper does not prove that every boundary piece is a Delaunay edge. Those that
//!   are not are counted in [`Mesh::forced_pieces`].
//!   They need no acute angle: a middle piece on an inner segment can be 1.5 radii long, and vertices √7/4 radii above and
//!   below its middle lie in its diametral circle.
//! * Input angles under 90°, which the paper excludes, are bitten like any other unless [`Corners::Cut`] is asked for: a
//!   point of one segment that a circle of another covers already gets no circle of its own.
//!
//! # Reference
//! X.-Y. Li, S.-H. Teng, A. Üngör, "Biting: Advancing Front Meets Sphere Packing".

// The steps are private; their links work in `cargo doc --document-private-items`.
#![allow(rustdoc::private_intra_doc_links)]

mod boundary;
mod corners;
mod front;
mod interior;
mod order;
#[cfg(test)]
mod tests;

pub use corners::Corners;
pub use order::Order;

use super::{Entry, Guarantee, MeshError, Mesher, Parameter, Request, Trace, from_parameters};
use crate::delaunay::triangulate;
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::mesh::{Mesh, Piece};
use crate::spacing::Spacing;
use corners::Cuts;
use serde::{Deserialize, Serialize};

/// The biting method and its parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Biting {
    /// The order of bites. The paper leaves it open; the default is what `sweep` found best.
    pub order: Order,
    /// What is done about input angles under 90°, which the paper excludes.
    pub corners: Corners,
}

pub(super) const ENTRY: Entry = Entry {
    name: "biting",
    summary: "advancing front that packs circles (Li, Teng, Üngör)",
    parameters: &[
        Parameter {
            name: "order",
            values: "fifo, lifo, sharpest, flattest, equilateral, smallest, largest, random",
            default: "largest",
            help: "which front vertex is bitten next (open in §5.1; the default is what the sweep found best)",
        },
        Parameter {
            name: "corners",
            values: "bite, cut",
            default: "bite",
            help: "whether input angles under 90° are bitten like any other, or cut off first and given back (§5.1; pays for small c_b so far)",
        },
    ],
    guarantees: &[
        Guarantee::always("constrained-delaunay"),
        Guarantee::with("packing-disjoint", "corners", "bite"),
        Guarantee::with("coverage", "corners", "bite"),
        Guarantee::always("boundary-height"),
        Guarantee::always("min-angle"),
        Guarantee::with("nn-vertex-lower", "corners", "bite"),
        Guarantee::with("nn-vertex-upper", "corners", "bite"),
        Guarantee::with("nn-point-lower", "corners", "bite"),
        Guarantee::with("nn-point-upper", "corners", "bite"),
        Guarantee::with("vertices-lower", "corners", "bite"),
        Guarantee::with("vertices-upper", "corners", "bite"),
    ],
    make: from_parameters::<Biting>,
};

/// What biting leaves: well-spaced points that cover the domain, not yet triangulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Bitten {
    /// Centres of the biting circles in the order of bites: input vertices, boundary, interior.
    pub centres: Vec<DVec2>,
    /// Chains of centres along the input segments.
    pub pieces: Vec<Piece>,
}

impl Biting {
    /// Steps 2 to 5: the centres of the biting circles, without the triangulation.
    pub fn bite(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Bitten, MeshError> {
        let (cuts, graded) = match self.corners {
            Corners::Bite => (Cuts::none(domain), None),
            Corners::Cut => {
                let (cuts, graded) = trace.step("corner_cutting", || Cuts::new(domain, spacing, request));
                trace.count("corners_cut", cuts.count as f64);
                trace.count("corners_left", cuts.left as f64);
                (cuts, Some(graded))
            }
        };
        let spacing = graded.as_ref().map_or(spacing, |graded| graded);
        let mut front = front::Front::new(domain, &cuts, spacing, self.order, request)?;
        trace.step("vertex_protection", || boundary::vertex_protection(&mut front))?;
        let pieces = trace.step("edge_protection", || boundary::edge_protection(&mut front))?;
        let centres = trace.step("interior_biting", || interior::interior_biting(front))?;
        trace.count("bites", centres.len() as f64);
        Ok(Bitten { centres, pieces })
    }
}

impl Mesher for Biting {
    fn mesh(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Mesh, MeshError> {
        let Bitten { centres, pieces } = self.bite(domain, spacing, request, trace)?;
        Ok(trace.step("delaunay_triangulation", || triangulate(domain, centres, pieces))?)
    }
}
