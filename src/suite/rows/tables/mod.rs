//! What a finished experiment leaves: tables that `pandas.read_csv` reads as they are.
//!
//! | file | a line |
//! |---|---|
//! | `meshes.csv` | a cell of the plan, in the plan's order: what was asked for, what came out, worst values of the claims |
//! | `angles.csv` | a mesh: how many triangles have which smallest angle |
//! | `broken.csv` | a check that does not hold although the method promises it under its hypotheses |
//! | `times.csv` | a cell that ran alone: repeats, their median and spread, steps, memory |
//! | `rounds.csv` | a round of an adaptation |
//! | `tally.csv` | a method on a family of cases that are tallied: how many ended how |
//! | `cases.csv` | such a case that is not certified: why, and the command that runs it again |
//! | `tally_times.csv` | a method on a family: seconds |
//! | `run.toml` | who made it and when, and the plan |
//!
//! Two runs of the same code give the same bytes but for `times.csv`, `tally_times.csv` and `run.toml`: numbers that were measured have 9 digits,
//! and what depends on the machine stands apart. `docs/rows.md` has every column; [`page`] writes it from the very
//! list that writes the tables.
//!
//! # Which lines the tables hold
//! A run that is finished replaces them. A line stays from before where this run has none for its cell: where the cell was not asked
//! for (`--only`, `--domains`, `--timed`), or was skipped for want of something that this machine lacks, a peer or memory, and the
//! earlier line is of a mesh. Lines of cells that the plan no longer has go. `run.toml` keeps who made the lines that stayed.

mod asked;
mod beside;
mod cause;
mod claims;
pub mod column;
mod meshes;
#[cfg(test)]
mod page;
mod read;
mod run_file;
mod tally;
#[cfg(test)]
mod tests;

pub use column::TableError;
#[cfg(test)]
use page::page;
pub use run_file::{Made, RunFile};

use super::record::Row;
use super::tally::{Chunk, Family};
use crate::suite::files::write_together;
use beside::{angles, breaches, broken, histograms, parts, rounds, timed, times};
use column::write;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// A line a cell.
pub const MESHES: &str = "meshes.csv";
/// Histograms of smallest angles.
pub const ANGLES: &str = "angles.csv";
/// Checks that do not hold.
pub const BROKEN: &str = "broken.csv";
/// Times of cells that ran alone.
pub const TIMES: &str = "times.csv";
/// Rounds of adaptation.
pub const ROUNDS: &str = "rounds.csv";
/// Cases that are tallied.
pub const TALLY: &str = "tally.csv";
/// Those that are not certified.
pub const CASES: &str = "cases.csv";
/// What they took.
pub const TALLY_TIMES: &str = "tally_times.csv";
/// Who made it, and the plan.
pub const RUN: &str = "run.toml";

/// The tables of an experiment's folder, as rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Tables {
    /// A row a cell, in the plan's order. Reports say no provenance: `run` does.
    pub rows: Vec<Row>,
    /// What cases came to that are tallied.
    pub families: Vec<Family>,
    /// Who made it, and the plan.
    pub run: RunFile,
}

impl Tables {
    /// Whether a folder has tables.
    pub fn are_in(folder: &Path) -> bool {
        [MESHES, TALLY].iter().any(|name| folder.join(name).is_file())
    }

    /// Reads the tables of a folder.
    ///
    /// # Errors
    /// [`TableError`], naming file and line.
    pub fn read(folder: &Path) -> Result<Self, TableError> {
        let path = folder.join(RUN);
        let families = match folder.join(TALLY).is_file() {
            true => tally::read(folder)?,
            false => Vec::new(),
        };
        // A plan whose groups are all tallied leaves no meshes.
        let has_rows = families.is_empty() || folder.join(MESHES).is_file();
        let mut rows = match has_rows {
            true => read::meshes(&folder.join(MESHES))?,
            false => Vec::new(),
        };
        let text = std::fs::read_to_string(&path).map_err(|cause| TableError::Io {
            path: path.clone(),
            cause,
        })?;
        let run = toml::from_str(&text).map_err(|problem| TableError::Line {
            path,
            line: 1,
            problem: problem.to_string().trim_end().to_owned(),
        })?;
        let mut reports = read::Reports::of(&mut rows);
        if has_rows {
            reports.add_angles(&folder.join(ANGLES))?;
            reports.add_broken(&folder.join(BROKEN))?;
        }
        if folder.join(TIMES).is_file() {
            reports.add_times(&folder.join(TIMES))?;
        }
        if folder.join(ROUNDS).is_file() {
            reports.add_rounds(&folder.join(ROUNDS))?;
        }
        Ok(Self { rows, families, run })
    }

    /// The tables of a run that is finished: for each key of the plan the row that the run has, unless an earlier one stays.
    /// `rows` are those of the run; of these `is_final` says whether it takes the place of an earlier mesh. `chunks` are all of the plan.
    pub fn gather<'a>(
        plan: &str,
        keys: impl IntoIterator<Item = &'a str>,
        rows: &[Row],
        is_final: impl Fn(&Row) -> bool,
        chunks: &[Chunk],
        earlier: Option<Self>,
    ) -> Self {
        let earlier = earlier.unwrap_or_else(|| Self {
            rows: Vec::new(),
            families: Vec::new(),
            run: RunFile::default(),
        });
        let by_key =
            |rows: &[Row]| -> HashMap<String, usize> { rows.iter().map(|row| row.key.clone()).zip(0..).collect() };
        let (now, before) = (by_key(rows), by_key(&earlier.rows));
        let mut has_stayed = false;
        let mut gathered = Vec::new();
        for key in keys {
            let old = before.get(key).map(|&place| &earlier.rows[place]);
            let new = now.get(key).map(|&place| &rows[place]);
            let stays = old.filter(|old| new.is_none_or(|new| old.report.is_some() && !is_final(new)));
            has_stayed |= stays.is_some();
            gathered.extend(stays.or(new).cloned());
        }
        let of_rows = gathered
            .iter()
            .filter_map(|row| row.report.as_ref()?.provenance.as_ref());
        let all = of_rows.chain(chunks.iter().map(|chunk| &chunk.provenance));
        let made = run_file::made(all, if has_stayed { &earlier.run.made } else { &[] });
        Self {
            rows: gathered,
            families: Family::of(chunks),
            run: RunFile {
                plan: plan.to_owned(),
                made,
            },
        }
    }

    /// Writes all tables of a folder; none changes before all are written. Those that would have no lines but for a run of another
    /// kind are removed.
    ///
    /// # Errors
    /// [`TableError::Io`].
    pub fn write(&self, folder: &Path) -> Result<(), TableError> {
        let files: Vec<(PathBuf, String)> = self
            .texts()
            .into_iter()
            .map(|(name, text)| (folder.join(name), text))
            .collect();
        let failed = |path: &Path, cause| TableError::Io {
            path: path.to_owned(),
            cause,
        };
        write_together(&files).map_err(|(path, cause)| failed(path, cause))?;
        for name in [MESHES, ANGLES, BROKEN, TIMES, ROUNDS, TALLY, CASES, TALLY_TIMES] {
            let path = folder.join(name);
            if path.exists() && files.iter().all(|(written, _)| *written != path) {
                std::fs::remove_file(&path).map_err(|cause| failed(&path, cause))?;
            }
        }
        Ok(())
    }

    /// Name and text of each table.
    fn texts(&self) -> Vec<(&'static str, String)> {
        let rows = &self.rows;
        let mut texts = Vec::new();
        if !rows.is_empty() || self.families.is_empty() {
            texts.extend([
                (MESHES, write(&meshes::columns(meshes::counted(rows)), rows)),
                (ANGLES, write(&angles(), &histograms(rows))),
                (BROKEN, write(&broken(), &breaches(rows))),
            ]);
        }
        texts.push((RUN, self.run.text()));
        if !self.families.is_empty() {
            let counts = tally::counts(&self.families);
            texts.extend([
                (TALLY, write(&tally::columns(), &counts)),
                (TALLY_TIMES, write(&tally::times(), &counts)),
                (CASES, write(&tally::case_columns(), &tally::cases(&self.families))),
            ]);
        }
        let alone = parts(rows, |report| report.times.as_ref());
        if !alone.is_empty() {
            texts.push((TIMES, write(&times(timed(&alone)), &alone)));
        }
        let adapted = parts(rows, |report| report.rounds.iter().enumerate());
        if !adapted.is_empty() {
            texts.push((ROUNDS, write(&rounds(), &adapted)));
        }
        texts
    }
}
