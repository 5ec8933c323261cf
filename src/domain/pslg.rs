//! [`Pslg`]: the input as given, not yet known to be valid, with where each part of it was written.

use crate::geometry::DVec2;

/// An input segment as given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InputSegment {
    /// Index of the first end in [`Pslg::vertices`].
    pub a: usize,
    /// Index of the second end.
    pub b: usize,
    /// The user's marker, 0 where none was given.
    pub marker: i32,
}

/// A region point: the face that holds it gets the attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Any point of the face.
    pub point: DVec2,
    /// The attribute its triangles carry.
    pub attribute: f64,
    /// Largest triangle area the user asked for there. Passed on from file to file; meshers follow the spacing instead.
    pub max_area: Option<f64>,
}

/// Which bounded faces are inside.
#[derive(Clone, Debug, PartialEq)]
pub enum Fill {
    /// Triangle's rule: all but those that hold one of these points.
    HolePoints(Vec<DVec2>),
    /// The rule of polygons with rings: a face is inside if a path to it from far away crosses an odd number of rings.
    EvenOdd {
        /// For each segment whether an odd number of rings runs along it.
        flips: Vec<bool>,
    },
}

impl Default for Fill {
    fn default() -> Self {
        Self::HolePoints(Vec::new())
    }
}

/// Where the parts of a [`Pslg`] came from, for messages. Line numbers count from 1; lists are empty if there is no file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// File name as the user gave it, or the gallery's name.
    pub file: String,
    /// The number of the file's first vertex and segment: 0 or 1.
    pub first_number: usize,
    /// The file that contains the vertices, if it is another one.
    pub vertex_file: Option<String>,
    /// Line of each vertex.
    pub vertex_lines: Vec<usize>,
    /// Line of each segment.
    pub segment_lines: Vec<usize>,
    /// Line of each hole point.
    pub hole_lines: Vec<usize>,
    /// Line of each region point.
    pub region_lines: Vec<usize>,
}

/// A planar straight-line graph as given. [`super::Domain::new`] checks it, [`super::repair`] mends it.
///
/// ```
/// use biting::domain::{Domain, Pslg};
/// use biting::geometry::DVec2;
///
/// let mut plate = Pslg::new("plate with a slot");
/// plate.add_ring([(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)].map(DVec2::from), 1);
/// plate.add_ring([(1.0, 0.9), (2.0, 0.9), (2.0, 1.1), (1.0, 1.1)].map(DVec2::from), 2);
/// plate.add_hole(DVec2::new(1.5, 1.0));
/// assert!((Domain::new(plate)?.area() - 5.8).abs() < 1e-12);
/// # Ok::<(), biting::domain::DomainError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pslg {
    /// Gallery name or file stem.
    pub name: String,
    /// Vertex positions.
    pub vertices: Vec<DVec2>,
    /// One marker for each vertex; empty means all 0.
    pub vertex_markers: Vec<i32>,
    /// Segments between vertices.
    pub segments: Vec<InputSegment>,
    /// Which bounded faces are inside.
    pub fill: Fill,
    /// Region points.
    pub regions: Vec<Region>,
    /// What the reader left out, as sentences for the user.
    pub notes: Vec<String>,
    /// Where its parts came from.
    pub source: Source,
}

impl Pslg {
    /// An empty PSLG of that name.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            source: Source {
                file: name.to_owned(),
                ..Source::default()
            },
            ..Self::default()
        }
    }

    /// Adds an isolated vertex and returns its index.
    pub fn add_vertex(&mut self, x: DVec2) -> usize {
        self.vertices.push(x);
        self.vertices.len() - 1
    }

    /// Adds a closed ring through `points`, in order, its segments marked `marker`.
    pub fn add_ring(&mut self, points: impl IntoIterator<Item = DVec2>, marker: i32) {
        let first = self.vertices.len();
        self.add_chain(points, marker);
        if let Some(last) = self.vertices.len().checked_sub(1).filter(|&last| last > first) {
            self.segments.push(InputSegment {
                a: last,
                b: first,
                marker,
            });
        }
    }

    /// Adds an open chain through `points`, in order, its segments marked `marker`.
    pub fn add_chain(&mut self, points: impl IntoIterator<Item = DVec2>, marker: i32) {
        let first = self.vertices.len();
        self.vertices.extend(points);
        self.segments
            .extend((first + 1..self.vertices.len()).map(|b| InputSegment { a: b - 1, b, marker }));
    }

    /// Adds a hole point under Triangle's rule.
    pub fn add_hole(&mut self, x: DVec2) {
        match &mut self.fill {
            Fill::HolePoints(points) => points.push(x),
            fill @ Fill::EvenOdd { .. } => *fill = Fill::HolePoints(vec![x]),
        }
    }

    /// The hole points, none under the even-odd rule.
    pub fn holes(&self) -> &[DVec2] {
        match &self.fill {
            Fill::HolePoints(points) => points,
            Fill::EvenOdd { .. } => &[],
        }
    }

    /// The two ends of segment `s`.
    pub fn ends(&self, s: usize) -> [DVec2; 2] {
        [self.vertices[self.segments[s].a], self.vertices[self.segments[s].b]]
    }

    /// The marker of vertex `v`.
    pub fn vertex_marker(&self, v: usize) -> i32 {
        self.vertex_markers.get(v).copied().unwrap_or(0)
    }
}
