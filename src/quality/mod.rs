//! Judges a mesh by domain, spacing, c_b and mesh alone. This module imports no mesher.
//!
//! [`Statistics`] are numbers; a [`Certificate`] is a list of checks, each with worst value, bound and witnesses. What
//! a mesher reports about its own mesh (pieces, input vertices) is not used: the boundary is found by coordinates.
//!
//! # Structural checks
//! All but the last are guaranteed for every mesher; the last is guaranteed for meshers that claim it.
//!
//! | claim | says | worst |
//! |---|---|---|
//! | `positive-orientation` | every triangle is counter-clockwise, exactly | smallest signed area |
//! | `area` | triangles' areas sum to the domain's | relative difference |
//! | `vertices-used` | every mesh vertex is in a triangle | how many are not |
//! | `input-vertices` | every input vertex is a mesh vertex | how many are not |
//! | `input-segments` | every input segment is a chain of mesh edges | how many are not |
//! | `manifold-edges` | an edge is in at most two triangles, once in each direction | most triangles at an edge |
//! | `boundary-on-segments` | an edge of one triangle lies on an input segment | how many do not |
//! | `constrained-delaunay` | an edge on no input segment is Delaunay, exactly | opposite angles above 180°, degrees |
//!
//! # The paper's bounds, with t = c_b · lipschitz()
//! | claim | paper | says | needs |
//! |---|---|---|---|
//! | `packing-disjoint` | Lemma 5.4 | ‖x − y‖ ≥ c_p (f(x) + f(y)), c_p = c_b / (2 + t) | f ≤ lfs, c_b ≤ 1 |
//! | `coverage` | Theorem 5.5 | every point of Ω is in some closed B(x, c_b f(x)) | t < 1 |
//! | `boundary-height` | Lemmas 6.3, 6.4 | circles of neighbouring boundary vertices meet at least (9) · smaller radius above the boundary | f ≤ lfs, c_b ≤ 1, t ≤ 1/3, no angle under 90° |
//! | `min-angle` | Theorem 6.8 | sin θ ≥ 1/2 − t | the same, and no `low_head_on` |
//! | `min-angle-beyond-corners` | Theorem 6.8, §5.1 | sin θ ≥ 1/2 − t in triangles that touch no input angle under 60° | f ≤ lfs, c_b ≤ 1, 0.05 ≤ t ≤ 1/3, corners cut off |
//! | `corner-angles` | §5.1 | no angle of a triangle at an input angle under 60° is below the smallest input angle there | corners cut off, each its vertex's only angle inside |
//! | `nn-vertex-lower`, `-upper` | Lemma 5.7 | c_b (1 − t) f ≤ nn ≤ 2 c_b / (1 − t) f at vertices | f ≤ lfs, c_b ≤ 1, t < 1 |
//! | `nn-point-lower`, `-upper` | Lemma 5.8 | c_b / (2 + 2t) f ≤ nn ≤ (3 − t) c_b / (1 − t)² f elsewhere | the same |
//! | `vertices-lower` | follows from 5.5 | vertices ≥ (1 − t)² I / (π c_b²) | t < 1 |
//! | `vertices-upper` | follows from 5.4 | vertices, by share of packing circle, ≤ 4 (1 + t)² I / (π c_b²) | f ≤ lfs, c_b ≤ 1 |
//!
//! These are for the rule of the paper. By the rule of the later point ([`Rule::Later`]) the same claims say:
//! | claim | says | needs |
//! |---|---|---|
//! | `coverage` | every point z of Ω has ‖x − z‖ ≤ c_b f(z) for some x | t < 1 |
//! | `min-angle` | sin θ ≥ (1 − t) / 2 | f ≤ lfs, c_b ≤ 1, t < 1, no angle under 90° |
//! | `min-angle-beyond-corners` | the same in triangles that touch no input angle under 60° | f ≤ lfs, c_b ≤ 1, 0.05 ≤ t ≤ 1/2, corners cut off |
//! | `nn-vertex-lower`, `-upper` | c_b / (1 + t) f ≤ nn ≤ 2 c_b / (1 − t) f at vertices | f ≤ lfs, c_b ≤ 1, t < 1 |
//! | `nn-point-lower`, `-upper` | c_b / (2 + t) f ≤ nn ≤ (3 + t) c_b / (1 − t) f elsewhere | the same |
//! | `vertices-lower` | vertices ≥ t² I / (−2π c_b² (ln(1 − t) + t)) | t < 1 |
//!
//! `packing-disjoint` and `vertices-upper` stay as they are, and `boundary-height` is only measured. The bound t ≥ 0.05
//! ([`FLAT_T`](crate::theory::FLAT_T)) of `min-angle-beyond-corners` is not needed if nothing has to be cut off or held
//! apart ([`Hypotheses::is_plain`]).
//!
//! # Distances inside the domain
//! If the spacing is Lipschitz in these ([`Spacing::is_geodesic`]), lfs is [`crate::spacing::GeodesicLfs`], and circles
//! and vertices count only for what they reach (`delaunay::Reach`, found from the domain alone):
//!
//! * `packing-disjoint` leaves out pairs of vertices if the circle of the one with the larger spacing holds the other
//!   without reaching it;
//! * `coverage`: a point must be in a circle that reaches it;
//! * nn is the smallest radius with which a disc reaches another vertex, or two.
//!
//! Besides what the table says, all bounds then need t ≤ √2 − 1, the rule of the paper, and no vertex with an angle
//! under 90° inside and one under 180° outside. The docs of biting have the proof.
//!
//! # Hypotheses
//! `low_head_on` counts the input segments that the circles of their two input vertices together cover while meeting
//! lower than (9). The paper excludes this case without saying so; it is possible only if c_b + t > 1 (`protection.rs`
//! has the reason).
//!
//! [`Hypotheses`] has what each bound needs. A check whose hypotheses fail, or that the mesher does not guarantee, is
//! still measured, but its `applies` is false. No angle under 90° means none between neighbouring segments, inside *or
//! outside*: §5.1 assumes that the domain "does not have an acute input angle", and across a narrow notch a circle
//! bites what its centre cannot see.
//!
//! # How coverage is decided without sampling
//! Let U be the part of Ω outside all closed discs, and assume that it is not empty. If all of ∂Ω (and of every inner
//! segment) is covered, U is open and bounded by arcs of circles, each of them inside Ω and inside no other disc. So
//! two things need checking: that each input segment is covered along its length (a union of intervals), and, for each
//! circle, that the angular intervals inside the other discs cover all of it that lies in Ω. An arc left over cannot
//! cross ∂Ω, since points of ∂Ω beside the crossing would be uncovered; so one point of it decides whether it lies in
//! Ω.
//!
//! # Why `vertices-lower` and `vertices-upper` hold
//! Within B(x, c_b f(x)), f ≥ (1 − t) f(x), so this disc holds at most π c_b² / (1 − t)² of I = ∫ dA / f². Discs that
//! cover Ω hold all of I. Within B(x, c_p f(x)), f ≤ (1 + α c_p) f(x), so this disc holds at least π c_p² / (1 + α
//! c_p)² = π c_b² / (4 (1 + t)²) of I if it lies in Ω. Disjoint discs hold at most all of I. A disc that reaches
//! outside Ω counts by the share that surely lies in Ω. If it is the disc of an input vertex and meets only the
//! segments there, that is the angle inside over 2π. If it meets one boundary segment, it is 1/2, since a chord leaves
//! at least the half disc on the centre's side. If it meets more, it is 0.

mod angle;
mod boundary;
mod coverage;
mod discs;
mod gaps;
mod parallel;
mod protection;
mod reached;
pub(crate) mod shape;
mod spread;
mod statistics;
mod structure;
mod subject;
mod tally;
#[cfg(test)]
mod tests;

use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::spacing::{Integral, Spacing};
use crate::theory::{Claim, Hypotheses, Rule};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

/// 5th, 50th and 95th percentile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Percentiles {
    /// 5th.
    pub p05: f64,
    /// Median.
    pub p50: f64,
    /// 95th.
    pub p95: f64,
}

/// Smallest and largest of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
}

/// The numbers that make meshes comparable: those of the mesh alone and, with a spacing, those relative to it. Angles
/// are in degrees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Mesh vertices.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
    /// Smallest angle of all triangles.
    pub min_angle_deg: f64,
    /// Smallest angle, leaving out triangles that touch an input vertex with an inside angle under 60°; absent if no
    /// triangle is left.
    pub min_angle_free_deg: Option<f64>,
    /// Triangles left out of `min_angle_free_deg`.
    pub excused: usize,
    /// Largest angle.
    pub max_angle_deg: f64,
    /// Mean over triangles of the smallest angle.
    pub mean_min_angle_deg: f64,
    /// 5th percentile over triangles of the smallest angle.
    pub p05_min_angle_deg: f64,
    /// Largest circumradius over shortest edge.
    pub max_radius_edge: f64,
    /// Triangles by smallest angle, in 60 bins of one degree: bin k counts k ≤ angle < k + 1, the last one 60° too.
    pub min_angle_histogram: Vec<u64>,
    /// Edge length over s(midpoint), s = c_b f; absent without a spacing.
    pub edge_over_size: Option<Percentiles>,
    /// Distance to the nearest mesh vertex over f, at mesh vertices; absent without a spacing.
    pub nn_over_f: Option<Range>,
    /// The β of Definition 4.1 that the vertices reach as centres of packing circles of radius c_p f, c_p = c_b / (2 +
    /// t): no point q of the domain has a larger gap to them than β c_p f(q). An estimate from below (`gaps.rs`);
    /// absent without a spacing.
    #[serde(default)]
    pub beta: Option<f64>,
    /// Angles where one front met another ([`Mesh::seams`]), and elsewhere; absent if none did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seams: Option<Seams>,
}

/// Angles where one front met another, and elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seams {
    /// Where fronts met.
    pub met: Angles,
    /// All other triangles.
    pub elsewhere: Angles,
}

/// Smallest angles of some triangles, those that touch an input angle under 60° left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Angles {
    /// How many triangles.
    pub triangles: usize,
    /// The smallest, degrees; 0 if there are no triangles, as in the other fields.
    pub min_deg: f64,
    /// Mean over triangles of the smallest angle, degrees.
    pub mean_deg: f64,
    /// 5th percentile over triangles of the smallest angle, degrees.
    pub p05_deg: f64,
    /// Share of triangles with a smallest angle under 30°.
    pub share_under_30: f64,
}

impl Statistics {
    /// Share of triangles whose smallest angle is under a whole number of degrees.
    pub fn share_under(&self, degrees: usize) -> f64 {
        let under: u64 = self.min_angle_histogram.iter().take(degrees).sum();
        under as f64 / self.triangles.max(1) as f64
    }
}

/// A check of the certificate, as data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// The claim that is checked.
    pub claim: Claim,
    /// The place in the paper that states it; empty for structural checks.
    pub lemma: String,
    /// Whether the hypotheses hold and the method guarantees the claim; a check that does not apply is a measurement.
    pub applies: bool,
    /// The worst value found; absent if there was nothing to measure.
    pub worst: Option<f64>,
    /// The bound with which it is compared.
    pub bound: Option<f64>,
    /// Whether the claim holds everywhere that it was checked.
    pub holds: bool,
    /// How many places broke it; of the circles that overlap one packing circle, at most a few hundred are counted.
    pub broken: usize,
    /// Where the worst is, if it is somewhere.
    pub at: Option<[f64; 2]>,
    /// The first few places that broke it: centroids of triangles, midpoints of edges, vertices.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub witnesses: Vec<[f64; 2]>,
}

/// The most witnesses that a check lists.
pub const WITNESSES: usize = 8;

/// Every bound of the paper and every structural claim, checked on one mesh.
///
/// ```
/// use biting::{Case, domain::Domain, meshers::biting::Biting, theory::Claim};
///
/// let square = Domain::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])?;
/// let case = Case::new(square, "lfs", 0.25, 0.75)?;
/// let (_, certificate) = case.judge_of(&case.mesh(&Biting::default())?, &Biting::default());
/// let angle = certificate.check(Claim::MinAngle).expect("judged with a spacing");
/// assert!(angle.applies && angle.holds && angle.worst >= angle.bound);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Whether every check that applies holds.
    pub holds: bool,
    /// Triangles excused from the angle bound, since they touch an input vertex with an inside angle under 60°.
    pub excused: usize,
    /// The number of input segments bitten at their two vertices only, whose circles meet lower than the bound of Lemma
    /// 6.4. That there are none is a hypothesis of Theorem 6.8 that the paper does not state. 0 without a spacing.
    #[serde(default)]
    pub low_head_on: usize,
    /// All checks.
    pub checks: Vec<Check>,
}

/// What the checks of the paper's bounds need.
#[derive(Clone, Copy)]
pub struct Bounds<'a> {
    /// f as the mesher evaluated it.
    pub spacing: &'a dyn Spacing,
    /// Biting constant.
    pub c_b: f64,
    /// Whose spacing sets the distance of two points: the bounds depend on it.
    pub rule: Rule,
    /// Whether f ≤ lfs is known.
    pub lfs_cap: bool,
    /// ∫_Ω dA / f². The bounds on the number of vertices allow for its error; without it there are none.
    pub integral: Option<Integral>,
    /// Claims that the mesher guarantees if their hypotheses hold.
    pub guaranteed: &'a [Claim],
}

/// The hypotheses of a domain, a spacing and c_b, and of what the mesh shows at the boundary.
pub(crate) fn hypotheses(domain: &Domain, bounds: &Bounds, low_head_on: usize) -> Hypotheses {
    Hypotheses {
        t: bounds.c_b * bounds.spacing.lipschitz(),
        c_b: bounds.c_b,
        rule: bounds.rule,
        lfs_cap: bounds.lfs_cap,
        smallest_segment_angle_deg: domain.smallest_segment_angle_deg(),
        low_head_on,
        single_corners: has_single_corners(domain),
        is_geodesic: bounds.spacing.is_geodesic(),
        corners_hide: corners_hide(domain),
    }
}

fn corners_hide(domain: &Domain) -> bool {
    (0..domain.vertices().len()).any(|v| {
        let wedges = domain.wedges(v);
        let is_cut = wedges.iter().any(|wedge| wedge.inside && wedge.angle < FRAC_PI_2);
        is_cut && wedges.iter().any(|wedge| !wedge.inside && wedge.angle < PI)
    })
}

fn has_single_corners(domain: &Domain) -> bool {
    (0..domain.vertices().len()).all(|v| {
        let inside = || domain.wedges(v).iter().filter(|wedge| wedge.inside);
        inside().count() == 1 || inside().all(|wedge| wedge.angle >= FRAC_PI_2)
    })
}

/// Statistics and certificate of a mesh of `domain`; with `bounds`, those that need a spacing too.
///
/// The mesh may come from anywhere. The work is shared among rayon's threads; the result does not depend on them.
pub fn judge(domain: &Domain, mesh: &Mesh, bounds: Option<&Bounds>) -> (Statistics, Certificate) {
    let subject = subject::Subject::new(domain, mesh, bounds);
    (statistics::measure(&subject), certificate(&subject))
}

fn certificate(subject: &subject::Subject) -> Certificate {
    let structure = structure::Structure::of(subject);
    let is_whole = structure.is_whole();
    let mut checks = structure.into_checks();
    if let Some(sizes) = &subject.sizes {
        checks.push(coverage::packing_check(sizes));
        checks.push(coverage::coverage_check(subject, sizes, is_whole));
        checks.push(sizes.heights.check(sizes.applies(Claim::BoundaryHeight)));
        checks.extend(angle::checks(subject, sizes));
        checks.push(angle::corner_check(subject, sizes));
        checks.extend(spread::checks(subject, sizes));
    }
    Certificate {
        holds: checks.iter().all(|check| check.holds || !check.applies),
        excused: subject.excused,
        low_head_on: subject.sizes.as_ref().map_or(0, |sizes| sizes.hypotheses.low_head_on),
        checks,
    }
}

impl Certificate {
    /// The checks that apply and do not hold.
    pub fn broken(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| check.applies && !check.holds)
    }

    /// The check of a claim.
    pub fn check(&self, claim: Claim) -> Option<&Check> {
        self.checks.iter().find(|check| check.claim == claim)
    }
}
