//! What a figure is made of: its picture, its caption and the numbers that both come from.

use crate::domain::Domain;
use crate::geometry::near::Disc;
use crate::geometry::{DVec2, Rect};
use crate::suite::charts::ChartError;
use crate::suite::charts::scene::{Arc, Fill, Mark, Pen, Scene, Sheet};
use serde_json::{Map, Value};
use std::path::Path;

use super::front;
use super::run::Run;

/// Draws to a stem, to which `.svg` and `.png` are added.
pub(super) type Draw<'a> = Box<dyn Fn(&Path) -> Result<(), ChartError> + 'a>;

/// How a figure's picture is made.
pub(super) enum Picture<'a> {
    /// From scenes.
    Sheet(Sheet),
    /// From a chart of its own.
    Chart(Draw<'a>),
}

/// A figure, ready to be written.
pub(super) struct Drawing<'a> {
    pub picture: Picture<'a>,
    /// What is to be seen, in Markdown.
    pub caption: String,
    /// What it was drawn from.
    pub numbers: Numbers,
    /// Commands that make the meshes in it.
    pub commands: Vec<String>,
}

/// Numbers by name, in order, to twelve digits: enough to show any difference, and few enough to be read.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Numbers(Map<String, Value>);

impl Numbers {
    pub fn with(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.0.insert(name.to_owned(), value.into());
        self
    }

    pub fn number(self, name: &str, value: f64) -> Self {
        self.with(name, rounded(value))
    }

    pub fn point(self, name: &str, point: DVec2) -> Self {
        self.with(name, place(point))
    }

    pub fn points(self, name: &str, points: &[DVec2]) -> Self {
        let points: Vec<Value> = points.iter().map(|&point| place(point)).collect();
        self.with(name, points)
    }

    /// A circle: its centre and its radius.
    pub fn disc(self, name: &str, disc: &Disc) -> Self {
        let value = Self::default()
            .point("centre", disc.centre)
            .number("radius", disc.radius);
        self.with(name, value)
    }

    /// What was asked of a run, and a hash of the mesh that came out.
    pub fn run(self, run: &Run) -> Self {
        self.with("domain", run.asked.domain.clone())
            .number("t", run.asked.t)
            .number("t_effective", run.case.t())
            .number("c_b", run.asked.c_b)
            .with("mesh", run.fingerprint())
    }
}

impl From<Numbers> for Value {
    fn from(numbers: Numbers) -> Self {
        Self::Object(numbers.0)
    }
}

fn place(point: DVec2) -> Value {
    vec![rounded(point.x), rounded(point.y)].into()
}

/// To twelve digits; −0 is 0.
fn rounded(value: f64) -> Value {
    let text = format!("{value:.11e}");
    text.parse::<f64>().map_or(Value::Null, |value| (value + 0.0).into())
}

/// The smallest box around circles, with a margin as a share of its larger side.
pub(super) fn around(discs: &[Disc], margin: f64) -> Rect {
    let corners = discs
        .iter()
        .flat_map(|disc| [disc.centre - disc.radius, disc.centre + disc.radius]);
    let tight = Rect::around(corners);
    let margin = margin * tight.size().max_element();
    Rect {
        min: tight.min - margin,
        max: tight.max + margin,
    }
}

/// What to show of circles on a level segment with the domain above: what of them is inside, and room for names below.
pub(super) fn above(domain: &Domain, discs: &[Disc], level: f64) -> Rect {
    let arcs = discs.iter().flat_map(|disc| front::in_domain(domain, disc));
    let points = arcs
        .flat_map(|arc| arc.points(64))
        .chain(discs.iter().map(|disc| disc.centre));
    let tight = Rect::around(points);
    let width = tight.size().x;
    Rect {
        min: DVec2::new(tight.min.x - 0.03 * width, level - 0.07 * width),
        max: tight.max + 0.03 * width,
    }
}

/// The domain as ground: its inside tinted, its segments drawn.
pub(super) fn ground(scene: &mut Scene, run: &Run, fill: Fill) {
    for corners in &run.ground {
        scene.area(*corners, fill);
    }
    segments(scene, &run.case.domain);
}

/// The domain's segments.
pub(super) fn segments(scene: &mut Scene, domain: &Domain) {
    for segment in 0..domain.segments().len() {
        scene.line(domain.ends(segment), Pen::Boundary);
    }
}

/// What of a circle is inside the domain.
pub(super) fn circle(scene: &mut Scene, domain: &Domain, disc: &Disc, pen: Pen) {
    scene.arcs(front::in_domain(domain, disc), pen);
}

/// The edges of the mesh that reach into the window.
pub(super) fn edges(scene: &mut Scene, run: &Run) {
    let window = scene.window;
    let near = |t: &usize| run.mesh.corners(*t).iter().any(|corner| window.contains(*corner));
    for t in (0..run.mesh.triangles.len()).filter(near) {
        let [a, b, c] = run.mesh.corners(t);
        scene.line([a, b, c, a], Pen::Edge);
    }
}

/// Other centres in the window, without names.
pub(super) fn other_centres(scene: &mut Scene, run: &Run, named: &[DVec2]) {
    let window = scene.window;
    let others = run.bites.iter().map(|bite| bite.centre);
    for centre in others.filter(|centre| window.contains(*centre) && !named.contains(centre)) {
        scene.point(centre, Mark::Pale);
    }
}

/// A radius of `disc`, drawn in a direction, with words.
pub(super) fn radius(scene: &mut Scene, disc: &Disc, angle_deg: f64, words: &str) {
    let end = Arc {
        disc: *disc,
        start: angle_deg.to_radians(),
        sweep: 1.0,
    };
    scene.length([disc.centre, end.at(0.0)], words);
}
