//! One case run and judged.

use crate::domain::{self, gallery};
use crate::meshers::{Budget, Request};
use crate::quality::{Certificate, Check};
use crate::spacing::{SpacingError, estimate_triangles};
use crate::suite::rows::tally::Verdict;
use crate::suite::run::ending::guarded;
use crate::suite::run::measure;
use crate::suite::run::prepare::fill_in;
use crate::suite::run::runner::{self, VERTICES_PER_BUDGET_TRIANGLE};
use crate::suite::run::tally::family::Trial;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Relative error asked of the integral that bounds the number of vertices, and foretells that of triangles.
const INTEGRAL_ERROR: f64 = 0.02;

/// Memory a worker may use, bytes; above it a mesher is stopped.
const MOST_MEMORY: u64 = 3_000_000_000;

/// A case that was run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
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

impl Tried {
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
pub fn run(trial: &Trial) -> Tried {
    let start = Instant::now();
    let ended = guarded(|| attempt(trial));
    let tried = match ended {
        Ok(Ok(tried)) => tried,
        Ok(Err((verdict, reason))) => Tried::without_mesh(verdict, reason),
        Err(panic) => Tried::without_mesh(Verdict::Panicked, panic),
    };
    Tried {
        seconds: start.elapsed().as_secs_f64(),
        discarded: guarded(|| gallery::discarded(&trial.cell.domain)).unwrap_or(0),
        ..tried
    }
}

/// Why there is no mesh.
type NoMesh = (Verdict, String);

fn attempt(trial: &Trial) -> Result<Tried, NoMesh> {
    let cell = &trial.cell;
    let case = prepared(trial)?;
    let most = trial.budget.triangles;
    let expected = case
        .integral
        .map_or(0.0, |integral| estimate_triangles(integral.value, cell.c_b));
    if expected > most {
        let reason = format!("about {expected:.0} triangles expected, above the budget of {most}");
        return Err((Verdict::Stopped, reason));
    }
    let declined = |reason| (Verdict::Declined, reason);
    let mesher = runner::mesher(cell).map_err(declined)?;
    let request = Request {
        seed: cell.seed,
        budget: Budget {
            max_vertices: Some((VERTICES_PER_BUDGET_TRIANGLE * most) as usize),
            max_seconds: Some(trial.budget.seconds),
            max_memory: Some(MOST_MEMORY),
        },
        ..case.request()
    };
    let made = mesher.mesh(&case.domain, &*case.spacing.function, &request);
    let mesh = made.map_err(|error| match error {
        _ if error.is_budget() => (Verdict::Stopped, error.to_string()),
        _ => declined(error.to_string()),
    })?;
    let broken = broken(&mesher.judge(&case, &mesh).1);
    Ok(Tried {
        verdict: if broken.is_none() {
            Verdict::Certified
        } else {
            Verdict::Invalid
        },
        reason: broken,
        triangles: mesh.triangles.len(),
        fingerprint: measure::fingerprint(&mesh),
        discarded: 0,
        seconds: 0.0,
    })
}

/// Domain and spacing, as for the cells of a sweep; its integral where asked for, to fewer digits.
fn prepared(trial: &Trial) -> Result<crate::Case, NoMesh> {
    let cell = &trial.cell;
    let domain = domain::load(&cell.domain).map_err(|error| (Verdict::Refused, error.to_string()))?;
    let declined = |error: SpacingError| (Verdict::Declined, error.to_string());
    let spec = fill_in(&cell.spacing, &domain);
    let case = crate::Case::new(domain, &spec, cell.t, cell.c_b).map_err(declined)?;
    match trial.integral {
        true => case.integrated(INTEGRAL_ERROR).map_err(declined),
        false => Ok(case),
    }
}

/// The guaranteed checks that a mesh breaks, in words.
fn broken(certificate: &Certificate) -> Option<String> {
    let told = |check: &Check| {
        let number = |value: Option<f64>| value.map_or_else(|| "nothing".into(), |value| value.to_string());
        let place = check.at.map_or_else(String::new, |[x, y]| format!(" at ({x}, {y})"));
        let (worst, bound) = (number(check.worst), number(check.bound));
        format!("{}: {worst} where {bound} is the bound{place}", check.claim)
    };
    let broken: Vec<String> = certificate.broken().map(told).collect();
    (!broken.is_empty()).then(|| broken.join("; "))
}
