//! Angles where fronts met and elsewhere, mesh by mesh.

use super::canvas::{ChartError, write_both};
use super::dots::{Column, Dot, Dots};
use super::legend::Key;
use super::style::{self, Marker};
use crate::quality::Angles;
use crate::suite::analysis::contest::Method;
use crate::suite::analysis::summary::measured;
use crate::suite::rows::record::Row;
use std::path::Path;

/// Draws mean angles where fronts met, hollow, and elsewhere, for each mesh in which they did; the 5th percentile and the
/// share of triangles under 30° likewise.
///
/// # Errors
/// [`ChartError`].
pub fn seams(rows: &[(&Row, String)], stem: &Path) -> Result<(), ChartError> {
    type Of = fn(&Angles) -> f64;
    let columns: [(&str, Of); 3] = [
        ("mean (°)", |angles| angles.mean_deg),
        ("5th percentile (°)", |angles| angles.p05_deg),
        ("triangles under 30° (%)", |angles| 100.0 * angles.share_under_30),
    ];
    let marker = |row: &Row| style::method(&Method::of(row));
    let column = |(label, value): (&str, Of)| {
        let mut dots = Vec::new();
        for (line, (row, _)) in rows.iter().enumerate() {
            let Some(seams) = measured(row).and_then(|report| report.statistics.seams) else {
                continue;
            };
            let dot = |angles: &Angles, marker: Marker| Dot {
                line,
                shift: 0.0,
                values: vec![value(angles)],
                marker,
                missing: "none",
            };
            dots.push(dot(&seams.elsewhere, marker(row)));
            dots.push(dot(&seams.met, marker(row).hollow()));
        }
        Column {
            label: label.to_string(),
            is_log: false,
            dots,
        }
    };
    let key = rows.first().map(|(row, _)| marker(row)).map(|marker| {
        vec![
            (Key::Point(marker), "elsewhere".to_string()),
            (Key::Point(marker.hollow()), "where fronts met".to_string()),
        ]
    });
    let figure = Dots {
        columns: columns.map(column).into(),
        key: key.unwrap_or_default(),
        names: rows.iter().map(|(_, name)| name.clone()).collect(),
    };
    write_both(&figure, stem)
}
