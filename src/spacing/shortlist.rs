//! Short lists: a tree of cells whose leaves name the few items that decide a function there.
//!
//! # Idea
//! lfs(x) is decided by two of the features nearest to x, a limited spacing by one of its terms. If the items that decide at the
//! centre of a small disc are lower than item K all over the disc, K cannot decide anywhere in it. So a child's list is a part
//! of its parent's, and a query walks down to its leaf and looks at a few items, exactly as if it had looked at all.
//!
//! # Guarantee
//! An item's value is v_K + α d_K, with d_K the distance to a convex set. The gradient of d is a unit vector that turns by at
//! most r / (d − r) within r of a point at distance d > r, because the Hessian's eigenvalues lie in [0, 1 / d]. Hence, within r
//! of c,
//!
//! > d_K − d_W ≥ d_K(c) − d_W(c) − min(2 r, r ‖∇d_K − ∇d_W‖ + ½ r² / (d_K − r) + ½ r² / (d_W − r)),
//!
//! and K is left out where so its value is above that of both deciding items W.
//!
//! # Cost
//! About (items) × (depth) × (overlap) to build; a query is a walk of `depth` steps and one short list.

use super::items::{Items, View};
use crate::geometry::tolerance::SHORTLIST;
use crate::geometry::{DVec2, Rect};
use rayon::prelude::*;

/// Deepest tree: cells 2⁻⁴⁰ of the root, finer than coordinates can tell apart in practice.
const DEPTH: usize = 40;

/// A cell smaller than the function there is not split once so many levels in turn have each left out under 1 /
/// [`PROGRESS`] of the list: what is incident to all that is near, as the segments of a fan at its vertex, stays on it
/// however small the cell.
const IDLE_LEVELS: usize = 2;

/// See [`IDLE_LEVELS`].
const PROGRESS: usize = 8;

/// The tree is cut into so many subtrees at least, which are built side by side.
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
    tree: Tree,
}

#[derive(Clone, Debug)]
struct Tree {
    nodes: Vec<Node>,
    lists: Vec<u32>,
}

/// A cell with what matters in it, that may be split.
struct Pending {
    cell: Rect,
    depth: usize,
    list: Vec<u32>,
    /// Levels in turn that left out next to nothing.
    idle: usize,
    is_leaf: bool,
}

impl Pending {
    /// `parent` lists all items that matter in a cell around this one; `idle` is that cell's.
    fn new(items: &impl Items, cell: Rect, depth: usize, (parent, idle): (&[u32], usize)) -> Self {
        if !items.is_asked_in(&cell) {
            return Self {
                cell,
                depth,
                list: Vec::new(),
                idle,
                is_leaf: true,
            };
        }
        let (centre, radius) = (cell.centre(), 0.5 * cell.diagonal());
        let (value, deciding) = items.decide(parent, centre);
        // One item may decide twice.
        let count = if deciding[0] == deciding[1] { 1 } else { 2 };
        let deciding = &deciding.map(|item| items.view(item, centre))[..count];
        let matters = |item: &u32| {
            let view = items.view(*item, centre);
            let may_win = |over: &View| {
                let lead = view.value - over.value - SHORTLIST * view.value;
                lead <= items.slope() * 2.0 * radius && lead <= items.slope() * view.margin(over, radius)
            };
            deciding.iter().any(may_win)
        };
        let mut list = Vec::new();
        let mut pending: Vec<u32> = parent.iter().rev().copied().collect();
        while let Some(item) = pending.pop() {
            if matters(&item) {
                match items.parts(item, &cell) {
                    Some(parts) => pending.extend(parts.rev()),
                    None => list.push(item),
                }
            }
        }
        let is_fine = items.is_fine(radius / value, list.len());
        let is_idle = radius <= value && PROGRESS * parent.len().saturating_sub(list.len()) < parent.len();
        let idle = if is_idle { idle + 1 } else { 0 };
        // Whether no item stands for others, however small a cell.
        let point = Rect {
            min: centre,
            max: centre,
        };
        let is_single = |item: &u32| items.parts(*item, &point).is_none();
        let is_short = list.len() <= items.short() && list.iter().all(is_single);
        let is_leaf = is_short || depth >= DEPTH || is_fine || idle >= IDLE_LEVELS;
        if is_leaf && list.len() > items.longest() {
            list.clear();
        }
        Self {
            cell,
            depth,
            list,
            idle,
            is_leaf,
        }
    }

    fn parts(&self, items: &impl Items) -> [Self; 4] {
        let given = (&self.list[..], self.idle);
        parts(self.cell).map(|part| Self::new(items, part, self.depth + 1, given))
    }
}

/// The four parts of a cell: quarters, or strips across where it is more than twice as long as wide.
fn parts(cell: Rect) -> [Rect; 4] {
    let [first, second] = shape(cell);
    let [low, high] = halves(cell, first);
    let ([a, b], [c, d]) = (halves(low, second), halves(high, second));
    [a, b, c, d]
}

/// The axes along which a cell is halved, one after the other.
fn shape(cell: Rect) -> [usize; 2] {
    let size = cell.size();
    if size.x > 2.0 * size.y {
        [0, 0]
    } else if size.y > 2.0 * size.x {
        [1, 1]
    } else {
        [0, 1]
    }
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

    /// The whole tree below a cell.
    fn below(items: &impl Items, root: Pending) -> Self {
        let mut tree = Self::new();
        let mut pending = vec![(0, root)];
        while let Some((node, cell)) = pending.pop() {
            if let Some(first) = tree.enter(node, &cell) {
                pending.extend((first..).zip(cell.parts(items)));
            }
        }
        tree
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
        let mut tree = Tree::new();
        let mut level = vec![(0, Pending::new(items, root, 0, (all, 0)))];
        while !level.is_empty() && level.len() < SUBTREES {
            let open = level
                .into_iter()
                .filter_map(|(node, cell)| Some((tree.enter(node, &cell)?, cell)));
            let parts = open.collect::<Vec<_>>().into_par_iter();
            level = parts
                .flat_map_iter(|(first, cell)| (first..).zip(cell.parts(items)))
                .collect();
        }
        let subtrees: Vec<(u32, Tree)> = level
            .into_par_iter()
            .map(|(node, cell)| (node, Tree::below(items, cell)))
            .collect();
        for (node, subtree) in subtrees {
            tree.graft(node, subtree);
        }
        tree.nodes.shrink_to_fit();
        tree.lists.shrink_to_fit();
        Self { root, tree }
    }

    /// The items that decide the function at `x`; none outside the root.
    pub fn at(&self, x: DVec2) -> Option<&[u32]> {
        if !self.root.contains(x) {
            return None;
        }
        let Tree { nodes, lists } = &self.tree;
        let mut cell = self.root;
        let mut node = nodes[0];
        while node.count == INNER {
            let mut part = node.first as usize;
            for (axis, step) in shape(cell).into_iter().zip([2, 1]) {
                let middle = cell.centre()[axis];
                if x[axis] >= middle {
                    cell.min[axis] = middle;
                    part += step;
                } else {
                    cell.max[axis] = middle;
                }
            }
            node = nodes[part];
        }
        Some(&lists[node.first as usize..(node.first + node.count) as usize])
    }

    /// Number of tree nodes and of list entries: 8 and 4 bytes each.
    pub fn size(&self) -> (usize, usize) {
        (self.tree.nodes.len(), self.tree.lists.len())
    }
}

#[cfg(test)]
mod tests {
    use super::super::features::{Feature, Features};
    use super::super::testing::pseudo_random_points;
    use super::*;

    fn rect(min: (f64, f64), max: (f64, f64)) -> Rect {
        Rect {
            min: min.into(),
            max: max.into(),
        }
    }

    fn vertices(points: impl IntoIterator<Item = DVec2>) -> Features {
        let vertex = |(at, index)| Feature::new([at; 2], [index; 2]);
        Features::new(points.into_iter().zip(0..).map(vertex).collect())
    }

    /// The leaves of a tree: cell, depth, list.
    fn leaves(lists: &Shortlists) -> Vec<(Rect, usize, &[u32])> {
        let Tree { nodes, lists: entries } = &lists.tree;
        let mut pending = vec![(lists.root, 0, nodes[0])];
        let mut leaves = Vec::new();
        while let Some((cell, depth, node)) = pending.pop() {
            let first = node.first as usize;
            if node.count == INNER {
                let children = parts(cell).into_iter().zip(&nodes[first..first + 4]);
                pending.extend(children.map(|(part, child)| (part, depth + 1, *child)));
            } else {
                leaves.push((cell, depth, &entries[first..first + node.count as usize]));
            }
        }
        leaves
    }

    #[test]
    fn a_cell_has_four_quarters_or_where_it_is_more_than_twice_as_long_as_wide_four_strips_across() {
        let quarters = [
            rect((0.0, 0.0), (0.5, 0.25)),
            rect((0.0, 0.25), (0.5, 0.5)),
            rect((0.5, 0.0), (1.0, 0.25)),
            rect((0.5, 0.25), (1.0, 0.5)),
        ];
        assert_eq!(parts(rect((0.0, 0.0), (1.0, 0.5))), quarters);
        assert_eq!(
            (shape(quarters[0]), shape(rect((0.0, 0.0), (0.5, 1.0)))),
            ([0, 1], [0, 1])
        );
        let across = [0.0, 0.25, 0.5, 0.75].map(|x| rect((x, 0.0), (x + 0.25, 0.375)));
        assert_eq!(parts(rect((0.0, 0.0), (1.0, 0.375))), across);
        let across = [0.0, 0.25, 0.5, 0.75].map(|y| rect((0.0, y), (0.375, y + 0.25)));
        assert_eq!(parts(rect((0.0, 0.0), (0.375, 1.0))), across);
    }

    #[test]
    fn the_list_at_a_point_is_that_of_the_leaf_it_is_in_and_decides_as_all_features_do() {
        let points = pseudo_random_points(600);
        let (features, all) = (vertices(points.iter().copied()), (0..600).collect::<Vec<u32>>());
        let lists = Shortlists::new(&features, &all, rect((0.0, 0.0), (1.0, 3.0)));
        let leaves = leaves(&lists);
        let entries: usize = leaves.iter().map(|(_, _, list)| list.len()).sum();
        assert_eq!(lists.size(), (1 + (leaves.len() - 1) / 3 * 4, entries));
        for (cell, _, list) in &leaves {
            // The lower corner too: of cells that meet in a point, it is in the one to the right and above.
            for x in [cell.min, cell.centre()] {
                assert_eq!(lists.at(x), Some(*list), "{x}");
            }
            for x in [cell.min, cell.centre(), cell.max] {
                assert_eq!(features.decide(list, x).0, features.decide(&all, x).0, "{x}");
            }
        }
        for outside in [(-1e-9, 0.5), (0.5, 3.000_001)] {
            assert_eq!(lists.at(outside.into()), None);
        }
    }

    /// Too near to one another for cells of that depth to tell them apart, and well inside each.
    #[test]
    fn no_tree_is_deeper_than_coordinates_can_be_told_apart() {
        let place =
            |k: usize| DVec2::splat(1.0 / 3.0) + 4.0 * f64::EPSILON * DVec2::new((k % 8) as f64, (k / 8) as f64);
        let features = vertices((0..32).map(place));
        let all: Vec<u32> = (0..features.len() as u32).collect();
        let lists = Shortlists::new(&features, &all, rect((-1.0, -1.0), (1.0, 1.0)));
        assert_eq!(leaves(&lists).iter().map(|(_, depth, _)| *depth).max(), Some(DEPTH));
    }
}
