//! What the search varies: a domain with vertices of its own choosing, a spacing of cones, c_b and the order of bites.

use crate::domain::{Domain, Pslg};
use crate::geometry::DVec2;
use crate::meshers::biting::TO_THE_LETTER;
use crate::suite::rows::record::Cell;
use rand::RngExt;
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// Orders of bites, by name.
const ORDERS: [&str; 6] = ["largest", "fifo", "lifo", "smallest", "random", "flattest"];
/// Most vertices inside, and most cones.
const MOST: usize = 16;
/// How near vertices come to the sides, and where sides' own vertices may stand.
const MARGIN: f64 = 0.05;
/// Coordinates are whole multiples of this, so that files hold them as they are.
const DECIMALS: f64 = 1e7;
/// The expression's proved Lipschitz constant may be above its slope by this share.
const PROVED: f64 = 1.01;

/// A domain, a spacing and how to bite it, for one t.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Candidate {
    /// Corners are (0, 0) and (1, `height`).
    height: f64,
    /// Vertices inside.
    vertices: Vec<DVec2>,
    /// f is at most h + α ‖x − c‖ for each (c, h).
    cones: Vec<(DVec2, f64)>,
    /// As a share of the largest that c_b + t ≤ 1 allows.
    share: f64,
    order: usize,
    seed: u64,
}

impl Candidate {
    /// One at random.
    pub fn random(random: &mut Pcg64) -> Self {
        let mut candidate = Self {
            height: random.random_range(0.3..1.0),
            vertices: Vec::new(),
            cones: Vec::new(),
            share: random.random_range(0.4..1.0),
            order: random.random_range(0..ORDERS.len()),
            seed: random.random_range(0..1000),
        };
        if random.random_range(0..2) == 0 {
            candidate.vertices = ring(random);
        } else {
            for _ in 0..random.random_range(0..5) {
                candidate.vertices.push(point(random));
            }
        }
        for _ in 0..random.random_range(0..4) {
            candidate.cones.push(cone(random));
        }
        candidate.kept_in()
    }

    /// One near this: coordinates and sizes moved by about `step`, rarely more.
    pub fn near(&self, step: f64, random: &mut Pcg64) -> Self {
        let mut next = self.clone();
        let rarely = |random: &mut Pcg64| random.random_range(0..12) == 0;
        next.height += moved(step, random);
        next.share += moved(step, random);
        for vertex in &mut next.vertices {
            *vertex += DVec2::new(moved(step, random), moved(step, random));
        }
        for (centre, size) in &mut next.cones {
            *centre += DVec2::new(moved(step, random), moved(step, random));
            *size *= 1.0 + moved(step, random);
        }
        if rarely(random) {
            next.order = random.random_range(0..ORDERS.len());
        }
        if rarely(random) {
            next.seed = random.random_range(0..1000);
        }
        if rarely(random) {
            next.vertices.push(point(random));
        }
        if rarely(random) {
            next.cones.push(cone(random));
        }
        if rarely(random) && !next.vertices.is_empty() {
            next.vertices.remove(random.random_range(0..next.vertices.len()));
        }
        if rarely(random) && !next.cones.is_empty() {
            next.cones.remove(random.random_range(0..next.cones.len()));
        }
        next.kept_in()
    }

    /// Within the ranges, and as a file would hold it.
    fn kept_in(mut self) -> Self {
        let whole = |value: f64| (value * DECIMALS).round() / DECIMALS;
        self.height = whole(self.height.clamp(0.3, 1.0));
        self.share = whole(self.share.clamp(0.3, 1.0));
        self.vertices.truncate(MOST);
        self.cones.truncate(MOST);
        let high = DVec2::new(1.0, self.height) - MARGIN;
        for vertex in &mut self.vertices {
            let kept = vertex.clamp(DVec2::splat(MARGIN), high);
            *vertex = DVec2::new(whole(kept.x), whole(kept.y));
        }
        for (centre, size) in &mut self.cones {
            *centre = DVec2::new(whole(centre.x), whole(centre.y));
            *size = whole(size.clamp(0.02, 1.0));
        }
        self
    }

    /// The rectangle with the vertices inside; none where two of them coincide.
    pub fn domain(&self, name: &str) -> Option<Domain> {
        let mut pslg = Pslg::new(name);
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, self.height), (0.0, self.height)];
        pslg.add_ring(corners.map(DVec2::from), 1);
        for vertex in &self.vertices {
            pslg.add_vertex(*vertex);
        }
        Domain::new(pslg).ok()
    }

    /// What asks for its mesh at `t`, of the domain in that file.
    pub fn cell(&self, file: &str, t: f64) -> Cell {
        let c_b = (self.share * (1.0 - t) * 1e4).floor() / 1e4;
        let slope = t / c_b / PROVED;
        let cone =
            |(centre, size): &(DVec2, f64)| format!("{size} + {slope} * hypot(x - {}, y - {})", centre.x, centre.y);
        let spacing = self
            .cones
            .iter()
            .map(cone)
            .reduce(|all, next| format!("min({all}, {next})"));
        let spacing = spacing.map_or("lfs".into(), |cones| format!("expr:{cones}"));
        let cell = Cell::new(file, "biting", &spacing, t, c_b).with(&[("order", ORDERS[self.order])]);
        Cell {
            seed: self.seed,
            ..cell.with(TO_THE_LETTER)
        }
    }
}

fn point(random: &mut Pcg64) -> DVec2 {
    DVec2::new(random.random_range(0.0..1.0), random.random_range(0.0..1.0))
}

/// A point with others around it: by Lemma 5.7 its nearest neighbour is farthest where circles just meet all around.
fn ring(random: &mut Pcg64) -> Vec<DVec2> {
    let (centre, radius) = (point(random), random.random_range(0.1..0.3));
    let count = random.random_range(5..14);
    let turn = random.random_range(0.0..1.0);
    let around = (0..count).map(|k| TAU * (f64::from(k) + turn) / f64::from(count));
    let around = around.map(|angle| centre + radius * DVec2::from_angle(angle));
    std::iter::once(centre).chain(around).collect()
}

fn cone(random: &mut Pcg64) -> (DVec2, f64) {
    (point(random), random.random_range(0.03..0.5))
}

/// Mostly 0 or about `step`, rarely ten times that.
fn moved(step: f64, random: &mut Pcg64) -> f64 {
    let far = match random.random_range(0..10) {
        0..4 => 0.0,
        4..9 => 1.0,
        _ => 10.0,
    };
    far * step * random.random_range(-1.0..1.0)
}
