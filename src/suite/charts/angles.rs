//! The smallest angle against t.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel};
use super::style::{self, GREY, INK, Marker};
use crate::suite::analysis::summary::{Grid, Setting, setting};
use crate::suite::rows::record::Report;
use crate::theory::{Promises, Rule};
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Draws the smallest angle of every measured cell of `grid` against its effective t, with the curve asin(1/2 − t).
/// Hollow points are meshes for which a hypothesis of Theorem 6.8 fails: segments meet at an angle under 90°, or circles of
/// neighbouring input vertices meet low.
///
/// # Errors
/// [`ChartError`].
pub fn smallest_angle(grid: &Grid, stem: &Path) -> Result<(), ChartError> {
    write_both(&SmallestAngle { grid }, stem)
}

/// How far apart in t the points of neighbouring c_b stand, so that they do not hide one another.
const SPREAD: f64 = 0.003;

struct SmallestAngle<'a> {
    grid: &'a Grid<'a>,
}

impl SmallestAngle<'_> {
    /// Each measured cell's report with the index of its c_b.
    fn points(&self) -> impl Iterator<Item = (usize, &Report)> {
        let place = |c_b: f64| self.grid.c_bs.iter().position(|other| *other == c_b);
        self.grid
            .reports()
            .filter_map(move |(row, report)| Some((place(row.cell.c_b)?, report)))
    }

    fn marker(&self, index: usize) -> Marker {
        Marker::new(index, style::ordered(index, self.grid.c_bs.len()))
    }

    fn entries(&self) -> Vec<Entry> {
        let mut entries: Vec<Entry> = vec![(Key::Heading, "c_b".into())];
        let c_bs = self.grid.c_bs.iter().enumerate();
        entries.extend(c_bs.map(|(index, c_b)| (Key::Point(self.marker(index)), format!("{c_b}"))));
        entries.push((Key::Heading, String::new()));
        entries.push((Key::Heading, "Theorem 6.8".into()));
        entries.push((Key::Line(INK), "asin(1/2 − t)".into()));
        entries.push((Key::Heading, String::new()));
        entries.push((Key::Heading, "hypotheses".into()));
        entries.push((Key::Point(Marker::new(0, GREY)), "hold".into()));
        entries.push((Key::Point(Marker::new(0, GREY).hollow()), "one fails".into()));
        entries
    }
}

impl Figure for SmallestAngle<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1200 - 200) * FINE);
        let top = self
            .points()
            .filter_map(|(_, report)| report.statistics.min_angle_free_deg)
            .fold(35.0, f64::max);
        let reach = self.grid.ts.last().copied().unwrap_or(0.5).max(0.5);
        let x = Axis::linear("effective t = c_b · Lipschitz constant of f", 0.0..reach * 1.04, 6);
        let y = Axis::linear("smallest angle (degrees)", 0.0..top * 1.05, 8);
        let mut panel = Panel::new(&left, "", x, y, 70)?;
        let curve: Vec<_> = (0..=100)
            .map(|k| f64::from(k) * 0.005)
            .map(|t| (t, Promises { rule: Rule::Earlier, t }.min_angle_deg()))
            .collect();
        panel.line(&curve, INK, 2 * FINE as u32)?;
        let middle = (self.grid.c_bs.len() as f64 - 1.0) / 2.0;
        for (index, report) in self.points() {
            let marker = self.marker(index);
            let is_papers = setting(report) == Setting::Papers;
            let marker = if is_papers { marker } else { marker.hollow() };
            if let Some(angle) = report.statistics.min_angle_free_deg {
                let apart = SPREAD * (index as f64 - middle);
                panel.marker((report.t_effective + apart, angle), marker)?;
            }
        }
        legend(&right, 40, &self.entries())
    }
}
