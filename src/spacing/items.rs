//! The items that short lists are made of, as seen from a point.

use crate::geometry::{DVec2, Rect};
use std::ops::Range;

/// Share of [`Items::is_fine`] for features. Meshes and integrals ask a few times in such a cell where spacing follows lfs: a
/// shorter list would take longer to make than it saves.
const FINEST: f64 = 1.0 / 32.0;

/// [`Items::short`] of features.
const SHORT: usize = 16;

/// What decides a function: convex sets, each with a value that rises with the distance from it.
pub trait Items: Sync {
    /// The function at `x` if the items in `list` are all there are, and the items that decide it: one twice, or two.
    fn decide(&self, list: &[u32], x: DVec2) -> (f64, [u32; 2]);

    /// An item as seen from `x`.
    fn view(&self, item: u32, x: DVec2) -> View;

    /// α: by how much values rise with distance.
    fn slope(&self) -> f64;

    /// What stands for an item in a cell that is small against it: items of which each has a value no lower.
    fn parts(&self, _item: u32, _cell: &Rect) -> Option<Range<u32>> {
        None
    }

    /// Whether the function is ever asked for in a cell: the list of another is empty.
    fn is_asked_in(&self, _cell: &Rect) -> bool {
        true
    }

    /// Whether a cell is not to be split: its radius as a share of the function at its centre, and how long its list is.
    fn is_fine(&self, share: f64, _count: usize) -> bool {
        share <= FINEST
    }

    /// A list longer than this is of no use: that of its cell is empty.
    fn longest(&self) -> usize {
        usize::MAX
    }

    /// A list this short is not worth splitting.
    fn short(&self) -> usize {
        SHORT
    }
}

/// An item K as seen from a point x.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Its value there.
    pub value: f64,
    /// dist(x, K).
    pub distance: f64,
    /// ∇ dist: the unit vector away from K, 0 inside K.
    pub away: DVec2,
}

impl View {
    /// The view over `offset`, which leads from the point of K nearest to x to x, of an item that has `lowest` on K.
    pub fn new(offset: DVec2, lowest: f64, slope: f64) -> Self {
        let distance = offset.length();
        let away = if distance > 0.0 { offset / distance } else { DVec2::ZERO };
        Self {
            value: lowest + slope * distance,
            distance,
            away,
        }
    }

    /// By how much the distance to `other` may gain on the distance to this one within `radius`.
    pub fn margin(&self, other: &Self, radius: f64) -> f64 {
        let turn = |view: &Self| {
            if view.distance > radius {
                0.5 * radius * radius / (view.distance - radius)
            } else {
                f64::INFINITY
            }
        };
        (radius * self.away.distance(other.away) + turn(self) + turn(other)).min(2.0 * radius)
    }
}
