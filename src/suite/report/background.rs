//! What a background saves and costs: meshes whose spacing is evaluated on one, beside those of the spacing itself.

use super::findings::spread;
use super::markdown::number;
use crate::suite::analysis::summary::measured;
use crate::suite::rows::record::{Cell, Report, Row};

/// A line for the largest error beside the spacing itself, and one beside the smallest error there is, over all cells that differ
/// in this alone.
pub(super) fn background_findings(rows: &[Row]) -> Vec<String> {
    let errors = rows.iter().filter_map(|row| row.cell.background);
    let (smallest, largest) = errors.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), error| {
        (low.min(error), high.max(error))
    });
    let finer = (smallest < largest).then_some(Some(smallest));
    let others = [None].into_iter().chain(finer);
    others.filter_map(|other| finding(rows, largest, other)).collect()
}

/// Meshes on a background of that error beside those on another, or of the spacing itself.
fn finding(rows: &[Row], error: f64, other: Option<f64>) -> Option<String> {
    let mut pairs: Vec<[&Report; 2]> = Vec::new();
    for row in rows.iter().filter(|row| row.cell.background == Some(error)) {
        let cell = Cell {
            background: other,
            ..row.cell.clone()
        };
        let beside = rows.iter().find(|row| row.cell == cell).and_then(measured);
        pairs.extend(beside.zip(measured(row)).map(|(beside, report)| [beside, report]));
    }
    let ratios = |value: fn(&Report) -> f64| spread(pairs.iter().map(|two| value(two[1]) / value(two[0])).collect());
    let triangles = ratios(|report| report.statistics.triangles as f64)?;
    let seconds = ratios(|report| report.seconds.total)?;
    let kept = pairs
        .iter()
        .filter(|two| two[0].certificate.holds == two[1].certificate.holds)
        .count();
    Some(format!(
        "**A background of error {} beside {}**, on {} pairs: {} times the triangles in the median, from {} to {}; the \
         mesher's seconds {} times, from {} to {}; {} of the pairs have the same verdict of the certificate.",
        number(error),
        other.map_or("the spacing itself".to_owned(), |other| format!(
            "one of error {}",
            number(other)
        )),
        pairs.len(),
        number(triangles.median),
        number(triangles.least),
        number(triangles.most),
        number(seconds.median),
        number(seconds.least),
        number(seconds.most),
        if kept == pairs.len() {
            "all".to_owned()
        } else {
            kept.to_string()
        }
    ))
}
