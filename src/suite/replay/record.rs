//! The data in a replay's page: columns of whole numbers.
//!
//! Lengths count units of [`Frame::unit`], places units from [`Frame::corner`], y upward.

use crate::geometry::DVec2;
use crate::mesh::Mesh;
use crate::meshers::{Bite, Reason, Waiting};
use crate::quality;
use crate::suite::figures::labels::{self, Label};
use crate::suite::replay::outline;
use crate::suite::rows::record::Cell;
use crate::suite::rows::record::{parameter_text, quoted};
use crate::suite::run::prepare::Prepared;
use crate::theory::{Promises, Rule};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The number of units along the larger side of the domain's box: enough to zoom in on the smallest circles.
const UNITS: f64 = 1e7;

/// Ranks are written as whole numbers of this: f, an angle or a shape to four digits.
const RANK_UNIT: f64 = 1e-4;

/// A run of biting, bite by bite, with its mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    /// What was run.
    pub about: About,
    /// How numbers become places.
    pub frame: Frame,
    /// Mesh vertices: x and y by turns.
    pub points: Vec<i64>,
    /// Triangles of the mesh, as three vertices each.
    pub triangles: Vec<[u32; 3]>,
    /// The domain.
    pub outline: Outline,
    /// The bites.
    pub bites: Bites,
    /// The front vertices.
    pub queue: Queue,
}

/// What was run, and what came out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct About {
    /// Name of the domain.
    pub domain: String,
    /// Control spacing, as asked for.
    pub spacing: String,
    /// Order of bites.
    pub order: String,
    /// Biting constant.
    pub c_b: f64,
    /// c_b times the Lipschitz constant of the spacing.
    pub t: f64,
    /// The command that writes this page.
    pub command: String,
    /// Smallest angle of the mesh, without triangles at input angles under 60°; absent if there are no others.
    pub min_angle_deg: Option<f64>,
    /// asin(1/2 − t) (Theorem 6.8).
    pub min_angle_bound_deg: f64,
}

/// The box that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Its lower left corner.
    pub corner: [f64; 2],
    /// One unit in the domain's unit of length.
    pub unit: f64,
    /// Its width and height in units.
    pub size: [i64; 2],
}

/// The domain, as mesh vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outline {
    /// The boundary as closed rings.
    pub rings: Vec<Vec<u32>>,
    /// Input segments.
    pub segments: Vec<[u32; 2]>,
    /// The front before the first bite.
    pub front: Vec<[u32; 2]>,
    /// Triangles of corners that are cut off, by number.
    pub corners: Vec<u32>,
    /// Bite, vertex and end of the side of a notch that its circle does not cover beyond.
    pub shadows: Vec<[u32; 3]>,
}

/// The bites, in order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bites {
    /// Why, a letter each: `V` input vertex, `C` cut corner, `B` progressive, `M` middle, `F` front vertex.
    pub reasons: String,
    /// Centres, as mesh vertices.
    pub centres: Vec<u32>,
    /// Radii.
    pub radii: Vec<i64>,
    /// The segment that each `B` or `M` protects.
    pub segments: Vec<u32>,
    /// Of each `B` the bite p₁, of each `M` p₁ and p₂; −1 where a cut corner stands for it.
    pub parents: Vec<i64>,
    /// Of each `M` q₁ and q₂: x and y by turns.
    pub middles: Vec<i64>,
    /// Of each `F` the front vertex bitten.
    pub chosen: Vec<u32>,
}

/// Front vertices, in the order in which they appear.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Queue {
    /// How many appear with each bite.
    pub appearing: Vec<u32>,
    /// Where: x and y by turns.
    pub points: Vec<i64>,
    /// The bite that takes each.
    pub gone: Vec<u32>,
    /// The two bites on whose circles each lies: one after the other by turns.
    pub circles: Vec<u32>,
    /// Ranks in units of 10⁻⁴; none where the order has none.
    pub ranks: Vec<i64>,
    /// The place of each among all, if they were bitten in turn; none where lots are drawn.
    pub turns: Vec<u32>,
}

/// Makes the recording of a run.
pub(super) fn record(cell: &Cell, prepared: &Prepared, mesh: &Mesh, bites: &[Bite]) -> Result<Recording, String> {
    let domain = &*prepared.site.domain;
    if bites.is_empty() {
        return Err(no_bites(cell));
    }
    let frame = Frame::around(domain.bounds().min, domain.bounds().size());
    let is_cut = outline::cut_vertices(domain, bites);
    let corners = outline::corner_triangles(mesh, &is_cut);
    let labels: Vec<Label> = (0..bites.len())
        .filter_map(|k| labels::label(domain, bites, k))
        .collect();
    let about = about(cell, prepared, mesh);
    let queue = Queue::new(&frame, bites, &about.order);
    Ok(Recording {
        points: frame.places(mesh.points.iter().copied()),
        triangles: mesh.triangles.clone(),
        outline: Outline {
            rings: outline::rings(domain),
            segments: domain.segments().iter().map(|s| [s.a as u32, s.b as u32]).collect(),
            front: outline::first_front(mesh, &is_cut, &corners),
            corners,
            shadows: outline::shadows(domain, bites),
        },
        bites: Bites::new(&frame, mesh, bites, &labels, &queue)?,
        about,
        frame,
        queue,
    })
}

/// The message that a mesher does not bite.
pub(super) fn no_bites(cell: &Cell) -> String {
    format!("mesher `{}` has no bites to replay", cell.mesher)
}

fn about(cell: &Cell, prepared: &Prepared, mesh: &Mesh) -> About {
    let domain = &*prepared.site.domain;
    let (statistics, _) = quality::judge(domain, mesh, None);
    let t = prepared.case(cell.c_b).t();
    let order = cell.complete().get("order").map(parameter_text).unwrap_or_default();
    About {
        domain: domain.name().into(),
        spacing: prepared.spacing.spec.clone(),
        order,
        c_b: cell.c_b,
        t,
        command: format!(
            "cargo run --release -- figures --replay {}{}",
            quoted(&cell.domain),
            cell.options()
        ),
        min_angle_deg: statistics.min_angle_free_deg,
        min_angle_bound_deg: Promises { rule: Rule::Earlier, t }.min_angle_deg(),
    }
}

impl Frame {
    fn around(corner: DVec2, size: DVec2) -> Self {
        let unit = size.max_element() / UNITS;
        Self {
            corner: [corner.x, corner.y],
            unit,
            size: [size.x, size.y].map(|side| (side / unit).round() as i64),
        }
    }

    fn length(&self, length: f64) -> i64 {
        (length / self.unit).round() as i64
    }

    fn places(&self, points: impl Iterator<Item = DVec2>) -> Vec<i64> {
        let [x, y] = self.corner;
        points
            .flat_map(|point| [self.length(point.x - x), self.length(point.y - y)])
            .collect()
    }
}

impl Bites {
    fn new(frame: &Frame, mesh: &Mesh, bites: &[Bite], labels: &[Label], queue: &Queue) -> Result<Self, String> {
        let key = |point: DVec2| [point.x.to_bits(), point.y.to_bits()];
        let points = mesh.points.iter().enumerate();
        let vertex_at: HashMap<[u64; 2], u32> = points.map(|(v, &point)| (key(point), v as u32)).collect();
        let vertex = |bite: &Bite| {
            let found = vertex_at.get(&key(bite.centre)).copied();
            found.ok_or_else(|| format!("the bite at {} is no vertex of the mesh", bite.centre))
        };
        let parent = |circle: &Option<usize>| circle.map_or(-1, |k| k as i64);
        let middles = labels.iter().filter(|label| label.points.len() == 2);
        Ok(Self {
            reasons: bites.iter().map(|bite| letter(bite.reason)).collect(),
            centres: bites.iter().map(vertex).collect::<Result<_, _>>()?,
            radii: bites.iter().map(|bite| frame.length(bite.radius)).collect(),
            segments: labels.iter().map(|label| label.segment as u32).collect(),
            parents: labels
                .iter()
                .flat_map(|label| label.circles.iter().map(parent))
                .collect(),
            middles: frame.places(middles.flat_map(|label| label.points.iter().copied())),
            chosen: bites.iter().filter_map(|bite| chosen(bite, queue)).collect(),
        })
    }
}

fn letter(reason: Reason) -> char {
    match reason {
        Reason::InputVertex => 'V',
        Reason::CutCorner => 'C',
        Reason::Progressive { .. } => 'B',
        Reason::Middle { .. } => 'M',
        Reason::FrontVertex => 'F',
    }
}

/// The front vertex that a bite was centred on: if several were at the same point, the one whose turn it was.
fn chosen(bite: &Bite, queue: &Queue) -> Option<u32> {
    if bite.reason != Reason::FrontVertex {
        return None;
    }
    let first = *bite.gone.first()?;
    let turn = |serial: &u32| queue.turns.get(*serial as usize).copied().unwrap_or(*serial);
    let at = |serial: u32| {
        let place = 2 * serial as usize;
        queue.points.get(place..place + 2)
    };
    let same = bite.gone.iter().copied().filter(|&serial| at(serial) == at(first));
    same.min_by_key(turn)
}

impl Queue {
    fn new(frame: &Frame, bites: &[Bite], order: &str) -> Self {
        let all: Vec<Waiting> = bites.iter().flat_map(|bite| bite.appeared.iter().copied()).collect();
        let mut gone = vec![bites.len() as u32; all.len()];
        for (k, bite) in bites.iter().enumerate() {
            for &serial in &bite.gone {
                gone[serial as usize] = k as u32;
            }
        }
        let ranks: Vec<i64> = all.iter().map(|one| (one.rank / RANK_UNIT).round() as i64).collect();
        Self {
            appearing: bites.iter().map(|bite| bite.appeared.len() as u32).collect(),
            points: frame.places(all.iter().map(|one| one.point)),
            gone,
            circles: all.iter().flat_map(|one| one.circles).collect(),
            ranks: if ranks.iter().all(|&rank| rank == 0) {
                Vec::new()
            } else {
                ranks
            },
            turns: turns(&all, order),
        }
    }
}

/// The place of each front vertex among all, were they bitten in turn; none where lots are drawn.
fn turns(all: &[Waiting], order: &str) -> Vec<u32> {
    let mut in_turn: Vec<&Waiting> = all.iter().collect();
    match order {
        "random" => return Vec::new(),
        "lifo" => in_turn.reverse(),
        _ => in_turn.sort_by(|one, other| one.rank.total_cmp(&other.rank).then(one.serial.cmp(&other.serial))),
    }
    let mut turns = vec![0; all.len()];
    for (turn, one) in in_turn.iter().enumerate() {
        turns[one.serial as usize] = turn as u32;
    }
    turns
}
