//! `figures --replay`: what is written, and what is refused.

use super::{folder, run};
use std::fs;

#[test]
fn a_replay_is_one_page() {
    let folder = folder();
    let (out, _) = run(
        folder.path(),
        &["figures", "--replay", "l-shape", "--param", "order=fifo"],
        0,
    );
    assert!(out.contains("replay-l-shape.html"), "{out}");
    let page = fs::read_to_string(folder.path().join("paper/replay-l-shape.html")).expect("the page");
    assert!(page.starts_with("<!doctype html>") && page.contains("\"order\":\"fifo\""));
    run(
        folder.path(),
        &["figures", "--replay", "l-shape", "--out", "elsewhere"],
        0,
    );
    assert!(folder.path().join("elsewhere/replay-l-shape.html").exists());
}

#[test]
fn what_is_too_large_or_not_there_is_refused() {
    let folder = folder();
    let fine = ["figures", "--replay", "unit-square", "--spacing", "uniform:0.001"];
    let (_, err) = run(folder.path(), &fine, 4);
    assert!(err.contains("20000"), "{err}");
    run(folder.path(), &["figures", "--replay", "nowhere"], 2);
    // Without a replay these options would have no effect.
    run(folder.path(), &["figures", "--t", "0.1"], 2);
    run(
        folder.path(),
        &["figures", "--replay", "l-shape", "--param", "order=none"],
        2,
    );
    let later = ["figures", "--replay", "l-shape", "--param", "rule=later"];
    let (_, err) = run(folder.path(), &later, 2);
    assert!(err.contains("leave out rule"), "{err}");
    assert!(!folder.path().join("paper").exists());
}
