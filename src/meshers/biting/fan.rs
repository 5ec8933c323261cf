//! The edges around a vertex that is cut off: between neighbouring segments, or more than one where those are far apart.
//!
//! # Idea
//! Circles at the ends of a cut edge must overlap above it and not hold each other, so that edges which share an end
//! differ in length by a factor of 1.3 to 1.5 at most. An angle wider than that beside a narrow one is divided, with
//! parts that grow away from the narrow one. No part need be smaller than the smallest angle at the vertex, but for angles
//! between about 1.5 and 2 times a neighbour: these are halved, and counted.

use super::corners::SHARE;
use crate::domain::{Domain, Wedge};
use crate::geometry::DVec2;
use crate::geometry::near::least_meeting_height;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

/// Room for what f loses to rounding when two edges share an end.
const ROOM: f64 = 1.01;

/// How fast parts grow away from a narrow angle: by this share of t, and with this t at most.
const GROWTH: f64 = 0.8;
const MOST_T: f64 = 0.25;

/// The largest part of an angle of 90° or more.
const WIDEST_PART: f64 = FRAC_PI_3;

/// Most rounds of dividing further where neighbours differ too much.
const ROUNDS: usize = 64;

/// Steps to an angle when parts of equal weight are laid out in it.
const STEPS: usize = 256;

/// A cut edge, for a cut at distance 1 from the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
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

    /// The smallest radius of circles at its ends: they meet at least as high above it as (9) says, and hold every point that
    /// sees it under more than 175° less its angle.
    pub fn least_radius(&self, t: f64) -> f64 {
        // Equal radii ρ at distance 2 meet at height √(ρ² − 1).
        let height = least_meeting_height(t.min(1.0));
        let by_height = 1.0 / (1.0 - height * height).sqrt();
        let by_angle = 1.0 / (0.5 * (175f64.to_radians() - self.angle)).sin();
        0.5 * self.width() * by_height.max(by_angle)
    }
}

/// The cut edges of a vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct Fan {
    pub edges: Vec<Edge>,
    /// Unit vectors to the ends of edges that are on no segment.
    pub between: Vec<DVec2>,
    /// How many angles were divided into parts smaller than the smallest angle.
    pub narrowed: usize,
}

impl Fan {
    /// Of vertex `v`, for a spacing that grows with `t`.
    pub fn new(domain: &Domain, v: usize, t: f64) -> Self {
        let mut fan = Self::default();
        for run in runs(domain.wedges(v)) {
            let angles: Vec<f64> = run.wedges.iter().map(|wedge| wedge.angle).collect();
            let smallest = angles.iter().copied().fold(f64::INFINITY, f64::min);
            for (wedge, parts) in run.wedges.iter().zip(divide(&angles, run.is_closed, t)) {
                fan.narrowed += usize::from(parts.iter().any(|part| *part < smallest * (1.0 - 1e-9)));
                let [from, to] = [wedge.from, wedge.to].map(|s| domain.away(s, v).0);
                let (mut start, mut turned) = (from, 0.0);
                for (k, &angle) in parts.iter().enumerate() {
                    turned += angle;
                    let end = if k + 1 == parts.len() {
                        to
                    } else {
                        DVec2::from_angle(turned).rotate(from)
                    };
                    fan.edges.push(Edge {
                        ends: [start, end],
                        angle,
                    });
                    if k + 1 < parts.len() {
                        fan.between.push(end);
                    }
                    start = end;
                }
            }
        }
        fan
    }
}

/// Wedges inside the domain, each beside the next.
struct Run {
    wedges: Vec<Wedge>,
    /// Whether the last is beside the first.
    is_closed: bool,
}

fn runs(wedges: &[Wedge]) -> Vec<Run> {
    let Some(outside) = wedges.iter().position(|wedge| !wedge.inside) else {
        return vec![Run {
            wedges: wedges.to_vec(),
            is_closed: wedges.len() > 1,
        }];
    };
    let mut turned = wedges.to_vec();
    turned.rotate_left(outside);
    let runs = turned.split(|wedge| !wedge.inside).filter(|run| !run.is_empty());
    runs.map(|run| Run {
        wedges: run.to_vec(),
        is_closed: false,
    })
    .collect()
}

/// The parts of each angle, counter-clockwise.
fn divide(angles: &[f64], is_closed: bool, t: f64) -> Vec<Vec<f64>> {
    let sizes: Vec<Size> = sizes(angles, is_closed, GROWTH * t.min(MOST_T));
    let mut counts: Vec<usize> = sizes
        .iter()
        .map(|size| size.total().round().max(1.0) as usize)
        .collect();
    for _ in 0..ROUNDS {
        let parts: Vec<Vec<f64>> = sizes
            .iter()
            .zip(&counts)
            .map(|(size, count)| size.parts(*count))
            .collect();
        let all: Vec<(usize, f64)> = parts
            .iter()
            .enumerate()
            .flat_map(|(k, parts)| parts.iter().map(move |part| (k, *part)))
            .collect();
        let next = |k: usize| (k + 1 < all.len() || is_closed).then(|| all[(k + 1) % all.len()]);
        let misfit = (0..all.len()).find_map(|k| {
            let (one, other) = (all[k], next(k)?);
            let (narrow, wide) = if one.1 < other.1 { (one, other) } else { (other, one) };
            (!fit(narrow.1, wide.1, t)).then_some(wide.0)
        });
        match misfit {
            Some(wedge) => counts[wedge] += 1,
            None => return parts,
        }
    }
    sizes
        .iter()
        .zip(&counts)
        .map(|(size, count)| size.parts(*count))
        .collect()
}

/// Whether edges of these angles can share an end: its circle must not hold the ends of the one and suffice for the other.
fn fit(narrow: f64, wide: f64, t: f64) -> bool {
    let edge = |angle| Edge {
        ends: [DVec2::X; 2],
        angle,
    };
    SHARE * edge(narrow).width() >= ROOM * edge(wide).least_radius(t)
}

/// The size of parts within an angle: the least of three lines.
struct Size {
    angle: f64,
    most: f64,
    /// At its two ends.
    ends: [f64; 2],
    growth: f64,
}

/// What each angle may have for parts, growing away from the narrow ones.
fn sizes(angles: &[f64], is_closed: bool, growth: f64) -> Vec<Size> {
    let most = |angle: f64| {
        if angle < FRAC_PI_2 {
            angle
        } else {
            angle / (angle / WIDEST_PART).ceil()
        }
    };
    let mut sizes: Vec<Size> = angles
        .iter()
        .map(|&angle| Size {
            angle,
            most: most(angle),
            ends: [f64::INFINITY; 2],
            growth,
        })
        .collect();
    let count = angles.len();
    let laps = if is_closed { 2 } else { 1 };
    let mut reach = [f64::INFINITY; 2];
    for k in 0..laps * count {
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

    /// How many parts there are by size in each of [`STEPS`] steps.
    fn weights(&self) -> impl Iterator<Item = f64> {
        let step = self.angle / STEPS as f64;
        (0..STEPS).map(move |k| step / self.at((k as f64 + 0.5) * step))
    }

    fn total(&self) -> f64 {
        self.weights().sum()
    }

    /// That many parts of equal weight.
    fn parts(&self, count: usize) -> Vec<f64> {
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

    fn parts(degrees: &[f64], is_closed: bool) -> Vec<Vec<f64>> {
        let angles: Vec<f64> = degrees.iter().map(|angle| angle.to_radians()).collect();
        divide(&angles, is_closed, 0.25)
    }

    #[test]
    fn angles_that_fit_stay_whole() {
        let whole = |degrees: &[f64]| parts(degrees, false).iter().all(|parts| parts.len() == 1);
        assert!(whole(&[1.0]) && whole(&[89.0]) && whole(&[10.0, 12.0, 10.0]) && whole(&[80.0, 85.0]));
        assert!(!whole(&[10.0, 20.0]) && !whole(&[40.0, 100.0]));
    }

    #[test]
    fn parts_fill_their_angles_and_fit_their_neighbours() {
        for degrees in [
            &[1.0, 179.0][..],
            &[30.0, 150.0, 30.0, 150.0],
            &[5.0, 60.0, 7.0, 200.0, 88.0],
            &[2.0, 3.5, 354.5],
        ] {
            let sum: f64 = degrees.iter().sum();
            let is_closed = sum > 359.0;
            let parts = parts(degrees, is_closed);
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
            let last = is_closed.then(|| [all[all.len() - 1], all[0]]);
            for [one, other] in pairs.chain(last) {
                assert!(fit(one.min(other), one.max(other), 0.25), "{degrees:?}: {one} {other}");
            }
            assert!(all.len() < 80, "{degrees:?}: {}", all.len());
        }
    }
}
