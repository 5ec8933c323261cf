//! Step 3 in the leaves: the independent set among their samples, tile by tile.
//!
//! Two candidates are in conflict if the circle of the one chosen first covers the other. The set is built greedily, in
//! an [`Order`] within each tile. So it is independent and maximal: a candidate that is not chosen is covered by a
//! circle chosen before it. A sample is tested against the few circles that reach into its leaf, which are found once
//! per row of the leaf, and s is evaluated only for samples that are chosen.

use super::balance::{Leaf, Quadtree};
use super::circles::{Row, row, samples};
use super::independent_set::Order;
use super::tiles::Tile;
use super::{Field, QuadtreeMis};
use crate::geometry::near::{Disc, DiscGrid, Near};
use crate::geometry::{DVec2, tolerance};
use crate::meshers::MeshError;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

/// The circles that reach into a leaf, and those chosen there.
pub(super) struct Picker<'a, 'b> {
    pub field: &'b Field<'a>,
    tree: &'b Quadtree,
    circles: &'b mut DiscGrid,
    /// The number of vertices besides those in `circles`.
    elsewhere: usize,
    pub leaf: Leaf,
    /// A point of the leaf, from which offsets are measured.
    pub anchor: DVec2,
    /// The circles that reach into the leaf, relative to its anchor.
    pub near: Vec<Near>,
}

impl<'a, 'b> Picker<'a, 'b> {
    pub fn new(field: &'b Field<'a>, tree: &'b Quadtree, circles: &'b mut DiscGrid, elsewhere: usize) -> Self {
        Self {
            field,
            tree,
            circles,
            elsewhere,
            leaf: tree.leaves[0],
            anchor: DVec2::ZERO,
            near: Vec::new(),
        }
    }

    /// Turns to a leaf.
    pub fn turn_to(&mut self, leaf: u32) {
        self.leaf = self.tree.leaves[leaf as usize];
        self.anchor = self.tree.anchor(&self.leaf);
        let reach = self.tree.reach(&self.leaf);
        self.circles
            .around(self.anchor, self.leaf.radius, reach, &mut self.near);
    }

    /// Whether one circle covers the box with that centre and half width and height.
    pub fn is_box_covered(&self, centre: DVec2, half: DVec2) -> bool {
        let centre = centre - self.anchor;
        self.near.iter().any(|near| {
            let shrunk = near.radius * (1.0 - tolerance::COVERED);
            ((near.offset - centre).abs() + half).length_squared() < shrunk * shrunk
        })
    }

    /// Whether one circle covers the leaf.
    pub fn is_leaf_covered(&self) -> bool {
        self.is_box_covered(self.leaf.centre, DVec2::splat(self.leaf.half))
    }

    /// Whether a point of the leaf, relative to its anchor, lies in the domain and no circle covers it. The circles
    /// with the two ids `but` do not count.
    fn is_free(&self, x: DVec2, but: [u32; 2]) -> bool {
        let covers = |near: &Near| {
            let shrunk = near.radius * (1.0 - tolerance::COVERED);
            near.offset.distance_squared(x) < shrunk * shrunk && !but.contains(&near.id)
        };
        !self.near.iter().any(covers) && (self.leaf.is_inside() || self.field.domain.contains(self.anchor + x))
    }

    /// Collects the circles that pass through the square.
    pub fn circles_through(&self, centre: DVec2, half: f64, found: &mut Vec<Near>) {
        let centre = centre - self.anchor;
        found.clear();
        found.extend(self.near.iter().filter(|near| {
            let offset = (near.offset - centre).abs();
            let (nearest, farthest) = ((offset - half).max(DVec2::ZERO).length(), (offset + half).length());
            nearest <= near.radius && near.radius <= farthest
        }));
    }

    /// Chooses the point of the leaf if it lies in the domain and no circle covers it. Returns whether it was chosen.
    pub fn pick(&mut self, x: DVec2) -> Result<bool, MeshError> {
        self.pick_at(x - self.anchor, [NO_CIRCLE; 2])
    }

    /// [`Self::pick`] of a point relative to the leaf's anchor; two circles do not count.
    pub fn pick_at(&mut self, offset: DVec2, but: [u32; 2]) -> Result<bool, MeshError> {
        if !self.is_free(offset, but) {
            return Ok(false);
        }
        let x = self.anchor + offset;
        let radius = self.field.sizing.at(x)?;
        self.field
            .monitor
            .placed(self.elsewhere + self.circles.len() + 1, x, radius)?;
        let id = self.circles.insert(Disc { centre: x, radius });
        let offset = x - self.anchor;
        self.near.push(Near {
            id,
            offset,
            distance_squared: offset.length_squared(),
            radius,
        });
        Ok(true)
    }
}

/// No circle has this id.
const NO_CIRCLE: u32 = u32::MAX;

/// Chooses a maximal independent set of the samples of a tile, and adds it to the circles that reach into the tile.
/// Returns how many samples were examined.
pub(super) fn interior(
    field: &Field,
    tree: &Quadtree,
    number: usize,
    tile: &Tile,
    circles: &mut DiscGrid,
    elsewhere: usize,
) -> Result<usize, MeshError> {
    let first = tree.leaves[tile.leaves[0] as usize];
    field
        .monitor
        .look(elsewhere + circles.len(), first.centre, first.radius)?;
    let stream = field.seed.wrapping_add((number as u64 + 1).wrapping_mul(STREAM));
    let mut random = Pcg64::seed_from_u64(stream);
    let leaf = |number: usize| &tree.leaves[tile.leaves[number] as usize];
    let numbers: Vec<usize> = (0..tile.leaves.len()).collect();
    let rows = match field.mesher.order {
        Order::Insertion => from_below(field.mesher, numbers, leaf),
        Order::Spacing => {
            let mut numbers = numbers;
            numbers.sort_by(|&one, &other| leaf(one).radius.total_cmp(&leaf(other).radius));
            leaf_by_leaf(field.mesher, &numbers, leaf)
        }
        Order::Degree | Order::Random => leaf_by_leaf(field.mesher, &numbers, leaf),
    };
    let mut walk = Walk {
        picker: Picker::new(field, tree, circles, elsewhere),
        leaves: &tile.leaves,
        is_done: vec![false; tile.leaves.len()],
    };
    if matches!(field.mesher.order, Order::Insertion | Order::Spacing) {
        return walk.row_by_row(&rows, &mut random);
    }
    let mut free = walk.uncovered(&rows, &mut random);
    if field.mesher.order == Order::Random {
        free.shuffle(&mut random);
    } else {
        let mut ranked: Vec<(u32, Sample)> = degrees(field, &free)?.into_iter().zip(free).collect();
        ranked.sort_by_key(|(degree, _)| *degree);
        free = ranked.into_iter().map(|(_, sample)| sample).collect();
    }
    walk.one_by_one(&free)
}

/// The rows of leaves, one leaf after the other.
fn leaf_by_leaf<'a>(mesher: &QuadtreeMis, leaves: &[usize], place: impl Fn(usize) -> &'a Leaf) -> Vec<Row> {
    let rows = |&leaf: &usize| (0..mesher.oversample).map(move |number| (leaf, number));
    let rows = leaves.iter().flat_map(rows);
    rows.map(|(leaf, number)| row(mesher, leaf, place(leaf), number))
        .collect()
}

/// The rows of leaves from below, and from left to right.
fn from_below<'a>(mesher: &QuadtreeMis, mut leaves: Vec<usize>, place: impl Fn(usize) -> &'a Leaf) -> Vec<Row> {
    let band = |leaf: usize| (place(leaf).rect().min.y, place(leaf).half);
    leaves.sort_by(|&one, &other| {
        let ([y, other_y], [x, other_x]) = ([one, other].map(band), [one, other].map(|leaf| place(leaf).centre.x));
        y.0.total_cmp(&other_y.0)
            .then(y.1.total_cmp(&other_y.1))
            .then(x.total_cmp(&other_x))
    });
    // The rows of leaves of one size that lie side by side are in order already, which makes the sort fast.
    let mut rows = Vec::with_capacity(leaves.len() * mesher.oversample as usize);
    for band in leaves.chunk_by(|&one, &other| band(one) == band(other)) {
        for number in 0..mesher.oversample {
            rows.extend(band.iter().map(|&leaf| row(mesher, leaf, place(leaf), number)));
        }
    }
    rows.sort_by(|one, other| {
        let (one, other) = (one.centre, other.centre);
        one.y.total_cmp(&other.y).then(one.x.total_cmp(&other.x))
    });
    rows
}

/// Makes the random numbers of tiles differ.
const STREAM: u64 = 0x9e37_79b9_7f4a_7c15;

/// A sample that no circle covers yet.
#[derive(Clone, Copy, Debug)]
struct Sample {
    /// The number of its leaf in the tile.
    leaf: usize,
    x: DVec2,
    /// Whether degrees count it.
    counts: bool,
}

/// Most samples per side of a leaf that degrees count: enough to distinguish a crowded place from a free one, with work
/// that does not grow with the fourth power of the oversampling.
const COUNTED: u32 = 4;

/// A walk over the samples of a tile.
struct Walk<'a, 'b, 'c> {
    picker: Picker<'a, 'b>,
    leaves: &'c [u32],
    /// Which leaves are known to be covered by one circle each.
    is_done: Vec<bool>,
}

impl Walk<'_, '_, '_> {
    /// Turns to a leaf, unless it is known to be covered.
    fn turn_to(&mut self, leaf: usize) -> bool {
        if !self.is_done[leaf] {
            self.picker.turn_to(self.leaves[leaf]);
            self.is_done[leaf] = self.picker.is_leaf_covered();
        }
        !self.is_done[leaf]
    }

    /// Examines samples row by row. A row is skipped, without a search for the circles around its leaf, if one circle
    /// of the last search covers it. This is so for most rows.
    fn row_by_row(&mut self, rows: &[Row], random: &mut Pcg64) -> Result<usize, MeshError> {
        let (picker, mut looked_at) = (&mut self.picker, 0);
        let mut next_row = vec![0; self.leaves.len()];
        for row in rows {
            if row.number < next_row[row.leaf] {
                continue;
            }
            picker.turn_to(self.leaves[row.leaf]);
            if !picker.is_box_covered(row.centre, row.half) {
                for x in samples(picker.field.mesher, row, random) {
                    looked_at += 1;
                    picker.pick(x)?;
                }
            }
            let above = (1..).map(|step| row.centre + DVec2::new(0.0, f64::from(2 * step) * row.half.y));
            let left = picker.field.mesher.oversample - row.number;
            let covered = above
                .take(left as usize)
                .take_while(|&centre| picker.is_box_covered(centre, row.half));
            next_row[row.leaf] = row.number + 1 + covered.count() as u32;
        }
        Ok(looked_at)
    }

    fn one_by_one(&mut self, samples: &[Sample]) -> Result<usize, MeshError> {
        let mut looked_at = 0;
        for sample in samples {
            if self.turn_to(sample.leaf) {
                looked_at += 1;
                self.picker.pick(sample.x)?;
            }
        }
        Ok(looked_at)
    }

    /// The samples that lie in the domain and that no circle covers yet.
    fn uncovered(&mut self, rows: &[Row], random: &mut Pcg64) -> Vec<Sample> {
        let mut free = Vec::new();
        let apart = self.picker.field.mesher.oversample.div_ceil(COUNTED);
        for row in rows {
            if !self.turn_to(row.leaf) {
                continue;
            }
            let picker = &self.picker;
            for (x, column) in samples(picker.field.mesher, row, random).zip(0u32..) {
                if picker.is_free(x - picker.anchor, [NO_CIRCLE; 2]) {
                    let counts = row.number.is_multiple_of(apart) && column.is_multiple_of(apart);
                    free.push(Sample {
                        leaf: row.leaf,
                        x,
                        counts,
                    });
                }
            }
        }
        free
    }
}

/// For each sample, the number of samples whose circles cover it, of those that count.
fn degrees(field: &Field, samples: &[Sample]) -> Result<Vec<u32>, MeshError> {
    let mut circles = DiscGrid::new(field.sizing.t());
    for sample in samples.iter().filter(|sample| sample.counts) {
        let radius = field.sizing.at(sample.x)?;
        circles.insert(Disc {
            centre: sample.x,
            radius,
        });
    }
    let mut near = Vec::new();
    let degree = |sample: &Sample| {
        circles.covering(sample.x, field.sizing.at(sample.x)?, 0.0, &mut near);
        Ok(near.len() as u32)
    };
    samples.iter().map(degree).collect()
}
