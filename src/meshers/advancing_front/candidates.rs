//! Apexes over a base, ranked, and the exact test of the triangle that each would make.
//!
//! A candidate's rank is an angle in degrees: the smallest angle of its triangle, or less if what it leaves of the
//! front can only be closed with smaller angles. The rank counts the wedges beside the new sides, and nodes and edges
//! too near to them.

use super::front::Front;
use super::ideal_point::{Base, Place};
use crate::geometry::predicates::{Meeting, orient2d, segments_meet};
use crate::geometry::segments::closest_on_segment;
use crate::geometry::{DVec2, Rect, turn};

/// The node to which a candidate connects the base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Apex {
    /// A node of the front.
    Node(u32),
    /// A new node, with s there.
    New(DVec2, f64),
}

/// A candidate that ranks this number of degrees is taken without trying other places for a new node.
const GOOD: f64 = 50.0;

/// A new node ranks by this factor lower than it would as a node of the front: of two good triangles, the one without a
/// new node is better.
const NEW_NODE: f64 = 0.95;

/// The factor of a new node's rank: one nearer to the base than δ₁ makes smaller elements than asked for.
fn weight(place: Place) -> f64 {
    NEW_NODE * place.share * place.share
}

/// Height of an equilateral triangle over its side: whatever is nearer than that to a new side is too near.
const HEIGHT: f64 = 0.866_025_403_784_438_6;

/// A front edge near the base.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    from: u32,
    to: u32,
    p: DVec2,
    q: DVec2,
    /// Where the edge before starts.
    before: DVec2,
    /// s at `from`.
    size: f64,
}

impl Near {
    /// Whether, by the edges at `from`, a point lies on the side that is not meshed: across a thin wall it does not.
    fn sees(&self, point: DVec2) -> bool {
        self.from == self.to || left_of(self.p, self.q, point) || left_of(self.before, self.p, point)
    }
}

/// Whether a point is on the left of a line.
fn left_of(p: DVec2, q: DVec2, point: DVec2) -> bool {
    orient2d(p, q, point) > 0.0
}

#[derive(Clone, Copy, Debug)]
struct Candidate {
    apex: Apex,
    at: DVec2,
    /// Where a new node lies.
    place: Place,
    rank: f64,
    /// Whether the triangle was found valid and the rank counts everything.
    examined: bool,
}

impl Front<'_> {
    /// The best apex over the base among front nodes within `reach` δ₁ of the ideal point and new points on the
    /// bisector, if it ranks at least `least` degrees and its triangle is valid.
    pub fn candidates(&self, base: &Base, reach: f64, least: f64, with_new: bool) -> Option<Apex> {
        let radius = reach * base.side;
        let around = [base.a, base.b, base.ideal - radius, base.ideal + radius];
        let near = self.near(base, Rect::around(around));
        let mut list = self.ranked(base, &near, radius);
        if with_new {
            list.extend(self.new_node(base, Place::IDEAL));
        }
        let best = self.best(base, &near, &mut list, least);
        if !with_new || best.is_some_and(|best| best.rank >= GOOD) {
            return best.map(|best| best.apex);
        }
        let is_short = base.length < SHORT_BASE * base.side;
        let others = Place::OTHERS.iter().filter(|place| is_short || place.shift == 0.0);
        list.extend(others.filter_map(|&place| self.new_node(base, place)));
        self.best(base, &near, &mut list, least).map(|best| best.apex)
    }

    /// A new node as a candidate, with s as at the base until it is examined.
    fn new_node(&self, base: &Base, place: Place) -> Option<Candidate> {
        let at = base.apex_at(base.side, place);
        Some(Candidate {
            apex: Apex::New(at, base.side),
            at,
            place,
            rank: weight(place) * self.rank(base, None, at)?,
            examined: false,
        })
    }

    /// Whether to close the cleft between the base and the next edge by the triangle of the two.
    pub fn closes_cleft(&self, base: &Base, least: f64) -> Option<Apex> {
        let node = base.around[1];
        let at = self.at(node);
        let rank = self.rank(base, Some(node), at)?;
        if rank < least {
            return None;
        }
        let room = CLEFT_ROOM * base.length;
        let bounds = Rect::around([base.a, base.b, at]);
        let near = self.near(
            base,
            Rect {
                min: bounds.min - room,
                max: bounds.max + room,
            },
        );
        let rank = rank.min(self.examine(base, Apex::Node(node), at, &near)?);
        (rank >= least).then_some(Apex::Node(node))
    }

    /// The front edges of the base's face that may meet a box.
    fn near(&self, base: &Base, bounds: Rect) -> Vec<Near> {
        let face = self.edge(base.edge).face;
        let mut near = Vec::with_capacity(24);
        self.grid.near(bounds, |slot| {
            let edge = self.edge(slot);
            if edge.face == face && slot != base.edge {
                let from = &self.nodes[edge.from as usize];
                near.push(Near {
                    from: edge.from,
                    to: edge.to,
                    p: from.at,
                    q: self.at(edge.to),
                    before: self.at(self.edge(edge.before).from),
                    size: from.size,
                });
            }
        });
        near
    }

    /// The nodes of the front within `radius` of the ideal point, ranked by the triangle alone.
    fn ranked(&self, base: &Base, near: &[Near], radius: f64) -> Vec<Candidate> {
        let candidates = near.iter().filter_map(|edge| {
            let is_end = base.ends.contains(&edge.from);
            let is_near = base.around.contains(&edge.from) || edge.p.distance_squared(base.ideal) <= radius * radius;
            if is_end || !is_near {
                return None;
            }
            let rank = self.rank(base, Some(edge.from), edge.p)?;
            Some(Candidate {
                apex: Apex::Node(edge.from),
                at: edge.p,
                place: Place::IDEAL,
                rank,
                examined: false,
            })
        });
        candidates.collect()
    }

    /// Examines candidates, highest rank first, until an examined one ranks highest.
    fn best(&self, base: &Base, near: &[Near], list: &mut Vec<Candidate>, least: f64) -> Option<Candidate> {
        loop {
            let (place, first) = list.iter().enumerate().reduce(|best, other| {
                let better = other.1.rank > best.1.rank || (other.1.rank == best.1.rank && other.1.examined);
                if better { other } else { best }
            })?;
            let mut first = *first;
            if first.examined || first.rank < least {
                return (first.rank >= least).then_some(first);
            }
            match self.examined(base, near, &mut first) {
                Some(()) => list[place] = first,
                None => {
                    list.swap_remove(place);
                }
            }
        }
    }

    fn examined(&self, base: &Base, near: &[Near], candidate: &mut Candidate) -> Option<()> {
        let mut weigh = 1.0;
        if let Apex::New(..) = candidate.apex {
            let (at, size) = self.new_apex(base, candidate.place);
            candidate.apex = Apex::New(at, size);
            candidate.at = at;
            weigh = weight(candidate.place);
            candidate.rank = weigh * self.rank(base, None, at)?;
        }
        let room = self.examine(base, candidate.apex, candidate.at, near)?;
        candidate.rank = candidate.rank.min(weigh * room);
        candidate.examined = true;
        Some(())
    }

    /// The rank of the triangle with its apex at `at` (the front node `node`, if there is one) by its angles and the
    /// wedges it leaves; none if it does not fit into the wedges.
    fn rank(&self, base: &Base, node: Option<u32>, at: DVec2) -> Option<f64> {
        let (along, to_a, to_b) = (base.b - base.a, base.a - at, base.b - at);
        let angles = [turn(along, -to_a), turn(-to_b, -along), turn(to_a, to_b)];
        if angles.iter().any(|angle| *angle >= std::f64::consts::PI) {
            return None;
        }
        let mut rank = angles[0].min(angles[1]).min(angles[2]).to_degrees();
        let closes = [0, 1].map(|end| node == Some(base.around[end]));
        for end in [0, 1] {
            if !closes[end] {
                rank = rank.min(wedge_rank(base.wedges[end] - angles[end])?);
            }
        }
        if let Some(node) = node {
            let beside = self.wedges_beside(base, node, closes, to_a, to_b);
            rank = rank.min(beside.map_or(Some(60.0), wedge_rank)?);
        }
        Some(rank)
    }

    /// The smallest wedge left at a front node beside the sides of a triangle with its apex there.
    fn wedges_beside(&self, base: &Base, node: u32, closes: [bool; 2], to_a: DVec2, to_b: DVec2) -> Option<f64> {
        let tip = self.at(node);
        let mut least = f64::INFINITY;
        if !closes[0] {
            for out in self.leaving(node).filter(|&out| self.edge(out).to != node) {
                least = least.min(turn(self.at(self.edge(out).to) - tip, to_a));
            }
        }
        if !closes[1] {
            for into in self.entering(node).filter(|&into| self.edge(into).from != node) {
                least = least.min(turn(to_b, self.at(self.edge(into).from) - tip));
            }
        }
        debug_assert!(!base.ends.contains(&node));
        least.is_finite().then_some(least)
    }

    /// The exact test of a triangle. Returns the room that it leaves, as an angle; none if the triangle is not
    /// positive, if it holds a front node, or if one of its new sides meets the front.
    fn examine(&self, base: &Base, apex: Apex, at: DVec2, near: &[Near]) -> Option<f64> {
        if orient2d(base.a, base.b, at) <= 0.0 {
            return None;
        }
        let node = match apex {
            Apex::Node(node) => Some(node),
            Apex::New(..) => None,
        };
        let closes = [0, 1].map(|end| node == Some(base.around[end]));
        let trial = Trial {
            base,
            node,
            at,
            closes,
            sides: [base.a.distance(at), base.b.distance(at)],
            size: base.side,
            bounds: Rect::around([base.a, base.b, at]),
        };
        let mut room = f64::INFINITY;
        for edge in near {
            room = room.min(trial.against(edge)?);
        }
        Some(60.0 * room.min(1.0))
    }
}

/// A base shorter than this share of δ₁ counts as short: over it, new nodes may be off the bisector.
const SHORT_BASE: f64 = 0.9;

/// An edge shorter than this share of δ₁ counts as too short.
const SHORT: f64 = 1.0;

/// How far towards the middle of a triangle a point is moved to be inside it: far beyond rounding, but near its side.
const INWARD: f64 = 1e-6;

/// How far around a cleft the front is examined, as a share of the base.
const CLEFT_ROOM: f64 = 0.25;

/// The smallest angle with which a wedge can be closed at best, in degrees; none if nothing is left of it.
fn wedge_rank(wedge: f64) -> Option<f64> {
    let degrees = wedge.to_degrees();
    if degrees <= 0.0 {
        None
    } else if degrees < 60.0 {
        Some(degrees)
    } else if degrees < 90.0 {
        Some(90.0 - 0.5 * degrees)
    } else {
        Some((0.5 * degrees).min(60.0))
    }
}

/// A triangle to be tested against the front.
struct Trial<'a> {
    base: &'a Base,
    node: Option<u32>,
    at: DVec2,
    /// Whether the sides at a and at b are front edges already.
    closes: [bool; 2],
    /// Lengths of the sides at a and at b.
    sides: [f64; 2],
    /// δ₁.
    size: f64,
    bounds: Rect,
}

impl Trial<'_> {
    fn is_corner(&self, node: u32) -> bool {
        self.base.ends.contains(&node) || self.node == Some(node)
    }

    /// How much room a front edge leaves, where 1 is that of an equilateral triangle; none if it is in the way.
    fn against(&self, edge: &Near) -> Option<f64> {
        let corners = [self.is_corner(edge.from), self.is_corner(edge.to)];
        if corners == [true, true] {
            return Some(1.0);
        }
        if self.may_meet(edge) && self.meets(edge, corners) {
            return None;
        }
        let mut room = f64::INFINITY;
        if !corners[0] && !self.base.around.contains(&edge.from) {
            let inside = (self.base.a + self.base.b + self.at) / 3.0;
            for (end, corner) in [self.base.a, self.base.b].into_iter().enumerate() {
                let foot = closest_on_segment([corner, self.at], edge.p);
                // From a little inside the triangle, since a node on the side does not see the side itself.
                if !self.closes[end] && edge.sees(foot.lerp(inside, INWARD)) {
                    room = room.min(foot.distance(edge.p) / (HEIGHT * self.sides[end].min(edge.size)));
                }
            }
        }
        if self.node.is_none() && !corners[0] && edge.sees(self.at) {
            // If the new node is too near to another, the edge between them will be too short: the row has more nodes
            // than s asks for.
            let size = SHORT * self.size.min(edge.size);
            room = room.min(edge.p.distance_squared(self.at) / (size * size));
        }
        if self.node.is_none() && corners == [false, false] && left_of(edge.p, edge.q, self.at) {
            let distance = closest_on_segment([edge.p, edge.q], self.at).distance(self.at);
            room = room.min(distance / (HEIGHT * self.sides[0].min(edge.size)));
        }
        Some(room)
    }

    fn may_meet(&self, edge: &Near) -> bool {
        edge.p.min(edge.q).cmple(self.bounds.max).all() && self.bounds.min.cmple(edge.p.max(edge.q)).all()
    }

    /// Whether a front edge starts in the closed triangle or meets a new side away from a common corner.
    fn meets(&self, edge: &Near, corners: [bool; 2]) -> bool {
        let (a, b) = (self.base.a, self.base.b);
        if !corners[0] && self.holds(edge.p) {
            return true;
        }
        if edge.from == edge.to {
            return false;
        }
        let touches = |corner: u32| edge.from == corner || edge.to == corner;
        [a, b].into_iter().enumerate().any(|(end, corner)| {
            let shares_corner = touches(self.base.ends[end]) || self.node.is_some_and(touches);
            !self.closes[end] && !shares_corner && segments_meet(edge.p, edge.q, corner, self.at) != Meeting::Apart
        })
    }

    fn holds(&self, point: DVec2) -> bool {
        let (a, b) = (self.base.a, self.base.b);
        orient2d(a, b, point) >= 0.0 && orient2d(b, self.at, point) >= 0.0 && orient2d(self.at, a, point) >= 0.0
    }
}
