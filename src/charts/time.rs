//! Time against triangles.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel, log_span};
use super::style::{self, Marker};
use crate::experiment::series::TimeSeries;
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Draws seconds against triangles, log-log: the whole run and each of its steps, with fitted slopes.
///
/// # Errors
/// [`ChartError`].
pub fn time(series: &[TimeSeries], stem: &Path) -> Result<(), ChartError> {
    write_both(&Time { series }, stem)
}

struct Time<'a> {
    series: &'a [TimeSeries],
}

impl Figure for Time<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1200 - 300) * FINE);
        let all = || self.series.iter().flat_map(|series| series.points.iter());
        let x = Axis::log("triangles", log_span(all().map(|point| point.0)));
        let y = Axis::log("time (seconds)", log_span(all().map(|point| point.1)));
        let mut panel = Panel::new(&left, "", x, y, 90)?;
        let mut entries: Vec<Entry> = vec![(Key::Heading, "step, fitted slope".into())];
        for (index, series) in self.series.iter().enumerate() {
            let marker = Marker::new(index, style::category(index));
            let slope = series
                .fit()
                .map(|line| format!(" {:.2}", line.slope))
                .unwrap_or_default();
            entries.push((Key::Series(marker), format!("{}{slope}", series.name.replace('_', " "))));
            if let Some(line) = series.fit() {
                let ends = log_span(series.points.iter().map(|point| point.0));
                let at = |x: f64| (x, 10f64.powf(line.slope * x.log10() + line.intercept));
                panel.line(&[at(ends.start * 1.2), at(ends.end / 1.2)], marker.colour, FINE as u32)?;
            }
            for point in series.points.iter().filter(|point| point.0 > 0.0 && point.1 > 0.0) {
                panel.marker(*point, marker)?;
            }
        }
        legend(&right, 40, &entries)
    }
}
