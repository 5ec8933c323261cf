//! What a disc reaches inside the domain: the part of it that can be walked to from its centre without leaving the disc or the
//! domain.
//!
//! # Idea
//! The domain's own triangulation, from its vertices and segments alone, is searched from the triangles that hold the centre
//! x. A disc meets a triangle in a convex set, so the disc B(x, r) reaches all of a triangle that it meets, or nothing. If it
//! reaches a triangle, it reaches the one across an edge if and only if the edge is not on the boundary and has a point in
//! the disc. Where the domain touches itself at a vertex, it also reaches the triangles there if the vertex is in the disc.
//! Triangles are taken in the order of their least radius (the largest distance of an edge to cross, on the best way), so the
//! radii at which vertices and segments are reached come out in order.
//!
//! # Cost
//! About log n to find the triangle that holds the centre, and one step for each triangle of the domain's triangulation that is met.

use super::{TriangulationError, triangulate};
use crate::domain::Domain;
use crate::geometry::boxes::BoxTree;
use crate::geometry::predicates::triangle_holds;
use crate::geometry::segments::{SegmentIndex, closest_on_segment};
use crate::geometry::{DVec2, Rect};
use crate::mesh::{Lists, Mesh, NONE, Piece};
use rustc_hash::FxHashSet;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

/// A feature of the domain, by its index there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// An input vertex.
    Vertex(u32),
    /// An input segment.
    Segment(u32),
}

/// The domain's triangulation, to be searched for what discs reach.
#[derive(Clone, Debug)]
pub struct Reach {
    points: Vec<DVec2>,
    /// How many of them are the domain's, which come first.
    input_vertices: usize,
    /// Counter-clockwise.
    triangles: Vec<[u32; 3]>,
    /// Across the sides ab, bc, ca of each triangle.
    neighbours: Vec<[u32; 3]>,
    /// The input segment on each side.
    segments: Vec<[u32; 3]>,
    /// The ends of each input segment.
    ends: Vec<[u32; 2]>,
    /// The triangles at each vertex where the domain touches itself.
    touching: Lists,
    tree: BoxTree,
    /// The sides with the domain on one side only.
    boundary: SegmentIndex,
}

/// What a disc reaches, if that is not all of the domain that it meets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part(Box<[u32]>);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Step {
    Triangle(u32),
    Vertex(u32),
    Segment(u32),
}

impl Reach {
    /// Triangulates the domain.
    ///
    /// # Errors
    /// If it cannot be triangulated.
    pub fn new(domain: &Domain) -> Result<Self, TriangulationError> {
        let whole = (0..domain.segments().len()).map(|_| Vec::new());
        let mesh = triangulate(domain, domain.vertices().to_vec(), Piece::chains(domain, whole))?;
        Ok(Self::of(domain, mesh))
    }

    /// Searches a mesh of the domain that has its vertices first.
    fn of(domain: &Domain, mesh: Mesh) -> Self {
        let adjacency = mesh.adjacency();
        let mut segment_of = vec![NONE; adjacency.edges().len()];
        for piece in &mesh.pieces {
            if let Some(edge) = adjacency.find(piece.a, piece.b) {
                segment_of[edge] = piece.segment;
            }
        }
        let on_side = |a, b| adjacency.find(a, b).map_or(NONE, |edge| segment_of[edge]);
        let outer: Vec<[u32; 2]> = (adjacency.edges().iter())
            .filter(|edge| edge.is_boundary())
            .map(|edge| edge.ends)
            .collect();
        let mut sides_at = vec![0u8; mesh.points.len()];
        for end in outer.iter().flatten() {
            sides_at[*end as usize] = sides_at[*end as usize].saturating_add(1);
        }
        let at_corners = (0..)
            .zip(&mesh.triangles)
            .flat_map(|(t, corners)| corners.map(|v| (v, t)));
        let touching = at_corners.filter(|(v, _)| sides_at[*v as usize] > 2);
        let corners = |triangle: &[u32; 3]| triangle.map(|v| mesh.points[v as usize]);
        Self {
            neighbours: adjacency.neighbours(&mesh.triangles),
            segments: (mesh.triangles.iter())
                .map(|&[a, b, c]| [on_side(a, b), on_side(b, c), on_side(c, a)])
                .collect(),
            ends: (domain.segments().iter())
                .map(|segment| [segment.a as u32, segment.b as u32])
                .collect(),
            touching: Lists::group(mesh.points.len(), touching),
            tree: BoxTree::new(mesh.triangles.iter().map(|t| Rect::around(corners(t)))),
            boundary: SegmentIndex::new(outer.iter().map(|ends| ends.map(|v| mesh.points[v as usize]))),
            input_vertices: domain.vertices().len(),
            points: mesh.points,
            triangles: mesh.triangles,
        }
    }

    /// lfs(x) with discs that count only what they reach: the radius of the smallest disc around `x` that reaches two features
    /// that are not incident (Definition 2.1 and its footnote). Infinite if there are no two.
    pub fn smallest_apart(&self, x: DVec2) -> f64 {
        let mut met: Vec<[u32; 2]> = Vec::new();
        let mut found = f64::INFINITY;
        self.grow(x, |feature, radius| {
            let ends = match feature {
                Feature::Vertex(v) => [v; 2],
                Feature::Segment(s) => self.ends[s as usize],
            };
            let is_incident = |other: &[u32; 2]| ends.contains(&other[0]) || ends.contains(&other[1]);
            if met.iter().all(is_incident) {
                met.push(ends);
                return ControlFlow::Continue(());
            }
            found = radius;
            ControlFlow::Break(())
        });
        found
    }

    /// Visits the features that discs around `x` reach, each with its radius, in the order of the radii, until `visit` breaks
    /// off.
    pub fn grow(&self, x: DVec2, mut visit: impl FnMut(Feature, f64) -> ControlFlow<()>) {
        let mut waiting: BinaryHeap<Reverse<(u64, Step)>> = BinaryHeap::new();
        // Distances are not negative, so their bits have the same order.
        self.holding(x, |t| waiting.push(Reverse((0, Step::Triangle(t)))));
        let mut done: FxHashSet<Step> = FxHashSet::default();
        while let Some(Reverse((key, step))) = waiting.pop() {
            if !done.insert(step) {
                continue;
            }
            let radius = f64::from_bits(key);
            let mut wait = |step: Step, distance: f64| {
                if !done.contains(&step) {
                    waiting.push(Reverse((radius.max(distance).to_bits(), step)));
                }
            };
            let told = match step {
                Step::Triangle(t) => {
                    let corners = self.triangles[t as usize];
                    for (k, v) in corners.into_iter().enumerate() {
                        if (v as usize) < self.input_vertices {
                            wait(Step::Vertex(v), self.points[v as usize].distance(x));
                        }
                        let (next, segment) = (self.neighbours[t as usize][k], self.segments[t as usize][k]);
                        if next != NONE || segment != NONE {
                            let distance = self.away(t, k, x);
                            if next != NONE {
                                wait(Step::Triangle(next), distance);
                            }
                            if segment != NONE {
                                wait(Step::Segment(segment), distance);
                            }
                        }
                    }
                    ControlFlow::Continue(())
                }
                Step::Vertex(v) => {
                    (self.touching.get(v as usize).iter()).for_each(|&t| wait(Step::Triangle(t), 0.0));
                    visit(Feature::Vertex(v), radius)
                }
                Step::Segment(s) => visit(Feature::Segment(s), radius),
            };
            if told.is_break() {
                return;
            }
        }
    }

    /// What the closed disc reaches, if it meets more of the domain than that. Not through vertices where the domain touches
    /// itself: what lies behind such a vertex counts for a disc around that vertex.
    pub fn part(&self, centre: DVec2, radius: f64) -> Option<Part> {
        // Each other component of what the disc meets has a boundary side of its own in the disc.
        let mut sides = 0i64;
        self.boundary.within(centre, radius, |_, _| sides += 1);
        if sides < 2 {
            return None;
        }
        let mut reached: Vec<u32> = Vec::new();
        self.holding(centre, |t| reached.push(t));
        let mut seen: FxHashSet<u32> = reached.iter().copied().collect();
        let mut next = 0;
        while let Some(&t) = reached.get(next) {
            next += 1;
            for (k, &across) in self.neighbours[t as usize].iter().enumerate() {
                if (across == NONE || !seen.contains(&across)) && self.away(t, k, centre) <= radius {
                    if across == NONE {
                        sides -= 1;
                    } else {
                        seen.insert(across);
                        reached.push(across);
                    }
                }
            }
        }
        if sides <= 0 {
            return None;
        }
        reached.sort_unstable();
        Some(Part(reached.into()))
    }

    /// Whether a point of the disc that `part` belongs to is reached.
    pub fn is_in(&self, part: &Part, x: DVec2) -> bool {
        let mut is_in = false;
        self.holding(x, |t| is_in |= part.0.binary_search(&t).is_ok());
        is_in
    }

    /// The smallest radius with which a disc around `x` reaches `y`, through no vertex where the domain touches itself; infinite
    /// where none does.
    pub fn radius_to(&self, x: DVec2, y: DVec2) -> f64 {
        let mut wanted = Vec::new();
        self.holding(y, |t| wanted.push(t));
        let mut waiting: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
        self.holding(x, |t| waiting.push(Reverse((0, t))));
        let mut done: FxHashSet<u32> = FxHashSet::default();
        while let Some(Reverse((key, t))) = waiting.pop() {
            let radius = f64::from_bits(key);
            if wanted.contains(&t) {
                return radius.max(x.distance(y));
            }
            if done.insert(t) {
                for (k, &next) in self.neighbours[t as usize].iter().enumerate() {
                    if next != NONE && !done.contains(&next) {
                        waiting.push(Reverse((radius.max(self.away(t, k, x)).to_bits(), next)));
                    }
                }
            }
        }
        f64::INFINITY
    }

    /// How far side `k` of triangle `t` is from `x`.
    fn away(&self, t: u32, k: usize, x: DVec2) -> f64 {
        let corners = self.triangles[t as usize];
        let ends = [corners[k], corners[(k + 1) % 3]].map(|v| self.points[v as usize]);
        closest_on_segment(ends, x).distance(x)
    }

    /// The closed triangles that hold `x` or, if rounding has put it beside the domain, the nearest.
    fn holding(&self, x: DVec2, mut visit: impl FnMut(u32)) {
        let corners = |t: usize| self.triangles[t].map(|v| self.points[v as usize]);
        let mut is_held = false;
        self.tree.near(x, 0.0, |t| {
            if triangle_holds(corners(t), x) {
                is_held = true;
                visit(t as u32);
            }
            0.0
        });
        if is_held {
            return;
        }
        let (mut nearest, mut least) = (Vec::new(), f64::INFINITY);
        self.tree.near(x, f64::INFINITY, |t| {
            let [a, b, c] = corners(t);
            let sides = [[a, b], [b, c], [c, a]].map(|ends| closest_on_segment(ends, x).distance(x));
            let distance = sides.into_iter().fold(f64::INFINITY, f64::min);
            if distance < least {
                (nearest, least) = (vec![t as u32], distance);
            } else if distance == least {
                nearest.push(t as u32);
            }
            least
        });
        nearest.into_iter().for_each(visit);
    }
}

#[cfg(test)]
mod tests;
