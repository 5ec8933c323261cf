//! What is known of linear finite elements, held against what is measured.

use super::testing::{UNIT, dense, extremes_by_rotations, preconditioned, shaken, square, with_sliver};
use super::*;
use crate::geometry::DVec2;

fn named(name: &str) -> Problem {
    Problem::named(name, UNIT).unwrap()
}

/// u_h at the vertices of the mesh.
fn discrete(mesh: &Mesh, problem: &Problem) -> Vec<f64> {
    let elements = element::all(mesh).unwrap();
    let system = system::assemble(mesh, &elements, problem).unwrap();
    system.at_vertices(&direct::solve(&system.matrix, &system.load).unwrap())
}

/// A problem whose u is as good as linear on the unit square: a layer seen from so near that it is a slope.
const SLOPE: Problem = Problem::BoundaryLayer { wall: 0.0, width: 1e9 };

#[test]
fn errors_fall_as_theory_says() {
    // The named layers are thinner than meshes of a unit test resolve; wider ones have the same formulas.
    let layer = Problem::Layer {
        centre: DVec2::splat(-0.05),
        radius: 0.7,
        width: 0.1,
    };
    let peak = Problem::Peak {
        centre: DVec2::splat(0.25),
        width: 0.2,
    };
    let wall = Problem::BoundaryLayer { wall: 0.0, width: 0.2 };
    for (problem, coarse) in [(named("smooth"), 8), (layer, 32), (peak, 16), (wall, 16)] {
        let [one, two] = [coarse, 2 * coarse].map(|n| solve(&shaken(n), &problem).unwrap());
        let energy = (one.energy_error / two.energy_error).log2();
        let l2 = (one.l2_error / two.l2_error).log2();
        assert!((energy - 1.0).abs() < 0.1, "{problem:?}: energy order {energy}");
        assert!((l2 - 2.0).abs() < 0.2, "{problem:?}: L2 order {l2}");
    }
}

#[test]
fn a_reflex_corner_costs_a_third_of_the_order() {
    // The L as three of the square's quarters, with u's infinite gradient at the vertex in the middle.
    let [one, two] = [16, 32].map(|n| {
        let mut mesh = square(n);
        let points = mesh.points.clone();
        mesh.triangles.retain(|triangle| {
            let middle = triangle.iter().map(|v| points[*v as usize]).sum::<DVec2>() / 3.0;
            middle.min_element() < 0.5
        });
        solve(&mesh, &named("corner")).unwrap()
    });
    let order = (one.energy_error / two.energy_error).log2();
    assert!((order - 2.0 / 3.0).abs() < 0.05, "{order}");
    // |∇u|² = 4/9 r^(−2/3): six times 1/3 ∫ R(φ)^(4/3) dφ over an eighth of a turn, R = 1 / (2 cos φ).
    let step = std::f64::consts::FRAC_PI_4 / 1e5;
    let eighth: f64 = (0..100_000)
        .map(|k| step * (2.0 * (step * (f64::from(k) + 0.5)).cos()).powf(-4.0 / 3.0))
        .sum();
    let exact = (2.0 * eighth).sqrt();
    assert!(
        (one.energy_norm / exact - 1.0).abs() < 1e-4,
        "{} {exact}",
        one.energy_norm
    );
}

#[test]
fn norms_of_a_sine_are_those_of_calculus() {
    let found = solve(&square(16), &named("smooth")).unwrap();
    let pi = std::f64::consts::PI;
    assert!((found.l2_norm - 0.5).abs() < 1e-7);
    assert!((found.energy_norm - pi / 2f64.sqrt()).abs() < 1e-6);
    assert_eq!(
        (found.unknowns, found.solver, found.converged),
        (225, Solver::Cholesky, true)
    );
}

#[test]
fn a_linear_function_is_reproduced() {
    let mesh = shaken(9);
    for (x, value) in mesh.points.iter().zip(discrete(&mesh, &SLOPE)) {
        assert!((value - SLOPE.value(*x)).abs() < 1e-12, "{x}");
    }
    let found = solve(&mesh, &SLOPE).unwrap();
    assert!(found.energy_error < 1e-12 && found.l2_error < 1e-12, "{found:?}");
}

/// u_h − u is orthogonal to every function that is zero on the boundary, so that where u is one, the squares add up.
#[test]
fn energies_add_up_where_u_is_zero_on_the_boundary() {
    let (mesh, problem) = (shaken(12), named("smooth"));
    let nodal = discrete(&mesh, &problem);
    let of_discrete: f64 = element::all(&mesh)
        .unwrap()
        .iter()
        .map(|element| element.area * element.gradient(element.vertices.map(|v| nodal[v])).length_squared())
        .sum();
    let found = solve(&mesh, &problem).unwrap();
    let rest = found.energy_norm.powi(2) - of_discrete - found.energy_error.powi(2);
    assert!(rest.abs() < 1e-6 * found.energy_norm.powi(2), "{rest}");
}

#[test]
fn stiffness_takes_no_notice_of_constants_and_is_symmetric() {
    let mesh = shaken(7);
    for element in element::all(&mesh).unwrap() {
        for i in 0..3 {
            let sum: f64 = (0..3).map(|j| element.stiffness(i, j)).sum();
            assert!(sum.abs() < 1e-13 * element.stiffness(i, i));
        }
    }
    let matrix = dense(&mesh, &named("smooth"));
    assert_eq!(matrix.len(), 36);
    for (i, row) in matrix.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            assert_eq!(value.to_bits(), matrix[j][i].to_bits());
        }
    }
    // The middle vertex of four right triangles: the five-point stencil, whichever way they are cut.
    assert_eq!(dense(&square(2), &named("smooth")), [[4.0]]);
}

#[test]
fn the_dense_oracle_knows_the_second_difference() {
    let size = 12;
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    };
    let matrix = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
    let exact = |k: f64| 2.0 - 2.0 * (std::f64::consts::PI * k / 13.0).cos();
    let [low, high] = extremes_by_rotations(matrix);
    assert!((low - exact(1.0)).abs() < 1e-13 && (high - exact(12.0)).abs() < 1e-13);
}

#[test]
fn eigenvalues_are_those_of_the_dense_matrix() {
    for mesh in [square(2), shaken(7), with_sliver(1e-3)] {
        for name in ["smooth", "layer"] {
            let matrix = dense(&mesh, &named(name));
            let [low, high] = extremes_by_rotations(preconditioned(&matrix));
            let [_, largest] = extremes_by_rotations(matrix);
            let found = solve(&mesh, &named(name)).unwrap().spectrum.unwrap();
            assert!((found.largest / largest - 1.0).abs() < 1e-9, "{found:?} {largest}");
            assert!(
                (found.largest_preconditioned / high - 1.0).abs() < 1e-9,
                "{found:?} {high}"
            );
            assert!(
                (found.smallest_preconditioned / low - 1.0).abs() < 1e-5,
                "{found:?} {low}"
            );
            assert!(found.largest_preconditioned < 3.0);
        }
    }
}

#[test]
fn eigenvalues_of_a_large_square_are_those_of_its_stencil() {
    // All matrices of right triangles are the five-point stencil, with eigenvalues 4 − 2 cos(π i h) − 2 cos(π j h).
    let n = 60;
    let found = solve(&square(n), &named("layer")).unwrap().spectrum.unwrap();
    let cosine = (std::f64::consts::PI / f64::from(n)).cos();
    assert!((found.largest / (4.0 + 4.0 * cosine) - 1.0).abs() < 3e-4, "{found:?}");
    assert!(
        (found.smallest_preconditioned / (1.0 - cosine) - 1.0).abs() < 1e-4,
        "{found:?}"
    );
}

#[test]
fn iterations_grow_like_the_number_of_vertices_across() {
    let [one, two] = [16, 32].map(|n| solve(&shaken(n), &named("layer")).unwrap().iterations as f64);
    assert!((two / one - 2.0).abs() < 0.25, "{one} {two}");
}

/// The point of mesh quality: one triangle whose smallest angle halves doubles the largest eigenvalue.
#[test]
fn a_sliver_raises_the_largest_eigenvalue_like_one_over_its_angle() {
    let spectrum = |mesh: &Mesh| solve(mesh, &named("smooth")).unwrap().spectrum.unwrap();
    let good = spectrum(&square(8));
    let [thin, thinner] = [1e-3, 1e-5].map(|height| spectrum(&with_sliver(height)));
    assert!(thin.largest > 10.0 * good.largest, "{thin:?} {good:?}");
    assert!(
        (thinner.largest / thin.largest - 100.0).abs() < 10.0,
        "{thin:?} {thinner:?}"
    );
    // The diagonal hides it at the upper end; it comes out at the lower.
    assert!(thinner.largest_preconditioned < 3.0 && good.largest_preconditioned < 3.0);
    let ratio = thin.smallest_preconditioned / thinner.smallest_preconditioned;
    assert!((50.0..101.0).contains(&ratio), "{thin:?} {thinner:?}");
}

#[test]
fn conjugate_gradients_and_the_factorisation_agree() {
    let (mesh, problem) = (shaken(40), named("layer"));
    let elements = element::all(&mesh).unwrap();
    let system = system::assemble(&mesh, &elements, &problem).unwrap();
    let cg = krylov::ConjugateGradients::new(&system.matrix, &system.load);
    let iterated = cg.finish(RESIDUAL_OF_SOLUTION, ITERATIONS).unwrap();
    for (one, other) in iterated
        .iter()
        .zip(direct::solve(&system.matrix, &system.load).unwrap())
    {
        assert!((one - other).abs() < 1e-10);
    }
    let cg = krylov::ConjugateGradients::new(&system.matrix, &system.load);
    assert!(matches!(
        cg.finish(1e-12, 3),
        Err(FemError::NotConverged { iterations: 3, .. })
    ));
}

#[test]
fn the_same_bits_every_time_and_names_that_rows_can_hold() {
    let [one, two] = [0, 1].map(|_| serde_json::to_string(&solve(&shaken(20), &named("peak")).unwrap()).unwrap());
    assert_eq!(one, two);
    assert!(one.contains("\"solver\":\"cholesky\"") && one.contains("\"condition_preconditioned\":"));
    assert_eq!(
        serde_json::from_str::<Solution>(&one).unwrap(),
        solve(&shaken(20), &named("peak")).unwrap()
    );
}

/// Energies have no length in them, and L2 norms one: a domain of any size and place gives the same numbers.
#[test]
fn numbers_do_not_depend_on_size() {
    let at_one = solve(&shaken(10), &named("layer")).unwrap();
    for scale in [1e-6, 1e6] {
        let mut mesh = shaken(10);
        mesh.points.iter_mut().for_each(|point| *point *= scale);
        let bounds = crate::geometry::Rect::around(mesh.points.iter().copied());
        let found = solve(&mesh, &Problem::named("layer", bounds).unwrap()).unwrap();
        assert!((found.energy_error / at_one.energy_error - 1.0).abs() < 1e-9);
        assert!((found.l2_error / at_one.l2_error / scale - 1.0).abs() < 1e-9);
        assert_eq!(found.iterations, at_one.iterations);
    }
}

#[test]
fn vertices_without_triangles_change_nothing() {
    let plain = solve(&shaken(6), &named("layer")).unwrap();
    let mut mesh = shaken(6);
    mesh.points.insert(0, DVec2::NAN);
    mesh.points.push(DVec2::new(0.5, 7.0));
    mesh.triangles.iter_mut().flatten().for_each(|v| *v += 1);
    assert_eq!(solve(&mesh, &named("layer")).unwrap(), plain);
}

#[test]
fn without_a_free_vertex_there_is_still_an_error_to_measure() {
    let found = solve(&square(1), &named("layer")).unwrap();
    assert_eq!((found.unknowns, found.iterations, found.spectrum), (0, 0, None));
    assert!(found.converged && found.energy_error > 0.0);
}

#[test]
fn bad_meshes_are_told_with_the_triangle() {
    let failure = |spoil: fn(&mut Mesh)| {
        let mut mesh = square(3);
        spoil(&mut mesh);
        solve(&mesh, &named("smooth")).unwrap_err()
    };
    assert_eq!(failure(|mesh| mesh.triangles.clear()), FemError::Empty);
    let turned = failure(|mesh| mesh.triangles[7].swap(0, 1));
    assert!(matches!(turned, FemError::Degenerate { triangle: 7, double_area } if double_area < 0.0));
    assert!(
        turned
            .to_string()
            .starts_with("triangle 7 is turned over or degenerate: twice its area is -1.1")
    );
    let flat = failure(|mesh| mesh.triangles[2] = [0, 1, 2]);
    assert_eq!(
        flat,
        FemError::Degenerate {
            triangle: 2,
            double_area: 0.0
        }
    );
    let nowhere = failure(|mesh| mesh.points[5] = DVec2::NAN);
    assert!(matches!(nowhere, FemError::Degenerate { .. }));
    let far = failure(|mesh| mesh.points[15] = DVec2::INFINITY);
    assert!(matches!(far, FemError::Degenerate { .. }));
    let unknown = failure(|mesh| mesh.triangles[4][2] = 16);
    assert_eq!(
        unknown,
        FemError::UnknownVertex {
            triangle: 4,
            vertex: 16,
            vertices: 16
        }
    );
    let twice = failure(|mesh| mesh.triangles.push(mesh.triangles[0]));
    assert!(matches!(twice, FemError::NotManifold { .. }));
}

#[test]
fn a_problem_that_is_not_finite_is_told() {
    let centre = DVec2::splat(0.3);
    for problem in [
        Problem::Peak { centre, width: 0.0 },
        Problem::BoundaryLayer { wall: 0.5, width: 1e-3 },
        Problem::Layer {
            centre: DVec2::NAN,
            radius: 0.25,
            width: 0.1,
        },
    ] {
        let found = solve(&square(4), &problem);
        assert!(matches!(found, Err(FemError::NotFinite { .. })), "{found:?}");
    }
}
