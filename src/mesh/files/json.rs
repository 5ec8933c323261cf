//! `.json`: every field of a [`Mesh`], by its name.

use super::scan::Complaint;
use crate::geometry::DVec2;
use crate::mesh::{Mesh, Piece};
use serde::{Deserialize, Serialize};

/// A mesh as the file has it; pieces are `[a, b, segment]`.
#[derive(Serialize, Deserialize)]
struct Stored {
    points: Vec<[f64; 2]>,
    point_markers: Vec<i32>,
    triangles: Vec<[u32; 3]>,
    regions: Vec<f64>,
    pieces: Vec<[u32; 3]>,
    piece_markers: Vec<i32>,
    input_vertices: usize,
    forced_pieces: usize,
    #[serde(default)]
    seams: Vec<u32>,
}

/// One object on one line.
pub fn text(mesh: &Mesh) -> String {
    let stored = Stored {
        points: mesh.points.iter().map(|p| p.to_array()).collect(),
        point_markers: mesh.point_markers.clone(),
        triangles: mesh.triangles.clone(),
        regions: mesh.regions.clone(),
        pieces: mesh
            .pieces
            .iter()
            .map(|piece| [piece.a, piece.b, piece.segment])
            .collect(),
        piece_markers: mesh.piece_markers.clone(),
        input_vertices: mesh.input_vertices,
        forced_pieces: mesh.forced_pieces,
        seams: mesh.seams.clone(),
    };
    // Lists of numbers cannot fail to serialise.
    let mut text = serde_json::to_string(&stored).unwrap_or_default();
    text.push('\n');
    text
}

/// Reads it back; complains where lists do not fit together.
pub fn parse(text: &str) -> Result<Mesh, Complaint> {
    let stored: Stored = serde_json::from_str(text).map_err(|error| Complaint {
        line: error.line().max(1),
        message: format!("not a mesh: {error}"),
    })?;
    let points = stored.points.len();
    let beyond = |corners: &[u32]| corners.iter().any(|k| *k as usize >= points);
    let fits = [
        (
            stored.points.as_flattened().iter().all(|x| x.is_finite()),
            "a coordinate is not finite",
        ),
        (
            stored.point_markers.len() == points,
            "points and point_markers differ in number",
        ),
        (
            stored.regions.len() == stored.triangles.len(),
            "triangles and regions differ in number",
        ),
        (
            stored.piece_markers.len() == stored.pieces.len(),
            "pieces and piece_markers differ in number",
        ),
        (
            stored.input_vertices <= points,
            "input_vertices is above the number of points",
        ),
        (
            !beyond(stored.triangles.as_flattened()),
            "a triangle names a vertex that does not exist",
        ),
        (
            !stored.pieces.iter().any(|[a, b, _]| beyond(&[*a, *b])),
            "a piece names a vertex that does not exist",
        ),
        (
            stored.seams.iter().all(|t| (*t as usize) < stored.triangles.len()),
            "seams name a triangle that does not exist",
        ),
    ];
    if let Some((_, message)) = fits.iter().find(|(fine, _)| !fine) {
        return Err(Complaint {
            line: 1,
            message: message.to_string(),
        });
    }
    Ok(Mesh {
        points: stored.points.into_iter().map(DVec2::from_array).collect(),
        point_markers: stored.point_markers,
        triangles: stored.triangles,
        regions: stored.regions,
        pieces: stored
            .pieces
            .into_iter()
            .map(|[a, b, segment]| Piece { a, b, segment })
            .collect(),
        piece_markers: stored.piece_markers,
        input_vertices: stored.input_vertices,
        forced_pieces: stored.forced_pieces,
        seams: stored.seams,
    })
}
