//! Batteries of a plan: families of many small cases that are tallied, not kept a row each.

use crate::suite::run::plan::CellBudget;
use crate::suite::run::plan::Number;
use crate::suite::run::plan::group::Method;
use serde::Deserialize;

/// Families of domains, each domain meshed by every method, with a spacing, a t and a c_b drawn for each mesh.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Battery {
    /// Names of the families, in the order of the table.
    pub families: Vec<String>,
    /// Gallery name of a domain, in which `{family}` and `{seed}` are replaced; or else `folder`.
    #[serde(default)]
    pub domain: Option<String>,
    /// How many domains of each family, seeds 0, 1, …; needed with `domain`.
    #[serde(default)]
    pub domains: Option<usize>,
    /// A folder of domain files, in which `{family}` is replaced: every file is a domain.
    #[serde(default)]
    pub folder: Option<String>,
    /// The command that makes the folder, told where it is missing.
    #[serde(default)]
    pub fetch: Option<String>,
    /// Meshers with their parameters.
    pub methods: Vec<Method>,
    /// Spacings to draw from; one that stands there twice is drawn twice as often.
    pub spacings: Vec<String>,
    /// Values of t to draw from.
    pub t: Vec<Number>,
    /// Values of c_b to draw from.
    pub c_b: Vec<Number>,
    /// Limits of each mesh, where they are not the plan's.
    #[serde(default)]
    pub budget: Option<CellBudget>,
    /// What `--quick` runs of it; without it nothing.
    #[serde(default)]
    quick: Option<Quick>,
}

/// The part of a battery that `--quick` runs.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Quick {
    /// Domains of each family.
    domains: usize,
}

impl Battery {
    /// The part that `--quick` runs, if there is one.
    pub(super) fn into_quick(mut self) -> Option<Self> {
        let quick = self.quick.take()?;
        self.domains = Some(quick.domains);
        Some(self)
    }

    /// What is wrong with it, if something is.
    pub(super) fn check(&self) -> Result<(), String> {
        let lists = [
            ("families", self.families.is_empty()),
            ("methods", self.methods.is_empty()),
            ("spacings", self.spacings.is_empty()),
            ("t", self.t.is_empty()),
            ("c_b", self.c_b.is_empty()),
        ];
        if let Some((name, _)) = lists.iter().find(|(_, is_empty)| *is_empty) {
            return Err(format!("`{name}` is empty; fill it"));
        }
        match (&self.domain, self.domains, &self.folder) {
            (Some(_), Some(1..), None) | (None, _, Some(_)) => Ok(()),
            _ => Err("say `domain` and how many `domains`, or else `folder`".into()),
        }
    }
}
