//! `adapt`: rounds, files that the next mesh can take, and what is refused.

use super::{folder, run};
use serde_json::Value;
use std::fs;

#[test]
fn a_mesh_is_adapted_and_its_field_is_the_spacing_of_the_next() {
    let folder = folder();
    let asked = [
        "adapt",
        "l-shape",
        "--problem",
        "corner",
        "--eps",
        "0.02",
        "--rounds",
        "3",
    ];
    let files = ["--out", "u.vtu", "--report", "r.json"];
    let (out, _) = run(folder.path(), &[&asked[..], &files].concat(), 0);
    assert!(out.contains("round") && out.contains("last mesh: "), "{out}");
    let text = fs::read_to_string(folder.path().join("r.json")).expect("a report");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let rounds = report["rounds"].as_array().expect("rounds");
    assert!((1..=3).contains(&rounds.len()) && report["certificate"]["holds"] == true);
    let relative = report["poisson"]["l2_error"].as_f64().expect("an error")
        / report["poisson"]["l2_norm"].as_f64().expect("a norm");
    assert!(rounds[0]["l2_error"].as_f64().expect("an error") > relative, "{out}");
    run(
        folder.path(),
        &[
            "mesh",
            "l-shape",
            "--spacing",
            "field:u.vtu;eps=0.02",
            "--out",
            "next.vtu",
        ],
        0,
    );
    run(
        folder.path(),
        &["mesh", "l-shape", "--spacing", "nn:next.vtu;factor=1.2"],
        0,
    );
}

#[test]
fn what_cannot_be_adapted_is_bad_input() {
    let folder = folder();
    for (option, value, expected) in [
        ("--problem", "wave", "possible values: smooth, layer"),
        ("--eps=-1", "--sample", "-1"),
        ("--rounds", "0", "0 is not in"),
        ("--out", "mesh.xyz", "no format has this ending"),
    ] {
        let (_, error) = run(folder.path(), &["adapt", "unit-square", option, value], 2);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn a_budget_ends_an_adaptation_with_the_round_it_came_to() {
    let folder = folder();
    let adapt = ["adapt", "l-shape", "--problem", "corner", "--eps", "1e-5"];
    let asked = [&adapt[..], &["--max-vertices", "300", "--out", "m.vtu"]].concat();
    let (_, error) = run(folder.path(), &asked, 4);
    assert!(
        error.contains("on l-shape: round ") && error.contains("max_vertices = 300"),
        "{error}"
    );
    let (_, error) = run(folder.path(), &[&adapt[..], &["--max-seconds", "0.001"]].concat(), 4);
    assert!(
        error.contains("max_seconds = 0.001") && error.contains("raise the budget"),
        "{error}"
    );
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
