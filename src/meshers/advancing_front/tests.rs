//! What the certificate does not check; in this file whole meshes, their boundary and their seams.

use super::*;
use crate::domain::gallery;
use crate::mesh::Piece;
use crate::meshers::Budget;
use crate::quality::{Certificate, Statistics, judge};
use crate::spacing::{ControlSpacing, Options, build};
use crate::theory::Claim;
use proptest::prelude::*;

mod front;
mod modes;
mod refusals;

fn request(c_b: f64) -> Request {
    Request {
        c_b,
        seed: 0,
        threads: 1,
        budget: Budget {
            max_vertices: Some(200_000),
            ..Budget::default()
        },
    }
}

fn domain(name: &str) -> Domain {
    gallery::domain(name).expect("a gallery name").expect("a valid domain")
}

fn prepared(domain: &Domain, spec: &str) -> ControlSpacing {
    let options = Options {
        lfs_cap: false,
        ..Options::with_alpha(0.5)
    };
    build(spec, domain, &options).expect("a spacing")
}

/// Meshes with c_b = 1, and checks the structure.
fn meshed(method: &AdvancingFront, domain: &Domain, spec: &str) -> (Mesh, Statistics, Certificate, Trace) {
    let mut trace = Trace::default();
    let spacing = prepared(domain, spec).function;
    let mesh = method
        .mesh(domain, &*spacing, &request(1.0), &mut trace)
        .expect("a mesh");
    let (statistics, certificate) = assert_is_mesh(domain, &mesh);
    (mesh, statistics, certificate, trace)
}

const ROWS: AdvancingFront = AdvancingFront {
    advance: Advance::Row,
    ..AdvancingFront::DEFAULT
};

fn counted(trace: &Trace, name: &str) -> f64 {
    trace
        .counts
        .iter()
        .find(|(known, _)| *known == name)
        .expect("a count")
        .1
}

/// Calls `with` with the front of a domain that has advanced `steps` faces, and the pieces of the boundary.
fn advanced<T>(
    method: &AdvancingFront,
    domain: &Domain,
    spec: &str,
    steps: usize,
    with: impl FnOnce(Front, Vec<Piece>) -> T,
) -> T {
    let spacing = prepared(domain, spec).function;
    let request = request(1.0);
    let sizing = Sizing::new(domain, &*spacing, &request);
    let mut front = Front::new(method, domain, sizing, Monitor::new(&request.budget));
    let pieces = boundary::boundary(&mut front).expect("a boundary");
    for _ in 0..steps {
        if let Some(face) = front.pick_face() {
            advance_face(&mut front, &face).expect("a step");
        }
    }
    with(front, pieces)
}

fn assert_is_mesh(domain: &Domain, mesh: &Mesh) -> (Statistics, Certificate) {
    let (statistics, certificate) = judge(domain, mesh, None);
    let is_broken = |check: &&crate::quality::Check| !check.holds && check.claim != Claim::ConstrainedDelaunay;
    let broken: Vec<_> = certificate.checks.iter().filter(is_broken).collect();
    assert!(broken.is_empty(), "{broken:#?}");
    (statistics, certificate)
}

/// Found on the slanted sides of `two-arms`: a new side ran along three nodes that rounding had put on one line. The
/// middle node did not see the side on which it lay, and triangles of 0° filled what was left.
#[test]
fn a_side_along_three_collinear_nodes_is_no_side() {
    let domain = domain("two-arms");
    let spacing = build("lfs", &domain, &Options::new(0.5, 0.6))
        .expect("a spacing")
        .function;
    let mut trace = Trace::default();
    let mesh = AdvancingFront::DEFAULT.mesh(&domain, &*spacing, &request(0.6), &mut trace);
    let (statistics, _) = assert_is_mesh(&domain, &mesh.expect("a mesh"));
    assert_eq!(counted(&trace, "closed_by_force"), 0.0);
    assert!(statistics.min_angle_deg > 5.0, "{}", statistics.min_angle_deg);
}

#[test]
fn segments_are_cut_into_equal_parts_of_the_integral() {
    let domain = domain("unit-square");
    // On the lower side the integral of 1 / (0.1 + 0.1 x) is 10 ln 2 = 6.93: 7 pieces, each a seventh of it.
    advanced(&AdvancingFront::DEFAULT, &domain, "expr: 0.1 + 0.1*x", 0, |front, _| {
        let mut xs: Vec<f64> = front
            .nodes
            .iter()
            .map(|node| node.at)
            .filter(|p| p.y == 0.0)
            .map(|p| p.x)
            .collect();
        xs.sort_by(f64::total_cmp);
        assert_eq!(xs.len(), 8);
        for (k, x) in xs.into_iter().enumerate() {
            let expected = 2f64.powf(k as f64 / 7.0) - 1.0;
            assert!((x - expected).abs() < 2e-3, "{x} is not {expected}");
        }
    });
}

#[test]
fn fronts_of_a_ring_meet_in_its_middle() {
    let domain = domain("annulus");
    let (mesh, ..) = meshed(&AdvancingFront::DEFAULT, &domain, "uniform:0.02");
    let radii: Vec<f64> = mesh
        .points
        .iter()
        .map(|p| p.distance(domain.bounds().centre()))
        .collect();
    let (low, high) = (
        radii.iter().copied().fold(f64::INFINITY, f64::min),
        radii.iter().copied().fold(0.0, f64::max),
    );
    assert!(
        !mesh.seams.is_empty() && mesh.seams.len() < mesh.triangles.len() / 2,
        "{}",
        mesh.seams.len()
    );
    assert!(mesh.seams.windows(2).all(|pair| pair[0] < pair[1]));
    let near_boundary = mesh.seams.iter().filter(|&&t| {
        let corners = mesh.triangles[t as usize];
        corners
            .iter()
            .any(|&corner| radii[corner as usize] < low + 1e-9 || radii[corner as usize] > high - 1e-9)
    });
    assert!(
        near_boundary.count() * 4 < mesh.seams.len(),
        "fronts meet away from the boundary"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Any domain, any size: much larger than the features, much smaller, steeply graded.
    #[test]
    fn every_mesh_is_valid(
        seed in 0..1000u32,
        corners in 4..24usize,
        low in 0.01..0.5f64,
        slope in 0.0..0.5f64,
        by_rows in any::<bool>(),
        centre in (0.0..1.0f64, 0.0..1.0f64),
    ) {
        let domain = domain(&format!("random-simple:n={corners},seed={seed}"));
        let spec = format!("expr: {low} + {slope}*sqrt((x-{})^2 + (y-{})^2 + 0.0001)", centre.0, centre.1);
        let method = if by_rows { ROWS } else { AdvancingFront::DEFAULT };
        let (mesh, ..) = meshed(&method, &domain, &spec);
        prop_assert!(!mesh.triangles.is_empty());
    }
}
