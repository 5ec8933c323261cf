//! Figure 1: the scheme on one domain, from the PSLG to a layer of the interior.

use super::drawing::{Drawing, Numbers, Picture};
use super::front;
use super::run::{Asked, Run, short};
use crate::domain::{self, Domain};
use crate::geometry::near::Disc;
use crate::geometry::{DVec2, Rect};
use crate::meshers::biting::Order;
use crate::meshers::{Bite, Reason};
use crate::suite::charts::scene::{Arc, Fill, Mark, Pen, Scene, Sheet, within};

/// The domain is searched for among these random polygons.
const VERTICES: [usize; 3] = [7, 8, 9];
const SEEDS: u64 = 1000;

/// Circles large enough to be seen.
const T: f64 = 0.25;
const C_B: f64 = 0.6;

/// The scheme, step by step.
pub(super) struct Figure1 {
    pub run: Run,
    pub panels: Vec<Panel>,
}

/// What the domain looks like after some bites.
pub(super) struct Panel {
    pub title: &'static str,
    /// Bites made so far, and by the panel before.
    pub bitten: usize,
    pub bitten_before: usize,
    pub front_arcs: Vec<(usize, Arc)>,
    pub front_pieces: Vec<[DVec2; 2]>,
}

/// Finds the domain, bites it, and stops where the paper does.
pub(super) fn find() -> Result<Figure1, String> {
    let (name, domain) = choose_domain().ok_or("no random polygon has a notch and no angle under 90°")?;
    let asked = Asked {
        domain: name,
        t: T,
        c_b: C_B,
        order: Order::Fifo,
    };
    let run = Run::on(domain, asked)?;
    let stops = stops(&run.bites).ok_or("the run has no bite in the interior")?;
    let mut before = 0;
    let panels = TITLES.iter().zip(stops).map(|(title, bitten)| {
        let discs = run.discs(bitten);
        let panel = Panel {
            title,
            bitten,
            bitten_before: before,
            front_arcs: front::arcs(&run.case.domain, &discs),
            front_pieces: front::pieces(&run.case.domain, &discs),
        };
        before = bitten;
        panel
    });
    let panels = panels.collect();
    Ok(Figure1 { run, panels })
}

const TITLES: [&str; 6] = [
    "(a) the domain, all of it front",
    "(b) every vertex is bitten",
    "(c) the first bite at another point",
    "(d) a layer of the boundary",
    "(e) the first bite in the interior",
    "(f) a layer of the interior",
];

/// The polygon that reads best: one with a notch and no angle under 90°, its shortest side longest, for its size.
fn choose_domain() -> Option<(String, Domain)> {
    let names = VERTICES
        .iter()
        .flat_map(|n| (0..SEEDS).map(move |seed| format!("random-simple:n={n},seed={seed}")));
    let loaded = names.filter_map(|name| Some((domain::load(&name).ok().filter(Domain::has_no_acute_angle)?, name)));
    let notched = loaded.filter(|(domain, _)| has_notch(domain));
    let best = notched.max_by(|a, b| shortest_side(&a.0).total_cmp(&shortest_side(&b.0)));
    best.map(|(domain, name)| (name, domain))
}

fn has_notch(domain: &Domain) -> bool {
    let wedges = (0..domain.vertices().len()).flat_map(|v| domain.wedges(v));
    wedges
        .filter(|wedge| wedge.inside)
        .any(|wedge| wedge.angle > 1.1 * std::f64::consts::PI)
}

fn shortest_side(domain: &Domain) -> f64 {
    let sides = (0..domain.segments().len()).map(|s| domain.ends(s)[0].distance(domain.ends(s)[1]));
    sides.fold(f64::INFINITY, f64::min) / domain.area().sqrt()
}

/// After how many bites each panel is drawn. Boundary circles are of layer 0, and a circle centred where two others meet is of the
/// layer after the later one's; in the order `fifo` layers come one after another.
fn stops(bites: &[Bite]) -> Option<[usize; 6]> {
    let vertices = bites
        .iter()
        .take_while(|bite| bite.reason == Reason::InputVertex)
        .count();
    let interior = bites.iter().position(|bite| bite.reason == Reason::FrontVertex)?;
    let layer = layers(bites).iter().position(|layer| *layer > 1).unwrap_or(bites.len());
    Some([0, vertices, vertices + 1, interior, interior + 1, layer])
}

/// The layer of every bite.
pub(super) fn layers(bites: &[Bite]) -> Vec<usize> {
    let waiting: Vec<_> = bites.iter().flat_map(|bite| &bite.appeared).collect();
    let mut layers: Vec<usize> = Vec::new();
    for bite in bites {
        let chosen = bite.gone.first().filter(|_| bite.reason == Reason::FrontVertex);
        let vertex = chosen.and_then(|serial| waiting.iter().find(|vertex| vertex.serial == *serial));
        let layer = vertex.map_or(0, |vertex| {
            let circles = vertex.circles.iter().filter_map(|circle| layers.get(*circle as usize));
            circles.max().map_or(0, |layer| layer + 1)
        });
        layers.push(layer);
    }
    layers
}

impl Figure1 {
    fn scene(&self, panel: &Panel) -> Scene {
        let Run { case, bites, .. } = &self.run;
        let domain = &*case.domain;
        let bounds = domain.bounds();
        let margin = 0.03 * bounds.size().max_element();
        let window = Rect {
            min: bounds.min - margin,
            max: bounds.max + margin,
        };
        let mut scene = Scene::new(panel.title, window);
        let (old, new) = (0..panel.bitten_before, panel.bitten_before..panel.bitten);
        for corners in &self.run.ground {
            scene.area(*corners, Fill::Uneaten);
        }
        // What was eaten before covers what is eaten now: a bite takes what is left.
        for (range, fill) in [(new.clone(), Fill::Newest), (old.clone(), Fill::Eaten)] {
            for disc in range.map(|k| self.run.disc(k)) {
                for corners in &self.run.ground {
                    scene.area(within(&disc, corners), fill);
                }
            }
        }
        for (range, pen) in [(old.clone(), Pen::Pale), (new.clone(), Pen::Biting)] {
            for disc in range.map(|k| self.run.disc(k)) {
                scene.arcs(front::in_domain(domain, &disc), pen);
            }
        }
        super::drawing::segments(&mut scene, domain);
        for piece in &panel.front_pieces {
            scene.line(*piece, Pen::Front);
        }
        scene.arcs(panel.front_arcs.iter().map(|(_, arc)| *arc), Pen::Front);
        for (range, mark) in [(old, Mark::Pale), (new, Mark::Centre)] {
            range.for_each(|k| scene.point(bites[k].centre, mark));
        }
        scene
    }

    fn panel_numbers(panel: &Panel) -> Numbers {
        let length = |arc: &Arc| arc.sweep * arc.disc.radius;
        let arcs: f64 = panel.front_arcs.iter().map(|(_, arc)| length(arc)).sum();
        let pieces: f64 = panel.front_pieces.iter().map(|[a, b]| a.distance(*b)).sum();
        Numbers::default()
            .with("bites", panel.bitten)
            .with("front_arcs", panel.front_arcs.len())
            .number("length_of_front_arcs", arcs)
            .with("front_segments", panel.front_pieces.len())
            .number("length_of_front_segments", pieces)
    }

    /// Picture, caption and numbers.
    pub fn drawing(&self) -> Drawing<'static> {
        let scenes = self.panels.iter().map(|panel| self.scene(panel)).collect();
        let panels: Vec<serde_json::Value> = self
            .panels
            .iter()
            .map(|panel| Self::panel_numbers(panel).into())
            .collect();
        let discs: Vec<Disc> = self.run.discs(self.panels[5].bitten);
        let circles = discs.iter().map(|disc| Numbers::default().disc("circle", disc).into());
        let counts: Vec<String> = self.panels.iter().map(|panel| panel.bitten.to_string()).collect();
        let caption = format!(
            "The biting scheme, step by step, on a polygon: (a) the initial PSLG, whose boundary is the front; (b) bites at the vertices \
             of the polygon only; (c) the first bite at a point that is no vertex; (d) a layer of the boundary: no piece of it is \
             left; (e) the first bite in the interior; (f) a layer of the interior: every bite at a vertex of the front of (d) \
             that was still there in its turn.\n\nThick orange: the front, segments and arcs, computed from the circles anew for \
             each panel. Biscuit: what is left; grey: eaten before; blue: eaten since the panel before, with the circles and \
             centres (dots) of these bites. Bites so far: {}.\n\nDrawn from {}; in this order layers come one after another. The polygon \
             is, of {} random ones of {} to {} vertices that have a notch and no angle under 90°, the one whose shortest side is \
             longest for its area ({} of its square root).",
            counts.join(", "),
            self.run.told(),
            SEEDS * VERTICES.len() as u64,
            VERTICES[0],
            VERTICES[VERTICES.len() - 1],
            short(shortest_side(&self.run.case.domain))
        );
        let numbers = Numbers::default()
            .run(&self.run)
            .points("vertices", self.run.case.domain.vertices())
            .with("panels", panels)
            .with("circles", circles.collect::<Vec<serde_json::Value>>());
        Drawing {
            picture: Picture::Sheet(Sheet { columns: 3, scenes }),
            caption,
            numbers,
            commands: vec![self.run.asked.command()],
        }
    }
}
