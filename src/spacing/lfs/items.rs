//! The items that short lists are made of, as seen from a point.

use crate::geometry::{DVec2, Rect};
use std::ops::Range;

/// Share of [`Items::is_fine`] for features. If the spacing follows lfs, meshes and integrals query such a cell a few times: a
/// shorter list would take longer to make than it saves.
const FINEST: f64 = 1.0 / 32.0;

/// [`Items::short`] of features.
const SHORT: usize = 16;

/// The items that decide a function: convex sets, each with a value that rises with the distance from it.
pub trait Items: Sync {
    /// The function at `x` if there are no items but those in `list`, and the items that decide it: one twice, or two.
    fn decide(&self, list: &[u32], x: DVec2) -> (f64, [u32; 2]);

    /// From the point of an item nearest to `x` to `x`, and the item's value there.
    fn offset(&self, item: u32, x: DVec2) -> (DVec2, f64);

    /// An item as seen from `x`.
    fn view(&self, item: u32, x: DVec2) -> View {
        let (offset, lowest) = self.offset(item, x);
        let distance = offset.length();
        View::new(offset, distance, lowest + self.slope() * distance)
    }

    /// α: how much values rise per unit of distance.
    fn slope(&self) -> f64;

    /// The items that replace an item in a cell that is small beside it; none of them has a lower value.
    fn parts(&self, _item: u32, _cell: &Rect) -> Option<Range<u32>> {
        None
    }

    /// Whether an item is replaced by no others, however small the cell.
    fn is_single(&self, _item: u32) -> bool {
        true
    }

    /// Where in a cell the function can be asked for.
    fn asked_in(&self, _cell: &Rect) -> Asked {
        Asked::Everywhere
    }

    /// Whether a cell is fine enough, by its radius as a share of the function at its centre and by the length of its list.
    fn is_fine(&self, share: f64, _count: usize) -> bool {
        share <= FINEST
    }

    /// A list longer than this is of no use, and the cell gets an empty one.
    fn longest(&self) -> usize {
        usize::MAX
    }

    /// A list this short is not worth splitting.
    fn short(&self) -> usize {
        SHORT
    }
}

/// Where in a cell a function is asked for; a cell in which it never is has an empty list.
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
    /// The view of an item K from x, by the `offset` from the point of K nearest to x to x and its length, `distance`.
    #[inline]
    pub fn new(offset: DVec2, distance: f64, value: f64) -> Self {
        let away = if distance > 0.0 { offset / distance } else { DVec2::ZERO };
        Self { value, distance, away }
    }

    /// By how much the distance may differ within `radius` from what its gradient here predicts.
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
        // Within the radius it may turn in any direction.
        assert_eq!(far.turn(5.0), f64::INFINITY);
        assert_eq!(view(DVec2::ZERO).away, DVec2::ZERO);
    }
}
