//! A PSLG in the making, which accepts a part only if it meets no other.

use crate::domain::{InputSegment, Pslg};
use crate::geometry::DVec2;
use crate::geometry::predicates::{Meeting, segments_meet};
use rand::RngExt;
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// A PSLG and the random numbers that draw it.
pub(super) struct Draft {
    pub pslg: Pslg,
    random: Pcg64,
}

impl Draft {
    pub fn new(random: Pcg64) -> Self {
        Self {
            pslg: Pslg::new("random-pslg"),
            random,
        }
    }

    /// The PSLG, and what is left of the stream of numbers.
    pub fn into_parts(self) -> (Pslg, Pcg64) {
        (self.pslg, self.random)
    }

    /// A number from `low` to `high`.
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.random.random_range(0.0..1.0)
    }

    /// 10 to a power from `low` to `high`.
    pub fn power(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.number(low, high))
    }

    /// A whole number from `low` to `high`.
    pub fn count(&mut self, low: usize, high: usize) -> usize {
        self.random.random_range(low..high + 1)
    }

    /// Whether something with that probability happens.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.random.random_range(0.0..1.0) < probability
    }

    /// A seed for another generator.
    pub fn seed(&mut self) -> u64 {
        self.random.random_range(0..u64::MAX)
    }

    /// A point of the unit square.
    pub fn point(&mut self) -> DVec2 {
        DVec2::new(self.number(0.0, 1.0), self.number(0.0, 1.0))
    }

    /// A unit vector.
    pub fn direction(&mut self) -> DVec2 {
        DVec2::from_angle(self.number(0.0, TAU))
    }

    /// Replaces what was drawn so far.
    pub fn start_with(&mut self, pslg: Pslg) {
        self.pslg = pslg;
    }

    /// Adds a ring, if its segments are free and no vertex lies in another's way.
    pub fn ring(&mut self, points: &[DVec2]) -> bool {
        let before = (self.pslg.vertices.len(), self.pslg.segments.len());
        let whole = (0..points.len()).all(|k| {
            let v = match k {
                0 => self.vertex(points[0]),
                _ => self.reach(self.pslg.vertices.len() - 1, points[k]),
            };
            v.is_some()
        });
        if whole && points.len() > 2 && self.join(self.pslg.vertices.len() - 1, before.0) {
            return true;
        }
        self.pslg.vertices.truncate(before.0);
        self.pslg.segments.truncate(before.1);
        false
    }

    /// Adds a hole: a ring around `inside`, which must lie in it.
    pub fn hole(&mut self, points: &[DVec2], inside: DVec2) -> bool {
        let added = self.ring(points);
        if added {
            self.pslg.add_hole(inside);
        }
        added
    }

    /// Adds a vertex, unless something is there already.
    pub fn vertex(&mut self, x: DVec2) -> Option<usize> {
        let is_taken = self.pslg.vertices.contains(&x)
            || (0..self.pslg.segments.len()).any(|s| {
                let [a, b] = self.pslg.ends(s);
                segments_meet(x, x, a, b) != Meeting::Apart
            });
        (!is_taken && x.is_finite()).then(|| self.pslg.add_vertex(x))
    }

    /// Adds a segment from vertex `u` to a new vertex at `x`, if it is free; returns the new vertex.
    pub fn reach(&mut self, u: usize, x: DVec2) -> Option<usize> {
        let v = self.vertex(x)?;
        if self.join(u, v) {
            Some(v)
        } else {
            self.pslg.vertices.pop();
            None
        }
    }

    /// Adds a segment between two vertices, if it meets nothing but at its ends.
    pub fn join(&mut self, u: usize, v: usize) -> bool {
        let free = u != v && self.is_free(u, v);
        if free {
            self.pslg.segments.push(InputSegment { a: u, b: v, marker: 2 });
        }
        free
    }

    fn is_free(&self, u: usize, v: usize) -> bool {
        let pslg = &self.pslg;
        let (p, q) = (pslg.vertices[u], pslg.vertices[v]);
        let clear =
            |w: usize| w == u || w == v || segments_meet(pslg.vertices[w], pslg.vertices[w], p, q) == Meeting::Apart;
        let apart = |s: usize| {
            let InputSegment { a, b, .. } = pslg.segments[s];
            let [c, d] = pslg.ends(s);
            let is_incident = [a, b].iter().any(|end| [u, v].contains(end));
            match segments_meet(p, q, c, d) {
                Meeting::Apart => true,
                // Two segments that touch elsewhere than at a common vertex have a vertex on a segment, found by `clear`.
                Meeting::Touch => is_incident,
                Meeting::Cross | Meeting::Overlap => false,
            }
        };
        (0..pslg.vertices.len()).all(clear)
            && (0..pslg.segments.len()).all(apart)
            && pslg
                .holes()
                .iter()
                .all(|&hole| segments_meet(hole, hole, p, q) == Meeting::Apart)
    }
}
