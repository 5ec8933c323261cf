//! Quadratics as they are, and the order in which the rest converges.

use crate::domain::{Domain, gallery};
use crate::mesh::Mesh;
use crate::spacing::from_mesh::field::recovered_eigenvalues;
use crate::spacing::from_mesh::recover::*;
use crate::spacing::testing::bitten;

fn domain(name: &str) -> Domain {
    Domain::new(gallery::pslg(name).unwrap().unwrap()).unwrap()
}

fn recovered(mesh: &Mesh, u: impl Fn(DVec2) -> f64) -> Vec<(DVec2, [f64; 3])> {
    let (old, _) = OldMesh::new(mesh).unwrap();
    let values: Vec<f64> = old.points.iter().map(|&x| u(x)).collect();
    let found = hessians(&old, &values).unwrap();
    old.points.iter().copied().zip(found).collect()
}

#[test]
fn a_quadratic_is_recovered_as_it_is_everywhere() {
    let u = |x: DVec2| 1e3 + 7.0 * x.x - x.y + 3.0 * x.x * x.x - 4.0 * x.x * x.y + 0.5 * x.y * x.y;
    for name in ["unit-square", "l-shape", "star", "plate-hole"] {
        let mesh = bitten(&domain(name), "lfs", [0.25, 0.75]);
        for (x, found) in recovered(&mesh, u) {
            for (found, expected) in found.into_iter().zip([6.0, -4.0, 1.0]) {
                assert!((found - expected).abs() < 1e-5, "{name} {x}: {found} {expected}");
            }
        }
    }
}

#[test]
fn patches_that_lie_on_a_line_grow_and_meshes_of_few_vertices_are_told() {
    let strip = |count: u32| Mesh {
        points: (0..2 * count)
            .map(|k| DVec2::new(f64::from(k / 2), f64::from(k % 2)))
            .collect(),
        triangles: (0..count - 1)
            .flat_map(|k| [[2 * k, 2 * k + 2, 2 * k + 1], [2 * k + 1, 2 * k + 2, 2 * k + 3]])
            .collect(),
        ..Mesh::default()
    };
    // Two rows cannot tell y² from y: that coefficient is left out, the others are found.
    for (_, found) in recovered(&strip(9), |x| x.x * x.x + x.x * x.y) {
        assert!(
            (found[0] - 2.0).abs() < 1e-9 && (found[1] - 1.0).abs() < 1e-9 && found[2] == 0.0,
            "{found:?}"
        );
    }
    let told = recovered_eigenvalues(&strip(2), &[0.0; 4]).unwrap_err();
    assert_eq!(told, "it has 4 vertices; second derivatives need 6 or more");
}

/// Root mean square over the vertices of the error of |λ|max, relative to its largest value, for edges of about `h`.
fn error(h: f64) -> f64 {
    let mesh = bitten(&domain("unit-square"), &format!("uniform:{h}"), [0.25, 1.0]);
    let values: Vec<f64> = mesh
        .points
        .iter()
        .map(|x| (3.0 * x.x).sin() * (2.0 * x.y).cos())
        .collect();
    let found = recovered_eigenvalues(&mesh, &values).unwrap();
    // H = −[[9, 0], [0, 4]] u off the diagonal −6 cos 3x sin 2y.
    let exact = |x: DVec2| {
        let (u, off) = (
            (3.0 * x.x).sin() * (2.0 * x.y).cos(),
            -6.0 * (3.0 * x.x).cos() * (2.0 * x.y).sin(),
        );
        (6.5 * u).abs() + (2.5 * u).hypot(off)
    };
    let squares = mesh
        .points
        .iter()
        .zip(found)
        .map(|(&x, found)| (found - exact(x)).powi(2));
    (squares.sum::<f64>() / mesh.points.len() as f64).sqrt() / 9.0
}

#[test]
fn the_largest_eigenvalue_converges() {
    let errors = [0.1, 0.05, 0.025, 0.0125].map(error);
    let orders: Vec<f64> = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
    assert!(orders.iter().all(|order| *order > 1.5), "{orders:?}");
    assert!(errors[3] < 0.004, "{errors:?}");
}
