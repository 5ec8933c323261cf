//! Histograms of the smallest angle of each triangle.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, further_rows, legend_row};
use super::panel::{Axis, Panel};
use super::style;
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::series::OrderGroup;
use crate::suite::analysis::summary::Grid;
use crate::suite::rows::numbers::{distinct, first_seen};
use crate::suite::rows::record::Report;
use plotters::prelude::{DrawingBackend, RGBColor};
use std::path::Path;

/// Draws, for each order of bites, how triangles spread over smallest angles: one panel an order, one line a spacing.
///
/// # Errors
/// [`ChartError`].
pub fn angles_by_order(groups: &[OrderGroup], stem: &Path) -> Result<(), ChartError> {
    let orders = first_seen(groups.iter().map(|group| group.order));
    let spacings = first_seen(groups.iter().map(|group| group.spacing.as_str()));
    let lines = |order: &str| {
        let own = |spacing: &&str| {
            let mut same = groups
                .iter()
                .filter(|group| group.order == order && group.spacing == **spacing);
            same.next().map(|group| shares(&group.reports)).unwrap_or_default()
        };
        spacings.iter().map(own).collect()
    };
    let figure = Multiples {
        panels: orders
            .into_iter()
            .map(|order| (order.to_string(), lines(order)))
            .collect(),
        series: coloured(spacings.iter().map(|name| name.to_string())),
    };
    write_both(&figure, stem)
}

/// Draws, for each t, how triangles spread over smallest angles, over all c_b: one panel a t, one line a grid.
///
/// # Errors
/// [`ChartError`].
pub fn angles_by_t(grids: &[(String, Grid)], stem: &Path) -> Result<(), ChartError> {
    let ts = distinct(grids.iter().flat_map(|(_, grid)| grid.ts.iter().copied()));
    let at = |grid: &Grid, t: f64| {
        let reports = grid
            .reports()
            .filter(|(row, _)| row.cell.t == t)
            .map(|(_, report)| report);
        shares(&reports.collect::<Vec<_>>())
    };
    let panel = |t: f64| {
        let lines = grids.iter().map(|(_, grid)| at(grid, t)).collect();
        (format!("t = {}", (t * 1e3).round() / 1e3), lines)
    };
    let figure = Multiples {
        panels: ts.into_iter().map(panel).collect(),
        series: coloured(grids.iter().map(|(name, _)| name.clone())),
    };
    write_both(&figure, stem)
}

/// Draws, for each spacing, how triangles spread over smallest angles, over the tasks that all of `methods` measured: one panel a
/// spacing, one line a method; or where there are more methods than colours, one panel a method, one line a spacing.
///
/// # Errors
/// [`ChartError`].
pub fn angles_by_method(contest: &Contest, methods: &[usize], stem: &Path) -> Result<(), ChartError> {
    let spacings = contest.by_spacing(&contest.common(methods));
    let lines = |method: &usize, tasks: &[usize]| {
        let reports = tasks.iter().filter_map(|task| contest.report(*method, *task));
        shares(&reports.collect::<Vec<_>>())
    };
    let named = |(title, tasks): &(String, Vec<usize>)| {
        let plural = if tasks.len() == 1 { "" } else { "s" };
        format!("{title}, {} task{plural}", tasks.len())
    };
    let of = |method: &usize| &contest.methods[*method];
    let figure = if methods.len() > style::CATEGORIES.len() {
        let panel = |method: &usize| {
            let shares = spacings.iter().map(|(_, tasks)| lines(method, tasks)).collect();
            // Narrow panels: without parameters where these tell nothing apart.
            let same = methods.iter().filter(|other| of(other).mesher == of(method).mesher);
            let name = if same.count() == 1 {
                &of(method).mesher
            } else {
                &of(method).label
            };
            (name.clone(), shares)
        };
        Multiples {
            panels: methods.iter().map(panel).collect(),
            series: coloured(spacings.iter().map(named)),
        }
    } else {
        let panel = |spacing: &(String, Vec<usize>)| {
            let shares = methods.iter().map(|method| lines(method, &spacing.1)).collect();
            (named(spacing), shares)
        };
        Multiples {
            panels: spacings.iter().map(panel).collect(),
            series: methods
                .iter()
                .map(|method| (of(method).label.clone(), style::method(of(method)).colour))
                .collect(),
        }
    };
    write_both(&figure, stem)
}

/// Series with the colours of categories.
fn coloured(names: impl Iterator<Item = String>) -> Vec<(String, RGBColor)> {
    names.enumerate().map(|(k, name)| (name, style::category(k))).collect()
}

/// Share of triangles a degree, in percent: the mean over meshes, so that a large mesh counts as much as a small one. None
/// without meshes.
fn shares(reports: &[&Report]) -> Vec<f64> {
    let mut sums = vec![0.0; if reports.is_empty() { 0 } else { 60 }];
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

/// Uniform spacing puts nearly all triangles into one degree; above this share lines are cut, so that the rest shows.
const CUT: f64 = 30.0;

/// Pixels: of the whole figure, and left of the legend.
const WIDTH: u32 = 1200;
const LEFT: i32 = 62;

/// Small panels of equal axes, one line a series in each.
struct Multiples {
    /// Title of each panel, and the shares of each series in it.
    panels: Vec<(String, Vec<Vec<f64>>)>,
    /// Names and colours of the series.
    series: Vec<(String, RGBColor)>,
}

impl Multiples {
    /// Panels side by side.
    fn columns(&self) -> usize {
        self.panels.len().clamp(1, 4)
    }

    fn key(&self) -> Vec<Entry> {
        let entry = |(name, colour): &(String, RGBColor)| (Key::Line(*colour), name.clone());
        self.series.iter().map(entry).collect()
    }

    /// In pixels.
    fn key_height(&self) -> i32 {
        40 + further_rows(LEFT, WIDTH, &self.key())
    }
}

impl Figure for Multiples {
    fn size(&self) -> (u32, u32) {
        let rows = self.panels.len().div_ceil(self.columns()).max(1) as u32;
        (WIDTH, self.key_height() as u32 + 350 * rows)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (plots, key) = area.split_vertically((self.size().1 as i32 - self.key_height()) * FINE);
        let (count, columns) = (self.panels.len(), self.columns());
        let all = self.panels.iter().flat_map(|(_, shares)| shares.iter().flatten());
        let most = all.copied().fold(1.0, f64::max);
        let (top, unit) = if most > CUT {
            (CUT, format!("triangles (% a degree, cut at {CUT})"))
        } else {
            (1.05 * most, "triangles (% a degree)".to_string())
        };
        let areas = plots.split_evenly((count.div_ceil(columns).max(1), columns));
        for (index, ((title, lines), area)) in self.panels.iter().zip(&areas).enumerate() {
            let is_last = index + columns >= count;
            let x = Axis::linear(if is_last { "smallest angle (degrees)" } else { "" }, 0.0..60.0, 6);
            let label = if index % columns == 0 { unit.as_str() } else { "" };
            let mut panel = Panel::new(area, title, x, Axis::linear(label, 0.0..top, 5), 56)?;
            for (series, shares) in lines.iter().enumerate() {
                let shares: Vec<f64> = shares.iter().map(|share| share.min(top)).collect();
                panel.line(&steps(&shares), self.series[series].1, 3)?;
            }
        }
        legend_row(&key, LEFT, &self.key())
    }
}
