//! How what a scene means looks: one place for all figures.

use super::super::style::{BLUE, GREEN, GREY, INK, VERMILION};
use super::{Fill, Mark, Pen};
use plotters::prelude::RGBColor;

/// A line's look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub colour: RGBColor,
    /// Width in drawing units.
    pub width: u32,
    /// Lengths of dash and gap in pixels.
    pub dashes: Option<[f64; 2]>,
    /// What a label pays for a pixel of it that it covers.
    pub weight: f64,
}

const PURPLE: RGBColor = RGBColor(160, 80, 140);

pub(super) fn pen(pen: Pen) -> Line {
    let line = |colour, width, weight| Line {
        colour,
        width,
        dashes: None,
        weight,
    };
    let dashed = |line: Line, dash, gap| Line {
        dashes: Some([dash, gap]),
        ..line
    };
    match pen {
        Pen::Boundary => line(INK, 5, 3.0),
        Pen::Front => line(VERMILION, 6, 3.0),
        Pen::Biting => line(BLUE, 3, 1.5),
        Pen::Pale => line(RGBColor(165, 185, 205), 2, 0.4),
        Pen::Newest => line(VERMILION, 5, 2.0),
        Pen::Tried => dashed(line(BLUE, 3, 1.5), 8.0, 6.0),
        Pen::Packing => line(GREEN, 4, 2.0),
        Pen::Extended => dashed(line(PURPLE, 4, 2.0), 12.0, 6.0),
        Pen::Circumcircle => dashed(line(PURPLE, 4, 1.5), 12.0, 6.0),
        Pen::Triangle => line(VERMILION, 4, 2.0),
        Pen::Edge => line(RGBColor(190, 190, 190), 2, 0.3),
        Pen::Sight => dashed(line(GREY, 3, 1.5), 4.0, 5.0),
        Pen::Auxiliary => line(GREY, 2, 1.0),
    }
}

/// Arrows of lengths.
pub(super) fn length() -> Line {
    Line {
        colour: INK,
        width: 3,
        dashes: None,
        weight: 8.0,
    }
}

pub(super) fn fill(fill: Fill) -> RGBColor {
    match fill {
        Fill::Uneaten => RGBColor(250, 232, 190),
        Fill::Domain => RGBColor(252, 246, 232),
        Fill::Eaten => RGBColor(233, 237, 241),
        Fill::Newest => RGBColor(190, 217, 238),
        Fill::Triangle => RGBColor(250, 216, 192),
    }
}

/// A point's colour and radius in pixels.
pub(super) fn mark(mark: Mark) -> (RGBColor, f64) {
    match mark {
        Mark::Centre => (BLUE, 4.5),
        Mark::Pale => (RGBColor(140, 160, 180), 2.5),
        Mark::Newest => (VERMILION, 5.0),
        Mark::Place => (INK, 4.0),
    }
}
