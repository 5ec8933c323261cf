//! A [`Report`] says all about one mesh; a [`Row`] is one line of an experiment, failures included.

use crate::meshers::{Parameters, parameter_value};
use crate::quality::{Certificate, Statistics};
use crate::suite::fem::Solution;
use crate::suite::peers::AnyEntry;
use crate::suite::rows::adapted::{Adapt, Round};
use crate::suite::rows::times::Times;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What made a row: enough to make it again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Version of this crate.
    pub version: String,
    /// Commit, empty outside a checkout.
    pub commit: String,
    /// Whether the work tree had changes.
    pub dirty: bool,
    /// Compiler.
    pub rustc: String,
    /// Processor model.
    pub cpu: String,
    /// Cores the process may use.
    pub cores: usize,
    /// Operating system.
    pub os: String,
    /// When the row was made, RFC 3339, UTC.
    pub date: String,
}

/// Everything about one mesh. Field names are fixed, since scripts use them; lengths are in the domain's unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Gallery name or file stem.
    pub domain: String,
    /// Name in `MESHERS` or `PEERS`.
    pub mesher: String,
    /// The mesher's own parameters, all of them.
    pub params: serde_json::Map<String, serde_json::Value>,
    /// The spacing as asked for.
    pub spacing: String,
    /// Nominal t = α c_b.
    pub t: f64,
    /// c_b times the Lipschitz constant of the spacing as evaluated.
    pub t_effective: f64,
    /// Biting constant.
    pub c_b: f64,
    /// t / c_b: what the spacing is limited to.
    pub alpha: f64,
    /// Seed.
    pub seed: u64,
    /// Hypothesis: the spacing was capped by lfs.
    pub lfs_cap: bool,
    /// Hypothesis: smallest angle between neighbouring segments that opens into the domain, degrees; 360 if none.
    pub smallest_input_angle_deg: f64,
    /// Hypothesis: smallest angle between neighbouring segments on any side, inside or out, degrees; 360 if none.
    pub smallest_segment_angle_deg: f64,
    /// Pieces that are no Delaunay edges.
    pub forced_pieces: usize,
    /// ∫_Ω dA / f², and its estimated relative error.
    pub integral: f64,
    /// Estimated relative error of `integral`.
    pub integral_error: f64,
    /// ∫_Ω dA / lfs².
    pub integral_lfs: f64,
    /// triangles / integral.
    pub size_ratio: f64,
    /// triangles / integral_lfs.
    pub size_ratio_lfs: f64,
    /// triangles · (√3 / 4) c_b² / integral.
    pub size_efficiency: f64,
    /// asin(1/2 − t_effective) in degrees, 0 for t ≥ 1/2: Theorem 6.8.
    pub min_angle_bound_deg: f64,
    /// A hash of the mesh's points and triangles, bit by bit: equal meshes have equal fingerprints.
    pub fingerprint: String,
    /// Counts and angles.
    #[serde(flatten)]
    pub statistics: Statistics,
    /// Time and memory, of a mesh that was made alone.
    #[serde(flatten)]
    pub times: Option<Times>,
    /// Of a mesher outside this crate: what it told of its run. `times` are its own then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outside: Option<Outside>,
    /// What came of the Poisson problem that the cell asks for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poisson: Option<Solution>,
    /// Why nothing came of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poisson_failed: Option<String>,
    /// The rounds of adaptation before this mesh, where the cell asks for adaptation.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rounds: Vec<Round>,
    /// Counts the mesher reports of itself, such as bites.
    pub counts: BTreeMap<String, f64>,
    /// The certificate.
    pub certificate: Certificate,
    /// What made it; of a report from tables, their run file says that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub provenance: Option<Provenance>,
}

/// What a mesher outside this crate told of its run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outside {
    /// Of the program or library that made the mesh.
    pub version: String,
    /// Seconds before meshing, by name: imports, reading, setting up the size function. Of a cell that ran alone.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub set_up_seconds: BTreeMap<String, f64>,
    /// Whether a repeat made another mesh: such a mesher does not answer equal input by equal output.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub repeats_differ: bool,
}

/// How a cell of an experiment ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Measured; the report is there.
    Measured,
    /// The estimate was above the cell budget, or a mesher outside this crate is not installed.
    Skipped,
    /// The mesher declined, or stopped at a budget.
    Declined,
    /// It failed, or made a mesh that breaks a guaranteed check of structure; then the report is there.
    Failed,
}

/// One cell of an experiment: a line of the journal, and of `meshes.csv`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Identifies the cell: a resumed run skips cells whose key has a row.
    pub key: String,
    /// Which group of cells of the plan it belongs to: `grid`, `orders`, `time`, …
    pub group: String,
    /// How it ended.
    pub outcome: Outcome,
    /// Why it did not end measured.
    pub reason: Option<String>,
    /// Triangles expected before the run, from ∫ dA / f².
    pub estimated_triangles: f64,
    /// Domain, mesher, parameters, spacing, t, c_b as asked for, also where there is no report.
    pub cell: Cell,
    /// Where a number of triangles was asked for: every c_b tried, in order. The report is of the one that came nearest, and
    /// says its c_b, its t (the spacing being what it was) and its triangles, also where that is not near.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tries: Vec<Try>,
    /// All about the mesh.
    pub report: Option<Report>,
}

/// A try at a number of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Try {
    /// Biting constant.
    pub c_b: f64,
    /// Triangles it gave; absent where there was no mesh.
    pub triangles: Option<u64>,
}

/// What a cell asks for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Gallery name or file.
    pub domain: String,
    /// Name in `MESHERS` or `PEERS`.
    pub mesher: String,
    /// Parameters that differ from the defaults.
    pub params: serde_json::Map<String, serde_json::Value>,
    /// Spacing before cap and limiting.
    pub spacing: String,
    /// Nominal t.
    pub t: f64,
    /// Biting constant; where `triangles` is there, that from which it is scaled.
    pub c_b: f64,
    /// Seed.
    pub seed: u64,
    /// Whether the spacing is capped by lfs.
    pub lfs_cap: bool,
    /// Triangles the mesh shall have: c_b is scaled until it has, the spacing staying as it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub triangles: Option<u64>,
    /// Threads the mesher may use.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub threads: usize,
    /// A Poisson problem to solve on the mesh: a name in [`crate::suite::fem::PROBLEMS`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poisson: Option<String>,
    /// What adaptation shall make of the spacing before the mesh that is reported.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adapt: Option<Adapt>,
    /// Whether it runs alone and repeated.
    pub timed: bool,
}

/// A parameter's value as the command line takes it.
pub fn parameter_text(value: &serde_json::Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// Quoted where a shell would take it for more than a word.
pub(crate) fn quoted(text: &str) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || "-_.,:=/".contains(c);
    if text.chars().all(is_word) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}

fn one() -> usize {
    1
}

// A reference, since serde hands one over.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_one(threads: &usize) -> bool {
    *threads == 1
}

impl Row {
    /// How often its cell ran alone.
    pub fn repeats(&self) -> usize {
        let times = self.report.as_ref().and_then(|report| report.times.as_ref());
        times.map_or(0, |times| times.samples.len())
    }
}

impl Cell {
    /// A mesher with its defaults on a domain: f capped by lfs, seed 0, one thread, not timed.
    pub fn new(domain: &str, mesher: &str, spacing: &str, t: f64, c_b: f64) -> Self {
        Self {
            domain: domain.into(),
            mesher: mesher.into(),
            params: serde_json::Map::new(),
            spacing: spacing.into(),
            t,
            c_b,
            seed: 0,
            lfs_cap: true,
            triangles: None,
            threads: 1,
            poisson: None,
            adapt: None,
            timed: false,
        }
    }

    /// All parameters of its mesher: those it names, and the defaults of the rest.
    pub fn complete(&self) -> Parameters {
        AnyEntry::find(&self.mesher).map_or_else(|| self.params.clone(), |entry| entry.complete(&self.params))
    }

    /// The same with these parameters, written as on the command line.
    pub fn with(mut self, params: &[(&str, &str)]) -> Self {
        let params = params.iter();
        self.params
            .extend(params.map(|(name, value)| ((*name).to_owned(), parameter_value(value))));
        self
    }

    /// Spacing, t, c_b, seed, parameters and cap as the command line takes them, each with a blank before it.
    pub fn options(&self) -> String {
        let params = self.params.iter();
        let params =
            params.map(|(name, value)| format!(" --param {}", quoted(&format!("{name}={}", parameter_text(value)))));
        format!(
            " --spacing {} --t {} --c-b {} --seed {}{}{}",
            quoted(&self.spacing),
            self.t,
            self.c_b,
            self.seed,
            params.collect::<String>(),
            if self.lfs_cap { "" } else { " --no-lfs-cap" }
        )
    }

    /// Where the spacing is adapted, all that it then depends on.
    pub fn adapted_by(&self) -> Option<String> {
        let adapt = self.adapt?;
        let numbers = [adapt.eps, self.t, self.c_b];
        let params: Vec<String> = self
            .params
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        let (rounds, sample) = (adapt.rounds, adapt.sample);
        Some(format!(
            "{numbers:?} {rounds} {sample} {:?} {} {} {}",
            self.poisson,
            self.mesher,
            params.join(" "),
            self.seed
        ))
    }

    /// The cell with another c_b for the same spacing: α = t / c_b stays.
    pub fn scaled_to(&self, c_b: f64) -> Self {
        Self {
            t: self.t * (c_b / self.c_b),
            c_b,
            ..self.clone()
        }
    }
}
