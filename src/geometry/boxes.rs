//! A static index over things with boxes: which lie near a point, the nearer ones first, and which meet a box.
//!
//! A balanced binary tree, built once by median splits and walked without allocating: a query costs O(log n) plus what it finds.

use super::{DVec2, Rect};

/// Things in a leaf: at about this number, one thing more costs as much as one node more.
const LEAF: usize = 4;

/// Deepest tree: median splits halve, so 2^48 things would fit.
const DEPTH: usize = 48;

/// A thing with a box around it.
pub trait Boxed {
    /// The smallest box around it.
    fn bounds(&self) -> Rect;
}

impl Boxed for Rect {
    fn bounds(&self) -> Rect {
        *self
    }
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Rect,
    /// Range of a leaf's items; `from == to` marks an inner node, whose first child follows it.
    from: u32,
    to: u32,
    /// Second child of an inner node.
    second: u32,
}

/// An index over things with boxes; queries return positions in the order in which the things were given.
#[derive(Clone, Debug, Default)]
pub struct BoxTree<T = Rect> {
    nodes: Vec<Node>,
    items: Vec<(T, u32)>,
}

impl<T: Boxed> BoxTree<T> {
    /// Indexes `things`. O(n log n).
    pub fn new(things: impl IntoIterator<Item = T>) -> Self {
        let items: Vec<(T, u32)> = things.into_iter().zip(0..).collect();
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
        let boxes = self.items[from..to].iter().map(|item| item.0.bounds());
        let bounds = Rect::around(boxes.flat_map(|rect| [rect.min, rect.max]));
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
        let key = |item: &(T, u32)| {
            let rect = item.0.bounds();
            rect.min[axis] + rect.max[axis]
        };
        // The position breaks ties, so that the tree does not depend on the selection algorithm.
        self.items[from..to]
            .select_nth_unstable_by(middle - from, |a, b| key(a).total_cmp(&key(b)).then(a.1.cmp(&b.1)));
        self.split(from, middle);
        self.nodes[node].second = self.nodes.len() as u32;
        self.split(middle, to);
    }

    /// Walks the tree depth first, and enters a box if `enter` accepts it when it is reached.
    pub fn walk<S>(&self, state: &mut S, enter: impl Fn(&S, &Rect) -> bool, visit: impl Fn(&mut S, &T, usize)) {
        let mut stack = [0u32; DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let at = stack[height];
            let node = &self.nodes[at as usize];
            if !enter(state, &node.bounds) {
                continue;
            }
            if node.from < node.to {
                for (item, id) in &self.items[node.from as usize..node.to as usize] {
                    visit(state, item, *id as usize);
                }
            } else {
                stack[height] = node.second;
                stack[height + 1] = at + 1;
                height += 2;
            }
        }
    }

    /// Calls `visit` with each thing at most `reach` from `x`, and its distance, roughly the nearest first; `visit` returns the
    /// reach from then on. `distance` is a thing's own, at least that of its box.
    pub fn nearest_first(
        &self,
        x: DVec2,
        mut reach: f64,
        distance: impl Fn(&T) -> f64,
        mut visit: impl FnMut(usize, f64) -> f64,
    ) {
        let mut stack = [(0u32, 0.0); DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let (at, away) = stack[height];
            if away > reach {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.from < node.to {
                for (item, id) in &self.items[node.from as usize..node.to as usize] {
                    let distance = distance(item);
                    if distance <= reach {
                        reach = visit(*id as usize, distance);
                    }
                }
            } else {
                let children = [at + 1, node.second].map(|c| (c, self.nodes[c as usize].bounds.distance(x)));
                let nearer = usize::from(children[1].1 < children[0].1);
                stack[height] = children[1 - nearer];
                stack[height + 1] = children[nearer];
                height += 2;
            }
        }
    }
}

impl BoxTree {
    /// Visits the boxes within `reach` of `x`, roughly the nearest first; `visit` returns the reach from then on.
    pub fn near(&self, x: DVec2, reach: f64, mut visit: impl FnMut(usize) -> f64) {
        self.nearest_first(x, reach, |rect| rect.distance(x), |id, _| visit(id));
    }

    /// Visits the boxes that have a point in common with `cell`.
    pub fn meeting(&self, cell: Rect, mut visit: impl FnMut(usize)) {
        self.walk(
            &mut visit,
            |_, node| node.meets(cell),
            |visit, rect, id| {
                if rect.meets(cell) {
                    visit(id);
                }
            },
        );
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
