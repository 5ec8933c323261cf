//! The paper's formulas, hypotheses and claims, each once. Meshers and quality both import them from here, and neither
//! imports the other.
//!
//! [`Rule`] says who bites whom, [`Promises`] has every bound for a rule and t, [`Hypotheses`] has what the bounds
//! need, and [`Claim`] names the checks of the certificate. For [`Rule::Earlier`] the numbers are the paper's; for
//! [`Rule::Later`] the docs of [`crate::meshers::biting`] derive them.

use crate::geometry::tolerance::{AREA, RIGHT_ANGLE_DEG};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, SQRT_2};
use std::fmt;

#[cfg(test)]
mod tests;

/// The t = α c_b below which a spacing counts as flat. If biting must go down to a smaller size beside a corner, sizes
/// then grow away from there faster than the spacing would.
pub const FLAT_T: f64 = 0.05;

/// √2 − 1, the largest t = α c_b for which biting is proved to work with distances inside the domain.
pub const GEODESIC_T: f64 = SQRT_2 - 1.0;

/// 1/3, the largest t for which the bounds of §6 at the boundary hold.
pub const BOUNDARY_T: f64 = 1.0 / 3.0;

/// Whose spacing sets the distance of two points x and y, x bitten before y. With g = c_b f and t its Lipschitz constant:
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// That of the earlier point, ‖x − y‖ ≥ g(x), as in the paper: y lies in no circle of the points before it. Biting
    /// ends when every point z of the domain has a bitten point x with ‖x − z‖ ≤ g(x).
    #[default]
    Earlier,
    /// That of the later point, ‖x − y‖ ≥ g(y): no point before lies in the circle of y. Biting ends when every point z
    /// of the domain has a bitten point x with ‖x − z‖ ≤ g(z).
    Later,
}

impl Rule {
    /// The one of two values that counts for the distance of two points: that of the point bitten first, or that of the
    /// other.
    pub fn of<T>(self, earlier: T, later: T) -> T {
        match self {
            Self::Earlier => earlier,
            Self::Later => later,
        }
    }
}

/// The packing constant c_p = c_b / (2 + t): by Lemma 5.4 the circles B(x, c_p f(x)) are disjoint.
pub fn packing_constant(c_b: f64, t: f64) -> f64 {
    c_b / (2.0 + t)
}

/// β = (1 + t) / (1 − t) of Theorem 5.5: every point y of the domain has a packing circle within β c_p f(y). Infinite
/// from t = 1 on.
pub fn beta(t: f64) -> f64 {
    if t < 1.0 { (1.0 + t) / (1.0 - t) } else { f64::INFINITY }
}

/// Equation (9), the smaller of the bounds of Lemmas 6.3 and 6.4: the circles of neighbouring boundary vertices meet at
/// least (1 − t) √((t² − 4t + 7)(1 − t²)) / 4 times the smaller radius above the boundary.
pub fn least_meeting_height(t: f64) -> f64 {
    (1.0 - t) * ((t * t - 4.0 * t + 7.0) * (1.0 - t * t)).max(0.0).sqrt() / 4.0
}

/// The bounds of biting for a rule and t = c_b · lipschitz(). Distances are in units of c_b f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Promises {
    /// Who bites whom.
    pub rule: Rule,
    /// α c_b.
    pub t: f64,
}

impl Promises {
    /// sin θ ≥ 1/2 − t by Theorem 6.8; (1 − t) / 2 by the rule of the later point. 0 if that is negative.
    pub fn least_sine(self) -> f64 {
        self.rule.of(0.5 - self.t, 0.5 - 0.5 * self.t).max(0.0)
    }

    /// The angle of [`Promises::least_sine`], degrees.
    pub fn min_angle_deg(self) -> f64 {
        self.least_sine().asin().to_degrees()
    }

    /// nn at vertices: from 1 − t to 2 / (1 − t) by Lemma 5.7; from 1 / (1 + t) by the rule of the later point.
    pub fn nn_at_vertices(self) -> [f64; 2] {
        let t = self.t;
        let least = self.rule.of((1.0 - t).max(0.0), 1.0 / (1.0 + t));
        [least, self.upper(2.0 / (1.0 - t))]
    }

    /// nn elsewhere: from 1 / (2 + 2t) to (3 − t) / (1 − t)² by Lemma 5.8; from 1 / (2 + t) to (3 + t) / (1 − t) by the
    /// rule of the later point.
    pub fn nn_at_points(self) -> [f64; 2] {
        let t = self.t;
        let least = self.rule.of(1.0 / (2.0 + 2.0 * t), 1.0 / (2.0 + t));
        let most = self.rule.of((3.0 - t) / ((1.0 - t) * (1.0 - t)), (3.0 + t) / (1.0 - t));
        [least, self.upper(most)]
    }

    /// The most of ∫ dA / (c_b f)² that one point x can eat: π / (1 − t)², since f ≥ (1 − t) f(x) in its circle; −2π
    /// (ln(1 − t) + t) / t² by the rule of the later point, where g grows with t away from it.
    pub fn most_eaten(self) -> f64 {
        let t = self.t;
        let by_later = if t < 1e-4 {
            // The first terms of the series: the formula cancels.
            PI * (1.0 + 2.0 * t / 3.0 + 0.5 * t * t)
        } else {
            -2.0 * PI * ((-t).ln_1p() + t) / (t * t)
        };
        self.upper(self.rule.of(PI / ((1.0 - t) * (1.0 - t)), by_later))
    }

    /// The fewest and the most vertices of a mesh, each counted by the share of its packing circle that lies in the
    /// domain: at least as many as cover ∫ dA / f², at most as many as there is room for their packing circles.
    /// `integral` is the least and the largest value that the integral may have.
    pub fn vertices(self, c_b: f64, integral: [f64; 2]) -> [f64; 2] {
        let fewest = integral[0] / (self.most_eaten() * c_b * c_b);
        let most = 4.0 * (1.0 + self.t).powi(2) * integral[1] / (PI * c_b * c_b);
        [fewest, most]
    }

    /// What the certificate holds the worst value of a claim against. `integral` is as for [`Promises::vertices`].
    pub fn bound(self, claim: Claim, c_b: f64, integral: [f64; 2]) -> f64 {
        match claim {
            Claim::PositiveOrientation
            | Claim::VerticesUsed
            | Claim::InputVertices
            | Claim::InputSegments
            | Claim::BoundaryOnSegments
            | Claim::ConstrainedDelaunay => 0.0,
            Claim::ManifoldEdges => 2.0,
            Claim::Area => AREA,
            Claim::PackingDisjoint | Claim::CornerAngles => 1.0,
            Claim::Coverage => self.rule.of(0.0, 1.0),
            Claim::BoundaryHeight => least_meeting_height(self.t.min(1.0)),
            Claim::MinAngle | Claim::MinAngleBeyondCorners => self.min_angle_deg(),
            Claim::NnVertexLower => c_b * self.nn_at_vertices()[0],
            Claim::NnVertexUpper => c_b * self.nn_at_vertices()[1],
            Claim::NnPointLower => c_b * self.nn_at_points()[0],
            Claim::NnPointUpper => c_b * self.nn_at_points()[1],
            Claim::VerticesLower => self.vertices(c_b, integral)[0],
            Claim::VerticesUpper => self.vertices(c_b, integral)[1],
        }
    }

    /// No upper bound holds from t = 1 on.
    fn upper(self, bound: f64) -> f64 {
        if self.t < 1.0 { bound } else { f64::INFINITY }
    }
}

/// A claim of the certificate, the structural ones first; the table in [`crate::quality`] has what each says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)]
pub enum Claim {
    PositiveOrientation,
    Area,
    VerticesUsed,
    InputVertices,
    InputSegments,
    ManifoldEdges,
    BoundaryOnSegments,
    ConstrainedDelaunay,
    PackingDisjoint,
    Coverage,
    BoundaryHeight,
    MinAngle,
    MinAngleBeyondCorners,
    CornerAngles,
    NnVertexLower,
    NnVertexUpper,
    NnPointLower,
    NnPointUpper,
    VerticesLower,
    VerticesUpper,
}

impl Claim {
    /// All, in the order of a certificate.
    pub const ALL: [Self; 20] = [
        Self::PositiveOrientation,
        Self::Area,
        Self::VerticesUsed,
        Self::InputVertices,
        Self::InputSegments,
        Self::ManifoldEdges,
        Self::BoundaryOnSegments,
        Self::ConstrainedDelaunay,
        Self::PackingDisjoint,
        Self::Coverage,
        Self::BoundaryHeight,
        Self::MinAngle,
        Self::MinAngleBeyondCorners,
        Self::CornerAngles,
        Self::NnVertexLower,
        Self::NnVertexUpper,
        Self::NnPointLower,
        Self::NnPointUpper,
        Self::VerticesLower,
        Self::VerticesUpper,
    ];

    /// Its name in reports, tables and messages: kebab case.
    pub fn name(self) -> &'static str {
        match self {
            Self::PositiveOrientation => "positive-orientation",
            Self::Area => "area",
            Self::VerticesUsed => "vertices-used",
            Self::InputVertices => "input-vertices",
            Self::InputSegments => "input-segments",
            Self::ManifoldEdges => "manifold-edges",
            Self::BoundaryOnSegments => "boundary-on-segments",
            Self::ConstrainedDelaunay => "constrained-delaunay",
            Self::PackingDisjoint => "packing-disjoint",
            Self::Coverage => "coverage",
            Self::BoundaryHeight => "boundary-height",
            Self::MinAngle => "min-angle",
            Self::MinAngleBeyondCorners => "min-angle-beyond-corners",
            Self::CornerAngles => "corner-angles",
            Self::NnVertexLower => "nn-vertex-lower",
            Self::NnVertexUpper => "nn-vertex-upper",
            Self::NnPointLower => "nn-point-lower",
            Self::NnPointUpper => "nn-point-upper",
            Self::VerticesLower => "vertices-lower",
            Self::VerticesUpper => "vertices-upper",
        }
    }

    /// The place in the paper that states it; empty for the structural claims.
    pub fn lemma(self) -> &'static str {
        match self {
            Self::PackingDisjoint => "Lemma 5.4",
            Self::Coverage => "Theorem 5.5",
            Self::BoundaryHeight => "Lemmas 6.3 and 6.4",
            Self::MinAngle => "Theorem 6.8",
            Self::MinAngleBeyondCorners => "Theorem 6.8, §5.1",
            Self::CornerAngles => "§5.1",
            Self::NnVertexLower | Self::NnVertexUpper => "Lemma 5.7",
            Self::NnPointLower | Self::NnPointUpper => "Lemma 5.8",
            Self::VerticesLower => "from Theorem 5.5",
            Self::VerticesUpper => "from Lemma 5.4",
            _ => "",
        }
    }
}

impl fmt::Display for Claim {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.pad(self.name())
    }
}

/// A claim that a method guarantees if the claim's hypotheses hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Guarantee {
    /// The claim.
    pub claim: Claim,
    /// Whether only in plain cases: no angle between neighbouring segments, inside or outside, is under 90°, and, by
    /// the paper's rule, c_b + t ≤ 1. In other cases the method meshes with a smaller spacing than it was given, or
    /// leaves out some circles.
    pub plain: bool,
}

impl Guarantee {
    /// On every domain, for every spacing.
    pub const fn always(claim: Claim) -> Self {
        Self { claim, plain: false }
    }

    /// Only in plain cases.
    pub const fn plain(claim: Claim) -> Self {
        Self { claim, plain: true }
    }
}

/// Whether something that a claim needs is met, and what it is.
type Needed = (bool, &'static str);

/// What the paper's theorems assume, stated or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hypotheses {
    /// c_b times the Lipschitz constant of the spacing as evaluated.
    pub t: f64,
    /// Biting constant.
    pub c_b: f64,
    /// Whose spacing sets the distance of two points.
    pub rule: Rule,
    /// Whether f ≤ lfs.
    pub lfs_cap: bool,
    /// Smallest angle between neighbouring segments, inside or outside, degrees; 360 if none.
    pub smallest_segment_angle_deg: f64,
    /// The number of input segments bitten at their two vertices only, whose circles meet lower than (9).
    pub low_head_on: usize,
    /// Whether every vertex with an angle under 90° inside has no other angle inside.
    pub single_corners: bool,
    /// Whether f is Lipschitz, and lfs measured, in distances inside the domain.
    pub is_geodesic: bool,
    /// Whether a vertex with an angle under 90° inside, which has no circle if corners are cut off, may hide points:
    /// whether it has an angle under 180° outside.
    pub corners_hide: bool,
}

impl Hypotheses {
    /// Whether neither the domain nor the request needs anything that the paper does not have: no angle between
    /// neighbouring segments, inside or outside, is under 90°, and c_b + t ≤ 1. The rule of the later point does not
    /// need the second.
    pub fn is_plain(&self) -> bool {
        (self.rule == Rule::Later || self.c_b + self.t <= 1.0) && self.has_no_small_angle()
    }

    /// Whether a claim follows from these hypotheses for a mesh made by biting.
    pub fn imply(&self, claim: Claim) -> bool {
        self.unmet(claim).is_empty()
    }

    /// What a claim needs and they do not meet, each as one would ask for it; `…=…` are columns of the tables of results.
    pub fn unmet(&self, claim: Claim) -> Vec<&'static str> {
        let mut needed = Vec::new();
        if self.is_geodesic {
            needed.extend([
                (self.rule == Rule::Earlier, "rule=earlier"),
                (self.t <= GEODESIC_T, "t <= 0.414"),
                (!self.corners_hide, "no corner that hides points"),
            ]);
        }
        match claim {
            Claim::PackingDisjoint | Claim::VerticesUpper => needed.extend(self.vertices_apart()),
            Claim::Coverage | Claim::VerticesLower => needed.push(self.below_one()),
            Claim::BoundaryHeight => {
                needed.push((self.rule == Rule::Earlier, "rule=earlier"));
                needed.extend(self.of_section_6());
            }
            Claim::MinAngle => needed.extend(self.of_theorem_6_8()),
            Claim::MinAngleBeyondCorners => needed.extend(self.corners_can_be_cut()),
            Claim::CornerAngles => needed.push((self.single_corners, "one angle inside at each corner")),
            Claim::NnVertexLower | Claim::NnVertexUpper | Claim::NnPointLower | Claim::NnPointUpper => {
                needed.extend(self.vertices_apart());
                needed.push(self.below_one());
            }
            // Of the structure of a mesh.
            _ => return Vec::new(),
        }
        let mut unmet: Vec<&str> = needed
            .iter()
            .filter(|(is_met, _)| !is_met)
            .map(|(_, what)| *what)
            .collect();
        unmet.dedup();
        unmet
    }

    /// What [`Hypotheses::is_plain`] needs and they do not meet.
    pub fn not_plain(&self) -> Vec<&'static str> {
        let needed = [
            (self.rule == Rule::Later || self.c_b + self.t <= 1.0, "c_b + t <= 1"),
            self.no_small_angle(),
        ];
        needed
            .iter()
            .filter(|(is_met, _)| !is_met)
            .map(|(_, what)| *what)
            .collect()
    }

    /// What §6 assumes of domain and t.
    fn of_section_6(&self) -> Vec<Needed> {
        let [capped, small] = self.vertices_apart();
        vec![capped, small, (self.t <= BOUNDARY_T, "t <= 1/3"), self.no_small_angle()]
    }

    /// What Theorem 6.8 needs, stated or not; by the rule of the later point, any t < 1 is enough.
    fn of_theorem_6_8(&self) -> Vec<Needed> {
        match self.rule {
            Rule::Earlier => {
                let mut needed = self.of_section_6();
                needed.push((self.low_head_on == 0, "low_head_on=0"));
                needed
            }
            Rule::Later => {
                let [capped, small] = self.vertices_apart();
                vec![capped, small, self.below_one(), self.no_small_angle()]
            }
        }
    }

    /// Circles around input vertices hold no other input vertex (Lemma 5.1).
    fn vertices_apart(&self) -> [Needed; 2] {
        [(self.lfs_cap, "lfs_cap=1"), (self.c_b <= 1.0, "c_b <= 1")]
    }

    /// Whether corners can be cut off so that the angle bound holds beyond them: with t, the spacing must come down to
    /// the sizes of the cuts.
    fn corners_can_be_cut(&self) -> Vec<Needed> {
        let [capped, small] = self.vertices_apart();
        let (steepest, told) = self.rule.of((BOUNDARY_T, "t <= 1/3"), (1.0 / 2.0, "t <= 1/2"));
        vec![
            capped,
            small,
            (self.t <= steepest, told),
            (self.t >= FLAT_T || self.is_plain(), "t >= 0.05"),
        ]
    }

    fn below_one(&self) -> Needed {
        (self.t < 1.0, "t < 1")
    }

    fn no_small_angle(&self) -> Needed {
        (self.has_no_small_angle(), "no angle under 90 degrees")
    }

    fn has_no_small_angle(&self) -> bool {
        self.smallest_segment_angle_deg >= 90.0 - RIGHT_ANGLE_DEG
    }
}
