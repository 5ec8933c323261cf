//! The command line as a user sees it: exit statuses, messages and files; sweeps that are killed and resumed.

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::Path;

mod adapt;
#[cfg(unix)]
mod compare;
#[cfg(unix)]
mod disk;
mod fingerprints;
mod replay;
mod sweep;
mod tally;

fn biting(folder: &Path) -> Command {
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("biting");
    command.current_dir(folder);
    command
}

/// Runs the program, asserts its exit status, and returns standard output and standard error.
fn run(folder: &Path, arguments: &[&str], status: i32) -> (String, String) {
    let output = biting(folder).args(arguments).output().expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(status), "biting {arguments:?}\n{out}\n{err}");
    (out, err)
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

const CROSSED: &str = "4 2 0 0\n1 0 0\n2 1 1\n3 1 0\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";

#[test]
fn one_figure_alone_is_four_files_and_the_table() {
    let folder = folder();
    run(folder.path(), &["figures", "--only", "figure1", "--out", "."], 0);
    assert_eq!(names(folder.path()), ["README.md", "figures"]);
    let files = ["figure1.json", "figure1.md", "figure1.png", "figure1.svg"];
    assert_eq!(names(&folder.path().join("figures")), files);
}

#[test]
fn bad_input_is_reported_in_one_message_with_file_line_and_remedy() {
    let folder = folder();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    write("crossed.poly", CROSSED);
    write("letters.poly", "4 2 0 0\n1 0 0\n2 one 1\n");
    write("plan.toml", "question = \"?\"\n[[group]]\nname = 3\n");
    write("unknown.toml", &plan("").replace("\"biting\"", "\"nibbling\""));
    for (arguments, expected) in [
        (&["mesh", "nowhere.poly"][..], &["nowhere.poly"][..]),
        (&["mesh", "no-such-name"], &["no-such-name"]),
        (&["figures", "--only", "figure9"], &["figure9", "figure1"]),
        (
            &["figures", "--only", "study-size"],
            &["meshes.csv", "--results", "--only"],
        ),
        (&["mesh", "crossed.poly"], &["crossed.poly", "cross", "--repair"]),
        (&["mesh", "letters.poly"], &["letters.poly", "3"]),
        (&["mesh", "l-shape", "--spacing", "expr:x+"], &["expr:x+", "column 8"]),
        (&["mesh", "l-shape", "--spacing", "lsf"], &["lsf", "lfs"]),
        (
            &["mesh", "l-shape", "--mesher", "nibbling"],
            &["nibbling", "biting list"],
        ),
        (&["mesh", "l-shape", "--param", "order=tasty"], &["tasty", "fifo"]),
        (&["mesh", "l-shape", "--t", "0"], &["--t", "positive"]),
        (&["mesh", "l-shape", "--out", "mesh.xyz"], &["mesh.xyz", ".vtu"]),
        (&["check", "l-shape", "nowhere.vtu"], &["nowhere.vtu"]),
        (&["sweep", "plan.toml"], &["plan.toml", "line 3"]),
        (&["sweep", "nowhere.toml"], &["nowhere.toml", "biting list"]),
        (&["sweep", "unknown.toml"], &["unknown.toml", "nibbling"]),
        (&["sweep", "plan.toml", "--shard", "3/2"], &["3/2", "I/N"]),
        (&["report", "nowhere"], &["nowhere"]),
    ] {
        let (_, message) = run(folder.path(), arguments, 2);
        for part in expected {
            assert!(message.contains(part), "{arguments:?} should name {part}: {message}");
        }
        assert!(!message.contains("panicked"), "{message}");
    }
    assert_eq!(
        names(folder.path()),
        ["crossed.poly", "letters.poly", "plan.toml", "unknown.toml"]
    );
}

#[test]
fn list_names_what_there_is() {
    let (out, _) = run(Path::new(env!("CARGO_MANIFEST_DIR")), &["list"], 0);
    for name in [
        "unit-square",
        "biting",
        "--param order=",
        "lfs",
        "uniform:H",
        "experiments/sweep.toml",
    ] {
        assert!(out.contains(name), "{name} is missing in {out}");
    }
}

/// The fields that every report must have, since scripts use them.
const FIELDS: &str = "domain mesher params spacing t t_effective c_b alpha seed vertices triangles integral size_ratio \
    size_efficiency min_angle_deg min_angle_free_deg min_angle_bound_deg max_angle_deg mean_min_angle_deg \
    p05_min_angle_deg max_radius_edge edge_over_size nn_over_f seconds peak_rss_bytes certificate provenance";

#[test]
fn a_mesh_its_files_and_its_report() {
    let folder = folder();
    let mut arguments = vec![
        "mesh",
        "l-shape",
        "--t",
        "1/4",
        "--c-b",
        "0.5",
        "--report",
        "report.json",
    ];
    let files = [
        "m.node",
        "m.vtu",
        "m.msh",
        "m.obj",
        "m.svg",
        "m.png",
        "m.json",
        "domain.poly",
    ];
    for file in files {
        arguments.extend(["--out", file]);
    }
    let (out, _) = run(folder.path(), &arguments, 0);
    for file in files.iter().chain(&["m.ele", "report.json"]) {
        assert!(out.contains(&format!("wrote {file}")), "{file} is not reported: {out}");
        assert!(
            fs::metadata(folder.path().join(file)).expect("written").len() > 0,
            "{file}"
        );
    }
    assert_eq!(
        names(folder.path()).len(),
        files.len() + 2,
        "nothing else is left behind"
    );
    let report: Value =
        serde_json::from_slice(&fs::read(folder.path().join("report.json")).expect("read")).expect("JSON");
    for field in FIELDS.split_whitespace() {
        assert!(
            report.get(field).is_some_and(|value| !value.is_null()),
            "{field} is missing"
        );
    }
    for mesh in ["m.node", "m.vtu", "m.msh", "m.obj", "m.json"] {
        run(folder.path(), &["check", "domain.poly", mesh], 0);
        run(
            folder.path(),
            &[
                "check",
                "l-shape",
                mesh,
                "--spacing",
                "lfs",
                "--t",
                "1/4",
                "--c-b",
                "0.5",
            ],
            0,
        );
    }
}

#[test]
fn a_damaged_mesh_fails_the_check() {
    let folder = folder();
    run(
        folder.path(),
        &["mesh", "comb", "--t", "0.5", "--c-b", "1", "--out", "m.node"],
        0,
    );
    let path = folder.path().join("m.ele");
    let text = fs::read_to_string(&path).expect("read");
    let mut lines: Vec<&str> = text.lines().collect();
    let count: usize = lines[0]
        .split_whitespace()
        .next()
        .and_then(|count| count.parse().ok())
        .expect("a count");
    let first = format!("{} 3 1", count - 1);
    lines[0] = &first;
    lines.remove(count);
    fs::write(&path, lines.join("\n")).expect("written");
    let (out, err) = run(folder.path(), &["check", "comb", "m.node"], 1);
    assert!(out.contains("NO") && err.contains("area"), "{out}{err}");
}

#[test]
fn equal_input_gives_equal_bytes() {
    let folder = folder();
    for (name, threads) in [("a.json", "1"), ("b.json", "1"), ("c.json", "4")] {
        let order = "order=random";
        run(
            folder.path(),
            &["mesh", "comb", "--param", order, "--threads", threads, "--out", name],
            0,
        );
    }
    let read = |name: &str| fs::read(folder.path().join(name)).expect("read");
    assert!(read("a.json") == read("b.json") && read("a.json") == read("c.json"));
    run(
        folder.path(),
        &[
            "mesh",
            "comb",
            "--param",
            "order=random",
            "--seed",
            "1",
            "--out",
            "d.json",
        ],
        0,
    );
    assert!(read("a.json") != read("d.json"), "the seed matters");
}

#[test]
fn a_domain_that_crosses_itself_is_mended_on_request() {
    let folder = folder();
    fs::write(folder.path().join("crossed.poly"), CROSSED).expect("written");
    let (_, message) = run(
        folder.path(),
        &["mesh", "crossed.poly", "--repair", "--out", "m.node"],
        0,
    );
    assert!(message.contains("repair of crossed"), "{message}");
    run(folder.path(), &["check", "crossed.poly", "m.node"], 2);
    run(folder.path(), &["check", "crossed.poly", "m.node", "--repair"], 0);
}

#[test]
fn a_budget_stops_with_the_reason_and_leaves_nothing() {
    let folder = folder();
    let (_, message) = run(
        folder.path(),
        &["mesh", "comb", "--max-vertices", "60", "--out", "m.vtu"],
        4,
    );
    assert!(
        message.contains("max_vertices") && message.contains("to be expected"),
        "{message}"
    );
    assert!(names(folder.path()).is_empty());
}

#[test]
fn without_a_budget_no_mesh_is_begun_that_memory_cannot_hold() {
    let folder = folder();
    let (_, message) = run(folder.path(), &["mesh", "unit-square", "--spacing", "uniform:1e-12"], 4);
    assert!(
        message.contains("triangles were to be expected") && message.contains("(0.0, 0.0)"),
        "{message}"
    );
}

/// Limiting that spacing takes many seconds, before any mesher runs.
#[test]
fn a_budget_is_noticed_while_the_spacing_is_made() {
    let folder = folder();
    for budget in [["--max-seconds", "0.1"], ["--max-memory", "1"]] {
        let (_, message) = run(
            folder.path(),
            &[&["mesh", "aegean", "--t", "0.01", "--out", "m.vtu"], &budget[..]].concat(),
            4,
        );
        assert!(
            message.contains("stopped by max_") && message.contains("aegean") && message.contains("raise the budget"),
            "{message}"
        );
        assert!(names(folder.path()).is_empty());
    }
}

#[test]
fn standard_output_carries_only_the_mesh_or_the_report() {
    let folder = folder();
    for (option, is_it) in [
        ("--out", (|json| json["triangles"].is_array()) as fn(&Value) -> bool),
        ("--report", |json| {
            json["triangles"].is_u64() && json["certificate"]["holds"] == true
        }),
    ] {
        let arguments = ["mesh", "unit-square", "--size", "0.2", option, "-"];
        let (out, err) = run(folder.path(), &arguments, 0);
        assert!(
            is_it(&serde_json::from_str(&out).expect("JSON and nothing else")),
            "{out}"
        );
        assert!(err.contains("triangles"), "the summary goes to standard error: {err}");
    }
    let both = ["mesh", "unit-square", "--out", "-", "--report", "-"];
    let (_, message) = run(folder.path(), &both, 2);
    assert!(message.contains("--out and --report both name -"), "{message}");
    assert!(names(folder.path()).is_empty());
}

/// A plan of 18 cells on three domains, two of the cells timed.
fn plan(expectations: &str) -> String {
    format!(
        r#"question = "Does a sweep come through?"
[budget]
triangles = 3000
[expect]
{expectations}
[[group]]
name = "grid"
domains = ["unit-square", "l-shape"]
spacings = ["lfs", "expr:0.1*{{w}} + 0.2*sqrt((x - {{x0}})^2 + (y - {{y0}})^2)"]
mesher = "biting"
t = [0.25, 0.5]
c_b = [0.25, 1.0]
quick = {{ domains = ["unit-square"], spacings = ["lfs"] }}
[[group]]
name = "time"
domains = ["unit-square"]
spacings = ["uniform:0.1", "uniform:0.05"]
mesher = "biting"
t = [0.25]
c_b = [1.0]
timed = true
repeats = 2
"#
    )
}
