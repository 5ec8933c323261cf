//! What came of the mutants: rows, figures, and survivors that nobody explained.

use crate::list::Mutant;
use crate::run::Outcome;
use anyhow::{Context, Result};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Survivors that cannot be killed, each with the reason.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explained {
    #[serde(default)]
    survivor: Vec<Survivor>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Survivor {
    file: String,
    /// The line it is in, trimmed: line numbers drift.
    line: String,
    /// What cargo-mutants calls the changes, without the places.
    changes: Vec<String>,
    /// Why no test can, or need, tell it from the original.
    why: String,
}

impl Explained {
    pub fn read(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
        Ok(toml::from_str(&text)?)
    }

    fn of(&self, mutant: &Mutant) -> Option<&str> {
        let found = self.survivor.iter().find(|known| {
            known.file == mutant.file
                && known.line == mutant.line
                && known.changes.iter().any(|change| change == mutant.change())
        });
        found.map(|known| known.why.as_str())
    }
}

#[derive(Clone, Copy, Default)]
struct Counts {
    mutants: usize,
    killed: usize,
    timed_out: usize,
    unviable: usize,
    explained: usize,
    survived: usize,
}

/// The table by folder, and one line for each survivor that is not explained.
pub fn report(mutants: &[(Mutant, Option<Outcome>)], explained: &Explained) -> (String, Vec<String>) {
    let mut counts: BTreeMap<String, Counts> = BTreeMap::new();
    let mut open = Vec::new();
    for (mutant, outcome) in mutants {
        let line = &mutant.line;
        let folder = mutant.file.split('/').nth(1).unwrap_or_default().to_owned();
        let mut count = |to: fn(&mut Counts) -> &mut usize| {
            for name in [folder.clone(), "~total".to_owned()] {
                *to(counts.entry(name).or_default()) += 1;
            }
        };
        count(|counts| &mut counts.mutants);
        match outcome {
            None => count(|counts| &mut counts.unviable),
            Some(Outcome::Killed(_)) => count(|counts| &mut counts.killed),
            Some(Outcome::TimedOut) => count(|counts| &mut counts.timed_out),
            Some(Outcome::Survived(_) | Outcome::Unreached) if explained.of(mutant).is_some() => {
                count(|counts| &mut counts.explained);
            }
            Some(Outcome::Survived(tests)) => {
                count(|counts| &mut counts.survived);
                open.push(format!("{}    // {line}    ({tests} tests)", mutant.name));
            }
            Some(Outcome::Unreached) => {
                count(|counts| &mut counts.survived);
                open.push(format!("{}    // {line}    (unreached)", mutant.name));
            }
        }
    }
    let mut table = String::from(
        "| folder | mutants | killed | timed out | not compiled | survived, explained | survived |\n|---|---:|---:|---:|---:|---:|---:|\n",
    );
    for (name, c) in &counts {
        table += &format!(
            "| {} | {} | {} | {} | {} | {} | {} |\n",
            name.trim_start_matches('~'),
            c.mutants,
            c.killed,
            c.timed_out,
            c.unviable,
            c.explained,
            c.survived
        );
    }
    (table, open)
}
