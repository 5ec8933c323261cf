//! The rows of an experiment with what its plan says of them: what it asks, which mesher it is about, and which rows each section
//! of its page shows.

use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::measures::{AT_EQUAL_COUNT, AT_EQUAL_SIZE, Measure, REASONS};
use crate::suite::analysis::summary::{Grid, by_spacing};
use crate::suite::rows::record::Row;
use crate::suite::rows::tables::{Made, RUN, TableError, Tables};
use crate::suite::rows::tally::Family;
use crate::suite::run::plan::{Expectations, Plan, PlanError, Section};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Why there are no results.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// The plan could not be read.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The tables could not be read.
    #[error(transparent)]
    Tables(#[from] TableError),
}

/// All methods asked alike.
pub struct Asking<'a> {
    /// What is equal.
    pub title: &'static str,
    /// Who was asked what.
    pub contest: Contest<'a>,
    /// What they are compared by.
    pub measures: &'static [Measure],
    /// What explains the differences.
    pub reasons: &'static [Measure],
}

/// An experiment that was run.
#[derive(Clone, Debug)]
pub struct Results {
    /// What it asks.
    pub question: String,
    /// The mesher it is about.
    pub about: String,
    /// What must come out.
    pub expect: Expectations,
    /// The sections of its page, each with the names of the groups whose rows it shows.
    pub sections: BTreeMap<Section, BTreeSet<String>>,
    /// The sections whose first findings answer the question; none for the first that has any.
    pub headline: Vec<Section>,
    /// Who made it.
    pub made: Vec<Made>,
    /// Its rows.
    pub rows: Vec<Row>,
    /// What its cases came to that are tallied.
    pub families: Vec<Family>,
}

impl Results {
    /// What came of a plan.
    pub fn new(plan: Plan, tables: Tables) -> Self {
        Self {
            question: plan.question.trim().to_owned(),
            about: plan.about,
            expect: plan.expect,
            sections: plan.sections,
            headline: plan.headline,
            made: tables.run.made,
            rows: tables.rows,
            families: tables.families,
        }
    }

    /// Reads the tables of a folder. The rows are sorted by what was asked, in whatever order the plan has its groups.
    ///
    /// # Errors
    /// [`ResultsError`]: a file that is not there, or a line in it that cannot be read.
    pub fn read(folder: &Path) -> Result<Self, ResultsError> {
        let mut tables = Tables::read(folder)?;
        tables.rows.sort_by(|a, b| {
            let names = |row: &Row| (row.group.clone(), row.cell.spacing.clone(), row.cell.domain.clone());
            let by_t = a.cell.t.total_cmp(&b.cell.t);
            names(a)
                .cmp(&names(b))
                .then(by_t)
                .then(a.cell.c_b.total_cmp(&b.cell.c_b))
                .then(a.key.cmp(&b.key))
        });
        let plan = Plan::parse(tables.run.plan.clone(), &folder.join(RUN))?;
        Ok(Self::new(plan, tables))
    }

    /// The rows that a section shows.
    pub fn of(&self, section: Section) -> Vec<&Row> {
        let Some(groups) = self.sections.get(&section) else {
            return Vec::new();
        };
        self.rows.iter().filter(|row| groups.contains(&row.group)).collect()
    }

    /// Whether a row is of the mesher that the experiment is about.
    pub fn is_ours(&self, row: &Row) -> bool {
        row.cell.mesher == self.about
    }

    /// The rows of a section by the mesher that the experiment is about.
    pub fn ours(&self, section: Section) -> Vec<&Row> {
        let mut own = self.of(section);
        own.retain(|row| self.is_ours(row));
        own
    }

    /// Those by spacing.
    pub fn grids(&self, section: Section) -> Vec<(String, Grid<'_>)> {
        let split = by_spacing(&self.ours(section));
        split.into_iter().map(|(title, rows)| (title, Grid::of(rows))).collect()
    }

    /// The rows of a section in which all methods were asked for the same edge length.
    pub fn at_equal_size(&self, section: Section) -> Contest<'_> {
        let own = self.of(section).into_iter();
        Contest::of(own.filter(|row| row.cell.triangles.is_none()))
    }

    /// The rows of a section in which all methods were asked for the same number of triangles.
    pub fn at_equal_count(&self, section: Section) -> Contest<'_> {
        let own = self.of(section).into_iter();
        Contest::of(own.filter(|row| row.cell.triangles.is_some()))
    }

    /// Both, with what methods are compared by in each.
    pub fn askings(&self, section: Section) -> [Asking<'_>; 2] {
        [
            Asking {
                title: "equal edge length",
                contest: self.at_equal_size(section),
                measures: &AT_EQUAL_SIZE,
                reasons: &REASONS,
            },
            Asking {
                title: "equal triangle count",
                contest: self.at_equal_count(section),
                measures: &AT_EQUAL_COUNT,
                reasons: &[],
            },
        ]
    }
}
