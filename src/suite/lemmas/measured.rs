//! The judgement on meshes: the worst margin of every check over the committed tables.

use super::record::{Measured, Statement};
use crate::suite::analysis::summary::{parameter, rounded};
use crate::suite::rows::record::{Outcome, Report, Row};
use crate::suite::rows::tables::{TableError, Tables};
use std::path::Path;

/// The rows of meshes by biting, of all experiments in a results folder.
pub struct Meshes {
    rows: Vec<(String, Row)>,
}

/// The worst that meshes show of a statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// The check's worst value over its bound: at least 1 where a bound from below holds, at most 1 where one from above does.
    pub ratio: f64,
    /// Experiment and cell.
    pub seen: String,
    /// t of that cell, as its spacing has it.
    pub t: f64,
    /// How many meshes were measured, their hypotheses holding.
    pub meshes: usize,
}

impl Meshes {
    /// Reads the tables of every experiment's folder in `results`, but those of quick runs.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(results: &Path) -> Result<Self, TableError> {
        let mut folders: Vec<_> = std::fs::read_dir(results)
            .into_iter()
            .flatten()
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| Tables::are_in(path))
            .collect();
        folders.sort();
        let mut rows = Vec::new();
        for folder in folders {
            let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if name.ends_with("-quick") {
                continue;
            }
            let read = Tables::read(&folder)?.rows;
            let is_the_papers = |row: &Row| row.cell.mesher == "biting" && parameter(row, "rule") != Some("later");
            let by_biting = read
                .into_iter()
                .filter(|row| row.outcome == Outcome::Measured && is_the_papers(row));
            rows.extend(by_biting.map(|row| (name.clone(), row)));
        }
        Ok(Self { rows })
    }

    /// How many meshes there are.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// The worst margin of a statement's check, where it applies.
    pub fn worst(&self, statement: &Statement) -> Option<Worst> {
        let measured = statement.measured?;
        let seen: Vec<Seen> = self.seen(&measured).collect();
        let rank = |seen: &Seen| measured.sense.sign() * seen.value / seen.bound;
        let worst = seen.iter().min_by(|a, b| rank(a).total_cmp(&rank(b)))?;
        Some(Worst {
            ratio: worst.value / worst.bound,
            seen: format!("{}: {}", worst.experiment, worst.key),
            t: worst.report.t_effective,
            meshes: seen.len(),
        })
    }

    /// The worst value of a statement's quantity at each nominal t, of meshes whose spacing has that t.
    pub fn by_t(&self, statement: &Statement) -> Vec<(f64, f64)> {
        let Some((measured, quantity)) = statement
            .measured
            .and_then(|measured| Some((measured, measured.quantity?)))
        else {
            return Vec::new();
        };
        let own = self
            .seen(&measured)
            .filter(|seen| (seen.report.t_effective - seen.report.t).abs() < SAME_T);
        let mut values: Vec<(f64, f64)> = own
            .map(|seen| {
                (
                    rounded(seen.report.t),
                    quantity(seen.value, seen.report.c_b, seen.report.t),
                )
            })
            .collect();
        let sign = statement.sense.sign();
        values.sort_by(|a, b| a.0.total_cmp(&b.0).then((sign * a.1).total_cmp(&(sign * b.1))));
        values.dedup_by_key(|value| value.0);
        values
    }

    /// The values of a check wherever it applies.
    fn seen<'a>(&'a self, measured: &Measured) -> impl Iterator<Item = Seen<'a>> {
        let claim = measured.claim;
        self.rows.iter().filter_map(move |(experiment, row)| {
            let report = row.report.as_ref()?;
            let check = report.certificate.check(claim)?;
            let seen = Seen {
                experiment,
                key: &row.key,
                report,
                value: check.worst?,
                bound: check.bound?,
            };
            (check.applies && seen.bound > 0.0).then_some(seen)
        })
    }
}

/// Limiting changed the spacing, so that its t is what was asked for, up to rounding.
const SAME_T: f64 = 1e-9;

/// A check's worst value on one mesh.
struct Seen<'a> {
    experiment: &'a str,
    key: &'a str,
    report: &'a Report,
    value: f64,
    bound: f64,
}
