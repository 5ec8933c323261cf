//! The paper's remark that independent sets of oversampled points cost more than biting, answered in numbers.

use super::drawer::Drawer;
use super::markdown::{number, percent, table};
use crate::suite::analysis::remarks::{Sampling, samplings};
use crate::suite::analysis::results::Results;
use crate::suite::charts::{self, ChartError};
use crate::suite::run::plan::Section;

/// What each density of samples gave.
fn sampled(results: &Results) -> Vec<Sampling> {
    samplings(&results.at_equal_size(Section::Oversampling), &results.about)
}

/// Whether independent sets of oversampled points cost more than biting.
pub(super) fn findings(results: &Results) -> Vec<String> {
    finding(results).into_iter().collect()
}

fn finding(results: &Results) -> Option<String> {
    let found = sampled(results);
    let dearer = found
        .iter()
        .filter(|one| one.seconds.is_some_and(|ratio| ratio > 1.0))
        .count();
    let verdict = match dearer {
        0 => "does not hold",
        some if some == found.len() => "holds",
        _ => "holds in part",
    };
    let told: Vec<String> = found
        .iter()
        .map(|one| {
            let end = if one.is_complete {
                "until no gap is left"
            } else {
                "once"
            };
            format!(
                "{} points a side sampled {end} take {} times the seconds, leave {} of circles at a gap and β = {}",
                number(one.points),
                number(one.seconds),
                percent(one.gap_share),
                number(one.beta)
            )
        })
        .collect();
    let ends = [told.first()?, told.last()?];
    let ends = if told.len() > 1 {
        ends.to_vec()
    } else {
        ends[..1].to_vec()
    };
    Some(format!(
        "**The paper's remark that independent sets of oversampled points cost more {verdict}**: {} of {} densities take longer \
         than {} on the same tasks; {}.",
        dearer,
        found.len(),
        results.about,
        ends.into_iter().cloned().collect::<Vec<_>>().join("; ")
    ))
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
