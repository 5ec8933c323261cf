//! Smallest angles by either rule of who bites whom, against t, with the bound of each.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel};
use super::style::{self, GREY, Marker};
use crate::suite::analysis::summary::{is_acute, measured, parameter};
use crate::suite::rows::record::{Report, Row};
use crate::theory::{Promises, Rule};
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Each rule with the value of its parameter, what it is called, and its bound.
const RULES: [(Rule, &str, &str, &str); 2] = [
    (Rule::Earlier, "earlier", "the earlier (paper)", "asin(1/2 − t)"),
    (Rule::Later, "later", "the later", "asin((1 − t) / 2)"),
];

/// How far apart in t the points of the two rules stand.
const SPREAD: f64 = 0.008;

/// Draws the smallest angle of every measured row against its effective t, with the curves of both bounds. Hollow points are
/// meshes of domains with angles under 90° between segments.
///
/// # Errors
/// [`ChartError`].
pub fn rules(rows: &[&Row], stem: &Path) -> Result<(), ChartError> {
    write_both(&Rules { rows }, stem)
}

struct Rules<'a> {
    rows: &'a [&'a Row],
}

impl Rules<'_> {
    fn reports<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Report> {
        let own = self.rows.iter().filter(move |row| parameter(row, "rule") == Some(name));
        own.filter_map(|row| measured(row))
    }

    fn entries(&self) -> Vec<Entry> {
        let heading = |text: &str| (Key::Heading, text.to_string());
        let mut entries = vec![heading("whose spacing counts")];
        for (index, (_, _, title, _)) in RULES.iter().enumerate() {
            entries.push((Key::Point(marker(index)), title.to_string()));
        }
        entries.extend([heading(""), heading("bounds")]);
        for (index, (.., bound)) in RULES.iter().enumerate() {
            entries.push((Key::Line(style::ordered(index, RULES.len())), bound.to_string()));
        }
        entries.extend([heading(""), heading("angles under 90°")]);
        entries.push((Key::Point(Marker::new(0, GREY)), "none".into()));
        entries.push((Key::Point(Marker::new(0, GREY).hollow()), "some".into()));
        entries
    }
}

fn marker(index: usize) -> Marker {
    Marker::new(index, style::ordered(index, RULES.len()))
}

impl Figure for Rules<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1200 - 220) * FINE);
        let all = || RULES.iter().flat_map(|(_, name, ..)| self.reports(name));
        let top = all()
            .filter_map(|report| report.statistics.min_angle_free_deg)
            .fold(35.0, f64::max);
        let reach = all().map(|report| report.t_effective).fold(0.5, f64::max);
        let x = Axis::linear("effective t = c_b · Lipschitz constant of f", 0.0..reach * 1.04, 6);
        let y = Axis::linear("smallest angle (degrees)", 0.0..top * 1.05, 8);
        let mut panel = Panel::new(&left, "", x, y, 70)?;
        for (index, (rule, name, ..)) in RULES.iter().enumerate() {
            let ts = (0..=100).map(|k| f64::from(k) * 0.01 * reach);
            let curve: Vec<_> = ts.map(|t| (t, Promises { rule: *rule, t }.min_angle_deg())).collect();
            panel.line(&curve, style::ordered(index, RULES.len()), 2 * FINE as u32)?;
            for report in self.reports(name) {
                let own = marker(index);
                let own = if is_acute(report) { own.hollow() } else { own };
                if let Some(angle) = report.statistics.min_angle_free_deg {
                    let apart = SPREAD * (index as f64 - 0.5);
                    panel.marker((report.t_effective + apart, angle), own)?;
                }
            }
        }
        legend(&right, 40, &self.entries())
    }
}
