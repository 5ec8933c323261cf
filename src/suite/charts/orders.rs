//! Orders of bites side by side.

use super::canvas::{ChartError, write_both};
use super::dots::{Column, Dot, Dots, apart};
use super::legend::Key;
use super::style::{self, Marker};
use crate::suite::analysis::measures::Measure;
use crate::suite::analysis::series::OrderGroup;
use crate::suite::rows::numbers::first_seen;
use std::path::Path;

/// Draws medians over domains, with the range from smallest to largest, of some measures for each order; one marker
/// for each spacing.
///
/// # Errors
/// [`ChartError`].
pub fn orders(groups: &[OrderGroup], measures: &[Measure], stem: &Path) -> Result<(), ChartError> {
    let names = first_seen(groups.iter().map(|group| group.order));
    let spacings = first_seen(groups.iter().map(|group| group.spacing.as_str()));
    let marker = |series: usize| Marker::new(series, style::category(series));
    let dot = |group: &OrderGroup, measure: &Measure| {
        let series = spacings.iter().position(|name| *name == group.spacing).unwrap_or(0);
        Dot {
            line: names.iter().position(|name| *name == group.order).unwrap_or(0),
            shift: apart(series, spacings.len()),
            values: group
                .reports
                .iter()
                .filter_map(|report| (measure.value)(report))
                .collect(),
            marker: marker(series),
            missing: "not measured",
        }
    };
    let column = |measure: &Measure| Column {
        label: measure.short_label(),
        is_log: false,
        dots: groups.iter().map(|group| dot(group, measure)).collect(),
    };
    let figure = Dots {
        names: names.iter().map(|name| name.to_string()).collect(),
        columns: measures.iter().map(column).collect(),
        key: spacings
            .iter()
            .enumerate()
            .map(|(k, name)| (Key::Series(marker(k)), name.to_string()))
            .collect(),
    };
    write_both(&figure, stem)
}
