//! A mesher of one's own, judged by the certificate: `cargo run --release --example own_mesher` writes own_mesher.svg.
//!
//! It goes through the points of a fine grid and keeps each that is far enough from the boundary and from all kept before.
//! The Delaunay triangulation of the kept points is the mesh.

use biting::Case;
use biting::delaunay::triangulate;
use biting::domain::Domain;
use biting::geometry::DVec2;
use biting::mesh::{Mesh, Piece, files};
use biting::meshers::{MeshError, Mesher, Request, Trace};
use biting::spacing::Spacing;
use biting::theory::{Claim, Guarantee};
use std::error::Error;
use std::path::Path;

/// Keeps grid points that are far enough from all kept before.
struct Greedy {
    /// Grid points along the longer side of the domain's box.
    grid: usize,
}

impl Mesher for Greedy {
    /// What the certificate holds this method to, besides the structure of the mesh.
    fn guarantees(&self) -> Vec<Guarantee> {
        vec![Guarantee::always(Claim::ConstrainedDelaunay)]
    }

    fn mesh(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Mesh, MeshError> {
        let size = |x: DVec2| request.c_b * spacing.at(x);
        let mut points = domain.vertices().to_vec();
        let pieces = trace.step("boundary", || cut_segments(domain, &mut points, size));
        trace.step("interior", || self.fill(domain, &mut points, size));
        Ok(trace.step("triangulation", || triangulate(domain, points, pieces))?)
    }
}

impl Greedy {
    fn fill(&self, domain: &Domain, points: &mut Vec<DVec2>, size: impl Fn(DVec2) -> f64) {
        let bounds = domain.bounds();
        let extent = bounds.max - bounds.min;
        let step = extent.max_element() / self.grid as f64;
        for row in 0..=(extent.y / step) as usize {
            for column in 0..=(extent.x / step) as usize {
                let x = bounds.min + step * DVec2::new(column as f64, row as f64);
                let is_clear = domain.nearest_segment(x).1 >= 0.6 * size(x);
                if is_clear && domain.contains(x) && points.iter().all(|kept| kept.distance(x) >= size(x)) {
                    points.push(x);
                }
            }
        }
    }
}

/// Cuts each segment into equal pieces, none longer than the size at its middle.
fn cut_segments(domain: &Domain, points: &mut Vec<DVec2>, size: impl Fn(DVec2) -> f64) -> Vec<Piece> {
    let mut cuts = Vec::new();
    for segment in 0..domain.segments().len() {
        let [a, b] = domain.ends(segment);
        let count = (a.distance(b) / size(a.midpoint(b))).ceil().max(1.0);
        let mut on_segment = Vec::new();
        for k in 1..count as usize {
            let x = a.lerp(b, k as f64 / count);
            on_segment.push((a.distance(x), points.len() as u32));
            points.push(x);
        }
        cuts.push(on_segment);
    }
    Piece::chains(domain, cuts)
}

fn main() -> Result<(), Box<dyn Error>> {
    let ell = Domain::polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]])?;
    let case = Case::new(ell, "expr:0.05 + 0.2*sqrt((x-1)^2 + (y-1)^2)", 0.25, 0.75)?;
    let mesher = Greedy { grid: 300 };
    let mesh = case.mesh(&mesher)?;
    let (statistics, certificate) = case.judge_of(&mesh, &mesher);

    println!(
        "{} triangles, smallest angle {:.2}°",
        statistics.triangles, statistics.min_angle_deg
    );
    for check in &certificate.checks {
        let kind = if check.applies { "guaranteed" } else { "measured" };
        let verdict = if check.holds { "holds" } else { "does not hold" };
        println!("{kind:<10} {:<28} {verdict}", check.claim.to_string());
    }
    files::write(&mesh, Path::new("own_mesher.svg"))?;
    println!("wrote own_mesher.svg");
    Ok(())
}
