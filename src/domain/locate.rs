//! Which face holds a point, decided exactly, in about a tenth of a microsecond.
//!
//! A grid contains the face of every cell that no segment comes near. In the other cells the first segment in the direction +x
//! from the point ([`SegmentIndex::right_of`]) decides: the point lies in the face on the near side of it.

use super::Segment;
use crate::geometry::segments::{Seen, SegmentIndex};
use crate::geometry::tolerance::GRID_SLACK;
use crate::geometry::{DVec2, Rect};

/// Cells per segment: enough that most queries end in the grid.
const CELLS_PER_SEGMENT: f64 = 16.0;

/// Most cells that segments may run through, per segment; makes cells larger where many segments are long.
const CROSSED_PER_SEGMENT: f64 = 8.0;

/// Marks a cell that a segment meets.
const MIXED: u32 = u32::MAX;

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the open face of this number.
    Face(usize),
    /// On this segment or one of its ends; any of them if there are several.
    Segment(usize),
}

/// Finds faces of points.
#[derive(Clone, Debug)]
pub(super) struct Locator {
    origin: DVec2,
    cells_per_unit: DVec2,
    columns: usize,
    rows: usize,
    /// The face of each cell, row by row, or [`MIXED`].
    cells: Vec<u32>,
}

impl Locator {
    /// Marks the cells; O(n log n) for n segments.
    pub fn new(bounds: Rect, segments: &[Segment], ends: impl Fn(usize) -> [DVec2; 2], index: &SegmentIndex) -> Self {
        let size = bounds.size();
        let count = segments.len() as f64;
        let length: f64 = (0..segments.len())
            .map(|s| {
                let [a, b] = ends(s);
                a.distance(b)
            })
            .sum();
        let side = (size.x * size.y / (CELLS_PER_SEGMENT * count))
            .sqrt()
            .max(length / (CROSSED_PER_SEGMENT * count));
        let along =
            |extent: f64| ((extent / side).ceil() as usize).clamp(1, CELLS_PER_SEGMENT as usize * segments.len());
        let (columns, rows) = (along(size.x), along(size.y));
        let mut grid = Self {
            origin: bounds.min,
            cells_per_unit: DVec2::new(columns as f64, rows as f64) / size,
            columns,
            rows,
            cells: vec![0; columns * rows],
        };
        for s in 0..segments.len() {
            grid.mark(ends(s));
        }
        grid.fill(segments, index);
        grid
    }

    /// Marks every cell that the segment comes within [`GRID_SLACK`] cells of.
    fn mark(&mut self, ends: [DVec2; 2]) {
        let [a, b] = ends.map(|p| (p - self.origin) * self.cells_per_unit);
        let clamp = |x: f64, count: usize| (x.max(0.0) as usize).min(count - 1);
        let (low, high) = (a.y.min(b.y), a.y.max(b.y));
        for row in clamp(low - GRID_SLACK, self.rows)..=clamp(high + GRID_SLACK, self.rows) {
            let at = |y: f64| {
                let share = if a.y == b.y {
                    0.0
                } else {
                    ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0)
                };
                a.x + share * (b.x - a.x)
            };
            let flat = a.y == b.y;
            let from = if flat { a.x } else { at(row as f64 - GRID_SLACK) };
            let to = if flat { b.x } else { at(row as f64 + 1.0 + GRID_SLACK) };
            let first = clamp(from.min(to) - GRID_SLACK, self.columns);
            let last = clamp(from.max(to) + GRID_SLACK, self.columns);
            self.cells[row * self.columns + first..=row * self.columns + last].fill(MIXED);
        }
    }

    /// Writes the face of each cell that no segment meets, by one query per run of such cells.
    fn fill(&mut self, segments: &[Segment], index: &SegmentIndex) {
        for row in 0..self.rows {
            let mut known = None;
            for column in 0..self.columns {
                let cell = row * self.columns + column;
                if self.cells[cell] == MIXED {
                    known = None;
                    continue;
                }
                let face = known.unwrap_or_else(|| {
                    let centre = self.origin + (DVec2::new(column as f64, row as f64) + 0.5) / self.cells_per_unit;
                    match look(centre, segments, index) {
                        Place::Face(face) => face as u32,
                        Place::Segment(_) => MIXED,
                    }
                });
                known = Some(face);
                self.cells[cell] = face;
            }
        }
    }

    /// Where `x` lies. Points that are not finite lie in face 0.
    pub fn place(&self, x: DVec2, segments: &[Segment], index: &SegmentIndex) -> Place {
        let at = (x - self.origin) * self.cells_per_unit;
        let (column, row) = (at.x as usize, at.y as usize);
        let in_grid = at.x >= 0.0 && at.y >= 0.0 && column < self.columns && row < self.rows;
        // Outside the grid, and on its border, the query itself decides.
        let known = if in_grid {
            self.cells[row * self.columns + column]
        } else {
            MIXED
        };
        if known == MIXED {
            look(x, segments, index)
        } else {
            Place::Face(known as usize)
        }
    }
}

/// Where `x` lies, by the first segment in the direction +x.
pub(super) fn look(x: DVec2, segments: &[Segment], index: &SegmentIndex) -> Place {
    match index.right_of(x) {
        Seen::On(s) => Place::Segment(s),
        Seen::Segment(s, true) => Place::Face(segments[s].left),
        Seen::Segment(s, false) => Place::Face(segments[s].right),
        Seen::Nothing => Place::Face(0),
    }
}
