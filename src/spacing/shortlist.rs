//! Short lists: a quadtree whose leaves name the few items that decide a function there.
//!
//! # Idea
//! Some functions are decided at x by the items nearest to x: lfs by features, a limited spacing by cells. If the
//! function is at most u on a cell, only items that can contribute u or less somewhere in the cell matter there. Since
//! the function is L-Lipschitz, u = value(centre) + L · radius will do, and a child's list is a part of its parent's. A
//! query walks down to its leaf and looks at a dozen items, exactly as if it had looked at all.
//!
//! # Cost
//! About (items) × (depth) × (overlap) to build; a query is a walk of `depth` steps and one short list.

use crate::geometry::tolerance::SHORTLIST;
use crate::geometry::{DVec2, Rect};

/// Deepest tree: cells 2⁻⁴⁰ of the root, finer than coordinates can tell apart in practice.
const DEPTH: usize = 40;

/// What the items are and how they decide the function.
pub trait Contest: Sync {
    /// How many items there are.
    fn len(&self) -> usize;
    /// The function at `x`, if the items in `list` are all that matter there.
    fn value(&self, list: &[u32], x: DVec2) -> f64;
    /// A lower bound of what the item can contribute anywhere in `cell`.
    fn least(&self, item: u32, cell: Rect) -> f64;
    /// Lipschitz constant of the function.
    fn slope(&self) -> f64;
    /// A list this short is not worth splitting.
    fn short(&self) -> usize;
    /// A cell is not split once radius · slope is below this share of the function at its centre.
    fn finest(&self) -> f64;
}

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

/// The four quarters of a cell: lower left, lower right, upper left, upper right.
pub fn quarters(cell: Rect) -> [Rect; 4] {
    let centre = cell.centre();
    [
        Rect {
            min: cell.min,
            max: centre,
        },
        Rect {
            min: DVec2::new(centre.x, cell.min.y),
            max: DVec2::new(cell.max.x, centre.y),
        },
        Rect {
            min: DVec2::new(cell.min.x, centre.y),
            max: DVec2::new(centre.x, cell.max.y),
        },
        Rect {
            min: centre,
            max: cell.max,
        },
    ]
}

struct Pending {
    node: u32,
    cell: Rect,
    depth: usize,
    list: Vec<u32>,
}

impl Shortlists {
    /// Builds the lists over `root`.
    pub fn new(contest: &impl Contest, root: Rect) -> Self {
        let mut tree = Self {
            root,
            nodes: vec![Node { first: 0, count: 0 }],
            lists: Vec::new(),
        };
        let all: Vec<u32> = (0..contest.len() as u32).collect();
        let mut pending = vec![Pending {
            node: 0,
            cell: root,
            depth: 0,
            list: tree.shorten(contest, &all, root).1,
        }];
        while let Some(next) = pending.pop() {
            if tree.is_leaf(contest, &next) {
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
            for (cell, node) in quarters(next.cell).into_iter().zip(first..) {
                let (_, list) = tree.shorten(contest, &next.list, cell);
                pending.push(Pending {
                    node,
                    cell,
                    depth: next.depth + 1,
                    list,
                });
            }
        }
        tree.nodes.shrink_to_fit();
        tree.lists.shrink_to_fit();
        tree
    }

    /// The value at the centre, and the items of `list` that matter in `cell`.
    fn shorten(&self, contest: &impl Contest, list: &[u32], cell: Rect) -> (f64, Vec<u32>) {
        let value = contest.value(list, cell.centre());
        let highest = (value + contest.slope() * 0.5 * cell.diagonal()) * (1.0 + SHORTLIST);
        (
            value,
            list.iter()
                .copied()
                .filter(|&item| contest.least(item, cell) <= highest)
                .collect(),
        )
    }

    fn is_leaf(&self, contest: &impl Contest, pending: &Pending) -> bool {
        pending.list.len() <= contest.short()
            || pending.depth >= DEPTH
            || contest.slope() * 0.5 * pending.cell.diagonal()
                <= contest.finest() * contest.value(&pending.list, pending.cell.centre())
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
