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

    /// From the point of an item nearest to `x` to `x`, and the item's value there.
    fn offset(&self, item: u32, x: DVec2) -> (DVec2, f64);

    /// An item as seen from `x`.
    fn view(&self, item: u32, x: DVec2) -> View {
        let (offset, lowest) = self.offset(item, x);
        let distance = offset.length();
        View::new(offset, distance, lowest + self.slope() * distance)
    }

    /// α: by how much values rise with distance.
    fn slope(&self) -> f64;

    /// What stands for an item in a cell that is small against it: items of which each has a value no lower.
    fn parts(&self, _item: u32, _cell: &Rect) -> Option<Range<u32>> {
        None
    }

    /// Whether an item stands for no others, however small the cell.
    fn is_single(&self, _item: u32) -> bool {
        true
    }

    /// Where in a cell the function is ever asked for.
    fn asked_in(&self, _cell: &Rect) -> Asked {
        Asked::Everywhere
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

/// Where in a cell a function is asked for; the list of a cell where it is not is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// Nowhere.
    Nowhere,
    /// Perhaps in some of its parts.
    InPart,
    /// In all of its parts.
    Everywhere,
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
    /// The view over `offset`, which leads over `distance` from the point of K nearest to x to x.
    #[inline]
    pub fn new(offset: DVec2, distance: f64, value: f64) -> Self {
        let away = if distance > 0.0 { offset / distance } else { DVec2::ZERO };
        Self { value, distance, away }
    }

    /// By how much the distance may rise within `radius` beyond what its gradient here says, or fall short of it.
    #[inline]
    pub fn turn(&self, radius: f64) -> f64 {
        if self.distance > radius {
            0.5 * radius * radius / (self.distance - radius)
        } else {
            f64::INFINITY
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gradient_turns_by_half_the_square_of_the_radius_over_what_is_left_of_the_distance() {
        let view = |offset: DVec2| View::new(offset, offset.length(), 7.0);
        let far = view(DVec2::new(3.0, 4.0));
        assert_eq!((far.value, far.distance, far.away), (7.0, 5.0, DVec2::new(0.6, 0.8)));
        assert_eq!(far.turn(0.5), 0.125 / 4.5);
        // Within the radius it may turn any way.
        assert_eq!(far.turn(5.0), f64::INFINITY);
        assert_eq!(view(DVec2::ZERO).away, DVec2::ZERO);
    }
}
