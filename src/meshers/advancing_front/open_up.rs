//! Opening up: if a face of the front cannot be closed well, the elements around it are deleted, and the front
//! advances there again from elsewhere.

use super::front::{Front, NONE, OPEN, Triangle};
use super::ideal_point::Base;
use crate::geometry::{DVec2, Rect};

/// Elements with a corner within this many δ₁ of the base's middle are deleted.
const REACH: f64 = 1.5;

/// How often the front is opened up at one place, at most.
const TIMES: usize = 2;

impl Front<'_> {
    /// Deletes the elements around a base, unless there are none or they were deleted too often before.
    pub fn open_up(&mut self, base: &Base) -> bool {
        let (middle, reach) = (base.a.midpoint(base.b), REACH * base.side.max(base.length));
        if self.times_opened(middle, reach) >= TIMES {
            return false;
        }
        let doomed = self.elements_around(base, middle, reach);
        if doomed.is_empty() {
            return false;
        }
        self.openings.insert(self.opened_at.len() as u32, middle, reach);
        self.opened_at.push(middle);
        self.tally.opened += 1;
        self.tally.reopened_elements += doomed.len();
        self.delete(&doomed);
        true
    }

    fn times_opened(&self, middle: DVec2, reach: f64) -> usize {
        let bounds = Rect {
            min: middle - reach,
            max: middle + reach,
        };
        let mut times = 0;
        self.openings.near(bounds, |at| {
            times += usize::from(self.opened_at[at as usize].distance(middle) <= reach)
        });
        times
    }

    /// Elements behind the front near the base, and those reached from them across sides, if they have a corner within
    /// reach.
    fn elements_around(&self, base: &Base, middle: DVec2, reach: f64) -> Vec<u32> {
        let bounds = Rect {
            min: middle - reach,
            max: middle + reach,
        };
        let face = self.edge(base.edge).face;
        let mut found = Vec::new();
        let is_near = |triangle: u32| {
            let corners = self.triangles[triangle as usize].corners;
            corners.iter().any(|&corner| self.at(corner).distance(middle) <= reach)
        };
        self.grid.near(bounds, |edge| {
            let edge = self.edge(edge);
            if edge.face == face && edge.right != NONE && is_near(edge.right) && !found.contains(&edge.right) {
                found.push(edge.right);
            }
        });
        let mut place = 0;
        while place < found.len() {
            for across in self.triangles[found[place] as usize].across {
                if across < OPEN && is_near(across) && !found.contains(&across) {
                    found.push(across);
                }
            }
            place += 1;
        }
        found
    }

    /// Deletes triangles: their edges on the front leave it, the edges behind them join it.
    fn delete(&mut self, doomed: &[u32]) {
        let mut nodes = Vec::new();
        let mut opened = Vec::new();
        for &triangle in doomed {
            let Triangle {
                corners, across, face, ..
            } = self.triangles[triangle as usize];
            nodes.extend(corners);
            for side in 0..3 {
                let (from, to) = (corners[side], corners[(side + 1) % 3]);
                match across[side] {
                    OPEN => {
                        if let Some(edge) = self.between(to, from) {
                            self.remove_edge(edge);
                        }
                    }
                    beyond if beyond != NONE && doomed.contains(&beyond) => {}
                    beyond => {
                        self.set_across(beyond, to, from, OPEN);
                        opened.push(self.add_edge(from, to, face, beyond));
                    }
                }
            }
        }
        for &triangle in doomed {
            let triangle = &mut self.triangles[triangle as usize];
            triangle.corners = [NONE; 3];
            triangle.is_seam = false;
        }
        nodes.sort_unstable();
        nodes.dedup();
        for &node in &nodes {
            self.relink(node);
            let is_input = (node as usize) < self.domain.vertices().len();
            let is_lonely = self.leaving(node).next().is_none();
            // Only a vertex that no segment touches can lose all its edges and still have to be connected.
            if is_input && is_lonely && self.domain.isolated().binary_search(&(node as usize)).is_ok() {
                let face = self.domain.face_at(self.at(node)) as u32;
                self.add_edge(node, node, face, NONE);
            }
        }
        let around: Vec<u32> = nodes.iter().flat_map(|&node| self.entering(node)).collect();
        opened.into_iter().for_each(|edge| self.enqueue(edge));
        around.into_iter().for_each(|edge| self.requeue_untried(edge));
    }

    /// Queues a face again as if it had not been tried, since its surroundings have changed. A node that no other edge
    /// touches is not a face.
    pub fn requeue_untried(&mut self, edge: u32) {
        if self.edge(edge).next != edge {
            self.edges[edge as usize].attempts = 0;
            self.enqueue(edge);
        }
    }
}
