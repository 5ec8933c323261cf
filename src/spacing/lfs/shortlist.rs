//! Short lists: a tree of cells whose leaves name the few items that decide a function there.
//!
//! # Idea
//! lfs(x) is decided by two of the features nearest to x, a limited spacing by one of its terms. If the items that decide at the
//! centre of a small disc are lower than item K all over the disc, K cannot decide anywhere in it. So a child's list is a part
//! of its parent's, and a query walks down to its leaf and evaluates a few items, with exactly the result of evaluating all.
//!
//! # Guarantee
//! An item's value is v_K + α d_K, with d_K the distance to a convex set. The gradient of d is a unit vector that turns by at
//! most r / (d − r) within r of a point at distance d > r, because the Hessian's eigenvalues lie in [0, 1 / d]. Hence, within r
//! of c,
//!
//! > d_K − d_W ≥ d_K(c) − d_W(c) − min(2 r, r ‖∇d_K − ∇d_W‖ + ½ r² / (d_K − r) + ½ r² / (d_W − r)),
//!
//! and K is left out if this puts its value above that of both deciding items W.
//!
//! The leaf of a point is read off its place in the root, as two binary fractions. These are rounded, and so are the cells'
//! sides: r has room for both.
//!
//! # Cost
//! About (items) × (depth) × (overlap) to build; a query is a walk of `depth` steps, without a branch that depends on the point,
//! and one short list.

use crate::geometry::tolerance::{CELL_ULPS, SHORTLIST};
use crate::geometry::{DVec2, Rect};
use crate::spacing::lfs::items::{Asked, Items, View};
use path::Scale;
use rayon::prelude::*;

mod path;

/// Deepest tree: cells of 2⁻⁴⁰ of the root, below the resolution of coordinates in practice.
const DEPTH: usize = 40;

/// A cell smaller than the function there is not split once this number of levels in a row have each left out less than 1 /
/// [`PROGRESS`] of the list: features incident to everything nearby, such as the segments of a fan at its vertex, stay on the
/// list however small the cell.
const IDLE_LEVELS: usize = 2;

/// See [`IDLE_LEVELS`].
const PROGRESS: usize = 8;

/// The tree is cut into at least this number of subtrees, which are built in parallel.
const SUBTREES: usize = 256;

#[derive(Clone, Copy, Debug)]
struct Node {
    /// First child (of four), or first entry in `lists`.
    first: u32,
    /// Entries of a leaf; [`INNER`] marks an inner node.
    count: u32,
}

const INNER: u32 = u32::MAX;

/// The tree of short lists over a box.
#[derive(Clone, Debug)]
pub struct Shortlists {
    root: Rect,
    scale: Scale,
    tree: Tree,
}

#[derive(Clone, Debug)]
struct Tree {
    nodes: Vec<Node>,
    lists: Vec<u32>,
}

/// The items that decide at the centre of a disc.
struct Rival {
    view: View,
    radius: f64,
    /// [`View::turn`] within the disc.
    turn: f64,
}

impl Rival {
    fn new(view: View, radius: f64) -> Self {
        let turn = view.turn(radius);
        Self { view, radius, turn }
    }

    /// Whether another item may have the lower value somewhere in the disc.
    #[inline]
    fn may_lose(&self, to: &View, slope: f64) -> bool {
        let lead = (to.value - self.view.value) / slope;
        let rest = lead - self.turn - to.turn(self.radius);
        // Comparing squares saves a root.
        let apart = self.view.away.distance_squared(to.away);
        lead <= 2.0 * self.radius && (rest <= 0.0 || rest * rest <= self.radius * self.radius * apart)
    }
}

/// A cell with the items that matter in it, which may be split.
struct Pending {
    cell: Rect,
    depth: usize,
    list: Vec<u32>,
    asked: Asked,
    /// Levels in a row that left out next to nothing.
    idle: usize,
    is_leaf: bool,
}

/// What all cells have in common.
struct Builder<'a, I> {
    items: &'a I,
    scale: &'a Scale,
    /// How far beside its cell a point may be.
    beside: f64,
}

impl<I: Items> Builder<'_, I> {
    /// `from` lists all items that matter in a cell around this one; `asked` and `idle` are that cell's.
    fn cell(&self, cell: Rect, depth: usize, (from, asked, idle): (&[u32], Asked, usize)) -> Pending {
        let asked = match asked {
            Asked::InPart => self.items.asked_in(&cell),
            settled => settled,
        };
        let mut pending = Pending {
            cell,
            depth,
            list: Vec::new(),
            asked,
            idle,
            is_leaf: true,
        };
        if asked != Asked::Nowhere {
            self.select(&mut pending, from);
        }
        pending
    }

    fn parts(&self, of: &Pending) -> [Pending; 4] {
        let given = (&of.list[..], of.asked, of.idle);
        parts(of.cell, self.scale.axes(of.depth)).map(|part| self.cell(part, of.depth + 1, given))
    }

    /// Keeps the items of a list that matter in the cell, and decides whether the cell is to be split.
    fn select(&self, pending: &mut Pending, from: &[u32]) {
        let items = self.items;
        let centre = pending.cell.centre();
        let radius = 0.5 * pending.cell.diagonal() + self.beside;
        let (value, deciding) = items.decide(from, centre);
        let is_one = deciding[0] == deciding[1];
        let [one, other] = deciding.map(|item| Rival::new(items.view(item, centre), radius));
        let reach = one.view.value.max(other.view.value) + items.slope() * 2.0 * radius;
        let matters = |item: u32| {
            let (offset, lowest) = items.offset(item, centre);
            let distance = offset.length();
            let value = (1.0 - SHORTLIST) * (lowest + items.slope() * distance);
            value <= reach && {
                let view = View::new(offset, distance, value);
                one.may_lose(&view, items.slope()) || (!is_one && other.may_lose(&view, items.slope()))
            }
        };
        let list = &mut pending.list;
        list.reserve(from.len());
        let mut open = Vec::new();
        for &item in from {
            open.push(item);
            while let Some(item) = open.pop() {
                if matters(item) {
                    match items.parts(item, &pending.cell) {
                        Some(parts) => open.extend(parts.rev()),
                        None => list.push(item),
                    }
                }
            }
        }
        let count = list.len();
        let is_idle = radius <= value && PROGRESS * from.len().saturating_sub(count) < from.len();
        pending.idle = if is_idle { pending.idle + 1 } else { 0 };
        let is_short = count <= items.short() && list.iter().all(|&item| items.is_single(item));
        let is_fine = items.is_fine(radius / value, count);
        pending.is_leaf = is_short || is_fine || pending.depth >= DEPTH || pending.idle >= IDLE_LEVELS;
        if pending.is_leaf {
            list.sort_by_key(|&item| !items.is_single(item));
            list.truncate(if count > items.longest() { 0 } else { count });
            list.shrink_to_fit();
        }
    }

    /// The whole tree below a cell.
    fn below(&self, root: Pending) -> Tree {
        let mut tree = Tree::new();
        let mut pending = vec![(0, root)];
        while let Some((node, cell)) = pending.pop() {
            if let Some(first) = tree.enter(node, &cell) {
                pending.extend((first..).zip(self.parts(&cell)));
            }
        }
        tree
    }

    /// The tree of `all` items over `root`.
    fn tree(&self, all: &[u32], root: Rect) -> Tree {
        let mut tree = Tree::new();
        let mut level = vec![(0, self.cell(root, 0, (all, Asked::InPart, 0)))];
        while !level.is_empty() && level.len() < SUBTREES {
            let open = level
                .into_iter()
                .filter_map(|(node, cell)| Some((tree.enter(node, &cell)?, cell)));
            let parts = open.collect::<Vec<_>>().into_par_iter();
            level = parts
                .flat_map_iter(|(first, cell)| (first..).zip(self.parts(&cell)))
                .collect();
        }
        let subtrees: Vec<(u32, Tree)> = level
            .into_par_iter()
            .map(|(node, cell)| (node, self.below(cell)))
            .collect();
        for (node, subtree) in subtrees {
            tree.graft(node, subtree);
        }
        tree.nodes.shrink_to_fit();
        tree.lists.shrink_to_fit();
        tree
    }
}

/// The four parts of a cell, halved along two axes one after the other.
fn parts(cell: Rect, [first, second]: [usize; 2]) -> [Rect; 4] {
    let [low, high] = halves(cell, first);
    let ([a, b], [c, d]) = (halves(low, second), halves(high, second));
    [a, b, c, d]
}

fn halves(cell: Rect, axis: usize) -> [Rect; 2] {
    let (mut low, mut high) = (cell, cell);
    let middle = cell.centre()[axis];
    low.max[axis] = middle;
    high.min[axis] = middle;
    [low, high]
}

impl Tree {
    fn new() -> Self {
        Self {
            nodes: vec![Node { first: 0, count: 0 }],
            lists: Vec::new(),
        }
    }

    /// Enters a cell at a node: a leaf's list, or an inner node's children, the first of which is returned.
    fn enter(&mut self, node: u32, cell: &Pending) -> Option<u32> {
        if cell.is_leaf {
            self.nodes[node as usize] = Node {
                first: self.lists.len() as u32,
                count: cell.list.len() as u32,
            };
            self.lists.extend_from_slice(&cell.list);
            return None;
        }
        let first = self.nodes.len() as u32;
        self.nodes[node as usize] = Node { first, count: INNER };
        self.nodes.extend([Node { first: 0, count: 0 }; 4]);
        Some(first)
    }

    /// Puts another tree's root at a node.
    fn graft(&mut self, node: u32, other: Self) {
        let (nodes, lists) = (self.nodes.len() as u32 - 1, self.lists.len() as u32);
        let moved = |node: Node| Node {
            first: node.first + if node.count == INNER { nodes } else { lists },
            ..node
        };
        let mut others = other.nodes.into_iter().map(moved);
        self.nodes[node as usize] = others.next().expect("a root");
        self.nodes.extend(others);
        self.lists.extend(other.lists);
    }
}

impl Shortlists {
    /// Builds the lists of `all` items over `root`, on rayon's pool; the tree does not depend on the number of threads.
    pub fn new(items: &impl Items, all: &[u32], root: Rect) -> Self {
        let scale = Scale::new(root.size());
        let builder = Builder {
            items,
            scale: &scale,
            beside: CELL_ULPS * f64::EPSILON * root.largest_coordinate(),
        };
        let tree = builder.tree(all, root);
        Self { root, scale, tree }
    }

    /// The items that decide the function at `x`, those that replace others last; none outside the root.
    #[inline]
    pub fn at(&self, x: DVec2) -> Option<&[u32]> {
        if !self.root.contains(x) {
            return None;
        }
        let Tree { nodes, lists } = &self.tree;
        let mut path = self.scale.path(x - self.root.min);
        let mut node = nodes[0];
        while node.count == INNER {
            node = nodes[node.first as usize + path.step()];
        }
        Some(&lists[node.first as usize..(node.first + node.count) as usize])
    }

    /// The same lists, with other numbers for the items.
    pub fn renumbered(mut self, number: impl Fn(u32) -> u32) -> Self {
        self.tree.lists.iter_mut().for_each(|item| *item = number(*item));
        self
    }

    /// Number of tree nodes and of list entries: 8 and 4 bytes each.
    #[cfg(test)]
    pub fn size(&self) -> (usize, usize) {
        (self.tree.nodes.len(), self.tree.lists.len())
    }
}

#[cfg(test)]
mod tests;
