//! Points plus boundary pieces → constrained Delaunay triangulation, outside and holes carved away. The only door to spade.

use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::mesh::{Mesh, Piece};

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
    /// Anything else spade refuses, in its words.
    #[error("triangulation: {0}")]
    Refused(String),
}

/// The constrained Delaunay triangulation of `points` with `pieces` as constraints, the outside and holes carved away.
///
/// `points` starts with the domain's vertices in order; `pieces` cut each of its segments into a chain.
pub fn triangulate(_domain: &Domain, _points: Vec<DVec2>, _pieces: Vec<Piece>) -> Result<Mesh, TriangulationError> {
    unimplemented!("the triangulation part provides this")
}
