//! The code is as the tree in ARCHITECTURE.md: which module may import which, and which may use which crate.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Roots of the crate and of the suite: they declare modules, and import nothing.
const ROOTS: [&str; 3] = ["lib", "main", "suite/mod"];

/// Writes files for any module, and imports nothing.
const FILES: &str = "suite/files";

/// The tree of ARCHITECTURE.md: modules as paths below `src/`, each of which imports only from those before it.
fn order() -> Vec<String> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let lines = text.lines().filter_map(|line| line.strip_prefix("src/"));
    let modules = lines.filter_map(|line| line.split_whitespace().next());
    modules.map(str::to_owned).collect()
}

/// The module of a source file, as the tree names it.
fn module(path: &Path) -> String {
    let below = path.strip_prefix(src()).expect("a file below src").with_extension("");
    let names: Vec<_> = below.iter().map(|name| name.to_string_lossy()).collect();
    let depth = if names[0] == "suite" { 2 } else { 1 };
    names[..depth.min(names.len())].join("/")
}

/// The modules that code imports by paths from the crate's root; those written as a group are named `{`.
fn imported(code: &str) -> BTreeSet<String> {
    let first = |path: &str| {
        let is_end = |letter: char| !(letter.is_alphanumeric() || letter == '_');
        let name = path.split(is_end).next().unwrap_or_default();
        if name.is_empty() {
            "{".to_owned()
        } else {
            name.to_owned()
        }
    };
    let paths = code.split("crate::").skip(1);
    paths
        .map(|path| match path.strip_prefix("suite::") {
            Some(path) => format!("suite/{}", first(path)),
            // The one type at the root.
            None => first(path).replace("Case", "case"),
        })
        .collect()
}

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

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn src() -> PathBuf {
    root().join("src")
}

fn is_test(path: &Path) -> bool {
    let stem = path.file_stem().unwrap_or_default();
    ["tests", "testing", "fixture"].iter().any(|name| stem == *name)
        || path.components().any(|part| part.as_os_str() == "tests")
}

/// All source files but tests.
fn product() -> impl Iterator<Item = PathBuf> {
    sources(&src()).into_iter().filter(|path| !is_test(path))
}

#[test]
fn the_tree_has_every_module_once() {
    let tree = order();
    let known: BTreeSet<&str> = tree.iter().map(String::as_str).collect();
    assert_eq!(known.len(), tree.len(), "twice in ARCHITECTURE.md");
    let there: BTreeSet<String> = product().map(|path| module(&path)).collect();
    let there = there.iter().map(String::as_str);
    let there: BTreeSet<&str> = there.filter(|name| !ROOTS.contains(name) && *name != FILES).collect();
    assert_eq!(known, there);
}

#[test]
fn imports_point_one_way() {
    let tree = order();
    let place = |module: &str| tree.iter().position(|other| other == module);
    let mut wrong = Vec::new();
    for path in product() {
        let own = module(&path);
        if ROOTS.contains(&own.as_str()) {
            continue;
        }
        for other in imported(&code(&path)) {
            let may = own == other
                || (own.starts_with("suite/") && other == FILES)
                || place(&own).zip(place(&other)).is_some_and(|(own, other)| other < own)
                    && [own.as_str(), &other] != ["quality", "meshers"];
            if !may {
                wrong.push(format!("{} imports {other}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn imports_are_seen() {
    let code = "use crate::suite::run::plan;\nuse crate::{domain, mesh};\nlet case = crate::Case::new();";
    let found: Vec<String> = imported(code).into_iter().collect();
    assert_eq!(found, ["case", "suite/run", "{"]);
}

#[test]
fn no_mesher_imports_another() {
    let folders = fs::read_dir(src().join("meshers")).expect("a folder");
    let folders = folders.map(|entry| entry.expect("an entry").path());
    let meshers: Vec<PathBuf> = folders.filter(|path| path.is_dir()).collect();
    assert!(meshers.len() > 1);
    for own in &meshers {
        let files = sources(own).into_iter().filter(|path| !is_test(path));
        for (path, other) in files.flat_map(|path| meshers.iter().map(move |other| (path.clone(), other))) {
            let name = other.file_name().expect("a name").to_string_lossy();
            let imports = own != other && code(&path).contains(&format!("::{name}::"));
            assert!(!imports, "{} imports {name}", path.display());
        }
    }
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
            assert!(!talks, "{} uses {name}; only {door} may", path.display());
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
