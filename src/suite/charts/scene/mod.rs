//! Geometric drawings: circles, arcs, lines, areas, points and lengths in the domain's coordinates, with labels that are
//! placed so that none collides.
//!
//! A [`Scene`] says what is to be seen, by what it means ([`Pen`], [`Fill`], [`Mark`]); how that looks is in `look.rs`, where
//! labels go in `labels.rs`.

mod clip;
pub(crate) mod labels;
mod look;
mod paint;

use super::canvas::{ChartError, write_both};
use crate::geometry::near::Disc;
use crate::geometry::{DVec2, Rect};
use std::path::Path;

/// What a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pen {
    /// The boundary of the domain, and inner segments.
    Boundary,
    /// The front.
    Front,
    /// A biting circle.
    Biting,
    /// A biting circle of lesser interest.
    Pale,
    /// The circle that the figure is about.
    Newest,
    /// A circle that was tried and not bitten.
    Tried,
    /// A packing circle.
    Packing,
    /// The extended circle.
    Extended,
    /// A circumcircle.
    Circumcircle,
    /// Sides of the triangle that the figure is about.
    Triangle,
    /// Edges of the mesh.
    Edge,
    /// A line of sight.
    Sight,
    /// Auxiliary lines.
    Auxiliary,
}

/// What an area is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    /// What is left of the domain.
    Uneaten,
    /// The inside of the domain, where nothing is eaten.
    Domain,
    /// What has been bitten away.
    Eaten,
    /// What was bitten away last.
    Newest,
    /// The triangle that the figure is about.
    Triangle,
}

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A centre of a biting circle, a mesh vertex.
    Centre,
    /// One of lesser interest.
    Pale,
    /// The one that the figure is about.
    Newest,
    /// A point that is no centre.
    Place,
}

/// Something to draw, in the domain's coordinates.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A convex polygon, filled.
    Area(Vec<DVec2>, Fill),
    /// A line through points.
    Line(Vec<DVec2>, Pen),
    /// An arc of a circle, counter-clockwise.
    Arc(Arc, Pen),
    /// A point.
    Point(DVec2, Mark),
    /// A length between two points, with an arrow at each end.
    Length([DVec2; 2]),
}

/// An arc of a circle, counter-clockwise from the angle `start` through `sweep`, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// The circle.
    pub disc: Disc,
    /// Where it begins.
    pub start: f64,
    /// How far it goes, in (0, 2π].
    pub sweep: f64,
}

impl Arc {
    /// The whole circle.
    pub fn whole(disc: Disc) -> Self {
        Self {
            disc,
            start: 0.0,
            sweep: std::f64::consts::TAU,
        }
    }

    /// The point at a share of the arc, from 0 to 1.
    pub fn at(&self, share: f64) -> DVec2 {
        self.disc.centre + self.disc.radius * DVec2::from_angle(self.start + share * self.sweep)
    }

    /// `count` + 1 points along it.
    pub fn points(&self, count: usize) -> Vec<DVec2> {
        (0..=count).map(|k| self.at(k as f64 / count as f64)).collect()
    }
}

/// Words beside a point. `_` before a letter, or before several in braces, lowers them: `c_b f(p_1)`, `h_{max}`.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The words.
    pub words: String,
    /// What they stand beside.
    pub at: DVec2,
    /// In whose colour they are set.
    pub mark: Mark,
}

/// One drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Stands above it.
    pub title: String,
    /// What is shown of the plane.
    pub window: Rect,
    /// What is drawn, in order.
    pub shapes: Vec<Shape>,
    /// Words, placed around all else.
    pub labels: Vec<Label>,
}

impl Scene {
    /// An empty one.
    pub fn new(title: impl Into<String>, window: Rect) -> Self {
        Self {
            title: title.into(),
            window,
            shapes: Vec::new(),
            labels: Vec::new(),
        }
    }

    /// Adds an area.
    pub fn area(&mut self, outline: impl IntoIterator<Item = DVec2>, fill: Fill) {
        self.shapes.push(Shape::Area(outline.into_iter().collect(), fill));
    }

    /// Adds a line.
    pub fn line(&mut self, points: impl IntoIterator<Item = DVec2>, pen: Pen) {
        self.shapes.push(Shape::Line(points.into_iter().collect(), pen));
    }

    /// Adds a circle, if it comes near the window.
    pub fn circle(&mut self, disc: Disc, pen: Pen) {
        if self.window.distance(disc.centre) <= disc.radius {
            self.shapes.push(Shape::Arc(Arc::whole(disc), pen));
        }
    }

    /// Adds arcs.
    pub fn arcs(&mut self, arcs: impl IntoIterator<Item = Arc>, pen: Pen) {
        self.shapes.extend(arcs.into_iter().map(|arc| Shape::Arc(arc, pen)));
    }

    /// Adds a point.
    pub fn point(&mut self, at: DVec2, mark: Mark) {
        self.shapes.push(Shape::Point(at, mark));
    }

    /// Adds a point with words beside it.
    pub fn named_point(&mut self, at: DVec2, mark: Mark, words: impl Into<String>) {
        self.point(at, mark);
        let words = words.into();
        self.labels.push(Label { words, at, mark });
    }

    /// Adds a length with words beside its middle.
    pub fn length(&mut self, ends: [DVec2; 2], words: impl Into<String>) {
        self.shapes.push(Shape::Length(ends));
        self.labels.push(Label {
            words: words.into(),
            at: ends[0].midpoint(ends[1]),
            mark: Mark::Place,
        });
    }
}

/// Drawings side by side, in rows of `columns`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// How many stand in a row.
    pub columns: usize,
    /// The drawings.
    pub scenes: Vec<Scene>,
}

impl Sheet {
    /// Writes `stem.svg` and `stem.png`.
    ///
    /// # Errors
    /// [`ChartError`].
    pub fn write(&self, stem: &Path) -> Result<(), ChartError> {
        write_both(self, stem)
    }

    /// Writes the SVG alone.
    #[cfg(test)]
    pub(crate) fn write_svg(&self, path: &Path) -> Result<(), ChartError> {
        super::canvas::write_svg(self, path)
    }
}

/// Sides of the polygon that a disc is filled as.
const SIDES: usize = 120;

/// The part of a disc in a counter-clockwise triangle, as a convex polygon; empty where there is none.
pub fn within(disc: &Disc, triangle: &[DVec2; 3]) -> Vec<DVec2> {
    let mut polygon = Arc::whole(*disc).points(SIDES);
    polygon.pop();
    (0..3).fold(polygon, |rest, k| {
        clip::left_of(&rest, [triangle[k], triangle[(k + 1) % 3]])
    })
}
