//! Drawings of meshes: triangles coloured by their smallest angle, and the input segments.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_png, write_svg};
use super::legend::colour_bar;
use super::style::{self, INK, SMALL, TITLE};
use crate::geometry::{DVec2, Rect};
use crate::mesh::Mesh;
use crate::quality::shape::angles_deg;
use plotters::prelude::{Color, DrawingBackend, PathElement, Polygon, RGBColor, Text};
use plotters::style::text_anchor::{HPos, VPos};
use std::collections::BTreeMap;
use std::path::Path;

/// Colours change every 5°: few enough to be told apart, and the picture stays small.
const BANDS: usize = 12;

/// Above this many triangles an SVG is larger than any reader wants.
const MOST_IN_SVG: usize = 20_000;

/// Draws `mesh` to `path`, as PNG or SVG by its ending. Each triangle has a colour for its smallest angle.
///
/// # Errors
/// [`ChartError`]; an SVG of more than 20 000 triangles is refused with the advice to draw a PNG.
pub fn draw_mesh(mesh: &Mesh, path: &Path) -> Result<(), ChartError> {
    let figure = Sheet {
        meshes: &[("", mesh)],
        width: WIDTH,
    };
    write(&figure, path)
}

/// The same, smaller: for a page of many.
///
/// # Errors
/// As [`draw_mesh`].
pub fn draw_small_mesh(mesh: &Mesh, path: &Path) -> Result<(), ChartError> {
    let figure = Sheet {
        meshes: &[("", mesh)],
        width: SMALL_WIDTH,
    };
    write(&figure, path)
}

/// Draws several meshes two by two, each under its title, to `path`, as PNG or SVG by its ending.
///
/// # Errors
/// As [`draw_mesh`].
pub fn draw_mesh_sheet(meshes: &[(&str, &Mesh)], path: &Path) -> Result<(), ChartError> {
    write(&Sheet { meshes, width: WIDTH }, path)
}

fn write(figure: &Sheet, path: &Path) -> Result<(), ChartError> {
    if path.extension().is_none_or(|ending| ending != "svg") {
        return write_png(figure, path);
    }
    let triangles: usize = figure.meshes.iter().map(|(_, mesh)| mesh.triangles.len()).sum();
    if triangles > MOST_IN_SVG {
        let advice = format!("{triangles} triangles make too large an SVG: ask for a .png");
        return Err(ChartError::Draw(advice));
    }
    write_svg(figure, path)
}

struct Sheet<'a> {
    meshes: &'a [(&'a str, &'a Mesh)],
    width: u32,
}

/// Widths of drawings, in pixels.
const WIDTH: u32 = 1200;
const SMALL_WIDTH: u32 = 760;

/// Room for the colour bar, in pixels.
const SIDE: u32 = 120;

impl Figure for Sheet<'_> {
    fn size(&self) -> (u32, u32) {
        match self.meshes {
            [(_, mesh)] => {
                let size = Rect::around(mesh.points.iter().copied()).size();
                let height = (self.width - SIDE) as f64 * size.y / size.x;
                // Also where a mesh is flat or has no points.
                (self.width, (height as u32).clamp(420, self.width - 100))
            }
            _ => (1200, 1080),
        }
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((self.width - SIDE) as i32 * FINE);
        match self.meshes {
            [(_, mesh)] => draw(&left, mesh, bounds(mesh))?,
            meshes => {
                let titles: Vec<&str> = meshes.iter().map(|mesh| mesh.0).collect();
                for (body, (_, mesh)) in under_titles(&left, &titles)?.iter().zip(meshes) {
                    draw(body, mesh, bounds(mesh))?;
                }
            }
        }
        angle_bar(&right)
    }
}

/// Draws titles, two by two, and returns the areas under them.
pub(super) fn under_titles<DB: DrawingBackend>(area: &Area<DB>, titles: &[&str]) -> Drawn<Vec<Area<DB>>> {
    let areas = area.split_evenly((titles.len().div_ceil(2), 2));
    let under = areas.iter().zip(titles).map(|(area, title)| {
        let (head, body) = area.split_vertically(36 * FINE);
        let middle = (head.dim_in_pixel().0 as i32 / 2, 22 * FINE);
        let look = style::text(TITLE, INK, HPos::Center, VPos::Center);
        head.draw(&Text::new(title.to_string(), middle, look))?;
        Ok(body)
    });
    under.collect()
}

/// What the colours mean.
pub(super) fn angle_bar<DB: DrawingBackend>(area: &Area<DB>) -> Drawn {
    let ticks: Vec<_> = (0..=6).map(|k| (f64::from(k) * 10.0, format!("{}°", k * 10))).collect();
    let words = style::text(SMALL, INK, HPos::Left, VPos::Center);
    for (line, word) in ["smallest", "angle"].into_iter().enumerate() {
        area.draw(&Text::new(
            word,
            (4 * FINE, (24 + 22 * line as i32) * FINE),
            words.clone(),
        ))?;
    }
    let (_, bar) = area.split_vertically(20 * FINE);
    colour_bar(&bar, "", 0.0..60.0, &ticks, BANDS)
}

/// The box around a mesh.
pub(super) fn bounds(mesh: &Mesh) -> Rect {
    Rect::around(mesh.points.iter().copied())
}

/// Shorter edges would hide the colours between them; drawing units.
const SHORTEST_EDGE: i32 = 5 * FINE;

/// Draws triangles, their edges where there is room for them, and the input segments: those wholly within `window`.
pub(super) fn draw<DB: DrawingBackend>(area: &Area<DB>, mesh: &Mesh, window: Rect) -> Drawn {
    let view = View::of(window, area.dim_in_pixel());
    let corners = (0..mesh.triangles.len()).map(|t| mesh.corners(t));
    for corners in corners.filter(|corners| corners.iter().all(|&point| window.contains(point))) {
        let places = corners.map(|point| view.place(point)).to_vec();
        let smallest = angles_deg(corners).into_iter().fold(60.0, f64::min);
        area.draw(&Polygon::new(places, band(smallest).filled()))?;
    }
    let edge = style::stroke(RGBColor(60, 60, 60), 1);
    let within = |ends: &[DVec2; 2]| ends.iter().all(|&end| window.contains(end));
    let points = |ends: [u32; 2]| ends.map(|v| mesh.points[v as usize]);
    let is_shown = |ends: &[u32; 2]| {
        let [(ax, ay), (bx, by)] = points(*ends).map(|end| view.place(end));
        within(&points(*ends)) && (ax - bx).abs().max((ay - by).abs()) >= SHORTEST_EDGE
    };
    let shown: Vec<[u32; 2]> = edges(mesh).into_iter().filter(is_shown).collect();
    for trail in trails(&shown) {
        let places: Vec<_> = trail.iter().map(|&v| view.place(mesh.points[v as usize])).collect();
        area.draw(&PathElement::new(places, edge))?;
    }
    let line = style::stroke(INK, FINE as u32 + 1);
    let pieces = mesh.pieces.iter().map(|piece| points([piece.a, piece.b]));
    for ends in pieces.filter(within) {
        let ends = ends.map(|end| view.place(end)).to_vec();
        area.draw(&PathElement::new(ends, line))?;
    }
    Ok(())
}

fn band(angle_deg: f64) -> RGBColor {
    let place = (angle_deg / 60.0 * BANDS as f64).floor().clamp(0.0, BANDS as f64 - 1.0);
    style::continuous((place + 0.5) / BANDS as f64)
}

/// Each edge once, sorted.
fn edges(mesh: &Mesh) -> Vec<[u32; 2]> {
    let sides = mesh.triangles.iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut edges: Vec<[u32; 2]> = sides.map(|[a, b]| [*a.min(b), *a.max(b)]).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Walks along edges, each edge in one of them: a drawing of walks is a fifth of the size of one of edges.
fn trails(edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut at: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (index, ends) in edges.iter().enumerate() {
        ends.iter().for_each(|&end| at.entry(end).or_default().push(index));
    }
    let mut walked = vec![false; edges.len()];
    let mut trails = Vec::new();
    for start in 0..edges.len() {
        if walked[start] {
            continue;
        }
        let mut trail = vec![edges[start][0]];
        let mut next = Some(start);
        while let Some(index) = next {
            walked[index] = true;
            let [a, b] = edges[index];
            let end = if trail.last() == Some(&a) { b } else { a };
            trail.push(end);
            let left = at.get_mut(&end);
            next = left.and_then(|left| {
                left.retain(|&index| !walked[index]);
                left.pop()
            });
        }
        trails.push(trail);
    }
    trails
}

/// From the plane to drawing units, y turned over, the same scale in both directions.
pub(super) struct View {
    centre: DVec2,
    middle: DVec2,
    scale: f64,
}

impl View {
    pub fn of(bounds: Rect, (width, height): (u32, u32)) -> Self {
        let room = DVec2::new(f64::from(width), f64::from(height));
        let margin = DVec2::splat(24.0 * f64::from(FINE));
        let size = bounds.size().max(DVec2::splat(f64::MIN_POSITIVE));
        Self {
            centre: bounds.centre(),
            middle: 0.5 * room,
            scale: ((room - margin) / size).min_element(),
        }
    }

    pub fn place(&self, point: DVec2) -> (i32, i32) {
        let moved = self.scale * (point - self.centre);
        (
            (self.middle.x + moved.x).round() as i32,
            (self.middle.y - moved.y).round() as i32,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trails_walk_along_every_edge_once() {
        // Two triangles that share an edge, and an edge apart.
        let edges = [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3], [7, 8]];
        let trails = trails(&edges);
        let mut walked: Vec<[u32; 2]> = trails
            .iter()
            .flat_map(|trail| {
                trail
                    .windows(2)
                    .map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])])
            })
            .collect();
        walked.sort_unstable();
        assert_eq!(walked, edges);
        assert!(trails.len() <= 3, "{trails:?}");
    }
}
