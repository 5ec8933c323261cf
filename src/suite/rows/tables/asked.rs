//! The columns of `meshes.csv` that say what a cell asks for, and how it ended.

use super::column::{Column, exact, flag, number};
use super::meshes::{measure, of_mesh};
use crate::suite::rows::record::{Outcome, Row, Try, parameter_text};

/// What a cell asks for, to the last bit.
pub(super) fn asked() -> Vec<Column<Row>> {
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
        column("lfs_cap", "1 if f is capped by lfs, so that f ≤ lfs", |row| {
            Some(flag(row.cell.lfs_cap))
        })
        .paper("§5")
        .or("1"),
        column(
            "wanted_triangles",
            "triangles that the mesh is to have: c_b is scaled for it, f stays as it is",
            |row| Some(row.cell.triangles?.to_string()),
        ),
        column("threads", "threads that the mesher may use", |row| {
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
        column("adapt_sample", "1 if the Hessian is that of u itself", |row| {
            Some(flag(row.cell.adapt?.sample))
        })
        .or("0"),
        column(
            "timed",
            "1 if the cell runs alone and is repeated: `times.csv` has its times",
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
pub(super) fn ended() -> Vec<Column<Row>> {
    vec![
        Column::new("outcome", "measured, declined, failed or skipped", |row: &Row| {
            Some(outcome_word(row.outcome).into())
        }),
        Column::new("reason", "why it is not measured", |row: &Row| row.reason.clone()),
        Column::new(
            "estimated_triangles",
            "if there is no mesh: triangles expected, from ∫ dA / f²",
            |row: &Row| row.report.is_none().then(|| number(row.estimated_triangles)),
        ),
        Column::new(
            "tries",
            "if triangles are wanted: each c_b tried, as `c_b:triangles`, the last part empty if there was no mesh",
            tries,
        ),
        of_mesh("peer_version", "version of the peer", |report| {
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
        of_mesh("holds", "1 if every check that applies holds", |report| {
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
