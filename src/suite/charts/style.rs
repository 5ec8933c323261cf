//! One look for all figures: sizes, colours and markers. Colours can be told apart by the colour-blind, and each
//! series has a marker of its own besides.

use super::canvas::{Area, Drawn, FINE, FONT};
use crate::suite::analysis::contest::Method;
use plotters::prelude::{Circle, Color, DrawingBackend, PathElement, Polygon, RGBColor, ShapeStyle, TextStyle};
use plotters::style::IntoFont;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Text and frames.
pub(super) const INK: RGBColor = RGBColor(40, 40, 40);
/// Lesser text and reference lines.
pub(super) const GREY: RGBColor = RGBColor(120, 120, 120);
/// Grid lines.
pub(super) const PALE: RGBColor = RGBColor(226, 226, 226);

/// Text heights in pixels of the finished picture.
pub(super) const TITLE: i32 = 23;
/// Axis and legend titles.
pub(super) const LABEL: i32 = 20;
/// Ticks, legends and notes.
pub(super) const SMALL: i32 = 18;
/// Numbers within a figure.
pub(super) const TINY: i32 = 15;

/// The first three of the categories, by name.
pub(super) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(super) const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub(super) const GREEN: RGBColor = RGBColor(0, 158, 115);

/// Okabe and Ito's colours, the black last and the yellow left out since it vanishes on white.
pub(super) const CATEGORIES: [RGBColor; 7] = [
    BLUE,
    VERMILION,
    GREEN,
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// The colour of the category with this index.
pub(super) fn category(index: usize) -> RGBColor {
    CATEGORIES[index % CATEGORIES.len()]
}

/// The marker of a method, in the colour of its mesher: the same in all figures. Hollow where parameters differ from the
/// mesher's defaults.
pub(super) fn method(method: &Method) -> Marker {
    mesher(method.place, method.is_default)
}

/// The same, by the mesher's place. Where colours come round again, shapes are others.
pub(super) fn mesher(place: usize, is_default: bool) -> Marker {
    let marker = Marker::new(place + place / CATEGORIES.len(), category(place));
    if is_default { marker } else { marker.hollow() }
}

/// The colour of item `index` of `count` ordered ones: viridis without its palest end.
pub(super) fn ordered(index: usize, count: usize) -> RGBColor {
    continuous(0.88 * index as f64 / count.saturating_sub(1).max(1) as f64)
}

/// Viridis at `share`, which is held to 0 … 1.
pub(super) fn continuous(share: f64) -> RGBColor {
    ViridisRGB.get_color(share.clamp(0.0, 1.0))
}

/// White on dark colours, ink on light ones.
pub(super) fn readable_on(colour: RGBColor) -> RGBColor {
    let RGBColor(r, g, b) = colour;
    let light = 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b);
    if light < 140.0 { RGBColor(255, 255, 255) } else { INK }
}

/// Text of `pixels` height, anchored.
pub(super) fn text(pixels: i32, colour: RGBColor, h: HPos, v: VPos) -> TextStyle<'static> {
    (FONT, FINE * pixels).into_font().color(&colour).pos(Pos::new(h, v))
}

/// A line of this colour, `width` in drawing units.
pub(super) fn stroke(colour: RGBColor, width: u32) -> ShapeStyle {
    colour.stroke_width(width)
}

/// Shapes of points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    Circle,
    Square,
    Up,
    Diamond,
    Down,
    /// Thick, so that hollow and filled differ as for the others.
    Plus,
    Times,
}

const SHAPES: [Shape; 7] = [
    Shape::Circle,
    Shape::Square,
    Shape::Up,
    Shape::Diamond,
    Shape::Down,
    Shape::Plus,
    Shape::Times,
];

/// The shape of the series with this index.
pub(super) fn shape(index: usize) -> Shape {
    SHAPES[index % SHAPES.len()]
}

/// A point of a series: filled, or hollow to mark it apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Marker {
    pub(super) shape: Shape,
    pub(super) colour: RGBColor,
    pub(super) filled: bool,
    /// Half its width, drawing units.
    pub(super) radius: i32,
}

impl Marker {
    /// The filled marker of series `index` in `colour`.
    pub(super) fn new(index: usize, colour: RGBColor) -> Self {
        Self {
            shape: shape(index),
            colour,
            filled: true,
            radius: 5 * FINE,
        }
    }

    /// The same, hollow.
    pub(super) fn hollow(self) -> Self {
        Self { filled: false, ..self }
    }

    /// Draws the marker at a place in `area`'s own drawing units.
    pub(super) fn draw<DB: DrawingBackend>(self, area: &Area<DB>, (x, y): (i32, i32)) -> Drawn {
        let line = stroke(self.colour, FINE as u32 + 1);
        let fill = self.colour.filled();
        let moved = |points: Vec<(i32, i32)>| points.into_iter().map(|p| (x + p.0, y + p.1)).collect::<Vec<_>>();
        match self.outline() {
            None => area.draw(&Circle::new((x, y), self.radius, if self.filled { fill } else { line }))?,
            Some(points) if self.filled => area.draw(&Polygon::new(moved(points), fill))?,
            Some(points) => area.draw(&PathElement::new(moved(points), line))?,
        }
        Ok(())
    }

    /// Corners around (0, 0), closed; absent for the circle.
    fn outline(self) -> Option<Vec<(i32, i32)>> {
        let r = self.radius;
        let s = r * 9 / 10;
        Some(match self.shape {
            Shape::Circle => return None,
            Shape::Square => vec![(-s, -s), (s, -s), (s, s), (-s, s), (-s, -s)],
            Shape::Up => vec![(0, -r - 1), (r + 1, s), (-r - 1, s), (0, -r - 1)],
            Shape::Down => vec![(0, r + 1), (r + 1, -s), (-r - 1, -s), (0, r + 1)],
            Shape::Diamond => vec![(0, -r - 2), (r + 2, 0), (0, r + 2), (-r - 2, 0), (0, -r - 2)],
            Shape::Plus => cross((0, r)),
            Shape::Times => cross((s * 9 / 10, s * 9 / 10)),
        })
    }
}

/// A cross with arms along `tip` and its turns by quarters, thick enough to be filled.
fn cross(tip: (i32, i32)) -> Vec<(i32, i32)> {
    let turned = |(x, y): (i32, i32)| (-y, x);
    let length = f64::from(tip.0).hypot(f64::from(tip.1));
    let half = 1.25 * f64::from(FINE) / length;
    let mut arm = tip;
    let mut points = Vec::new();
    for _ in 0..4 {
        let side = turned(arm);
        let (dx, dy) = (half * f64::from(side.0), half * f64::from(side.1));
        let at = |along: f64, across: f64| {
            let x = along * f64::from(arm.0) + across * dx;
            let y = along * f64::from(arm.1) + across * dy;
            (x.round() as i32, y.round() as i32)
        };
        points.extend([at(1.0, -1.0), at(1.0, 1.0), at(half, 1.0)]);
        arm = side;
    }
    points.push(points[0]);
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshers::MESHERS;
    use crate::suite::peers::PEERS;

    #[test]
    fn no_two_meshers_look_alike() {
        let looks: Vec<(RGBColor, Shape)> = (0..MESHERS.len() + PEERS.len())
            .map(|place| mesher(place, true))
            .map(|marker| (marker.colour, marker.shape))
            .collect();
        for (place, look) in looks.iter().enumerate() {
            assert!(!looks[..place].contains(look), "{place}: {look:?}");
        }
    }
}
