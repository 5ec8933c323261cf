//! `compare` with a peer that is a shell script: installed, run, judged, ended at its limits; no Python, no network.

use super::{folder, run};
use biting::suite::{Outcome, Row, Tables};
use serde_json::Value;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// A script in place of `python3`. It makes a virtual environment whose `python` is this script too, installs nothing,
/// and as an adapter does what FAKE says.
const PYTHON: &str = r#"#!/bin/sh
case "$1 $2" in
"-m venv") mkdir -p "$3/bin" && cp "$0" "$3/bin/python" ;;
"-m pip") exit 0 ;;
*)
    case "$FAKE" in
    mesh | turned)
        printf '4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n' >mesh.node
        if [ "$FAKE" = mesh ]; then corners='0 1 2'; else corners='0 2 1'; fi
        printf '2 3 0\n0 %s\n1 0 2 3\n' "$corners" >mesh.ele
        printf '{"version":"7.8","seconds":{"imports":0.5,"mesh":0.25},"rss_before_bytes":1000,"peak_rss_bytes":5000,"counts":{"rounds":3}}' >answer.json
        cp request.json "$KEPT"
        ;;
    decline) echo "no such domain" >&2; exit 4 ;;
    crash) echo "first" >&2; echo "out of cheese" >&2; exit 9 ;;
    wait) echo $$ >"$KEPT"; exec sleep 1000 ;;
    esac
    ;;
esac
"#;

const PLAN: &str = r#"
question = "?"
[budget]
seconds = 60
[[group]]
name = "meshers"
domains = ["unit-square"]
spacings = ["uniform:2"]
methods = [{ mesher = "biting" }, { mesher = "triangle", params = { angle = 20 } }]
t = [0.25]
c_b = [0.5]
timed = true
repeats = 1
"#;

/// A folder with the plan, a `python3`, and a cache for peers.
fn prepared() -> tempfile::TempDir {
    let folder = folder();
    fs::write(folder.path().join("try.toml"), PLAN).expect("written");
    let python = folder.path().join("python3");
    fs::write(&python, PYTHON).expect("written");
    fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).expect("made a program");
    folder
}

/// `compare` in the checkout, with that folder's `python3` and cache.
fn command(folder: &Path, fake: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_biting"));
    let path = std::env::var("PATH").unwrap_or_default();
    command
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("PATH", format!("{}:{path}", folder.display()))
        .env("BITING_PEERS", folder.join("peers"))
        .env("FAKE", fake)
        .env("KEPT", folder.join("kept"))
        .arg("compare")
        .arg(folder.join("try.toml"))
        .arg("--results")
        .arg(folder.join(fake));
    command
}

fn compare(folder: &Path, fake: &str, more: &[&str]) -> Output {
    command(folder, fake).args(more).output().expect("the program starts")
}

fn install(folder: &Path) {
    let output = compare(folder, "none", &["--install", "--only", "triangle"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// The peer's row.
fn row(folder: &Path, fake: &str) -> Row {
    let rows = Tables::read(&folder.join(fake).join("try")).expect("tables").rows;
    rows.into_iter()
        .find(|row| row.cell.mesher == "triangle")
        .expect("the peer's row")
}

#[test]
fn a_peer_that_is_not_there_is_skipped_or_asked_for() {
    let folder = prepared();
    let output = compare(folder.path(), "mesh", &[]);
    assert_eq!(output.status.code(), Some(0));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        said.contains("triangle: not installed; `biting compare --install --only triangle`"),
        "{said}"
    );
    assert_eq!(row(folder.path(), "mesh").outcome, Outcome::Skipped);
    let output = compare(folder.path(), "mesh", &["--only", "triangle"]);
    assert_eq!(output.status.code(), Some(2), "it was named");
    // Installed meanwhile, its cell is run.
    install(folder.path());
    assert_eq!(compare(folder.path(), "mesh", &[]).status.code(), Some(0));
    let measured = row(folder.path(), "mesh");
    assert_eq!(measured.outcome, Outcome::Measured);
    // Gone again, or not asked for: what was measured stays.
    fs::remove_dir_all(folder.path().join("peers")).expect("removed");
    assert_eq!(compare(folder.path(), "mesh", &[]).status.code(), Some(0));
    assert_eq!(row(folder.path(), "mesh"), measured);
    assert_eq!(
        compare(folder.path(), "mesh", &["--only", "biting"]).status.code(),
        Some(0)
    );
    assert_eq!(row(folder.path(), "mesh"), measured);
}

#[test]
fn a_peer_gets_the_request_and_its_mesh_is_judged() {
    let folder = prepared();
    install(folder.path());
    assert!(compare(folder.path(), "mesh", &[]).status.success());
    let request: Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("kept")).expect("kept")).expect("JSON");
    assert_eq!(request["protocol"], 1);
    assert_eq!(request["parameters"]["angle"], 20);
    assert_eq!(request["parameters"]["passes"], 30, "defaults are passed too");
    // lfs of the unit square caps f at 1 in its middle: the size is not uniform, so it is a field.
    assert_eq!(request["size"]["field"], "size.field");
    assert_eq!(request["size"]["scale"], 0.5);
    let row = row(folder.path(), "mesh");
    let report = row.report.expect("measured");
    assert_eq!((row.outcome, report.statistics.triangles), (Outcome::Measured, 2));
    let times = report.times.expect("timed");
    assert_eq!(times.seconds.total, 0.25, "its own clock");
    assert_eq!((times.rss_before_bytes, times.peak_rss_bytes), (1000, 5000));
    let told = report.outside.expect("a peer");
    assert_eq!((told.version.as_str(), told.set_up_seconds["imports"]), ("7.8", 0.5));
    assert_eq!(report.counts["rounds"], 3.0);
    assert!(folder.path().join("mesh/try/README.md").exists());
}

#[test]
fn what_goes_wrong_becomes_a_row_with_its_reason() {
    let folder = prepared();
    install(folder.path());
    for (fake, outcome, reason) in [
        ("decline", Outcome::Declined, "no such domain"),
        ("crash", Outcome::Failed, "out of cheese"),
        ("nothing", Outcome::Failed, "answer.json"),
        ("turned", Outcome::Failed, "positive-orientation"),
    ] {
        assert_eq!(compare(folder.path(), fake, &[]).status.code(), Some(0), "{fake}");
        let row = row(folder.path(), fake);
        let told = row.reason.unwrap_or_default();
        assert!(row.outcome == outcome && told.contains(reason), "{fake}: {told}");
        assert_eq!(
            row.report.is_some(),
            fake == "turned",
            "a mesh that does not conform keeps its numbers"
        );
    }
}

#[test]
fn nothing_is_left_of_a_peer_whose_comparison_is_killed() {
    if !Path::new("/usr/bin/setpriv").exists() {
        return;
    }
    let folder = prepared();
    install(folder.path());
    let mut running = command(folder.path(), "wait").spawn().expect("the program starts");
    let kept = folder.path().join("kept");
    let start = Instant::now();
    while fs::read_to_string(&kept).map_or(0, |text| text.len()) == 0 {
        assert!(start.elapsed() < Duration::from_secs(60), "the peer starts");
        std::thread::sleep(Duration::from_millis(20));
    }
    running.kill().expect("killed");
    running.wait().expect("waited for");
    let process = fs::read_to_string(&kept).expect("its number");
    let is_there =
        || fs::read_to_string(format!("/proc/{}/stat", process.trim())).is_ok_and(|stat| !stat.contains(") Z "));
    let start = Instant::now();
    while is_there() {
        assert!(
            start.elapsed() < Duration::from_secs(10),
            "the peer outlives the comparison"
        );
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn names_that_do_not_exist_are_refused() {
    let folder = prepared();
    let folder = folder.path();
    let (_, said) = run(folder, &["compare", "try.toml", "--only", "pentagle"], 2);
    assert!(said.contains("no mesher `pentagle`"), "{said}");
    let (_, said) = run(folder, &["compare", "--install", "--only", "biting"], 2);
    assert!(said.contains("nothing to install"), "{said}");
}
