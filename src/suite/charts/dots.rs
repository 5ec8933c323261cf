//! Lines of names, columns of numbers: the median of some values as a marker, their range as a line through it.

use super::canvas::{Area, Drawn, FINE, Figure};
use super::legend::{Entry, further_rows, legend_row};
use super::panel::{Axis, Panel, log_span, span};
use super::style::{self, Marker, TINY};
use crate::suite::rows::numbers::{median, quantile};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};

/// The figure.
pub(super) struct Dots {
    /// From top to bottom.
    pub(super) names: Vec<String>,
    pub(super) columns: Vec<Column>,
    /// What the markers mean.
    pub(super) key: Vec<Entry>,
}

/// One number of all lines.
pub(super) struct Column {
    pub(super) label: String,
    pub(super) is_log: bool,
    pub(super) dots: Vec<Dot>,
}

/// Some values of one line.
pub(super) struct Dot {
    /// Index among the names.
    pub(super) line: usize,
    /// Downwards, in lines.
    pub(super) shift: f64,
    /// Those that are not finite are left out.
    pub(super) values: Vec<f64>,
    pub(super) marker: Marker,
    /// What stands there where there are no values: how that came.
    pub(super) missing: &'static str,
}

/// Places `index` of `count` markers on one line apart from each other.
pub(super) fn apart(index: usize, count: usize) -> f64 {
    (0.66 / count.max(3) as f64) * (index as f64 - (count as f64 - 1.0) / 2.0)
}

/// Room for names: at least so much, and so much a letter, in pixels.
const LEAST_LEFT: i32 = 130;
const LETTER: i32 = 10;
/// Room for a column's first label.
const MARGIN: i32 = 10;
/// Height of a line, and of all besides, in pixels.
const LINE: u32 = 40;
const FRAME: u32 = 130;
const LOWEST: u32 = 600;
const WIDTH: u32 = 1200;

impl Dots {
    fn left(&self) -> i32 {
        let longest = self.names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        (MARGIN + LETTER * longest as i32).max(LEAST_LEFT)
    }

    fn column<DB: DrawingBackend>(&self, area: &Area<DB>, column: &Column, is_first: bool) -> Drawn {
        let names: Vec<String> = self.names.iter().rev().cloned().collect();
        let values = || column.dots.iter().flat_map(|dot| dot.values.iter().copied());
        let x = if column.is_log {
            Axis::log(&column.label, log_span(values())).sparse()
        } else {
            Axis::linear(&column.label, span(values()), 4)
        };
        let start = if column.is_log {
            log_span(values()).start
        } else {
            span(values()).start
        };
        let y = Axis::categories("", &names);
        let (y, left) = if is_first {
            (y, self.left())
        } else {
            (y.unnamed(), MARGIN)
        };
        let mut panel = Panel::new(area, "", x, y, left)?;
        for dot in &column.dots {
            let y = (names.len() - 1 - dot.line) as f64 - dot.shift;
            let all: Vec<f64> = dot.values.iter().copied().filter(|value| value.is_finite()).collect();
            let ends = (quantile(all.clone(), 0.0), quantile(all.clone(), 1.0));
            let (Some(middle), (Some(low), Some(high))) = (median(all), ends) else {
                let look = style::text(TINY, dot.marker.colour, HPos::Left, VPos::Center);
                panel.text((start, y), (4, 0), dot.missing, look)?;
                continue;
            };
            panel.line(&[(low, y), (high, y)], dot.marker.colour, FINE as u32)?;
            panel.marker((middle, y), dot.marker)?;
        }
        Ok(())
    }
}

impl Figure for Dots {
    fn size(&self) -> (u32, u32) {
        let further = further_rows(LEAST_LEFT, WIDTH, &self.key) as u32;
        (WIDTH, (FRAME + LINE * self.names.len() as u32).max(LOWEST) + further)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (plots, key) =
            area.split_vertically((self.size().1 as i32 - 44 - further_rows(LEAST_LEFT, WIDTH, &self.key)) * FINE);
        let names = (self.left() - MARGIN) * FINE;
        let each = (plots.dim_in_pixel().0 as i32 - names) / self.columns.len().max(1) as i32;
        let mut rest = plots;
        for (index, column) in self.columns.iter().enumerate() {
            let is_first = index == 0;
            let (here, after) = rest.split_horizontally(if is_first { each + names } else { each });
            self.column(&here, column, is_first)?;
            rest = after;
        }
        legend_row(&key, LEAST_LEFT, &self.key)
    }
}
