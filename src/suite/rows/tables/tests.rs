//! What is written is read, each column is documented, and the committed tables are what the code would write.

use super::*;
use crate::domain::gallery;
use crate::meshers::biting::Biting;
use crate::quality::{Angles, Seams};
use crate::suite::fem::{Solution, Solver, Spectrum};
use crate::suite::rows::adapted::{Adapt, Round};
use crate::suite::rows::record::{Cell, Outcome, Outside, Provenance, Report, Try};
use crate::suite::rows::times::{Seconds, Times};
use crate::suite::run::prepare::Store;
use crate::suite::run::{measure, runner};
use crate::theory::Claim;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// A mesh of the star, whose corners break what is promised of them if they are bitten.
fn row(key: &str, params: &[(&str, &str)]) -> Row {
    let cell = Cell::new("star", "biting", "lfs", 1.0 / 3.0, 0.75).with(params);
    let prepared = Store::new(None, false).prepare_for_t(&cell).unwrap();
    let mesher = runner::mesher(&cell).unwrap();
    let request = prepared.case(cell.c_b).request();
    let run = measure::run(&prepared, &mesher, &request).unwrap();
    let mut report = measure::judge(&prepared, &cell, &mesher, &run, &Provenance::default());
    (report.times, report.provenance) = (None, None);
    Row {
        key: key.into(),
        group: "grid".into(),
        outcome: Outcome::Measured,
        reason: None,
        estimated_triangles: 0.0,
        cell,
        tries: Vec::new(),
        report: Some(report),
    }
}

fn skipped(key: &str) -> Row {
    Row {
        outcome: Outcome::Skipped,
        reason: Some("too large,\nby \"far\"".into()),
        estimated_triangles: 1e6 / 3.0,
        report: None,
        ..row(key, &[])
    }
}

/// A row in which every column says something but its default.
fn full() -> Row {
    let mut row = row("full", &[("order", "fifo")]);
    row.reason = Some("none".into());
    row.cell.seed = 7;
    row.cell.lfs_cap = false;
    row.cell.triangles = Some(500);
    row.cell.threads = 2;
    row.cell.poisson = Some("smooth".into());
    row.cell.adapt = Some(Adapt {
        eps: 0.001,
        rounds: 3,
        sample: true,
    });
    row.cell.timed = true;
    row.tries = vec![
        Try {
            c_b: 0.5,
            triangles: None,
        },
        Try {
            c_b: 2.0 / 3.0,
            triangles: Some(501),
        },
    ];
    let report = row.report.as_mut().unwrap();
    fill(report);
    row
}

fn fill(report: &mut Report) {
    let angles = |share: f64| Angles {
        triangles: 10,
        min_deg: 20.5,
        mean_deg: 40.25,
        p05_deg: 22.0,
        share_under_30: share,
    };
    report.c_b = 2.0 / 3.0;
    report.lfs_cap = false;
    report.statistics.seams = Some(Seams {
        met: angles(0.5),
        elsewhere: angles(0.25),
    });
    report.forced_pieces = 3;
    report.certificate.low_head_on = 4;
    report.certificate.holds = false;
    for check in &mut report.certificate.checks {
        (check.broken, check.holds, check.applies) = (2, false, false);
        if claims::worst_elsewhere(check.claim).is_none() {
            check.worst = Some(3.5);
        }
    }
    report.outside = Some(Outside {
        version: "1.2, of its own".into(),
        set_up_seconds: BTreeMap::from([("imports".into(), 0.25)]),
        repeats_differ: true,
    });
    report.poisson = Some(Solution {
        unknowns: 8,
        energy_error: 0.1,
        energy_norm: 1.5,
        l2_error: 0.01,
        l2_norm: 0.5,
        solver: Solver::ConjugateGradients,
        iterations: 17,
        converged: false,
        spectrum: Some(Spectrum {
            largest: 6.5,
            largest_preconditioned: 1.5,
            smallest_preconditioned: 0.5,
            condition_preconditioned: 3.0,
        }),
    });
    report.poisson_failed = Some("it did not".into());
    report.rounds = vec![
        Round {
            vertices: 3,
            triangles: 4,
            l2_error: 0.1,
            energy_error: 0.2,
            settled: 0.3,
            least_change: 0.4,
            independent: 2,
            kept: 1,
        };
        2
    ];
    report.times = Some(Times {
        seconds: Seconds {
            total: 0.5,
            steps: [("interior_biting".to_owned(), 0.25.into())].into_iter().collect(),
        },
        samples: vec![0.45, 0.5, 0.52],
        rss_before_bytes: 1000,
        peak_rss_bytes: 2000,
    });
}

fn tables(rows: Vec<Row>) -> Tables {
    Tables {
        families: Vec::new(),
        rows,
        run: RunFile {
            plan: "question = \"?\"\n\n[[group]]\nname = 'grid'\n".into(),
            made: vec![made("a", "2026-01-01T00:00:00Z")],
        },
    }
}

fn made(commit: &str, date: &str) -> Made {
    Made {
        by: Provenance {
            commit: commit.into(),
            date: date.into(),
            ..Provenance::default()
        },
        until: date.into(),
    }
}

/// The head of each table that some text is.
fn head(text: &str) -> Vec<&str> {
    text.lines().next().unwrap_or_default().split(',').collect()
}

#[test]
fn what_is_written_is_read_and_would_be_written_again() {
    let folder = tempfile::tempdir().unwrap();
    let whole = tables(vec![row("bitten", &[("corners", "bite")]), skipped("large"), full()]);
    whole.write(folder.path()).unwrap();
    let read = Tables::read(folder.path()).unwrap();
    assert_eq!(read.texts(), whole.texts());
    assert_eq!(read.run, whole.run);
    for (read, written) in read.rows.iter().zip(&whole.rows) {
        assert_eq!(
            (&read.key, &read.cell, &read.reason),
            (&written.key, &written.cell, &written.reason)
        );
        let [read, written] = [read, written].map(|row| {
            row.report.as_ref().map(|report| {
                let checks = report.certificate.checks.iter();
                let checks: Vec<_> = checks
                    .map(|check| (check.claim, check.applies, check.holds, check.broken))
                    .collect();
                (
                    report.fingerprint.clone(),
                    report.statistics.min_angle_histogram.clone(),
                    report.params.clone(),
                    checks,
                )
            })
        });
        assert_eq!(read, written);
    }
    let (report, written) = (
        read.rows[2].report.as_ref().unwrap(),
        whole.rows[2].report.as_ref().unwrap(),
    );
    assert_eq!(
        (report.c_b, report.t_effective),
        (written.c_b, written.t_effective),
        "to the last bit"
    );
    assert_eq!(
        (&report.times, &report.outside, &report.poisson),
        (&written.times, &written.outside, &written.poisson)
    );
    assert_eq!(report.rounds, written.rounds);
}

#[test]
fn bounds_that_are_not_written_follow() {
    let folder = tempfile::tempdir().unwrap();
    for params in [&[][..], &[("rule", "later")]] {
        let whole = tables(vec![row("bitten", params)]);
        whole.write(folder.path()).unwrap();
        let read = Tables::read(folder.path()).unwrap();
        let [read, written] = [&read, &whole].map(|tables| &tables.rows[0].report.as_ref().unwrap().certificate.checks);
        for (read, written) in read.iter().zip(written) {
            // Of the integral's error, which bounds on counts grant, only the size is there.
            let digits = match read.claim {
                Claim::VerticesLower | Claim::VerticesUpper => 1e-6,
                Claim::PositiveOrientation | Claim::Area => 5e-3,
                _ => 5e-9,
            };
            let near = |a: Option<f64>, b: Option<f64>| match (a, b) {
                (Some(a), Some(b)) => (a - b).abs() <= digits * b.abs(),
                (a, b) => a == b,
            };
            assert!(
                near(read.bound, written.bound) && near(read.worst, written.worst),
                "{read:?} {written:?}"
            );
        }
    }
}

#[test]
fn every_column_says_something_of_a_row_that_has_everything() {
    let whole = tables(vec![skipped("large"), full()]);
    let texts: BTreeMap<&str, String> = whole.texts().into_iter().collect();
    let counted: Vec<&str> = meshes::counted(&whole.rows).into_iter().collect();
    let all: Vec<String> = meshes::columns(counted).into_iter().map(|column| column.name).collect();
    assert_eq!(head(&texts[MESHES]), all);
    let of = |columns: Vec<String>, name: &str| assert_eq!(head(&texts[name]), columns, "{name}");
    // All are broken, so of biting with its defaults nothing applies and everything promised is there, with its cause.
    of(broken().into_iter().map(|column| column.name).collect(), BROKEN);
    of(rounds().into_iter().map(|column| column.name).collect(), ROUNDS);
    let times = times([vec!["interior_biting"], vec!["imports"]]);
    of(times.into_iter().map(|column| column.name).collect(), TIMES);
}

#[test]
fn a_breach_has_its_cause() {
    let mut row = row("bitten", &[("corners", "bite"), ("head_on", "leave")]);
    let report = row.report.as_mut().unwrap();
    let breach = |claim: Claim, report: &mut Report, applies: bool| {
        let check = report
            .certificate
            .checks
            .iter_mut()
            .find(|check| check.claim == claim)
            .unwrap();
        (check.broken, check.holds, check.applies) = (1, false, applies);
    };
    breach(Claim::MinAngle, report, false);
    breach(Claim::MinAngleBeyondCorners, report, false);
    breach(Claim::Coverage, report, true);
    let text = &tables(vec![row]).texts()[2].1;
    let causes: Vec<(&str, &str)> = text
        .lines()
        .skip(1)
        .map(|line| (line.split(',').nth(1).unwrap(), line.rsplit(',').next().unwrap()))
        .collect();
    // The star has angles of 36°; its corners bitten, nothing is promised beyond them; coverage applies, so it is a fault.
    let own: Vec<_> = causes
        .iter()
        .filter(|(claim, _)| ["coverage", "min-angle"].contains(claim))
        .collect();
    assert_eq!(
        own,
        [&("coverage", ""), &("min-angle", "no angle under 90 degrees")],
        "{text}"
    );
    assert!(!text.contains("min-angle-beyond-corners"), "{text}");
}

#[test]
fn lines_stay_where_a_run_has_none() {
    let mut old: Vec<Row> = ["a", "b", "gone", "c", "d"].iter().map(|key| skipped(key)).collect();
    old[1] = row("b", &[]);
    let mut earlier = tables(old.clone());
    earlier.run.made = vec![made("old", "2026-01-01T00:00:00Z")];
    let mut new = [row("a", &[("order", "fifo")]), skipped("b"), skipped("c")];
    new[0].report.as_mut().unwrap().provenance = Some(made("new", "2026-02-02T00:00:00Z").by);
    let gathered = |is_final: bool| {
        let keys = ["a", "b", "c", "d", "never"];
        Tables::gather("plan", keys, &new, |_| is_final, &[], Some(earlier.clone()))
    };
    // A peer that is not there now: its mesh stays; so does the line of d, which was not asked for.
    let stays = gathered(false);
    assert_eq!(
        stays.rows,
        [new[0].clone(), old[1].clone(), new[2].clone(), old[4].clone()]
    );
    let commits: Vec<&str> = stays.run.made.iter().map(|made| made.by.commit.as_str()).collect();
    assert_eq!((commits, stays.run.plan.as_str()), (vec!["old", "new"], "plan"));
    // Above its budget now: that is what the plan says.
    assert_eq!(gathered(true).rows[1], new[1]);
    let alone = Tables::gather("plan", ["a", "b"], &new, |_| true, &[], Some(earlier.clone()));
    assert_eq!(alone.run.made.len(), 1, "nothing of the earlier run stayed");
}

#[test]
fn who_made_it_is_told_once_for_each_code_and_machine() {
    let row = |commit: &str, date: &str| {
        let mut row = row("a", &[]);
        row.report.as_mut().unwrap().provenance = Some(made(commit, date).by);
        row
    };
    let rows = [
        row("x", "2026-01-02T00:00:00Z"),
        row("y", "2026-01-03T00:00:00Z"),
        row("x", "2026-01-01T00:00:00Z"),
    ];
    let all = run_file::made(
        rows.iter().filter_map(|row| row.report.as_ref()?.provenance.as_ref()),
        &[],
    );
    assert_eq!(all.len(), 2);
    assert_eq!(
        (all[0].by.date.as_str(), all[0].until.as_str()),
        ("2026-01-01T00:00:00Z", "2026-01-02T00:00:00Z")
    );
}

#[test]
fn tables_that_have_no_lines_any_more_go() {
    let folder = tempfile::tempdir().unwrap();
    tables(vec![full()]).write(folder.path()).unwrap();
    assert!(folder.path().join(TIMES).is_file() && folder.path().join(ROUNDS).is_file());
    tables(vec![row("a", &[])]).write(folder.path()).unwrap();
    assert!(!folder.path().join(TIMES).exists() && !folder.path().join(ROUNDS).exists());
}

#[test]
fn what_is_wrong_in_a_table_is_told_with_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let told = || Tables::read(folder.path()).unwrap_err().to_string();
    assert!(told().contains("meshes.csv"), "{}", told());
    tables(vec![row("a", &[])]).write(folder.path()).unwrap();
    let text = fs::read_to_string(folder.path().join(MESHES)).unwrap();
    fs::write(folder.path().join(MESHES), text.replace(",measured,", ",mismeasured,")).unwrap();
    assert!(
        told().contains("meshes.csv:2: `mismeasured` is no outcome"),
        "{}",
        told()
    );
    fs::write(folder.path().join(MESHES), text).unwrap();
    fs::write(folder.path().join(BROKEN), "key,claim,worst,bound\nb,area,1,2\n").unwrap();
    assert!(
        told().contains("broken.csv:2: `meshes.csv` has no mesh `b`"),
        "{}",
        told()
    );
    fs::write(folder.path().join(RUN), "plan = 3\n").unwrap();
    assert!(told().contains("run.toml"), "{}", told());
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn the_page_is_what_the_columns_say() {
    let path = root().join("docs/rows.md");
    if std::env::var_os("RENEW").is_some() {
        fs::write(&path, page()).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap_or_default() == page(),
        "docs/rows.md is stale: RENEW=1 cargo test --lib -- tables"
    );
}

#[test]
fn committed_tables_are_what_would_be_written_and_documented() {
    let page = page();
    let documented: BTreeSet<&str> = page.split('`').collect();
    let is_known = |column: &str| {
        let family = ["count_…", "step_…_seconds", "set_up_…_seconds"].iter().any(|family| {
            let (before, after) = family.split_once('…').unwrap();
            column.starts_with(before) && column.ends_with(after)
        });
        family || documented.contains(column) || column.starts_with("from_")
    };
    let mut count = 0;
    for entry in fs::read_dir(root().join("results")).unwrap() {
        let folder = entry.unwrap().path();
        if !Tables::are_in(&folder) {
            continue;
        }
        count += 1;
        let tables = Tables::read(&folder).unwrap();
        for (name, text) in tables.texts() {
            if std::env::var_os("RENEW").is_some() {
                fs::write(folder.join(name), &text).unwrap();
            }
            let committed = fs::read_to_string(folder.join(name)).unwrap();
            assert!(
                committed == text,
                "{}/{name} would be written otherwise",
                folder.display()
            );
            if name.ends_with(".csv") {
                let unknown: Vec<&str> = head(&text).into_iter().filter(|column| !is_known(column)).collect();
                assert!(unknown.is_empty(), "{name}: {unknown:?}");
            }
        }
    }
    assert!(count >= 8, "{count} folders have tables");
}

#[test]
fn a_mesh_is_made_again_from_its_line() {
    let folder = tempfile::tempdir().unwrap();
    tables(vec![row("a", &[])]).write(folder.path()).unwrap();
    let read = Tables::read(folder.path()).unwrap().rows.remove(0);
    let prepared = Store::new(None, false).prepare_for_t(&read.cell).unwrap();
    assert_eq!(
        gallery::domain("star").unwrap().unwrap().vertices(),
        prepared.site.domain.vertices()
    );
    let mesh = prepared.case(read.cell.c_b).mesh(&Biting::default()).unwrap();
    assert_eq!(measure::fingerprint(&mesh), read.report.unwrap().fingerprint);
}
