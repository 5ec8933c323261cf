//! What became of every mutant, line by line as it comes; of earlier runs, which mutants tests told from the original.

use crate::list::Mutant;
use crate::run::Outcome;
use anyhow::{Context, Result};
use std::collections::HashMap;
use std::io::Write;
use std::path::PathBuf;

/// A file with a line for each mutant: its name, its outcome, the source line.
pub struct Log {
    path: PathBuf,
    /// What mutants came to that tests told from the original in earlier runs, by [`key`].
    told: HashMap<String, Outcome>,
}

/// How the log writes that a test, which follows, killed a mutant.
const KILLED: &str = "killed by ";
/// How it writes that tests ran far beyond their time.
const TIMED_OUT: &str = "timed out";

impl Log {
    /// A log that starts empty, or with what `is_kept` from earlier runs: the last word on each mutant they told.
    pub fn open(path: PathBuf, is_kept: bool) -> Result<Self> {
        let known = if is_kept {
            std::fs::read_to_string(&path).unwrap_or_default()
        } else {
            String::new()
        };
        let mut told = HashMap::new();
        let mut kept = String::new();
        for line in known.lines() {
            let fields: Vec<&str> = line.split('\t').collect();
            let [name, outcome, source] = fields[..] else { continue };
            let outcome = match outcome.strip_prefix(KILLED) {
                Some(test) => Some(Outcome::Killed(test.to_owned())),
                None => (outcome == TIMED_OUT).then_some(Outcome::TimedOut),
            };
            if let Some(outcome) = outcome {
                told.insert(key(name, source), outcome);
                kept += line;
                kept.push('\n');
            }
        }
        std::fs::write(&path, kept)?;
        Ok(Self { path, told })
    }

    /// How tests told the mutant from the original in an earlier run, if its line has not changed since.
    pub fn told(&self, mutant: &Mutant) -> Option<Outcome> {
        self.told.get(&key(&mutant.name, &mutant.line)).cloned()
    }

    /// Adds a mutant's outcome, or that it was left out.
    pub fn note(&self, mutant: &Mutant, outcome: Option<&Outcome>) -> Result<()> {
        let told = match outcome {
            None => "left out".to_owned(),
            Some(Outcome::Killed(test)) => format!("{KILLED}{test}"),
            Some(Outcome::TimedOut) => TIMED_OUT.to_owned(),
            Some(Outcome::Survived(tests)) => format!("survived {tests} tests"),
            Some(Outcome::Unreached) => "unreached".to_owned(),
        };
        let line = format!("{}\t{told}\t{}\n", mutant.name, mutant.line);
        let mut file = std::fs::OpenOptions::new()
            .append(true)
            .open(&self.path)
            .context("the log of outcomes")?;
        Ok(file.write_all(line.as_bytes())?)
    }
}

/// File, column and change with the source line: what stays when lines above it come and go.
fn key(name: &str, source: &str) -> String {
    let parts: Vec<&str> = name.splitn(4, ':').collect();
    match parts[..] {
        [file, _, column, change] => format!("{file}:{column}:{change}\t{source}"),
        _ => format!("{name}\t{source}"),
    }
}
