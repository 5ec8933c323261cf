//! The edges around a vertex that is cut off: one or more between each two neighbouring segments.
//!
//! # Idea
//! Circles at the ends of a cut edge must overlap above it, but not hold each other's centres. So edges which share an
//! end differ in length by a factor of at most 1.3 to 1.5. A wider angle beside a narrow one is divided into parts that
//! grow away from the narrow one. No part need be smaller than the smallest angle at the vertex, with one exception:
//! angles between about 1.5 and 2 times a neighbour are halved, and counted.

use crate::domain::{Domain, Wedge};
use crate::geometry::DVec2;
use crate::meshers::biting::beyond::corners::SHARE;
use crate::theory::Rule;
use crate::theory::least_meeting_height;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

/// Room for what rounding takes from f when two edges share an end.
const ROOM: f64 = 1.01;

/// How fast parts grow away from a narrow angle: with this share of t, and as if t were at most [`MOST_T`].
const GROWTH: f64 = 0.8;
const MOST_T: f64 = 0.25;

/// The largest part of an angle of 90° or more.
const WIDEST_PART: f64 = FRAC_PI_3;

/// How many numbers of parts [`fewest_parts`] tries, from the least possible on.
const MOST_PARTS: i32 = 16;

/// Most rounds in which wedges are divided further because neighbours differ too much.
const ROUNDS: usize = 64;

/// Steps into which an angle is divided to lay out parts of equal weight in it.
const STEPS: usize = 256;

/// A cut edge, for a cut at distance 1 from the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::meshers::biting) struct Edge {
    /// Unit vectors to its ends, counter-clockwise.
    pub ends: [DVec2; 2],
    /// The angle between them.
    pub angle: f64,
}

impl Edge {
    /// Its length, 2 sin(θ/2).
    pub fn width(&self) -> f64 {
        2.0 * (0.5 * self.angle).sin()
    }

    /// The smallest radius of circles at its ends. From this on they meet at least as high above it as (9) says, and
    /// hold every point that sees it under more than 175° less its angle.
    ///
    /// By the rule of the later point, ends of radius r are only sure to eat their circles of radius r / (1 + t).
    /// Points outside both circles see the edge under at most φ, where sin(φ/2) is half the edge over r / (1 + t). The
    /// angles they make with it are at least 90° − φ/2, which must not be below asin((1 − t) / 2).
    pub fn least_radius(&self, t: f64, rule: Rule) -> f64 {
        let by_angle = 1.0 / (0.5 * (175f64.to_radians() - self.angle)).sin();
        let half = 0.5 * self.width();
        match rule {
            Rule::Earlier => {
                // Equal radii ρ at distance 2 meet at height √(ρ² − 1).
                let height = least_meeting_height(t.min(1.0));
                let by_height = 1.0 / (1.0 - height * height).sqrt();
                half * by_height.max(by_angle)
            }
            Rule::Later => {
                let by_height = 1.0 / (1.0 - 0.25 * (1.0 - t) * (1.0 - t)).sqrt();
                half * (1.0 + t) * by_height.max(by_angle)
            }
        }
    }

    /// The largest radius of circles at its ends, beside segments at its angle: they do not hold each other's centres
    /// and, by the rule of the later point, no point of one segment eats one of the other.
    pub fn most_radius(&self, rule: Rule) -> f64 {
        slope_beside(self.angle, rule)
    }
}

/// How fast circles may grow along two segments that face each other at `angle`, with the distance from their vertex:
/// by a share of the width there and, by the rule of the later point, by no more than the distance to the other
/// segment.
pub(in crate::meshers::biting) fn slope_beside(angle: f64, rule: Rule) -> f64 {
    let width = SHARE * 2.0 * (0.5 * angle).sin();
    rule.of(width, width.min(angle.sin()))
}

/// The cut edges of a vertex.
#[derive(Clone, Debug, Default)]
pub(in crate::meshers::biting) struct Fan {
    pub edges: Vec<Edge>,
    /// Unit vectors to the ends of edges that are on no segment.
    pub between: Vec<DVec2>,
    /// How many angles were divided into parts smaller than the smallest angle.
    pub narrowed: usize,
}

impl Fan {
    /// The fan of vertex `v`, for a spacing that grows with slope `t`.
    pub fn new(domain: &Domain, v: usize, t: f64, rule: Rule) -> Self {
        let mut fan = Self::default();
        let wedges = domain.wedges(v);
        let inside = wedges.iter().filter(|wedge| wedge.inside);
        let smallest = inside.map(|wedge| wedge.angle).fold(f64::INFINITY, f64::min);
        for (wedge, parts) in wedges.iter().zip(divide(wedges, t, rule)) {
            fan.narrowed += usize::from(parts.iter().any(|part| *part < smallest * (1.0 - 1e-9)));
            let [from, to] = [wedge.from, wedge.to].map(|s| domain.away(s, v).0);
            let (mut start, mut turned) = (from, 0.0);
            for (k, &angle) in parts.iter().enumerate() {
                turned += angle;
                let is_last = k + 1 == parts.len();
                let end = if is_last {
                    to
                } else {
                    DVec2::from_angle(turned).rotate(from)
                };
                fan.edges.push(Edge {
                    ends: [start, end],
                    angle,
                });
                if !is_last {
                    fan.between.push(end);
                }
                start = end;
            }
        }
        fan
    }
}

/// The parts of each wedge around a vertex, counter-clockwise; a wedge outside has none.
fn divide(wedges: &[Wedge], t: f64, rule: Rule) -> Vec<Vec<f64>> {
    let sizes = sizes(wedges, [GROWTH * t.min(MOST_T), t], rule);
    let whole = |size: &Size| size.total().round().max(1.0) as usize;
    let counts = wedges
        .iter()
        .zip(&sizes)
        .map(|(wedge, size)| if wedge.inside { whole(size) } else { 0 });
    let mut counts: Vec<usize> = counts.collect();
    let all_parts = |counts: &[usize]| {
        sizes
            .iter()
            .zip(counts)
            .map(|(size, count)| size.parts(*count))
            .collect()
    };
    for _ in 0..ROUNDS {
        let parts: Vec<Vec<f64>> = all_parts(&counts);
        match misfit(wedges, &parts, t, rule) {
            Some(wedge) => counts[wedge] += 1,
            None => return parts,
        }
    }
    all_parts(&counts)
}

/// A wedge with a part that is too wide for the part beside it.
fn misfit(wedges: &[Wedge], parts: &[Vec<f64>], t: f64, rule: Rule) -> Option<usize> {
    let each = |k: usize| parts[k].iter().map(move |part| wedges[k].inside.then_some((k, *part)));
    // If a wedge lies outside, the parts before and after it share no end.
    let outside = |k: usize| (!wedges[k].inside).then_some(None);
    let all: Vec<Option<(usize, f64)>> = (0..wedges.len()).flat_map(|k| each(k).chain(outside(k))).collect();
    (0..all.len()).find_map(|k| {
        let (one, other) = (all[k]?, all[(k + 1) % all.len()]?);
        let (narrow, wide) = if one.1 < other.1 { (one, other) } else { (other, one) };
        (!fit(narrow.1, wide.1, t, rule)).then_some(wide.0)
    })
}

/// Whether edges of these angles can share an end: its circle must not hold the other end of the narrow edge, and must
/// be large enough for the wide one.
fn fit(narrow: f64, wide: f64, t: f64, rule: Rule) -> bool {
    SHARE * edge(narrow).width() >= ROOM * edge(wide).least_radius(t, rule)
}

fn edge(angle: f64) -> Edge {
    Edge {
        ends: [DVec2::X; 2],
        angle,
    }
}

/// The fewest equal parts of an angle for which edges fit, if it need not be divided for its neighbours.
fn fewest_parts(angle: f64, t: f64, rule: Rule) -> f64 {
    let is_flat = angle >= FRAC_PI_2;
    let fits = |count: f64| {
        let edge = edge(angle / count);
        let most = if is_flat || count > 1.0 {
            SHARE * edge.width()
        } else {
            edge.most_radius(rule)
        };
        most >= ROOM * edge.least_radius(t, rule)
    };
    let least = if is_flat { (angle / WIDEST_PART).ceil() } else { 1.0 };
    (0..MOST_PARTS)
        .map(|more| least + f64::from(more))
        .find(|count| fits(*count))
        .unwrap_or(least)
}

/// The size of parts within an angle: at each place, the least of three linear functions.
struct Size {
    angle: f64,
    most: f64,
    /// The sizes at its two ends.
    ends: [f64; 2],
    growth: f64,
}

/// The sizes of parts that each wedge may have, growing away from the narrow ones. They grow on through wedges outside,
/// since circles grow no faster across these.
fn sizes(wedges: &[Wedge], [growth, t]: [f64; 2], rule: Rule) -> Vec<Size> {
    let most = |wedge: &Wedge| match wedge.angle {
        _ if !wedge.inside => f64::INFINITY,
        angle => angle / fewest_parts(angle, t, rule),
    };
    let size = |wedge: &Wedge| Size {
        angle: wedge.angle,
        most: most(wedge),
        ends: [f64::INFINITY; 2],
        growth,
    };
    let mut sizes: Vec<Size> = wedges.iter().map(size).collect();
    let (count, mut reach) = (wedges.len(), [f64::INFINITY; 2]);
    // Twice around, so that every wedge is reached from every other.
    for k in 0..2 * count {
        for (end, at) in [(0, k % count), (1, count - 1 - k % count)] {
            let size = &mut sizes[at];
            size.ends[end] = size.ends[end].min(reach[end]);
            reach[end] = size.most.min(reach[end] + growth * size.angle);
        }
    }
    sizes
}

impl Size {
    fn at(&self, turned: f64) -> f64 {
        let [first, second] = self.ends;
        let grown = (first + self.growth * turned).min(second + self.growth * (self.angle - turned));
        self.most.min(grown)
    }

    /// For each of [`STEPS`] steps, how many parts fall on it by size.
    fn weights(&self) -> impl Iterator<Item = f64> {
        let step = self.angle / STEPS as f64;
        (0..STEPS).map(move |k| step / self.at((k as f64 + 0.5) * step))
    }

    fn total(&self) -> f64 {
        self.weights().sum()
    }

    /// `count` parts of equal weight.
    fn parts(&self, count: usize) -> Vec<f64> {
        if count == 0 {
            return Vec::new();
        }
        let (step, share) = (self.angle / STEPS as f64, self.total() / count as f64);
        let (mut parts, mut weight, mut placed) = (Vec::with_capacity(count), 0.0, 0.0);
        for (k, added) in self.weights().enumerate() {
            while parts.len() + 1 < count && weight + added >= share * (parts.len() + 1) as f64 {
                let within = (share * (parts.len() + 1) as f64 - weight) / added;
                let end = (k as f64 + within) * step;
                parts.push(end - placed);
                placed = end;
            }
            weight += added;
        }
        parts.push(self.angle - placed);
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The parts of angles inside; what is left of 360° is outside.
    fn parts(degrees: &[f64]) -> Vec<Vec<f64>> {
        let wedge = |degrees: f64, inside: bool| Wedge {
            from: 0,
            to: 1,
            angle: degrees.to_radians(),
            face: 0,
            inside,
        };
        let mut wedges: Vec<Wedge> = degrees.iter().map(|&degrees| wedge(degrees, true)).collect();
        let left = 360.0 - degrees.iter().sum::<f64>();
        if left > 0.0 {
            wedges.push(wedge(left, false));
        }
        let mut parts = divide(&wedges, 0.25, Rule::Earlier);
        parts.truncate(degrees.len());
        parts
    }

    #[test]
    fn angles_that_fit_stay_whole() {
        let whole = |degrees: &[f64]| parts(degrees).iter().all(|parts| parts.len() == 1);
        assert!(whole(&[1.0]) && whole(&[89.0]) && whole(&[10.0, 12.0, 10.0]) && whole(&[80.0, 85.0]));
        assert!(!whole(&[10.0, 20.0]) && !whole(&[40.0, 100.0]));
    }

    #[test]
    fn parts_fill_their_angles_and_fit_their_neighbours() {
        for degrees in [
            &[1.0, 179.0][..],
            &[30.0, 150.0, 30.0, 150.0],
            &[5.0, 60.0, 7.0, 200.0, 87.0],
            &[2.0, 3.5, 354.5],
        ] {
            let parts = parts(degrees);
            for (parts, angle) in parts.iter().zip(degrees) {
                assert!((parts.iter().sum::<f64>().to_degrees() - angle).abs() < 1e-9);
            }
            let all: Vec<f64> = parts.concat();
            let smallest = degrees.iter().copied().fold(f64::INFINITY, f64::min);
            assert!(
                all.iter().all(|part| part.to_degrees() > 0.7 * smallest),
                "{degrees:?}: {all:?}"
            );
            let pairs = all.windows(2).map(|pair| [pair[0], pair[1]]);
            let last = (degrees.iter().sum::<f64>() > 359.0).then(|| [all[all.len() - 1], all[0]]);
            for [one, other] in pairs.chain(last) {
                assert!(
                    fit(one.min(other), one.max(other), 0.25, Rule::Earlier),
                    "{degrees:?}: {one} {other}"
                );
            }
            assert!(all.len() < 80, "{degrees:?}: {}", all.len());
        }
    }

    #[test]
    fn sizes_grow_on_across_a_notch() {
        // 2° inside, 4° outside, 60° inside: beside the notch, the parts of the 60° are as small as the 2° demand.
        let wedge = |degrees: f64, inside| Wedge {
            from: 0,
            to: 1,
            angle: f64::to_radians(degrees),
            face: 0,
            inside,
        };
        let parts = divide(
            &[
                wedge(2.0, true),
                wedge(4.0, false),
                wedge(60.0, true),
                wedge(294.0, false),
            ],
            0.25,
            Rule::Earlier,
        );
        assert!(parts[0].len() == 1 && parts[1].is_empty() && parts[3].is_empty());
        assert!(
            parts[2][0].to_degrees() < 5.0 && parts[2][parts[2].len() - 1].to_degrees() > 8.0,
            "{parts:?}"
        );
    }
}
