//! Which (t, c_b) gives the fewest triangles for a given smallest angle.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::{Entry, Key, legend};
use super::panel::{Axis, Panel, log_span, span};
use super::size::{c_b_entries, c_b_marker};
use super::style::{self, GREY, INK, TINY};
use crate::suite::analysis::measures::SIZE_RATIO_LFS;
use crate::suite::analysis::summary::{Pair, unbeaten_pairs};
use crate::suite::rows::numbers::distinct;
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};
use std::ops::Range;
use std::path::Path;

/// Draws triangles / ∫ dA / lfs² against the smallest angle, one point for each (t, c_b), those that no other beats in
/// both joined and labelled with their t.
///
/// # Errors
/// [`ChartError`].
pub fn fewest(pairs: &[Pair], stem: &Path) -> Result<(), ChartError> {
    write_both(&Fewest { pairs }, stem)
}

struct Fewest<'a> {
    pairs: &'a [Pair],
}

/// Space a label needs, in drawing units.
const LABEL_SIZE: (i32, i32) = (72 * FINE, 20 * FINE);

impl Figure for Fewest<'_> {
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1200 - 190) * FINE);
        let c_bs = distinct(self.pairs.iter().map(|pair| pair.c_b));
        let Range { start, end } = span(self.pairs.iter().map(|pair| pair.smallest_angle_deg));
        // Room for the label of the rightmost point.
        let across = start..end + 0.06 * (end - start);
        let upward = log_span(self.pairs.iter().map(|pair| pair.size_ratio_lfs));
        let x = Axis::linear("smallest angle over the domains (degrees)", across, 8);
        let mut panel = Panel::new(&left, "", x, Axis::log(SIZE_RATIO_LFS.title, upward), 86)?;
        let place = |pair: &Pair| (pair.smallest_angle_deg, pair.size_ratio_lfs);
        let best = unbeaten_pairs(self.pairs);
        panel.dashes(&best.iter().map(place).collect::<Vec<_>>(), GREY, FINE as u32)?;
        // The best last: pairs may coincide, where the limited spacing is the same.
        let others = self.pairs.iter().filter(|pair| !best.contains(pair));
        for (pair, is_best) in others
            .map(|pair| (pair, false))
            .chain(best.iter().map(|pair| (pair, true)))
        {
            let index = c_bs.iter().position(|c_b| *c_b == pair.c_b).unwrap_or(0);
            let marker = c_b_marker(index, c_bs.len());
            panel.marker(place(pair), if is_best { marker } else { marker.hollow() })?;
        }
        let mut taken: Vec<(i32, i32)> = Vec::new();
        for pair in &best {
            let (x, y) = panel.pixel(place(pair));
            let free = |other: &(i32, i32)| (x - other.0).abs() > LABEL_SIZE.0 || (y - other.1).abs() > LABEL_SIZE.1;
            if taken.iter().all(free) {
                taken.push((x, y));
                let words = format!("t = {}", (pair.t * 1e3).round() / 1e3);
                panel.text(
                    place(pair),
                    (9, 6),
                    &words,
                    style::text(TINY, INK, HPos::Left, VPos::Top),
                )?;
            }
        }
        let mut entries: Vec<Entry> = c_b_entries(&c_bs, Key::Point);
        entries.push((Key::Heading, String::new()));
        entries.push((Key::Dashes(GREY), "fewest".into()));
        legend(&right, 40, &entries)
    }
}
