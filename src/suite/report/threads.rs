//! Speed by number of threads, of the methods that were run with several.

use super::markdown::{table, value};
use crate::suite::analysis::contest::Method;
use crate::suite::analysis::measures::{SPEED, TRIANGLES};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::rows::numbers::quantile;
use crate::suite::rows::record::Row;
use crate::suite::run::plan::Section;

/// Speed by number of threads, of the methods that were run with several.
pub(super) fn text(results: &Results) -> String {
    let own = results.of(Section::Threads);
    let line = |row: &&Row| {
        vec![
            Method::of(row).label,
            row.cell.threads.to_string(),
            value(&TRIANGLES, measured(row).and_then(TRIANGLES.value)),
            value(&SPEED, measured(row).and_then(SPEED.value)),
            range_of(&row.samples),
        ]
    };
    let lines: Vec<Vec<String>> = own.iter().map(line).collect();
    let speed = SPEED.label();
    let head = ["mesher", "threads", "triangles", speed.as_str(), "range of repeats"];
    table(&head, &lines)
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
