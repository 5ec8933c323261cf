//! Task by task: every method on each.

use super::markdown::{degrees, number, table};
use super::threads::{range_of, speed};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::results::Results;
use crate::suite::rows::record::{Outcome, Row};
use crate::suite::run::plan::Section;

/// A table for each task.
pub(super) fn text(results: &Results) -> String {
    let contests = [
        ("equal edge length", results.at_equal_size(Section::Tasks)),
        ("equal triangle count", results.at_equal_count(Section::Tasks)),
    ];
    let tasks = contests
        .iter()
        .flat_map(|(title, contest)| (0..contest.tasks.len()).map(move |task| task_table(contest, task, title)));
    tasks.collect()
}

/// Every method on one task.
fn task_table(contest: &Contest, task: usize, title: &str) -> String {
    let asked = &contest.tasks[task];
    let wanted = asked.triangles.map_or_else(String::new, |count| format!(" of {count}"));
    let samples = contest.all().into_iter().filter_map(|method| contest.row(method, task));
    let once = match samples.map(|row| row.samples.len()).max() {
        Some(1) => ", once",
        _ => "",
    };
    let line = |method: usize| Some((contest.row(method, task)?, &contest.methods[method].label));
    let lines: Vec<Vec<String>> = contest
        .all()
        .into_iter()
        .filter_map(line)
        .map(|(row, label)| task_line(row, label))
        .collect();
    let head = [
        "mesher",
        "triangles",
        "/∫dA/f²",
        "edge/s 5, 50, 95 %",
        "smallest",
        "mean",
        "5th percentile",
        "under 20°",
        "under 30°",
        "10⁶ triangles/s",
        "range of repeats",
        "peak MB (before)",
        "",
    ];
    format!(
        "### {}, `{}`, at {title}{wanted}{once}\n\n",
        asked.domain, asked.spacing
    ) + &table(&head, &lines)
}

/// How a row ended and why, the reason once.
fn told(how: &str, row: &Row) -> String {
    let reason = row.reason.as_deref().unwrap_or_default();
    let reason = reason
        .strip_prefix(how)
        .and_then(|rest| rest.strip_prefix(": "))
        .unwrap_or(reason);
    format!("{how}: {reason}")
}

/// A line of a task's table: also of a mesh that does not conform, with what it breaks.
fn task_line(row: &Row, label: &str) -> Vec<String> {
    let reason = match row.outcome {
        Outcome::Measured => String::new(),
        Outcome::Skipped => told("skipped", row),
        Outcome::Declined => told("declined", row),
        Outcome::Failed => told("failed", row),
    };
    let Some(report) = &row.report else {
        let blank = std::iter::repeat_n("–".to_owned(), 11);
        return std::iter::once(label.to_owned()).chain(blank).chain([reason]).collect();
    };
    let statistics = &report.statistics;
    let percent = |degrees: usize| format!("{} %", number(100.0 * statistics.share_under(degrees)));
    let edges = statistics.edge_over_size.as_ref();
    let edges = edges.map_or_else(
        || "–".to_owned(),
        |edge| [edge.p05, edge.p50, edge.p95].map(number).join(", "),
    );
    let megabytes = |bytes: u64| number(bytes as f64 / 1e6);
    vec![
        label.to_owned(),
        statistics.triangles.to_string(),
        number(report.size_ratio),
        edges,
        degrees(statistics.min_angle_free_deg),
        degrees(statistics.mean_min_angle_deg),
        degrees(statistics.p05_min_angle_deg),
        percent(20),
        percent(30),
        number(speed(report)),
        range_of(&row.samples),
        format!(
            "{} ({})",
            megabytes(report.peak_rss_bytes),
            megabytes(report.rss_before_bytes)
        ),
        reason,
    ]
}
