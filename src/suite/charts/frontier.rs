//! Smallest angle against size, one curve for each family of methods.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel, log_span, span};
use super::style::{Marker, category};
use crate::suite::analysis::frontier::{Family, Point};
use crate::suite::analysis::measures::SIZE_RATIO_LFS;
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Draws triangles / ∫ dA / lfs² against the smallest angle: every point, those joined that no other of its family beats in
/// both.
///
/// # Errors
/// [`ChartError`].
pub fn frontier(title: &str, families: &[Family], stem: &Path) -> Result<(), ChartError> {
    write_both(&Frontier { title, families }, stem)
}

struct Frontier<'a> {
    title: &'a str,
    families: &'a [Family],
}

impl Frontier<'_> {
    /// In the colour of the mesher, each family of one mesher with a shape of its own.
    fn marker(&self, index: usize) -> Marker {
        let family = &self.families[index];
        let earlier = self.families[..index]
            .iter()
            .filter(|other| other.mesher == family.mesher);
        Marker::new(family.place + earlier.count(), category(family.place))
    }
}

impl Figure for Frontier<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1200 - 270) * FINE);
        let points = || self.families.iter().flat_map(|family| &family.points);
        let across = span(points().map(|point| point.angle_deg));
        let upward = log_span(points().map(|point| point.size));
        let x = Axis::linear("smallest angle (degrees)", across, 8);
        let mut panel = Panel::new(&left, self.title, x, Axis::log(SIZE_RATIO_LFS.title, upward), 86)?;
        let place = |point: &Point| (point.angle_deg, point.size);
        let mut entries: Vec<Entry> = Vec::new();
        for (index, family) in self.families.iter().enumerate() {
            let marker = self.marker(index);
            for point in &family.points {
                panel.marker(place(point), marker.hollow())?;
            }
            let best: Vec<(f64, f64)> = family.frontier().iter().map(place).collect();
            panel.line(&best, marker.colour, FINE as u32 + 1)?;
            for point in best {
                panel.marker(point, marker)?;
            }
            entries.push((Key::Series(marker), family.label.clone()));
        }
        legend(&right, 40, &entries)
    }
}
