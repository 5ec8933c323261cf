//! Time against triangles.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel, log_span};
use super::style::{self, Marker};
use crate::suite::analysis::contest::{Contest, Method};
use crate::suite::analysis::series::TimeSeries;
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Draws seconds against triangles, log-log: the whole run and each of its steps, with fitted slopes.
///
/// # Errors
/// [`ChartError`].
pub fn time(series: &[TimeSeries], stem: &Path) -> Result<(), ChartError> {
    let marker = |index: usize| Marker::new(index, style::category(index));
    let lines = series.iter().enumerate().map(|(k, series)| (marker(k), series.clone()));
    let figure = Time {
        heading: "step, fitted slope",
        unit: "time (seconds)",
        lines: lines.collect(),
    };
    write_both(&figure, stem)
}

/// Draws microseconds a triangle against triangles, log-log: the whole run and each of its steps, with fitted slopes, which are
/// 0 where time is linear.
///
/// # Errors
/// [`ChartError`].
pub fn time_per_triangle(series: &[TimeSeries], stem: &Path) -> Result<(), ChartError> {
    let line = |(k, series): (usize, &TimeSeries)| {
        let points = series
            .points
            .iter()
            .map(|(triangles, seconds)| (*triangles, 1e6 * seconds / triangles));
        let series = TimeSeries {
            name: series.name.clone(),
            points: points.collect(),
        };
        (Marker::new(k, style::category(k)), series)
    };
    let figure = Time {
        heading: "step, fitted slope",
        unit: "time a triangle (µs)",
        lines: series.iter().enumerate().map(line).collect(),
    };
    write_both(&figure, stem)
}

/// Draws seconds against triangles of every method, with fitted slopes.
///
/// # Errors
/// [`ChartError`].
pub fn time_by_method(contest: &Contest, stem: &Path) -> Result<(), ChartError> {
    let line = |(k, method): (usize, &Method)| {
        let series = TimeSeries::of_method(contest, k);
        (style::method(method), series)
    };
    let figure = Time {
        heading: "mesher, fitted slope",
        unit: "time (seconds)",
        lines: contest.methods.iter().enumerate().map(line).collect(),
    };
    write_both(&figure, stem)
}

struct Time {
    heading: &'static str,
    unit: &'static str,
    lines: Vec<(Marker, TimeSeries)>,
}

/// Room for the legend, in pixels: some, and more for long names.
const SIDE: i32 = 300;
const LETTER: i32 = 9;

impl Figure for Time {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let longest = self.lines.iter().map(|(_, series)| series.name.chars().count()).max();
        let side = (100 + LETTER * longest.unwrap_or(0) as i32).clamp(SIDE, 500);
        let (left, right) = area.split_horizontally((1200 - side) * FINE);
        let all = || self.lines.iter().flat_map(|(_, series)| series.points.iter());
        let x = Axis::log("triangles", log_span(all().map(|point| point.0)));
        let y = Axis::log(self.unit, log_span(all().map(|point| point.1)));
        let mut panel = Panel::new(&left, "", x, y, 90)?;
        let mut entries: Vec<Entry> = vec![(Key::Heading, self.heading.into())];
        for (marker, series) in &self.lines {
            let slope = series
                .fit()
                .map(|line| format!(" {:.2}", line.slope))
                .unwrap_or_default();
            entries.push((
                Key::Series(*marker),
                format!("{}{slope}", series.name.replace('_', " ")),
            ));
            if let Some(line) = series.fit() {
                let ends = log_span(series.points.iter().map(|point| point.0));
                let at = |x: f64| (x, 10f64.powf(line.slope * x.log10() + line.intercept));
                panel.line(&[at(ends.start * 1.2), at(ends.end / 1.2)], marker.colour, FINE as u32)?;
            }
            for point in series.points.iter().filter(|point| point.0 > 0.0 && point.1 > 0.0) {
                panel.marker(*point, *marker)?;
            }
        }
        legend(&right, 40, &entries)
    }
}
