//! Cuts segments where they cross, by i_overlay on an integer grid.
//!
//! i_overlay reports every cut through [`OverlayEdgeData`]: each piece gets a number, and the numbers form a forest whose
//! roots are the segments that went in and whose leaves are the pieces that came out.

use super::{Piece, RepairReport, Work};
use crate::geometry::segments::closest_on_segment;
use crate::geometry::tolerance::REPAIR_GRID;
use crate::geometry::{DVec2, Rect};
use i_overlay::core::edge_data::{EdgeDataMerge, EdgeDataSplit, OverlayEdgeData};
use i_overlay::core::edge_overlay::{EdgeOverlay, InputEdge};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::ShapeType;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::number::int::IntNumber;
use i_overlay::i_float::int::point::IntPoint;
use std::collections::HashMap;

type GridPoint = [i64; 2];

/// Cuts the segments in `crossing` where they cross each other. With `move_all` every vertex moves to the grid, so that
/// what i_overlay promises for grid points holds for the result; otherwise vertices stay where they are.
pub(super) fn split(work: &mut Work, crossing: &[usize], move_all: bool, report: &mut RepairReport) {
    let grid = Grid::new(&work.vertices);
    let mut takes_part = vec![move_all; work.vertices.len()];
    for &s in crossing {
        takes_part[work.segments[s].a] = true;
        takes_part[work.segments[s].b] = true;
    }
    let merged = snap(work, &grid, &takes_part, move_all, report);
    let mut at_grid: HashMap<GridPoint, usize> = HashMap::new();
    for v in (0..work.vertices.len()).filter(|&v| takes_part[v]) {
        at_grid.entry(grid.round(work.vertices[v])).or_insert(v);
    }
    let forest = cut(work, crossing, &grid);
    let mut roots = crossing.iter().copied().enumerate().peekable();
    let mut pieces = Vec::with_capacity(work.segments.len() + crossing.len());
    for s in 0..work.segments.len() {
        let piece = work.segments[s];
        let Some((root, _)) = roots.next_if(|&(_, segment)| segment == s) else {
            pieces.push(piece);
            continue;
        };
        let ends = work.ends(s);
        for part in forest.leaves(root) {
            let [a, b] = part.map(|point| {
                *at_grid.entry(point).or_insert_with(|| {
                    report.crossings += 1;
                    work.vertices.push(grid.place(point));
                    work.markers.push(0);
                    work.vertices.len() - 1
                })
            });
            for v in [a, b] {
                let off = closest_on_segment(ends, work.vertices[v]).distance(work.vertices[v]);
                report.largest_displacement = report.largest_displacement.max(off);
            }
            let backward = (work.vertices[b] - work.vertices[a]).dot(ends[1] - ends[0]) < 0.0;
            let (a, b) = if backward { (b, a) } else { (a, b) };
            pieces.push(Piece { a, b, ..piece });
        }
    }
    work.segments = pieces;
    let mut into = merged;
    into.extend(into.len()..work.vertices.len());
    report.merged_vertices += work.merge(&into);
}

/// Finds the vertices that share a grid point, for merging, and moves vertices to the grid if asked to.
fn snap(work: &mut Work, grid: &Grid, takes_part: &[bool], move_all: bool, report: &mut RepairReport) -> Vec<usize> {
    let mut first_at: HashMap<GridPoint, usize> = HashMap::new();
    let mut into: Vec<usize> = (0..work.vertices.len()).collect();
    for v in (0..work.vertices.len()).filter(|&v| takes_part[v]) {
        let point = grid.round(work.vertices[v]);
        let first = *first_at.entry(point).or_insert(v);
        let goal = if move_all {
            grid.place(point)
        } else {
            work.vertices[first]
        };
        let distance = work.vertices[v].distance(goal);
        report.largest_displacement = report.largest_displacement.max(distance);
        report.moved_vertices += usize::from(distance > 0.0);
        into[v] = first;
        if move_all {
            work.vertices[v] = goal;
        }
    }
    into
}

/// Lets i_overlay cut the segments.
fn cut(work: &Work, crossing: &[usize], grid: &Grid) -> Forest {
    let mut overlay: EdgeOverlay<i64, Number> = EdgeOverlay::new(crossing.len());
    for &s in crossing {
        let mut ends = work.ends(s).map(|p| grid.round(p));
        // All in one direction, so that the windings of pieces that coincide add up and never cancel.
        ends.sort_unstable();
        let root = overlay.data_store().nodes.len();
        overlay.data_store_mut().nodes.push(Node {
            ends,
            ..Node::default()
        });
        let [a, b] = ends.map(|[x, y]| IntPoint::new(x, y));
        overlay.add_edge(
            InputEdge {
                a,
                b,
                data: Number(root),
            },
            ShapeType::Subject,
        );
    }
    // The fill rule does not matter: by then the forest contains the cuts.
    overlay.build_vectors(OverlayRule::Subject, FillRule::EvenOdd);
    overlay.into_data_store()
}

/// A grid of a power of two on which integers convert to coordinates and back without rounding.
struct Grid {
    origin: DVec2,
    step: f64,
}

impl Grid {
    fn new(vertices: &[DVec2]) -> Self {
        let bounds = Rect::around(vertices.iter().copied());
        let extent = bounds.size().max_element();
        let magnitude = bounds.min.abs().max(bounds.max.abs()).max_element();
        // Not finer than the coordinates themselves, far from the origin.
        let step = power_of_two(extent * REPAIR_GRID).max(power_of_two(magnitude) * f64::EPSILON);
        let origin = (bounds.centre() / step).round() * step;
        Self { origin, step }
    }

    fn round(&self, p: DVec2) -> GridPoint {
        let at = ((p - self.origin) / self.step).round();
        [at.x as i64, at.y as i64]
    }

    fn place(&self, point: GridPoint) -> DVec2 {
        self.origin + DVec2::new(point[0] as f64, point[1] as f64) * self.step
    }
}

/// The smallest power of two that is at least `x`.
fn power_of_two(x: f64) -> f64 {
    x.log2().ceil().exp2()
}

/// Number of a piece: its node in the [`Forest`].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Number(usize);

#[derive(Clone, Copy, Debug, Default)]
struct Node {
    ends: [GridPoint; 2],
    /// The two pieces it was cut into.
    parts: Option<[usize; 2]>,
    /// The piece it was merged with.
    merged: Option<usize>,
}

/// Every piece that was ever made.
#[derive(Debug, Default)]
struct Forest {
    nodes: Vec<Node>,
}

impl Forest {
    fn add(&mut self, a: GridPoint, b: GridPoint) -> usize {
        self.nodes.push(Node {
            ends: [a, b],
            ..Node::default()
        });
        self.nodes.len() - 1
    }

    /// The ends of the final pieces of segment `root`, in order along it.
    fn leaves(&self, root: usize) -> Vec<[GridPoint; 2]> {
        let mut found = Vec::new();
        let mut todo = vec![root];
        while let Some(number) = todo.pop() {
            let node = &self.nodes[number];
            if let Some(merged) = node.merged {
                todo.push(merged);
            } else if let Some([first, second]) = node.parts {
                todo.extend([second, first]);
            } else {
                found.push(node.ends);
            }
        }
        found
    }
}

impl OverlayEdgeData for Number {
    type Store = Forest;

    fn split<I: IntNumber>(self, cut: EdgeDataSplit<I>, forest: &mut Forest) -> (Self, Self) {
        // Exact: grid points have fewer bits than an f64.
        let [a, p, b] = [cut.a, cut.p, cut.b].map(|point| [point.x.to_f64() as i64, point.y.to_f64() as i64]);
        let parts = [forest.add(a, p), forest.add(p, b)];
        forest.nodes[self.0].parts = Some(parts);
        (Self(parts[0]), Self(parts[1]))
    }

    fn merge(pair: EdgeDataMerge<i_overlay::segm::boolean::ShapeCountBoolean, Self>, forest: &mut Forest) -> Self {
        let [a, b] = forest.nodes[pair.lhs_data.0].ends;
        let merged = forest.add(a, b);
        forest.nodes[pair.lhs_data.0].merged = Some(merged);
        forest.nodes[pair.rhs_data.0].merged = Some(merged);
        Self(merged)
    }
}
