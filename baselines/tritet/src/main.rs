//! tritet, Shewchuk's Triangle from Rust, behind the protocol of ../../PROTOCOL.md.

#[path = "../../peer.rs"]
mod peer;

use peer::{Domain, Failure, Mesh, Size};
use std::process::ExitCode;
use tritet::{StrError, Trigen};

/// tritet hands Triangle an area with 15 digits behind the point: under this, fewer than six of them count.
const SMALLEST_AREA: f64 = 1e-9;

fn main() -> ExitCode {
    peer::serve("3.4.0 (Triangle 1.6)", mesh)
}

fn mesh(domain: &Domain, size: &Size, angle: f64) -> Result<Mesh, Failure> {
    if angle <= 0.0 {
        return Err(Failure::Declined(
            "tritet takes no angle for Triangle's own bound of 20 degrees: it cannot go without".into(),
        ));
    }
    let area = match *size {
        Size::AnglesAlone => None,
        Size::Uniform(edge) => Some(peer::equilateral_area(edge)),
        Size::Field => {
            return Err(Failure::Declined(
                "tritet takes one largest area, or one for a region: no size function".into(),
            ));
        }
    };
    if area.is_some_and(|area| area < SMALLEST_AREA) {
        return Err(Failure::Declined("tritet would round so small an area".into()));
    }
    refine(domain, area, angle).map_err(|message| Failure::Failed(message.to_string()))
}

fn refine(domain: &Domain, area: Option<f64>, angle: f64) -> Result<Mesh, StrError> {
    let holes = (!domain.holes.is_empty()).then_some(domain.holes.len());
    let mut trigen = Trigen::new(domain.points.len(), Some(domain.segments.len()), None, holes)?;
    for (k, &[x, y]) in domain.points.iter().enumerate() {
        trigen.set_point(k, 0, x, y)?;
    }
    for (k, &[a, b]) in domain.segments.iter().enumerate() {
        trigen.set_segment(k, 0, a, b)?;
    }
    for (k, &[x, y]) in domain.holes.iter().enumerate() {
        trigen.set_hole(k, x, y)?;
    }
    trigen.generate_mesh(false, false, true, area, Some(angle))?;
    let corners = (0..trigen.out_ncell()).map(|cell| [0, 1, 2].map(|m| trigen.out_cell_point(cell, m)));
    let point = |vertex| [trigen.out_point(vertex, 0), trigen.out_point(vertex, 1)];
    Ok(Mesh::compacted(corners, point, trigen.out_npoint()))
}
