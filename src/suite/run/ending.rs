//! How a unit of work ended, and what of it goes into a row.

use crate::suite::rows::numbers::median;
use crate::suite::rows::record::{Outcome, Report, Row, Try};
use crate::suite::rows::times::Times;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How a unit ended.
pub(super) struct Ending {
    pub(super) outcome: Outcome,
    pub(super) reason: Option<String>,
    pub(super) estimated_triangles: f64,
    pub(super) tries: Vec<Try>,
    pub(super) report: Option<Report>,
}

impl Ending {
    pub(super) fn without_report(outcome: Outcome, reason: String, estimated_triangles: f64) -> Self {
        Self {
            outcome,
            reason: Some(reason),
            estimated_triangles,
            tries: Vec::new(),
            report: None,
        }
    }

    /// Skipped, since more triangles are expected than the budget allows.
    pub(super) fn too_large(estimated: f64, limit: f64) -> Self {
        let reason = format!("about {estimated:.0} triangles expected, above the cell's budget of {limit:.0}");
        Self::without_report(Outcome::Skipped, reason, estimated)
    }
}

/// JSON has no numbers that are not finite: the cell failed, and the row says so.
pub(super) fn unwritable(row: Row, error: &str) -> Row {
    let reason = format!("its report cannot be written ({error}): a number in it is not finite");
    Row {
        outcome: Outcome::Failed,
        reason: Some(reason),
        estimated_triangles: if row.estimated_triangles.is_finite() {
            row.estimated_triangles
        } else {
            f64::MAX
        },
        report: None,
        ..row
    }
}

/// What a row can do without: where a check that nobody guarantees was broken, besides the worst place, for the mesh can be
/// made again from its row and has them all; and how long a mesh took that was made beside others.
pub(super) fn slim(report: &mut Report, is_timed: bool) {
    let checks = report.certificate.checks.iter_mut();
    checks
        .filter(|check| !check.applies)
        .for_each(|check| check.witnesses.clear());
    if !is_timed {
        report.times = None;
        report.outside.iter_mut().for_each(|told| told.set_up_seconds.clear());
    }
}

/// The times become those of the run nearest to the median of all repeats, the last of which is `run`; their total is the median
/// itself.
pub(super) fn add_repeat(times: &mut Times, run: Times) {
    times.samples.push(run.seconds.total);
    let Some(median) = median(times.samples.clone()) else {
        return;
    };
    if (run.seconds.total - median).abs() < (times.seconds.total - median).abs() {
        times.seconds.steps = run.seconds.steps;
    }
    times.seconds.total = median;
}

/// A panic in one cell is that cell's failure, and no reason to lose the others.
pub(super) fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        format!("panicked: {}", text.unwrap_or_else(|| "no message".into()))
    })
}
