//! Step 3: a maximal independent set of the candidates, on vertices, then edges, then the interior.

use super::Field;
use super::balance::Quadtree;
use super::circles::OnSegment;
use super::complete::complete;
use super::edges::Boundary;
use super::interior::interior;
use super::tiles::Tiles;
use crate::geometry::DVec2;
use crate::mesh::Piece;
use crate::meshers::{MeshError, Trace};
use serde::{Deserialize, Serialize};

/// The order in which candidates are considered, along the segments and within each tile of leaves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// Along a segment, its even division first, then from end to end; in a tile, row by row from below. Where spacing
    /// is even, a row settles into the hollows of the row before, which makes the packing denser than any other order
    /// does.
    #[default]
    Insertion,
    /// First the candidates that the fewest other candidates would cover.
    Degree,
    /// First the candidates where the spacing is smallest.
    Spacing,
    /// In random order, by seed.
    Random,
}

impl Order {
    /// All orders, in the order of the docs.
    pub const ALL: [Self; 4] = [Self::Insertion, Self::Degree, Self::Spacing, Self::Random];
}

/// The independent set.
#[derive(Clone, Debug, PartialEq)]
pub struct Packing {
    /// Centres of the circles chosen: input vertices, boundary, interior.
    pub centres: Vec<DVec2>,
    /// Chains of centres along the input segments.
    pub pieces: Vec<Piece>,
    /// Counts of the run, by name.
    counts: [(&'static str, usize); 6],
}

impl Packing {
    /// Notes the counts in the trace.
    pub(super) fn note(&self, trace: &mut Trace) {
        for (name, count) in self.counts {
            trace.count(name, count as f64);
        }
    }
}

/// Chooses circles, one after the other, whose centres no circle chosen before covers.
pub(super) fn independent_set(
    field: &Field,
    tree: &Quadtree,
    on_segments: Vec<OnSegment>,
) -> Result<Packing, MeshError> {
    let mut candidates = on_segments.len();
    let mut boundary = Boundary::vertices(field)?;
    boundary.edges(on_segments)?;
    let closing = boundary.close_gaps()?;
    let mut tiles = Tiles::new(tree, field, &boundary.circles);
    let looked_at =
        tiles.sweep(|number, tile, circles, elsewhere| interior(field, tree, number, tile, circles, elsewhere))?;
    candidates += looked_at.into_iter().sum::<usize>();
    let sampled = tiles.chosen();
    if field.mesher.complete {
        complete(field, tree, &mut tiles)?;
    }
    let completing = tiles.chosen() - sampled;
    let (pieces, rounds) = (boundary.pieces(), tiles.worked);
    let interior = tiles.tiles.into_iter().flat_map(|tile| tile.chosen);
    let centres: Vec<DVec2> = boundary
        .circles
        .discs()
        .chain(interior)
        .map(|disc| disc.centre)
        .collect();
    Ok(Packing {
        counts: [
            ("leaves", tree.leaves.len()),
            ("candidates", candidates),
            ("chosen", centres.len()),
            ("closing", closing),
            ("completing", completing),
            ("rounds", rounds),
        ],
        centres,
        pieces,
    })
}
