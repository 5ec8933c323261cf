//! Biting: an advancing front that packs circles instead of building elements (§5.1).
//!
//! # Idea
//! Put a point on the front, remove ("bite away") the circle of radius c_b f around it from what is left of the domain,
//! and repeat until nothing is left. No later point falls into an earlier circle, so the points are well spaced; every
//! point of the domain is in some circle, so there are no gaps; and the Delaunay triangulation of such points is well
//! shaped.
//!
//! # Steps
//! 1. the control spacing is prepared beforehand ([`crate::spacing`]);
//! 2. the initial front is the boundary of the domain ([`front::Front::new`]); corners are cut off, and the spacing is
//!    held down beside them ([`beyond::corners`]);
//! 3. [`boundary::vertex_protection`] bites every input vertex;
//! 4. [`boundary::edge_protection`] bites along the input segments until they are covered;
//! 5. [`interior::interior_biting`] bites at front vertices until the front is empty;
//! 6. [`triangulate`] makes the constrained Delaunay triangulation of the centres.
//!
//! # Guarantee
//! With t = α c_b, the paper proves four things, each a check of the certificate:
//! * packing circles of radius c_b f / (2 + t) are disjoint (Lemma 5.4, `packing-disjoint`);
//! * every point of the domain is covered by a biting circle (Theorem 5.5, `coverage`);
//! * the smallest angle is at least asin(1/2 − t) (Theorem 6.8, `min-angle`);
//! * nearest-neighbour distances are within constants of f (Lemmas 5.7 and 5.8, `nn-vertex-*`, `nn-point-*`).
//!
//! [`crate::quality`] has what each needs besides: for one, the angle bound of the paper to the letter needs c_b + t ≤
//! 1, which the paper does not say. By default, with corners cut off and circles held apart that would meet low, every
//! triangle that touches no input angle under 60° meets the angle bound (`min-angle-beyond-corners`), and no angle of
//! the others is below the smallest input angle there (`corner-angles`). The claims that compare with f are guaranteed
//! where nothing is cut off or held down: in plain cases ([`Guarantee::plain`](crate::theory::Guarantee)), and to the
//! letter.
//!
//! With `rule=later` two points keep the distance that the spacing at the later one asks for, and the smallest angle is
//! at least asin((1 − t) / 2). For domains without a boundary this is known. [`beyond::rule`] has the theorem with a
//! boundary, its proof, and the other bounds; the certificate then checks these in place of the paper's.
//!
//! With `lfs:geodesic` circles bite only what they reach inside the domain. For t ≤ √2 − 1 and the paper's rule the
//! same bounds hold: [`beyond::inside`] has the proof and its hypotheses.
//!
//! # Cost
//! A bite takes O(1), with one evaluation of f and a point-in-domain query for each front vertex next to the boundary.
//! The triangulation takes O(n log n). By the rule of the later point a bite takes about ten more evaluations of f,
//! since its front vertices are found as roots.
//!
//! # Deviations from the paper (and why)
//! * The paper does not say which front vertex is bitten next, so [`Order`] is a parameter. On lfs in the sweep its
//!   default, the largest spacing first, gives the largest smallest angles and nearly the fewest triangles.
//! * The paper leaves open the order along the boundary. Here gaps are bitten at their two ends in turn.
//! * A middle circle closes every gap, even one of length 0 where two circles touch. Without it the front would have a
//!   vertex on the boundary itself, which Lemmas 6.3 and 6.4 exclude without saying so.
//! * The triangulation is constrained, since the paper does not prove that every boundary piece is a Delaunay edge.
//!   [`Mesh::forced_pieces`] counts the pieces that are not. They occur without acute angles too: a middle piece on an
//!   inner segment can be 1.5 radii long, and vertices √7/4 radii above and below its middle lie in its diametral
//!   circle.
//! * Input angles under 90°, which the paper excludes, are cut off, as §5.1 suggests without saying how, and come back
//!   as triangles of their own ([`beyond::corners`]). Across an angle under 90° that opens to the outside, circles
//!   cover nothing ([`beyond::notches`]). With [`Corners::Bite`] such angles are bitten like any other: a point of one
//!   segment that a circle of another already covers gets no circle of its own.
//! * If the circles of a segment's two ends would together cover it and meet low, a case that Lemma 6.4 overlooks, they
//!   are held apart ([`HeadOn::Part`]). The angle bound then holds without c_b + t ≤ 1.
//!
//! # Reference
//! X.-Y. Li, S.-H. Teng, A. Üngör, "Biting: Advancing Front Meets Sphere Packing". For `rule=later`: S. A. Mitchell, A.
//! Rand, M. S. Ebeida, C. Bajaj, "Variable radii Poisson-disk sampling", CCCG 2012, who call the rule current-disks and
//! prove the bound (1 − t) / 2 for domains without a boundary.

pub mod beyond;
mod boundary;
mod front;
mod gap;
mod interior;
mod order;
#[cfg(test)]
mod tests;

pub use order::Order;

use crate::delaunay::triangulate;
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::mesh::{Mesh, Piece};
use crate::meshers::{Entry, MeshError, Mesher, Parameter, Request, Trace, from_parameters};
use crate::spacing::Spacing;
use crate::theory::{Claim, Guarantee, Rule};
use beyond::corners::Cuts;
use beyond::inside::Inside;
use beyond::notches::Notches;
use serde::{Deserialize, Serialize};

/// How to treat input angles under 90°, which the paper's theorems exclude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Corners {
    /// As any other angle, and circles cover across a notch: the paper to the letter.
    Bite,
    /// Those inside are cut off before biting, and come back as triangles of their own; across those outside, no circle
    /// covers anything.
    #[default]
    Cut,
}

/// How to treat a segment that the circles of its two ends together cover while meeting low, which Theorem 6.8 silently
/// excludes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HeadOn {
    /// As any other segment: the paper to the letter.
    Leave,
    /// The two circles are made smaller, and a third is put between them.
    #[default]
    Part,
}

/// The biting method and its parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Biting {
    /// Who bites whom. The default is the paper's.
    pub rule: Rule,
    /// The order of bites. The paper leaves it open; the default is the best one in the sweep.
    pub order: Order,
    /// How to treat input angles under 90°, which the paper excludes.
    pub corners: Corners,
    /// How to treat two circles that together cover a segment and meet low.
    pub head_on: HeadOn,
}

/// The parameters with which biting is the paper's, without anything of ours.
pub const TO_THE_LETTER: &[(&str, &str)] = &[("corners", "bite"), ("head_on", "leave")];

pub(super) const ENTRY: Entry = Entry {
    name: "biting",
    summary: "advancing front that packs circles (Li, Teng, Üngör)",
    parameters: &[
        Parameter {
            name: "rule",
            values: "earlier, later",
            default: "earlier",
            help: "whose spacing sets the distance that two points keep: that of the one bitten earlier (§5.1), or of the later one",
        },
        Parameter {
            name: "order",
            values: "fifo, lifo, sharpest, flattest, equilateral, smallest, largest, random",
            default: "largest",
            help: "which front vertex is bitten next (open in §5.1; the default is the best one in the sweep)",
        },
        Parameter {
            name: "corners",
            values: "cut, bite",
            default: "cut",
            help: "whether input angles under 90° are cut off first and come back as triangles (§5.1), or are bitten like any other",
        },
        Parameter {
            name: "head_on",
            values: "part, leave",
            default: "part",
            help: "whether two circles that together cover a segment but meet low are made smaller, with a third between them",
        },
    ],
    make: from_parameters::<Biting>,
};

/// The result of biting: well-spaced points that cover the domain, not yet triangulated.
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
        let t = request.c_b * spacing.lipschitz();
        if t.is_nan() || t >= 1.0 {
            return Err(MeshError::Declined(format!(
                "biting needs t = alpha c_b below 1, and here it is {t}; limit the spacing's gradient (--t)"
            )));
        }
        let inside = Inside::new(self, domain, spacing, t)?;
        let (cuts, capped) = trace.step("corner_cutting", || {
            Cuts::new(self, domain, (spacing, inside.as_ref()), request)
        })?;
        trace.count("corners_cut", cuts.count as f64);
        trace.count("angles_narrowed", cuts.narrowed as f64);
        trace.count("segments_parted", cuts.parted as f64);
        let notches = match self.corners {
            Corners::Bite => Notches::default(),
            Corners::Cut => Notches::new(domain),
        };
        let spacing: &dyn Spacing = if capped.is_empty() { spacing } else { &capped };
        let mut front = front::Front::new(domain, &cuts, (&notches, inside), spacing, self, request);
        front.log = trace.bites.take();
        trace.step("vertex_protection", || boundary::vertex_protection(&mut front))?;
        let pieces = trace.step("edge_protection", || boundary::edge_protection(&mut front))?;
        let centres = trace.step("interior_biting", || interior::interior_biting(&mut front))?;
        trace.bites = front.log;
        trace.count("bites", centres.len() as f64);
        Ok(Bitten { centres, pieces })
    }
}

/// What holds if biting uses the spacing that it was given and leaves out no circle: in plain cases, or to the letter.
const OF_WHOLE_BITES: [Claim; 8] = [
    Claim::PackingDisjoint,
    Claim::Coverage,
    Claim::NnVertexLower,
    Claim::NnVertexUpper,
    Claim::NnPointLower,
    Claim::NnPointUpper,
    Claim::VerticesLower,
    Claim::VerticesUpper,
];

impl Mesher for Biting {
    fn rule(&self) -> Rule {
        self.rule
    }

    fn guarantees(&self) -> Vec<Guarantee> {
        let (cuts, parts) = (self.corners == Corners::Cut, self.head_on == HeadOn::Part);
        let mut claims = vec![Claim::ConstrainedDelaunay, Claim::BoundaryHeight, Claim::MinAngle];
        claims.extend((cuts && parts).then_some(Claim::MinAngleBeyondCorners));
        claims.extend(cuts.then_some(Claim::CornerAngles));
        let plain = cuts || parts;
        let of_whole_bites = OF_WHOLE_BITES.map(|claim| Guarantee { claim, plain });
        claims
            .into_iter()
            .map(Guarantee::always)
            .chain(of_whole_bites)
            .collect()
    }

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
