//! A bound against its parameter: as printed, as corrected, the optimum over all configurations, and the worst on meshes.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel};
use super::style::{self, INK, Marker};
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// What the figure of one statement shows; every curve is points (parameter, value).
pub struct BoundFigure {
    /// Statement and quantity.
    pub title: String,
    /// What the parameter is.
    pub parameter: String,
    /// The printed formula.
    pub printed: Vec<(f64, f64)>,
    /// The corrected one; empty if none is needed.
    pub corrected: Vec<(f64, f64)>,
    /// Optima.
    pub optimum: Vec<(f64, f64)>,
    /// The worst on meshes; empty if not measured.
    pub measured: Vec<(f64, f64)>,
}

/// Draws the figure of a statement to `stem.svg` and `stem.png`.
///
/// # Errors
/// [`ChartError`].
pub fn bound(figure: &BoundFigure, stem: &Path) -> Result<(), ChartError> {
    write_both(figure, stem)
}

/// A curve: its name, its points, the marker in whose colour it is drawn.
type Curve<'a> = (&'static str, &'a [(f64, f64)], Marker);

impl BoundFigure {
    fn curves(&self) -> [Curve<'_>; 4] {
        let marker = |index| Marker::new(index, style::category(index));
        [
            ("printed", &self.printed, Marker::new(1, style::category(1)).hollow()),
            ("corrected", &self.corrected, marker(2)),
            ("optimum over all", &self.optimum, Marker::new(0, INK)),
            ("worst on meshes", &self.measured, marker(0)),
        ]
    }

    fn spans(&self) -> [std::ops::Range<f64>; 2] {
        let points = || {
            self.curves()
                .map(|curve| curve.1)
                .concat()
                .into_iter()
                .filter(|point| point.1.is_finite())
        };
        let most = |pick: fn((f64, f64)) -> f64| points().map(pick).fold(f64::MIN, f64::max);
        let least = |pick: fn((f64, f64)) -> f64| points().map(pick).fold(f64::MAX, f64::min);
        let width = most(|point| point.0).max(1e-3);
        let (low, high) = (least(|point| point.1).min(0.0), most(|point| point.1));
        [0.0..1.04 * width, low..high + 0.06 * (high - low).max(1e-9)]
    }
}

impl Figure for BoundFigure {
    fn size(&self) -> (u32, u32) {
        (1000, 600)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1000 - 210) * FINE);
        let [x, y] = self.spans();
        let mut panel = Panel::new(
            &left,
            &self.title,
            Axis::linear(&self.parameter, x, 6),
            Axis::linear("", y, 6),
            70,
        )?;
        let mut entries: Vec<Entry> = Vec::new();
        for (name, points, marker) in self.curves().into_iter().filter(|curve| !curve.1.is_empty()) {
            let is_formula = name == "printed" || name == "corrected";
            if is_formula {
                panel.line(points, marker.colour, 2 * FINE as u32)?;
            }
            for point in points.iter().filter(|_| !is_formula) {
                panel.marker(*point, marker)?;
            }
            let key = if is_formula {
                Key::Line(marker.colour)
            } else {
                Key::Point(marker)
            };
            entries.push((key, name.into()));
        }
        legend(&right, 60, &entries)
    }
}
