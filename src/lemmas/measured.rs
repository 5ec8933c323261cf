//! The judgement on meshes: the worst margin of every check over the committed rows.

use super::record::Statement;
use super::search::Sense;
use crate::experiment::journal::{JournalError, read_rows};
use crate::experiment::record::{Outcome, Row};
use crate::experiment::summary::rounded;
use std::collections::BTreeMap;
use std::path::Path;

/// The rows of meshes by biting, of all experiments in a results folder.
pub struct Meshes {
    rows: Vec<(String, Row)>,
}

/// The worst that meshes show of a statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// The check.
    pub claim: &'static str,
    /// The check's worst value over its bound: at least 1 where a bound from below holds, at most 1 where one from above does.
    pub ratio: f64,
    /// Experiment and cell.
    pub seen: String,
    /// Where in the domain, if it is somewhere.
    pub at: Option<[f64; 2]>,
    /// t of that cell, as its spacing has it.
    pub t: f64,
    /// How many meshes were measured, their hypotheses holding.
    pub meshes: usize,
}

impl Meshes {
    /// Reads `rows.jsonl` of every experiment's folder in `results`, which has a plan, but those of quick runs.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(results: &Path) -> Result<Self, JournalError> {
        let mut folders: Vec<_> = std::fs::read_dir(results)
            .into_iter()
            .flatten()
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| ["plan.toml", "rows.jsonl"].iter().all(|name| path.join(name).is_file()))
            .collect();
        folders.sort();
        let mut rows = Vec::new();
        for folder in folders {
            let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if name.ends_with("-quick") {
                continue;
            }
            let read: Vec<Row> = read_rows(&folder.join("rows.jsonl"))?;
            let by_biting = read
                .into_iter()
                .filter(|row| row.outcome == Outcome::Measured && row.cell.mesher == "biting");
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
        let mut meshes = 0;
        let mut worst: Option<Worst> = None;
        for (experiment, row, ratio, at) in self.ratios(statement) {
            meshes += 1;
            let is_worse = worst.as_ref().is_none_or(|worst| match sense(statement) {
                Sense::AtLeast => ratio < worst.ratio,
                Sense::AtMost => ratio > worst.ratio,
            });
            if is_worse {
                worst = Some(Worst {
                    claim: statement.measured.map_or("", |measured| measured.claim),
                    ratio,
                    seen: format!("{experiment}: {}", row.key),
                    at,
                    t: row.report.as_ref().map_or(f64::NAN, |report| report.t_effective),
                    meshes: 0,
                });
            }
        }
        worst.map(|worst| Worst { meshes, ..worst })
    }

    /// The worst value of a statement's quantity at each nominal t.
    pub fn by_t(&self, statement: &Statement) -> BTreeMap<String, f64> {
        let mut worst = BTreeMap::new();
        let Some(quantity) = statement.measured.and_then(|measured| measured.quantity) else {
            return worst;
        };
        for (_, row, ..) in self.ratios(statement) {
            let Some(report) = &row.report else { continue };
            // Only where limiting changed the spacing is t what the statement's t is.
            if (report.t_effective - report.t).abs() > 1e-9 {
                continue;
            }
            let claim = statement.measured.map_or("", |measured| measured.claim);
            let Some(value) = report.certificate.check(claim).and_then(|check| check.worst) else {
                continue;
            };
            let value = quantity(value, report.c_b, report.t);
            let entry = worst.entry(rounded(report.t).to_string()).or_insert(value);
            *entry = match statement.sense {
                Sense::AtLeast => value.min(*entry),
                Sense::AtMost => value.max(*entry),
            };
        }
        worst
    }

    fn ratios<'a>(&'a self, statement: &Statement) -> impl Iterator<Item = (&'a str, &'a Row, f64, Option<[f64; 2]>)> {
        let claim = statement.measured.map(|measured| measured.claim);
        self.rows.iter().filter_map(move |(experiment, row)| {
            let check = row.report.as_ref()?.certificate.check(claim?)?;
            let (worst, bound) = (check.worst?, check.bound?);
            (check.applies && bound > 0.0).then_some((experiment.as_str(), row, worst / bound, check.at))
        })
    }
}

/// Which way the check of a statement bounds: that of counts of vertices is the other way round than of the integrals behind it.
fn sense(statement: &Statement) -> Sense {
    match statement.measured.map(|measured| measured.claim) {
        Some("vertices-lower") => Sense::AtLeast,
        Some("vertices-upper") => Sense::AtMost,
        _ => statement.sense,
    }
}
