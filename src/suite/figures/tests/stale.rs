//! The committed files are what the code draws now.

use super::super::drawing::Picture;
use super::super::{FIGURES, page};
use super::material;
use std::fs;
use std::path::{Path, PathBuf};

const AGAIN: &str = "is stale: run `cargo run --release -- figures` and look at what changed";

fn committed(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("paper").join(name)
}

fn read(name: &str) -> String {
    fs::read_to_string(committed(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Numbers, captions with the hash of the numbers, and where the picture is of scenes the picture itself.
#[test]
fn no_figure_is_stale() {
    let folder = tempfile::tempdir().unwrap();
    for entry in FIGURES {
        let drawing = (entry.draw)(material()).unwrap();
        let file = |ending: &str| format!("figures/{}.{ending}", entry.name);
        assert!(
            read(&file("json")) == page::numbers(&drawing),
            "{} {AGAIN}",
            file("json")
        );
        assert!(
            read(&file("md")) == page::caption(entry, &drawing),
            "{} {AGAIN}",
            file("md")
        );
        assert!(committed(&file("png")).exists(), "{} is missing", file("png"));
        if let Picture::Sheet(sheet) = &drawing.picture {
            let path = folder.path().join("drawn.svg");
            sheet.write_svg(&path).unwrap();
            assert!(
                read(&file("svg")) == fs::read_to_string(&path).unwrap(),
                "{} {AGAIN}",
                file("svg")
            );
        } else {
            assert!(committed(&file("svg")).exists(), "{} is missing", file("svg"));
        }
    }
    assert!(read("README.md") == page::readme(FIGURES), "paper/README.md {AGAIN}");
}

#[test]
fn a_changed_number_changes_the_hash() {
    let numbers = |value: f64| serde_json::Value::from(super::super::drawing::Numbers::default().number("t", value));
    assert_eq!(page::hash(&numbers(0.25)), page::hash(&numbers(0.25)));
    assert_ne!(page::hash(&numbers(0.25)), page::hash(&numbers(0.250_000_001)));
}
