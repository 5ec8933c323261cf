//! ARCHITECTURE.md's arrows, held to: which module may import which, and who may talk to which crate.

use std::fs;
use std::path::{Path, PathBuf};

/// Modules in pipeline order, as paths below `src/`: each imports only from those before it.
const ORDER: [&str; 18] = [
    "geometry",
    "domain",
    "mesh",
    "delaunay",
    "spacing",
    "meshers",
    "quality",
    "suite/peers",
    "suite/fem",
    "suite/rows",
    "suite/run",
    "suite/analysis",
    "suite/charts",
    "suite/report",
    "suite/lemmas",
    "suite/figures",
    "suite/replay",
    "suite/cli",
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The code of a file outside its tests and docs.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a source file");
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    code.lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect::<Vec<_>>()
        .join("\n")
}

fn src() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn is_test(path: &Path) -> bool {
    let stem = path.file_stem().unwrap_or_default();
    ["tests", "testing", "fixture"].iter().any(|name| stem == *name)
        || path.components().any(|part| part.as_os_str() == "tests")
}

#[test]
fn imports_point_one_way() {
    let mut wrong = Vec::new();
    for (place, module) in ORDER.iter().enumerate() {
        for path in sources(&src().join(module)).into_iter().filter(|path| !is_test(path)) {
            let code = code(&path);
            for later in &ORDER[place + 1..] {
                let later = later.replace('/', "::");
                if code.contains(&format!("crate::{later}::")) || code.contains(&format!("crate::{later};")) {
                    wrong.push(format!("{} imports {later}", path.display()));
                }
            }
        }
    }
    for (module, shunned) in [("quality", "meshers"), ("meshers", "quality")] {
        for path in sources(&src().join(module)).into_iter().filter(|path| !is_test(path)) {
            if code(&path).contains(&format!("crate::{shunned}")) {
                wrong.push(format!("{} imports {shunned}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn one_door_to_each_outside_crate() {
    for (name, door) in [
        ("spade", "delaunay"),
        ("plotters", "suite/charts"),
        ("robust", "geometry"),
        ("rsparse", "suite/fem"),
    ] {
        for path in sources(&src())
            .into_iter()
            .filter(|path| !path.starts_with(src().join(door)))
        {
            let code = code(&path);
            let talks = code.contains(&format!("use {name}::")) || code.contains(&format!(" {name}::"));
            assert!(!talks, "{} talks to {name}; only {door} may", path.display());
        }
    }
}

#[test]
fn files_and_docs_keep_their_size() {
    for path in sources(&src()).into_iter().filter(|path| !is_test(path)) {
        let lines = fs::read_to_string(&path).expect("a source file").lines().count();
        assert!(lines <= 420, "{} has {lines} lines; split it by step", path.display());
    }
}

#[test]
fn the_library_does_not_print() {
    for path in sources(&src())
        .into_iter()
        .filter(|path| !path.starts_with(src().join("suite/cli")))
    {
        let code = code(&path);
        for word in ["println!", "eprintln!", "print!(", "dbg!"] {
            assert!(!code.contains(word), "{} has {word}", path.display());
        }
    }
}
