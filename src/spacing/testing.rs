//! Oracles and inputs for the tests of this folder.

use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::mesh::Mesh;
use crate::meshers::{Budget, Parameters, Request, Trace};
use crate::spacing::{Options, build};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// lfs straight from Definition 2.1: over all pairs of features that are not incident, the smallest of the larger
/// distance.
pub fn naive_lfs(vertices: &[DVec2], segments: &[[usize; 2]], x: DVec2) -> f64 {
    let mut features: Vec<([usize; 2], f64)> = Vec::new();
    for (index, vertex) in vertices.iter().enumerate() {
        features.push(([index, index], vertex.distance(x)));
    }
    for &[a, b] in segments {
        let (p, q) = (vertices[a], vertices[b]);
        let share = ((x - p).dot(q - p) / (q - p).length_squared()).clamp(0.0, 1.0);
        features.push(([a, b], p.lerp(q, share).distance(x)));
    }
    let mut lowest = f64::INFINITY;
    for (one, near) in &features {
        for (two, far) in &features {
            let is_incident = one.iter().any(|end| two.contains(end));
            if !is_incident {
                lowest = lowest.min(near.max(*far));
            }
        }
    }
    lowest
}

/// Points in the unit square, the same every time.
pub fn pseudo_random_points(count: usize) -> Vec<DVec2> {
    let mut random = Pcg64::seed_from_u64(7);
    (0..count).map(|_| random_point(&mut random)).collect()
}

fn random_point(random: &mut impl Rng) -> DVec2 {
    DVec2::new(random.random(), random.random())
}

/// A wheel with `teeth` of radius 1.1 on a disc of radius 1: many features of one size, four vertices per tooth.
pub fn gear(teeth: usize) -> (Vec<DVec2>, Vec<[usize; 2]>) {
    let count = 4 * teeth;
    let corner = |index: usize| {
        let radius = if index % 4 < 2 { 1.0 } else { 1.1 };
        radius * DVec2::from_angle(std::f64::consts::TAU * index as f64 / count as f64)
    };
    (
        (0..count).map(corner).collect(),
        (0..count).map(|index| [index, (index + 1) % count]).collect(),
    )
}

/// A gallery domain.
pub fn gallery(name: &str) -> Domain {
    crate::domain::gallery::domain(name).unwrap().unwrap()
}

/// Points of the domain, the same every time.
pub fn points_inside(domain: &Domain, count: usize) -> Vec<DVec2> {
    points_by(domain, count, 11)
}

/// The same for a seed.
pub fn points_by(domain: &Domain, count: usize, seed: u64) -> Vec<DVec2> {
    let bounds = domain.bounds();
    let mut random = Pcg64::seed_from_u64(seed);
    let anywhere = std::iter::repeat_with(|| bounds.min + random_point(&mut random) * bounds.size());
    anywhere.filter(|&x| domain.contains(x)).take(count).collect()
}

/// A mesh of `domain` by biting with its defaults, for a SPEC, t and c_b.
pub fn bitten(domain: &Domain, spec: &str, [t, c_b]: [f64; 2]) -> Mesh {
    let prepared = build(spec, domain, &Options::new(t, c_b)).unwrap_or_else(|error| panic!("{spec}: {error}"));
    let entry = crate::meshers::find("biting").expect("a mesher");
    let mesher = (entry.make)(&Parameters::new()).expect("defaults are valid");
    let request = Request {
        c_b,
        seed: 0,
        threads: 1,
        budget: Budget::default(),
    };
    let mesh = mesher.mesh(domain, &*prepared.function, &request, &mut Trace::default());
    mesh.unwrap_or_else(|error| panic!("{spec}: {error}"))
}
