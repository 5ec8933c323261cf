//! Cutting off small corners (§5.1: "we can cut off that small angle first"), for `corners = cut`.
//!
//! # Idea
//! Where all angles that open into the domain at an input vertex v are under 90°, each of their segments is bitten at
//! distance r from v, v itself is not bitten, and the triangles of v and two neighbouring cut points are left out of
//! what is to be bitten. Their bases, the cut edges, form angles above 90° with the segments, so that no small angle is
//! left in the rest.
//!
//! # The spacing beside a cut
//! Across a corner of angle θ, two segments are about s y apart at distance y from v, s = 2 sin(θ/2). For circles of one
//! segment not to bite the other, c_b f is held below κ s y on them, from the cut to the end of the shorter one, and
//! grows with t away from there ([`Graded`]). Then κ < 1 keeps the circles of the two cut points from holding
//! each other, and κ > 1/√2 makes them hold the disc whose diameter is the cut edge. So no vertex of the rest lies in that disc,
//! the angles opposite to the cut edge sum to less than 180°, and it stands in the constrained Delaunay triangulation of all
//! vertices without being forced: the corner triangle comes back by itself.

use crate::domain::{Domain, Wedge};
use crate::geometry::DVec2;
use crate::geometry::segments::{Seen, SegmentIndex};
use crate::geometry::tolerance::{NO_ANGLE, RIGHT_ANGLE_DEG};
use crate::meshers::Request;
use crate::meshers::sizing::Sizing;
use crate::spacing::Spacing;
use serde::{Deserialize, Serialize};

/// What is done about input angles under 90°, which the paper's theorems exclude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Corners {
    /// They are bitten like any other.
    #[default]
    Bite,
    /// They are cut off before biting, and given back.
    Cut,
}

/// κ: circles beside a cut have this share of the width there.
const SHARE: f64 = 0.9;

/// The smallest share that other corners may leave of it at a cut edge: above 1/√2, with room for what f loses to rounding.
const LEAST_SHARE: f64 = 0.75;

/// A cut, and its edge, are at most this share of the distance from the vertex to features not incident to it, so that a
/// third is left where both ends of a segment are cut.
const REACH_SHARE: f64 = 1.0 / 3.0;

/// The spacing beside cuts grows at least with this t, where the spacing given is flatter.
const LEAST_T: f64 = 0.25;

/// How often cuts that a smaller one nearby disturbs are made smaller before they are given up, and by what factor: to
/// some 1/4000 of what there was room for.
const ROUNDS: usize = 24;
const SHRINK: f64 = 0.7;

/// The corners that are cut off.
pub(super) struct Cuts {
    /// For each input vertex how far from it its segments are cut, 0 where they are not.
    distances: Vec<f64>,
    /// The sides of all corner triangles, and for each whether a corner lies on its left and on its right.
    outline: SegmentIndex,
    sides: Vec<[bool; 2]>,
    /// How many vertices are cut off.
    pub count: usize,
    /// How many vertices with an angle under 90° inside are left to biting.
    pub left: usize,
}

/// The angles at `v` that open into the domain.
fn inside(domain: &Domain, v: usize) -> impl Iterator<Item = &Wedge> {
    domain.wedges(v).iter().filter(|wedge| wedge.inside)
}

fn is_acute(wedge: &Wedge) -> bool {
    wedge.angle.to_degrees() < 90.0 - RIGHT_ANGLE_DEG
}

/// s = 2 sin(θ/2): the cut edge over the cut's distance.
fn width(wedge: &Wedge) -> f64 {
    2.0 * (0.5 * wedge.angle).sin()
}

/// The unit vector along segment `s` away from its end `v`, and the segment's length.
fn away(domain: &Domain, s: usize, v: usize) -> (DVec2, f64) {
    let segment = domain.segments()[s];
    let other = if segment.a == v { segment.b } else { segment.a };
    let along = domain.vertices()[other] - domain.vertices()[v];
    (along / along.length(), along.length())
}

impl Cuts {
    /// No corner is cut off.
    pub fn none(domain: &Domain) -> Self {
        Self::at(domain, vec![0.0; domain.vertices().len()], 0)
    }

    /// Cuts off what can be, and lowers the spacing accordingly.
    pub fn new<'a>(domain: &Domain, spacing: &'a dyn Spacing, request: &Request) -> (Self, Graded<'a>) {
        let sizing = Sizing::new(domain, spacing, request);
        let t = sizing.t().max(LEAST_T);
        let isolated = domain.isolated().iter().map(|&v| [domain.vertices()[v]; 2]);
        let features = SegmentIndex::new((0..domain.segments().len()).map(|s| domain.ends(s)).chain(isolated));
        let vertices = 0..domain.vertices().len();
        let has_corner: Vec<bool> = vertices.clone().map(|v| inside(domain, v).any(is_acute)).collect();
        let room = |v: usize| match has_corner[v] && inside(domain, v).all(is_acute) {
            true => room(domain, &features, v, request.c_b * spacing.at(domain.vertices()[v]), t),
            false => 0.0,
        };
        let mut distances: Vec<f64> = vertices.clone().map(room).collect();
        for round in 0..=ROUNDS {
            let graded = Graded::new(domain, spacing, &distances, request.c_b, t);
            let disturbed: Vec<usize> = vertices
                .clone()
                .filter(|&v| distances[v] > 0.0 && !stands(domain, &graded, v, distances[v], request.c_b))
                .collect();
            if disturbed.is_empty() {
                break;
            }
            let factor = if round < ROUNDS - 1 { SHRINK } else { 0.0 };
            disturbed.into_iter().for_each(|v| distances[v] *= factor);
        }
        // What coordinates cannot resolve, biting would decline.
        for v in vertices {
            let narrowest = inside(domain, v).map(width).fold(f64::INFINITY, f64::min);
            if SHARE * narrowest * distances[v] < sizing.smallest() {
                distances[v] = 0.0;
            }
        }
        let graded = Graded::new(domain, spacing, &distances, request.c_b, t);
        let corners = has_corner.iter().filter(|has| **has).count();
        (Self::at(domain, distances, corners), graded)
    }

    fn at(domain: &Domain, distances: Vec<f64>, corners: usize) -> Self {
        let mut cuts = Self {
            count: distances.iter().filter(|distance| **distance > 0.0).count(),
            distances,
            outline: SegmentIndex::default(),
            sides: Vec::new(),
            left: 0,
        };
        cuts.left = corners - cuts.count;
        let mut outline = Vec::new();
        let mut sides = Vec::new();
        for v in (0..cuts.distances.len()).filter(|&v| cuts.is_cut(v)) {
            let apex = domain.vertices()[v];
            for wedge in domain.wedges(v) {
                let from = cuts.point(domain, wedge.from, v);
                let before = domain.wedges(v).iter().find(|other| other.to == wedge.from);
                outline.push([apex, from]);
                sides.push([wedge.inside, before.is_some_and(|other| other.inside)]);
                if wedge.inside {
                    outline.push([from, cuts.point(domain, wedge.to, v)]);
                    sides.push([true, false]);
                }
            }
        }
        cuts.sides = sides;
        cuts.outline = SegmentIndex::new(outline);
        cuts
    }

    /// Whether vertex `v` is cut off.
    pub fn is_cut(&self, v: usize) -> bool {
        self.distances[v] > 0.0
    }

    /// How far from its end `v` a segment is cut; 0 where it is not.
    pub fn distance(&self, v: usize) -> f64 {
        self.distances[v]
    }

    /// Where segment `s` is cut at its end `v`.
    pub fn point(&self, domain: &Domain, s: usize, v: usize) -> DVec2 {
        domain.vertices()[v] + away(domain, s, v).0 * self.distances[v]
    }

    /// Whether `x` lies in a corner triangle or on its border, decided exactly.
    pub fn hold(&self, x: DVec2) -> bool {
        match self.outline.right_of(x) {
            Seen::On(_) => true,
            Seen::Segment(side, on_left) => self.sides[side][usize::from(!on_left)],
            Seen::Nothing => false,
        }
    }
}

/// How far from `v` its segments can be cut: as far as features not incident to it and the spacing leave room for, that the
/// corner triangle be as large as the triangles beside it.
fn room(domain: &Domain, features: &SegmentIndex, v: usize, size: f64, t: f64) -> f64 {
    let incident = |s: usize| {
        let segment = domain.segments().get(s);
        segment.is_some_and(|segment| segment.a == v || segment.b == v)
    };
    let nearest = features.nearest_where(domain.vertices()[v], |s| !incident(s));
    let lengths = inside(domain, v).flat_map(|wedge| [wedge.from, wedge.to].map(|s| away(domain, s, v).1));
    let reach = lengths.fold(nearest.map_or(f64::INFINITY, |(_, distance)| distance), f64::min);
    let widest = inside(domain, v).map(width).fold(0.0, f64::max);
    if inside(domain, v).any(|wedge| wedge.angle <= NO_ANGLE) {
        return 0.0;
    }
    (REACH_SHARE * reach / widest.max(1.0)).min(size / (widest + t))
}

/// Whether the circles at the cut points of `v` hold the discs over the cut edges.
fn stands(domain: &Domain, graded: &Graded, v: usize, distance: f64, c_b: f64) -> bool {
    inside(domain, v).all(|wedge| {
        let points = [wedge.from, wedge.to].map(|s| domain.vertices()[v] + away(domain, s, v).0 * distance);
        points
            .iter()
            .all(|&x| c_b * graded.at(x) >= LEAST_SHARE * width(wedge) * distance)
    })
}

/// min(f, κ s y / c_b along the segments beside cuts, growing with α away from them): Lipschitz with α = t / c_b, since
/// each of its terms is (Lemma 2.3).
pub(super) struct Graded<'a> {
    inner: &'a dyn Spacing,
    alpha: f64,
    sides: Vec<Side>,
    index: SegmentIndex,
    smallest: f64,
}

/// The part of a segment beside a cut, from `near` to `far` away from its vertex, where f is at most `slope` times that
/// distance.
struct Side {
    vertex: DVec2,
    direction: DVec2,
    near: f64,
    far: f64,
    slope: f64,
}

impl Side {
    /// min over y in [near, far] of slope · y + α ‖x − (vertex + y direction)‖.
    fn at(&self, x: DVec2, alpha: f64) -> f64 {
        let to = x - self.vertex;
        let (along, across) = (to.dot(self.direction), to.perp_dot(self.direction).abs());
        let steeper = alpha * alpha - self.slope * self.slope;
        let best = if steeper > 0.0 {
            (along - across * self.slope / steeper.sqrt()).clamp(self.near, self.far)
        } else {
            self.near
        };
        self.slope * best + alpha * (along - best).hypot(across)
    }
}

impl<'a> Graded<'a> {
    fn new(domain: &Domain, inner: &'a dyn Spacing, distances: &[f64], c_b: f64, t: f64) -> Self {
        let mut sides = Vec::new();
        for v in (0..distances.len()).filter(|&v| distances[v] > 0.0) {
            for wedge in inside(domain, v) {
                let ways = [wedge.from, wedge.to].map(|s| away(domain, s, v));
                sides.extend(ways.map(|(direction, _)| Side {
                    vertex: domain.vertices()[v],
                    direction,
                    near: distances[v],
                    far: ways[0].1.min(ways[1].1),
                    slope: SHARE * width(wedge) / c_b,
                }));
            }
        }
        let ends = |side: &Side| [side.near, side.far].map(|y| side.vertex + side.direction * y);
        let smallest = sides.iter().map(|side| side.slope * side.near);
        Self {
            inner,
            alpha: if sides.is_empty() { inner.lipschitz() } else { t / c_b },
            index: SegmentIndex::new(sides.iter().map(ends)),
            smallest: smallest.fold(f64::INFINITY, f64::min),
            sides,
        }
    }
}

impl Spacing for Graded<'_> {
    fn at(&self, x: DVec2) -> f64 {
        let mut least = self.inner.at(x);
        // A side farther away than that is above f whatever its slope.
        let reach = (least - self.smallest) / self.alpha;
        self.index.within(x, reach, |side, _| {
            least = least.min(self.sides[side].at(x, self.alpha))
        });
        least
    }

    fn lipschitz(&self) -> f64 {
        self.alpha
    }
}
