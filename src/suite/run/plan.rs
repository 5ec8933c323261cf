//! An experiment as a TOML file: its question, its budget, what it expects, and groups of cells.
//!
//! ```toml
//! question = "How far above the bound is the smallest angle?"
//! about = "biting"               # the mesher the question is about: default the first one named
//! sections = ["angle", "size"]   # of the page, for groups that name none: default by what they vary (`--dry-run` prints it)
//! headline = ["angle"]           # whose first findings answer the question: default the first that has any
//!
//! [budget]                       # of each cell; a cell above it is written as skipped, with the estimate
//! triangles = 150_000
//! seconds = 60.0
//!
//! [expect]                       # where one of these breaks, the run ends with exit status 1
//! certificate_holds = true
//! measured_share = 0.8
//! measured_per_domain = { lakes = 10 }
//! adapted_slope = { most = -0.9, least = -1.2 }   # of the L2 error of adapted meshes against vertices, in logarithms
//!
//! [[group]]                      # every combination of the lists is a cell
//! name = "grid"
//! domains = ["unit-square", "lakes"]
//! spacings = ["lfs"]
//! mesher = "biting"
//! params = [{ order = "fifo" }]  # default: one cell with the mesher's defaults
//! # several meshers: `methods = [{ mesher = "biting" }, { mesher = "biting", params = { order = "fifo" } }]` instead of both;
//! # or `methods = "all"`, the list `all` of a table `[methods]` at the top
//! t = [0.25, "1/3"]              # numbers or fractions
//! c_b = [0.25, 1.0]
//! seeds = [0]                    # default
//! lfs_cap = true                 # default
//! equal_triangles = 20_000       # or a list; without it c_b stays as asked, with it c_b is scaled until a mesh has so many
//! threads = [1]                  # default
//! poisson = "smooth"             # without it nothing is solved
//! adapt = [{ eps = 1e-3, rounds = 6 }]   # without it the spacing is as it says; with it adapted to u of that problem first
//! timed = false                  # default; a timed cell runs alone, `repeats` times
//! repeats = 3                    # default
//! sections = ["angle"]           # the sections of the page that show its cells; groups of one name share theirs
//! quick = { t = [0.25] }         # lists that replace those above under --quick; without it the group is left out
//! ```
//!
//! [`Section`] has the sections there are.
//!
//! A group may be tallied: many small cases, of which only those that are not certified leave a line ([`Tallied`]).
//!
//! ```toml
//! [expect]                       # what counts there
//! panicked = 0                   # cases that ended so
//! hung = 0
//! invalid = 0
//! declined_share = 0.01          # of a mesher's valid domains
//! skipped_families = 0           # those whose files are not there
//!
//! [[group]]                      # each domain by every method, with a spacing, t and c_b drawn for each mesh
//! name = "drawn"
//! tally = { families = ["fan", "slits"], draws = 1000 }        # or fetch = "the command", for domains that are folders
//! domains = ["random-pslg:kind={family},seed={seed}"]          # or ["out/outlines/{family}"]
//! methods = [{ mesher = "biting" }]
//! spacings = ["lfs"]
//! t = [0.25, "1/3"]
//! c_b = [0.5]
//! quick = { draws = 4 }
//! ```

mod group;
mod number;
mod section;
mod tally;
#[cfg(test)]
mod tests;

pub use group::{Group, Method};
pub use number::{Number, fraction};
pub use section::Section;
pub use tally::Tallied;

use crate::suite::rows::numbers::first_seen;
use crate::suite::rows::record::Cell;
use serde::{Deserialize, Serialize};
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

/// Most cells of a plan: a few lists combine to more than any memory holds.
const MOST_CELLS: usize = 1_000_000;

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
    /// The mesher that it is about: what the page says of "ours" is about this one.
    pub about: String,
    /// The sections of its page, each with the names of the groups whose rows it shows.
    pub sections: BTreeMap<Section, BTreeSet<String>>,
    /// The sections whose first findings answer the question; none for the first that has any.
    pub headline: Vec<Section>,
    /// Limits of each cell.
    pub budget: CellBudget,
    /// What must come out.
    pub expect: Expectations,
    /// Groups of cells, in the order of the rows, and groups that are tallied.
    pub groups: Vec<Group>,
}

/// Limits of each cell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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
    /// The largest share of a mesher's cells that may be declined or fail, of those that are not skipped.
    pub unmeshed_share: Option<f64>,
    /// The least number of measured cells of some domains.
    pub measured_per_domain: BTreeMap<String, usize>,
    /// Between what the slope of log₁₀ L2 error against log₁₀ vertices must lie, for the adapted meshes of each problem.
    pub adapted_slope: Option<SlopeRange>,
    /// Of cases that are tallied: the most cases that may panic, or end their process.
    pub panicked: Option<u64>,
    /// Of cases that are tallied: the most cases that may hang.
    pub hung: Option<u64>,
    /// Of cases that are tallied: the most cases whose mesh may break a guaranteed check.
    pub invalid: Option<u64>,
    /// Of cases that are tallied: the largest share of valid domains that a method may decline.
    pub declined_share: Option<f64>,
    /// Of cases that are tallied: the most families that may be skipped since their files are not there.
    pub skipped_families: Option<u64>,
}

/// Between what a slope must lie.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlopeRange {
    /// No steeper downwards than this.
    pub least: f64,
    /// At least as steep downwards as this.
    pub most: f64,
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
    about: Option<String>,
    #[serde(default)]
    sections: Option<Vec<Section>>,
    #[serde(default)]
    headline: Vec<Section>,
    #[serde(default)]
    budget: CellBudget,
    #[serde(default)]
    expect: Expectations,
    #[serde(default)]
    methods: BTreeMap<String, Vec<Method>>,
    #[serde(default)]
    group: Vec<Group>,
}

impl Plan {
    /// Reads and checks the plan in `file`.
    ///
    /// # Errors
    /// [`PlanError`] names the file and line, and what to change.
    pub fn read(file: &Path) -> Result<Self, PlanError> {
        let text = std::fs::read_to_string(file).map_err(|cause| PlanError {
            file: file.to_owned(),
            problem: format!("{cause}; run in a checkout, where `biting list` shows the experiments, or name a file"),
        })?;
        Self::parse(text, file)
    }

    /// Checks the plan that `text` is, which stands in `file`.
    ///
    /// # Errors
    /// [`PlanError`] names the file and line, and what to change.
    pub fn parse(text: String, file: &Path) -> Result<Self, PlanError> {
        let error = |problem: String| PlanError {
            file: file.to_owned(),
            problem,
        };
        let name = file
            .file_stem()
            .map_or_else(|| "experiment".into(), |stem| stem.to_string_lossy().into_owned());
        let File {
            question,
            about,
            sections,
            headline,
            budget,
            expect,
            methods,
            mut group,
        } = toml::from_str(&text).map_err(|cause| error(cause.to_string().trim_end().to_owned()))?;
        for each in &mut group {
            each.resolve(&methods).map_err(error)?;
        }
        let mut plan = Self {
            name,
            file: file.to_owned(),
            text,
            question,
            about: String::new(),
            sections: BTreeMap::new(),
            headline,
            budget,
            expect,
            groups: group,
        };
        let cells = plan.cells()?;
        plan.check_tallied().map_err(error)?;
        plan.about = plan.mesher_in_question(about).map_err(error)?;
        plan.sections = plan.sections_of(&cells, sections.as_deref());
        plan.check_headline().map_err(error)?;
        Ok(plan)
    }

    /// Which groups each section of the page shows: those that the groups name, else those that the plan names, else what
    /// follows from the cells.
    fn sections_of(&self, cells: &[PlannedCell], of_plan: Option<&[Section]>) -> BTreeMap<Section, BTreeSet<String>> {
        let mut sections: BTreeMap<Section, BTreeSet<String>> = BTreeMap::new();
        let names: BTreeSet<&str> = self.groups.iter().map(|group| group.name.as_str()).collect();
        for name in names {
            let groups = self.groups.iter().filter(|group| group.name == name);
            let named: Vec<&[Section]> = groups.filter_map(|group| group.sections.as_deref()).collect();
            let shown = match (named.is_empty(), of_plan) {
                (false, _) => named.concat().into_iter().collect(),
                (true, Some(sections)) => sections.iter().copied().collect(),
                (true, None) => {
                    let own = cells.iter().filter(|planned| planned.group == name);
                    Section::defaults(&own.map(|planned| &planned.cell).collect::<Vec<_>>(), &self.about)
                }
            };
            let shown: BTreeSet<Section> = shown;
            let is_tallied = |group: &Group| group.name == name && group.tally.is_some();
            let always = match self.groups.iter().any(is_tallied) {
                true => Section::Tally,
                false => Section::Certificate,
            };
            for section in shown.into_iter().chain([always]) {
                sections.entry(section).or_default().insert(name.to_owned());
            }
        }
        sections
    }

    fn check_headline(&self) -> Result<(), String> {
        let missing = self
            .headline
            .iter()
            .find(|section| !self.sections.contains_key(section));
        missing.map_or(Ok(()), |missing| {
            let sections: Vec<String> = self.sections.keys().map(Section::to_string).collect();
            Err(format!(
                "`headline` has `{missing}`, but its page has {}",
                sections.join(", ")
            ))
        })
    }

    /// The mesher that it is about: the one it names, which must be in a group, or else the first.
    fn mesher_in_question(&self, named: Option<String>) -> Result<String, String> {
        let methods: Vec<Method> = self
            .groups
            .iter()
            .filter_map(|group| group.methods().ok())
            .flatten()
            .collect();
        let meshers = first_seen(methods.iter().map(|method| method.mesher.as_str()));
        let about = named.or_else(|| meshers.first().map(ToString::to_string));
        about
            .filter(|about| meshers.contains(&about.as_str()))
            .ok_or_else(|| format!("`about` is none of the meshers of its groups: {}", meshers.join(", ")))
    }

    /// Its groups that are tallied, each with what it says of that.
    pub fn tallied(&self) -> impl Iterator<Item = (&Group, &Tallied)> {
        self.groups
            .iter()
            .filter_map(|group| Some((group, group.tally.as_ref()?)))
    }

    fn check_tallied(&self) -> Result<(), String> {
        let mut names = BTreeSet::new();
        let families = self.tallied().flat_map(|(_, tallied)| &tallied.families);
        for family in families {
            if !names.insert(family) {
                return Err(format!("family `{family}` stands there twice; remove one"));
            }
        }
        Ok(())
    }

    /// The part that `--quick` runs: groups with a `quick` table, with its lists in place of theirs. The expected
    /// number of cells a domain and share of declined cases are dropped, since they speak of the whole plan.
    pub fn into_quick(mut self) -> Self {
        self.name.push_str("-quick");
        self.expect.measured_per_domain.clear();
        self.expect.declined_share = None;
        self.expect.adapted_slope = None;
        self.groups = self.groups.into_iter().filter_map(Group::into_quick).collect();
        self
    }

    /// Every cell, in the order of the rows.
    ///
    /// # Errors
    /// [`PlanError`] for an empty list, a bad number, a cell that stands in a group twice, or more cells than memory is
    /// for.
    pub fn cells(&self) -> Result<Vec<PlannedCell>, PlanError> {
        let error = |problem: String| PlanError {
            file: self.file.clone(),
            problem,
        };
        let combinations = self
            .groups
            .iter()
            .map(Group::combinations)
            .fold(0, usize::saturating_add);
        if combinations > MOST_CELLS {
            return Err(error(format!(
                "the lists combine to {combinations} cells; at most {MOST_CELLS} are run"
            )));
        }
        let mut cells = Vec::new();
        let mut keys = BTreeSet::new();
        for group in &self.groups {
            let found = group
                .cells(self.budget)
                .map_err(|problem| error(format!("group `{}`: {problem}", group.name)))?;
            if found.is_empty() && group.tally.is_none() {
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
        if self.groups.is_empty() {
            return Err(error(
                "no group has cells to run; under --quick only groups with a `quick` table run".into(),
            ));
        }
        Ok(cells)
    }
}
