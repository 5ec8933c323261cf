//! Near-queries among discs whose radii vary slowly: the store behind the front.
//!
//! # Idea
//! Discs are kept in one hash grid per power of two of the radius. Radii are t-Lipschitz in the centres,
//! |r − r′| ≤ t ‖c − c′‖ with t < 1, so discs that meet have radii within a factor (1 + t) / (1 − t) of each other and
//! centres within 2r / (1 − t): a query looks at a few cells of a few levels, however graded the radii are.
//!
//! # Cost
//! Since biting keeps centres apart, a cell holds O(1) discs and a query or an insertion is O(1). Cells are stored in
//! blocks of 8 × 8, so a query hashes about one to four times a level.

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

/// A disc as a query sees it.
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
    /// Disc and the next one in its cell.
    discs: Vec<(Disc, u32)>,
    blocks: FxHashMap<BlockKey, u32>,
    /// First disc of each cell, 64 cells a block.
    heads: Vec<[u32; BLOCK_CELLS]>,
    /// How many discs a level holds, by binary exponent of the radius.
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
/// Radii are evaluated in floating point: room so that rounding cannot hide a neighbour.
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

    /// How many discs there are.
    pub fn len(&self) -> usize {
        self.discs.len()
    }

    /// Whether there is no disc.
    pub fn is_empty(&self) -> bool {
        self.discs.is_empty()
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
    /// disc at `centre` would have. Needs t · `reach` < `radius`, and takes longer the nearer they are.
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

    /// Calls `visit` for every disc that may meet `B(centre, extent)`, in an order that depends on the discs alone.
    ///
    /// A disc B(y, r) that does has ‖y − centre‖ < extent + r, and |r − radius| ≤ t ‖y − centre‖: so r lies between
    /// (radius − t · extent) / (1 + t) and (radius + t · extent) / (1 − t), and y within (radius + extent) / (1 − t).
    fn visit(&self, centre: DVec2, radius: f64, extent: f64, mut visit: impl FnMut(Near)) {
        let smallest = (radius - self.t * extent) / ((1.0 + self.t) * ROOM);
        let largest = ROOM * (radius + self.t * extent) / (1.0 - self.t);
        let reach = ROOM * (radius + extent) / (1.0 - self.t);
        for level in level_of(smallest)..=level_of(largest) {
            if self.level_sizes[(level - LOWEST_LEVEL) as usize] == 0 {
                continue;
            }
            let inverse = inverse_cell_size(level);
            // Radii of a level are below its cell size.
            let reach = reach.min(extent + 1.0 / inverse);
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

/// The two points, relative to the centre of a circle of `radius`, where it crosses the circle `other`; the same point
/// twice where rounding makes them touch.
pub fn circle_intersections(radius: f64, other: &Near) -> [DVec2; 2] {
    let distance = other.distance_squared.sqrt();
    let along = (other.distance_squared + radius * radius - other.radius * other.radius) / (2.0 * distance);
    let across = (radius * radius - along * along).max(0.0).sqrt();
    let direction = other.offset / distance;
    let foot = direction * along;
    let offset = direction.perp() * across;
    [foot - offset, foot + offset]
}

/// How far from the line through their centres two circles of radius `a` and `b` at that distance meet; 0 where they do not.
pub fn meeting_height(distance: f64, a: f64, b: f64) -> f64 {
    let along = 0.5 * (distance + (a - b) * (a + b) / distance);
    ((a - along) * (a + along)).max(0.0).sqrt()
}

/// Equation (9), the smaller of the bounds of Lemmas 6.3 and 6.4: the circles of neighbouring boundary vertices meet at
/// least (1 − t) √((t² − 4t + 7)(1 − t²)) / 4 times the smaller radius above the boundary.
pub fn least_meeting_height(t: f64) -> f64 {
    (1.0 - t) * ((t * t - 4.0 * t + 7.0) * (1.0 - t * t)).max(0.0).sqrt() / 4.0
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
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn circles_meet_where_pythagoras_says() {
        assert!((meeting_height(6.0, 5.0, 5.0) - 4.0).abs() < 1e-15);
        assert!((meeting_height(21.0, 13.0, 20.0) - 12.0).abs() < 1e-14);
        assert_eq!(meeting_height(3.0, 1.0, 1.0), 0.0);
    }

    #[test]
    fn the_least_height_is_the_papers_by_hand() {
        assert!((least_meeting_height(0.0) - 7f64.sqrt() / 4.0).abs() < 1e-15);
        // ½ √((¼ − 2 + 7) ¾) / 4.
        assert!((least_meeting_height(0.5) - 63f64.sqrt() / 32.0).abs() < 1e-15);
        assert_eq!(least_meeting_height(1.0), 0.0);
    }

    /// Radius 0.01 + t·|x|: t-Lipschitz, graded over two powers of ten.
    fn disc_at(centre: DVec2, t: f64) -> Disc {
        Disc {
            centre,
            radius: 0.01 + t * centre.x.abs(),
        }
    }

    /// A disc as one at the origin sees it.
    fn seen(x: f64, y: f64, radius: f64) -> Near {
        let offset = DVec2::new(x, y);
        Near {
            id: 0,
            offset,
            distance_squared: offset.length_squared(),
            radius,
        }
    }

    #[test]
    fn circles_cross_on_both_circles_right_point_first() {
        for (radius, other) in [
            (1.0, seen(1.0, 0.0, 1.0)),
            (2.0, seen(0.0, 3.0, 2.5)),
            (5.0, seen(-3.0, 1.0, 2.2)),
            (0.25, seen(0.2, -0.3, 0.5)),
        ] {
            let [right, left] = circle_intersections(radius, &other);
            for point in [right, left] {
                assert!((point.length() - radius).abs() < 1e-14);
                assert!((point.distance(other.offset) - other.radius).abs() < 1e-14);
            }
            assert!(other.offset.perp_dot(right) < 0.0 && other.offset.perp_dot(left) > 0.0);
        }
        assert_eq!(circle_intersections(1.0, &seen(3.0, 0.0, 2.0)), [DVec2::X; 2]);
        assert_eq!(circle_intersections(1.0, &seen(0.0, 4.0, 2.0)), [1.625 * DVec2::Y; 2]);
    }

    #[test]
    fn a_level_is_the_binary_exponent() {
        for (radius, level) in [(1.0, 0), (1.99, 0), (2.0, 1), (0.75, -1), (1e-300, -997)] {
            assert_eq!(level_of(radius), level);
            assert_eq!(inverse_cell_size(level), 0.5f64.powi(level + 1));
        }
    }

    #[test]
    fn cells_are_half_open_and_eight_by_eight_make_a_block() {
        for (coordinate, cell) in [
            (0.0, 0),
            (0.49, 0),
            (0.5, 1),
            (3.75, 7),
            (-0.25, -1),
            (-0.5, -1),
            (-0.75, -2),
        ] {
            assert_eq!(cell_of(coordinate, 2.0), cell);
        }
        assert_eq!(
            [(0, 0), (7, 0), (0, 1), (8, 9), (-1, -1)].map(|(c, r)| cell_in_block(c, r)),
            [0, 7, 8, 8, 63]
        );
    }

    #[test]
    fn discs_are_open_and_counted() {
        let mut grid = DiscGrid::new(0.0);
        assert_eq!((grid.is_empty(), grid.len()), (true, 0));
        let discs = [0.0, 4.0].map(|x| Disc {
            centre: DVec2::new(x, 0.0),
            radius: 1.0,
        });
        assert_eq!(discs.map(|disc| grid.insert(disc)), [0, 1]);
        assert!(!grid.is_empty() && grid.len() == 2);
        assert_eq!(
            (grid.disc(1), grid.discs().collect::<Vec<_>>()),
            (discs[1], discs.to_vec())
        );
        let mut near = Vec::new();
        let mut covering = |x: f64, tolerance: f64| {
            grid.covering(DVec2::new(x, 0.0), 1.0, tolerance, &mut near);
            near.iter().map(|disc| disc.id).collect::<Vec<_>>()
        };
        assert_eq!(covering(1.0, 0.0), [0u32; 0]);
        assert_eq!(covering(0.95, 0.0), [0]);
        assert_eq!(covering(0.95, 0.1), [0u32; 0]);
        assert_eq!(covering(0.85, 0.1), [0]);
        assert_eq!(covering(1.05, 0.1), [0u32; 0]);
        grid.meeting(DVec2::new(2.0, 0.0), 1.0, &mut near);
        assert!(near.is_empty());
        grid.around(DVec2::new(2.0, 0.0), 1.0, 1.25, &mut near);
        assert_eq!(near.len(), 2);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn queries_find_what_a_loop_finds(
            centres in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 1..200),
            query in (-1.0..1.0f64, -1.0..1.0f64),
            t in 0.0..0.9f64,
            share in 0.0..3.0f64,
            scale in prop::sample::select(vec![1.0, 1024.0, 1.0 / 1024.0]),
        ) {
            let disc_at = |centre: DVec2, t| {
                let disc = disc_at(centre, t);
                Disc { centre: scale * disc.centre, radius: scale * disc.radius }
            };
            let discs: Vec<Disc> = centres.iter().map(|&c| disc_at(c.into(), t)).collect();
            let mut grid = DiscGrid::new(t);
            discs.iter().for_each(|&disc| { grid.insert(disc); });
            let query = disc_at(query.into(), t);
            let loop_over = |keep: &dyn Fn(&Disc) -> bool| -> Vec<u32> {
                (0..discs.len() as u32).filter(|&id| keep(&discs[id as usize])).collect()
            };
            let mut near = Vec::new();
            let sorted = |near: &[Near]| { let mut ids: Vec<u32> = near.iter().map(|n| n.id).collect(); ids.sort_unstable(); ids };
            grid.meeting(query.centre, query.radius, &mut near);
            prop_assert_eq!(sorted(&near), loop_over(&|d| d.centre.distance(query.centre) < d.radius + query.radius));
            grid.covering(query.centre, query.radius, 0.0, &mut near);
            prop_assert_eq!(sorted(&near), loop_over(&|d| d.centre.distance(query.centre) < d.radius));
            let reach = query.radius * share.min(0.9 / t);
            grid.around(query.centre, query.radius, reach, &mut near);
            prop_assert_eq!(sorted(&near), loop_over(&|d| d.centre.distance(query.centre) < d.radius + reach));
        }
    }
}
