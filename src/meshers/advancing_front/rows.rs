//! A layer at a time, in the spirit of paving: rows are chosen and completed, and small openings are closed at once.
//!
//! As in the other mode, clefts are seamed first ([`super::queue`]).

use super::Advance;
use super::candidates::Apex;
use super::front::{Front, NONE};
use crate::geometry::predicates::orient2d;
use crate::geometry::{DVec2, Rect, turn};
use crate::meshers::MeshError;

/// Openings of at most this number of edges are closed at once if that is good enough: six, as in paving.
const CLOSURE: usize = 6;

impl Front<'_> {
    /// Row choice: queues the whole front as the coming rows, loop by loop. The loop with the shortest edges comes
    /// first, and each begins at its sharpest corner. Returns whether anything was queued.
    pub fn begin_row(&mut self) -> bool {
        if self.method.advance != Advance::Row {
            return false;
        }
        let mut is_taken = vec![false; self.edges.len()];
        let mut rows = Vec::new();
        for edge in self.live().collect::<Vec<_>>() {
            if !is_taken[edge as usize] && self.edge(edge).next != edge {
                let (row, edges) = self.row_from(edge);
                edges.iter().for_each(|&edge| is_taken[edge as usize] = true);
                rows.push((row, edges));
            }
        }
        // Equal lengths keep the order in which they were found.
        rows.sort_by(|(first, _), (second, _)| first.total_cmp(second));
        let mut is_any = false;
        for edge in rows.into_iter().flat_map(|(_, edges)| edges) {
            let this = *self.edge(edge);
            if this.attempts == 0 {
                self.queue.push_in_row(&this, edge);
                is_any = true;
            }
        }
        is_any
    }

    /// The edges of the loop through an edge, from its sharpest corner on, with their mean length.
    fn row_from(&self, edge: u32) -> (f64, Vec<u32>) {
        let mut edges = vec![edge];
        let mut at = self.edge(edge).next;
        while at != edge {
            edges.push(at);
            at = self.edge(at).next;
        }
        let length: f64 = edges.iter().map(|&edge| self.length_of(edge)).sum();
        let wedges = edges.iter().map(|&edge| self.wedge(edge));
        let sharpest = wedges
            .enumerate()
            .reduce(|least, other| if other.1 < least.1 { other } else { least });
        let start = sharpest.map_or(0, |(place, _)| (place + 1) % edges.len());
        let count = edges.len() as f64;
        edges.rotate_left(start);
        (length / count, edges)
    }

    fn length_of(&self, edge: u32) -> f64 {
        self.at(self.edge(edge).from).distance(self.at(self.edge(edge).to))
    }

    /// Closure check: closes small openings bounded by new edges, by the best of their triangulations.
    pub fn closure_check(&mut self, edges: [Option<u32>; 2]) -> Result<(), MeshError> {
        for edge in edges.into_iter().flatten() {
            let is_due = self.method.advance == Advance::Row && !self.stands(edge, NONE);
            let Some(corners) = is_due.then(|| self.small_loop(edge)).flatten() else {
                continue;
            };
            let points: Vec<DVec2> = corners.iter().map(|&node| self.at(node)).collect();
            let plan = Plan::best(&points);
            let is_good = plan.worst() >= 0.5 * self.method.accept;
            if is_good && !self.is_occupied(&corners, &points, edge) {
                self.close(&plan, &corners, 0, corners.len() - 1)?;
                self.tally.closures += 1;
            }
        }
        Ok(())
    }

    /// The nodes along the loop of an edge, from its end on, if they are few and all different.
    fn small_loop(&self, edge: u32) -> Option<Vec<u32>> {
        let mut corners = vec![self.edge(edge).to];
        let mut at = self.edge(edge).next;
        while at != edge {
            let node = self.edge(at).to;
            if corners.len() == CLOSURE || corners.contains(&node) {
                return None;
            }
            corners.push(node);
            at = self.edge(at).next;
        }
        (corners.len() > 3).then_some(corners)
    }

    /// Whether a front node other than the corners lies within the box around them: other steps then close the opening.
    fn is_occupied(&self, corners: &[u32], points: &[DVec2], edge: u32) -> bool {
        let (bounds, face) = (Rect::around(points.iter().copied()), self.edge(edge).face);
        let mut is_occupied = false;
        self.grid.near(bounds, |other| {
            let other = self.edge(other);
            let is_inside = bounds.contains(self.at(other.from));
            is_occupied |= other.face == face && is_inside && !corners.contains(&other.from);
        });
        is_occupied
    }

    /// Makes the planned triangles of the corners `low..=high`, whose base goes from the last to the first of them.
    fn close(&mut self, plan: &Plan, corners: &[u32], low: usize, high: usize) -> Result<(), MeshError> {
        if high - low < 2 {
            return Ok(());
        }
        let middle = plan.apex[low][high];
        let Some(edge) = self.between(corners[high], corners[low]) else {
            return Ok(());
        };
        let base = self.ideal_point(edge);
        self.advance(&base, Apex::Node(corners[middle]))?;
        self.close(plan, corners, low, middle)?;
        self.close(plan, corners, middle, high)
    }
}

/// The triangulation of a small polygon whose smallest angle is largest.
struct Plan {
    count: usize,
    /// The smallest angle in degrees within the corners i..=j; negative if they cannot be triangulated.
    angle: [[f64; CLOSURE]; CLOSURE],
    /// The apex over the base from corner j to corner i.
    apex: [[usize; CLOSURE]; CLOSURE],
}

impl Plan {
    fn best(points: &[DVec2]) -> Self {
        let mut plan = Self {
            count: points.len(),
            angle: [[180.0; CLOSURE]; CLOSURE],
            apex: [[0; CLOSURE]; CLOSURE],
        };
        for span in 2..points.len() {
            for low in 0..points.len() - span {
                let high = low + span;
                plan.angle[low][high] = -1.0;
                for middle in low + 1..high {
                    let own = smallest_angle(points[low], points[middle], points[high]);
                    let angle = own.min(plan.angle[low][middle]).min(plan.angle[middle][high]);
                    if angle > plan.angle[low][high] {
                        plan.angle[low][high] = angle;
                        plan.apex[low][high] = middle;
                    }
                }
            }
        }
        plan
    }

    fn worst(&self) -> f64 {
        self.angle[0][self.count - 1]
    }
}

/// The smallest angle of a triangle in degrees; negative unless it is counter-clockwise.
fn smallest_angle(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    if orient2d(a, b, c) <= 0.0 {
        return -1.0;
    }
    let angles = [turn(b - a, c - a), turn(c - b, a - b), turn(a - c, b - c)];
    angles.into_iter().fold(f64::INFINITY, f64::min).to_degrees()
}
