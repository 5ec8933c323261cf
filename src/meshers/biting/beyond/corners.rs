//! Cutting off small corners (§5.1: "we can cut off that small angle first"), for `corners = cut`, and keeping circles
//! from meeting low.
//!
//! # Idea
//! If an angle under 90° opens into the domain at an input vertex v, every segment of v is bitten at distance r from v,
//! and v itself is not bitten. The triangles of v and two neighbouring cut points are left out of what is to be bitten.
//! Their bases, the cut edges, form angles above 90° with the segments, so no small angle is left in the rest. If v has
//! other angles too, points at distance r are also put between their segments ([`fan`]).
//!
//! # The spacing beside a cut
//! Across a corner of angle θ, two segments are about s y apart at distance y from v, s = 2 sin(θ/2). So that circles
//! of one segment do not reach the other, c_b f is held below κ s y on both, from the cut to the end of the shorter
//! one, and grows with slope t away from there ([`Capped`]). Since κ < 1, the circles of neighbouring cut points do not
//! hold each other's centres. Since their radii are at least [`Edge::least_radius`], they meet high enough above the
//! cut edge for Theorem 6.8, and no vertex of the rest sees the base of the corner triangle under more than 180° − θ.
//! So the corner triangle is Delaunay, and the triangulation brings it back by itself.
//!
//! # Circles that meet low
//! Lemmas 6.3 and 6.4 bound from below how high above a segment the circles of neighbouring centres meet. They overlook
//! the two ends of a segment whose circles together cover it. If those meet lower than (9), both radii are held to half
//! the distance between the ends, so that step 4 puts a circle in the middle. The angle bound then holds without c_b +
//! t ≤ 1.
//!
//! By the rule of the later point, two ends together cover a segment only if c_b f exceeds half its length in its
//! middle. It is held down there. If f ≤ lfs, this happens only beside cuts.

use crate::domain::{Domain, Wedge};
use crate::geometry::DVec2;
use crate::geometry::near::meeting_height;
use crate::geometry::segments::{Seen, SegmentIndex};
use crate::geometry::tolerance::{COVERED, NO_ANGLE, RIGHT_ANGLE_DEG};
use crate::meshers::biting::beyond::capped::{Cap, Capped};
use crate::meshers::biting::beyond::fan::{Edge, Fan, slope_beside};
use crate::meshers::biting::beyond::inside::Inside;
use crate::meshers::biting::{Biting, Corners, HeadOn};
use crate::meshers::sizing::Sizing;
use crate::meshers::{MeshError, Request};
use crate::spacing::Spacing;
use crate::theory::least_meeting_height;
use crate::theory::{FLAT_T, Rule};
use std::f64::consts::FRAC_1_SQRT_2;

/// κ: the radius of a circle beside a cut, as a share of the width there.
pub(in crate::meshers::biting) const SHARE: f64 = 0.95;

/// A cut, and its edges, are at most this share of the distance from the vertex to features not incident to it, so that a
/// third is left where both ends of a segment are cut.
const REACH_SHARE: f64 = 1.0 / 3.0;

/// If the given spacing is flatter than [`FLAT_T`], it grows with this slope away from where it is held down: without
/// any growth a single corner would set the size everywhere.
const GROWTH: f64 = 0.25;

/// A cut that smaller ones nearby disturb is made smaller by at least this factor, until it fits.
const SHRINK: f64 = 0.8;

/// The corners that are cut off, and the spacing that fits them.
pub(in crate::meshers::biting) struct Cuts {
    /// For each input vertex, how far from it its segments are cut; 0 if they are not.
    distances: Vec<f64>,
    /// Points of cuts that are on no segment.
    pub between: Vec<DVec2>,
    /// The sides of all corner triangles, and for each side whether a corner triangle lies on its left and on its
    /// right.
    outline: SegmentIndex,
    sides: Vec<[bool; 2]>,
    /// How many vertices are cut off.
    pub count: usize,
    /// How many segments get a circle in the middle, because the circles of their ends would else cover them and meet
    /// low.
    pub parted: usize,
    /// How many angles had to be divided into parts smaller than the smallest angle of their vertex.
    pub narrowed: usize,
}

/// The angles at `v` that open into the domain.
fn inside(domain: &Domain, v: usize) -> impl Iterator<Item = &Wedge> {
    domain.wedges(v).iter().filter(|wedge| wedge.inside)
}

fn is_small(wedge: &Wedge) -> bool {
    wedge.angle.to_degrees() < 90.0 - RIGHT_ANGLE_DEG
}

/// The cuts while they are being decided: distances and parted segments are made to fit one another, round by round.
struct Plan<'a> {
    domain: &'a Domain,
    sizing: Sizing<'a>,
    c_b: f64,
    rule: Rule,
    /// The slope with which s grows away from caps.
    t: f64,
    /// The vertices to be cut off, each with its fan for distance 1.
    fans: Vec<(usize, Fan)>,
    /// As in [`Cuts`].
    distances: Vec<f64>,
    /// For each segment, whether the circles of its ends are held apart.
    parted: Vec<bool>,
}

impl Cuts {
    /// No corner is cut off.
    pub fn none(domain: &Domain) -> Self {
        Self {
            distances: vec![0.0; domain.vertices().len()],
            between: Vec::new(),
            outline: SegmentIndex::default(),
            sides: Vec::new(),
            count: 0,
            parted: 0,
            narrowed: 0,
        }
    }

    /// The cuts, and the segments parted, as the parameters of `biting` demand, with the spacing for the rest. Declined
    /// if coordinates cannot resolve a cut.
    pub fn new<'a>(
        biting: &Biting,
        domain: &'a Domain,
        (spacing, inside): (&'a dyn Spacing, Option<&Inside>),
        request: &Request,
    ) -> Result<(Self, Capped<'a>), MeshError> {
        let mut plan = Plan::new(biting, domain, (spacing, inside), request)?;
        loop {
            let capped = Capped::new(spacing, plan.c_b, plan.t, plan.caps());
            let sizing = Sizing::new(domain, &capped, request);
            let is_settled = plan.shrink(&sizing)? & (biting.head_on == HeadOn::Leave || plan.part(&sizing)?);
            if is_settled {
                return Ok((plan.cuts(), capped));
            }
        }
    }

    /// Whether vertex `v` is cut off.
    pub fn is_cut(&self, v: usize) -> bool {
        self.distances[v] > 0.0
    }

    /// How far from its end `v` a segment is cut; 0 if it is not.
    pub fn distance(&self, v: usize) -> f64 {
        self.distances[v]
    }

    /// Where segment `s` is cut at its end `v`.
    pub fn point(&self, domain: &Domain, s: usize, v: usize) -> DVec2 {
        domain.vertices()[v] + domain.away(s, v).0 * self.distances[v]
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

impl<'a> Plan<'a> {
    fn new(
        biting: &Biting,
        domain: &'a Domain,
        (spacing, within): (&'a dyn Spacing, Option<&Inside>),
        request: &Request,
    ) -> Result<Self, MeshError> {
        let sizing = Sizing::new(domain, spacing, request);
        let t = if sizing.t() < FLAT_T { GROWTH } else { sizing.t() };
        let mut plan = Self {
            domain,
            sizing,
            c_b: request.c_b,
            rule: biting.rule,
            t,
            fans: Vec::new(),
            distances: vec![0.0; domain.vertices().len()],
            parted: vec![false; domain.segments().len()],
        };
        if biting.corners == Corners::Bite {
            return Ok(plan);
        }
        let isolated = domain.isolated().iter().map(|&v| [domain.vertices()[v]; 2]);
        let features = SegmentIndex::new((0..domain.segments().len()).map(|s| domain.ends(s)).chain(isolated));
        for v in 0..domain.vertices().len() {
            if inside(domain, v).any(is_small) {
                let fan = Fan::new(domain, v, t, biting.rule);
                let nearest = match within {
                    Some(within) => within.nearest_apart(domain.vertices()[v]),
                    None => nearest_apart(&features, domain, v),
                };
                plan.distances[v] = plan.room(nearest, v, &fan)?;
                plan.fans.push((v, fan));
            }
        }
        Ok(plan)
    }

    /// How far from `v` its segments are cut, so that the corner triangles are about as large as the triangles beside
    /// them. The spacing limits this, and so do the features not incident to `v`, of which `nearest` is the distance.
    fn room(&self, nearest: f64, v: usize, fan: &Fan) -> Result<f64, MeshError> {
        let domain = self.domain;
        let lengths = domain.wedges(v).iter().map(|wedge| domain.away(wedge.from, v).1);
        let reach = lengths.fold(nearest, f64::min);
        if inside(domain, v).any(|wedge| wedge.angle <= NO_ANGLE) {
            return Err(unresolved(domain.vertices()[v]));
        }
        let widest = fan.edges.iter().map(Edge::width).fold(0.0, f64::max);
        let size = self.sizing.at(domain.vertices()[v])?;
        Ok((REACH_SHARE * reach / widest.max(1.0)).min(size / (widest + self.t)))
    }

    /// The caps for what is cut and parted so far.
    fn caps(&self) -> Vec<Cap> {
        let mut caps = Vec::new();
        for (v, fan) in &self.fans {
            let (vertex, distance) = (self.domain.vertices()[*v], self.distances[*v]);
            caps.extend(self.beside(*v, distance));
            if fan.edges.len() > 1 {
                caps.extend(fan.edges.iter().flat_map(|edge| {
                    edge.ends
                        .map(|way| Cap::point(vertex + way * distance, SHARE * edge.width() * distance))
                }));
            }
        }
        for s in (0..self.parted.len()).filter(|&s| self.parted[s]) {
            let [a, b] = self.ends(s);
            let half = 0.5 * a.distance(b);
            match self.rule {
                Rule::Earlier => caps.extend([Cap::point(a, half), Cap::point(b, half)]),
                Rule::Later => caps.push(Cap::point(a.midpoint(b), half)),
            }
        }
        caps
    }

    /// The caps along segments at `v` that face each other at less than 90°: neighbours and, beyond the ends of shorter
    /// segments between them, others too.
    fn beside(&self, v: usize, distance: f64) -> Vec<Cap> {
        let (domain, wedges) = (self.domain, self.domain.wedges(v));
        let vertex = domain.vertices()[v];
        let mut caps = Vec::new();
        for first in 0..wedges.len() {
            let (one, length) = domain.away(wedges[first].from, v);
            let (mut angle, mut near) = (0.0, distance);
            for wedge in wedges.iter().cycle().skip(first).take(wedges.len()) {
                angle += wedge.angle;
                if !wedge.inside || angle.to_degrees() >= 90.0 - RIGHT_ANGLE_DEG || near >= length {
                    break;
                }
                let (other, far) = domain.away(wedge.to, v);
                let (far, slope) = (far.min(length), slope_beside(angle, self.rule));
                if far > near {
                    caps.extend([one, other].map(|direction| Cap {
                        start: vertex + direction * near,
                        direction,
                        length: far - near,
                        size: slope * near,
                        slope,
                    }));
                    near = far;
                }
            }
        }
        caps
    }

    /// What is left of a segment between its cuts.
    fn ends(&self, s: usize) -> [DVec2; 2] {
        let segment = self.domain.segments()[s];
        [segment.a, segment.b].map(|v| self.domain.vertices()[v] + self.domain.away(s, v).0 * self.distances[v])
    }

    /// Makes cuts smaller if their circles are held below what their edges need. Returns whether there were none.
    fn shrink(&mut self, capped: &Sizing) -> Result<bool, MeshError> {
        let mut is_settled = true;
        for (v, fan) in &self.fans {
            let (vertex, distance) = (self.domain.vertices()[*v], self.distances[*v]);
            let mut fit = f64::INFINITY;
            for edge in &fan.edges {
                for way in edge.ends {
                    fit = fit
                        .min(capped.at(vertex + way * distance)? / (edge.least_radius(self.t, self.rule) * distance));
                }
            }
            if fit < 1.0 {
                is_settled = false;
                self.distances[*v] *= fit.min(SHRINK);
            }
            let narrowest = fan.edges.iter().map(Edge::width).fold(f64::INFINITY, f64::min);
            if SHARE * narrowest * self.distances[*v] < self.sizing.smallest() {
                return Err(unresolved(vertex));
            }
        }
        Ok(is_settled)
    }

    /// Marks segments that the circles of their two ends together cover while meeting low. Returns whether there were
    /// none.
    fn part(&mut self, capped: &Sizing) -> Result<bool, MeshError> {
        let mut is_settled = true;
        for s in (0..self.parted.len()).filter(|&s| !self.parted[s]).collect::<Vec<_>>() {
            if self.meet_low(self.ends(s), capped)? {
                self.parted[s] = true;
                is_settled = false;
            }
        }
        Ok(is_settled)
    }

    /// Whether the two ends of a segment, which is c long, together cover it and meet low. By the paper's rule, low is
    /// lower than (9). By the rule of the later point, the middle m is eaten, but g(m) − t c / 2 ≤ c / √2, so that a
    /// point may be left in the circle over the segment.
    fn meet_low(&self, [a, b]: [DVec2; 2], capped: &Sizing) -> Result<bool, MeshError> {
        let between = a.distance(b);
        Ok(match self.rule {
            Rule::Earlier => {
                let radii = [capped.at(a)?, capped.at(b)?];
                let bound = least_meeting_height(self.t.min(1.0));
                let is_low = meeting_height(between, radii[0], radii[1]) < bound * radii[0].min(radii[1]);
                radii[0] + radii[1] > between && is_low
            }
            Rule::Later => {
                let radius = capped.at(a.midpoint(b))?;
                let is_eaten = radius * (1.0 - COVERED) > 0.5 * between;
                is_eaten && radius <= between * (FRAC_1_SQRT_2 + 0.5 * self.t)
            }
        })
    }

    fn cuts(&self) -> Cuts {
        let mut cuts = Cuts {
            distances: self.distances.clone(),
            count: self.fans.len(),
            parted: self.parted.iter().filter(|parted| **parted).count(),
            narrowed: self.fans.iter().map(|(_, fan)| fan.narrowed).sum(),
            ..Cuts::none(self.domain)
        };
        let mut outline = Vec::new();
        for (v, fan) in &self.fans {
            let (vertex, distance) = (self.domain.vertices()[*v], self.distances[*v]);
            let wedges = self.domain.wedges(*v);
            for (k, wedge) in wedges.iter().enumerate() {
                let before = &wedges[(k + wedges.len() - 1) % wedges.len()];
                outline.push([vertex, cuts.point(self.domain, wedge.from, *v)]);
                cuts.sides.push([wedge.inside, before.inside]);
            }
            for edge in &fan.edges {
                outline.push(edge.ends.map(|way| vertex + way * distance));
                cuts.sides.push([true, false]);
            }
            cuts.between
                .extend(fan.between.iter().map(|way| vertex + *way * distance));
        }
        cuts.outline = SegmentIndex::new(outline);
        cuts
    }
}

/// The distance from `v` to the nearest feature not incident to it.
fn nearest_apart(features: &SegmentIndex, domain: &Domain, v: usize) -> f64 {
    let incident = |s: usize| {
        let segment = domain.segments().get(s);
        segment.is_some_and(|segment| segment.a == v || segment.b == v)
    };
    let nearest = features.nearest_where(domain.vertices()[v], |s| !incident(s));
    nearest.map_or(f64::INFINITY, |(_, distance)| distance)
}

fn unresolved(vertex: DVec2) -> MeshError {
    MeshError::Declined(format!(
        "the angle at ({}, {}) is too small, or features are too close to it: coordinates of this size do not resolve the \
         corner to be cut off there (§5.1); move the domain to the origin, widen the angle, or try `--param corners=bite`",
        vertex.x, vertex.y
    ))
}
