//! An experiment as a TOML file: its question, its budget, what it expects, and groups of cells.
//!
//! ```toml
//! question = "How far above the bound is the smallest angle?"
//!
//! [budget]                       # of each cell; a cell above it is written as skipped, with the estimate
//! triangles = 150_000
//! seconds = 60.0
//!
//! [expect]                       # where one of these breaks, the run ends with exit status 1
//! certificate_holds = true
//! measured_share = 0.8
//! measured_per_domain = { lakes = 10 }
//!
//! [[group]]                      # every combination of the lists is a cell
//! name = "grid"
//! domains = ["unit-square", "lakes"]
//! spacings = ["lfs"]
//! mesher = "biting"
//! params = [{ order = "fifo" }]  # default: one cell with the mesher's defaults
//! t = [0.25, "1/3"]              # numbers or fractions
//! c_b = [0.25, 1.0]
//! seeds = [0]                    # default
//! lfs_cap = true                 # default
//! timed = false                  # default; a timed cell runs alone, `repeats` times
//! repeats = 3                    # default
//! quick = { t = [0.25] }         # lists that replace those above under --quick; without it the group is left out
//! ```

use super::record::Cell;
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Why a plan cannot be run; one message with the file, the place and the remedy.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", file.display())]
pub struct PlanError {
    /// The plan's file.
    pub file: PathBuf,
    /// What is wrong, where, and what to do.
    pub problem: String,
}

/// An experiment as read from its file.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The file's stem: names the folder under `results/`.
    pub name: String,
    /// Where it was read from.
    pub file: PathBuf,
    /// The file's text, kept beside the results.
    pub text: String,
    /// What the experiment asks.
    pub question: String,
    /// Limits of each cell.
    pub budget: CellBudget,
    /// What must come out.
    pub expect: Expectations,
    /// Groups of cells, in the order of the rows.
    pub groups: Vec<Group>,
}

/// Limits of each cell.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CellBudget {
    /// A cell expected to have more triangles is skipped.
    pub triangles: f64,
    /// A mesher is stopped after this many seconds.
    pub seconds: f64,
}

impl Default for CellBudget {
    fn default() -> Self {
        Self {
            triangles: 200_000.0,
            seconds: 120.0,
        }
    }
}

/// What must come out; every breach is told, and makes the run's exit status 1.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Expectations {
    /// Whether every check that applies must hold in every measured cell.
    pub certificate_holds: bool,
    /// Where no input angle is under 90° and t is at most this, every check must hold, also those that do not apply.
    pub certificate_whole_up_to_t: Option<Number>,
    /// The least share of cells that must be measured.
    pub measured_share: f64,
    /// The least number of measured cells of some domains.
    pub measured_per_domain: BTreeMap<String, usize>,
}

/// A group: every combination of its lists is a cell.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Its name in the rows; the charts know `grid`, `orders` and `time`.
    pub name: String,
    /// Gallery names or files.
    pub domains: Vec<String>,
    /// Spacings before cap and limiting.
    pub spacings: Vec<String>,
    /// Name in `MESHERS`.
    pub mesher: String,
    /// Parameters that differ from the mesher's defaults, one table a variant.
    #[serde(default = "one_empty_table")]
    params: Vec<Map<String, Value>>,
    t: Vec<Number>,
    c_b: Vec<Number>,
    #[serde(default = "seed_zero")]
    seeds: Vec<u64>,
    #[serde(default = "yes")]
    lfs_cap: bool,
    #[serde(default)]
    timed: bool,
    #[serde(default = "three")]
    repeats: usize,
    /// Triangles, where the group needs another budget than the plan's.
    #[serde(default)]
    budget: Option<CellBudget>,
    #[serde(default)]
    quick: Option<Quick>,
}

/// The lists of a group that `--quick` replaces.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Quick {
    domains: Option<Vec<String>>,
    spacings: Option<Vec<String>>,
    params: Option<Vec<Map<String, Value>>>,
    t: Option<Vec<Number>>,
    c_b: Option<Vec<Number>>,
    repeats: Option<usize>,
}

fn one_empty_table() -> Vec<Map<String, Value>> {
    vec![Map::new()]
}

fn seed_zero() -> Vec<u64> {
    vec![0]
}

fn yes() -> bool {
    true
}

fn three() -> usize {
    3
}

/// A number, or a fraction in quotes, since TOML cannot write 1/3.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub struct Number(f64);

impl Number {
    /// Its value, positive and finite.
    pub fn get(self) -> f64 {
        self.0
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Number(f64),
    Text(String),
}

impl TryFrom<Written> for Number {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        let value = match written {
            Written::Number(value) => value,
            Written::Text(text) => fraction(&text).ok_or_else(|| format!("`{text}` is no number such as \"1/3\""))?,
        };
        if value.is_finite() && value > 0.0 {
            Ok(Self(value))
        } else {
            Err(format!("{value} must be positive and finite"))
        }
    }
}

/// `"1/3"` or `"0.25"` as a number.
pub fn fraction(text: &str) -> Option<f64> {
    match text.split_once('/') {
        Some((over, under)) => Some(over.trim().parse::<f64>().ok()? / under.trim().parse::<f64>().ok()?),
        None => text.trim().parse().ok(),
    }
}

/// One cell of a plan, before anything is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedCell {
    /// Identifies the row; equal for equal cells of one group and different otherwise.
    pub key: String,
    /// The group's name.
    pub group: String,
    /// What is asked for.
    pub cell: Cell,
    /// Its limits.
    pub budget: CellBudget,
    /// How often to run it: 1 unless it is timed.
    pub repeats: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    question: String,
    #[serde(default)]
    budget: CellBudget,
    #[serde(default)]
    expect: Expectations,
    group: Vec<Group>,
}

impl Plan {
    /// Reads and checks the plan in `file`.
    ///
    /// # Errors
    /// [`PlanError`] names the file and line, and what to change.
    pub fn read(file: &Path) -> Result<Self, PlanError> {
        let error = |problem: String| PlanError {
            file: file.to_owned(),
            problem,
        };
        let text = std::fs::read_to_string(file).map_err(|cause| {
            error(format!(
                "{cause}; run in a checkout, where `biting list` shows the experiments, or name a file"
            ))
        })?;
        let name = file
            .file_stem()
            .map_or_else(|| "experiment".into(), |stem| stem.to_string_lossy().into_owned());
        let File {
            question,
            budget,
            expect,
            group,
        } = toml::from_str(&text).map_err(|cause| error(cause.to_string().trim_end().to_owned()))?;
        let plan = Self {
            name,
            file: file.to_owned(),
            text,
            question,
            budget,
            expect,
            groups: group,
        };
        plan.cells()?;
        Ok(plan)
    }

    /// The part that `--quick` runs: groups with a `quick` table, with its lists in place of theirs. The expected
    /// number of cells a domain is dropped, since it speaks of the whole plan.
    pub fn into_quick(mut self) -> Self {
        self.name.push_str("-quick");
        self.expect.measured_per_domain.clear();
        self.groups = self.groups.into_iter().filter_map(Group::into_quick).collect();
        self
    }

    /// Every cell, in the order of the rows.
    ///
    /// # Errors
    /// [`PlanError`] for an empty list, a bad number, or a cell that stands in a group twice.
    pub fn cells(&self) -> Result<Vec<PlannedCell>, PlanError> {
        let error = |problem: String| PlanError {
            file: self.file.clone(),
            problem,
        };
        let mut cells = Vec::new();
        let mut keys = BTreeSet::new();
        for group in &self.groups {
            let found = group
                .cells(self.budget)
                .map_err(|problem| error(format!("group `{}`: {problem}", group.name)))?;
            if found.is_empty() {
                return Err(error(format!(
                    "group `{}` has an empty list, so no cells; fill it",
                    group.name
                )));
            }
            for planned in found {
                if !keys.insert(planned.key.clone()) {
                    return Err(error(format!("`{}` stands there twice; remove one", planned.key)));
                }
                cells.push(planned);
            }
        }
        if cells.is_empty() {
            return Err(error(
                "no group has cells to run; under --quick only groups with a `quick` table run".into(),
            ));
        }
        Ok(cells)
    }
}

impl Group {
    fn into_quick(mut self) -> Option<Self> {
        let quick = self.quick.take()?;
        self.domains = quick.domains.unwrap_or(self.domains);
        self.spacings = quick.spacings.unwrap_or(self.spacings);
        self.params = quick.params.unwrap_or(self.params);
        self.t = quick.t.unwrap_or(self.t);
        self.c_b = quick.c_b.unwrap_or(self.c_b);
        self.repeats = quick.repeats.unwrap_or(self.repeats);
        Some(self)
    }

    fn cells(&self, budget: CellBudget) -> Result<Vec<PlannedCell>, String> {
        if self.timed && self.repeats == 0 {
            return Err("`repeats` must be at least 1".into());
        }
        let mut cells = Vec::new();
        for domain in &self.domains {
            for spacing in &self.spacings {
                for params in &self.params {
                    for &seed in &self.seeds {
                        for t in &self.t {
                            for c_b in &self.c_b {
                                let cell = Cell {
                                    domain: domain.clone(),
                                    mesher: self.mesher.clone(),
                                    params: params.clone(),
                                    spacing: spacing.clone(),
                                    t: t.get(),
                                    c_b: c_b.get(),
                                    seed,
                                    lfs_cap: self.lfs_cap,
                                    timed: self.timed,
                                };
                                cells.push(PlannedCell {
                                    key: key(&self.name, &cell),
                                    group: self.name.clone(),
                                    budget: self.budget.unwrap_or(budget),
                                    repeats: if self.timed { self.repeats } else { 1 },
                                    cell,
                                });
                            }
                        }
                    }
                }
            }
        }
        Ok(cells)
    }
}

/// The key of a row: everything the cell asks for, readable.
fn key(group: &str, cell: &Cell) -> String {
    let mut key = format!("{group}/{}/{}/{}", cell.domain, cell.spacing, cell.mesher);
    for (name, value) in &cell.params {
        let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        key.push_str(&format!(",{name}={value}"));
    }
    key.push_str(&format!("/t={}/c_b={}", cell.t, cell.c_b));
    for (text, differs) in [
        (format!("/seed={}", cell.seed), cell.seed != 0),
        ("/no-lfs-cap".into(), !cell.lfs_cap),
        ("/timed".into(), cell.timed),
    ] {
        if differs {
            key.push_str(&text);
        }
    }
    key
}

#[cfg(test)]
mod tests;
