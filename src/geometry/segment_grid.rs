//! Near-queries among segments that come and go: the index behind a front of mesh edges.
//!
//! # Idea
//! A segment is filed by its middle in one hash grid per power of two of its length, in cells larger than the segment. On every
//! level in use, a query by box visits the cells whose segments could reach the box: those of the box grown by half a cell.
//! If the box spans more blocks of a level than the level has, the query goes through the level's blocks instead, so that
//! a large box over minute segments costs no more than the blocks there are.
//!
//! # Cost
//! O(1) for an insertion or removal; a query costs the cells it covers plus what they contain.

use super::near::{
    BLOCK_CELLS, BLOCK_SHIFT, BLOCK_SIDE, BlockKey, cell_in_block, cell_of, inverse_cell_size, level_of,
};
use super::{DVec2, Rect};
use rustc_hash::FxHashMap;

/// Segments, each under a small whole number of the caller's choice, which may be used again after removal.
#[derive(Debug, Default)]
pub struct SegmentGrid {
    /// By the caller's number.
    entries: Vec<Entry>,
    blocks: FxHashMap<BlockKey, u32>,
    /// The first segment of each cell, 64 cells per block.
    heads: Vec<[u32; BLOCK_CELLS]>,
    /// Levels in the order of their cell size.
    levels: Vec<Level>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    block: u32,
    cell: u32,
    before: u32,
    after: u32,
    level: i32,
}

#[derive(Debug)]
struct Level {
    level: i32,
    held: u32,
    /// Column, row and number of its blocks.
    blocks: Vec<(i64, i64, u32)>,
}

const NONE: u32 = u32::MAX;
const ABSENT: Entry = Entry {
    block: NONE,
    cell: 0,
    before: NONE,
    after: NONE,
    level: 0,
};
/// By how many cells a box grows: half a segment, plus room for the rounding of cell coordinates, which are accurate to
/// 2⁻¹⁰ of a cell at the finest resolution that a mesher accepts.
const REACH: f64 = 0.5 + 1.0 / 256.0;

impl SegmentGrid {
    /// Files a segment under `id`; `extent`, positive and normal, is at least its length.
    pub fn insert(&mut self, id: u32, middle: DVec2, extent: f64) {
        let level = level_of(extent);
        let inverse = inverse_cell_size(level);
        let (column, row) = (cell_of(middle.x, inverse), cell_of(middle.y, inverse));
        let (block_column, block_row) = (column >> BLOCK_SHIFT, row >> BLOCK_SHIFT);
        let at = match self.levels.binary_search_by_key(&level, |known| known.level) {
            Ok(at) => at,
            Err(at) => {
                let new = Level {
                    level,
                    held: 0,
                    blocks: Vec::new(),
                };
                self.levels.insert(at, new);
                at
            }
        };
        let (known, heads) = (&mut self.levels[at], &mut self.heads);
        known.held += 1;
        let key = BlockKey {
            level,
            column: block_column,
            row: block_row,
        };
        let block = *self.blocks.entry(key).or_insert_with(|| {
            heads.push([NONE; BLOCK_CELLS]);
            let block = (heads.len() - 1) as u32;
            known.blocks.push((block_column, block_row, block));
            block
        });
        let cell = cell_in_block(column, row);
        let after = std::mem::replace(&mut self.heads[block as usize][cell], id);
        if self.entries.len() <= id as usize {
            self.entries.resize(id as usize + 1, ABSENT);
        }
        self.entries[id as usize] = Entry {
            block,
            cell: cell as u32,
            before: NONE,
            after,
            level,
        };
        if after != NONE {
            self.entries[after as usize].before = id;
        }
    }

    /// Forgets the segment filed under `id`, if there is one.
    pub fn remove(&mut self, id: u32) {
        let Some(slot) = self.entries.get_mut(id as usize) else {
            return;
        };
        let entry = std::mem::replace(slot, ABSENT);
        if entry.block == NONE {
            return;
        }
        match entry.before {
            NONE => self.heads[entry.block as usize][entry.cell as usize] = entry.after,
            before => self.entries[before as usize].after = entry.after,
        }
        if entry.after != NONE {
            self.entries[entry.after as usize].before = entry.before;
        }
        if let Ok(at) = self.levels.binary_search_by_key(&entry.level, |known| known.level) {
            self.levels[at].held -= 1;
        }
    }

    /// Calls `visit` with every segment that may meet the closed box, in an order that depends on the past calls alone.
    pub fn near(&self, bounds: Rect, mut visit: impl FnMut(u32)) {
        for level in self.levels.iter().filter(|level| level.held > 0) {
            let inverse = inverse_cell_size(level.level);
            let reach = DVec2::splat(REACH / inverse);
            let (low, high) = (bounds.min - reach, bounds.max + reach);
            let columns = (cell_of(low.x, inverse), cell_of(high.x, inverse));
            let rows = (cell_of(low.y, inverse), cell_of(high.y, inverse));
            let block_columns = columns.0 >> BLOCK_SHIFT..=columns.1 >> BLOCK_SHIFT;
            let block_rows = rows.0 >> BLOCK_SHIFT..=rows.1 >> BLOCK_SHIFT;
            let span = |range: &std::ops::RangeInclusive<i64>| range.end().saturating_sub(*range.start()) as f64 + 1.0;
            if span(&block_columns) * span(&block_rows) > level.blocks.len() as f64 {
                for &(column, row, block) in &level.blocks {
                    if block_columns.contains(&column) && block_rows.contains(&row) {
                        self.visit_block((column, row, block), columns, rows, &mut visit);
                    }
                }
                continue;
            }
            for row in block_rows {
                for column in block_columns.clone() {
                    let key = BlockKey {
                        level: level.level,
                        column,
                        row,
                    };
                    if let Some(&block) = self.blocks.get(&key) {
                        self.visit_block((column, row, block), columns, rows, &mut visit);
                    }
                }
            }
        }
    }

    /// Visits the cells of a block that lie in the given columns and rows.
    fn visit_block(
        &self,
        (block_column, block_row, block): (i64, i64, u32),
        columns: (i64, i64),
        rows: (i64, i64),
        visit: &mut impl FnMut(u32),
    ) {
        let heads = &self.heads[block as usize];
        let (left, bottom) = (block_column << BLOCK_SHIFT, block_row << BLOCK_SHIFT);
        for row in rows.0.max(bottom)..=rows.1.min(bottom + BLOCK_SIDE - 1) {
            for column in columns.0.max(left)..=columns.1.min(left + BLOCK_SIDE - 1) {
                let mut id = heads[cell_in_block(column, row)];
                while id != NONE {
                    visit(id);
                    id = self.entries[id as usize].after;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::segments::meets_box;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_segment_is_found_from_its_far_end() {
        for scale in [1.0 / 1024.0, 1.0, 1024.0] {
            let mut grid = SegmentGrid::default();
            // Its middle and its end lie in different cells.
            grid.insert(0, scale * DVec2::new(-0.1, 0.3), 1.2 * scale);
            let end = Rect {
                min: scale * DVec2::new(0.49, 0.29),
                max: scale * DVec2::new(0.51, 0.31),
            };
            let mut found = Vec::new();
            grid.near(end, |id| found.push(id));
            assert_eq!(found, [0], "scale {scale}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn a_query_misses_none_that_a_loop_finds(
            segments in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64, -12.0..0.0f64, 0.0..std::f64::consts::TAU), 1..150),
            removed in prop::collection::vec(any::<bool>(), 150),
            corner in (-1.0..1.0f64, -1.0..1.0f64),
            size in -10.0..1.0f64,
            scale in prop::sample::select(vec![1.0, 1024.0, 1.0 / 1024.0]),
        ) {
            let mut grid = SegmentGrid::default();
            let ends: Vec<[DVec2; 2]> = segments.iter().map(|&(x, y, log, angle)| {
                let start = DVec2::new(x, y);
                [scale * start, scale * (start + log.exp2() * DVec2::from_angle(angle))]
            }).collect();
            for (id, [a, b]) in ends.iter().enumerate() {
                grid.insert(id as u32, a.midpoint(*b), a.distance(*b));
            }
            (0..ends.len()).filter(|&id| removed[id]).for_each(|id| grid.remove(id as u32));
            let bounds = Rect { min: scale * DVec2::from(corner), max: scale * (DVec2::from(corner) + size.exp2()) };
            let mut found = vec![0; ends.len()];
            grid.near(bounds, |id| found[id as usize] += 1);
            for id in 0..ends.len() {
                prop_assert!(found[id] <= 1 && (found[id] == 0 || !removed[id]));
                prop_assert!(removed[id] || found[id] == 1 || !meets_box(ends[id], &bounds), "segment {id} is missed");
            }
        }
    }
}
