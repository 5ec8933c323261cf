//! Speed by number of threads, of the methods that were run with several.

use super::markdown::{number, table};
use crate::suite::analysis::contest::Method;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::rows::numbers::quantile;
use crate::suite::rows::record::{Report, Row};
use crate::suite::run::plan::Section;

/// Speed by number of threads, of the methods that were run with several.
pub(super) fn text(results: &Results) -> String {
    let own = results.of(Section::Threads);
    let line = |row: &&Row| {
        vec![
            Method::of(row).label,
            row.cell.threads.to_string(),
            measured(row).map_or_else(|| "–".to_owned(), |report| report.statistics.triangles.to_string()),
            number(measured(row).and_then(speed)),
            range_of(&row.samples),
        ]
    };
    let lines: Vec<Vec<String>> = own.iter().map(line).collect();
    let head = ["mesher", "threads", "triangles", "10⁶ triangles/s", "range of repeats"];
    table(&head, &lines)
}

/// Millions of triangles a second.
pub(super) fn speed(report: &Report) -> Option<f64> {
    let seconds = report.seconds.total;
    (seconds > 0.0).then(|| 1e-6 * report.statistics.triangles as f64 / seconds)
}

/// From the fastest repeat to the slowest, over their median, in percent.
pub(super) fn range_of(samples: &[f64]) -> String {
    let ends = [0.0, 0.5, 1.0].map(|share| quantile(samples.to_vec(), share));
    match ends {
        [Some(least), Some(middle), Some(most)] if samples.len() > 1 && middle > 0.0 => {
            let percent = |value: f64| format!("{:+.0}", 100.0 * (value / middle - 1.0));
            format!("{} to {} %", percent(least), percent(most))
        }
        _ => "–".to_owned(),
    }
}
