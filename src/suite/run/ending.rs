//! How a unit of work ended, and what of it goes into a row.

use crate::suite::rows::numbers::median;
use crate::suite::rows::record::{Outcome, Report, Row, Try};
use crate::suite::run::measure::Run;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How a unit ended.
pub(super) struct Ending {
    pub(super) outcome: Outcome,
    pub(super) reason: Option<String>,
    pub(super) estimated_triangles: f64,
    pub(super) samples: Vec<f64>,
    pub(super) tries: Vec<Try>,
    pub(super) report: Option<Report>,
}

impl Ending {
    pub(super) fn without_report(outcome: Outcome, reason: String, estimated_triangles: f64) -> Self {
        Self {
            outcome,
            reason: Some(reason),
            estimated_triangles,
            samples: Vec::new(),
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
        samples: Vec::new(),
        report: None,
        ..row
    }
}

/// What a row can do without: where a check that nobody guarantees was broken, besides the worst place. The mesh can be
/// made again from its row, and has them all.
pub(super) fn slim(report: &mut Report) {
    let checks = report.certificate.checks.iter_mut();
    checks
        .filter(|check| !check.applies)
        .for_each(|check| check.witnesses.clear());
}

/// The report's times become those of the run nearest to the median of `samples`, its total the median itself.
pub(super) fn take_median(report: &mut Report, run: Run, samples: &[f64]) {
    let Some(median) = median(samples.to_vec()) else {
        return;
    };
    if (run.seconds.total - median).abs() < (report.seconds.total - median).abs() {
        report.seconds.steps = run.seconds.steps;
    }
    report.seconds.total = median;
}

/// A panic in one cell is that cell's failure, and no reason to lose the others.
pub(super) fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        format!("panicked: {}", text.unwrap_or_else(|| "no message".into()))
    })
}
