//! Two meshes of one domain side by side: whole, near a place, and how their triangles spread over smallest angles.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_png};
use super::mesh::{angle_bar, bounds, draw};
use super::panel::{Axis, Panel};
use super::style::{self, INK, TITLE};
use crate::geometry::{DVec2, Rect};
use crate::mesh::Mesh;
use crate::quality::shape::angles_deg;
use plotters::prelude::{Circle, DrawingBackend, Text};
use plotters::style::text_anchor::{HPos, VPos};
use std::path::Path;

/// Draws two meshes, each under its title, to `path` as PNG: whole; the part within `window`, where what differs can be
/// seen; and the histogram of the smallest angle of each triangle.
///
/// # Errors
/// [`ChartError`].
pub fn side_by_side(meshes: [(&str, &Mesh); 2], window: Rect, path: &Path) -> Result<(), ChartError> {
    write_png(&SideBySide { meshes, window }, path)
}

struct SideBySide<'a> {
    meshes: [(&'a str, &'a Mesh); 2],
    window: Rect,
}

/// Width of the drawing, heights of its rows, and the width of the colour bar, in pixels.
const HEAD: i32 = 36;
const WIDTH: i32 = 960;
const WHOLE: i32 = 400;
const PART: i32 = 430;
const HISTOGRAM: i32 = 280;
const SIDE: i32 = 120;

/// Radius of the ring around the place that is looked at, in pixels.
const MARK: i32 = 40;

impl Figure for SideBySide<'_> {
    fn size(&self) -> (u32, u32) {
        (WIDTH as u32, (HEAD + WHOLE + PART + HISTOGRAM) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((WIDTH - SIDE) * FINE);
        let all: Vec<f64> = self.meshes.iter().flat_map(|(_, mesh)| shares(mesh)).collect();
        let most = all.iter().copied().fold(1.0, f64::max);
        // On a logarithmic axis, so that a single bad triangle shows.
        let least = 0.7 * all.iter().copied().filter(|share| *share > 0.0).fold(most, f64::min);
        for ((title, mesh), column) in self.meshes.iter().zip(left.split_evenly((1, 2))) {
            let (head, rest) = column.split_vertically(HEAD * FINE);
            let (whole, rest) = rest.split_vertically(WHOLE * FINE);
            let (part, histogram) = rest.split_vertically(PART * FINE);
            let middle = (head.dim_in_pixel().0 as i32 / 2, 22 * FINE);
            let look = style::text(TITLE, INK, HPos::Center, VPos::Center);
            head.draw(&Text::new(title.to_string(), middle, look))?;
            draw(&whole, mesh, bounds(mesh))?;
            draw(&part, mesh, self.window)?;
            mark(&part)?;
            let x = Axis::linear("smallest angle (degrees)", 0.0..60.0, 6);
            let y = Axis::log("triangles (% a degree)", least..1.5 * most);
            let mut panel = Panel::new(&histogram, "", x, y, 60)?;
            let shares = shares(mesh);
            let steps = shares.iter().enumerate();
            let steps: Vec<_> = steps
                .map(|(k, share)| (k as f64, share.max(least)))
                .flat_map(|(k, share)| [(k, share), (k + 1.0, share)])
                .collect();
            panel.line(&steps, style::category(0), 3)?;
        }
        angle_bar(&right.split_vertically((HEAD + WHOLE) * FINE).0)
    }
}

/// A ring around the middle of the window.
fn mark<DB: DrawingBackend>(area: &Area<DB>) -> Drawn {
    let (width, height) = area.dim_in_pixel();
    let (middle, ring) = ((width as i32 / 2, height as i32 / 2), style::stroke(INK, 3));
    area.draw(&Circle::new(middle, MARK * FINE, ring))?;
    Ok(())
}

/// Share of triangles a degree of smallest angle, in percent.
fn shares(mesh: &Mesh) -> Vec<f64> {
    let mut shares = vec![0.0; 60];
    for t in 0..mesh.triangles.len() {
        let smallest = angles_deg(mesh.corners(t)).into_iter().fold(60.0, f64::min);
        shares[(smallest as usize).min(59)] += 100.0 / mesh.triangles.len() as f64;
    }
    shares
}

/// A window around a place, of the shape of the drawing, as wide as `width`.
pub fn window(place: DVec2, width: f64) -> Rect {
    let half = 0.5 * width * DVec2::new(1.0, f64::from(PART) / (0.5 * f64::from(WIDTH - SIDE)));
    Rect {
        min: place - half,
        max: place + half,
    }
}
