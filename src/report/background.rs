//! What a background saves and costs: meshes whose spacing is evaluated on one, beside those of the spacing itself.

use super::findings::spread;
use super::markdown::number;
use crate::experiment::record::{Cell, Report, Row};
use crate::experiment::summary::measured;

/// The line over all cells that differ in the background alone.
pub(super) fn background_findings(rows: &[Row]) -> Vec<String> {
    let plain = |cell: &Cell| Cell {
        background: None,
        ..cell.clone()
    };
    let mut errors = Vec::new();
    let mut pairs: Vec<[&Report; 2]> = Vec::new();
    for row in rows {
        let Some(error) = row.cell.background else { continue };
        let is_its = |other: &&Row| other.cell == plain(&row.cell);
        let exact = rows.iter().find(is_its).and_then(measured);
        if let Some(pair) = exact.zip(measured(row)) {
            pairs.push([pair.0, pair.1]);
            errors.push(error);
        }
    }
    let ratios = |value: fn(&Report) -> f64| spread(pairs.iter().map(|two| value(two[1]) / value(two[0])).collect());
    let triangles = ratios(|report| report.statistics.triangles as f64);
    let seconds = ratios(|report| report.seconds.total);
    let Some((triangles, seconds)) = triangles.zip(seconds) else {
        return Vec::new();
    };
    let largest = errors.iter().copied().fold(0.0, f64::max);
    let kept = pairs
        .iter()
        .filter(|two| two[0].certificate.holds == two[1].certificate.holds)
        .count();
    vec![format!(
        "**A background of error {} beside the spacing itself**, on {} pairs: {} times the triangles in the median, from {} to {}; the \
         mesher's seconds {} times, from {} to {}; {} of the pairs have the same verdict of the certificate.",
        number(largest),
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
    )]
}
