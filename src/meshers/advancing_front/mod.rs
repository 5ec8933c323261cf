//! The classic advancing front: elements one at a time, or a layer at a time (§3).
//!
//! # Idea
//! The front is the boundary of what is not meshed yet: at first the boundary of the domain, cut into pieces of about
//! s. Pick a face of the front and put a triangle on it, with its apex at a node of the front or at a new node. This
//! moves the front inward; repeat until nothing is left. Faces of clefts and small faces go first.
//!
//! # Steps
//! 1. [`boundary::boundary`] cuts the segments into pieces on which ∫ 1/s is about 1;
//! 2. [`attempt`] picks a face (`pick_face`): clefts, then the shortest, then those that could not be closed;
//! 3. [`ideal_point`] computes where the apex should be: at distance δ₁ from both ends, δ₁ being s clamped to \[0.55,
//!    2\] × base;
//! 4. [`candidates`] ranks that point, points below it on the bisector, and the nodes of the front nearby, and takes
//!    the best one whose triangle passes the exact test against the front nearby;
//! 5. [`advance`] makes the triangle and moves the front;
//! 6. a face that cannot be closed well waits; then the search is widened; then the elements around it are deleted and
//!    made anew ([`open_up`]);
//! 7. what is left then is closed by force ([`close`]);
//! 8. [`rows`] does all this a layer at a time, with paving's row choice, closure check and seaming of clefts;
//! 9. [`improve`] swaps edges and smooths, if asked to.
//!
//! # Guarantee
//! None of the paper's bounds, and no Delaunay triangulation. The structural checks hold: each triangle is tested
//! against the front by exact predicates before it is made. A valid triangle with its apex at a node of the front
//! always exists, since the constrained triangulation of what is left has one over each base. The method always ends: a
//! face is tried [`attempt::ATTEMPTS`] times, new nodes keep their distance from the front, and no place is opened up
//! more than twice.
//!
//! # Cost
//! O(log n) per triangle for the queue and O(1) for the rest, with one or two evaluations of s per node and none elsewhere.
//!
//! # Deviations from the paper (and why)
//! * The inventors rank front nodes by their distance from the ideal point. Here a candidate ranks by the smallest
//!   angle that it leads to, in its triangle and in the wedges beside it. Near the ideal point the ranks agree; where
//!   fronts meet, angles rank better.
//! * Lengths that agree to 8 bits count as equal, first come first served, so that on uniform s the front moves in rows and
//!   not at the whim of rounding.
//! * Over a base much shorter than s, a new node may lie beside the bisector ([`ideal_point::Place::OTHERS`]), so that
//!   a row gets fewer nodes than it has bases. Paving calls this row adjustment. Without it rows keep their number of
//!   nodes away from a fine boundary until s is twice the base, and then break up.
//! * The literature stops when a front cannot close. Here the last resort is the constrained Delaunay triangulation of what
//!   is left, counted as `closed_by_force`.
//! * Paving makes quadrilaterals; its controls are kept, its smoothing of rows is not: see [`AdvancingFront::smooth`].
//! * [`Mesh::forced_pieces`] is 0: the method makes no Delaunay triangulation from which pieces could be missing.
//!
//! # Where fronts meet
//! The paper says that quality is lost there. [`Mesh::seams`] marks three kinds of triangles: those that join parts of
//! the front more than four edges apart along it, those that continue such a triangle without a new node, and all that
//! share a vertex with one of these.
//!
//! # Reference
//! J. Peraire, M. Vahdati, K. Morgan, O. C. Zienkiewicz, "Adaptive remeshing for compressible flow computations" (1987), for
//! heap, ideal point and clamps; R. Löhner, P. Parikh (1988), and P. L. George, E. Seveno (1994), for the searches and for what
//! is done when they fail; T. D. Blacker, M. B. Stephenson, "Paving" (1991), for the rows.

mod advance;
mod attempt;
mod boundary;
mod candidates;
mod close;
mod finish;
mod front;
mod ideal_point;
mod improve;
mod open_up;
mod queue;
mod rows;
#[cfg(test)]
mod tests;

use super::sizing::Sizing;
use super::{Entry, MeshError, Mesher, Monitor, Parameter, Request, Trace, from_parameters, within};
use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::spacing::Spacing;
use front::Front;
use serde::{Deserialize, Serialize};

/// How the front moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Advance {
    /// Element at a time: the shortest face first.
    #[default]
    Element,
    /// Layer at a time: row by row around the front.
    Row,
}

/// The advancing front method and its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AdvancingFront {
    /// Element or layer at a time. Default element (Peraire, Löhner, George); layers are paving's.
    pub advance: Advance,
    /// How far from the ideal point front nodes are candidates, in δ₁; 0.5 to 10. Default 1.5: nodes farther away make angles
    /// under 30°. It is multiplied by 4 and by 16 when a search is widened.
    pub search: f64,
    /// A front node where the angle of what is not meshed is less than this is a cleft and goes first, degrees; 0 to
    /// 120. Default 80: up to there one triangle closes a cleft better than two.
    pub cleft: f64,
    /// The rank that a triangle needs at the first attempt: the smallest angle in it and in what it leaves, degrees; 0
    /// to 60. Default 30.
    pub accept: f64,
    /// δ₁ is at least this share of the base; 0.5 to 1. Default 0.55 (Peraire et al.).
    pub low: f64,
    /// δ₁ is at most this multiple of the base; 1 to 10. Default 2 (Peraire et al.).
    pub high: f64,
    /// Sweeps of smoothing when the front is empty; 0 to 1000. Default 0.
    pub smooth: u32,
    /// Whether edges are swapped until all but the pieces are Delaunay. Default false.
    pub swap: bool,
}

impl AdvancingFront {
    /// All parameters at their defaults.
    pub const DEFAULT: Self = Self {
        advance: Advance::Element,
        search: 1.5,
        cleft: 80.0,
        accept: 30.0,
        low: 0.55,
        high: 2.0,
        smooth: 0,
        swap: false,
    };
}

impl Default for AdvancingFront {
    fn default() -> Self {
        Self::DEFAULT
    }
}

const fn parameter(name: &'static str, values: &'static str, default: &'static str, help: &'static str) -> Parameter {
    Parameter {
        name,
        values,
        default,
        help,
    }
}

pub(super) const ENTRY: Entry = Entry {
    name: "advancing-front",
    summary: "triangles put on a front that moves inward (Peraire, Löhner, George)",
    parameters: &[
        parameter(
            "advance",
            "element, row",
            "element",
            "an element or a layer at a time (§3; rows as in paving)",
        ),
        parameter(
            "search",
            "0.5 to 10",
            "1.5",
            "search radius for front nodes around the ideal point, in target edge lengths",
        ),
        parameter(
            "cleft",
            "0 to 120",
            "80.0",
            "front angles below this, in degrees, are closed first (§3)",
        ),
        parameter(
            "accept",
            "0 to 60",
            "30.0",
            "smallest angle that a triangle must lead to at first, degrees",
        ),
        parameter(
            "low",
            "0.5 to 1",
            "0.55",
            "new sides are at least this share of their base (Peraire et al.)",
        ),
        parameter(
            "high",
            "1 to 10",
            "2.0",
            "new sides are at most this multiple of their base (Peraire et al.)",
        ),
        parameter("smooth", "0 to 1000", "0", "sweeps of smoothing at the end"),
        parameter(
            "swap",
            "true, false",
            "false",
            "whether edges are swapped to Delaunay at the end",
        ),
    ],
    make: from_parameters::<AdvancingFront>,
};

/// Counts of what happened during a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Tally {
    /// Searches that were widened.
    widened: usize,
    /// How often the front was opened up, and how many elements that deleted.
    opened: usize,
    reopened_elements: usize,
    /// Small openings closed at once.
    closures: usize,
    /// Triangles made by closing what was left by force.
    closed_by_force: usize,
}

impl Tally {
    fn report(&self, trace: &mut Trace) {
        for (name, count) in [
            ("widened", self.widened),
            ("opened", self.opened),
            ("reopened_elements", self.reopened_elements),
            ("closures", self.closures),
            ("closed_by_force", self.closed_by_force),
        ] {
            trace.count(name, count as f64);
        }
    }
}

impl Mesher for AdvancingFront {
    fn check(&self) -> Result<(), String> {
        within(&[
            ("search", self.search, 0.5, 10.0),
            ("cleft", self.cleft, 0.0, 120.0),
            ("accept", self.accept, 0.0, 60.0),
            ("low", self.low, 0.5, 1.0),
            ("high", self.high, 1.0, 10.0),
            ("smooth", f64::from(self.smooth), 0.0, 1000.0),
        ])
    }

    fn mesh(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Mesh, MeshError> {
        super::refuse_geodesic(spacing)?;
        let sizing = Sizing::new(domain, spacing, request);
        let mut front = Front::new(self, domain, sizing, Monitor::new(&request.budget));
        let pieces = trace.step("boundary", || boundary::boundary(&mut front))?;
        trace.step("advance", || advance_until_empty(&mut front))?;
        trace.step("close_by_force", || front.close_by_force())?;
        front.tally.report(trace);
        let mesh = front.into_mesh(pieces);
        let mesh = trace.step("swap", || improve::swap(self, mesh));
        Ok(trace.step("smooth", || improve::smooth(self, mesh)))
    }
}

/// Element by element, until the front is empty or nothing moves it any further.
fn advance_until_empty(front: &mut Front) -> Result<(), MeshError> {
    while let Some(face) = front.pick_face() {
        advance_face(front, &face)?;
    }
    Ok(())
}

/// One face of the front: the triangle over it, or the next attempt at it later.
fn advance_face(front: &mut Front, face: &attempt::Picked) -> Result<(), MeshError> {
    match front.find_apex(face) {
        Some(apex) => {
            let sides = front.advance(&face.base, apex)?;
            front.closure_check(sides)
        }
        None => {
            front.failed(face);
            Ok(())
        }
    }
}
