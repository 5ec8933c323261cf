//! One case run and judged.

use super::family::Case;
use crate::domain::gallery;
use crate::experiment::ending::guarded;
use crate::experiment::measure;
use crate::experiment::prepare::{PrepareError, Prepared, Store};
use crate::experiment::runner::{self, VERTICES_PER_BUDGET_TRIANGLE};
use crate::meshers::{Budget, MeshError, Request};
use crate::quality::{self, Check};
use crate::spacing::estimate_triangles;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// There is a mesh, and every guaranteed check of its certificate holds.
    Certified,
    /// A typed error says why there is none, though the domain is valid.
    Declined,
    /// A budget ended it, or it was expected to need more than the budget has.
    Stopped,
    /// The domain is no valid PSLG, and was refused with the reason.
    Refused,
    /// It panicked, or ended its process.
    Panicked,
    /// It was not done long after its time budget.
    Hung,
    /// A guaranteed check of the certificate fails.
    Invalid,
}

/// A case that was run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// How it ended.
    pub verdict: Verdict,
    /// Why it is not certified.
    pub reason: Option<String>,
    /// Triangles of the mesh; 0 where there is none.
    pub triangles: usize,
    /// Of the mesh; empty where there is none.
    pub fingerprint: String,
    /// Random domains that were thrown away before this one, since they were no valid PSLG.
    pub discarded: usize,
    /// From the domain's name to the verdict.
    pub seconds: f64,
}

impl Trial {
    /// A case that has no mesh.
    pub fn without_mesh(verdict: Verdict, reason: String) -> Self {
        Self {
            verdict,
            reason: Some(reason),
            triangles: 0,
            fingerprint: String::new(),
            discarded: 0,
            seconds: 0.0,
        }
    }
}

/// Runs a case as `biting mesh` would, and judges its mesh.
pub fn run(case: &Case) -> Trial {
    let start = Instant::now();
    let ended = guarded(|| attempt(case));
    let trial = match ended {
        Ok(Ok(trial)) => trial,
        Ok(Err((verdict, reason))) => Trial::without_mesh(verdict, reason),
        Err(panic) => Trial::without_mesh(Verdict::Panicked, panic),
    };
    Trial {
        seconds: start.elapsed().as_secs_f64(),
        discarded: guarded(|| gallery::discarded(&case.cell.domain)).unwrap_or(0),
        ..trial
    }
}

fn attempt(case: &Case) -> Result<Trial, (Verdict, String)> {
    let cell = &case.cell;
    let prepared = Store::new(None, false)
        .prepare_for_t(cell)
        .map_err(|error| match error {
            PrepareError::Domain(_) => (Verdict::Refused, error.to_string()),
            PrepareError::Spacing { .. } => (Verdict::Declined, error.to_string()),
        })?;
    let (expected, most) = (
        estimate_triangles(prepared.integral.value, cell.c_b),
        case.budget.triangles,
    );
    if expected > most {
        let reason = format!("about {expected:.0} triangles expected, above the budget of {most}");
        return Err((Verdict::Stopped, reason));
    }
    let declined = |reason| (Verdict::Declined, reason);
    let (entry, mesher) = runner::mesher(cell).map_err(declined)?;
    let request = Request {
        c_b: cell.c_b,
        seed: cell.seed,
        threads: 1,
        budget: Budget {
            max_vertices: Some((VERTICES_PER_BUDGET_TRIANGLE * most) as usize),
            max_seconds: Some(case.budget.seconds),
            max_memory: None,
        },
    };
    let run = measure::run(&prepared, &*mesher, &request).map_err(|error| match error {
        MeshError::Budget { .. } => (Verdict::Stopped, error.to_string()),
        _ => declined(error.to_string()),
    })?;
    let guaranteed = entry.guaranteed(&cell.params, &prepared.site.domain, &*prepared.spacing, cell.c_b);
    let broken = broken(&prepared, case, &guaranteed, &run.mesh);
    Ok(Trial {
        verdict: if broken.is_none() {
            Verdict::Certified
        } else {
            Verdict::Invalid
        },
        reason: broken,
        triangles: run.mesh.triangles.len(),
        fingerprint: measure::fingerprint(&run.mesh),
        discarded: 0,
        seconds: 0.0,
    })
}

/// The guaranteed checks that a mesh breaks, in words.
fn broken(prepared: &Prepared, case: &Case, guaranteed: &[&str], mesh: &crate::mesh::Mesh) -> Option<String> {
    let bounds = prepared.bounds(case.cell.c_b, guaranteed);
    let (_, certificate) = quality::judge(&prepared.site.domain, mesh, Some(&bounds));
    let told = |check: &Check| {
        let number = |value: Option<f64>| value.map_or_else(|| "nothing".into(), |value| value.to_string());
        let place = check.at.map_or_else(String::new, |[x, y]| format!(" at ({x}, {y})"));
        let (worst, bound) = (number(check.worst), number(check.bound));
        format!("{}: {worst} where {bound} is the bound{place}", check.claim)
    };
    let checks = certificate.checks.iter().filter(|check| check.applies && !check.holds);
    let broken: Vec<String> = checks.map(told).collect();
    (!broken.is_empty()).then(|| broken.join("; "))
}
