//! `.svg`: a drawing of the edges and, thicker, of the input's segments; to look at, not to read back.

use crate::geometry::Rect;
use crate::mesh::Mesh;
use std::fmt::Write;

/// The longer side of the drawing, in user units.
const SIZE: f64 = 1000.0;

/// Draws every edge once, as a move and a line.
pub fn text(mesh: &Mesh) -> String {
    let frame = Rect::around(mesh.points.iter().copied());
    let extent = if mesh.points.is_empty() {
        glam::DVec2::ONE
    } else {
        frame.size()
    };
    let scale = SIZE / extent.max_element().max(f64::MIN_POSITIVE);
    let edges = mesh
        .adjacency()
        .edges()
        .iter()
        .map(|edge| edge.ends)
        .collect::<Vec<_>>();
    let mean = edges
        .iter()
        .map(|&[a, b]| mesh.points[a as usize].distance(mesh.points[b as usize]))
        .sum::<f64>()
        / edges.len().max(1) as f64;
    let thin = (0.05 * mean * scale).clamp(0.01, 1.0);
    let path = |lines: &mut dyn Iterator<Item = [u32; 2]>| {
        let mut path = String::new();
        for ends in lines {
            let [a, b] = ends.map(|k| (mesh.points[k as usize] - frame.min) * scale);
            let height = extent.y * scale;
            // Writing to a string cannot fail.
            let _ = write!(path, "M{:.3} {:.3}L{:.3} {:.3}", a.x, height - a.y, b.x, height - b.y);
        }
        path
    };
    let margin = 2.0 * thin + 1.0;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.3} {:.3} {:.3} {:.3}\" fill=\"none\" \
         stroke-linecap=\"round\">\n\
         <path stroke=\"#4477aa\" stroke-width=\"{thin:.4}\" d=\"{}\"/>\n\
         <path stroke=\"#000000\" stroke-width=\"{:.4}\" d=\"{}\"/>\n</svg>\n",
        -margin,
        -margin,
        extent.x * scale + 2.0 * margin,
        extent.y * scale + 2.0 * margin,
        path(&mut edges.iter().copied()),
        2.0 * thin,
        path(&mut mesh.pieces.iter().map(|piece| [piece.a, piece.b])),
    )
}
