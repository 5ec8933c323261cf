//! How the time of each step grows with the mesh.

use super::drawer::Drawer;
use super::markdown::{number, table};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::series::{TimeSeries, time_series};
use crate::suite::analysis::summary::measured;
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::{median, quantile};
use crate::suite::rows::record::Report;
use crate::suite::run::plan::Section;

/// How the time of one step grows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Slope {
    pub(super) name: String,
    /// Of log seconds against log triangles.
    pub(super) slope: Option<f64>,
    /// Median over cells.
    pub(super) seconds_per_triangle: Option<f64>,
    /// Fewest and most triangles.
    pub(super) triangles: (f64, f64),
}

/// The whole mesh first, then its steps.
pub(super) fn slopes(results: &Results) -> Vec<Slope> {
    let series = time_series(&results.ours(Section::Time));
    let one = |series: TimeSeries| {
        let triangles: Vec<f64> = series.points.iter().map(|point| point.0).collect();
        let end = |q| quantile(triangles.clone(), q).unwrap_or(0.0);
        Slope {
            slope: series.fit().map(|line| line.slope),
            seconds_per_triangle: median(series.points.iter().map(|point| point.1 / point.0).collect()),
            triangles: (end(0.0), end(1.0)),
            name: series.name,
        }
    };
    series.into_iter().map(one).collect()
}

/// With what power of the triangles the time of the whole grows.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let slopes = slopes(results);
    let finding = slopes.first().and_then(|whole| {
        Some(format!(
            "Time of {} grows with triangles to the power {} from {} to {} triangles; the median is {} µs per triangle.",
            results.about,
            number(whole.slope?),
            number(whole.triangles.0),
            number(whole.triangles.1),
            number(whole.seconds_per_triangle.map(|seconds| 1e6 * seconds))
        ))
    });
    finding.into_iter().collect()
}

/// Slope and time per triangle of each step.
pub(super) fn text(results: &Results) -> String {
    let slopes = slopes(results);
    if slopes.is_empty() {
        return String::new();
    }
    let timed: Vec<&Report> = results.ours(Section::Time).into_iter().filter_map(measured).collect();
    let quiet = timed.iter().filter(|report| report.believable().is_some()).count();
    let spreads = timed.iter().filter_map(|report| report.times.as_ref()?.spread());
    let lines = slopes.iter().map(|step| {
        vec![
            step.name.replace('_', " "),
            number(step.slope),
            number(step.seconds_per_triangle.map(|s| 1e6 * s)),
        ]
    });
    format!(
        "Cells run alone and repeated: {}, of which the {quiet} are shown whose repeats spread by less than 0.1 of their median (in the \
         median cell by {}). Slopes are least-squares lines through the logarithms.\n\n",
        timed.len(),
        number(median(spreads.collect()))
    ) + &table(&["step", "slope", "µs per triangle"], &lines.collect::<Vec<_>>())
}

/// Seconds against triangles, step by step.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let series = time_series(&results.ours(Section::Time));
    if series.is_empty() {
        return Ok(());
    }
    let caption = "Seconds against triangles, whole and by step, with the slopes of fitted lines.";
    charts::time(&series, &drawer.chart("time", caption))
}
