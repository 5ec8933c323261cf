//! Disks that are full, folders that cannot be written, kills in the middle of a write, two sweeps into one folder.

use super::{folder, names, plan, run};
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Runs the program so that no file may grow beyond a given number of blocks of 512 bytes. To a process that ignores
/// the signal, this is a full disk.
fn on_a_full_disk(folder: &Path, blocks: u32, arguments: &[&str]) -> Output {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    Command::new("sh")
        .args(["-c", &script])
        .arg(assert_cmd::cargo::cargo_bin!("biting"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("a shell")
}

const SMALL: [&str; 4] = ["mesh", "unit-square", "--size", "0.06"];

#[test]
fn a_full_disk_is_reported_and_leaves_the_old_file() {
    for target in ["m.node", "m.vtu", "m.msh", "m.obj", "m.svg", "m.json", "m.png"] {
        let folder = folder();
        fs::write(folder.path().join(target), "old").expect("written");
        let output = on_a_full_disk(folder.path(), 2, &[&SMALL[..], &["--out", target]].concat());
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{target}: {message}");
        assert!(message.contains(target) && !message.contains("panicked"), "{message}");
        assert_eq!(names(folder.path()), [target], "nothing is left beside it");
        assert_eq!(fs::read(folder.path().join(target)).expect("read"), b"old");
    }
}

#[test]
fn a_sweep_on_a_full_disk_is_reported_and_resumed() {
    let folder = folder();
    fs::write(folder.path().join("try.toml"), plan("")).expect("written");
    let output = on_a_full_disk(folder.path(), 24, &["sweep", "try.toml", "--threads", "1"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("journal.jsonl") && !told.contains("panicked"), "{told}");
    let (out, _) = run(folder.path(), &["sweep", "try.toml"], 0);
    assert!(out.contains("are done"), "rows from before are kept: {out}");
    let text = fs::read_to_string(folder.path().join("results/try/meshes.csv")).expect("a table");
    assert_eq!(text.lines().count(), 19);
}

#[test]
fn a_folder_that_cannot_be_is_reported() {
    let folder = folder();
    fs::write(folder.path().join("file"), "").expect("written");
    for more in [["--out", "file/below/m.node"], ["--report", "file/m.json"]] {
        let (_, message) = run(folder.path(), &[&SMALL[..], &more[..]].concat(), 2);
        assert!(message.contains(more[1]) || message.contains("file"), "{message}");
    }
    fs::write(folder.path().join("try.toml"), plan("")).expect("written");
    let (_, message) = run(folder.path(), &["sweep", "try.toml", "--results", "file"], 2);
    assert!(message.contains("file"), "{message}");
    assert_eq!(names(folder.path()), ["file", "try.toml"]);
}

#[test]
fn a_kill_leaves_the_old_file_or_the_new_one() {
    let folder = folder();
    let new = [&SMALL[..], &["--out", "m.vtu"]].concat();
    run(folder.path(), &new, 0);
    let path = folder.path().join("m.vtu");
    let whole = fs::read(&path).expect("read");
    for moment in 0..12 {
        fs::write(&path, "old").expect("written");
        let mut mesh = Command::new(assert_cmd::cargo::cargo_bin!("biting"))
            .args(&new)
            .current_dir(folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        sleep(Duration::from_millis(8 * moment));
        // The program may have been faster.
        let _ = mesh.kill();
        mesh.wait().expect("ended");
        let left = fs::read(&path).expect("read");
        assert!(left == b"old" || left == whole, "{} bytes at {moment}", left.len());
    }
}

#[test]
fn a_second_sweep_into_one_folder_is_reported() {
    let folder = folder();
    fs::write(folder.path().join("try.toml"), plan("")).expect("written");
    let sweep = ["sweep", "try.toml", "--threads", "1"];
    let mut first = Command::new(assert_cmd::cargo::cargo_bin!("biting"))
        .args(sweep)
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    while !folder.path().join("results/try/journal.jsonl").exists() && first.try_wait().expect("known").is_none() {
        sleep(Duration::from_millis(1));
    }
    let second = Command::new(assert_cmd::cargo::cargo_bin!("biting"))
        .args(sweep)
        .current_dir(folder.path())
        .output()
        .expect("the program starts");
    let was_running = first.try_wait().expect("known").is_none();
    assert!(first.wait().expect("ended").success());
    let message = String::from_utf8_lossy(&second.stderr);
    if was_running {
        assert_eq!(second.status.code(), Some(2), "{message}");
        assert!(
            message.contains("another sweep (process") && message.contains("--shard"),
            "{message}"
        );
    }
    let text = fs::read_to_string(folder.path().join("results/try/meshes.csv")).expect("a table");
    assert_eq!(text.lines().count(), 19);
}
