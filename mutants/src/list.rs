//! The mutants: names, places and replacements as cargo-mutants lists them.

use anyhow::{Context, Result, ensure};
use serde::Deserialize;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;
use std::process::Command;

/// Line and column, both from 1, columns in characters.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    pub line: usize,
    pub column: usize,
}

/// From the first character to behind the last.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
pub struct Span {
    pub start: Place,
    pub end: Place,
}

/// What cargo-mutants does at a place.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
pub enum Genre {
    FnValue,
    BinaryOperator,
    UnaryOperator,
    MatchArm,
    MatchArmGuard,
    StructField,
}

/// One mutant.
#[derive(Clone, Debug, Deserialize)]
pub struct Mutant {
    /// File, line, column and change: what cargo-mutants calls it.
    pub name: String,
    /// Path from the root of the crate.
    pub file: String,
    pub span: Span,
    pub replacement: String,
    pub genre: Genre,
    /// The source line it starts in, trimmed, as it was when the list was made.
    #[serde(skip)]
    pub line: String,
}

impl Mutant {
    /// The name without line and column: what stays when lines above it come and go.
    pub fn change(&self) -> &str {
        self.name.splitn(4, ':').nth(3).unwrap_or(&self.name).trim_start()
    }
}

/// Every mutant of the files that `globs` name in the crate at `root`.
pub fn list(root: &Path, globs: &[String]) -> Result<Vec<Mutant>> {
    let mut command = Command::new("cargo");
    command.args(["mutants", "--list", "--json"]).current_dir(root);
    for glob in globs {
        command.args(["-f", glob]);
    }
    let output = command
        .output()
        .context("cargo mutants: `cargo install cargo-mutants --locked`")?;
    let message = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "cargo mutants --list: {message}");
    let mut mutants: Vec<Mutant> = serde_json::from_slice(&output.stdout).context("the list of cargo mutants")?;
    let mut texts: HashMap<String, String> = HashMap::new();
    for mutant in &mut mutants {
        let text = match texts.entry(mutant.file.clone()) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert(std::fs::read_to_string(root.join(&mutant.file))?),
        };
        let line = text.lines().nth(mutant.span.start.line - 1);
        mutant.line = line.unwrap_or_default().trim().to_owned();
    }
    Ok(mutants)
}
