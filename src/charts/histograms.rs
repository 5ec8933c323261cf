//! Histograms of the smallest angle of each triangle.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend, legend_row};
use super::panel::{Axis, Panel};
use super::style::{self, Marker};
use crate::experiment::record::Report;
use crate::experiment::series::OrderGroup;
use crate::experiment::summary::{Grid, first_seen, measured};
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Draws, for each order of bites, how triangles spread over smallest angles: one panel an order, one line a spacing.
///
/// # Errors
/// [`ChartError`].
pub fn angles_by_order(groups: &[OrderGroup], stem: &Path) -> Result<(), ChartError> {
    write_both(&ByOrder { groups }, stem)
}

/// Draws, for each t, how triangles spread over smallest angles, over all c_b; one panel for each of `grids`.
///
/// # Errors
/// [`ChartError`].
pub fn angles_by_t(grids: &[(String, Grid)], stem: &Path) -> Result<(), ChartError> {
    write_both(&ByT { grids }, stem)
}

/// Share of triangles a degree, in percent: the mean over meshes, so that a large mesh counts as much as a small one.
fn shares(reports: &[&Report]) -> Vec<f64> {
    let mut sums = vec![0.0; 60];
    for report in reports {
        let counts = &report.statistics.min_angle_histogram;
        let total: u64 = counts.iter().sum::<u64>().max(1);
        for (sum, count) in sums.iter_mut().zip(counts) {
            *sum += 100.0 * *count as f64 / total as f64 / reports.len() as f64;
        }
    }
    sums
}

/// The outline of a histogram with bins of one degree.
fn steps(shares: &[f64]) -> Vec<(f64, f64)> {
    shares
        .iter()
        .enumerate()
        .flat_map(|(k, share)| [(k as f64, *share), (k as f64 + 1.0, *share)])
        .collect()
}

fn top<'a>(all: impl Iterator<Item = &'a Vec<f64>>) -> f64 {
    all.flatten().copied().fold(1.0, f64::max) * 1.05
}

struct ByOrder<'a> {
    groups: &'a [OrderGroup<'a>],
}

impl Figure for ByOrder<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let orders = first_seen(self.groups.iter().map(|group| group.order));
        let spacings = first_seen(self.groups.iter().map(|group| group.spacing.as_str()));
        let all: Vec<Vec<f64>> = self.groups.iter().map(|group| shares(&group.reports)).collect();
        let (plots, key) = area.split_vertically((750 - 40) * FINE);
        let lines = orders.len().div_ceil(4).max(1);
        let areas = plots.split_evenly((lines, 4));
        for (index, (order, area)) in orders.iter().zip(&areas).enumerate() {
            let below = index + 4 >= orders.len();
            let x = Axis::linear(if below { "smallest angle (degrees)" } else { "" }, 0.0..60.0, 6);
            let y = Axis::linear(
                if index % 4 == 0 { "triangles (% a degree)" } else { "" },
                0.0..top(all.iter()),
                5,
            );
            let mut panel = Panel::new(area, order, x, y, 56)?;
            for (group, shares) in self.groups.iter().zip(&all).filter(|(group, _)| group.order == *order) {
                let series = spacings.iter().position(|name| *name == group.spacing).unwrap_or(0);
                panel.line(&steps(shares), style::category(series), 3)?;
            }
        }
        let entries = spacings.iter().enumerate();
        let entries = entries.map(|(k, name)| (Key::Line(style::category(k)), name.to_string()));
        legend_row(&key, 62, &entries.collect::<Vec<_>>())
    }
}

struct ByT<'a> {
    grids: &'a [(String, Grid<'a>)],
}

impl Figure for ByT<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1200 - 130) * FINE);
        let own = |grid: &Grid, t: f64| {
            let rows = grid.rows.iter().filter(|row| row.cell.t == t);
            shares(&rows.filter_map(|row| measured(row)).collect::<Vec<_>>())
        };
        let all: Vec<Vec<Vec<f64>>> = self
            .grids
            .iter()
            .map(|(_, grid)| grid.ts.iter().map(|t| own(grid, *t)).collect())
            .collect();
        let top = top(all.iter().flatten());
        let areas = left.split_evenly((1, self.grids.len().max(1)));
        for (((title, _), lines), area) in self.grids.iter().zip(&all).zip(&areas) {
            let x = Axis::linear("smallest angle of a triangle (degrees)", 0.0..60.0, 6);
            let mut panel = Panel::new(area, title, x, Axis::linear("triangles (% a degree)", 0.0..top, 6), 70)?;
            for (index, shares) in lines.iter().enumerate() {
                panel.line(&steps(shares), style::ordered(index, lines.len()), 2 * FINE as u32)?;
            }
        }
        let ts = self.grids.first().map(|(_, grid)| grid.ts.clone()).unwrap_or_default();
        let mut entries: Vec<Entry> = vec![(Key::Heading, "t".into())];
        for (index, t) in ts.iter().enumerate() {
            let colour = Marker::new(index, style::ordered(index, ts.len())).colour;
            entries.push((Key::Line(colour), format!("{}", (t * 1e3).round() / 1e3)));
        }
        legend(&right, 50, &entries)
    }
}
