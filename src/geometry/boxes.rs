//! A static index over boxes: which lie near a point, the nearer ones first, and which meet a box.
//!
//! A balanced binary tree, built once by median splits and walked without allocating: a query costs O(log n) and what it finds.

use super::{DVec2, Rect};

/// Boxes in a leaf; about where one more costs as much as one more node.
const LEAF: usize = 4;

/// Deepest tree: median splits halve, so 2^48 boxes would fit.
const DEPTH: usize = 48;

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Rect,
    /// Range of a leaf's items; `from == to` marks an inner node, whose first child follows it.
    from: u32,
    to: u32,
    /// Second child of an inner node.
    second: u32,
}

/// An index over boxes; queries answer with positions in the order in which they were given.
#[derive(Clone, Debug, Default)]
pub struct BoxTree {
    nodes: Vec<Node>,
    items: Vec<(Rect, u32)>,
}

impl BoxTree {
    /// Indexes `boxes`. O(n log n).
    pub fn new(boxes: impl IntoIterator<Item = Rect>) -> Self {
        let items: Vec<(Rect, u32)> = boxes.into_iter().zip(0..).collect();
        let mut tree = Self {
            nodes: Vec::with_capacity(items.len()),
            items,
        };
        if !tree.items.is_empty() {
            tree.split(0, tree.items.len());
        }
        tree
    }

    fn split(&mut self, from: usize, to: usize) {
        let corners = self.items[from..to].iter().flat_map(|(rect, _)| [rect.min, rect.max]);
        let bounds = Rect::around(corners);
        let node = self.nodes.len();
        let is_leaf = to - from <= LEAF;
        let range = if is_leaf { [from as u32, to as u32] } else { [0, 0] };
        self.nodes.push(Node {
            bounds,
            from: range[0],
            to: range[1],
            second: 0,
        });
        if is_leaf {
            return;
        }
        let axis = usize::from(bounds.size().y > bounds.size().x);
        let middle = from + (to - from) / 2;
        let key = |item: &(Rect, u32)| item.0.min[axis] + item.0.max[axis];
        // The position breaks ties, so that the tree does not depend on the selection algorithm.
        self.items[from..to]
            .select_nth_unstable_by(middle - from, |a, b| key(a).total_cmp(&key(b)).then(a.1.cmp(&b.1)));
        self.split(from, middle);
        self.nodes[node].second = self.nodes.len() as u32;
        self.split(middle, to);
    }

    /// Visits the boxes within `reach` of `x`, roughly the nearer ones first; `visit` gives the reach from then on.
    pub fn near(&self, x: DVec2, mut reach: f64, mut visit: impl FnMut(usize) -> f64) {
        let mut stack = [0u32; DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let at = stack[height];
            let node = &self.nodes[at as usize];
            if node.bounds.distance(x) > reach {
                continue;
            }
            if node.from < node.to {
                for (rect, id) in &self.items[node.from as usize..node.to as usize] {
                    if rect.distance(x) <= reach {
                        reach = visit(*id as usize);
                    }
                }
                continue;
            }
            let (first, second) = (at + 1, node.second);
            let distance = |child: u32| self.nodes[child as usize].bounds.distance(x);
            let is_first_nearer = distance(first) <= distance(second);
            (stack[height], stack[height + 1]) = if is_first_nearer {
                (second, first)
            } else {
                (first, second)
            };
            height += 2;
        }
    }

    /// Visits the boxes that have a point in common with `cell`.
    pub fn meeting(&self, cell: Rect, mut visit: impl FnMut(usize)) {
        let meets = |rect: &Rect| rect.min.cmple(cell.max).all() && rect.max.cmpge(cell.min).all();
        let mut stack = [0u32; DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let at = stack[height];
            let node = &self.nodes[at as usize];
            if !meets(&node.bounds) {
                continue;
            }
            if node.from < node.to {
                let own = &self.items[node.from as usize..node.to as usize];
                own.iter()
                    .filter(|(rect, _)| meets(rect))
                    .for_each(|(_, id)| visit(*id as usize));
            } else {
                (stack[height], stack[height + 1]) = (node.second, at + 1);
                height += 2;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn an_empty_tree_has_nothing() {
        let tree = BoxTree::new([]);
        tree.near(DVec2::ZERO, f64::INFINITY, |_| panic!("a box"));
        tree.meeting(
            Rect {
                min: DVec2::ZERO,
                max: DVec2::ONE,
            },
            |_| panic!("a box"),
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn queries_find_what_a_loop_finds(
            corners in prop::collection::vec((0.0f64..1.0, 0.0f64..1.0, 0.0f64..0.2, 0.0f64..0.2), 1..60),
            x in -0.2f64..1.2, y in -0.2f64..1.2, reach in 0.0f64..0.5,
        ) {
            let rect = |(x, y, w, h)| Rect { min: DVec2::new(x, y), max: DVec2::new(x + w, y + h) };
            let boxes: Vec<Rect> = corners.into_iter().map(rect).collect();
            let tree = BoxTree::new(boxes.iter().copied());
            let x = DVec2::new(x, y);
            let sorted = |mut found: Vec<usize>| { found.sort_unstable(); found };
            let by_loop = |wanted: &dyn Fn(&Rect) -> bool| -> Vec<usize> {
                (0..boxes.len()).filter(|&k| wanted(&boxes[k])).collect()
            };
            let mut found = Vec::new();
            tree.near(x, reach, |k| { found.push(k); reach });
            prop_assert_eq!(sorted(found), by_loop(&|rect| rect.distance(x) <= reach));
            let mut nearest = f64::INFINITY;
            tree.near(x, f64::INFINITY, |k| { nearest = boxes[k].distance(x).min(nearest); nearest });
            prop_assert_eq!(nearest, boxes.iter().map(|rect| rect.distance(x)).fold(f64::INFINITY, f64::min));
            let cell = Rect { min: x, max: x + reach };
            let mut found = Vec::new();
            tree.meeting(cell, |k| found.push(k));
            let meets = |rect: &Rect| {
                rect.min.max(cell.min).cmple(rect.max.min(cell.max)).all()
            };
            prop_assert_eq!(sorted(found), by_loop(&meets));
        }
    }
}
