//! Task by task: every method on each.

use super::markdown::{number, table, value};
use super::threads::{range_of, speed};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::measures::{
    EDGES, MEAN_ANGLE, MIN_ANGLE, Measure, P05_ANGLE, SIZE_RATIO, SPEED, TRIANGLES, UNDER_20, UNDER_30,
};
use crate::suite::analysis::results::{Asking, Results};
use crate::suite::rows::record::{Outcome, Report, Row};
use crate::suite::run::plan::Section;

/// The columns that are numbers of a mesh.
const MEASURES: [Measure; 10] = [
    TRIANGLES, SIZE_RATIO, EDGES[0], EDGES[1], EDGES[2], MIN_ANGLE, MEAN_ANGLE, P05_ANGLE, UNDER_20, UNDER_30,
];

/// A table for each task.
pub(super) fn text(results: &Results) -> String {
    let askings = results.askings(Section::Tasks);
    let tables = |Asking { title, contest, .. }: &Asking| -> String {
        (0..contest.tasks.len())
            .map(|task| task_table(contest, task, title))
            .collect()
    };
    askings.iter().map(tables).collect()
}

/// Every method on one task.
fn task_table(contest: &Contest, task: usize, title: &str) -> String {
    let asked = &contest.tasks[task];
    let wanted = asked.triangles.map_or_else(String::new, |count| format!(" of {count}"));
    let samples = contest.all().into_iter().filter_map(|method| contest.row(method, task));
    let once = match samples.map(|row| row.repeats()).max() {
        Some(1) => ", once",
        _ => "",
    };
    let line = |method: usize| Some(task_line(contest.row(method, task)?, &contest.methods[method].label));
    let lines: Vec<Vec<String>> = contest.all().into_iter().filter_map(line).collect();
    let labels = MEASURES.map(|measure| measure.label());
    let mut head = vec!["mesher"];
    head.extend(labels.iter().map(String::as_str));
    let speed = SPEED.label();
    head.extend([speed.as_str(), "spread of repeats", "peak MB (before)", ""]);
    let (domain, spacing) = (&asked.domain, &asked.spacing);
    format!("### {domain}, `{spacing}`, at {title}{wanted}{once}\n\n") + &table(&head, &lines)
}

/// A line of a task's table: also of a mesh that does not conform, with what it breaks.
fn task_line(row: &Row, label: &str) -> Vec<String> {
    let report = row.report.as_ref();
    let mut line = vec![label.to_owned()];
    line.extend(MEASURES.iter().map(|by| value(by, report.and_then(by.value))));
    line.push(report.map_or_else(|| "–".into(), speed));
    line.push(report.map_or_else(|| "–".into(), range_of));
    line.push(report.map_or_else(|| "–".into(), memory));
    line.push(match row.outcome {
        Outcome::Measured => String::new(),
        Outcome::Skipped => ended("skipped", row),
        Outcome::Declined => ended("declined", row),
        Outcome::Failed => ended("failed", row),
    });
    line
}

/// How a row ended and why, the reason once.
fn ended(how: &str, row: &Row) -> String {
    let reason = row.reason.as_deref().unwrap_or_default();
    let reason = reason
        .strip_prefix(how)
        .and_then(|rest| rest.strip_prefix(": "))
        .unwrap_or(reason);
    format!("{how}: {reason}")
}

/// Peak memory, and that before meshing.
fn memory(report: &Report) -> String {
    let megabytes = |bytes: u64| number(bytes as f64 / 1e6);
    report.times.as_ref().map_or_else(
        || "–".to_owned(),
        |times| {
            format!(
                "{} ({})",
                megabytes(times.peak_rss_bytes),
                megabytes(times.rss_before_bytes)
            )
        },
    )
}
