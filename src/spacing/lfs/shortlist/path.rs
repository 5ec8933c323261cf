//! Which leaf of the tree a point is in, read off its place in the root as two binary fractions.

use crate::geometry::DVec2;

/// Bits of a place in the root along each axis, out of 64: a level takes one bit of each axis, or two of one.
const BITS: i32 = 63;

/// Most levels of strips: they suffice for a root a million million times as long as wide, and leave bits for all levels.
const STRIPS: usize = 20;

/// How cells are cut into four parts, and how a place in the root becomes a path through them.
#[derive(Clone, Debug)]
pub struct Scale {
    /// 2^[`BITS`] / (side of the root).
    per_length: DVec2,
    /// Levels at the top whose cells, more than twice as long as wide, are cut into strips across this axis.
    strips: usize,
    across: usize,
}

/// Which parts of parts of the root a point is in: the bits of its two coordinates that are still to be used, the next one first.
pub struct Path {
    bits: [u64; 2],
    strips: usize,
    across: usize,
}

impl Scale {
    /// For a root of the given size.
    pub fn new(size: DVec2) -> Self {
        let across = usize::from(size.y > size.x);
        let mut ratio = size[across] / size[1 - across];
        let mut strips = 0;
        while ratio > 2.0 && strips < STRIPS {
            ratio *= 0.25;
            strips += 1;
        }
        Self {
            per_length: 2f64.powi(BITS) / size,
            strips,
            across,
        }
    }

    /// The axes along which a cell at that depth is halved, one after the other: its parts are quarters, or strips.
    pub fn axes(&self, depth: usize) -> [usize; 2] {
        if depth < self.strips { [self.across; 2] } else { [0, 1] }
    }

    /// The path to a place that is given from the root's lower corner.
    #[inline]
    pub fn path(&self, from_corner: DVec2) -> Path {
        // The root's upper sides belong to it.
        let bits = |share: f64| (share as u64).min((1 << BITS) - 1) << 1;
        Path {
            bits: (from_corner * self.per_length).to_array().map(bits),
            strips: self.strips,
            across: self.across,
        }
    }
}

impl Path {
    /// The number of the next part.
    #[inline]
    pub fn step(&mut self) -> usize {
        if self.strips > 0 {
            self.strips -= 1;
            return 2 * self.bit(self.across) + self.bit(self.across);
        }
        2 * self.bit(0) + self.bit(1)
    }

    #[inline]
    fn bit(&mut self, axis: usize) -> usize {
        let bit = self.bits[axis] >> (u64::BITS - 1);
        self.bits[axis] <<= 1;
        bit as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(size: DVec2, x: (f64, f64)) -> Vec<usize> {
        let mut path = Scale::new(size).path(x.into());
        (0..5).map(|_| path.step()).collect()
    }

    #[test]
    fn a_cell_has_four_quarters_or_where_it_is_more_than_twice_as_long_as_wide_four_strips_across() {
        let axes = |x: f64, y: f64| [0, 1, 2].map(|depth| Scale::new(DVec2::new(x, y)).axes(depth));
        assert_eq!(axes(1.0, 1.0), [[0, 1]; 3]);
        assert_eq!(axes(2.0, 1.0), [[0, 1]; 3]);
        assert_eq!(axes(2.1, 1.0), [[0, 0], [0, 1], [0, 1]]);
        assert_eq!(axes(1.0, 8.1), [[1, 1], [1, 1], [0, 1]]);
        // No end of strips.
        assert_eq!(Scale::new(DVec2::X).axes(STRIPS), [0, 1]);
    }

    #[test]
    fn a_path_is_made_of_the_bits_of_both_coordinates() {
        // 0.8125 = 0.1101, 0.3125 = 0.0101.
        let square = DVec2::ONE;
        assert_eq!(steps(square, (0.8125, 0.3125)), [0b10, 0b11, 0b00, 0b11, 0b00]);
        assert_eq!(steps(square, (0.0, 0.0)), [0; 5]);
        assert_eq!(steps(square, (1.0, 1.0)), [3; 5]);
        // Two bits of one axis first.
        assert_eq!(
            steps(DVec2::new(3.0, 1.0), (3.0 * 0.8125, 0.3125)),
            [0b11, 0b00, 0b11, 0b00, 0b01]
        );
        assert_eq!(
            steps(DVec2::new(1.0, 3.0), (0.8125, 3.0 * 0.3125)),
            [0b01, 0b10, 0b11, 0b00, 0b10]
        );
        // A root without height.
        assert_eq!(steps(DVec2::X, (0.8125, 0.0)), [0b11, 0b01, 0, 0, 0]);
    }
}
