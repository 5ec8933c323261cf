//! Step 1: a balanced quadtree whose leaves are about as large as the edges that the spacing asks for there.
//!
//! # Idea
//! A cell is split until its side is at most `side` · s everywhere in it. This follows from the proved Lipschitz
//! constant t of s = c_b f: if s is known at one point of the cell and of Ω, it is smaller in the cell by at most t ·
//! (distance to the farthest corner). Cells that do not meet Ω are dropped. Then every cell whose neighbour across a
//! side has been split twice is split too.
//!
//! # Cost
//! s is evaluated about once per leaf, and not at all in cells that an upper bound of s is enough to split.

use super::Field;
use crate::geometry::{DVec2, Rect};
use crate::meshers::MeshError;
use crate::spacing::cover::Cell;

/// A leaf that meets the domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Leaf {
    pub centre: DVec2,
    /// Half the side.
    pub half: f64,
    /// s at the leaf's anchor.
    pub radius: f64,
    /// Index of the anchor in [`Quadtree::anchors`] if segments run through the leaf; else [`INSIDE`].
    anchor: u32,
}

/// Marks a leaf that no segment meets: all of it is inside, and its anchor is its centre.
const INSIDE: u32 = u32::MAX;

impl Leaf {
    /// Whether no segment meets the leaf, so that all of it lies inside.
    pub fn is_inside(&self) -> bool {
        self.anchor == INSIDE
    }

    /// The leaf as a box.
    pub fn rect(&self) -> Rect {
        Rect {
            min: self.centre - self.half,
            max: self.centre + self.half,
        }
    }
}

/// A cell of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Node {
    /// It does not meet the domain.
    Outside,
    /// It is the leaf with this number.
    Leaf(u32),
    /// Its quarters are the four nodes from this number on: lower left, lower right, upper left, upper right.
    Inner(u32),
}

/// The quadtree; node 0 is the root.
#[derive(Debug)]
pub(super) struct Quadtree {
    /// The square around the domain.
    pub root: Rect,
    pub nodes: Vec<Node>,
    pub leaves: Vec<Leaf>,
    /// Points of the domain in the leaves that segments meet.
    anchors: Vec<DVec2>,
    /// Fewest and most halvings of the root that made a leaf.
    depths: [u32; 2],
}

/// This number of leaves counts as one vertex to come: a vertex's circle of radius s meets fewer leaves with sides
/// above s/2.
const LEAVES_A_VERTEX: usize = 64;

/// Clock and memory are checked once in this number of leaves.
const LEAVES_BETWEEN_LOOKS: usize = 1 << 14;

/// The balanced quadtree of the domain whose leaves have sides of at most [`QuadtreeMis::leaf_side`] · s.
///
/// [`QuadtreeMis::leaf_side`]: super::QuadtreeMis::leaf_side
pub(super) fn balance(field: &Field) -> Result<Quadtree, MeshError> {
    let root = Cell::root(field.domain);
    let mut tree = Quadtree {
        root: root.rect,
        nodes: vec![Node::Outside],
        leaves: Vec::new(),
        anchors: Vec::new(),
        depths: [u32::MAX, 0],
    };
    let mut builder = Builder {
        tree: &mut tree,
        field,
        t: field.sizing.t(),
        side: field.mesher.leaf_side,
    };
    builder.grow(0, root, 0, [0.0, f64::INFINITY])?;
    builder.even_out()?;
    Ok(tree)
}

struct Builder<'a, 'b> {
    tree: &'b mut Quadtree,
    field: &'b Field<'a>,
    t: f64,
    side: f64,
}

impl Builder<'_, '_> {
    /// Makes `node` the tree of `cell`, in which s is within `bounds`.
    fn grow(&mut self, node: usize, cell: Cell, depth: u32, bounds: [f64; 2]) -> Result<(), MeshError> {
        let width = cell.rect.size().x;
        let [mut low, mut high] = bounds;
        if width <= self.side * high {
            let anchor = cell.point(self.field.domain);
            let radius = if low < high { self.field.sizing.at(anchor)? } else { low };
            let change = self.t * farthest_corner(cell.rect, anchor);
            (low, high) = (low.max(radius - change), high.min(radius + change));
            if width <= self.side * low {
                return self.add_leaf(node, &cell, anchor, radius, depth);
            }
        }
        self.split(node, &cell, |builder, child, quarter| {
            builder.grow(child, quarter, depth + 1, [low, high])
        })
    }

    /// Makes `node` an inner node, and calls `with` for each of its quarters that meets the domain.
    fn split(
        &mut self,
        node: usize,
        cell: &Cell,
        mut with: impl FnMut(&mut Self, usize, Cell) -> Result<(), MeshError>,
    ) -> Result<(), MeshError> {
        let first = self.tree.nodes.len();
        self.tree.nodes.extend([Node::Outside; 4]);
        self.tree.nodes[node] = Node::Inner(first as u32);
        let middle = cell.rect.centre();
        for quarter in cell.split(self.field.domain) {
            let child = first + quadrant(middle, quarter.rect.centre());
            with(self, child, quarter)?;
        }
        Ok(())
    }

    fn add_leaf(&mut self, node: usize, cell: &Cell, anchor: DVec2, radius: f64, depth: u32) -> Result<(), MeshError> {
        let tree = &mut *self.tree;
        if tree.leaves.len().is_multiple_of(LEAVES_A_VERTEX) {
            self.field
                .monitor
                .placed(tree.leaves.len() / LEAVES_A_VERTEX, anchor, radius)?;
        }
        if tree.leaves.len().is_multiple_of(LEAVES_BETWEEN_LOOKS) {
            let vertices = tree.leaves.len() / LEAVES_A_VERTEX;
            self.field.monitor.look(vertices, anchor, radius)?;
        }
        let number = if cell.crossing.is_empty() {
            INSIDE
        } else {
            tree.anchors.push(anchor);
            (tree.anchors.len() - 1) as u32
        };
        tree.nodes[node] = Node::Leaf(tree.leaves.len() as u32);
        tree.leaves.push(Leaf {
            centre: cell.rect.centre(),
            half: 0.5 * cell.rect.size().x,
            radius,
            anchor: number,
        });
        tree.depths = [tree.depths[0].min(depth), tree.depths[1].max(depth)];
        Ok(())
    }

    /// Splits leaves until neighbours across a side differ by at most one level: until beyond each side of every inner
    /// node there is a node of its own level, or nothing.
    fn even_out(&mut self) -> Result<(), MeshError> {
        if self.tree.depths[1] < self.tree.depths[0] + 2 {
            return Ok(());
        }
        let mut inner = self.tree.inner_places();
        while let Some(place) = inner.pop() {
            for neighbour in place.neighbours() {
                while let Some((node, leaf_place)) = self.tree.leaf_above(neighbour) {
                    self.halve(node, leaf_place)?;
                    inner.push(leaf_place);
                }
            }
        }
        Ok(())
    }

    /// Splits a leaf into leaves. The last of them gets its number.
    fn halve(&mut self, node: usize, place: Place) -> Result<(), MeshError> {
        let Node::Leaf(number) = self.tree.nodes[node] else {
            return Ok(());
        };
        let leaf = self.tree.leaves[number as usize];
        let mut crossing = Vec::new();
        if !leaf.is_inside() {
            self.field
                .domain
                .index()
                .in_box(leaf.rect(), |segment| crossing.push(segment as u32));
            crossing.sort_unstable();
        }
        let cell = Cell {
            rect: leaf.rect(),
            crossing,
        };
        self.split(node, &cell, |builder, child, quarter| {
            let anchor = quarter.point(builder.field.domain);
            let radius = builder.field.sizing.at(anchor)?;
            builder.add_leaf(child, &quarter, anchor, radius, place.depth + 1)
        })?;
        let tree = &mut *self.tree;
        if let Some(moved) = tree.leaves.pop() {
            let from = Node::Leaf(tree.leaves.len() as u32);
            tree.leaves[number as usize] = moved;
            let made = tree.nodes.iter_mut().rev().take(4);
            made.filter(|child| **child == from)
                .for_each(|child| *child = Node::Leaf(number));
        }
        Ok(())
    }
}

fn farthest_corner(cell: Rect, x: DVec2) -> f64 {
    (x - cell.min).max(cell.max - x).length()
}

/// Which quarter around `middle` a point lies in.
fn quadrant(middle: DVec2, x: DVec2) -> usize {
    usize::from(x.x > middle.x) + 2 * usize::from(x.y > middle.y)
}

/// A cell by its depth and its column and row among the cells of that depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub depth: u32,
    pub column: u64,
    pub row: u64,
}

impl Place {
    const ROOT: Self = Self {
        depth: 0,
        column: 0,
        row: 0,
    };

    fn quarter(self, quadrant: u64) -> Self {
        Self {
            depth: self.depth + 1,
            column: 2 * self.column + (quadrant & 1),
            row: 2 * self.row + (quadrant >> 1),
        }
    }

    /// The cells of the same depth across the four sides.
    fn neighbours(self) -> impl Iterator<Item = Self> {
        let count = 1u64 << self.depth;
        let steps = [(1, 0), (0, 1), (u64::MAX, 0), (0, u64::MAX)];
        steps.into_iter().filter_map(move |(right, up)| {
            let (column, row) = (self.column.wrapping_add(right), self.row.wrapping_add(up));
            (column < count && row < count).then_some(Self { column, row, ..self })
        })
    }
}

impl Quadtree {
    /// A point of the leaf and of the domain, where s is the leaf's radius.
    pub fn anchor(&self, leaf: &Leaf) -> DVec2 {
        if leaf.is_inside() {
            leaf.centre
        } else {
            self.anchors[leaf.anchor as usize]
        }
    }

    /// Distance from the anchor to the farthest corner.
    pub fn reach(&self, leaf: &Leaf) -> f64 {
        farthest_corner(leaf.rect(), self.anchor(leaf))
    }

    /// The places of all inner nodes.
    fn inner_places(&self) -> Vec<Place> {
        let mut places = Vec::new();
        let mut stack = vec![(0, Place::ROOT)];
        while let Some((node, place)) = stack.pop() {
            if let Node::Inner(first) = self.nodes[node as usize] {
                places.push(place);
                stack.extend((0..4u32).map(|quadrant| (first + quadrant, place.quarter(u64::from(quadrant)))));
            }
        }
        places
    }

    /// The leaf that holds the cell at `place` as a part, and its place.
    fn leaf_above(&self, place: Place) -> Option<(usize, Place)> {
        let (mut node, mut at) = (0, Place::ROOT);
        while at.depth < place.depth {
            match self.nodes[node] {
                Node::Outside => return None,
                Node::Leaf(_) => return Some((node, at)),
                Node::Inner(first) => {
                    let below = place.depth - at.depth - 1;
                    let quadrant = (place.column >> below & 1) + 2 * (place.row >> below & 1);
                    node = first as usize + quadrant as usize;
                    at = at.quarter(quadrant);
                }
            }
        }
        None
    }
}
