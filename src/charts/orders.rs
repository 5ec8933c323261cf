//! Orders of bites side by side.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Key, legend_row};
use super::panel::{Axis, Panel, span};
use super::size::Measure;
use super::style::{self, Marker};
use crate::experiment::series::OrderGroup;
use crate::experiment::summary::{first_seen, median, quantile};
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// What orders are compared by, with units.
pub const ORDER_MEASURES: [Measure; 4] = [
    Measure {
        label: "smallest angle (°)",
        value: |report| report.statistics.min_angle_free_deg.unwrap_or(f64::NAN),
    },
    Measure {
        label: "mean smallest angle (°)",
        value: |report| report.statistics.mean_min_angle_deg,
    },
    Measure {
        label: "size efficiency",
        value: |report| report.size_efficiency,
    },
    Measure {
        label: "time (µs per triangle)",
        value: |report| 1e6 * report.seconds.total / report.statistics.triangles as f64,
    },
];

/// Draws medians over domains, with the range from smallest to largest, of four measures for each order; one marker
/// for each spacing.
///
/// # Errors
/// [`ChartError`].
pub fn orders(groups: &[OrderGroup], stem: &Path) -> Result<(), ChartError> {
    write_both(&Orders { groups }, stem)
}

struct Orders<'a> {
    groups: &'a [OrderGroup<'a>],
}

impl Orders<'_> {
    fn panel<DB: DrawingBackend>(&self, area: &Area<DB>, measure: Measure, names: &[String], first: bool) -> Drawn {
        let values = |group: &OrderGroup| -> Vec<f64> { group.reports.iter().map(|r| (measure.value)(r)).collect() };
        let across = span(self.groups.iter().flat_map(values));
        let y = Axis::categories("", names);
        let (y, left) = if first { (y, FIRST_LEFT) } else { (y.unnamed(), 10) };
        let mut panel = Panel::new(area, "", Axis::linear(measure.label, across, 4), y, left)?;
        let spacings = self.spacings();
        for group in self.groups {
            let Some(line) = names.iter().position(|name| name == group.order) else {
                continue;
            };
            let series = spacings.iter().position(|name| *name == group.spacing).unwrap_or(0);
            let shift = 0.22 * (series as f64 - (spacings.len() as f64 - 1.0) / 2.0);
            let y = line as f64 - shift;
            let all: Vec<f64> = values(group).into_iter().filter(|v| v.is_finite()).collect();
            let ends = (quantile(all.clone(), 0.0), quantile(all.clone(), 1.0));
            let (Some(middle), (Some(low), Some(high))) = (median(all), ends) else {
                continue;
            };
            panel.line(&[(low, y), (high, y)], style::category(series), FINE as u32)?;
            panel.marker((middle, y), Marker::new(series, style::category(series)))?;
        }
        Ok(())
    }

    fn spacings(&self) -> Vec<&str> {
        first_seen(self.groups.iter().map(|group| group.spacing.as_str()))
    }
}

/// Room for the names of the orders, in pixels.
const FIRST_LEFT: i32 = 130;

impl Figure for Orders<'_> {
    fn size(&self) -> (u32, u32) {
        (1200, 600)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let seen = first_seen(self.groups.iter().map(|group| group.order));
        let names: Vec<String> = seen.into_iter().rev().map(str::to_string).collect();
        let (plots, key) = area.split_vertically(self.size().1 as i32 * FINE - 44 * FINE);
        let each = (plots.dim_in_pixel().0 as i32 - (FIRST_LEFT - 10) * FINE) / ORDER_MEASURES.len() as i32;
        let mut rest = plots;
        for (index, measure) in ORDER_MEASURES.into_iter().enumerate() {
            let width = if index == 0 {
                each + (FIRST_LEFT - 10) * FINE
            } else {
                each
            };
            let (here, after) = rest.split_horizontally(width);
            self.panel(&here, measure, &names, index == 0)?;
            rest = after;
        }
        let entries = self.spacings().into_iter().enumerate();
        let entries = entries.map(|(k, name)| (Key::Series(Marker::new(k, style::category(k))), name.to_string()));
        legend_row(&key, FIRST_LEFT, &entries.collect::<Vec<_>>())
    }
}
