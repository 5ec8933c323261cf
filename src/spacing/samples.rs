//! Samples of f in a quadtree: the smallest f(y) + α‖x − y‖ over all of them, by branch and bound.

use super::cover::Cell;
use crate::geometry::{DVec2, Rect};

/// Most nodes waiting in a query: three a level, and the four that are being entered.
const STACK: usize = 3 * super::cover::DEPTH + 8;

#[derive(Clone, Copy, Debug)]
struct Node {
    cell: Rect,
    /// Where f was sampled in the cell, and its value.
    at: DVec2,
    value: f64,
    /// The smallest value in the subtree.
    lowest: f64,
    parent: u32,
    /// First child; children are consecutive.
    first: u32,
    children: u32,
}

/// A quadtree with one sample a cell.
#[derive(Clone, Debug)]
pub struct Samples {
    nodes: Vec<Node>,
    alpha: f64,
}

impl Samples {
    /// A tree of one cell whose sample is still to be set.
    pub fn new(root: Rect, alpha: f64) -> Self {
        Self {
            nodes: vec![Self::unset(root, 0)],
            alpha,
        }
    }

    fn unset(cell: Rect, parent: u32) -> Node {
        let (value, lowest) = (f64::INFINITY, f64::INFINITY);
        Node {
            cell,
            at: cell.centre(),
            value,
            lowest,
            parent,
            first: 0,
            children: 0,
        }
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Gives `node` the children `cells`, whose samples are still to be set.
    pub fn add_children(&mut self, node: usize, cells: &[Cell]) {
        self.nodes[node].first = self.nodes.len() as u32;
        self.nodes[node].children = cells.len() as u32;
        self.nodes
            .extend(cells.iter().map(|cell| Self::unset(cell.rect, node as u32)));
    }

    /// The children of `node`.
    pub fn children(&self, node: usize) -> std::ops::Range<usize> {
        let Node { first, children, .. } = self.nodes[node];
        first as usize..(first + children) as usize
    }

    /// The cell of `node`.
    pub fn cell(&self, node: usize) -> Rect {
        self.nodes[node].cell
    }

    /// Sets the sample of `node`.
    pub fn set(&mut self, node: usize, at: DVec2, value: f64) {
        self.nodes[node].at = at;
        self.nodes[node].value = value;
        let mut up = node;
        while value < self.nodes[up].lowest {
            self.nodes[up].lowest = value;
            up = self.nodes[up].parent as usize;
        }
    }

    /// f(y) + α‖x − y‖ for the sample y of `node`.
    fn through(&self, node: &Node, x: DVec2) -> f64 {
        node.value + self.alpha * node.at.distance(x)
    }

    /// min over all samples y of f(y) + α‖x − y‖; `near` is a node whose sample is thought to be good.
    pub fn lowest_at(&self, x: DVec2, near: usize) -> f64 {
        let mut best = self.through(&self.nodes[near], x);
        let mut stack = [(0.0, 0); STACK];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (bound, index): (f64, u32) = stack[height];
            if bound >= best {
                continue;
            }
            let node = &self.nodes[index as usize];
            best = best.min(self.through(node, x));
            let mut entered = height;
            for child in node.first..node.first + node.children {
                let inner = &self.nodes[child as usize];
                let bound = inner.lowest + self.alpha * inner.cell.distance(x);
                if bound < best {
                    // Kept in descending order, so that the most promising child is entered first.
                    let mut at = entered;
                    while at > height && stack[at - 1].0 < bound {
                        stack[at] = stack[at - 1];
                        at -= 1;
                    }
                    stack[at] = (bound, child);
                    entered += 1;
                }
            }
            height = entered;
        }
        best
    }
}
