//! Groups that are tallied: chunks, kills, shards, families without files, expectations.

use super::{folder, run};
use serde_json::Value;
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

/// The chunks of a file, without what may differ from run to run.
fn chunks(file: &Path) -> Vec<Value> {
    let text = fs::read_to_string(file).expect("chunks");
    let parse = |line: &str| {
        let mut chunk: Value = serde_json::from_str(line).expect("a chunk");
        chunk["provenance"] = Value::Null;
        if let Some(tallies) = chunk["tallies"].as_array_mut() {
            tallies.iter_mut().for_each(|tally| tally["seconds"] = Value::Null);
        }
        chunk
    };
    text.lines().map(parse).collect()
}

#[test]
fn cases_are_tallied_resumed_and_joined_from_shards() {
    let folder = folder();
    plan(folder.path(), RANDOM);
    let (out, _) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("18 cases in 3 chunks, 3 chunks to run"), "{out}");
    let file = folder.path().join("results/try/chunks.jsonl");
    let whole = chunks(&file);
    assert_eq!(whole.len(), 3);
    assert_eq!(whole[1]["tallies"][0]["cases"]["certified"], 3, "{whole:?}");
    let page = fs::read_to_string(folder.path().join("results/try/README.md")).expect("a page");
    assert!(page.contains("Of 18 hard cases, "), "{page}");

    let bytes = fs::read(&file).expect("read");
    fs::write(&file, &bytes[..bytes.len() - 100]).expect("cut off, as by a kill");
    let (out, err) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("1 chunks to run") && err.contains("cut off"), "{out}{err}");
    assert_eq!(chunks(&file), whole, "the digests of the meshes too");

    for shard in ["1/2", "2/2"] {
        run(
            folder.path(),
            &["sweep", "try.toml", "--results", "split", "--shard", shard],
            0,
        );
    }
    run(folder.path(), &["sweep", "merge", "try.toml", "--results", "split"], 0);
    assert_eq!(chunks(&folder.path().join("split/try/chunks.jsonl")), whole);

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
    let (out, _) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("1 chunks to run"), "{out}");
    let found = chunks(&folder.path().join("results/try/chunks.jsonl"));
    let cases = &found[3]["tallies"][0]["cases"];
    assert_eq!(
        (&cases["certified"], &cases["refused"]),
        (&Value::from(1), &Value::from(1)),
        "{found:?}"
    );
    assert!(
        found[3]["uncertified"][0]["command"]
            .as_str()
            .is_some_and(|text| text.contains("crossing.geojson"))
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
