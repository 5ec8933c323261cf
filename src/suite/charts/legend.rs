//! Legends: beside the data, never on it.

use super::canvas::{Area, Drawn, FINE};
use super::style::{self, INK, LABEL, Marker, SMALL};
use plotters::prelude::{Color, DrawingBackend, PathElement, RGBColor, Rectangle, Text};
use plotters::style::text_anchor::{HPos, VPos};
use std::ops::Range;

/// What stands before an entry's words.
#[derive(Clone, Copy, Debug)]
pub(super) enum Key {
    /// A point.
    Point(Marker),
    /// A point on its line.
    Series(Marker),
    /// A line alone.
    Line(RGBColor),
    /// A dashed line.
    Dashes(RGBColor),
    /// A heading has none.
    Heading,
}

/// One line of a legend.
pub(super) type Entry = (Key, String);

/// Height of a line in pixels.
const STEP: i32 = 27;

/// Draws `entries` down `area`, from `top` pixels.
pub(super) fn legend<DB: DrawingBackend>(area: &Area<DB>, top: i32, entries: &[Entry]) -> Drawn {
    for (line, (key, words)) in entries.iter().enumerate() {
        let y = FINE * (top + STEP * line as i32);
        let rail = vec![(4 * FINE, y), (32 * FINE, y)];
        match key {
            Key::Point(marker) => marker.draw(area, (18 * FINE, y))?,
            Key::Series(marker) => {
                area.draw(&PathElement::new(rail, style::stroke(marker.colour, FINE as u32)))?;
                marker.draw(area, (18 * FINE, y))?;
            }
            Key::Line(colour) => area.draw(&PathElement::new(rail, style::stroke(*colour, 2 * FINE as u32)))?,
            Key::Dashes(colour) => {
                for start in [4, 15, 26] {
                    let dash = vec![(start * FINE, y), ((start + 7) * FINE, y)];
                    area.draw(&PathElement::new(dash, style::stroke(*colour, FINE as u32 + 1)))?;
                }
            }
            Key::Heading => {
                let look = style::text(LABEL, INK, HPos::Left, VPos::Center);
                area.draw(&Text::new(words.clone(), (4 * FINE, y), look))?;
                continue;
            }
        }
        let look = style::text(SMALL, INK, HPos::Left, VPos::Center);
        area.draw(&Text::new(words.clone(), (42 * FINE, y), look))?;
    }
    Ok(())
}

/// A colour bar down the left of `area` with numbers beside it; `ticks` are values of `range` and their words.
pub(super) fn colour_bar<DB: DrawingBackend>(
    area: &Area<DB>,
    title: &str,
    range: Range<f64>,
    ticks: &[(f64, String)],
    bands: usize,
) -> Drawn {
    let height = area.dim_in_pixel().1 as i32;
    let (top, bottom) = (50 * FINE, height - 64 * FINE);
    let heading = style::text(LABEL, INK, HPos::Left, VPos::Center);
    area.draw(&Text::new(title.to_string(), (4 * FINE, top - 28 * FINE), heading))?;
    let at = |share: f64| bottom - (share * f64::from(bottom - top)).round() as i32;
    for band in 0..bands {
        let (low, high) = (band as f64 / bands as f64, (band + 1) as f64 / bands as f64);
        let colour = style::continuous((low + high) / 2.0);
        let corners = [(4 * FINE, at(high)), (28 * FINE, at(low))];
        area.draw(&Rectangle::new(corners, colour.filled()))?;
    }
    for (value, words) in ticks {
        let y = at((value - range.start) / (range.end - range.start));
        area.draw(&PathElement::new(
            vec![(28 * FINE, y), (34 * FINE, y)],
            style::stroke(INK, FINE as u32),
        ))?;
        let look = style::text(SMALL, INK, HPos::Left, VPos::Center);
        area.draw(&Text::new(words.clone(), (40 * FINE, y), look))?;
    }
    Ok(())
}

/// Room for a letter of an entry, and for what stands before its words and after them, in pixels.
const LETTER: i32 = 10;
const AROUND: i32 = 70;

/// Where `entries` stand side by side from `left` on in `width` pixels: in which row each, and how many pixels from the left.
fn places(left: i32, width: i32, entries: &[Entry]) -> Vec<(i32, i32)> {
    let (mut row, mut x) = (0, left);
    let mut places = Vec::new();
    for (_, words) in entries {
        let own = LETTER * words.chars().count() as i32 + AROUND;
        if x > left && x + own > width {
            (row, x) = (row + 1, left);
        }
        places.push((row, x));
        x += own;
    }
    places
}

/// How many pixels more than one row `entries` need from `left` on in a figure so wide.
pub(super) fn further_rows(left: i32, width: u32, entries: &[Entry]) -> i32 {
    let places = places(left, width as i32, entries);
    STEP * places.last().map_or(0, |(row, _)| *row)
}

/// Draws `entries` side by side along `area`, from `left` pixels, in as many rows as they need.
pub(super) fn legend_row<DB: DrawingBackend>(area: &Area<DB>, left: i32, entries: &[Entry]) -> Drawn {
    let width = area.dim_in_pixel().0 as i32 / FINE;
    for ((row, x), entry) in places(left, width, entries).into_iter().zip(entries) {
        let (_, rest) = area.split_horizontally(x * FINE);
        legend(&rest, 16 + STEP * row, std::slice::from_ref(entry))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_that_do_not_fit_stand_in_further_rows() {
        // Each is 30 + 70 pixels wide.
        let entries: Vec<Entry> = (0..5).map(|_| (Key::Line(INK), "abc".to_string())).collect();
        assert_eq!(
            places(50, 260, &entries),
            [(0, 50), (0, 150), (1, 50), (1, 150), (2, 50)]
        );
        assert_eq!(further_rows(50, 260, &entries), 2 * STEP);
        assert_eq!(further_rows(50, 1200, &entries), 0);
        assert_eq!(
            places(50, 60, &entries[..2]),
            [(0, 50), (1, 50)],
            "one that never fits has a row of its own"
        );
    }
}
