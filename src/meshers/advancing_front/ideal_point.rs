//! Where the apex over a base should be.

use super::front::Front;
use crate::geometry::DVec2;

/// A face of the front that was picked as base, and where its apex should be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Base {
    pub edge: u32,
    pub ends: [u32; 2],
    pub a: DVec2,
    pub b: DVec2,
    /// Ends of the neighbouring edges: before a, behind b.
    pub around: [u32; 2],
    /// The angles of what is not meshed at a and at b, radians.
    pub wedges: [f64; 2],
    pub length: f64,
    /// δ₁: how long the two new sides should be, as s at the ends of the base tells.
    pub side: f64,
    /// The ideal point for that.
    pub ideal: DVec2,
}

impl Base {
    /// The point over the base's middle at the given distance from both ends.
    pub fn apex(&self, side: f64) -> DVec2 {
        let along = self.b - self.a;
        let height = (side * side - 0.25 * self.length * self.length).max(0.0).sqrt();
        self.a.midpoint(self.b) + along.perp() * (height / self.length)
    }
}

impl Front<'_> {
    /// The ideal point of a base: at distance δ₁ from both of its ends, with δ₁ = s, clamped to
    /// [`super::AdvancingFront::low`] and [`super::AdvancingFront::high`] times the base.
    pub fn ideal_point(&self, edge: u32) -> Base {
        let this = *self.edge(edge);
        let (a, b) = (self.at(this.from), self.at(this.to));
        let length = a.distance(b);
        let size = 0.5 * (self.nodes[this.from as usize].size + self.nodes[this.to as usize].size);
        let mut base = Base {
            edge,
            ends: [this.from, this.to],
            a,
            b,
            around: [self.edge(this.before).from, self.edge(this.next).to],
            wedges: [self.wedge(this.before), self.wedge(edge)],
            length,
            side: self.clamped(size, length),
            ideal: a,
        };
        base.ideal = base.apex(base.side);
        base
    }

    fn clamped(&self, size: f64, length: f64) -> f64 {
        size.clamp(self.method.low * length, self.method.high * length)
    }

    /// A new node over the base at the given share of δ₁, with s there: the mean of s at the base and at the apex replaces
    /// s at the base alone. Where there is no s, as may be outside the domain, it is NaN.
    pub fn new_apex(&self, base: &Base, share: f64) -> (DVec2, f64) {
        let first = base.apex(share * base.side);
        let Ok(size) = self.sizing.at(first) else {
            return (first, f64::NAN);
        };
        let at_base = 0.5 * (self.nodes[base.ends[0] as usize].size + self.nodes[base.ends[1] as usize].size);
        let side = self.clamped(0.5 * (at_base + size), base.length);
        if (side - base.side).abs() <= SAME_SIDE * base.side {
            return (first, size);
        }
        let second = base.apex(share * side);
        (second, self.sizing.at(second).unwrap_or(f64::NAN))
    }
}

/// δ₁ is not corrected for a change by less than this share: it would cost an evaluation of f and not show.
const SAME_SIDE: f64 = 0.01;
