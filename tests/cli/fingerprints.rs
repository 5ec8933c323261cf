//! Bit-equal meshes by debug and release builds, whatever the number of threads. `tests/fingerprints.txt` has the
//! fingerprints of the release build (`.ci/fingerprints` writes it); these tests compare the build under test with it.

use super::{folder, run};
use biting::meshers::MESHERS;
use serde_json::Value;
use std::fs;

const TABLE: &str = include_str!("../fingerprints.txt");

/// Fingerprint and arguments of each case.
fn cases() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    TABLE.lines().filter(|line| !line.starts_with('#')).map(|line| {
        let mut words = line.split_whitespace();
        (words.next().expect("a fingerprint"), words.collect())
    })
}

#[test]
fn meshes_are_those_of_the_release_build() {
    for entry in MESHERS {
        let of_entry = cases().filter(|(_, arguments)| arguments.last() == Some(&entry.name));
        assert!(of_entry.count() >= 5, "{}: run .ci/fingerprints", entry.name);
    }
    let folder = folder();
    let report = folder.path().join("report.json");
    for (number, (fingerprint, arguments)) in cases().enumerate() {
        // Every case runs with one thread or with many, and the first of each mesher with both.
        let threads: &[&str] = match number % 5 {
            0 => &["1", "4"],
            odd if odd % 2 == 1 => &["3"],
            _ => &["1"],
        };
        for threads in threads {
            let more = ["--threads", threads, "--report", "report.json"];
            run(folder.path(), &[&["mesh"], &arguments[..], &more[..]].concat(), 0);
            let found: Value = serde_json::from_slice(&fs::read(&report).expect("read")).expect("JSON");
            assert_eq!(
                found["fingerprint"], fingerprint,
                "{arguments:?} with {threads} threads"
            );
        }
    }
}
