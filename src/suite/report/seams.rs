//! The paper's remark that an advancing front loses quality where fronts meet, answered in numbers.

use super::drawer::Drawer;
use super::markdown::{degrees, parameter, percent, table};
use crate::suite::analysis::remarks::{Met, meetings};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::record::Row;
use crate::suite::run::plan::Section;

/// What meshes say of the places where fronts met, at equal edge length, so that all methods have the same tasks.
fn met(results: &Results) -> Vec<Met> {
    let contest = results.at_equal_size(Section::Seams);
    meetings(contest.all().into_iter().flat_map(|k| contest.rows(k)))
}

/// Whether quality is lost where fronts meet: in most meshes, and in the median.
fn is_lost(met: &Met) -> bool {
    2 * met.worse > met.meshes[0] && met.met.mean_deg < met.elsewhere.mean_deg
}

/// Whether quality is lost where fronts meet, of the first method that marks such places by its defaults.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let found = met(results);
    let first = found.iter().find(|met| met.method.is_default).or(found.first());
    let finding = first.map(|met| {
        let verdict = if is_lost(met) { "holds" } else { "does not hold" };
        format!(
            "The paper's remark that quality is lost where fronts meet {verdict} for {}: mean smallest angle {} there, {} elsewhere, \
             smaller in {} of {} meshes.",
            met.method.label,
            degrees(met.met.mean_deg),
            degrees(met.elsewhere.mean_deg),
            met.worse,
            met.meshes[0]
        )
    });
    finding.into_iter().collect()
}

/// A line for each method that marks where fronts met.
pub(super) fn text(results: &Results) -> String {
    let found = met(results);
    if found.is_empty() {
        return String::new();
    }
    let line = |one: &Met| {
        let two = |value: fn(&crate::quality::Angles) -> String| [value(&one.met), value(&one.elsewhere)];
        let mut cells = vec![
            one.method.label.clone(),
            format!("{} of {}", one.meshes[0], one.meshes[1]),
            percent(one.share),
            format!("{} of {}", one.worse, one.meshes[0]),
        ];
        cells.extend(two(|angles| degrees(angles.min_deg)));
        cells.extend(two(|angles| degrees(angles.mean_deg)));
        cells.extend(two(|angles| degrees(angles.p05_deg)));
        cells.extend(two(|angles| percent(angles.share_under_30)));
        cells
    };
    let head = [
        "mesher",
        "meshes where fronts met",
        "share of triangles",
        "mean smaller there in",
        "smallest there",
        "elsewhere",
        "mean there",
        "elsewhere",
        "5th percentile there",
        "elsewhere",
        "under 30° there",
        "elsewhere",
    ];
    table(&head, &found.iter().map(line).collect::<Vec<_>>())
}

/// Most meshes in the chart.
const MOST_MEETINGS: usize = 30;

/// Angles where fronts met and elsewhere, mesh by mesh.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let size = results.at_equal_size(Section::Seams);
    let marked = |k: &usize| {
        size.rows(*k)
            .filter_map(measured)
            .any(|report| report.statistics.seams.is_some())
    };
    if let Some(k) = size.all().into_iter().find(marked) {
        let met = |row: &&Row| measured(row).is_some_and(|report| report.statistics.seams.is_some());
        let named = |row: &'_ &Row| {
            let spacing = row.cell.spacing.split(':').next().unwrap_or_default();
            format!(
                "{} {spacing} t={} c_b={}",
                row.cell.domain,
                parameter(row.cell.t),
                parameter(row.cell.c_b)
            )
        };
        let own: Vec<&Row> = size.rows(k).filter(met).collect();
        // A part that spreads over all of them, where they are too many to be told apart.
        let step = own.len().div_ceil(MOST_MEETINGS).max(1);
        let shown: Vec<_> = own.into_iter().step_by(step).map(|row| (row, named(&row))).collect();
        let caption = "Angles where fronts met (hollow) and elsewhere (filled), mesh by mesh.";
        charts::seams(&shown, &drawer.chart("seams", caption))?;
    }
    Ok(())
}
