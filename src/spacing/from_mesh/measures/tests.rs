//! el and nn by loops over all triangles and points, their bounds, and the constants of Lemma 2.2.

use crate::domain::{Domain, gallery};
use crate::mesh::files;
use crate::spacing::from_mesh::measures::*;
use crate::spacing::testing::{bitten, pseudo_random_points};
use crate::spacing::{Options, build};

/// Whether the triangle holds x, by signs of areas in plain arithmetic.
fn holds([a, b, c]: [DVec2; 3], x: DVec2) -> bool {
    let side = |p: DVec2, q: DVec2| (q - p).perp_dot(x - p);
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

fn longest([a, b, c]: [DVec2; 3]) -> f64 {
    a.distance(b).max(b.distance(c)).max(c.distance(a))
}

/// el straight from its definition; none outside the mesh.
fn naive_el(mesh: &Mesh, x: DVec2) -> Option<f64> {
    let all = (0..mesh.triangles.len()).map(|t| mesh.corners(t));
    all.filter(|corners| holds(*corners, x))
        .map(longest)
        .max_by(f64::total_cmp)
}

/// nn straight from its definition.
fn naive_nn(mesh: &Mesh, x: DVec2) -> f64 {
    let mut distances: Vec<f64> = mesh.points.iter().map(|point| point.distance(x)).collect();
    distances.sort_by(f64::total_cmp);
    distances[1]
}

fn square() -> Mesh {
    Mesh {
        points: vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y, DVec2::splat(7.0)],
        // One of them clockwise; the last point in no triangle.
        triangles: vec![[0, 1, 2], [0, 3, 2]],
        ..Mesh::default()
    }
}

#[test]
fn the_oracles_are_right_on_a_square() {
    let mesh = Mesh {
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..square()
    };
    assert_eq!(naive_el(&mesh, DVec2::splat(0.5)), Some(2f64.sqrt()));
    assert_eq!(naive_el(&mesh, DVec2::splat(1.5)), None);
    assert_eq!(naive_nn(&mesh, DVec2::ZERO), 1.0);
    assert_eq!(naive_nn(&mesh, DVec2::new(0.5, 0.0)), 0.5);
}

#[test]
fn a_square_of_two_triangles() {
    let (el, nn) = (
        EdgeLength::new(&square()).unwrap(),
        NearestNeighbour::new(&square()).unwrap(),
    );
    for x in [DVec2::ZERO, DVec2::new(0.25, 0.75), DVec2::new(-1.0, 3.0)] {
        assert_eq!(el.at(x), 2f64.sqrt());
    }
    assert_eq!((nn.at(DVec2::ZERO), nn.at(DVec2::new(0.5, 0.0))), (1.0, 0.5));
    let whole = Rect {
        min: DVec2::ZERO,
        max: DVec2::ONE,
    };
    assert_eq!(
        (el.lower_bound(whole), el.upper_bound(whole)),
        (2f64.sqrt(), 2f64.sqrt())
    );
    assert!((nn.lower_bound(whole) - 0.5).abs() < 1e-12);
}

#[test]
fn meshes_that_will_not_do_are_told() {
    let told = |points: Vec<DVec2>, triangles| {
        let mesh = Mesh {
            points,
            triangles,
            ..Mesh::default()
        };
        NearestNeighbour::new(&mesh).unwrap_err()
    };
    let corners = square().points;
    assert_eq!(told(corners.clone(), vec![]), "it has no triangles");
    let flat = vec![DVec2::ZERO, DVec2::X, 2.0 * DVec2::X];
    assert_eq!(told(flat, vec![[0, 1, 2]]), "triangle 0 has no area; repair the mesh");
    let double = vec![DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::X, DVec2::ONE];
    let message = told(double, vec![[0, 1, 2], [3, 4, 2]]);
    assert!(message.contains("has the place of another"), "{message}");
}

/// Meshes of the gallery: convex and not, with holes and small angles.
const DOMAINS: [&str; 5] = ["unit-square", "l-shape", "plate-hole", "star", "two-arms"];

fn mesh_of(name: &str) -> (Domain, Mesh) {
    let domain = Domain::new(gallery::pslg(name).unwrap().unwrap()).unwrap();
    let mesh = bitten(&domain, "lfs", [0.25, 0.75]);
    (domain, mesh)
}

#[test]
fn values_are_those_of_the_definitions_and_cells_enclose_them() {
    for name in DOMAINS {
        let (domain, mesh) = mesh_of(name);
        let (el, nn) = (EdgeLength::new(&mesh).unwrap(), NearestNeighbour::new(&mesh).unwrap());
        let bounds = domain.bounds();
        let vertices = mesh.points.iter().copied().take(50);
        let middles = mesh.triangles.iter().take(50).map(|t| {
            let [a, b] = [t[0], t[1]].map(|k| mesh.points[k as usize]);
            a.midpoint(b)
        });
        let spread = pseudo_random_points(300)
            .into_iter()
            .map(|p| bounds.min + p * bounds.size());
        for (k, x) in spread.chain(vertices).chain(middles).enumerate() {
            assert_eq!(nn.at(x), naive_nn(&mesh, x), "{name} {x}");
            if k < 350
                && let Some(expected) = naive_el(&mesh, x)
            {
                assert_eq!(el.at(x), expected, "{name} {x}");
            }
            // Cells of all sizes around it, not in its middle.
            let size = bounds.diagonal() * 0.5f64.powi(k as i32 % 12);
            let min = x - size * DVec2::new(0.3, 0.8);
            let cell = Rect { min, max: min + size };
            for spacing in [&el as &dyn Spacing, &nn] {
                let value = spacing.at(x);
                assert!(
                    spacing.lower_bound(cell) <= value && value <= spacing.upper_bound(cell),
                    "{name} {x} {cell:?}"
                );
            }
        }
    }
}

/// c₁ and c₂ of Lemma 2.2, on points of every triangle: corners, middles of edges, and inside.
#[test]
fn constants_of_lemma_2_2() {
    let mut most = 0.0f64;
    for name in DOMAINS {
        let (_, mesh) = mesh_of(name);
        let (el, nn) = (EdgeLength::new(&mesh).unwrap(), NearestNeighbour::new(&mesh).unwrap());
        let (mut low, mut high) = (f64::INFINITY, 0.0f64);
        for t in 0..mesh.triangles.len() {
            let corners = mesh.corners(t);
            for i in 0..=6 {
                for j in 0..=6 - i {
                    let weights = [i, j, 6 - i - j].map(|share| f64::from(share) / 6.0);
                    let x = (0..3).map(|k| weights[k] * corners[k]).sum::<DVec2>();
                    let ratio = nn.at(x) / el.at(x);
                    (low, high) = (low.min(ratio), high.max(ratio));
                }
            }
        }
        assert!((C_1[0]..C_1[1]).contains(&low), "{name}: {low}");
        most = most.max(high);
    }
    assert!((0.9..=1.0 + 1e-12).contains(&most), "{most}");
}

/// What the module's docs say of c₁.
const C_1: [f64; 2] = [0.19, 0.27];

#[test]
fn a_mesh_is_the_background_of_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("old.vtu");
    let (domain, mesh) = mesh_of("l-shape");
    files::write(&mesh, &file).unwrap();
    let options = Options::new(0.25, 0.75);
    for kind in ["nn", "el"] {
        let spec = format!("{kind}:{};factor=0.5", file.display());
        let prepared = build(&spec, &domain, &options).unwrap();
        assert_eq!(prepared.spec, spec);
        for x in pseudo_random_points(100) {
            let x = domain.bounds().min + x * domain.bounds().size();
            let own = match kind {
                "nn" => naive_nn(&mesh, x),
                _ => naive_el(&mesh, x).unwrap_or(f64::INFINITY),
            };
            assert!(!domain.contains(x) || prepared.function.at(x) <= 0.5 * own * (1.0 + 1e-12));
        }
        let finer = bitten(&domain, &spec, [0.25, 0.75]);
        assert!(finer.triangles.len() > mesh.triangles.len());
    }
    let told = build("nn:no/such.vtu", &domain, &options).err().unwrap().to_string();
    assert!(told.starts_with("spacing `nn:no/such.vtu`: no/such.vtu: "), "{told}");
}
