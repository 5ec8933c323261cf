//! Sweeps: rows, kills, shards, expectations.

use super::{folder, names, plan, run};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A folder with the plan `try.toml`.
fn planned(expectations: &str) -> tempfile::TempDir {
    let folder = folder();
    fs::write(folder.path().join("try.toml"), plan(expectations)).expect("written");
    folder
}

/// The rows, without the parts that may differ from run to run.
fn rows(file: &Path) -> Vec<Value> {
    let text = fs::read_to_string(file).expect("rows");
    let parse = |line: &str| {
        let mut row: Value = serde_json::from_str(line).expect("a row");
        for changing in ["seconds", "rss_before_bytes", "peak_rss_bytes", "provenance"] {
            if let Some(report) = row["report"].as_object_mut() {
                report.remove(changing);
            }
        }
        row["samples"] = Value::from(row["samples"].as_array().map_or(0, Vec::len));
        row
    };
    text.lines().map(parse).collect()
}

fn rows_file(folder: &Path) -> PathBuf {
    folder.join("results/try/rows.jsonl")
}

#[test]
fn a_killed_sweep_is_resumed() {
    let folder = planned("certificate_holds = true\nmeasured_share = 0.9");
    let (out, _) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("18 cells to run") && out.contains("held"), "{out}");
    let file = rows_file(folder.path());
    let whole = rows(&file);
    assert_eq!(whole.len(), 18);
    assert_eq!(whole[17]["samples"], 2, "timed cells are repeated");
    assert!(
        whole.iter().any(|row| !row["same_as"].is_null()),
        "cells that coincide are run once"
    );
    for name in ["README.md", "plan.toml", "charts"] {
        assert!(folder.path().join("results/try").join(name).exists(), "{name}");
    }

    let (out, _) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("all 18 cells have rows"), "{out}");

    let bytes = fs::read(&file).expect("read");
    fs::write(&file, &bytes[..bytes.len() * 2 / 3]).expect("cut off, as by a kill");
    let (out, err) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("are done") && err.contains("cut off"), "{out}{err}");
    assert_eq!(rows(&file), whole);

    let (out, _) = run(folder.path(), &["sweep", "try.toml", "--fresh"], 0);
    assert!(out.contains("18 cells to run") && out.contains("rows.before-"), "{out}");
    assert_eq!(rows(&file), whole);
}

#[test]
fn a_sweep_killed_for_real_is_resumed() {
    let folder = planned("");
    run(folder.path(), &["sweep", "try.toml", "--results", "calm"], 0);
    let whole = rows(&folder.path().join("calm/try/rows.jsonl"));
    let file = rows_file(folder.path());
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
        while !fs::read(&file).is_ok_and(|bytes| enough(&bytes)) {
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
    assert_eq!(rows(&file), whole);
}

#[test]
fn shards_join_to_the_same_rows() {
    let folder = planned("");
    run(folder.path(), &["sweep", "try.toml"], 0);
    let whole = rows(&rows_file(folder.path()));
    fs::remove_dir_all(folder.path().join("results")).expect("removed");
    run(folder.path(), &["sweep", "merge", "try.toml"], 2);
    run(folder.path(), &["sweep", "try.toml", "--shard", "2/2"], 0);
    let (_, message) = run(folder.path(), &["sweep", "merge", "try.toml"], 2);
    assert!(message.contains("have no row yet"), "{message}");
    run(folder.path(), &["sweep", "try.toml", "--shard", "1/2"], 0);
    run(folder.path(), &["sweep", "merge", "try.toml"], 0);
    assert_eq!(rows(&rows_file(folder.path())), whole);
}

#[test]
fn side_by_side_gives_the_same_rows() {
    let folder = planned("");
    let counted = |threads: &str| {
        run(
            folder.path(),
            &["sweep", "try.toml", "--fresh", "--threads", threads],
            0,
        );
        rows(&rows_file(folder.path()))
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
    assert_eq!(rows(&folder.path().join("results/try-quick/rows.jsonl")).len(), 4);
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
    let outcomes: BTreeMap<String, usize> =
        rows(&rows_file(folder.path()))
            .iter()
            .fold(BTreeMap::new(), |mut all, row| {
                *all.entry(row["outcome"].as_str().unwrap_or("none").to_owned())
                    .or_default() += 1;
                all
            });
    assert_eq!(
        outcomes,
        BTreeMap::from([("skipped".to_owned(), 18)]),
        "skipped cells have rows too"
    );
    let row = &rows(&rows_file(folder.path()))[0];
    assert!(
        row["estimated_triangles"]
            .as_f64()
            .is_some_and(|estimate| estimate > 1.0),
        "{row}"
    );
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
    let first = rows(&rows_file(folder.path()));
    assert_eq!(first.len(), 4);
    for row in &first {
        let number = |place: &str| row.pointer(place).and_then(Value::as_f64).expect("a number");
        assert!((number("/report/triangles") / 3000.0 - 1.0).abs() <= 0.02, "{row}");
        let tries = row["tries"].as_array().expect("tries");
        let last = tries.last().expect("a try");
        assert_eq!(last["triangles"], row["report"]["triangles"]);
        assert_eq!(last["c_b"], row["report"]["c_b"]);
        assert!(
            (number("/report/t") / number("/report/c_b") - 0.25).abs() < 1e-12,
            "the spacing stays"
        );
        assert!((number("/report/alpha") - 0.25).abs() < 1e-12);
    }
    run(folder.path(), &["sweep", "try.toml", "--fresh"], 0);
    assert_eq!(
        rows(&rows_file(folder.path())),
        first,
        "nothing in the search is random"
    );
}
