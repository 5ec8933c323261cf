//! Points plus boundary pieces → constrained Delaunay triangulation, outside and holes carved away. The only user of spade.
//!
//! Step 6 of §5.1. [`triangulate`] bulk-loads the points by [`spade`]'s circle sweep. (It takes 0.8 s for a million points; the
//! variant that keeps the order of the points takes 1.4 s, so each point carries its index instead.) It makes the pieces
//! constraints, and floods the faces from the pieces, whose segments know what lies on their left and right. The only
//! arithmetic is in exact predicates, so a boundary point that rounding moved off its segment by an ulp leaves no hole
//! and no sliver: the domain that is meshed is the one whose boundary is the pieces.
//!
//! `Reach` searches the triangulation of the domain alone for what discs reach inside it.
//! `Refinable` starts from the same triangulation and takes points one at a time, for refinement.

mod reach;
mod refinable;

pub(crate) use reach::{Part, Reach};
pub(crate) use refinable::{Cavity, Location, Refinable, following};

mod cavities;

pub(crate) use cavities::triangulate_cavities;

use crate::domain::{Domain, Face};
use crate::geometry::{DVec2, predicates};
use crate::mesh::{Mesh, Piece};
use spade::handles::{FixedDirectedEdgeHandle, FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// Why points and pieces have no constrained triangulation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TriangulationError {
    /// Two pieces cross away from their ends.
    #[error("boundary pieces cross near ({x}, {y}); run with --repair, or scale the domain up")]
    Crossing {
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// Two pieces cover the same edge.
    #[error("boundary pieces of segments {first} and {second} overlap near ({x}, {y}); run with --repair")]
    Overlap {
        /// Segment of the first.
        first: u32,
        /// Segment of the second.
        second: u32,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// Two points coincide.
    #[error("points {first} and {second} coincide at ({x}, {y}); run with --repair, or scale the domain up")]
    Coincident {
        /// Index of the first.
        first: usize,
        /// Index of the second.
        second: usize,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// The pieces do not separate inside from outside: rounding folded the boundary over, or a piece is missing.
    #[error("inside and outside meet near ({x}, {y}): the boundary is not closed there; scale the domain up")]
    Leak {
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// A point lies outside the domain.
    #[error("point {point} at ({x}, {y}) is in no triangle of the domain")]
    Outside {
        /// Index of the point.
        point: usize,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// A piece names a point or a segment that does not exist.
    #[error("piece {piece} names a point or a segment that does not exist")]
    Index {
        /// Index of the piece.
        piece: usize,
    },
    /// Anything else that spade refuses, in its words.
    #[error("triangulation: {0}")]
    Refused(String),
}

/// What spade stores: a position, and the caller's index of the point.
#[derive(Clone, Copy)]
struct Vertex {
    position: Point2<f64>,
    index: u32,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

type Cdt = ConstrainedDelaunayTriangulation<Vertex>;

/// Marks a face that the flood has not reached.
const UNKNOWN: u32 = u32::MAX;

/// The constrained Delaunay triangulation of `points` with `pieces` as constraints, the outside and holes carved away.
///
/// `points` starts with the domain's vertices in order; `pieces` cut each of its segments into a chain. A piece that
/// passes exactly through a further point is cut there. Equal input gives equal output, order of triangles included.
///
/// [`Mesh::forced_pieces`] counts the pieces that are not locally Delaunay in the triangulation *before* carving: both
/// triangles beside them exist and the far corner of one lies strictly inside the circumcircle of the other. It is 0 if and
/// only if the Delaunay triangulation of the points alone (§5.1, step 6) has all pieces among its edges, up to the choice
/// of diagonals among points on one circle.
pub fn triangulate(domain: &Domain, points: Vec<DVec2>, pieces: Vec<Piece>) -> Result<Mesh, TriangulationError> {
    let Labelled { cdt, edges, labels } = labelled(domain, &points, &pieces)?;
    let mut mesh = Mesh {
        forced_pieces: edges.iter().filter(|(_, edge)| is_forced(&cdt, *edge)).count(),
        input_vertices: domain.vertices().len(),
        piece_markers: edges
            .iter()
            .map(|(piece, _)| domain.segments()[piece.segment as usize].marker)
            .collect(),
        pieces: edges.into_iter().map(|(piece, _)| piece).collect(),
        points,
        ..Mesh::default()
    };
    collect_triangles(&cdt, domain, &labels, &mut mesh);
    mesh.mark_points(domain.vertex_markers());
    every_point_used(&mesh)?;
    Ok(mesh)
}

/// The triangulation before carving.
struct Labelled {
    cdt: Cdt,
    /// Each piece with its directed edge a → b, cut where it passed through a point.
    edges: Vec<(Piece, FixedDirectedEdgeHandle)>,
    /// The domain's face that each of spade's faces lies in.
    labels: Vec<u32>,
}

fn labelled(domain: &Domain, points: &[DVec2], pieces: &[Piece]) -> Result<Labelled, TriangulationError> {
    check_indices(domain, points, pieces)?;
    let (mut cdt, handles) = load(points)?;
    let edges = constrain(&mut cdt, &handles, points, pieces)?;
    let labels = flood(&cdt, domain, &edges)?;
    Ok(Labelled { cdt, edges, labels })
}

fn check_indices(domain: &Domain, points: &[DVec2], pieces: &[Piece]) -> Result<(), TriangulationError> {
    let broken = |piece: &Piece| {
        piece.a.max(piece.b) as usize >= points.len() || piece.segment as usize >= domain.segments().len()
    };
    match pieces.iter().position(broken) {
        Some(piece) => Err(TriangulationError::Index { piece }),
        None if points.len() >= UNKNOWN as usize => Err(TriangulationError::Refused(
            "more points than 32 bits can count".to_string(),
        )),
        None => Ok(()),
    }
}

/// The Delaunay triangulation of the points, and spade's handle of each.
fn load(points: &[DVec2]) -> Result<(Cdt, Vec<FixedVertexHandle>), TriangulationError> {
    let vertices = points.iter().zip(0..).map(|(p, index)| Vertex {
        position: Point2::new(p.x, p.y),
        index,
    });
    let cdt = <Cdt as Triangulation>::bulk_load(vertices.collect())
        .map_err(|error| TriangulationError::Refused(error.to_string()))?;
    if cdt.num_vertices() != points.len() {
        return Err(coincident(points));
    }
    let mut handles = vec![FixedVertexHandle::from_index(0); points.len()];
    for vertex in cdt.vertices() {
        handles[vertex.data().index as usize] = vertex.fix();
    }
    Ok((cdt, handles))
}

/// Names a pair of equal points, the one with the smallest indices.
fn coincident(points: &[DVec2]) -> TriangulationError {
    let key = |i: usize| (points[i].x + 0.0, points[i].y + 0.0); // + 0.0 turns −0 into 0
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_unstable_by(|&i, &j| {
        let ((xi, yi), (xj, yj)) = (key(i), key(j));
        xi.total_cmp(&xj).then(yi.total_cmp(&yj)).then(i.cmp(&j))
    });
    let pairs = order.windows(2).filter(|pair| points[pair[0]] == points[pair[1]]);
    match pairs.map(|pair| (pair[0], pair[1])).min() {
        Some((first, second)) => {
            let DVec2 { x, y } = points[first];
            TriangulationError::Coincident { first, second, x, y }
        }
        None => TriangulationError::Refused("points were lost without being equal to another".to_string()),
    }
}

/// Makes the pieces constraints. Returns each with its directed edge a → b, cut where it passes through a point.
fn constrain(
    cdt: &mut Cdt,
    handles: &[FixedVertexHandle],
    points: &[DVec2],
    pieces: &[Piece],
) -> Result<Vec<(Piece, FixedDirectedEdgeHandle)>, TriangulationError> {
    let mut edges = Vec::with_capacity(pieces.len());
    for piece in pieces {
        let chain = cdt.try_add_constraint(handles[piece.a as usize], handles[piece.b as usize]);
        if chain.is_empty() {
            return Err(crossing(cdt, handles, points, piece));
        }
        for edge in chain {
            let [a, b] = cdt.directed_edge(edge).vertices().map(|vertex| vertex.data().index);
            edges.push((
                Piece {
                    a,
                    b,
                    segment: piece.segment,
                },
                edge,
            ));
        }
    }
    let mut taken = vec![UNKNOWN; cdt.num_undirected_edges()];
    for (piece, edge) in &edges {
        let segment = &mut taken[edge.as_undirected().index()];
        if *segment != UNKNOWN {
            let DVec2 { x, y } = points[piece.a as usize].midpoint(points[piece.b as usize]);
            return Err(TriangulationError::Overlap {
                first: *segment,
                second: piece.segment,
                x,
                y,
            });
        }
        *segment = piece.segment;
    }
    Ok(edges)
}

/// Where `piece` meets the constraint that stops it.
fn crossing(cdt: &Cdt, handles: &[FixedVertexHandle], points: &[DVec2], piece: &Piece) -> TriangulationError {
    let (a, b) = (points[piece.a as usize], points[piece.b as usize]);
    let conflict = cdt
        .get_conflicting_edges_between_vertices(handles[piece.a as usize], handles[piece.b as usize])
        .next();
    let place = conflict.map_or(a, |edge| {
        let [c, d] = edge.vertices().map(|vertex| points[vertex.data().index as usize]);
        let (towards_c, towards_d) = (predicates::orient2d(a, b, c).abs(), predicates::orient2d(a, b, d).abs());
        c.lerp(d, towards_c / (towards_c + towards_d))
    });
    TriangulationError::Crossing { x: place.x, y: place.y }
}

/// The domain's face that each triangle lies in, spread from the pieces over all unconstrained edges.
///
/// The inside face with the most pieces is not walked through: it gets the triangles that no other face has reached, since
/// outside and holes are usually few triangles. A face that leaks into it meets one of its pieces.
fn flood(
    cdt: &Cdt,
    domain: &Domain,
    edges: &[(Piece, FixedDirectedEdgeHandle)],
) -> Result<Vec<u32>, TriangulationError> {
    let sides = || {
        edges.iter().flat_map(|(piece, edge)| {
            let segment = &domain.segments()[piece.segment as usize];
            [(*edge, segment.left as u32), (edge.rev(), segment.right as u32)]
        })
    };
    let rest = face_with_most_pieces(domain, sides().map(|(_, label)| label));
    let mut flood = Flood {
        cdt,
        faces: domain.faces(),
        labels: vec![UNKNOWN; cdt.num_all_faces()],
        stack: Vec::new(),
    };
    flood.labels[cdt.outer_face().fix().index()] = 0;
    for (edge, label) in sides().filter(|(_, label)| *label != rest) {
        flood.reach(edge, label)?;
    }
    for edge in cdt.convex_hull().filter(|edge| !edge.is_constraint_edge()) {
        flood.reach(edge.fix().rev(), 0)?;
    }
    while let Some((face, label)) = flood.stack.pop() {
        for edge in cdt
            .face(face)
            .adjacent_edges()
            .iter()
            .filter(|edge| !edge.is_constraint_edge())
        {
            flood.reach(edge.fix().rev(), label)?;
        }
    }
    for (edge, label) in sides().filter(|(_, label)| *label == rest) {
        flood.reach(edge, label)?;
    }
    for label in flood.labels.iter_mut().filter(|label| **label == UNKNOWN) {
        *label = rest;
    }
    Ok(flood.labels)
}

/// The inside face that most sides of pieces border on; 0, which is outside, if there is none.
fn face_with_most_pieces(domain: &Domain, labels: impl Iterator<Item = u32>) -> u32 {
    let mut counts = vec![0usize; domain.faces().len()];
    for label in labels {
        counts[label as usize] += 1;
    }
    let inside = (0u32..)
        .zip(counts)
        .filter(|(label, _)| domain.faces()[*label as usize].inside);
    inside.max_by_key(|(_, count)| *count).map_or(0, |(label, _)| label)
}

/// The state of [`flood`].
struct Flood<'a> {
    cdt: &'a Cdt,
    faces: &'a [Face],
    labels: Vec<u32>,
    stack: Vec<(FixedFaceHandle<InnerTag>, u32)>,
}

impl Flood<'_> {
    /// Labels the triangle on the left of `edge`, or makes sure that it is of the same kind already.
    fn reach(&mut self, edge: FixedDirectedEdgeHandle, label: u32) -> Result<(), TriangulationError> {
        let edge = self.cdt.directed_edge(edge);
        let found = &mut self.labels[edge.face().fix().index()];
        if *found == UNKNOWN {
            *found = label;
            self.stack
                .extend(edge.face().as_inner().map(|face| (face.fix(), label)));
            return Ok(());
        }
        // Two outside faces may have become one, because segments that bound nothing inside were left out.
        let (one, other) = (self.faces[*found as usize], self.faces[label as usize]);
        if one.inside != other.inside || (one.inside && one.region.to_bits() != other.region.to_bits()) {
            let [a, b] = edge.positions();
            return Err(TriangulationError::Leak {
                x: 0.5 * (a.x + b.x),
                y: 0.5 * (a.y + b.y),
            });
        }
        Ok(())
    }
}

/// Whether a constraint is not a Delaunay edge: the far corner of one triangle lies inside the circle of the other.
fn is_forced(cdt: &Cdt, edge: FixedDirectedEdgeHandle) -> bool {
    let edge = cdt.directed_edge(edge);
    let position = |point: Point2<f64>| DVec2::new(point.x, point.y);
    let [a, b] = edge.positions().map(position);
    match (edge.opposite_position(), edge.rev().opposite_position()) {
        (Some(left), Some(right)) => predicates::in_circle(a, b, position(left), position(right)) > 0.0,
        _ => false,
    }
}

fn collect_triangles(cdt: &Cdt, domain: &Domain, labels: &[u32], mesh: &mut Mesh) {
    for face in cdt.inner_faces() {
        let label = labels[face.fix().index()];
        let inside = domain.faces().get(label as usize).filter(|face| face.inside);
        if let Some(inside) = inside {
            mesh.triangles.push(face.vertices().map(|vertex| vertex.data().index));
            mesh.regions.push(inside.region);
        }
    }
}

fn every_point_used(mesh: &Mesh) -> Result<(), TriangulationError> {
    let mut used = vec![false; mesh.points.len()];
    for &corner in mesh.triangles.as_flattened() {
        used[corner as usize] = true;
    }
    match used.iter().position(|used| !used) {
        Some(point) => {
            let DVec2 { x, y } = mesh.points[point];
            Err(TriangulationError::Outside { point, x, y })
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
