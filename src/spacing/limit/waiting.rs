//! The nodes that wait in a search for the lowest value in a quadtree, the most promising on top.

use crate::spacing::cover::DEPTH;

/// Most nodes that wait: three per level, and the four that are being entered.
const MOST: usize = 3 * DEPTH + 8;

/// Nodes of a quadtree with lower bounds of what is below them. Those filed between two calls of [`Waiting::next`] are entered in
/// ascending order of their bounds, before all that were there.
pub struct Waiting {
    // Apart, so that they are cleared together.
    bounds: [f64; MOST],
    nodes: [u32; MOST],
    height: usize,
    /// Where those filed since the last call begin.
    newest: usize,
}

impl Waiting {
    /// With one node and its bound.
    #[inline]
    pub fn new(bound: f64, node: u32) -> Self {
        let mut waiting = Self {
            bounds: [0.0; MOST],
            nodes: [0; MOST],
            height: 0,
            newest: 0,
        };
        waiting.file(bound, node);
        waiting
    }

    /// Takes the most promising.
    #[inline]
    pub fn next(&mut self) -> Option<(f64, u32)> {
        self.height = self.height.checked_sub(1)?;
        self.newest = self.height;
        Some((self.bounds[self.height], self.nodes[self.height]))
    }

    /// Files a node below the one that was taken last.
    #[inline]
    pub fn file(&mut self, bound: f64, node: u32) {
        let mut place = self.height;
        while place > self.newest && self.bounds[place - 1] < bound {
            self.bounds[place] = self.bounds[place - 1];
            self.nodes[place] = self.nodes[place - 1];
            place -= 1;
        }
        self.bounds[place] = bound;
        self.nodes[place] = node;
        self.height += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_are_entered_first_the_lowest_of_them_before_the_others() {
        let mut waiting = Waiting::new(7.0, 0);
        assert_eq!(waiting.next(), Some((7.0, 0)));
        for (bound, node) in [(2.0, 1), (1.0, 2), (3.0, 3)] {
            waiting.file(bound, node);
        }
        assert_eq!(waiting.next(), Some((1.0, 2)));
        // Of equals the one filed last.
        for (bound, node) in [(9.0, 4), (8.0, 5), (9.0, 6)] {
            waiting.file(bound, node);
        }
        let rest: Vec<u32> = std::iter::from_fn(|| waiting.next()).map(|(_, node)| node).collect();
        assert_eq!(rest, [5, 6, 4, 1, 3]);
    }
}
