//! Interpolation, its bounds, and the way from a file to a mesh.

use crate::domain::{Domain, gallery};
use crate::mesh::files;
use crate::spacing::from_mesh::field::*;
use crate::spacing::testing::{bitten, pseudo_random_points};
use crate::spacing::{Hessian, Options, build};

fn domain(name: &str) -> Domain {
    Domain::new(gallery::pslg(name).unwrap().unwrap()).unwrap()
}

#[test]
fn a_linear_function_is_itself_inside_and_that_of_the_nearest_point_outside() {
    let f = |x: DVec2| 2.0 + x.x - 0.5 * x.y;
    let square = domain("unit-square");
    let mesh = bitten(&square, "uniform:0.2", [0.25, 1.0]);
    let values: Vec<f64> = mesh.points.iter().map(|&x| f(x)).collect();
    let nodal = Nodal::new(&mesh, &values).unwrap();
    for x in pseudo_random_points(500).into_iter().chain(mesh.points.iter().copied()) {
        assert!((nodal.at(x) - f(x)).abs() < 1e-14);
        let outside = 3.0 * x - DVec2::ONE;
        assert!(
            (nodal.at(outside) - f(outside.clamp(DVec2::ZERO, DVec2::ONE))).abs() < 1e-10,
            "{outside}"
        );
    }
}

#[test]
fn cells_enclose_the_function_inside_outside_and_across() {
    for name in ["l-shape", "plate-hole", "two-arms"] {
        let domain = domain(name);
        let mesh = bitten(&domain, "lfs", [0.25, 0.75]);
        let size = domain.bounds().size();
        let wave = |x: DVec2| 2.0 + (9.0 * x.x / size.x).sin() * (7.0 * x.y / size.y).cos();
        let values: Vec<f64> = mesh.points.iter().map(|&x| wave(x)).collect();
        let nodal = Nodal::new(&mesh, &values).unwrap();
        let points = pseudo_random_points(600);
        for (k, pair) in points.windows(2).enumerate() {
            let x = domain.bounds().min + (1.2 * pair[0] - DVec2::splat(0.1)) * size;
            let width = size.max_element() * 0.5f64.powi(k as i32 % 14);
            let min = x - width * pair[1];
            let cell = Rect { min, max: min + width };
            let value = nodal.at(x);
            assert!(
                nodal.lower_bound(cell) <= value && value <= nodal.upper_bound(cell),
                "{name} {x} {cell:?}"
            );
            if k % 14 == 13 && domain.contains(x) {
                assert!(
                    nodal.upper_bound(cell) - nodal.lower_bound(cell) < 0.1,
                    "{name} {cell:?}"
                );
            }
        }
    }
}

#[test]
fn a_field_in_a_file_gives_nearly_the_spacing_of_its_formula() {
    let folder = tempfile::tempdir().unwrap();
    let square = domain("unit-square");
    let mesh = bitten(&square, "uniform:0.02", [0.25, 1.0]);
    let u = "exp(2*x)+x*y+y^2";
    let values: Vec<f64> = mesh
        .points
        .iter()
        .map(|x| (2.0 * x.x).exp() + x.x * x.y + x.y * x.y)
        .collect();
    let tolerance = Tolerance {
        eps: 1e-3,
        min: None,
        max: Some(0.2),
    };
    let exact = Hessian::new(u, &tolerance, square.bounds()).unwrap();
    for name in ["u.vtu", "u.node"] {
        let file = folder.path().join(name);
        files::write_with_values(&mesh, &values, &file).unwrap();
        assert_eq!(files::read_with_values(&file).unwrap().1, values);
        let spec = format!("field:{};eps=0.001;max=0.2", file.display());
        let options = Options {
            lfs_cap: false,
            ..Options::with_alpha(f64::INFINITY)
        };
        let built = build(&spec, &square, &options).unwrap();
        for x in pseudo_random_points(300) {
            let (found, expected) = (built.function.at(x), exact.at(x));
            assert!((found / expected - 1.0).abs() < 0.15, "{name} {x}: {found}, {expected}");
        }
        assert!(!bitten(&square, &spec, [0.25, 0.75]).triangles.is_empty());
    }
}

#[test]
fn files_without_values_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let square = domain("unit-square");
    let mesh = bitten(&square, "uniform:0.5", [0.25, 1.0]);
    let told = |name: &str| {
        let file = folder.path().join(name);
        files::write(&mesh, &file).unwrap();
        let spec = format!("field:{};eps=1", file.display());
        let message = build(&spec, &square, &Options::with_alpha(1.0))
            .err()
            .unwrap()
            .to_string();
        message.replace(&folder.path().display().to_string(), "")
    };
    for name in ["/bare.vtu", "/bare.node"] {
        let message = told(&name[1..]);
        assert!(
            message.contains("it has no values at its points: a .node needs an attribute"),
            "{message}"
        );
    }
    assert!(told("bare.obj").contains("no mesh format has this ending; known are .node, .ele, .vtu"));
}
