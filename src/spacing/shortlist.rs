//! Short lists: a quadtree whose leaves name the few features that decide lfs there.
//!
//! # Idea
//! lfs(x) is decided by two of the features nearest to x. If the two that decide at the centre of a small disc are nearer
//! than feature K all over the disc, K cannot decide anywhere in it. So a child's list is a part of its parent's, and a
//! query walks down to its leaf and looks at a few features, exactly as if it had looked at all.
//!
//! # Guarantee
//! Features are convex. The gradient of the distance d to a convex set is a unit vector that turns by at most r / (d − r)
//! within r of a point at distance d > r, because the Hessian's eigenvalues lie in [0, 1 / d]. Hence, within r of c,
//!
//! > d_K − d_W ≥ d_K(c) − d_W(c) − min(2 r, r ‖∇d_K − ∇d_W‖ + ½ r² / (d_K − r) + ½ r² / (d_W − r)),
//!
//! and K is left out where that is positive for both deciding features W.
//!
//! # Cost
//! About (features) × (depth) × (overlap) to build; a query is a walk of `depth` steps and one short list.

use super::features::{Features, View};
use crate::geometry::tolerance::SHORTLIST;
use crate::geometry::{DVec2, Rect};

/// Deepest tree: cells 2⁻⁴⁰ of the root, finer than coordinates can tell apart in practice.
const DEPTH: usize = 40;

/// A cell is not split once radius · slope is below this share of the function at its centre: where lists stay long
/// there, many features tie, and smaller cells would not help.
const FINEST: f64 = 1e-3;

/// A list this short is not worth splitting.
const SHORT: usize = 16;

#[derive(Clone, Copy, Debug)]
struct Node {
    /// First child (of four), or first entry in `lists`.
    first: u32,
    /// Entries of a leaf; [`INNER`] marks an inner node.
    count: u32,
}

const INNER: u32 = u32::MAX;

/// The quadtree of short lists over a box.
#[derive(Clone, Debug)]
pub struct Shortlists {
    root: Rect,
    nodes: Vec<Node>,
    lists: Vec<u32>,
}

struct Pending {
    node: u32,
    cell: Rect,
    depth: usize,
    list: Vec<u32>,
    is_leaf: bool,
}

impl Pending {
    /// `parent` lists all items that matter in a cell around this one.
    fn new(features: &Features, node: u32, cell: Rect, depth: usize, parent: &[u32]) -> Self {
        let (centre, radius) = (cell.centre(), 0.5 * cell.diagonal());
        let (value, deciding) = features.decide(parent, centre);
        let deciding = deciding.map(|item| features.view(item, centre));
        let matters = |item: &u32| {
            let view = features.view(*item, centre);
            let may_win =
                |over: &View| view.distance - over.distance <= view.margin(over, radius) + SHORTLIST * view.distance;
            deciding.iter().any(may_win)
        };
        let list: Vec<u32> = parent.iter().copied().filter(matters).collect();
        let is_fine = radius <= FINEST * value;
        let is_leaf = list.len() <= SHORT || depth >= DEPTH || is_fine;
        Self {
            node,
            cell,
            depth,
            list,
            is_leaf,
        }
    }
}

impl Shortlists {
    /// Builds the lists over `root`.
    pub fn new(features: &Features, root: Rect) -> Self {
        let mut tree = Self {
            root,
            nodes: vec![Node { first: 0, count: 0 }],
            lists: Vec::new(),
        };
        let all: Vec<u32> = (0..features.len() as u32).collect();
        let mut pending = vec![Pending::new(features, 0, root, 0, &all)];
        while let Some(next) = pending.pop() {
            if next.is_leaf {
                tree.nodes[next.node as usize] = Node {
                    first: tree.lists.len() as u32,
                    count: next.list.len() as u32,
                };
                tree.lists.extend_from_slice(&next.list);
                continue;
            }
            let first = tree.nodes.len() as u32;
            tree.nodes[next.node as usize] = Node { first, count: INNER };
            tree.nodes.extend([Node { first: 0, count: 0 }; 4]);
            for (cell, node) in next.cell.quarters().into_iter().zip(first..) {
                pending.push(Pending::new(features, node, cell, next.depth + 1, &next.list));
            }
        }
        tree.nodes.shrink_to_fit();
        tree.lists.shrink_to_fit();
        tree
    }

    /// The items that decide the function at `x`; none outside the root.
    pub fn at(&self, x: DVec2) -> Option<&[u32]> {
        if !self.root.contains(x) {
            return None;
        }
        let mut cell = self.root;
        let mut node = self.nodes[0];
        while node.count == INNER {
            let centre = cell.centre();
            let (right, above) = (x.x >= centre.x, x.y >= centre.y);
            *(if right { &mut cell.min.x } else { &mut cell.max.x }) = centre.x;
            *(if above { &mut cell.min.y } else { &mut cell.max.y }) = centre.y;
            node = self.nodes[node.first as usize + usize::from(right) + 2 * usize::from(above)];
        }
        Some(&self.lists[node.first as usize..(node.first + node.count) as usize])
    }

    /// Number of tree nodes and of list entries: 8 and 4 bytes each.
    pub fn size(&self) -> (usize, usize) {
        (self.nodes.len(), self.lists.len())
    }
}
