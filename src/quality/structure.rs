//! Structural checks: what must hold for every mesh, whoever made it.

use super::boundary::{NO_SEGMENT, same_vertex_distance};
use super::subject::Subject;
use super::tally::{Tally, Worst};
use super::{Check, parallel, shape};
use crate::geometry::DVec2;
use crate::geometry::predicates::{in_circle, orient2d};
use crate::geometry::tolerance::AREA;
use crate::mesh::Edge;
use crate::theory::Claim;

/// All structural checks.
pub struct Structure {
    positive_orientation: Check,
    area: Check,
    vertices_used: Check,
    input_vertices: Check,
    input_segments: Check,
    manifold_edges: Check,
    boundary_on_segments: Check,
    constrained_delaunay: Check,
}

impl Structure {
    /// Checks a mesh.
    pub fn of(subject: &Subject) -> Self {
        Self {
            positive_orientation: positive_orientation(subject),
            area: area(subject),
            vertices_used: vertices_used(subject),
            input_vertices: input_vertices(subject),
            input_segments: input_segments(subject),
            manifold_edges: manifold_edges(subject),
            boundary_on_segments: boundary_on_segments(subject),
            constrained_delaunay: constrained_delaunay(subject),
        }
    }

    /// Whether the triangles are known to make up the domain.
    pub fn is_whole(&self) -> bool {
        let needed = [
            &self.positive_orientation,
            &self.area,
            &self.manifold_edges,
            &self.boundary_on_segments,
        ];
        needed.iter().all(|check| check.holds)
    }

    /// The checks in the order of the table in [`super`].
    pub fn into_checks(self) -> Vec<Check> {
        vec![
            self.positive_orientation,
            self.area,
            self.vertices_used,
            self.input_vertices,
            self.input_segments,
            self.manifold_edges,
            self.boundary_on_segments,
            self.constrained_delaunay,
        ]
    }
}

fn positive_orientation(subject: &Subject) -> Check {
    let mesh = subject.mesh;
    let parts = parallel::map_ranges(mesh.triangles.len(), |range| {
        let mut tally = Tally::new(Worst::Smallest);
        for corners in range.map(|t| mesh.corners(t)) {
            let twice = orient2d(corners[0], corners[1], corners[2]);
            tally.see(0.5 * twice, shape::centroid(corners), twice <= 0.0);
        }
        tally
    });
    Tally::all(Worst::Smallest, parts).check(Claim::PositiveOrientation, true, 0.0)
}

fn area(subject: &Subject) -> Check {
    let mesh = subject.mesh;
    let area = 0.5
        * parallel::sum(mesh.triangles.len(), |t| {
            let [a, b, c] = mesh.corners(t);
            (b - a).perp_dot(c - a)
        });
    let difference = (area / subject.domain.area() - 1.0).abs();
    let mut tally = Tally::new(Worst::Largest);
    let allowed = AREA.max(area_beside_segments(subject));
    let nowhere = subject.domain.bounds().centre();
    tally.see(difference, nowhere, difference.is_nan() || difference > allowed);
    Check {
        at: None,
        witnesses: Vec::new(),
        ..tally.check(Claim::Area, true, allowed)
    }
}

/// The area that `input-segments` allows between the mesh's boundary and the segments, as a share of the domain's area.
/// It is more than [`AREA`] only if the domain is narrower than a millionth of its distance to the origin.
fn area_beside_segments(subject: &Subject) -> f64 {
    let domain = subject.domain;
    let sides = (0..domain.segments().len()).filter(|&s| domain.is_boundary(s));
    let perimeter: f64 = sides.map(|s| domain.ends(s)).map(|[a, b]| a.distance(b)).sum();
    same_vertex_distance(domain, subject.mesh) * perimeter / domain.area()
}

/// A check that counts places that should not be there; their number is the worst value.
fn none_of(claim: Claim, places: impl Iterator<Item = DVec2>) -> Check {
    let mut tally = Tally::new(Worst::Largest);
    for place in places {
        tally.see(1.0, place, true);
    }
    let check = tally.check(claim, true, 0.0);
    Check {
        worst: Some(check.broken as f64),
        ..check
    }
}

fn vertices_used(subject: &Subject) -> Check {
    let points = &subject.mesh.points;
    let mut used = vec![false; points.len()];
    for corner in subject.mesh.triangles.as_flattened() {
        used[*corner as usize] = true;
    }
    none_of(
        Claim::VerticesUsed,
        points.iter().zip(used).filter(|(_, used)| !used).map(|(p, _)| *p),
    )
}

fn input_vertices(subject: &Subject) -> Check {
    let pairs = subject.domain.vertices().iter().zip(&subject.boundary.vertex);
    none_of(
        Claim::InputVertices,
        pairs.filter(|(_, found)| found.is_none()).map(|(p, _)| *p),
    )
}

fn input_segments(subject: &Subject) -> Check {
    none_of(Claim::InputSegments, subject.boundary.lost.iter().map(|(_, end)| *end))
}

fn manifold_edges(subject: &Subject) -> Check {
    let mut tally = Tally::new(Worst::Largest);
    for (e, edge) in subject.adjacency.edges().iter().enumerate() {
        tally.see(f64::from(edge.uses), subject.midpoint(e), !edge.is_manifold());
    }
    let check = tally.check(Claim::ManifoldEdges, true, 2.0);
    if check.holds {
        Check { at: None, ..check }
    } else {
        check
    }
}

fn boundary_on_segments(subject: &Subject) -> Check {
    let edges = subject.adjacency.edges().iter().enumerate();
    let strays = edges.filter(|(e, edge)| edge.is_boundary() && subject.boundary.segment[*e] == NO_SEGMENT);
    none_of(Claim::BoundaryOnSegments, strays.map(|(e, _)| subject.midpoint(e)))
}

fn constrained_delaunay(subject: &Subject) -> Check {
    let claimed = subject
        .sizes
        .as_ref()
        .is_some_and(|sizes| sizes.bounds.guaranteed.contains(&Claim::ConstrainedDelaunay));
    let edges = subject.adjacency.edges();
    let parts = parallel::map_ranges(edges.len(), |range| {
        let mut tally = Tally::new(Worst::Largest);
        for e in range.filter(|e| subject.boundary.segment[*e] == NO_SEGMENT) {
            if let Some(excess) = delaunay_excess_deg(subject, &edges[e]) {
                tally.see(excess, subject.midpoint(e), excess > 0.0);
            }
        }
        tally
    });
    let check = Tally::all(Worst::Largest, parts).check(Claim::ConstrainedDelaunay, claimed, 0.0);
    if check.holds {
        Check { at: None, ..check }
    } else {
        check
    }
}

/// By how many degrees the two angles opposite to an edge together exceed 180: 0 if the edge is Delaunay by the exact
/// predicate, above 0 if not; `None` unless the edge has a triangle on either side.
fn delaunay_excess_deg(subject: &Subject, edge: &Edge) -> Option<f64> {
    let mesh = subject.mesh;
    let far = |t: u32| {
        mesh.triangles
            .get(t as usize)?
            .iter()
            .find(|k| !edge.ends.contains(k))
            .copied()
    };
    let [a, b, left, right] =
        [edge.ends[0], edge.ends[1], far(edge.left)?, far(edge.right)?].map(|k| mesh.points[k as usize]);
    // The signs of in_circle assume a counter-clockwise triangle; any other triangle fails another check.
    if orient2d(a, b, left) <= 0.0 || in_circle(a, b, left, right) <= 0.0 {
        return Some(0.0);
    }
    let angle = |at: DVec2| {
        let (u, v) = (a - at, b - at);
        u.perp_dot(v).abs().atan2(u.dot(v)).to_degrees()
    };
    Some((angle(left) + angle(right) - 180.0).max(f64::MIN_POSITIVE))
}
