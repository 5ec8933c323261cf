//! Tiles of leaves that can be processed at the same time: the rounds of the independent set.
//!
//! # Idea
//! A tile is a cell of the quadtree with all its leaves. Choosing circles in one tile cannot disturb another that is
//! farther away than any circle of either reaches. So tiles are coloured so that those of one colour are that far
//! apart, and all tiles of a colour make a round. Rounds follow one another. The tiles of a round are shared among
//! threads; since none sees what the others choose, the result does not depend on how they are shared.
//!
//! # Cost
//! Each tile copies the circles of its neighbours that reach into it. Relative to its own circles, these become fewer
//! with its size.

use super::Field;
use super::balance::{Node, Quadtree};
use crate::geometry::Rect;
use crate::geometry::near::{Disc, DiscGrid};
use crate::meshers::MeshError;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// Most leaves of a tile that has more than one: few enough that 10⁵ triangles make many tiles, and enough that copying
/// the neighbours' circles costs little.
const MOST_LEAVES: usize = 4096;

/// A cell of the quadtree with its leaves.
#[derive(Debug)]
pub(super) struct Tile {
    pub cell: Rect,
    /// Its leaves, in the order of the quadtree.
    pub leaves: Vec<u32>,
    /// No circle centred in the tile has a larger radius.
    largest: f64,
    /// Tiles whose circles may reach into this one, or this one's into them.
    neighbours: Vec<u32>,
    /// Circles on the input boundary that reach into it.
    boundary: Vec<Disc>,
    /// Circles chosen in it.
    pub chosen: Vec<Disc>,
}

/// All tiles, and which of them make a round.
#[derive(Debug)]
pub(super) struct Tiles {
    pub tiles: Vec<Tile>,
    rounds: Vec<Vec<usize>>,
    t: f64,
    /// How many circles are on the input boundary.
    boundary: usize,
    /// None if there is one thread.
    pool: Option<rayon::ThreadPool>,
    /// Rounds worked on so far.
    pub worked: usize,
}

impl Tiles {
    /// Cuts the quadtree into tiles, and files the circles on the input boundary under the tiles into which they reach.
    pub fn new(tree: &Quadtree, field: &Field, boundary: &DiscGrid) -> Self {
        let (t, threads) = (field.sizing.t(), field.threads);
        let mut cutter = Cutter {
            tree,
            t,
            tiles: Vec::new(),
            waiting: Vec::new(),
            tile_at: FxHashMap::default(),
        };
        if cutter.group(0, tree.root) {
            let all = std::mem::take(&mut cutter.waiting);
            cutter.close(0, tree.root, all);
        }
        cutter.join_neighbours();
        for disc in boundary.discs() {
            for tile in cutter.tiles_where(|rect| rect.distance(disc.centre) < disc.radius) {
                cutter.tiles[tile].boundary.push(disc);
            }
        }
        let tiles = cutter.tiles;
        Self {
            rounds: rounds(&tiles),
            tiles,
            t,
            boundary: boundary.len(),
            // Without a pool, one thread does all the work.
            pool: rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .ok()
                .filter(|_| threads > 1),
            worked: 0,
        }
    }

    /// Does `work` on every tile, round by round. `work` gets the tile, all circles that reach into it, and the number
    /// of circles that do not; to the circles it adds those that it chooses. What it returns is returned tile by tile.
    pub fn sweep<T: Send>(
        &mut self,
        work: impl Fn(usize, &Tile, &mut DiscGrid, usize) -> Result<T, MeshError> + Sync,
    ) -> Result<Vec<T>, MeshError> {
        let mut found: Vec<Option<T>> = self.tiles.iter().map(|_| None).collect();
        for round in &self.rounds {
            let placed = self.boundary + self.chosen();
            let one = |&number: &usize| {
                let tile = &self.tiles[number];
                let mut circles = self.reaching(tile);
                let known = circles.len();
                let found = work(number, tile, &mut circles, placed - known)?;
                Ok((circles.discs().skip(known).collect(), found))
            };
            let results: Vec<Result<(Vec<Disc>, T), MeshError>> = match &self.pool {
                Some(pool) => pool.install(|| round.par_iter().map(one).collect()),
                None => round.iter().map(one).collect(),
            };
            for (&number, result) in round.iter().zip(results) {
                let (chosen, what) = result?;
                self.tiles[number].chosen.extend(chosen);
                found[number] = Some(what);
            }
        }
        self.worked += self.rounds.len();
        Ok(found.into_iter().flatten().collect())
    }

    /// The circles that reach into a tile, its own among them.
    fn reaching(&self, tile: &Tile) -> DiscGrid {
        let mut circles = DiscGrid::new(self.t);
        let around = tile
            .neighbours
            .iter()
            .flat_map(|&other| &self.tiles[other as usize].chosen);
        let reaching = around.filter(|disc| tile.cell.distance(disc.centre) < disc.radius);
        for disc in tile.boundary.iter().chain(reaching).chain(&tile.chosen) {
            circles.insert(*disc);
        }
        circles
    }

    /// How many circles have been chosen in all tiles.
    pub fn chosen(&self) -> usize {
        self.tiles.iter().map(|tile| tile.chosen.len()).sum()
    }
}

/// Tiles in the making.
struct Cutter<'a> {
    tree: &'a Quadtree,
    t: f64,
    tiles: Vec<Tile>,
    /// Leaves that are in no tile yet.
    waiting: Vec<u32>,
    /// The tile of each node that has one.
    tile_at: FxHashMap<u32, usize>,
}

impl Cutter<'_> {
    /// If the leaves below `node` are few enough for one tile, notes them as waiting and returns true; else makes tiles
    /// of its quarters.
    fn group(&mut self, node: u32, cell: Rect) -> bool {
        let first = match self.tree.nodes[node as usize] {
            Node::Outside => return true,
            Node::Leaf(leaf) => {
                self.waiting.push(leaf);
                return true;
            }
            Node::Inner(first) => first,
        };
        let start = self.waiting.len();
        let (quarters, mut all_wait) = (cell.quarters(), true);
        let groups = [0, 1, 2, 3].map(|k| {
            let (from, quarter) = (self.waiting.len(), quarters[k as usize]);
            all_wait &= self.group(first + k, quarter);
            (first + k, quarter, from..self.waiting.len())
        });
        if all_wait && self.waiting.len() - start <= MOST_LEAVES {
            return true;
        }
        for (child, quarter, range) in groups {
            let leaves = self.waiting[range].to_vec();
            self.close(child, quarter, leaves);
        }
        self.waiting.truncate(start);
        false
    }

    /// Makes a tile of leaves, if there are any.
    fn close(&mut self, node: u32, cell: Rect, leaves: Vec<u32>) {
        if leaves.is_empty() {
            return;
        }
        let largest = leaves.iter().map(|&leaf| {
            let leaf = &self.tree.leaves[leaf as usize];
            leaf.radius + self.t * self.tree.reach(leaf)
        });
        self.tile_at.insert(node, self.tiles.len());
        self.tiles.push(Tile {
            cell,
            largest: largest.fold(0.0, f64::max),
            leaves,
            neighbours: Vec::new(),
            boundary: Vec::new(),
            chosen: Vec::new(),
        });
    }

    fn join_neighbours(&mut self) {
        for tile in 0..self.tiles.len() {
            let (cell, largest) = (self.tiles[tile].cell, self.tiles[tile].largest);
            for other in self.tiles_where(|rect| gap(rect, cell) < largest) {
                if other != tile {
                    self.tiles[tile].neighbours.push(other as u32);
                    self.tiles[other].neighbours.push(tile as u32);
                }
            }
        }
        for tile in &mut self.tiles {
            tile.neighbours.sort_unstable();
            tile.neighbours.dedup();
        }
    }

    /// The tiles whose cell and all larger ones around it `wanted` accepts.
    fn tiles_where(&self, wanted: impl Fn(Rect) -> bool) -> Vec<usize> {
        let mut found = Vec::new();
        let mut stack = vec![(0u32, self.tree.root)];
        while let Some((node, rect)) = stack.pop() {
            if !wanted(rect) {
                continue;
            }
            if let Some(&tile) = self.tile_at.get(&node) {
                found.push(tile);
            } else if let Node::Inner(first) = self.tree.nodes[node as usize] {
                stack.extend((first..first + 4).zip(rect.quarters()));
            }
        }
        found
    }
}

/// Distance between two boxes.
fn gap(one: Rect, other: Rect) -> f64 {
    (one.min - other.max)
        .max(other.min - one.max)
        .max(crate::geometry::DVec2::ZERO)
        .length()
}

/// Tiles by colour: each tile gets the first colour that no neighbour before it has.
fn rounds(tiles: &[Tile]) -> Vec<Vec<usize>> {
    let mut colours: Vec<usize> = Vec::with_capacity(tiles.len());
    let mut rounds: Vec<Vec<usize>> = Vec::new();
    for (number, tile) in tiles.iter().enumerate() {
        let taken = |colour: &usize| {
            tile.neighbours
                .iter()
                .any(|&other| colours.get(other as usize) == Some(colour))
        };
        let colour = (0..).find(|colour| !taken(colour)).unwrap_or_default();
        if colour == rounds.len() {
            rounds.push(Vec::new());
        }
        rounds[colour].push(number);
        colours.push(colour);
    }
    rounds
}
