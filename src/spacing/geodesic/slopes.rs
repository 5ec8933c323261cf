//! Lowers the values at the vertices of a mesh until no triangle is steeper than α.

use crate::geometry::DVec2;
use crate::mesh::Lists;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A triangle steeper than α by no more than this factor is left as it is, or lowering might go on for ever; the values are scaled
/// in the end.
const ROOM: f64 = 1e-6;

/// Most visits to a triangle, on average: many times what is needed.
const LOOKS: usize = 400;

/// Most rounds of raising values, and the share that a round must gain.
const ROUNDS: usize = 24;
const LITTLE: f64 = 2e-3;

/// Points, triangles of any orientation, and values that are linear on each triangle.
pub struct Slopes<'a> {
    pub points: &'a [DVec2],
    pub triangles: &'a [[u32; 3]],
    pub values: Vec<f64>,
}

impl Slopes<'_> {
    /// Lowers values until the gradient is at most `alpha` on every triangle. No value falls below the smallest there is.
    ///
    /// Values are first lowered far enough, the lowest vertices first: what they allow their neighbours is then nearly final. Then
    /// each is raised again as far as its triangles allow, the others staying as they are, until that changes little.
    pub fn limit(&mut self, alpha: f64, most: &[f64]) {
        let at_corners = (0..)
            .zip(self.triangles)
            .flat_map(|(t, corners)| corners.map(|v| (v, t)));
        let around = Lists::group(self.points.len(), at_corners);
        self.lower(alpha, &around);
        self.raise(alpha, &around, most);
        let steepest = self.steepest();
        if steepest > alpha {
            let share = alpha / steepest * (1.0 - 4.0 * f64::EPSILON);
            self.values.iter_mut().for_each(|value| *value *= share);
        }
    }

    fn lower(&mut self, alpha: f64, around: &Lists) {
        let keys = self.values.iter().map(|value| value.to_bits());
        let mut waiting: BinaryHeap<Reverse<(u64, u32)>> = keys.zip(0..).map(Reverse).collect();
        let mut looks = LOOKS * self.triangles.len();
        while let Some(Reverse((key, v))) = waiting.pop() {
            if key != self.values[v as usize].to_bits() {
                continue;
            }
            for &t in around.get(v as usize) {
                while let Some(lowered) = self.lower_one(t as usize, alpha) {
                    waiting.push(Reverse((self.values[lowered as usize].to_bits(), lowered)));
                }
                looks = looks.saturating_sub(1);
            }
            if looks == 0 {
                break;
            }
        }
    }

    /// Raises values to at most `most`, lowest first, in rounds.
    fn raise(&mut self, alpha: f64, around: &Lists, most: &[f64]) {
        let is_lowered = |values: &[f64], v: u32| values[v as usize] < most[v as usize];
        let mut active: Vec<u32> = (0..most.len() as u32)
            .filter(|&v| is_lowered(&self.values, v))
            .collect();
        let mut is_next = vec![false; most.len()];
        for _ in 0..ROUNDS {
            active.sort_by(|&v, &w| {
                self.values[v as usize]
                    .total_cmp(&self.values[w as usize])
                    .then(v.cmp(&w))
            });
            for v in std::mem::take(&mut active) {
                is_next[v as usize] = false;
                let caps = around
                    .get(v as usize)
                    .iter()
                    .map(|&t| self.cap_in(v, t as usize, alpha));
                let cap = caps.fold(most[v as usize], f64::min);
                if cap <= self.values[v as usize] * (1.0 + LITTLE) {
                    continue;
                }
                self.values[v as usize] = cap;
                for w in around.get(v as usize).iter().flat_map(|&t| self.triangles[t as usize]) {
                    if is_lowered(&self.values, w) && !is_next[w as usize] {
                        is_next[w as usize] = true;
                        active.push(w);
                    }
                }
            }
            if active.is_empty() {
                break;
            }
        }
    }

    /// The largest value at corner `v` of triangle `t` for which the gradient is at most `alpha`.
    fn cap_in(&self, v: u32, t: usize, alpha: f64) -> f64 {
        let [a, b, c] = self.triangles[t];
        let others = match v {
            _ if v == a => [b, c],
            _ if v == b => [c, a],
            _ => [a, b],
        };
        self.cap(v, others, alpha)
    }

    /// The length of the steepest gradient.
    pub fn steepest(&self) -> f64 {
        let steepness = |t: usize| self.gradient(t).length();
        (0..self.triangles.len()).map(steepness).fold(0.0, f64::max)
    }

    fn gradient(&self, t: usize) -> DVec2 {
        let [a, b, c] = self.triangles[t].map(|v| (self.points[v as usize], self.values[v as usize]));
        let (ab, ac) = (b.0 - a.0, c.0 - a.0);
        ((c.1 - a.1) * ab.perp() - (b.1 - a.1) * ac.perp()) / ab.perp_dot(ac)
    }

    /// Lowers one corner of a triangle that is too steep, by as little as is enough if it is the only one, and returns it.
    fn lower_one(&mut self, t: usize, alpha: f64) -> Option<u32> {
        if self.gradient(t).length() <= alpha * (1.0 + ROOM) {
            return None;
        }
        let mut corners = self.triangles[t];
        corners.sort_by(|&v, &w| self.values[v as usize].total_cmp(&self.values[w as usize]));
        let [low, middle, high] = corners;
        // The edges from the lowest corner first: no third value helps an edge that is too steep.
        let along = |v: u32| {
            let length = self.points[v as usize].distance(self.points[low as usize]);
            self.values[low as usize] + alpha * length
        };
        let caps = [
            (middle, along(middle)),
            (high, along(high)),
            (
                high,
                self.cap(high, [low, middle], alpha).max(self.values[low as usize]),
            ),
            (
                middle,
                self.cap(middle, [low, high], alpha).max(self.values[low as usize]),
            ),
        ];
        let lowered = caps.into_iter().find(|&(v, cap)| cap < self.values[v as usize]);
        lowered.map(|(v, cap)| {
            self.values[v as usize] = cap;
            v
        })
    }

    /// The largest value at `v` for which the gradient is at most `alpha`, if the edge between the two others is not too steep.
    fn cap(&self, v: u32, [low, other]: [u32; 2], alpha: f64) -> f64 {
        let [x, from, to] = [v, low, other].map(|v| self.points[v as usize]);
        let [start, end] = [low, other].map(|v| self.values[v as usize]);
        let length = from.distance(to);
        let (direction, slope) = ((to - from) / length, (end - start) / length);
        let (along, across) = ((x - from).dot(direction), (x - from).perp_dot(direction).abs());
        let left = ((alpha - slope) * (alpha + slope)).max(0.0).sqrt();
        start + slope * along + across * left
    }
}
