//! Speed by number of threads, of the methods that were run with several.

use super::markdown::{table, value};
use crate::suite::analysis::contest::{Method, doubt};
use crate::suite::analysis::measures::{SPEED, TRIANGLES};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::rows::record::{Report, Row};
use crate::suite::rows::times::Times;
use crate::suite::run::plan::Section;

/// Speed by number of threads, of the methods that were run with several.
pub(super) fn text(results: &Results) -> String {
    let own = results.of(Section::Threads);
    let line = |row: &&Row| {
        vec![
            Method::of(row).label,
            row.cell.threads.to_string(),
            value(&TRIANGLES, measured(row).and_then(TRIANGLES.value)),
            measured(row).map_or_else(|| "–".to_owned(), speed),
            measured(row).map_or_else(|| "–".to_owned(), range_of),
        ]
    };
    let lines: Vec<Vec<String>> = own.iter().map(line).collect();
    let speed = SPEED.label();
    let head = ["mesher", "threads", "triangles", speed.as_str(), "spread of repeats"];
    table(&head, &lines)
}

/// Speed, or why there is none to quote.
pub(super) fn speed(report: &Report) -> String {
    match (SPEED.value)(report) {
        None => doubt([report]).to_owned(),
        speed => value(&SPEED, speed),
    }
}

/// From the fastest repeat to the slowest, over their median, in percent.
pub(super) fn range_of(report: &Report) -> String {
    let spread = report.times.as_ref().and_then(Times::spread);
    spread.map_or_else(|| "–".to_owned(), |spread| format!("{:.0} %", 100.0 * spread))
}
