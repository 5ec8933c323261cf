//! From scenes to a picture.

use super::super::canvas::{Area, Drawn, FINE, FONT, Figure};
use super::super::style::{self, INK, LABEL, SMALL};
use super::labels::{self, Obstacles, Wanted};
use super::look::{self, Line};
use super::{Label, Scene, Shape, Sheet, clip};
use crate::geometry::{DVec2, Rect};
use plotters::prelude::{Circle, Color, DrawingBackend, PathElement, Polygon, RGBColor, Text};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{FontStyle, IntoFont};

/// Width of the sheet, height of a title, space around a scene: pixels.
const WIDTH: f64 = 1200.0;
const HEAD: f64 = 34.0;
const MARGIN: f64 = 9.0;

/// Heights of letters, and of those that are lowered, in pixels; and how far down these are.
const LETTER: i32 = LABEL;
const LOWERED: i32 = 14;
const DROP: f64 = 6.0;

/// Circles are drawn as polygons: how far sides may lie within the circle, in pixels. Shorter sides would be rougher, since
/// their ends are rounded.
const WITHIN: f64 = 0.12;

impl Sheet {
    fn columns(&self) -> usize {
        self.columns.clamp(1, self.scenes.len().max(1))
    }

    /// Height of the scenes of a row, in pixels, without its titles.
    fn row_heights(&self) -> Vec<f64> {
        let width = WIDTH / self.columns() as f64 - 2.0 * MARGIN;
        let height = |scene: &Scene| width * scene.window.size().y / scene.window.size().x;
        let rows = self.scenes.chunks(self.columns());
        rows.map(|row| row.iter().map(height).fold(1.0, f64::max).min(1100.0))
            .collect()
    }

    /// Height of the titles of each row, in pixels.
    fn heads(&self) -> Vec<f64> {
        let is_titled = |row: &[Scene]| row.iter().any(|scene| !scene.title.is_empty());
        let rows = self.scenes.chunks(self.columns());
        rows.map(|row| if is_titled(row) { HEAD } else { MARGIN }).collect()
    }

    /// Where each scene is, in pixels of the picture.
    fn frames(&self) -> Vec<Rect> {
        let (columns, mut top) = (self.columns(), 0.0);
        let width = WIDTH / columns as f64;
        let mut frames = Vec::new();
        for (row, (height, head)) in self.row_heights().into_iter().zip(self.heads()).enumerate() {
            let count = self.scenes.len().min((row + 1) * columns) - row * columns;
            frames.extend((0..count).map(|column| {
                let min = DVec2::new(column as f64 * width + MARGIN, top + head);
                Rect {
                    min,
                    max: min + DVec2::new(width - 2.0 * MARGIN, height),
                }
            }));
            top += head + height + MARGIN;
        }
        frames
    }

    /// For each scene where its labels stand and what they must not touch, in pixels.
    #[cfg(test)]
    pub(crate) fn placed(&self) -> Vec<(Rect, Vec<Rect>, Vec<Rect>)> {
        super::super::canvas::register();
        let scenes = self.scenes.iter().zip(self.frames());
        let placed = scenes.map(|(scene, frame)| {
            let view = View::new(scene, frame);
            (view.frame, view.label_boxes(scene), view.obstacles(scene).points)
        });
        placed.collect()
    }
}

impl Figure for Sheet {
    fn size(&self) -> (u32, u32) {
        let rows = self.row_heights().into_iter().zip(self.heads());
        let height: f64 = rows.map(|(height, head)| height + head + MARGIN).sum();
        (WIDTH as u32, height.ceil() as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        for (scene, frame) in self.scenes.iter().zip(self.frames()) {
            let view = View::new(scene, frame);
            let place = units(DVec2::new(frame.min.x, frame.min.y - 0.5 * HEAD));
            let look = style::text(SMALL, INK, HPos::Left, VPos::Center);
            area.draw(&Text::new(scene.title.clone(), place, look))?;
            for shape in &scene.shapes {
                view.paint(area, shape)?;
            }
            for (label, place) in scene.labels.iter().zip(view.label_boxes(scene)) {
                write_label(area, label, place)?;
            }
        }
        Ok(())
    }
}

/// From the plane to pixels: the same scale in both directions, y turned over.
struct View {
    centre: DVec2,
    middle: DVec2,
    scale: f64,
    /// The part of the picture that is drawn on.
    frame: Rect,
}

impl View {
    fn new(scene: &Scene, frame: Rect) -> Self {
        Self {
            centre: scene.window.centre(),
            middle: frame.centre(),
            scale: (frame.size() / scene.window.size()).min_element(),
            frame,
        }
    }

    fn place(&self, point: DVec2) -> DVec2 {
        let moved = self.scale * (point - self.centre);
        self.middle + DVec2::new(moved.x, -moved.y)
    }

    fn all(&self, points: &[DVec2]) -> Vec<DVec2> {
        points.iter().map(|&point| self.place(point)).collect()
    }

    /// The line of a shape that is one, in pixels.
    fn outline(&self, shape: &Shape) -> Option<(Vec<DVec2>, Line)> {
        Some(match shape {
            Shape::Line(points, pen) => (self.all(points), look::pen(*pen)),
            Shape::Arc(arc, pen) => {
                let radius = arc.disc.radius * self.scale;
                let sides = (arc.sweep * (radius / (8.0 * WITHIN)).sqrt()).ceil().clamp(4.0, 2000.0);
                (self.all(&arc.points(sides as usize)), look::pen(*pen))
            }
            Shape::Length(ends) => (self.all(ends), look::length()),
            Shape::Area(..) | Shape::Point(..) => return None,
        })
    }

    fn paint<DB: DrawingBackend>(&self, area: &Area<DB>, shape: &Shape) -> Drawn {
        match shape {
            Shape::Area(outline, fill) => self.paint_area(area, outline, look::fill(*fill))?,
            Shape::Point(at, mark) => {
                let (colour, radius) = look::mark(*mark);
                let place = self.place(*at);
                if self.frame.contains(place) {
                    let radius = (radius * f64::from(FINE)).round() as i32;
                    area.draw(&Circle::new(units(place), radius, colour.filled()))?;
                }
            }
            Shape::Length(ends) => {
                for arrow in arrows(ends.map(|end| self.place(end))) {
                    let corners: Vec<_> = arrow.into_iter().map(units).collect();
                    area.draw(&Polygon::new(corners, look::length().colour.filled()))?;
                }
            }
            Shape::Line(..) | Shape::Arc(..) => {}
        }
        let Some((points, line)) = self.outline(shape) else {
            return Ok(());
        };
        for part in clip::line(&points, self.frame) {
            for dash in dashes(&part, line.dashes) {
                let dash: Vec<_> = distinct(dash.into_iter().map(units));
                area.draw(&PathElement::new(dash, style::stroke(line.colour, line.width)))?;
            }
        }
        Ok(())
    }

    /// With a line around it in its own colour, so that no seam shows between two that touch.
    fn paint_area<DB: DrawingBackend>(&self, area: &Area<DB>, outline: &[DVec2], colour: RGBColor) -> Drawn {
        let mut corners = self.all(outline);
        // Turned over, it runs the other way round.
        corners.reverse();
        let corners = distinct(clip::convex(&corners, self.frame).into_iter().map(units));
        if corners.len() > 2 {
            let closed: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
            area.draw(&Polygon::new(corners, colour.filled()))?;
            area.draw(&PathElement::new(closed, style::stroke(colour, 2)))?;
        }
        Ok(())
    }

    fn obstacles(&self, scene: &Scene) -> Obstacles {
        let mut obstacles = Obstacles::default();
        for shape in &scene.shapes {
            if let Shape::Point(at, mark) = shape {
                let at = self.place(*at);
                let radius = look::mark(*mark).1 + 1.0;
                obstacles.points.push(labels::grown(Rect { min: at, max: at }, radius));
            }
            if let Some((points, line)) = self.outline(shape) {
                let parts = clip::line(&points, self.frame);
                let ends = parts.iter().flat_map(|part| part.windows(2));
                obstacles
                    .lines
                    .extend(ends.map(|ends| ([ends[0], ends[1]], line.weight)));
            }
        }
        obstacles
    }

    fn label_boxes(&self, scene: &Scene) -> Vec<Rect> {
        let wanted = scene.labels.iter().map(|label| Wanted {
            at: self.place(label.at),
            size: size(&label.words),
        });
        labels::place(&wanted.collect::<Vec<_>>(), &self.obstacles(scene), self.frame)
    }
}

/// To drawing units.
fn units(place: DVec2) -> (i32, i32) {
    let fine = place * f64::from(FINE);
    (fine.x.round() as i32, fine.y.round() as i32)
}

fn distinct(points: impl Iterator<Item = (i32, i32)>) -> Vec<(i32, i32)> {
    let mut points: Vec<_> = points.collect();
    points.dedup();
    points
}

/// Length and half width of an arrow's head in pixels.
const ARROW: [f64; 2] = [9.0, 3.2];

/// The heads of a length's two arrows; none where there is no room for them.
fn arrows(ends: [DVec2; 2]) -> Vec<Vec<DVec2>> {
    let along = ends[1] - ends[0];
    if along.length() < 3.0 * ARROW[0] {
        return Vec::new();
    }
    let (along, across) = (along.normalize(), along.normalize().perp());
    let head = |tip: DVec2, back: DVec2| {
        let foot = tip + ARROW[0] * back;
        vec![tip, foot + ARROW[1] * across, foot - ARROW[1] * across]
    };
    vec![head(ends[0], along), head(ends[1], -along)]
}

/// A line cut into dashes.
fn dashes(points: &[DVec2], pattern: Option<[f64; 2]>) -> Vec<Vec<DVec2>> {
    let Some(pattern) = pattern else {
        return vec![points.to_vec()];
    };
    let (mut phase, mut left) = (0, pattern[0]);
    let mut parts = vec![vec![points[0]]];
    for ends in points.windows(2) {
        let (mut from, to) = (ends[0], ends[1]);
        while from.distance(to) > left {
            from += left * (to - from).normalize();
            match phase {
                0 => parts.last_mut().into_iter().for_each(|part| part.push(from)),
                _ => parts.push(vec![from]),
            }
            phase = 1 - phase;
            left = pattern[phase];
        }
        left -= from.distance(to);
        if phase == 0 {
            parts.last_mut().into_iter().for_each(|part| part.push(to));
        }
    }
    parts.retain(|part| part.len() > 1);
    parts
}

/// A label's words in runs: whether lowered, and the letters.
fn runs(words: &str) -> Vec<(bool, String)> {
    let mut runs: Vec<(bool, String)> = Vec::new();
    let (mut lowered, mut braces) = (false, false);
    for letter in words.chars() {
        match letter {
            '_' => lowered = true,
            '{' if lowered => braces = true,
            '}' if braces => (lowered, braces) = (false, false),
            _ => {
                match runs.last_mut().filter(|run| run.0 == lowered) {
                    Some(run) => run.1.push(letter),
                    None => runs.push((lowered, letter.into())),
                }
                lowered = lowered && braces;
            }
        }
    }
    runs
}

fn letter_height(lowered: bool) -> i32 {
    if lowered { LOWERED } else { LETTER }
}

/// Width of a run in pixels.
fn run_width(lowered: bool, letters: &str) -> f64 {
    let font = (FONT, FINE * letter_height(lowered))
        .into_font()
        .style(FontStyle::Normal);
    // A blank at an end has no box of its own.
    let blanks = letters.len() - letters.trim_end().len();
    let width = font
        .box_size(letters.trim_end())
        .map_or(0.0, |(width, _)| f64::from(width));
    width / f64::from(FINE) + 0.32 * f64::from(letter_height(lowered)) * blanks as f64 + 0.8
}

/// Width and height of a label in pixels.
fn size(words: &str) -> DVec2 {
    let width: f64 = runs(words)
        .iter()
        .map(|(lowered, letters)| run_width(*lowered, letters))
        .sum();
    let has_lowered = runs(words).iter().any(|run| run.0);
    DVec2::new(
        width,
        0.8 * f64::from(LETTER) + if has_lowered { 0.7 * DROP } else { 0.0 },
    )
}

fn write_label<DB: DrawingBackend>(area: &Area<DB>, label: &Label, place: Rect) -> Drawn {
    let mut left = place.min.x;
    let middle = place.min.y + 0.4 * f64::from(LETTER);
    let (colour, _) = look::mark(label.mark);
    for (lowered, letters) in runs(&label.words) {
        let drop = if lowered { DROP } else { 0.0 };
        let look = style::text(letter_height(lowered), colour, HPos::Left, VPos::Center);
        // SVG drops blanks at the beginning of a text.
        let shown = letters.trim_start();
        let blank = run_width(lowered, &letters) - run_width(lowered, shown);
        let place = units(DVec2::new(left + blank, middle + drop));
        area.draw(&Text::new(shown.to_owned(), place, look))?;
        left += run_width(lowered, &letters);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lowered_letters_are_runs_of_their_own() {
        let run = |lowered, letters: &str| (lowered, letters.to_string());
        assert_eq!(
            runs("c_b f(p_1)"),
            [
                run(false, "c"),
                run(true, "b"),
                run(false, " f(p"),
                run(true, "1"),
                run(false, ")")
            ]
        );
        assert_eq!(runs("h_{max} x"), [run(false, "h"), run(true, "max"), run(false, " x")]);
    }

    #[test]
    fn dashes_keep_their_lengths_around_corners() {
        let points = [(0.0, 0.0), (5.0, 0.0), (5.0, 5.0)].map(DVec2::from);
        let parts = dashes(&points, Some([3.0, 1.0]));
        let length = |part: &Vec<DVec2>| part.windows(2).map(|ends| ends[0].distance(ends[1])).sum::<f64>();
        let lengths: Vec<f64> = parts.iter().map(length).collect();
        assert_eq!(lengths, [3.0, 3.0, 2.0]);
        assert_eq!(parts[1], [(4.0, 0.0), (5.0, 0.0), (5.0, 2.0)].map(DVec2::from));
    }
}
