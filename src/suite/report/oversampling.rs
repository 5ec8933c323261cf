//! The paper's remark that independent sets of oversampled points cost more than biting, answered in numbers.

use super::drawer::Drawer;
use super::markdown::{number, percent, range, table};
use crate::suite::analysis::remarks::{Sampling, samplings};
use crate::suite::analysis::results::Results;
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::spread;
use crate::suite::run::plan::Section;

/// What each density of samples gave.
fn sampled(results: &Results) -> Vec<Sampling> {
    samplings(&results.at_equal_size(Section::Oversampling), &results.about)
}

/// Whether independent sets of oversampled points cost more.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let seconds: Vec<f64> = sampled(results).iter().filter_map(|one| one.seconds).collect();
    let (dearer, of) = (seconds.iter().filter(|ratio| **ratio > 1.0).count(), seconds.len());
    let verdict = match dearer {
        0 => "does not hold",
        some if some == of => "holds",
        _ => "holds in part",
    };
    let finding = spread(seconds).map(|times| {
        format!(
            "The paper's remark that oversampling costs more {verdict}: {dearer} of {of} densities take longer than {}, {} times the \
             seconds.",
            results.about,
            range(&times)
        )
    });
    finding.into_iter().collect()
}

/// A line for each density.
pub(super) fn text(results: &Results) -> String {
    let sampled = sampled(results);
    if sampled.is_empty() {
        return String::new();
    }
    let line = |one: &Sampling| {
        vec![
            one.method.label.clone(),
            format!("{} of {}", one.tasks[0], one.tasks[1]),
            number(one.beta),
            percent(one.gap_share),
            number(one.triangles),
            number(one.seconds),
            number(one.seconds_per_triangle),
        ]
    };
    let head = [
        "mesher",
        "tasks all measured",
        "β",
        "circles at a gap",
        "triangles over biting's",
        "seconds over biting's",
        "seconds per triangle over biting's",
    ];
    table(&head, &sampled.iter().map(line).collect::<Vec<_>>())
}

/// Gaps, triangles and time against the density.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let sampled = sampled(results);
    if sampled.len() < 2 {
        return Ok(());
    }
    let caption = "What the density of samples does to an independent set, beside biting on the same tasks.";
    charts::oversampling(&sampled, &drawer.chart("oversampling", caption))
}
