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
    /// δ₁: how long the two new sides should be, by s at the ends of the base.
    pub side: f64,
    /// The ideal point for that.
    pub ideal: DVec2,
}

/// A place for a new node over a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// How long the new sides should be, in δ₁.
    pub share: f64,
    /// How far the node is off the bisector, along the base, as a share of its length.
    pub shift: f64,
}

impl Place {
    pub const IDEAL: Self = Self::new(1.0, 0.0);

    pub const fn new(share: f64, shift: f64) -> Self {
        Self { share, shift }
    }

    /// Other places to try: nearer to the base, in case there is no room for the ideal one, and beside the bisector, in
    /// case the row is to have fewer nodes than bases.
    pub const OTHERS: [Self; 7] = [
        Self::new(0.85, 0.0),
        Self::new(0.7, 0.0),
        Self::new(0.58, 0.0),
        Self::new(1.0, 0.25),
        Self::new(1.0, -0.25),
        Self::new(1.0, 0.5),
        Self::new(1.0, -0.5),
    ];
}

impl Base {
    /// The point over the base's middle at the given distance from both ends.
    pub fn apex(&self, side: f64) -> DVec2 {
        self.apex_at(side, Place::IDEAL)
    }

    /// Where a new node goes, for a given δ₁.
    pub fn apex_at(&self, side: f64, place: Place) -> DVec2 {
        let along = self.b - self.a;
        let side = place.share * side;
        let height = (side * side - 0.25 * self.length * self.length).max(0.0).sqrt();
        self.a.midpoint(self.b) + along.perp() * (height / self.length) + along * place.shift
    }
}

impl Front<'_> {
    /// The base and its ideal point, at distance δ₁ from both of its ends: s, clamped to between
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

    /// A new node at a place over the base, with s there. Its place follows from the mean of s at the base and at a
    /// first apex, instead of s at the base alone. s is NaN if it has no value there, as may be outside the domain.
    pub fn new_apex(&self, base: &Base, place: Place) -> (DVec2, f64) {
        let first = base.apex_at(base.side, place);
        let Ok(size) = self.sizing.at(first) else {
            return (first, f64::NAN);
        };
        let at_base = 0.5 * (self.nodes[base.ends[0] as usize].size + self.nodes[base.ends[1] as usize].size);
        let side = self.clamped(0.5 * (at_base + size), base.length);
        if (side - base.side).abs() <= SAME_SIDE * base.side {
            return (first, size);
        }
        let second = base.apex_at(side, place);
        (second, self.sizing.at(second).unwrap_or(f64::NAN))
    }
}

/// δ₁ is not corrected for a change by less than this share: it would cost an evaluation of f and change nothing visible.
const SAME_SIDE: f64 = 0.01;
