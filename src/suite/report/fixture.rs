//! Made-up rows: a small sweep whose numbers follow a formula, so that findings can be worked out by hand.

use crate::quality::{Certificate, Check, Statistics};
use crate::suite::analysis::results::Results;
use crate::suite::rows::numbers::first_seen;
use crate::suite::rows::record::{Cell, Outcome, Provenance, Report, Row};
use crate::suite::rows::tables::{Made, RunFile, Tables};
use crate::suite::rows::times::{Seconds, Times};
use crate::theory::Claim;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::Path;

pub(super) const TS: [f64; 7] = [0.05, 0.1, 0.2, 0.25, 0.3333, 0.4, 0.5];
pub(super) const C_BS: [f64; 7] = [0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0];
pub(super) const DOMAINS: [(&str, f64); 5] = [
    ("made-up-square", 90.0),
    ("made-up-ring", 175.0),
    ("made-up-elbow", 90.0),
    ("made-up-star", 36.0),
    ("made-up-coast", 22.0),
];
pub(super) const SPACINGS: [&str; 2] = ["lfs", "expr:0.02 + 0.1*x"];
const ORDERS: [&str; 8] = [
    "fifo",
    "lifo",
    "sharpest",
    "flattest",
    "equilateral",
    "smallest",
    "largest",
    "random",
];

/// A number in 0 … 1 that depends on `text` alone.
fn noise(text: &str) -> f64 {
    let hash = text.bytes().fold(14695981039346656037u64, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(1099511628211)
    });
    (hash >> 40) as f64 / (1u64 << 24) as f64
}

/// A row that was not measured.
pub(super) fn row(group: &str, domain: &str, spacing: &str, t: f64, c_b: f64, order: &str) -> Row {
    Row {
        key: format!("{group}/{domain}/{spacing}/{t}/{c_b}/{order}"),
        group: group.into(),
        outcome: Outcome::Skipped,
        reason: Some("estimated above the budget of 400000 triangles".into()),
        estimated_triangles: 1e6,
        cell: Cell {
            params: Map::from_iter([("order".to_string(), json!(order))]),
            timed: group == "time",
            ..Cell::new(domain, "biting", spacing, t, c_b)
        },
        tries: Vec::new(),
        report: None,
    }
}

/// The same row, measured: `triangles` of them, smallest angle `margin` above the bound.
pub(super) fn measured(mut row: Row, angle: f64, triangles: usize, margin: f64) -> Row {
    let cell = row.cell.clone();
    let bound = (0.5 - cell.t).max(0.0).asin().to_degrees();
    let integral = triangles as f64 * 0.433 * cell.c_b * cell.c_b / 0.9;
    let seconds = 1e-6 * triangles as f64;
    let steps = [
        ("interior_biting", 0.4),
        ("triangulation", 0.45),
        ("edge_protection", 0.01),
    ];
    let steps = steps.map(|(name, share)| (name.to_string(), Value::from(share * seconds)));
    row.outcome = Outcome::Measured;
    row.reason = None;
    row.report = Some(Report {
        domain: cell.domain.clone(),
        mesher: cell.mesher.clone(),
        params: cell.params.clone(),
        spacing: cell.spacing.clone(),
        t: cell.t,
        t_effective: cell.t,
        c_b: cell.c_b,
        alpha: cell.t / cell.c_b,
        seed: 0,
        lfs_cap: true,
        smallest_input_angle_deg: angle,
        smallest_segment_angle_deg: angle,
        forced_pieces: 0,
        integral,
        integral_error: 1e-4,
        integral_lfs: integral / 2.0,
        size_ratio: triangles as f64 / integral,
        size_ratio_lfs: 2.3 / (cell.t.max(0.05) * cell.c_b),
        size_efficiency: 0.9 - 0.2 * cell.t + 0.05 * noise(&row.key),
        min_angle_bound_deg: bound,
        fingerprint: format!("made up: {}", row.key),
        statistics: statistics(triangles, bound + margin),
        times: Some(Times {
            seconds: Seconds {
                total: seconds,
                steps: Map::from_iter(steps),
            },
            samples: vec![0.97 * seconds, seconds, 1.02 * seconds],
            rss_before_bytes: 0,
            peak_rss_bytes: 1 << 24,
        }),
        counts: BTreeMap::new(),
        outside: None,
        poisson: None,
        rounds: Vec::new(),
        poisson_failed: None,
        certificate: certificate(bound + margin, bound),
        provenance: Some(provenance()),
    });
    row
}

/// The same, having run alone for so many seconds.
pub(super) fn timed(mut row: Row, seconds: f64) -> Row {
    if let Some(report) = &mut row.report {
        let times = report.times.get_or_insert_default();
        times.samples = vec![0.97 * seconds, seconds, 1.02 * seconds];
        times.seconds.total = seconds;
    }
    row
}

fn statistics(triangles: usize, smallest: f64) -> Statistics {
    let histogram = (0..60).map(|k| {
        let distance = (f64::from(k) - 50.0) / 8.0;
        if f64::from(k) + 1.0 < smallest {
            0
        } else {
            (1e4 * (-distance * distance).exp()) as u64
        }
    });
    Statistics {
        vertices: triangles / 2,
        triangles,
        min_angle_deg: smallest,
        min_angle_free_deg: Some(smallest),
        excused: 0,
        max_angle_deg: 110.0,
        mean_min_angle_deg: 0.5 * smallest + 36.0,
        p05_min_angle_deg: smallest + 5.0,
        max_radius_edge: 1.0,
        min_angle_histogram: histogram.collect(),
        edge_over_size: None,
        nn_over_f: None,
        beta: Some(1.0 + 0.02 * (smallest - 20.0).abs()),
        seams: None,
    }
}

fn certificate(smallest: f64, bound: f64) -> Certificate {
    let holds = smallest >= bound;
    let check = |claim: Claim, worst: f64, bound: f64, holds: bool| Check {
        claim,
        lemma: claim.lemma().into(),
        applies: true,
        worst: Some(worst),
        bound: Some(bound),
        holds,
        broken: usize::from(!holds),
        at: Some([0.25, 0.75]),
        witnesses: Vec::new(),
    };
    Certificate {
        holds,
        excused: 0,
        low_head_on: 0,
        checks: vec![
            check(Claim::PositiveOrientation, 1.0, 0.0, true),
            check(Claim::MinAngle, smallest, bound, holds),
        ],
    }
}

fn provenance() -> Provenance {
    Provenance {
        version: "0.1.0".into(),
        commit: "0123456789abcdef".into(),
        dirty: false,
        rustc: "rustc 1.95.0".into(),
        cpu: "Made-up CPU".into(),
        cores: 2,
        os: "Linux".into(),
        date: "2026-11-22T02:00:00Z".into(),
    }
}

/// A whole sweep: a grid with skipped cells and one failure, orders, and timed cells.
pub(super) fn sweep() -> Vec<Row> {
    let mut rows = Vec::new();
    for spacing in SPACINGS {
        for (domain, angle) in DOMAINS {
            for t in TS {
                for c_b in C_BS {
                    let cell = row("grid", domain, spacing, t, c_b, "fifo");
                    let triangles = (3e3 * (1.0 + 5.0 * noise(domain)) / (t * c_b)) as usize;
                    let margin = 1.0 + 8.0 * noise(&cell.key) * (t + 0.2);
                    let full = measured(cell.clone(), angle, triangles, margin);
                    rows.push(if triangles > 400_000 { cell } else { full });
                }
            }
            for order in ORDERS {
                let cell = row("orders", domain, spacing, 0.25, 0.75, order);
                let margin = 10.0 + 8.0 * noise(order) + noise(&cell.key);
                rows.push(measured(cell, angle, 20_000 + (1e4 * noise(order)) as usize, margin));
            }
        }
    }
    for power in 8..=20 {
        let c_b = 1.0 / f64::from(power);
        rows.push(measured(
            row("time", "unit-square", "uniform:1", 0.0, c_b, "fifo"),
            90.0,
            40 << power,
            30.0,
        ));
    }
    rows[3].outcome = Outcome::Failed;
    rows[3].reason = Some("no triangle at (0.1, 0.2)".into());
    rows[3].report = None;
    rows
}

/// What the pages of these tests show of each group.
const SECTIONS: [(&str, &str); 10] = [
    ("adapt", r#""adaptation""#),
    ("count", r#""methods", "tasks", "duels""#),
    ("frontier", r#""frontier""#),
    ("grid", r#""angle", "size", "fewest", "meshes""#),
    ("meshers", r#""methods", "peers", "tasks", "duels", "seams""#),
    ("orders", r#""orders""#),
    ("oversampling", r#""oversampling""#),
    ("poisson", r#""poisson""#),
    ("rules", r#""rules""#),
    ("time", r#""time""#),
];

/// A plan with the groups of these rows; its cells do not matter.
fn plan(rows: &[Row]) -> String {
    let group = |name: &str| {
        let sections = SECTIONS.iter().find(|(known, _)| *known == name).expect(name).1;
        format!(
            "[[group]]\nname = \"{name}\"\nsections = [{sections}]\ndomains = [\"a\"]\nspacings = [\"lfs\"]\n\
             mesher = \"biting\"\nt = [0.25]\nc_b = [0.5]\n"
        )
    };
    let groups = first_seen(rows.iter().map(|row| row.group.as_str()))
        .into_iter()
        .map(group);
    "question = \"What comes out?\"\n".to_owned() + &groups.collect::<String>()
}

/// Writes the tables of rows and their plan, as a run leaves them.
pub(super) fn leave(rows: &[Row], folder: &Path) {
    let made = Made {
        by: provenance(),
        until: provenance().date,
    };
    let run = RunFile {
        plan: plan(rows),
        made: vec![made],
    };
    let rows = rows.to_vec();
    Tables {
        rows,
        families: Vec::new(),
        run,
    }
    .write(folder)
    .expect("written");
}

/// Rows with their plan, in the order in which they stand here.
pub(super) fn results(rows: &[Row]) -> Results {
    let folder = tempfile::tempdir().expect("a folder");
    leave(rows, folder.path());
    Results {
        rows: rows.to_vec(),
        ..Results::read(folder.path()).expect("results")
    }
}

/// A row of some method on `domain`, not measured.
pub(super) fn asked(group: &str, domain: &str, mesher: &str, params: Value) -> Row {
    let mut row = row(group, domain, "lfs", 0.25, 0.75, "largest");
    row.cell.mesher = mesher.into();
    row.cell.params = params.as_object().cloned().unwrap_or_default();
    row.key = format!("{group}/{domain}/{mesher}/{params}");
    row
}

/// The same measured: triangles, and smallest angle above 14.48°.
pub(super) fn done(group: &str, domain: &str, mesher: &str, params: Value, triangles: usize, margin: f64) -> Row {
    measured(asked(group, domain, mesher, params), 90.0, triangles, margin)
}
