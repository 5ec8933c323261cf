//! What the density of samples does to an independent set: gaps, size and time.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend_row};
use super::panel::{Axis, Panel, log_span, span};
use super::style::{self, GREY, Marker};
use crate::suite::analysis::remarks::Sampling;
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Draws β, the share of circles that border a gap, and triangles and time over those of biting, against the points
/// sampled along a side of a leaf; filled where sampling goes on until no gap is left, hollow where it does not.
///
/// # Errors
/// [`ChartError`].
pub fn oversampling(samplings: &[Sampling], stem: &Path) -> Result<(), ChartError> {
    write_both(&Oversampling { samplings }, stem)
}

struct Oversampling<'a> {
    samplings: &'a [Sampling],
}

/// A panel: its title, its number, and where biting stands if that is known beforehand.
type Of = (&'static str, fn(&Sampling) -> Option<f64>, Option<f64>);

const PANELS: [Of; 4] = [
    ("β", |sampling| sampling.beta, None),
    (
        "circles at a gap (%)",
        |sampling| sampling.gap_share.map(|share| 100.0 * share),
        Some(0.0),
    ),
    ("triangles / biting's", |sampling| sampling.triangles, Some(1.0)),
    ("seconds / biting's", |sampling| sampling.seconds, Some(1.0)),
];

impl Oversampling<'_> {
    fn marker(sampling: &Sampling) -> Marker {
        let marker = Marker::new(sampling.method.place, style::category(sampling.method.place));
        if sampling.is_complete { marker } else { marker.hollow() }
    }
}

impl Figure for Oversampling<'_> {
    fn size(&self) -> (u32, u32) {
        (1200, 480)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (plots, key) = area.split_vertically((self.size().1 as i32 - 40) * FINE);
        let across = log_span(self.samplings.iter().map(|sampling| sampling.points));
        for ((title, value, ours), area) in PANELS.into_iter().zip(&plots.split_evenly((1, 4))) {
            let upward = span(self.samplings.iter().filter_map(value).chain(ours));
            let x = Axis::log("points a side of a leaf", across.clone());
            let mut panel = Panel::new(area, title, x, Axis::linear("", upward, 6), 60)?;
            if let Some(ours) = ours {
                panel.dashes(&[(across.start, ours), (across.end, ours)], GREY, FINE as u32)?;
            }
            for is_complete in [false, true] {
                let own = self
                    .samplings
                    .iter()
                    .filter(|sampling| sampling.is_complete == is_complete);
                let points: Vec<_> = own.filter_map(|one| Some((one, (one.points, value(one)?)))).collect();
                let Some((first, _)) = points.first() else { continue };
                let line: Vec<(f64, f64)> = points.iter().map(|(_, point)| *point).collect();
                let marker = Self::marker(first);
                panel.line(&line, marker.colour, FINE as u32)?;
                for point in line {
                    panel.marker(point, marker)?;
                }
            }
        }
        let entry = |is_complete: bool, words: &str| -> Option<Entry> {
            let first = self
                .samplings
                .iter()
                .find(|sampling| sampling.is_complete == is_complete)?;
            Some((Key::Series(Self::marker(first)), words.to_string()))
        };
        let entries = [
            entry(false, "sampled once"),
            entry(true, "until no gap is left"),
            Some((Key::Dashes(GREY), "biting".to_string())),
        ];
        legend_row(&key, 62, &entries.into_iter().flatten().collect::<Vec<_>>())
    }
}
