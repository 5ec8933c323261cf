//! `meshes.csv`: what was asked for, what came out, and the worst value of each claim; a line a cell.

use super::column::{Column, exact, flag, number};
use crate::quality::{Angles, Check, Percentiles};
use crate::suite::fem::{Solution, Solver, Spectrum};
use crate::suite::rows::record::{Outcome, Report, Row, Try, parameter_text};
use crate::theory::Claim;
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
        "what the mesher counts of itself under that name",
        move |report| report.counts.get(&own).copied().map(number),
    )
}

/// A column that needs a mesh.
fn of_mesh(name: &str, about: &str, value: impl Fn(&Report) -> Option<String> + 'static) -> Column<Row> {
    Column::new(name, about, move |row: &Row| value(row.report.as_ref()?))
}

/// A number of a mesh.
fn measure(name: &str, about: &str, value: impl Fn(&Report) -> f64 + 'static) -> Column<Row> {
    of_mesh(name, about, move |report| Some(number(value(report))))
}

/// A number that not all meshes have.
fn maybe(name: &str, about: &str, value: impl Fn(&Report) -> Option<f64> + 'static) -> Column<Row> {
    of_mesh(name, about, move |report| value(report).map(number))
}

/// What a cell asks for, to the last bit.
fn asked() -> Vec<Column<Row>> {
    let column = |name, about, value: fn(&Row) -> Option<String>| Column::new(name, about, value);
    vec![
        column("key", "identifies the cell in every table: all it asks for", |row| {
            Some(row.key.clone())
        }),
        column("group", "the plan's group of cells", |row| Some(row.group.clone())),
        column("domain", "gallery name or file", |row| Some(row.cell.domain.clone())),
        column(
            "spacing",
            "f as asked for, before it is capped by lfs and limited",
            |row| Some(row.cell.spacing.clone()),
        )
        .paper("§2"),
        column("mesher", "its name, ours or a peer's", |row| {
            Some(row.cell.mesher.clone())
        }),
        column(
            "params",
            "those of the mesher's parameters that differ from their defaults",
            params,
        ),
        column("t", "α c_b as asked for, to the last bit", |row| {
            Some(exact(row.cell.t))
        })
        .paper("§5"),
        column("c_b", "biting constant as asked for, to the last bit", |row| {
            Some(exact(row.cell.c_b))
        })
        .paper("§5"),
        column("seed", "of random choices", |row| Some(row.cell.seed.to_string())).or("0"),
        column("lfs_cap", "1 where f is capped by lfs, so that f ≤ lfs", |row| {
            Some(flag(row.cell.lfs_cap))
        })
        .paper("§5")
        .or("1"),
        column(
            "wanted_triangles",
            "triangles the mesh shall have: c_b is scaled for it, f staying as it is",
            |row| Some(row.cell.triangles?.to_string()),
        ),
        column("threads", "threads the mesher may use", |row| {
            Some(row.cell.threads.to_string())
        })
        .or("1"),
        column("problem", "Poisson problem that is solved on the mesh", |row| {
            row.cell.poisson.clone()
        }),
        column(
            "adapt_eps",
            "error of linear interpolation that f is adapted to, in the unit of u",
            |row| Some(exact(row.cell.adapt?.eps)),
        )
        .paper("§2.2"),
        column("adapt_rounds", "most rounds of adaptation", |row| {
            Some(row.cell.adapt?.rounds.to_string())
        }),
        column("adapt_sample", "1 where the Hessian is that of u itself", |row| {
            Some(flag(row.cell.adapt?.sample))
        })
        .or("0"),
        column(
            "timed",
            "1 where the cell runs alone and repeated: `times.csv` has its times",
            |row| Some(flag(row.cell.timed)),
        )
        .or("0"),
    ]
}

fn params(row: &Row) -> Option<String> {
    let params = row.cell.params.iter();
    let params: Vec<String> = params
        .map(|(name, value)| format!("{name}={}", parameter_text(value)))
        .collect();
    (!params.is_empty()).then(|| params.join(","))
}

/// How the cell ended.
fn ended() -> Vec<Column<Row>> {
    vec![
        Column::new("outcome", "measured, declined, failed or skipped", |row: &Row| {
            Some(outcome_word(row.outcome).into())
        }),
        Column::new("reason", "why it is not measured", |row: &Row| row.reason.clone()),
        Column::new(
            "estimated_triangles",
            "where there is no mesh: triangles expected, from ∫ dA / f²",
            |row: &Row| row.report.is_none().then(|| number(row.estimated_triangles)),
        ),
        Column::new(
            "tries",
            "where triangles are wanted: each c_b tried, `c_b:triangles`, the last part empty where there was no mesh",
            tries,
        ),
        of_mesh("peer_version", "version of a mesher outside this crate", |report| {
            Some(report.outside.as_ref()?.version.clone())
        }),
        of_mesh("fingerprint", "hash of points and triangles, bit by bit", |report| {
            Some(report.fingerprint.clone())
        }),
        measure(
            "vertices",
            "of the mesh; the worst value of `vertices-lower` too",
            |report| report.statistics.vertices as f64,
        ),
        measure("triangles", "of the mesh", |report| report.statistics.triangles as f64),
        of_mesh("holds", "1 where every check that applies holds", |report| {
            Some(flag(report.certificate.holds))
        }),
    ]
}

/// The word of an outcome.
pub(super) fn outcome_word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Measured => "measured",
        Outcome::Skipped => "skipped",
        Outcome::Declined => "declined",
        Outcome::Failed => "failed",
    }
}

fn tries(row: &Row) -> Option<String> {
    let one = |tried: &Try| {
        let triangles = tried.triangles.map(|count| count.to_string()).unwrap_or_default();
        format!("{}:{triangles}", number(tried.c_b))
    };
    let all: Vec<String> = row.tries.iter().map(one).collect();
    (!all.is_empty()).then(|| all.join(" "))
}

/// What the theorems assume of the mesh at hand.
fn hypotheses() -> Vec<Column<Row>> {
    vec![
        Column::new(
            "tuned_c_b",
            "where triangles are wanted: c_b of the mesh, to the last bit; its t is t · tuned_c_b / c_b",
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
        measure(
            "smallest_segment_angle_deg",
            "the same on any side, inside or out",
            |report| report.smallest_segment_angle_deg,
        )
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
            "boundary pieces that are no Delaunay edges",
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
        measure("integral_error", "its estimated relative error", |report| {
            report.integral_error
        }),
        measure("integral_lfs", "∫ dA / lfs² over the domain", |report| {
            report.integral_lfs
        }),
        measure("size_ratio", "triangles / integral", |report| report.size_ratio).paper("Theorem 5.11"),
        measure(
            "size_efficiency",
            "triangles · (√3/4) c_b² / integral: 1 for equilateral triangles of edge c_b f",
            |report| report.size_efficiency,
        ),
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
        measure("min_angle_bound_deg", "what `min-angle` is held against, degrees; 0 where there is no bound", |report| {
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

/// The claims whose worst value is a column of its own, with what it is and what it is where the column is left out. That of the
/// others is another column: [`worst_elsewhere`].
const WORST: [(Claim, &str, Option<&str>); 15] = [
    (
        Claim::PositiveOrientation,
        "smallest signed area of a triangle, in the domain's unit squared",
        None,
    ),
    (
        Claim::Area,
        "relative difference of the triangles' areas and the domain's",
        None,
    ),
    (Claim::VerticesUsed, "mesh vertices in no triangle", Some("0")),
    (
        Claim::InputVertices,
        "input vertices that are no mesh vertices",
        Some("0"),
    ),
    (
        Claim::InputSegments,
        "input segments that are no chains of mesh edges",
        Some("0"),
    ),
    (Claim::ManifoldEdges, "most triangles at an edge", Some("2")),
    (
        Claim::BoundaryOnSegments,
        "edges of one triangle on no input segment",
        Some("0"),
    ),
    (
        Claim::ConstrainedDelaunay,
        "opposite angles above 180°, degrees",
        Some("0"),
    ),
    (
        Claim::PackingDisjoint,
        "‖x − y‖ over the sum of the two packing radii, smallest",
        None,
    ),
    (
        Claim::Coverage,
        "largest part left uncovered, of a circle in radians, of a segment as a share of it; by the rule of the later point the largest distance to the nearest vertex over c_b f",
        None,
    ),
    (
        Claim::BoundaryHeight,
        "height over radius at which circles of neighbouring boundary vertices meet, smallest",
        None,
    ),
    (
        Claim::CornerAngles,
        "angle of a triangle at an input angle under 60° over that angle, smallest",
        None,
    ),
    (
        Claim::NnPointLower,
        "distance to the second nearest vertex over f, smallest at midpoints and circumcentres",
        None,
    ),
    (Claim::NnPointUpper, "the same, largest", None),
    (
        Claim::VerticesUpper,
        "vertices by share of their packing circle in the domain",
        None,
    ),
];

/// The worst value of a claim that is another column.
pub(super) fn worst_elsewhere(claim: Claim) -> Option<&'static str> {
    match claim {
        Claim::MinAngle | Claim::MinAngleBeyondCorners => Some("min_angle_free_deg"),
        Claim::NnVertexLower => Some("nn_over_f_min"),
        Claim::NnVertexUpper => Some("nn_over_f_max"),
        Claim::VerticesLower => Some("vertices"),
        _ => None,
    }
}

/// The column of a claim's worst value.
pub(super) fn worst_column(claim: Claim) -> String {
    worst_elsewhere(claim).map_or_else(|| format!("worst_{}", snake(claim)), str::to_owned)
}

/// The column that says in how many places a claim is broken.
pub(super) fn broken_column(claim: Claim) -> String {
    format!("broken_{}", snake(claim))
}

/// The column that says whether a claim applies.
pub(super) fn applies_column(claim: Claim) -> String {
    format!("applies_{}", snake(claim))
}

fn snake(claim: Claim) -> String {
    claim.name().replace('-', "_")
}

/// The worst value of a claim where its column is left out.
pub(super) fn worst_default(claim: Claim) -> Option<f64> {
    let (.., default) = WORST.iter().find(|(known, ..)| *known == claim)?;
    default.and_then(|text| text.parse().ok())
}

/// The worst value of each claim, in how many places it is broken, and whether it applies.
fn claims() -> Vec<Column<Row>> {
    fn check(report: &Report, claim: Claim) -> Option<&Check> {
        report.certificate.check(claim)
    }
    let worst = WORST.iter().map(|&(claim, about, default)| {
        let about = format!("worst value of `{claim}`: {about}");
        maybe(&worst_column(claim), &about, move |report| check(report, claim)?.worst)
            .paper(claim.lemma())
            .or(default)
    });
    let applies = Claim::ALL.into_iter().map(|claim| {
        let about =
            format!("1 where the method guarantees `{claim}` and its hypotheses hold; else it is only measured");
        of_mesh(&applies_column(claim), &about, move |report| {
            Some(flag(check(report, claim)?.applies))
        })
        .or("1")
    });
    let broken = Claim::ALL.into_iter().map(|claim| {
        let about = format!("in how many places `{claim}` does not hold: 0 where it holds");
        of_mesh(&broken_column(claim), &about, move |report| {
            Some(check(report, claim)?.broken.to_string())
        })
        .or("0")
    });
    worst.chain(broken).chain(applies).collect()
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
        of("poisson_solver", "where u_h comes from", |solution| {
            Some(solver_word(solution.solver).into())
        }),
        of("poisson_iterations", "iterations of conjugate gradients", |solution| {
            Some(solution.iterations.to_string())
        }),
        of("poisson_converged", "1 where they came to the residual", |solution| {
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
