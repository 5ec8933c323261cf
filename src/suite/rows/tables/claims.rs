//! The columns of `meshes.csv` that say what became of each claim of the certificate.

use super::column::{Column, flag, number, rough};
use super::meshes::of_mesh;
use crate::quality::Check;
use crate::suite::rows::record::{Report, Row};
use crate::theory::Claim;

/// The claims whose worst value is a column of its own, with what it is and what it is where the column is left out. That of the
/// others is another column: [`worst_elsewhere`].
const WORST: [(Claim, &str, Option<&str>); 15] = [
    (
        Claim::PositiveOrientation,
        "smallest signed area of a triangle, in the domain's unit squared, 3 digits",
        None,
    ),
    (
        Claim::Area,
        "relative difference of the triangles' areas and the domain's, 3 digits",
        None,
    ),
    (Claim::VerticesUsed, "mesh vertices in no triangle", Some("0")),
    (
        Claim::InputVertices,
        "input vertices that are not mesh vertices",
        Some("0"),
    ),
    (
        Claim::InputSegments,
        "input segments that are not chains of mesh edges",
        Some("0"),
    ),
    (Claim::ManifoldEdges, "most triangles at an edge", Some("2")),
    (
        Claim::BoundaryOnSegments,
        "edges of one triangle on no input segment",
        Some("0"),
    ),
    (
        Claim::ConstrainedDelaunay,
        "opposite angles above 180°, degrees",
        Some("0"),
    ),
    (
        Claim::PackingDisjoint,
        "‖x − y‖ over the sum of the two packing radii, smallest",
        None,
    ),
    (
        Claim::Coverage,
        "largest part left uncovered, of a circle in radians, of a segment as a share of it; by the rule of the later point the largest distance to the nearest vertex over c_b f",
        None,
    ),
    (
        Claim::BoundaryHeight,
        "height over radius at which circles of neighbouring boundary vertices meet, smallest",
        None,
    ),
    (
        Claim::CornerAngles,
        "angle of a triangle at an input angle under 60° over that angle, smallest",
        None,
    ),
    (
        Claim::NnPointLower,
        "distance to the second nearest vertex over f, smallest at midpoints and circumcentres",
        None,
    ),
    (Claim::NnPointUpper, "the same, largest", None),
    (
        Claim::VerticesUpper,
        "vertices by share of their packing circle in the domain",
        None,
    ),
];

/// The worst value of a claim that is another column.
pub(super) fn worst_elsewhere(claim: Claim) -> Option<&'static str> {
    match claim {
        Claim::MinAngle | Claim::MinAngleBeyondCorners => Some("min_angle_free_deg"),
        Claim::NnVertexLower => Some("nn_over_f_min"),
        Claim::NnVertexUpper => Some("nn_over_f_max"),
        Claim::VerticesLower => Some("vertices"),
        _ => None,
    }
}

/// The column of a claim's worst value.
pub(super) fn worst_column(claim: Claim) -> String {
    worst_elsewhere(claim).map_or_else(|| format!("worst_{}", snake(claim)), str::to_owned)
}

/// The column that says in how many places a claim is broken.
pub(super) fn broken_column(claim: Claim) -> String {
    format!("broken_{}", snake(claim))
}

/// The column that says whether a claim applies.
pub(super) fn applies_column(claim: Claim) -> String {
    format!("applies_{}", snake(claim))
}

fn snake(claim: Claim) -> String {
    claim.name().replace('-', "_")
}

/// The worst value of a claim where its column is left out.
pub(super) fn worst_default(claim: Claim) -> Option<f64> {
    let (.., default) = WORST.iter().find(|(known, ..)| *known == claim)?;
    default.and_then(|text| text.parse().ok())
}

/// The worst value of each claim, in how many places it is broken, and whether it applies.
pub(super) fn claims() -> Vec<Column<Row>> {
    fn check(report: &Report, claim: Claim) -> Option<&Check> {
        report.certificate.check(claim)
    }
    let worst = WORST.iter().map(|&(claim, about, default)| {
        let about = format!("worst value of `{claim}`: {about}");
        let written = match claim {
            Claim::PositiveOrientation | Claim::Area => rough,
            _ => number,
        };
        of_mesh(&worst_column(claim), &about, move |report| {
            check(report, claim)?.worst.map(written)
        })
        .paper(claim.lemma())
        .or(default)
    });
    let applies = Claim::ALL.into_iter().map(|claim| {
        let about = format!("1 if the method guarantees `{claim}` and its hypotheses hold; else it is only measured");
        of_mesh(&applies_column(claim), &about, move |report| {
            Some(flag(check(report, claim)?.applies))
        })
        .or("1")
    });
    let broken = Claim::ALL.into_iter().map(|claim| {
        let about = format!("number of places where `{claim}` does not hold");
        of_mesh(&broken_column(claim), &about, move |report| {
            Some(check(report, claim)?.broken.to_string())
        })
        .or("0")
    });
    worst.chain(broken).chain(applies).collect()
}
