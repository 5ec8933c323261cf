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

/// Whether advancing front loses quality where fronts meet, in a line for each of its methods that are at their defaults.
pub(super) fn findings(results: &Results) -> Vec<String> {
    finding(results).into_iter().collect()
}

fn finding(results: &Results) -> Option<String> {
    let found = met(results);
    let first = found.iter().find(|met| met.method.is_default).or(found.first())?;
    let verdict = if is_lost(first) { "holds" } else { "does not hold" };
    Some(format!(
        "**The paper's remark that an advancing front loses quality where fronts meet {verdict}** for {}: triangles there \
         ({} of all, in {} of {} meshes) have a mean smallest angle of {} against {} elsewhere, smaller in {} of {} meshes; \
         5th percentile {} against {}, under 30° {} against {} (medians over meshes).",
        first.method.label,
        percent(first.share),
        first.meshes[0],
        first.meshes[1],
        degrees(first.met.mean_deg),
        degrees(first.elsewhere.mean_deg),
        first.worse,
        first.meshes[0],
        degrees(first.met.p05_deg),
        degrees(first.elsewhere.p05_deg),
        percent(first.met.share_under_30),
        percent(first.elsewhere.share_under_30)
    ))
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
