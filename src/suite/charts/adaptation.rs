//! Error against vertices, adapted and uniform, beside a line of slope −1.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel, log_span};
use super::style::{self, Marker};
use crate::suite::analysis::convergence::Convergence;
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Draws relative L2 errors against vertices, log-log.
///
/// # Errors
/// [`ChartError`].
pub fn adaptation(lines: &[Convergence], stem: &Path) -> Result<(), ChartError> {
    write_both(&Adaptation { lines }, stem)
}

struct Adaptation<'a> {
    lines: &'a [Convergence],
}

impl Figure for Adaptation<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1200 - 300) * FINE);
        let all = || self.lines.iter().flat_map(|line| line.points.iter());
        let x = Axis::log("vertices", log_span(all().map(|point| point.0)));
        let y = Axis::log("relative L2 error", log_span(all().map(|point| point.1)));
        let title = self.lines.first().map_or("", |line| &line.title);
        let mut panel = Panel::new(&left, title, x, y, 100)?;
        let mut entries: Vec<Entry> = vec![(Key::Heading, "refinement, fitted slope".into())];
        for (k, line) in self.lines.iter().enumerate() {
            let marker = Marker::new(k, style::category(k));
            let slope = line.slope().map(|slope| format!(" {slope:.2}")).unwrap_or_default();
            entries.push((Key::Series(marker), format!("{}{slope}", line.name())));
            panel.line(&line.points, marker.colour, FINE as u32)?;
            for point in &line.points {
                panel.marker(*point, marker)?;
            }
        }
        // Through the first mesh of the first kind.
        if let Some([first, .., last]) = self.lines.first().map(|line| &line.points[..]) {
            let end = (last.0, first.1 * first.0 / last.0);
            panel.dashes(&[*first, end], style::GREY, FINE as u32)?;
            entries.push((Key::Heading, "dashed: slope −1".into()));
        }
        legend(&right, 40, &entries)
    }
}
