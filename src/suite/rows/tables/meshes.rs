//! `meshes.csv`: what was asked for ([`super::asked`]), what came out, and what became of each claim ([`super::claims`]); a line a cell.

use super::asked::{asked, ended};
use super::claims::claims;
use super::column::{Column, exact, flag, number, rough};
use crate::quality::{Angles, Percentiles};
use crate::suite::fem::{Solution, Solver, Spectrum};
use crate::suite::rows::record::{Report, Row};
use std::collections::BTreeSet;

/// What the meshers of some rows count: these name columns.
pub(super) fn counted(rows: &[Row]) -> BTreeSet<&str> {
    let reports = rows.iter().filter_map(|row| row.report.as_ref());
    reports
        .flat_map(|report| report.counts.keys().map(String::as_str))
        .collect()
}

/// The columns where meshers count these.
pub(super) fn columns<'a>(counted: impl IntoIterator<Item = &'a str>) -> Vec<Column<Row>> {
    let mut all = asked();
    all.extend(ended());
    all.extend(hypotheses());
    all.extend(sizes());
    all.extend(angles());
    all.extend(claims());
    all.extend(counted.into_iter().map(count));
    all.extend(fronts());
    all.extend(poisson());
    all
}

fn count(name: &str) -> Column<Row> {
    let own = name.to_owned();
    of_mesh(
        &format!("count_{name}"),
        "a count that the mesher reports under that name",
        move |report| report.counts.get(&own).copied().map(number),
    )
}

/// A column that needs a mesh.
pub(super) fn of_mesh(name: &str, about: &str, value: impl Fn(&Report) -> Option<String> + 'static) -> Column<Row> {
    Column::new(name, about, move |row: &Row| value(row.report.as_ref()?))
}

/// A number of a mesh.
pub(super) fn measure(name: &str, about: &str, value: impl Fn(&Report) -> f64 + 'static) -> Column<Row> {
    of_mesh(name, about, move |report| Some(number(value(report))))
}

/// A number that not all meshes have.
pub(super) fn maybe(name: &str, about: &str, value: impl Fn(&Report) -> Option<f64> + 'static) -> Column<Row> {
    of_mesh(name, about, move |report| value(report).map(number))
}

/// What the theorems assume of the mesh at hand.
fn hypotheses() -> Vec<Column<Row>> {
    vec![
        Column::new(
            "tuned_c_b",
            "if triangles are wanted: c_b of the mesh, to the last bit; its t is t · tuned_c_b / c_b",
            |row: &Row| {
                let scaled = row.report.as_ref().filter(|_| row.cell.triangles.is_some())?;
                Some(exact(scaled.c_b))
            },
        ),
        of_mesh(
            "t_effective",
            "c_b times the proved Lipschitz constant of f, to the last bit: every bound uses it",
            |report| Some(exact(report.t_effective)),
        )
        .paper("§5"),
        measure(
            "smallest_input_angle_deg",
            "smallest angle between neighbouring segments that opens into the domain, degrees; 360 if none",
            |report| report.smallest_input_angle_deg,
        ),
        measure("smallest_segment_angle_deg", "the same, inside or outside", |report| {
            report.smallest_segment_angle_deg
        })
        .paper("§5.1"),
        measure(
            "low_head_on",
            "input segments bitten at their two vertices only, whose circles meet lower than (9)",
            |report| report.certificate.low_head_on as f64,
        )
        .paper("Lemma 6.4")
        .or("0"),
        measure(
            "forced_pieces",
            "boundary pieces that are not Delaunay edges",
            |report| report.forced_pieces as f64,
        )
        .or("0"),
    ]
}

/// Counts beside what the spacing asks for.
fn sizes() -> Vec<Column<Row>> {
    let edge = |name, about, value: fn(&Percentiles) -> f64| {
        maybe(name, about, move |report| {
            report.statistics.edge_over_size.as_ref().map(value)
        })
    };
    vec![
        measure("integral", "∫ dA / f² over the domain", |report| report.integral).paper("§5.3"),
        of_mesh("integral_error", "its estimated relative error, 3 digits", |report| {
            Some(rough(report.integral_error))
        }),
        measure("integral_lfs", "∫ dA / lfs² over the domain", |report| {
            report.integral_lfs
        }),
        measure(
            "size_efficiency",
            "triangles · (√3/4) c_b² / integral: 1 for equilateral triangles of edge c_b f",
            |report| report.size_efficiency,
        )
        .paper("Theorem 5.11"),
        edge(
            "edge_over_size_p05",
            "edge length / c_b f(midpoint), 5th percentile",
            |edge| edge.p05,
        ),
        edge("edge_over_size_p50", "the same, median", |edge| edge.p50),
        edge("edge_over_size_p95", "the same, 95th percentile", |edge| edge.p95),
        maybe(
            "nn_over_f_min",
            "distance to the nearest vertex over f, smallest at vertices; the worst value of `nn-vertex-lower` too",
            |report| Some(report.statistics.nn_over_f?.min),
        )
        .paper("Lemma 5.7"),
        maybe(
            "nn_over_f_max",
            "the same, largest; the worst value of `nn-vertex-upper` too",
            |report| Some(report.statistics.nn_over_f?.max),
        )
        .paper("Lemma 5.7"),
        maybe(
            "beta",
            "the β that the packing circles reach: no point has a larger gap to them; from below",
            |report| report.statistics.beta,
        )
        .paper("Definition 4.1"),
    ]
}

/// Angles, degrees.
fn angles() -> Vec<Column<Row>> {
    vec![
        measure("min_angle_bound_deg", "the bound of `min-angle`, degrees; 0 if there is none", |report| {
            report.min_angle_bound_deg
        })
        .paper("Theorem 6.8"),
        measure("min_angle_deg", "smallest angle of all triangles, degrees", |report| {
            report.statistics.min_angle_deg
        }),
        maybe("min_angle_free_deg", "the same without triangles that touch an input vertex with an inside angle under 60°; the worst value of `min-angle` and `min-angle-beyond-corners` too", |report| {
            report.statistics.min_angle_free_deg
        })
        .paper("Theorem 6.8"),
        measure("excused_triangles", "triangles that `min_angle_free_deg` leaves out", |report| {
            report.statistics.excused as f64
        })
        .or("0"),
        measure("max_angle_deg", "largest angle, degrees", |report| report.statistics.max_angle_deg),
        measure("mean_min_angle_deg", "mean over triangles of the smallest angle, degrees", |report| {
            report.statistics.mean_min_angle_deg
        }),
        measure("p05_min_angle_deg", "5th percentile over triangles of the smallest angle, degrees", |report| {
            report.statistics.p05_min_angle_deg
        }),
    ]
}

/// Angles where fronts met, and elsewhere.
fn fronts() -> Vec<Column<Row>> {
    type Side = fn(&Report) -> Option<Angles>;
    let sides: [(&str, &str, Side); 2] = [
        ("met", "where fronts met", |report| Some(report.statistics.seams?.met)),
        ("elsewhere", "where no fronts met", |report| {
            Some(report.statistics.seams?.elsewhere)
        }),
    ];
    let mut all = Vec::new();
    for (name, place, side) in sides {
        let mut add = |what: &str, about: &str, value: fn(Angles) -> f64| {
            let about = format!("{about} {place}");
            all.push(maybe(&format!("{name}_{what}"), &about, move |report| {
                side(report).map(value)
            }));
        };
        add("triangles", "triangles", |angles| angles.triangles as f64);
        add("min_angle_deg", "smallest angle, degrees,", |angles| angles.min_deg);
        add(
            "mean_min_angle_deg",
            "mean of the smallest angles, degrees,",
            |angles| angles.mean_deg,
        );
        add(
            "p05_min_angle_deg",
            "5th percentile of the smallest angles, degrees,",
            |angles| angles.p05_deg,
        );
        add(
            "share_under_30_deg",
            "share of triangles with an angle under 30°",
            |angles| angles.share_under_30,
        );
    }
    all
}

/// What came of the Poisson problem.
fn poisson() -> Vec<Column<Row>> {
    let of = |name, about, value: fn(&Solution) -> Option<String>| {
        of_mesh(name, about, move |report| value(report.poisson.as_ref()?))
    };
    let spectrum = |name, about, value: fn(&Spectrum) -> f64| {
        maybe(name, about, move |report| {
            report.poisson.as_ref()?.spectrum.as_ref().map(value)
        })
    };
    vec![
        of("poisson_unknowns", "free vertices", |solution| {
            Some(solution.unknowns.to_string())
        }),
        of("poisson_energy_error", "H1 seminorm of u − u_h", |solution| {
            Some(number(solution.energy_error))
        }),
        of("poisson_energy_norm", "H1 seminorm of u", |solution| {
            Some(number(solution.energy_norm))
        }),
        of("poisson_l2_error", "L2 norm of u − u_h", |solution| {
            Some(number(solution.l2_error))
        }),
        of("poisson_l2_norm", "L2 norm of u", |solution| {
            Some(number(solution.l2_norm))
        }),
        of("poisson_solver", "the source of u_h", |solution| {
            Some(solver_word(solution.solver).into())
        }),
        of("poisson_iterations", "iterations of conjugate gradients", |solution| {
            Some(solution.iterations.to_string())
        }),
        of("poisson_converged", "1 if they reached the residual", |solution| {
            Some(flag(solution.converged))
        }),
        spectrum(
            "poisson_largest",
            "largest eigenvalue of the stiffness matrix A",
            |spectrum| spectrum.largest,
        ),
        spectrum(
            "poisson_largest_preconditioned",
            "largest eigenvalue of A scaled by its diagonal",
            |spectrum| spectrum.largest_preconditioned,
        ),
        spectrum(
            "poisson_smallest_preconditioned",
            "its smallest eigenvalue",
            |spectrum| spectrum.smallest_preconditioned,
        ),
        of_mesh("poisson_failed", "why there is no solution", |report| {
            report.poisson_failed.clone()
        }),
    ]
}

/// The word of a solver.
pub(super) fn solver_word(solver: Solver) -> &'static str {
    match solver {
        Solver::Cholesky => "cholesky",
        Solver::ConjugateGradients => "conjugate-gradients",
    }
}
