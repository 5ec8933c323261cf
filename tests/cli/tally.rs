//! Groups that are tallied: chunks, kills, shards, families without files, expectations.

use super::{folder, run};
use std::fs;
use std::path::Path;

fn plan(folder: &Path, groups: &str) {
    let text = format!(
        r#"
        question = "What comes out?"
        [budget]
        triangles = 3000
        seconds = 5.0
        [expect]
        panicked = 0
        hung = 0
        invalid = 0
        declined_share = 0.5
        skipped_families = 0
        {groups}
        "#
    );
    fs::write(folder.join("try.toml"), text).expect("written");
}

const RANDOM: &str = r#"
    [[group]]
    name = "random"
    tally = { families = ["convex", "fan", "grid"], draws = 3 }
    domains = ["random-pslg:kind={family},seed={seed}"]
    methods = [{ mesher = "biting" }, { mesher = "delaunay-refinement" }]
    spacings = ["lfs"]
    t = [0.25]
    c_b = [0.75]
    quick = { draws = 1 }
"#;

const FILES: &str = r#"
    [[group]]
    name = "files"
    tally = { families = ["outlines"], fetch = "make them" }
    domains = ["{family}"]
    methods = [{ mesher = "biting" }]
    spacings = ["lfs"]
    t = [0.25]
    c_b = [0.75]
"#;

/// The tables of a folder that are the same on every run.
fn tables(folder: &Path) -> [String; 2] {
    ["tally.csv", "cases.csv"].map(|name| fs::read_to_string(folder.join(name)).expect("a table"))
}

#[test]
fn cases_are_tallied_resumed_and_joined_from_shards() {
    let folder = folder();
    plan(folder.path(), RANDOM);
    let (out, _) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("18 cases in 3 chunks, 3 chunks to run"), "{out}");
    let results = folder.path().join("results/try");
    let whole = tables(&results);
    let lines: Vec<&str> = whole[0].lines().collect();
    assert_eq!(lines.len(), 7, "a line a method on a family: {whole:?}");
    assert!(
        lines[0].starts_with("family,method,certified,") && lines[3].starts_with("fan,biting,3,"),
        "{whole:?}"
    );
    let page = fs::read_to_string(results.join("README.md")).expect("a page");
    assert!(page.contains("Of 18 hard cases, "), "{page}");
    assert!(!results.join("journal-cases.jsonl").exists(), "tables are in its place");

    let sharded = |shard: &str| {
        let arguments = ["sweep", "try.toml", "--results", "split", "--shard", shard];
        run(folder.path(), &arguments, 0)
    };
    sharded("1/2");
    let file = folder.path().join("split/try/journal-cases.1-of-2.jsonl");
    let bytes = fs::read(&file).expect("read");
    fs::write(&file, &bytes[..bytes.len() - 100]).expect("cut off, as by a kill");
    let (out, err) = sharded("1/2");
    assert!(out.contains("1 chunks to run") && err.contains("cut off"), "{out}{err}");
    sharded("2/2");
    run(folder.path(), &["sweep", "merge", "try.toml", "--results", "split"], 0);
    assert_eq!(
        tables(&folder.path().join("split/try")),
        whole,
        "the digests of the meshes too"
    );

    let (out, _) = run(folder.path(), &["sweep", "try.toml", "--quick", "--dry-run"], 0);
    assert!(out.contains("try-quick: 6 cases"), "{out}");
}

#[test]
fn a_family_without_files_is_skipped_and_not_passed() {
    let folder = folder();
    plan(folder.path(), &format!("{RANDOM}{FILES}"));
    let (out, err) = run(folder.path(), &["sweep", "try.toml"], 1);
    assert!(
        out.contains("skipped outlines") && out.contains("`make them`"),
        "{out}{err}"
    );

    fs::create_dir(folder.path().join("outlines")).expect("a folder");
    let ring = |points: &str| format!(r#"{{"type": "Polygon", "coordinates": [[{points}]]}}"#);
    let files = [
        ("good", "[0,0],[1,0],[0,1],[0,0]"),
        ("crossing", "[0,0],[1,1],[1,0],[0,1],[0,0]"),
    ];
    for (name, points) in files {
        fs::write(folder.path().join(format!("outlines/{name}.geojson")), ring(points)).expect("written");
    }
    run(folder.path(), &["sweep", "try.toml"], 0);
    let [tally, cases] = tables(&folder.path().join("results/try"));
    let head: Vec<&str> = tally.lines().next().expect("a head").split(',').collect();
    let last: Vec<&str> = tally.lines().last().expect("a line").split(',').collect();
    let count = |verdict: &str| head.iter().position(|name| *name == verdict).map(|place| last[place]);
    assert_eq!(
        (count("certified"), count("refused")),
        (Some("1"), Some("1")),
        "{tally}"
    );
    assert!(
        cases.contains("outlines,biting,refused,outlines/crossing.geojson,"),
        "{cases}"
    );
}

#[test]
fn plans_that_cannot_be_tallied_are_refused() {
    let folder = folder();
    for (wrong, told) in [
        (RANDOM.replace(", draws = 3", ""), "`draws`"),
        (RANDOM.replace("\"fan\"", "\"convex\""), "stands there twice"),
        (RANDOM.replace("t = [0.25]", "t = []"), "`t` is empty"),
        (
            RANDOM.replace("t = [0.25]", "t = [0.25]\ntimed = true"),
            "has no `timed`",
        ),
    ] {
        plan(folder.path(), &wrong);
        let (_, err) = run(folder.path(), &["sweep", "try.toml"], 2);
        assert!(err.contains(told), "{err}");
    }
}
