//! How many triangles: ratios to ∫ dA / f² and ∫ dA / lfs² over t and c_b, and size efficiency.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, colour_bar, legend};
use super::panel::{Axis, Panel, log_span, span};
use super::style::{self, GREY, INK, Marker, SMALL, TINY, TITLE};
use crate::suite::analysis::measures::Measure;
use crate::suite::analysis::summary::{Grid, measured};
use crate::suite::rows::record::Report;
use plotters::prelude::{DrawingBackend, Text};
use plotters::style::text_anchor::{HPos, VPos};
use std::path::Path;

/// A grid with the title it stands under.
pub type Titled<'a> = (String, Grid<'a>);

/// Draws medians of `measure` over domains as a heat map over t × c_b, one panel for each of `grids`.
///
/// # Errors
/// [`ChartError`].
pub fn heat_map(grids: &[Titled], measure: &Measure, stem: &Path) -> Result<(), ChartError> {
    write_both(&HeatMap { grids, measure }, stem)
}

/// Draws medians of `measure` over domains against t, one line for each c_b, one panel for each of `grids`.
///
/// # Errors
/// [`ChartError`].
pub fn against_t(grids: &[Titled], measure: &Measure, stem: &Path) -> Result<(), ChartError> {
    write_both(&AgainstT { grids, measure }, stem)
}

/// Draws the size efficiency of every measured cell against t / c_b, one panel for each of `grids`.
///
/// # Errors
/// [`ChartError`].
pub fn efficiency(grids: &[Titled], stem: &Path) -> Result<(), ChartError> {
    write_both(&Efficiency { grids }, stem)
}

struct HeatMap<'a> {
    grids: &'a [Titled<'a>],
    measure: &'a Measure,
}

/// Room for what stands right of the panels, in pixels.
const SIDE: i32 = 150;

/// Areas for `count` panels of equal plotting size side by side, and one for the legend.
fn columns<DB: DrawingBackend>(area: &Area<DB>, count: usize) -> (Vec<Area<DB>>, Area<DB>) {
    let width = area.dim_in_pixel().0 as i32;
    let (left, right) = area.split_horizontally(width - SIDE * FINE);
    (left.split_evenly((1, count.max(1))), right)
}

/// All medians of all grids, for a common scale.
fn medians<'a>(grids: &'a [Titled<'a>], value: fn(&Report) -> Option<f64>) -> impl Iterator<Item = f64> + 'a {
    grids.iter().flat_map(move |(_, grid)| {
        let pairs = grid.ts.iter().flat_map(|t| grid.c_bs.iter().map(move |c_b| (*t, *c_b)));
        pairs.filter_map(move |(t, c_b)| grid.median(t, c_b, value))
    })
}

fn names(values: &[f64]) -> Vec<String> {
    values
        .iter()
        .map(|value| format!("{}", (value * 1e3).round() / 1e3))
        .collect()
}

impl Figure for HeatMap<'_> {
    fn size(&self) -> (u32, u32) {
        (1200, 620)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (head, body) = area.split_vertically(40 * FINE);
        let title = format!("{}, median over domains", self.measure.title);
        let look = style::text(TITLE, INK, HPos::Left, VPos::Center);
        head.draw(&Text::new(title, (80 * FINE, 22 * FINE), look))?;
        let (panels, side) = columns(&body, self.grids.len());
        let scale = log_span(medians(self.grids, self.measure.value));
        let share = |value: f64| (value / scale.start).ln() / (scale.end / scale.start).ln();
        for ((title, grid), area) in self.grids.iter().zip(&panels) {
            let x = Axis::categories("t", &names(&grid.ts));
            let y = Axis::categories("c_b", &names(&grid.c_bs));
            let mut panel = Panel::new(area, title, x, y, 70)?;
            for (column, t) in grid.ts.iter().enumerate() {
                for (line, c_b) in grid.c_bs.iter().enumerate() {
                    let Some(value) = grid.median(*t, *c_b, self.measure.value) else {
                        continue;
                    };
                    let (x, y) = (column as f64, line as f64);
                    let colour = style::continuous(share(value));
                    panel.cell((x - 0.5, y - 0.5), (x + 0.5, y + 0.5), colour)?;
                    let look = style::text(TINY, style::readable_on(colour), HPos::Center, VPos::Center);
                    let missing = grid.at(*t, *c_b).iter().any(|row| measured(row).is_none());
                    let words = three_digits(value) + if missing { "*" } else { "" };
                    panel.text((x, y), (0, 0), &words, look)?;
                }
            }
        }
        let ticks = Axis::log("", scale.clone()).named_ticks();
        let ticks: Vec<_> = ticks.into_iter().map(|(value, name)| (value.ln(), name)).collect();
        colour_bar(&side, "", scale.start.ln()..scale.end.ln(), &ticks, 64)
    }
}

/// 0.0123, 1.23, 12.3, 123, 1230: three digits that count.
fn three_digits(value: f64) -> String {
    let digits = 2 - value.abs().max(1e-9).log10().floor() as i32;
    format!("{value:.*}", digits.clamp(0, 9) as usize)
}

struct AgainstT<'a> {
    grids: &'a [Titled<'a>],
    measure: &'a Measure,
}

/// The legend of c_b, with markers and colours as everywhere.
pub(super) fn c_b_entries(c_bs: &[f64], key: fn(Marker) -> Key) -> Vec<Entry> {
    let heading = std::iter::once((Key::Heading, "c_b".to_string()));
    let series = c_bs
        .iter()
        .enumerate()
        .map(|(k, c_b)| (key(c_b_marker(k, c_bs.len())), format!("{c_b}")));
    heading.chain(series).collect()
}

/// The marker of the c_b at place `index` of `count`.
pub(super) fn c_b_marker(index: usize, count: usize) -> Marker {
    Marker::new(index, style::ordered(index, count))
}

impl Figure for AgainstT<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (panels, side) = columns(area, self.grids.len());
        let scale = log_span(medians(self.grids, self.measure.value));
        for ((title, grid), area) in self.grids.iter().zip(&panels) {
            let reach = grid.ts.last().copied().unwrap_or(0.5);
            let x = Axis::linear("t", 0.0..reach * 1.06, 6);
            let mut panel = Panel::new(area, title, x, Axis::log(self.measure.title, scale.clone()), 86)?;
            for (index, c_b) in grid.c_bs.iter().enumerate() {
                let value = |t: &f64| Some((*t, grid.median(*t, *c_b, self.measure.value)?));
                let points: Vec<(f64, f64)> = grid.ts.iter().filter_map(value).collect();
                let marker = c_b_marker(index, grid.c_bs.len());
                panel.line(&points, marker.colour, FINE as u32)?;
                for point in points {
                    panel.marker(point, marker)?;
                }
            }
        }
        let c_bs = self
            .grids
            .first()
            .map(|(_, grid)| grid.c_bs.clone())
            .unwrap_or_default();
        legend(&side, 50, &c_b_entries(&c_bs, Key::Series))
    }
}

struct Efficiency<'a> {
    grids: &'a [Titled<'a>],
}

impl Figure for Efficiency<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (panels, side) = columns(area, self.grids.len());
        let all = || self.grids.iter().flat_map(|(_, grid)| grid.reports());
        let limits = [1.0 / 3.0, 1.0];
        let across = log_span(all().map(|(row, _)| row.cell.t / row.cell.c_b));
        let upward = span(all().map(|(_, report)| report.size_efficiency).chain(limits));
        for ((title, grid), area) in self.grids.iter().zip(&panels) {
            let x = Axis::log("t / c_b, the Lipschitz constant f is limited to", across.clone());
            let y = Axis::linear("size efficiency (1: equilateral with edge c_b f)", upward.clone(), 8);
            let mut panel = Panel::new(area, title, x, y, 80)?;
            for (limit, words) in limits
                .into_iter()
                .zip(["thinnest covering, f constant", "hexagonal packing, f constant"])
            {
                panel.dashes(&[(across.start, limit), (across.end, limit)], GREY, FINE as u32)?;
                let look = style::text(SMALL, GREY, HPos::Left, VPos::Bottom);
                panel.text((across.start, limit), (8, -4), words, look)?;
            }
            for (row, report) in grid.reports() {
                let index = grid.c_bs.iter().position(|c_b| *c_b == row.cell.c_b).unwrap_or(0);
                let place = (row.cell.t / row.cell.c_b, report.size_efficiency);
                panel.marker(place, c_b_marker(index, grid.c_bs.len()))?;
            }
        }
        let c_bs = self
            .grids
            .first()
            .map(|(_, grid)| grid.c_bs.clone())
            .unwrap_or_default();
        legend(&side, 50, &c_b_entries(&c_bs, Key::Point))
    }
}
