//! What the certificate does not see: the front's invariants, the modes, seams, opening up, the last resort.

use super::*;
use crate::domain::gallery;
use crate::meshers::Budget;
use crate::quality::{Certificate, Statistics, judge};
use crate::spacing::{Options, Prepared, build};

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

fn prepared(domain: &Domain, spec: &str) -> Prepared {
    let options = Options {
        lfs_cap: false,
        ..Options::with_alpha(0.5)
    };
    build(spec, domain, &options).expect("a spacing")
}

/// Meshes with c_b = 1 and has the structure judged.
fn meshed(method: &AdvancingFront, domain: &Domain, spec: &str) -> (Mesh, Statistics, Certificate, Trace) {
    let mut trace = Trace::default();
    let spacing = prepared(domain, spec).function;
    let mesh = method
        .mesh(domain, &*spacing, &request(1.0), &mut trace)
        .expect("a mesh");
    let (statistics, certificate) = judge(domain, &mesh, None);
    let is_broken = |check: &&crate::quality::Check| !check.holds && check.claim != "constrained-delaunay";
    let broken: Vec<_> = certificate.checks.iter().filter(is_broken).collect();
    assert!(broken.is_empty(), "{broken:#?}");
    (mesh, statistics, certificate, trace)
}

#[test]
fn a_uniform_square_is_mostly_equilateral() {
    let (_, statistics, ..) = meshed(&AdvancingFront::default(), &domain("unit-square"), "uniform:0.02");
    assert!(
        statistics.mean_min_angle_deg > 52.0,
        "{}",
        statistics.mean_min_angle_deg
    );
}
