//! Goes on sampling where gaps remain, until none is left.
//!
//! # Idea
//! A cell that one circle covers, or that does not meet the domain, is done. Of any other cell, the centre is chosen if
//! no circle covers it; the quarters of the cell are then treated likewise, [`HALVINGS`] times. Most of the cells that
//! are left then are covered by several circles together. An uncovered region among them is bounded by arcs, since all
//! segments are covered. Its outer boundary has corners where two circles cross, because one circle alone can only
//! bound it from within. So it is enough to examine the crossings of circles in the cells that are left. If every
//! crossing is covered, there is no gap; an uncovered crossing is chosen.
//!
//! # Termination
//! No point is chosen within a circle chosen before, so the packing circles are disjoint, and the domain has room for
//! finitely many of them.

use super::Field;
use super::balance::Quadtree;
use super::interior::Picker;
use super::tiles::{Tile, Tiles};
use crate::geometry::near::{DiscGrid, Near, circle_intersections};
use crate::geometry::{DVec2, Rect};
use crate::meshers::MeshError;

/// How often a leaf is halved before crossings of circles are examined: samples are then 1/32 of a leaf apart.
const HALVINGS: u32 = 5;

/// Cells are extended on all sides by this share of their half side, so that a crossing on a common side is in one of
/// them.
const SLACK: f64 = 1e-6;

/// A part of a leaf that may not be covered.
#[derive(Clone, Copy, Debug)]
struct Speck {
    leaf: u32,
    centre: DVec2,
    half: f64,
}

/// Chooses circles until the domain is covered.
pub(super) fn complete(field: &Field, tree: &Quadtree, tiles: &mut Tiles) -> Result<(), MeshError> {
    let specks = tiles.sweep(|_, tile, circles, elsewhere| refine(field, tree, tile, circles, elsewhere))?;
    let mut before = usize::MAX;
    while tiles.chosen() != before {
        before = tiles.chosen();
        tiles.sweep(|number, _, circles, elsewhere| settle(field, tree, &specks[number], circles, elsewhere))?;
    }
    Ok(())
}

/// Chooses the centres of uncovered cells, and returns the smallest cells that no one circle covers.
fn refine(
    field: &Field,
    tree: &Quadtree,
    tile: &Tile,
    circles: &mut DiscGrid,
    elsewhere: usize,
) -> Result<Vec<Speck>, MeshError> {
    let mut left = Vec::new();
    let (mut cells, mut quarters) = (Vec::new(), Vec::new());
    let mut picker = Picker::new(field, tree, circles, elsewhere);
    for &leaf in &tile.leaves {
        picker.turn_to(leaf);
        let (centre, half) = (picker.leaf.centre, picker.leaf.half);
        cells.clear();
        cells.push(Speck { leaf, centre, half });
        for _ in 0..=HALVINGS {
            quarters.clear();
            for cell in &cells {
                if picker.is_box_covered(cell.centre, DVec2::splat(cell.half)) || !meets_domain(field, &picker, cell) {
                    continue;
                }
                picker.pick(cell.centre)?;
                quarters.extend(cell.quarters());
            }
            std::mem::swap(&mut cells, &mut quarters);
        }
        left.extend(cells.iter().filter(|cell| {
            !picker.is_box_covered(cell.centre, DVec2::splat(cell.half)) && meets_domain(field, &picker, cell)
        }));
    }
    Ok(left)
}

impl Speck {
    fn rect(&self) -> Rect {
        Rect {
            min: self.centre - self.half,
            max: self.centre + self.half,
        }
    }

    fn quarters(&self) -> [Self; 4] {
        let half = 0.5 * self.half;
        self.rect().quarters().map(|rect| Self {
            leaf: self.leaf,
            centre: rect.centre(),
            half,
        })
    }
}

fn meets_domain(field: &Field, picker: &Picker, cell: &Speck) -> bool {
    if picker.leaf.is_inside() || field.domain.contains(cell.centre) {
        return true;
    }
    let mut is_met = false;
    field.domain.index().in_box(cell.rect(), |_| is_met = true);
    is_met
}

/// Chooses the uncovered crossings of circles in the cells, one after the other, until no cell has any.
fn settle(
    field: &Field,
    tree: &Quadtree,
    specks: &[Speck],
    circles: &mut DiscGrid,
    elsewhere: usize,
) -> Result<(), MeshError> {
    let mut picker = Picker::new(field, tree, circles, elsewhere);
    let mut turned_to = None;
    let mut meeting = Vec::new();
    for speck in specks {
        if turned_to != Some(speck.leaf) {
            picker.turn_to(speck.leaf);
            turned_to = Some(speck.leaf);
        }
        while {
            picker.circles_through(speck.centre, speck.half * (1.0 + SLACK), &mut meeting);
            pick_crossing(&mut picker, &meeting, speck)?
        } {}
    }
    Ok(())
}

/// Chooses the first crossing of two of the circles in the cell that no other circle covers. Returns whether there was
/// one.
fn pick_crossing(picker: &mut Picker, circles: &[Near], speck: &Speck) -> Result<bool, MeshError> {
    for (index, one) in circles.iter().enumerate() {
        for other in &circles[index + 1..] {
            let offset = other.offset - one.offset;
            let other = Near {
                offset,
                distance_squared: offset.length_squared(),
                ..*other
            };
            for relative in circle_intersections(one.radius, &other) {
                let crossing = one.offset + relative;
                let away = (picker.anchor + crossing - speck.centre).abs().max_element();
                // The crossing lies on these two, so rounding decides on which side.
                if away <= speck.half * (1.0 + SLACK) && picker.pick_at(crossing, [one.id, other.id])? {
                    return Ok(true);
                }
            }
        }
    }
    Ok(false)
}
