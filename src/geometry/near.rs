//! Near-queries among discs whose radii vary slowly: the store behind the front.
//!
//! # Idea
//! Discs are kept in one hash grid per power of two of the radius. Radii are t-Lipschitz in the centres,
//! |r − r′| ≤ t ‖c − c′‖ with t < 1, so discs that meet have radii within a factor (1 + t) / (1 − t) of each other and
//! centres within 2r / (1 − t): a query looks at a few cells of a few levels, however graded the radii are.
//!
//! # Cost
//! Since biting keeps centres apart, a cell holds O(1) discs and a query or an insertion is O(1). Cells are stored in
//! blocks of 8 × 8, so a query hashes about one to four times per level.

use super::DVec2;
use rustc_hash::FxHashMap;

/// A closed disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Centre, in the domain's unit.
    pub centre: DVec2,
    /// Radius, in the domain's unit.
    pub radius: f64,
}

/// A disc that a query found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Index of the disc, in insertion order.
    pub id: u32,
    /// Its centre minus the query's.
    pub offset: DVec2,
    /// Squared length of `offset`.
    pub distance_squared: f64,
    /// Its radius.
    pub radius: f64,
}

/// Discs in insertion order, with queries for those that meet a given disc.
#[derive(Debug)]
pub struct DiscGrid {
    t: f64,
    /// Each disc and the next one in its cell.
    discs: Vec<(Disc, u32)>,
    blocks: FxHashMap<BlockKey, u32>,
    /// The first disc of each cell, 64 cells per block.
    heads: Vec<[u32; BLOCK_CELLS]>,
    /// The number of discs on each level, by binary exponent of the radius.
    level_sizes: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct BlockKey {
    pub level: i32,
    pub column: i64,
    pub row: i64,
}

const NONE: u32 = u32::MAX;
pub(super) const BLOCK_SHIFT: i64 = 3;
pub(super) const BLOCK_SIDE: i64 = 1 << BLOCK_SHIFT;
pub(super) const BLOCK_CELLS: usize = (BLOCK_SIDE * BLOCK_SIDE) as usize;
/// Smallest binary exponent of a normal number.
const LOWEST_LEVEL: i32 = -1022;
/// Radii are evaluated in floating point: this room keeps rounding from hiding a neighbour.
const ROOM: f64 = 1.0 + 1e-6;

impl DiscGrid {
    /// An empty grid for discs whose radii are `t`-Lipschitz in their centres, 0 ≤ t < 1.
    pub fn new(t: f64) -> Self {
        assert!((0.0..1.0).contains(&t), "near-queries need 0 ≤ t < 1, not {t}");
        Self {
            t,
            discs: Vec::new(),
            blocks: FxHashMap::default(),
            heads: Vec::new(),
            level_sizes: vec![0; 2046],
        }
    }

    /// The number of discs.
    pub fn len(&self) -> usize {
        self.discs.len()
    }

    /// Disc `id`.
    pub fn disc(&self, id: u32) -> Disc {
        self.discs[id as usize].0
    }

    /// All discs, in insertion order.
    pub fn discs(&self) -> impl ExactSizeIterator<Item = Disc> + '_ {
        self.discs.iter().map(|&(disc, _)| disc)
    }

    /// Adds a disc of positive normal radius and returns its index.
    pub fn insert(&mut self, disc: Disc) -> u32 {
        let level = level_of(disc.radius);
        let inverse = inverse_cell_size(level);
        let (column, row) = (cell_of(disc.centre.x, inverse), cell_of(disc.centre.y, inverse));
        let key = BlockKey {
            level,
            column: column >> BLOCK_SHIFT,
            row: row >> BLOCK_SHIFT,
        };
        let heads = &mut self.heads;
        let block = *self.blocks.entry(key).or_insert_with(|| {
            heads.push([NONE; BLOCK_CELLS]);
            (heads.len() - 1) as u32
        });
        let head = &mut heads[block as usize][cell_in_block(column, row)];
        let id = self.discs.len() as u32;
        self.discs.push((disc, *head));
        *head = id;
        self.level_sizes[(level - LOWEST_LEVEL) as usize] += 1;
        id
    }

    /// Collects into `near` the discs whose interior meets that of `B(centre, radius)`. The query disc itself must
    /// fit the Lipschitz condition with those in the grid.
    pub fn meeting(&self, centre: DVec2, radius: f64, near: &mut Vec<Near>) {
        self.around(centre, radius, radius, near);
    }

    /// Collects into `near` the discs whose interior meets that of `B(centre, reach)`, where `radius` is the radius that a
    /// disc at `centre` would have. Needs t · `reach` < `radius`, and takes longer the nearer these two are.
    pub fn around(&self, centre: DVec2, radius: f64, reach: f64, near: &mut Vec<Near>) {
        near.clear();
        self.visit(centre, radius, reach, |candidate| {
            let sum = reach + candidate.radius;
            if candidate.distance_squared < sum * sum {
                near.push(candidate);
            }
        });
    }

    /// Collects into `near` the discs whose interior holds `point`, each shrunk by the share `tolerance` of its radius.
    /// `radius` is the radius that a disc at `point` would have.
    pub fn covering(&self, point: DVec2, radius: f64, tolerance: f64, near: &mut Vec<Near>) {
        near.clear();
        self.visit(point, radius, 0.0, |candidate| {
            let shrunk = candidate.radius * (1.0 - tolerance);
            if candidate.distance_squared < shrunk * shrunk {
                near.push(candidate);
            }
        });
    }

    /// Collects into `near` the discs whose centre is closer to `point` than `radius`, the radius that a disc there would have.
    pub fn within(&self, point: DVec2, radius: f64, near: &mut Vec<Near>) {
        near.clear();
        let radii = [(1.0 - self.t) * radius, (1.0 + self.t) * radius];
        self.visit_centres(
            point,
            radii,
            |_| radius,
            |candidate| {
                if candidate.distance_squared < radius * radius {
                    near.push(candidate);
                }
            },
        );
    }

    /// Collects into `near` the discs B(y, r) for which there may be a point z with a radius g(z) above ‖z − y‖ and above
    /// ‖z − centre‖, where g is the t-Lipschitz function that all radii are values of.
    ///
    /// Then g(z) ≤ g(y) + t ‖z − y‖ < g(y) + t g(z), so g(z) < r / (1 − t), and likewise for `radius`: so y is closer than
    /// 2 min(r, `radius`) / (1 − t). And r is between (1 − t) g(z) and (1 + t) g(z), as is `radius`.
    pub fn sharing(&self, centre: DVec2, radius: f64, near: &mut Vec<Near>) {
        near.clear();
        let reach = |r: f64| 2.0 * r / (1.0 - self.t);
        let steepest = (1.0 + self.t) / (1.0 - self.t);
        self.visit_centres(
            centre,
            [radius / steepest, radius * steepest],
            |_| reach(radius),
            |candidate| {
                let reach = reach(radius.min(candidate.radius));
                if candidate.distance_squared < reach * reach {
                    near.push(candidate);
                }
            },
        );
    }

    /// Calls `visit` for every disc that may meet `B(centre, extent)`, in an order that depends on the discs alone.
    ///
    /// A disc B(y, r) that does has ‖y − centre‖ < extent + r, and |r − radius| ≤ t ‖y − centre‖: so r lies between
    /// (radius − t · extent) / (1 + t) and (radius + t · extent) / (1 − t), and y within (radius + extent) / (1 − t).
    fn visit(&self, centre: DVec2, radius: f64, extent: f64, visit: impl FnMut(Near)) {
        let radii = [
            (radius - self.t * extent) / (1.0 + self.t),
            (radius + self.t * extent) / (1.0 - self.t),
        ];
        let reach = ROOM * (radius + extent) / (1.0 - self.t);
        // Radii of a level are below its cell size.
        self.visit_centres(centre, radii, |cell_size| reach.min(extent + cell_size), visit);
    }

    /// Calls `visit` for every disc whose radius is in a range and whose centre is within a distance, which `reach` returns for the
    /// size of a level's cells.
    fn visit_centres(
        &self,
        centre: DVec2,
        [smallest, largest]: [f64; 2],
        reach: impl Fn(f64) -> f64,
        mut visit: impl FnMut(Near),
    ) {
        for level in level_of(smallest / ROOM)..=level_of(ROOM * largest) {
            if self.level_sizes[(level - LOWEST_LEVEL) as usize] == 0 {
                continue;
            }
            let inverse = inverse_cell_size(level);
            let reach = reach(1.0 / inverse);
            let (low, high) = (centre - reach, centre + reach);
            let columns = (cell_of(low.x, inverse), cell_of(high.x, inverse));
            let rows = (cell_of(low.y, inverse), cell_of(high.y, inverse));
            for row_block in rows.0 >> BLOCK_SHIFT..=rows.1 >> BLOCK_SHIFT {
                for column_block in columns.0 >> BLOCK_SHIFT..=columns.1 >> BLOCK_SHIFT {
                    let key = BlockKey {
                        level,
                        column: column_block,
                        row: row_block,
                    };
                    let Some(&block) = self.blocks.get(&key) else { continue };
                    let heads = &self.heads[block as usize];
                    let (left, bottom) = (column_block << BLOCK_SHIFT, row_block << BLOCK_SHIFT);
                    for row in rows.0.max(bottom)..=rows.1.min(bottom + BLOCK_SIDE - 1) {
                        for column in columns.0.max(left)..=columns.1.min(left + BLOCK_SIDE - 1) {
                            let mut id = heads[cell_in_block(column, row)];
                            while id != NONE {
                                let (disc, next) = self.discs[id as usize];
                                let offset = disc.centre - centre;
                                let distance_squared = offset.length_squared();
                                visit(Near {
                                    id,
                                    offset,
                                    distance_squared,
                                    radius: disc.radius,
                                });
                                id = next;
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The two points where a circle of `radius` crosses the circle `other`, relative to its centre; the same point twice if
/// rounding makes the circles touch.
pub fn circle_intersections(radius: f64, other: &Near) -> [DVec2; 2] {
    let distance = other.distance_squared.sqrt();
    let along = (other.distance_squared + radius * radius - other.radius * other.radius) / (2.0 * distance);
    let across = (radius * radius - along * along).max(0.0).sqrt();
    let direction = other.offset / distance;
    let foot = direction * along;
    let offset = direction.perp() * across;
    [foot - offset, foot + offset]
}

/// How far from the line through their centres two circles of radius `a` and `b` at that distance meet; 0 if they do not.
pub fn meeting_height(distance: f64, a: f64, b: f64) -> f64 {
    let along = 0.5 * (distance + (a - b) * (a + b) / distance);
    ((a - along) * (a + along)).max(0.0).sqrt()
}

/// The binary exponent of a positive normal number: 2^level ≤ radius < 2^(level + 1).
pub(super) fn level_of(radius: f64) -> i32 {
    ((radius.to_bits() >> 52) as i32 & 0x7ff) - 1023
}

/// One over the cell size of a level, 2^(level + 1): above every radius of the level.
pub(super) fn inverse_cell_size(level: i32) -> f64 {
    f64::from_bits(((1023 - (level as i64 + 1)) as u64) << 52)
}

pub(super) fn cell_of(coordinate: f64, inverse: f64) -> i64 {
    (coordinate * inverse).floor() as i64
}

pub(super) fn cell_in_block(column: i64, row: i64) -> usize {
    (((row & (BLOCK_SIDE - 1)) << BLOCK_SHIFT) | (column & (BLOCK_SIDE - 1))) as usize
}

#[cfg(test)]
mod tests;
