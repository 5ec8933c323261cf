//! Judges a mesh from domain, spacing, c_b and mesh alone. Imports no mesher.
//!
//! [`Statistics`] are numbers; a [`Certificate`] is a list of checks, each with worst value, bound and witness.

use serde::{Deserialize, Serialize};

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

/// The numbers of `design.md` that need the mesh (and, where told, the spacing). Angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Mesh vertices.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
    /// Smallest angle of all triangles.
    pub min_angle_deg: f64,
    /// Smallest angle leaving out triangles that touch an input vertex with an inside angle under 60°;
    /// absent where no triangle is left.
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
    /// Triangles by smallest angle, one count a degree: bin k holds k ≤ angle < k + 1, 60 bins.
    pub min_angle_histogram: Vec<u64>,
    /// Edge length over s(midpoint), s = c_b f; absent without a spacing.
    pub edge_over_size: Option<Percentiles>,
    /// Distance to the nearest mesh vertex over f, at mesh vertices; absent without a spacing.
    pub nn_over_f: Option<Range>,
}

/// A check of the certificate, as data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// Short name, in kebab case, unique: `min-angle`, `packing-disjoint`, …
    pub claim: String,
    /// Where the paper says so; empty for structural checks.
    pub lemma: String,
    /// Whether the hypotheses hold and the method guarantees it; a check that does not apply is a measurement.
    pub applies: bool,
    /// The worst value found; absent where there was nothing to measure.
    pub worst: Option<f64>,
    /// What it is held against.
    pub bound: Option<f64>,
    /// Whether the claim holds for every witness looked at.
    pub holds: bool,
    /// How many witnesses broke it.
    pub broken: usize,
    /// Where the worst is, if it is somewhere.
    pub at: Option<[f64; 2]>,
}

/// Every bound of the paper and every structural promise, checked on one mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Whether every check that applies holds.
    pub holds: bool,
    /// Triangles excused from the angle bound since they touch an input vertex with an inside angle under 60°.
    pub excused: usize,
    /// All checks.
    pub checks: Vec<Check>,
}
