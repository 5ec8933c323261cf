//! Samples of f in a quadtree: whether the smallest f(y) + α‖x − y‖ over all of them is low enough, by branch and bound.

use crate::geometry::{DVec2, Rect};
use crate::spacing::cover::Cell;
use crate::spacing::limit::waiting::Waiting;

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

/// A quadtree with one sample per cell.
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

    /// Whether f(y) + α‖x − y‖ `suffices` for some sample y; whatever is lower than a value that suffices must suffice too. The
    /// sample of the node `near` is tried first.
    pub fn any(&self, x: DVec2, near: usize, suffices: impl Fn(f64) -> bool) -> bool {
        if suffices(self.through(&self.nodes[near], x)) {
            return true;
        }
        let mut waiting = Waiting::new(0.0, 0);
        while let Some((_, index)) = waiting.next() {
            let node = &self.nodes[index as usize];
            if suffices(self.through(node, x)) {
                return true;
            }
            for child in node.first..node.first + node.children {
                let inner = &self.nodes[child as usize];
                let bound = inner.lowest + self.alpha * inner.cell.distance(x);
                if suffices(bound) {
                    waiting.file(bound, child);
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spacing::testing::pseudo_random_points;
    use proptest::prelude::*;

    const ROOT: Rect = Rect {
        min: DVec2::ZERO,
        max: DVec2::ONE,
    };

    /// Splits the cells that `choices` name, one after another, and sets a sample in every cell.
    fn tree(choices: &[usize], values: &[f64], alpha: f64) -> Samples {
        let mut samples = Samples::new(ROOT, alpha);
        for choice in choices {
            let leaves: Vec<usize> = (0..samples.len())
                .filter(|&node| samples.children(node).is_empty())
                .collect();
            let node = leaves[choice % leaves.len()];
            // Some quarters may be outside the domain.
            let quarters = samples.cell(node).quarters().into_iter().skip(choice % 3);
            let cells: Vec<Cell> = quarters
                .map(|rect| Cell {
                    rect,
                    crossing: Vec::new(),
                })
                .collect();
            samples.add_children(node, &cells);
        }
        let places = pseudo_random_points(samples.len());
        for (node, place) in places.into_iter().enumerate() {
            let cell = samples.cell(node);
            samples.set(node, cell.min + place * cell.size(), values[node % values.len()]);
        }
        samples
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn what_suffices_is_found_if_the_lowest_of_all_samples_does(
            choices in prop::collection::vec(0usize..1000, 0..20),
            values in prop::collection::vec(0.1f64..10.0, 97),
            x in (-0.5f64..1.5, -0.5f64..1.5),
            alpha in prop::sample::select(vec![0.7, 7.0]),
        ) {
            let (samples, x) = (tree(&choices, &values, alpha), DVec2::new(x.0, x.1));
            let all = samples.nodes.iter().map(|node| node.value + alpha * node.at.distance(x));
            let lowest = all.fold(99.0, f64::min);
            for near in [0, samples.len() / 2, samples.len() - 1] {
                prop_assert!(samples.any(x, near, |value| value <= lowest));
                prop_assert!(!samples.any(x, near, |value| value < lowest));
            }
        }

        #[test]
        fn every_node_knows_its_children_and_the_lowest_value_below_it(
            choices in prop::collection::vec(0usize..1000, 0..20),
            values in prop::collection::vec(0.1f64..1.0, 97),
        ) {
            let samples = tree(&choices, &values, 0.7);
            prop_assert_eq!(samples.len(), 1 + choices.iter().map(|choice| 4 - choice % 3).sum::<usize>());
            let mut parents = vec![0; samples.len()];
            for node in 0..samples.len() {
                for child in samples.children(node) {
                    parents[child] = node;
                    let (inner, outer) = (samples.cell(child), samples.cell(node));
                    prop_assert_eq!(2.0 * inner.size(), outer.size());
                    prop_assert!(outer.contains(inner.min) && outer.contains(inner.max));
                }
            }
            let mut lowest: Vec<f64> = samples.nodes.iter().map(|node| node.value).collect();
            for node in (1..samples.len()).rev() {
                lowest[parents[node]] = lowest[parents[node]].min(lowest[node]);
            }
            prop_assert_eq!(samples.nodes.iter().map(|node| node.lowest).collect::<Vec<_>>(), lowest);
        }
    }
}
