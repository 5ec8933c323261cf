//! Sweeps: rows, kills, shards, expectations.

use super::{folder, names, plan, run};
use biting::suite::{Outcome, Row, Tables};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A folder with the plan `try.toml`.
fn planned(expectations: &str) -> tempfile::TempDir {
    let folder = folder();
    fs::write(folder.path().join("try.toml"), plan(expectations)).expect("written");
    folder
}

/// The tables that two runs have in common, by name: all but times and provenance.
fn tables(folder: &Path) -> BTreeMap<&'static str, String> {
    let names = ["meshes.csv", "angles.csv", "broken.csv"];
    let read = |name| fs::read_to_string(folder.join(name)).expect("a table");
    names.map(|name| (name, read(name))).into_iter().collect()
}

fn rows(folder: &Path) -> Vec<Row> {
    Tables::read(folder).expect("tables").rows
}

fn results(folder: &Path) -> PathBuf {
    folder.join("results/try")
}

/// What a run that is finished leaves.
const LEFT: [&str; 8] = [
    "README.md",
    "angles.csv",
    "broken.csv",
    "charts",
    "journal.lock",
    "meshes.csv",
    "run.toml",
    "times.csv",
];

#[test]
fn a_killed_sweep_is_resumed() {
    let folder = planned("certificate_holds = true\nmeasured_share = 0.9");
    let (out, _) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("18 cells to run") && out.contains("held"), "{out}");
    let results = results(folder.path());
    let whole = tables(&results);
    assert_eq!(names(&results), LEFT);
    let rows = rows(&results);
    assert_eq!((rows.len(), rows[17].repeats()), (18, 2), "timed cells are repeated");
    assert!(rows[0].report.as_ref().is_some_and(|report| report.times.is_none()));

    // What a kill leaves: a journal that ends within a line.
    run(folder.path(), &["sweep", "try.toml", "--shard", "1/1"], 0);
    let (shard, journal) = (results.join("journal.1-of-1.jsonl"), results.join("journal.jsonl"));
    let bytes = fs::read(&shard).expect("read");
    let cut_off = || fs::write(&journal, &bytes[..bytes.len() * 2 / 3]).expect("cut off, as by a kill");
    fs::remove_file(&shard).expect("removed");
    cut_off();
    let (out, err) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("are done") && err.contains("cut off"), "{out}{err}");
    assert_eq!(tables(&results), whole);
    assert!(!journal.exists());

    cut_off();
    let (out, _) = run(folder.path(), &["sweep", "try.toml", "--fresh"], 0);
    assert!(
        out.contains("18 cells to run") && out.contains("journal.before-"),
        "{out}"
    );
    assert_eq!(tables(&results), whole);
}

#[test]
fn a_sweep_killed_for_real_is_resumed() {
    let folder = planned("");
    run(folder.path(), &["sweep", "try.toml", "--results", "calm"], 0);
    let whole = tables(&folder.path().join("calm/try"));
    let journal = results(folder.path()).join("journal.jsonl");
    let program = assert_cmd::cargo::cargo_bin!("biting");
    for kills in 1..=3 {
        let mut sweep = std::process::Command::new(program)
            .args(["sweep", "try.toml", "--threads", "1"])
            .current_dir(folder.path())
            .stdout(std::process::Stdio::null())
            .stderr(std::process::Stdio::null())
            .spawn()
            .expect("the program starts");
        let enough = |bytes: &Vec<u8>| bytes.iter().filter(|&&byte| byte == b'\n').count() >= 3 * kills;
        while !fs::read(&journal).is_ok_and(|bytes| enough(&bytes)) {
            if sweep.try_wait().expect("known").is_some() {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        // A sweep that was faster than the kill is as good.
        let _ = sweep.kill();
        sweep.wait().expect("ended");
    }
    run(folder.path(), &["sweep", "try.toml"], 0);
    assert_eq!(tables(&results(folder.path())), whole);
}

#[test]
fn times_are_measured_anew_by_themselves() {
    let folder = planned("");
    run(folder.path(), &["sweep", "try.toml"], 0);
    let results = results(folder.path());
    let whole = tables(&results);
    let (out, _) = run(folder.path(), &["sweep", "try.toml", "--timed"], 0);
    let timed = rows(&results).iter().filter(|row| row.cell.timed).count();
    assert!(out.contains(&format!("{timed} cells to run")), "{out}");
    assert_eq!(tables(&results), whole, "the other lines stay");
}

#[test]
fn shards_join_to_the_same_rows() {
    let folder = planned("");
    run(folder.path(), &["sweep", "try.toml"], 0);
    let whole = tables(&results(folder.path()));
    fs::remove_dir_all(folder.path().join("results")).expect("removed");
    run(folder.path(), &["sweep", "merge", "try.toml"], 2);
    run(folder.path(), &["sweep", "try.toml", "--shard", "2/2"], 0);
    let (_, message) = run(folder.path(), &["sweep", "merge", "try.toml"], 2);
    assert!(message.contains("have no row yet"), "{message}");
    run(folder.path(), &["sweep", "try.toml", "--shard", "1/2"], 0);
    run(folder.path(), &["sweep", "merge", "try.toml"], 0);
    assert_eq!(tables(&results(folder.path())), whole);
    assert!(
        !names(&results(folder.path()))
            .iter()
            .any(|name| name.ends_with(".jsonl"))
    );
}

#[test]
fn two_runs_give_the_same_tables_whatever_the_threads() {
    let folder = planned("");
    let counted = |threads: &str| {
        run(
            folder.path(),
            &["sweep", "try.toml", "--fresh", "--threads", threads],
            0,
        );
        tables(&results(folder.path()))
    };
    assert_eq!(counted("1"), counted("4"));
}

#[test]
fn quick_and_dry_runs_leave_the_rows_alone() {
    let folder = planned("");
    let (out, _) = run(folder.path(), &["sweep", "try.toml", "--dry-run"], 0);
    assert!(
        out.contains("18 cells") && out.contains("grid/l-shape/lfs/biting/t=0.25/c_b=1"),
        "{out}"
    );
    assert_eq!(names(folder.path()), ["try.toml"]);
    run(folder.path(), &["sweep", "try.toml", "--quick"], 0);
    assert_eq!(names(&folder.path().join("results")), ["try-quick"]);
    assert_eq!(rows(&folder.path().join("results/try-quick")).len(), 4);
}

#[test]
fn broken_expectations_and_empty_results_have_their_status() {
    let folder = planned("measured_per_domain = { l-shape = 9 }");
    let (out, message) = run(folder.path(), &["sweep", "try.toml"], 1);
    assert!(
        out.contains("BROKEN") && out.contains("l-shape") && message.contains("expectation"),
        "{out}{message}"
    );
    let small = plan("").replace("triangles = 3000", "triangles = 1");
    fs::write(folder.path().join("try.toml"), small).expect("written");
    let (_, message) = run(folder.path(), &["sweep", "try.toml", "--fresh"], 3);
    assert!(message.contains("budget"), "{message}");
    let rows = rows(&results(folder.path()));
    assert_eq!(rows.len(), 18, "skipped cells have lines too");
    let is_skipped = |row: &Row| row.outcome == Outcome::Skipped && row.estimated_triangles > 1.0;
    assert!(rows.iter().all(is_skipped), "{rows:?}");
}

#[test]
fn meshes_of_equal_count_are_searched_for() {
    let folder = folder();
    let plan = r#"
        question = "How many?"
        [expect]
        certificate_holds = true
        unmeshed_share = 0.0
        [[group]]
        name = "count"
        domains = ["plate-hole", "l-shape"]
        spacings = ["lfs"]
        methods = [{ mesher = "biting" }, { mesher = "biting", params = { order = "fifo" } }]
        equal_triangles = 3000
        t = [0.2]
        c_b = [0.8]
    "#;
    fs::write(folder.path().join("try.toml"), plan).expect("written");
    run(folder.path(), &["sweep", "try.toml"], 0);
    let first = tables(&results(folder.path()));
    let rows = rows(&results(folder.path()));
    assert_eq!(rows.len(), 4);
    for row in &rows {
        let report = row.report.as_ref().expect("measured");
        let triangles = report.statistics.triangles as f64;
        assert!((triangles / 3000.0 - 1.0).abs() <= 0.02, "{row:?}");
        let last = row.tries.last().expect("a try");
        assert_eq!(last.triangles, Some(report.statistics.triangles as u64));
        assert!((last.c_b / report.c_b - 1.0).abs() < 1e-8);
        assert!((report.t / report.c_b - 0.25).abs() < 1e-12, "the spacing stays");
        assert!((report.alpha - 0.25).abs() < 1e-12);
    }
    run(folder.path(), &["sweep", "try.toml"], 0);
    assert_eq!(
        tables(&results(folder.path())),
        first,
        "nothing in the search is random"
    );
}
