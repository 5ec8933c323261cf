//! A constrained Delaunay triangulation that takes points one at a time, splits pieces, and removes free vertices.
//!
//! Half-edges 3t, 3t + 1, 3t + 2 run counter-clockwise round triangle t, outside and holes included, so that a piece split
//! there keeps the whole plane triangulated and the result is the same as [`super::triangulate`] of all points. Every
//! triangle carries the face of the domain it lies in. All decisions are exact predicates.
//!
//! A piece is split by topology: its two triangles become four, whichever side of the line rounding put the point on. If one of
//! the four would not be counter-clockwise and is in the domain, the split is refused, so an invalid mesh cannot arise. If it is
//! outside, it stays as it is: a sliver of rounding errors, such as one between the convex hull and points of one side that a
//! rotation has left not quite on a line. No flip touches it, and since nothing is taken away, the triangles around a vertex
//! stay connected.

mod change;
mod collect;
mod remove;
#[cfg(test)]
mod tests;

use super::{TriangulationError, labelled};
use crate::domain::Domain;
use crate::geometry::{DVec2, predicates};
use crate::mesh::{NONE, Piece};
use spade::Triangulation;

/// A constrained Delaunay triangulation in the making.
#[derive(Clone, Debug)]
pub struct Refinable {
    points: Vec<DVec2>,
    /// How many of `points`, from the front, are the domain's vertices.
    input_vertices: usize,
    /// The ends of each segment of the domain.
    segment_ends: Vec<[u32; 2]>,
    /// The vertex where each half-edge starts; [`NONE`] in unused triangles.
    origin: Vec<u32>,
    /// The half-edge on the other side, [`NONE`] on the convex hull.
    twin: Vec<u32>,
    /// The piece on each half-edge, or [`NONE`].
    piece_of: Vec<u32>,
    /// The domain's face each triangle lies in.
    face_of: Vec<u32>,
    /// Whether each face of the domain is inside.
    inside: Vec<bool>,
    /// A half-edge out of each vertex; [`NONE`] for vertices that have been removed.
    out: Vec<u32>,
    pieces: Vec<Span>,
    /// Unused triangles, to be used again.
    unused: Vec<u32>,
    /// Whether splits of pieces have turned triangles outside over.
    has_overturned: bool,
    /// Triangles made or altered by the last change.
    changed: Vec<u32>,
}

/// A piece with its place on its segment.
#[derive(Clone, Copy, Debug)]
struct Span {
    piece: Piece,
    /// Where it begins and ends, as shares of the segment from its first vertex.
    shares: [f64; 2],
    /// One of its half-edges.
    edge: u32,
}

/// Where a walk towards a point ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// In this triangle, or on one of its edges that is not a piece.
    Triangle(u32),
    /// On this piece, or behind it: the walk does not cross pieces.
    Piece(u32),
    /// At this vertex.
    Vertex(u32),
}

/// The cavity of a new point: the triangles whose circumcircles hold it, as far as it sees past pieces.
#[derive(Clone, Debug, Default)]
pub struct Cavity {
    point: DVec2,
    triangles: Vec<u32>,
    /// Half-edges of those triangles on the cavity's rim, counter-clockwise.
    rim: Vec<u32>,
    stack: Vec<u32>,
}

impl Cavity {
    /// Half-edges on the rim, counter-clockwise, the cavity on their left.
    pub fn rim(&self) -> &[u32] {
        &self.rim
    }
}

/// The next half-edge round the same triangle.
pub fn following(edge: u32) -> u32 {
    if edge % 3 == 2 { edge - 2 } else { edge + 1 }
}

/// The half-edge before round the same triangle.
fn previous(edge: u32) -> u32 {
    if edge.is_multiple_of(3) { edge + 2 } else { edge - 1 }
}

impl Refinable {
    /// The triangulation of the domain's vertices with its segments as pieces; piece s is segment s.
    ///
    /// # Errors
    /// See [`TriangulationError`].
    pub fn new(domain: &Domain) -> Result<Self, TriangulationError> {
        let points = domain.vertices().to_vec();
        let whole = domain.segments().iter().zip(0..).map(|(ends, segment)| Piece {
            a: ends.a as u32,
            b: ends.b as u32,
            segment,
        });
        let pieces: Vec<Piece> = whole.collect();
        let start = labelled(domain, &points, &pieces)?;
        if start.edges.len() != pieces.len() {
            return Err(TriangulationError::Refused("a segment passes through a vertex".into()));
        }
        let mut half_edge = vec![NONE; start.cdt.num_directed_edges()];
        let count = 3 * start.cdt.num_inner_faces();
        let mut triangulation = Self {
            input_vertices: points.len(),
            segment_ends: pieces.iter().map(|piece| [piece.a, piece.b]).collect(),
            out: vec![NONE; points.len()],
            points,
            origin: Vec::with_capacity(count),
            twin: vec![NONE; count],
            piece_of: vec![NONE; count],
            face_of: Vec::with_capacity(count / 3),
            inside: domain.faces().iter().map(|face| face.inside).collect(),
            pieces: Vec::with_capacity(pieces.len()),
            unused: Vec::new(),
            has_overturned: false,
            changed: Vec::new(),
        };
        for face in start.cdt.inner_faces() {
            for edge in face.adjacent_edges() {
                let (id, vertex) = (triangulation.origin.len() as u32, edge.from().data().index);
                half_edge[edge.fix().index()] = id;
                triangulation.origin.push(vertex);
                triangulation.out[vertex as usize] = id;
            }
            triangulation.face_of.push(start.labels[face.fix().index()]);
        }
        for edge in start.cdt.directed_edges() {
            let (id, twin) = (half_edge[edge.fix().index()], half_edge[edge.rev().fix().index()]);
            if id != NONE {
                triangulation.twin[id as usize] = twin;
            }
        }
        for ((piece, edge), id) in start.edges.into_iter().zip(0..) {
            let sides = [edge, edge.rev()].map(|side| half_edge[side.index()]);
            for side in sides.into_iter().filter(|&side| side != NONE) {
                triangulation.piece_of[side as usize] = id;
            }
            let edge = sides[0].min(sides[1]);
            triangulation.pieces.push(Span {
                piece,
                shares: [0.0, 1.0],
                edge,
            });
        }
        Ok(triangulation)
    }

    /// Pieces so far.
    pub fn piece_count(&self) -> usize {
        self.pieces.len()
    }

    /// Triangles in store, outside and unused ones included.
    pub fn triangle_count(&self) -> usize {
        self.face_of.len()
    }

    /// Where a vertex is.
    pub fn point(&self, vertex: u32) -> DVec2 {
        self.points[vertex as usize]
    }

    /// The corners of a triangle, three times [`NONE`] if it is unused.
    pub fn triangle(&self, triangle: u32) -> [u32; 3] {
        let first = 3 * triangle as usize;
        [self.origin[first], self.origin[first + 1], self.origin[first + 2]]
    }

    /// Whether a triangle is in use and belongs to the domain.
    pub fn is_inside(&self, triangle: u32) -> bool {
        self.origin[3 * triangle as usize] != NONE && self.inside[self.face_of[triangle as usize] as usize]
    }

    /// The ends of a half-edge.
    pub fn ends(&self, edge: u32) -> [u32; 2] {
        [self.origin[edge as usize], self.origin[following(edge) as usize]]
    }

    /// The corner opposite to a half-edge in its triangle.
    pub fn apex(&self, edge: u32) -> u32 {
        self.origin[previous(edge) as usize]
    }

    /// The piece on a half-edge.
    pub fn piece_on(&self, edge: u32) -> Option<u32> {
        let piece = self.piece_of[edge as usize];
        (piece != NONE).then_some(piece)
    }

    /// A piece by its number; splitting keeps the number for the part nearer to the segment's first vertex.
    pub fn piece(&self, piece: u32) -> Piece {
        self.pieces[piece as usize].piece
    }

    /// Where a piece begins and ends on its segment, as shares from the segment's first vertex.
    pub fn shares(&self, piece: u32) -> [f64; 2] {
        self.pieces[piece as usize].shares
    }

    /// The half-edges of a piece that have the domain on their left.
    pub fn inner_sides(&self, piece: u32) -> impl Iterator<Item = u32> + use<> {
        let edge = self.pieces[piece as usize].edge;
        let inner = |&side: &u32| side != NONE && self.is_inside(side / 3);
        let sides = [edge, self.twin[edge as usize]].map(|side| Some(side).filter(inner));
        sides.into_iter().flatten()
    }

    /// Triangles made or altered by the last change, each once.
    pub fn changed(&self) -> &[u32] {
        &self.changed
    }

    /// The half-edges out of a vertex, counter-clockwise.
    pub fn around(&self, vertex: u32) -> Around<'_> {
        let mut first = self.out[vertex as usize];
        // On the hull, start at the clockwise end.
        let start = first;
        while first != NONE && self.twin[first as usize] != NONE {
            first = following(self.twin[first as usize]);
            if first == start {
                break;
            }
        }
        Around {
            triangulation: self,
            first,
            at: first,
        }
    }

    /// Walks from a triangle towards a point without crossing pieces, as long as the point is beyond an edge.
    ///
    /// Each step goes to a triangle whose circumcircle holds the point more deeply, so the walk ends.
    pub fn locate(&self, from: u32, x: DVec2) -> Location {
        let mut triangle = from;
        'walk: loop {
            let mut met = None;
            for edge in 3 * triangle..3 * triangle + 3 {
                let [a, b] = self.ends(edge).map(|vertex| self.point(vertex));
                let side = predicates::orient2d(a, b, x);
                let piece = self.piece_of[edge as usize];
                if piece == NONE && side < 0.0 && self.twin[edge as usize] != NONE {
                    triangle = self.twin[edge as usize] / 3;
                    continue 'walk;
                }
                if piece != NONE && (side < 0.0 || (side == 0.0 && met.is_none())) {
                    met = Some(piece);
                }
            }
            let corner = self.triangle(triangle).into_iter().find(|&v| self.point(v) == x);
            return match (corner, met) {
                (Some(vertex), _) => Location::Vertex(vertex),
                (None, Some(piece)) => Location::Piece(piece),
                (None, None) => Location::Triangle(triangle),
            };
        }
    }
}

/// The half-edges out of a vertex, counter-clockwise; see [`Refinable::around`].
#[derive(Clone, Debug)]
pub struct Around<'a> {
    triangulation: &'a Refinable,
    first: u32,
    at: u32,
}

impl Iterator for Around<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        if self.at == NONE {
            return None;
        }
        let edge = self.at;
        let turned = self.triangulation.twin[previous(edge) as usize];
        self.at = if turned == self.first { NONE } else { turned };
        Some(edge)
    }
}
