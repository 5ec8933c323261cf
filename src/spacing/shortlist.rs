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

/// Once radius · slope is below this share of the function, a list as long as [`LONG`] is left as it is: far from many
/// features, short lists would take a thousand cells for each, and such cells are few where spacing follows lfs.
const FAR: f64 = 1.0 / 16.0;

/// See [`FAR`].
const LONG: usize = 1024;

/// A list this short is not worth splitting.
const SHORT: usize = 16;

/// A cell smaller than the function there is not split once so many levels in turn have each left out under 1 /
/// [`PROGRESS`] of the list: what is incident to all that is near, as the segments of a fan at its vertex, stays on it
/// however small the cell.
const IDLE_LEVELS: usize = 2;

/// See [`IDLE_LEVELS`].
const PROGRESS: usize = 8;

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
    /// Levels in turn that left out next to nothing.
    idle: usize,
    is_leaf: bool,
}

impl Pending {
    /// `parent` lists all items that matter in a cell around this one; `idle` is that cell's.
    fn new(features: &Features, node: u32, cell: Rect, depth: usize, (parent, idle): (&[u32], usize)) -> Self {
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
        let finest = if list.len() < LONG { FINEST } else { FAR };
        let is_fine = radius <= finest * value;
        let is_idle = radius <= value && PROGRESS * (parent.len() - list.len()) < parent.len();
        let idle = if is_idle { idle + 1 } else { 0 };
        let is_leaf = list.len() <= SHORT || depth >= DEPTH || is_fine || idle >= IDLE_LEVELS;
        Self {
            node,
            cell,
            depth,
            list,
            idle,
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
        let mut pending = vec![Pending::new(features, 0, root, 0, (&all, 0))];
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
                pending.push(Pending::new(
                    features,
                    node,
                    cell,
                    next.depth + 1,
                    (&next.list, next.idle),
                ));
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
