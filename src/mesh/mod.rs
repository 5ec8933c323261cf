//! The result of a mesher: triangles over points, with the input's vertices, segments and regions still known.

mod adjacency;
pub mod files;

pub(crate) use adjacency::Lists;
pub use adjacency::{Adjacency, Edge, NONE};

use crate::domain::Domain;
use crate::geometry::DVec2;

/// A piece of an input segment that became a mesh edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Index of the end nearer to the segment's first vertex.
    pub a: u32,
    /// Index of the other end.
    pub b: u32,
    /// The input segment it lies on, an index into [`crate::domain::Domain::segments`].
    pub segment: u32,
}

impl Piece {
    /// The chains of mesh edges along all segments. `cuts` contains, for each segment, the vertices on it with their distances
    /// from its first end, in any order.
    pub fn chains(domain: &Domain, cuts: impl IntoIterator<Item = Vec<(f64, u32)>>) -> Vec<Self> {
        let mut pieces = Vec::new();
        for (segment, mut cuts) in cuts.into_iter().enumerate() {
            cuts.sort_by(|one, other| one.0.total_cmp(&other.0));
            let ends = domain.segments()[segment];
            let mut before = ends.a as u32;
            for next in cuts.into_iter().map(|(_, vertex)| vertex).chain([ends.b as u32]) {
                pieces.push(Self {
                    a: before,
                    b: next,
                    segment: segment as u32,
                });
                before = next;
            }
        }
        pieces
    }
}

/// A conforming triangle mesh. The domain's vertices come first, in order.
///
/// ```
/// use biting::{Case, domain::Domain, meshers::biting::Biting};
///
/// let square = Domain::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])?;
/// let mesh = Case::new(square, "uniform:0.2", 0.25, 0.75)?.mesh(&Biting::default())?;
/// assert_eq!(mesh.points[2].to_array(), [1.0, 1.0]);
/// let area = |t: usize| {
///     let [a, b, c] = mesh.corners(t);
///     0.5 * (b - a).perp_dot(c - a)
/// };
/// let whole: f64 = (0..mesh.triangles.len()).map(area).sum();
/// assert!((whole - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub points: Vec<DVec2>,
    /// One marker for each point: the input's for input vertices, the segment's for points on a segment, else 0.
    pub point_markers: Vec<i32>,
    /// Counter-clockwise triangles, as indices into `points`.
    pub triangles: Vec<[u32; 3]>,
    /// The region attribute of each triangle.
    pub regions: Vec<f64>,
    /// The input segments, cut into mesh edges; in segment order, along each segment from its first vertex.
    pub pieces: Vec<Piece>,
    /// One marker for each piece: its segment's.
    pub piece_markers: Vec<i32>,
    /// How many of `points`, from the front, are input vertices.
    pub input_vertices: usize,
    /// Number of pieces that are not Delaunay edges and are edges only because the triangulation is constrained.
    pub forced_pieces: usize,
    /// Triangles by which one front met another, as indices, ascending; empty for methods without a front of elements.
    pub seams: Vec<u32>,
}

impl Mesh {
    /// The corners of triangle `t`, in its order.
    pub fn corners(&self, t: usize) -> [DVec2; 3] {
        self.triangles[t].map(|k| self.points[k as usize])
    }

    /// Sets `point_markers`: input vertices get theirs, points on a segment the segment's, all others 0.
    pub fn mark_points(&mut self, input: &[i32]) {
        self.point_markers = vec![0; self.points.len()];
        for (piece, marker) in self.pieces.iter().zip(&self.piece_markers) {
            self.point_markers[piece.a as usize] = *marker;
            self.point_markers[piece.b as usize] = *marker;
        }
        for (marker, input) in self.point_markers.iter_mut().zip(input) {
            *marker = *input;
        }
    }

    /// All edges, each with the triangles on its sides.
    pub fn adjacency(&self) -> Adjacency {
        Adjacency::of(&self.triangles, self.points.len())
    }
}
