//! The tables beside `meshes.csv`: histograms, which are joined to it by the fingerprint; checks that a method promises and that do
//! not hold, times and rounds of adaptation, joined by the cell's key.

use super::cause::cause;
use super::column::{Column, flag, number};
use crate::quality::Check;
use crate::suite::rows::adapted::Round;
use crate::suite::rows::numbers::first_seen;
use crate::suite::rows::record::{Report, Row};
use crate::suite::rows::times::Times;
use std::collections::{BTreeSet, HashSet};

/// A line of a table: its cell, the mesh, and what the line is about.
pub(super) struct Part<'a, T> {
    pub(super) row: &'a Row,
    pub(super) report: &'a Report,
    pub(super) about: T,
}

/// The parts of each row that has a mesh.
pub(super) fn parts<'a, T, I: IntoIterator<Item = T>>(
    rows: &'a [Row],
    of: impl Fn(&'a Report) -> I,
) -> Vec<Part<'a, T>> {
    let measured = rows.iter().filter_map(|row| Some((row, row.report.as_ref()?)));
    let each = measured.flat_map(|(row, report)| of(report).into_iter().map(move |about| Part { row, report, about }));
    each.collect()
}

fn key<'a, T: 'a>() -> Column<Part<'a, T>> {
    Column::new("key", "the cell, as in `meshes.csv`", |part: &Part<T>| {
        Some(part.row.key.clone())
    })
}

/// Histograms, once where cells share a mesh.
pub(super) fn histograms(rows: &[Row]) -> Vec<Part<'_, &[u64]>> {
    let mut seen = HashSet::new();
    let mut all = parts(rows, |report| [&report.statistics.min_angle_histogram[..]]);
    all.retain(|part| seen.insert(part.report.fingerprint.as_str()));
    all
}

/// `angles.csv`: a line a mesh, a column a degree.
pub(super) fn angles<'a>() -> Vec<Column<Part<'a, &'a [u64]>>> {
    let bin = |degree: usize| {
        let about = format!(
            "triangles whose smallest angle is at least {degree}° and less than {}°",
            degree + 1
        );
        Column::new(&bin_column(degree), &about, move |part: &Part<&[u64]>| {
            part.about.get(degree).map(u64::to_string)
        })
        .or("0")
    };
    let fingerprint = Column::new(
        "fingerprint",
        "the mesh, as in `meshes.csv`; cells that share it share the line",
        |part: &Part<&[u64]>| Some(part.report.fingerprint.clone()),
    );
    std::iter::once(fingerprint).chain((0..BINS).map(bin)).collect()
}

/// Smallest angles are at most 60°.
pub(super) const BINS: usize = 60;

pub(super) fn bin_column(degree: usize) -> String {
    format!("from_{degree:02}_deg")
}

/// The checks that do not hold although their method promises them where their hypotheses are met.
pub(super) fn breaches(rows: &[Row]) -> Vec<Part<'_, (&Check, String)>> {
    let mut all = Vec::new();
    for part in parts(rows, |report| {
        report.certificate.checks.iter().filter(|check| check.broken > 0)
    }) {
        let Part { row, report, about } = part;
        all.extend(cause(row, report, about).map(|cause| Part {
            row,
            report,
            about: (about, cause),
        }));
    }
    all
}

/// `broken.csv`: a line a breach.
pub(super) fn broken<'a>() -> Vec<Column<Part<'a, (&'a Check, String)>>> {
    type Line<'a> = Part<'a, (&'a Check, String)>;
    let place = |axis: usize| move |part: &Line| part.about.0.at.map(|at| number(at[axis]));
    vec![
        key(),
        Column::new(
            "claim",
            "what does not hold; `src/quality` has the list",
            |part: &Line| Some(part.about.0.claim.to_string()),
        ),
        Column::new(
            "applies",
            "1 if the method guarantees it and its hypotheses hold, so that this is a fault",
            |part: &Line| Some(flag(part.about.0.applies)),
        ),
        Column::new("worst", "worst value", |part: &Line| part.about.0.worst.map(number)),
        Column::new("bound", "the bound that it breaks", |part: &Line| {
            part.about.0.bound.map(number)
        }),
        Column::new("places", "number of places where it does not hold", |part: &Line| {
            Some(part.about.0.broken.to_string())
        }),
        Column::new("x", "where the worst is, in the domain's unit", place(0)),
        Column::new("y", "the same", place(1)),
        Column::new(
            "cause",
            "the hypotheses that the cell does not meet, or `corners` if one about corners fails, which only the domain shows; empty for a fault",
            |part: &Line| Some(part.about.1.clone()).filter(|cause| !cause.is_empty()),
        ),
    ]
}

/// What the steps of some cells are called, and what peers do before they mesh: these name columns.
pub(super) fn timed<'a>(lines: &[Part<'a, &'a Times>]) -> [Vec<&'a str>; 2] {
    let steps = lines.iter().flat_map(|part| part.about.seconds.steps.keys());
    let peers = lines.iter().filter_map(|part| part.report.outside.as_ref());
    let set_ups: BTreeSet<&str> = peers
        .flat_map(|told| told.set_up_seconds.keys().map(String::as_str))
        .collect();
    [first_seen(steps.map(String::as_str)), set_ups.into_iter().collect()]
}

/// `times.csv`: a line a cell that ran alone.
pub(super) fn times<'a>([steps, set_ups]: [Vec<&str>; 2]) -> Vec<Column<Part<'a, &'a Times>>> {
    type Line<'a> = Part<'a, &'a Times>;
    let mut all = vec![
        key(),
        Column::new("repeats", "how often it ran", |part: &Line| {
            Some(part.about.samples.len().to_string())
        }),
        Column::new(
            "median_seconds",
            "from domain and spacing in memory to mesh in memory, median of the repeats; a peer's by its own clock",
            |part: &Line| Some(number(part.about.seconds.total)),
        ),
        Column::new(
            "spread",
            "largest repeat minus smallest, over the median: pages quote times below 0.1",
            |part: &Line| rounded(part.about).spread().map(number),
        ),
        Column::new(
            "samples_seconds",
            "each repeat, in the order they ran",
            |part: &Line| {
                let all: Vec<String> = part.about.samples.iter().map(|&sample| number(sample)).collect();
                (!all.is_empty()).then(|| all.join(" "))
            },
        ),
        Column::new(
            "rss_before_bytes",
            "resident memory of the process just before",
            |part: &Line| Some(part.about.rss_before_bytes.to_string()),
        ),
        Column::new("peak_rss_bytes", "its peak by the end", |part: &Line| {
            Some(part.about.peak_rss_bytes.to_string())
        }),
        Column::new(
            "repeats_differ",
            "1 if a peer's repeat made another mesh; ours may not",
            |part: &Line| Some(flag(part.report.outside.as_ref()?.repeats_differ)),
        )
        .or("0"),
    ];
    all.extend(steps.into_iter().map(|step| {
        let name = step.to_owned();
        let about = "seconds of that step, in the repeat nearest to the median";
        Column::new(&format!("{STEP}{step}{SECONDS}"), about, move |part: &Line| {
            part.about.seconds.steps.get(&name)?.as_f64().map(number)
        })
    }));
    all.extend(set_ups.into_iter().map(|what| {
        let name = what.to_owned();
        let about = "seconds of a peer before it meshes";
        Column::new(&format!("{SET_UP}{what}{SECONDS}"), about, move |part: &Line| {
            part.report
                .outside
                .as_ref()?
                .set_up_seconds
                .get(&name)
                .copied()
                .map(number)
        })
    }));
    all
}

/// Samples as the table has them, so that their spread is that of the table.
fn rounded(times: &Times) -> Times {
    let samples = times.samples.iter();
    Times {
        samples: samples
            .map(|&sample| number(sample).parse().unwrap_or(sample))
            .collect(),
        ..Times::default()
    }
}

/// How the columns of steps, and of what a peer does before it meshes, begin and end.
pub(super) const STEP: &str = "step_";
pub(super) const SET_UP: &str = "set_up_";
pub(super) const SECONDS: &str = "_seconds";

/// `rounds.csv`: a line a round of adaptation.
pub(super) fn rounds<'a>() -> Vec<Column<Part<'a, (usize, &'a Round)>>> {
    type Line<'a> = Part<'a, (usize, &'a Round)>;
    let count = |name, about, value: fn(&Round) -> usize| {
        Column::new(name, about, move |part: &Line| Some(value(part.about.1).to_string()))
    };
    let measure = |name, about, value: fn(&Round) -> f64| {
        Column::new(name, about, move |part: &Line| Some(number(value(part.about.1))))
    };
    vec![
        key(),
        Column::new("round", "from 1", |part: &Line| Some((part.about.0 + 1).to_string())),
        count("vertices", "of its mesh", |round| round.vertices),
        count("triangles", "of its mesh", |round| round.triangles),
        measure(
            "l2_error",
            "L2 error of the solution on it over the L2 norm of u",
            |round| round.l2_error,
        ),
        measure(
            "energy_error",
            "energy error of the solution on it over the energy norm of u",
            |round| round.energy_error,
        ),
        measure("settled", "share of its vertices whose spacing has settled", |round| {
            round.settled
        }),
        measure(
            "least_change",
            "smallest ratio of the next spacing to the last one at its vertices",
            |round| round.least_change,
        ),
        count(
            "independent",
            "points of a maximal independent set of its vertices for the next spacing",
            |round| round.independent,
        )
        .paper("§3.3"),
        count("kept", "vertices it has in common with the mesh before", |round| {
            round.kept
        }),
    ]
}
