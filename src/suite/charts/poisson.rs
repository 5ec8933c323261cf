//! What quality is for: errors, iterations and eigenvalues against unknowns, one line for each method.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel, log_span, span};
use super::style::{self, INK, TITLE};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::measures::YIELDS;
use crate::suite::analysis::summary::measured;
use crate::suite::rows::record::Report;
use plotters::prelude::{DrawingBackend, Text};
use plotters::style::text_anchor::{HPos, VPos};
use std::path::Path;

/// Height of the title, in pixels.
const HEAD: i32 = 40;

/// Draws each of [`YIELDS`] against unknowns, over the tasks of a contest.
///
/// # Errors
/// [`ChartError`].
pub fn poisson(title: &str, contest: &Contest, stem: &Path) -> Result<(), ChartError> {
    write_both(&Poisson { title, contest }, stem)
}

struct Poisson<'a> {
    title: &'a str,
    contest: &'a Contest<'a>,
}

impl Poisson<'_> {
    fn line(&self, method: usize, value: fn(&Report) -> Option<f64>) -> Vec<(f64, f64)> {
        let point = |report: &Report| {
            let solution = report.poisson.as_ref()?;
            Some((solution.unknowns as f64, value(report).filter(|value| *value > 0.0)?))
        };
        let mut points: Vec<(f64, f64)> = self
            .contest
            .rows(method)
            .filter_map(measured)
            .filter_map(point)
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    }
}

impl Figure for Poisson<'_> {
    fn size(&self) -> (u32, u32) {
        (1400, 1000)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (plots, key) = area.split_horizontally((1400 - 370) * FINE);
        let (head, plots) = plots.split_vertically(HEAD * FINE);
        let middle = (head.dim_in_pixel().0 as i32 / 2, HEAD * FINE / 2);
        let look = style::text(TITLE, INK, HPos::Center, VPos::Center);
        head.draw(&Text::new(self.title.to_string(), middle, look))?;
        let mut all = self.contest.all();
        // Who was not there when it was measured has no points.
        all.retain(|k| YIELDS.iter().any(|wanted| !self.line(*k, wanted.value).is_empty()));
        for (part, wanted) in plots.split_evenly((2, 2)).iter().zip(&YIELDS) {
            let lines: Vec<_> = all.iter().map(|k| (*k, self.line(*k, wanted.value))).collect();
            let points = || lines.iter().flat_map(|(_, line)| line.iter().copied());
            let x = Axis::log("unknowns", log_span(points().map(|point| point.0))).sparse();
            let y = Axis::linear(wanted.title, span(points().map(|point| point.1)), 6);
            let mut panel = Panel::new(part, "", x, y, 86)?;
            for (k, line) in &lines {
                let marker = style::method(&self.contest.methods[*k]);
                panel.line(line, marker.colour, FINE as u32)?;
                for point in line {
                    panel.marker(*point, marker)?;
                }
            }
        }
        let entry = |k: &usize| -> Entry {
            let method = &self.contest.methods[*k];
            (Key::Series(style::method(method)), method.label.clone())
        };
        legend(&key, 40, &all.iter().map(entry).collect::<Vec<_>>())
    }
}
