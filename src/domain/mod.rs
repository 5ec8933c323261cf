//! Ω: a planar straight-line graph (PSLG, §2.1) and which of its faces are to be meshed.

use crate::geometry::segments::SegmentIndex;
use crate::geometry::{DVec2, Rect};

mod build;
mod corners;
mod error;
mod files;
pub mod gallery;
mod locate;
mod pslg;
mod repair;
mod subdivision;
#[cfg(test)]
mod tests;
mod validate;

pub(crate) use corners::Wedge;
pub use error::{DomainError, Fault, FaultKind};
pub use files::geojson::parse as parse_geojson;
pub use files::poly::parse as parse_poly;
pub use files::{load, read};
pub(crate) use locate::Place;
pub use pslg::{Fill, InputSegment, Pslg, Region, Source};
pub use repair::{RepairReport, repair};
pub use validate::{LARGEST_COORDINATE, faults};

/// An input segment between two vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Segment {
    /// Index of the first end in [`Domain::vertices`].
    pub a: usize,
    /// Index of the second end.
    pub b: usize,
    /// The user's marker, 0 where none was given.
    pub marker: i32,
    /// The face on the left of a → b, an index into [`Domain::faces`].
    pub left: usize,
    /// The face on the right of a → b.
    pub right: usize,
}

/// A face of the planar subdivision. Face 0 is the unbounded one, always outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Whether the face belongs to Ω.
    pub inside: bool,
    /// The region attribute given by the user, 0 where none was given.
    pub region: f64,
    /// The largest triangle area that the user asked for there; it is passed on from file to file.
    pub max_area: Option<f64>,
}

impl Face {
    /// A face that is not to be meshed.
    pub const OUTSIDE: Self = Self {
        inside: false,
        region: 0.0,
        max_area: None,
    };
}

/// The domain to mesh: a valid PSLG. Vertices and segments that no inside face touches have been left out.
///
/// ```
/// use biting::domain::{Domain, load};
/// use biting::geometry::DVec2;
///
/// let triangle = Domain::polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])?;
/// assert!(triangle.contains(DVec2::new(0.2, 0.2)) && !triangle.contains(DVec2::new(0.8, 0.8)));
/// // A gallery name or a file, .poly or .geojson.
/// assert_eq!(load("l-shape")?.vertices().len(), 6);
/// // Two sides that cross are no polygon: the message says where.
/// assert!(Domain::polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]).is_err());
/// # Ok::<(), biting::domain::DomainError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Domain {
    name: String,
    vertices: Vec<DVec2>,
    vertex_markers: Vec<i32>,
    segments: Vec<Segment>,
    faces: Vec<Face>,
    bounds: Rect,
    area: f64,
    isolated: Vec<usize>,
    notes: Vec<String>,
    index: SegmentIndex,
    locator: locate::Locator,
    corners: corners::Corners,
}

impl Domain {
    /// Gallery name or file stem.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Input vertices, in input order.
    pub fn vertices(&self) -> &[DVec2] {
        &self.vertices
    }

    /// One marker for each vertex.
    pub fn vertex_markers(&self) -> &[i32] {
        &self.vertex_markers
    }

    /// Input segments, in input order.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Faces; a segment's `left` and `right` point here.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// The two ends of segment `s`.
    pub fn ends(&self, s: usize) -> [DVec2; 2] {
        let segment = &self.segments[s];
        [self.vertices[segment.a], self.vertices[segment.b]]
    }

    /// The smallest axis-aligned box around the vertices.
    pub fn bounds(&self) -> Rect {
        self.bounds
    }

    /// The segment nearest to `x`, and how far it is.
    pub fn nearest_segment(&self, x: DVec2) -> (usize, f64) {
        let nearest = self.index.nearest(x);
        nearest.unwrap_or((0, f64::INFINITY))
    }

    /// Area of the inside faces.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Whether exactly one side of segment `s` is inside: the front starts there.
    pub fn is_boundary(&self, s: usize) -> bool {
        let segment = &self.segments[s];
        self.faces[segment.left].inside != self.faces[segment.right].inside
    }

    /// Vertices on no segment, each in an inside face, in order.
    pub fn isolated(&self) -> &[usize] {
        &self.isolated
    }

    /// What was left out or ignored when the domain was built, as sentences for the user.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The spatial index of the segments, which returns indices into [`Domain::segments`].
    pub(crate) fn index(&self) -> &SegmentIndex {
        &self.index
    }

    /// Where `x` lies, decided exactly.
    pub fn place(&self, x: DVec2) -> Place {
        self.locator.place(x, &self.segments, &self.index)
    }

    /// Whether `x` lies in an inside face or on a segment, decided exactly.
    pub fn contains(&self, x: DVec2) -> bool {
        match self.place(x) {
            Place::Face(face) => self.faces[face].inside,
            Place::Segment(_) => true,
        }
    }

    /// The face that holds `x`, decided exactly; on a segment the face on its left, or on its right if only that one is
    /// inside.
    pub fn face_at(&self, x: DVec2) -> usize {
        match self.place(x) {
            Place::Face(face) => face,
            Place::Segment(s) => {
                let segment = &self.segments[s];
                if self.faces[segment.left].inside {
                    segment.left
                } else {
                    segment.right
                }
            }
        }
    }
}
