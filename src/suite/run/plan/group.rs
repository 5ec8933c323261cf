//! Groups of a plan and the cells they stand for.

use crate::geometry::Rect;
use crate::meshers::Parameters;
use crate::suite::fem::Problem;
use crate::suite::rows::adapted::Adapt;
use crate::suite::rows::record::Cell;
use crate::suite::rows::record::parameter_text;
use crate::suite::run::plan::{CellBudget, Number, PlannedCell, Section, Tallied};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A group: every combination of its lists is a cell.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Its name in the rows.
    pub name: String,
    /// The sections of the page that show its rows, where they are not the plan's.
    #[serde(default)]
    pub sections: Option<Vec<Section>>,
    /// That its cases are tallied in place of a row each, and how.
    #[serde(default)]
    pub tally: Option<Tallied>,
    /// Gallery names or files.
    pub domains: Vec<String>,
    /// Spacings before cap and limiting.
    pub spacings: Vec<String>,
    /// Name in `MESHERS`, where the group has one mesher alone.
    #[serde(default)]
    mesher: Option<String>,
    /// Its parameters that differ from the defaults, one table a variant.
    #[serde(default)]
    params: Option<Vec<Parameters>>,
    /// Meshers with their parameters, in place of `mesher` and `params`.
    #[serde(default)]
    methods: Option<Methods>,
    /// Values of t.
    pub t: Vec<Number>,
    /// Values of c_b.
    pub c_b: Vec<Number>,
    #[serde(default = "seed_zero")]
    seeds: Vec<u64>,
    #[serde(default = "yes")]
    lfs_cap: bool,
    /// Triangles every mesh shall have: c_b is scaled until it has, each c_b of the list being where that starts.
    #[serde(default)]
    equal_triangles: Option<Counts>,
    /// Threads a mesher may use.
    #[serde(default = "one_thread")]
    threads: Vec<usize>,
    /// A Poisson problem to solve on each mesh.
    #[serde(default)]
    poisson: Option<String>,
    /// Adaptations of the spacing to u of that problem, one cell each.
    #[serde(default)]
    adapt: Option<Vec<Adapt>>,
    #[serde(default)]
    timed: bool,
    #[serde(default = "three")]
    repeats: usize,
    /// Triangles, where the group needs another budget than the plan's.
    #[serde(default)]
    pub budget: Option<CellBudget>,
    #[serde(default)]
    quick: Option<Quick>,
}

/// The lists of a group that `--quick` replaces.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Quick {
    domains: Option<Vec<String>>,
    spacings: Option<Vec<String>>,
    params: Option<Vec<Parameters>>,
    methods: Option<Methods>,
    t: Option<Vec<Number>>,
    c_b: Option<Vec<Number>>,
    adapt: Option<Vec<Adapt>>,
    equal_triangles: Option<Counts>,
    repeats: Option<usize>,
    draws: Option<usize>,
}

/// One number of triangles or several.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum Counts {
    One(u64),
    Several(Vec<u64>),
}

impl Counts {
    fn list(&self) -> &[u64] {
        match self {
            Self::One(count) => std::slice::from_ref(count),
            Self::Several(counts) => counts,
        }
    }
}

/// The methods of a group, or the name of a list under `[methods]` that several groups share.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum Methods {
    Named(String),
    Listed(Vec<Method>),
}

impl Methods {
    /// Puts the list in place of its name.
    fn resolve(&mut self, lists: &BTreeMap<String, Vec<Method>>) -> Result<(), String> {
        if let Self::Named(name) = self {
            let list = lists
                .get(name)
                .ok_or_else(|| format!("there is no list `{name}` under `[methods]`"))?;
            *self = Self::Listed(list.clone());
        }
        Ok(())
    }

    fn list(&self) -> &[Method] {
        match self {
            Self::Listed(methods) => methods,
            Self::Named(_) => &[],
        }
    }
}

/// A mesher with parameters.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Method {
    /// Name in `MESHERS`.
    pub mesher: String,
    /// Those that differ from the mesher's defaults.
    #[serde(default)]
    pub params: Parameters,
}

fn seed_zero() -> Vec<u64> {
    vec![0]
}

fn one_thread() -> Vec<usize> {
    vec![1]
}

fn yes() -> bool {
    true
}

fn three() -> usize {
    3
}

impl Group {
    /// Puts the lists that several groups share in place of their names.
    pub(super) fn resolve(&mut self, lists: &BTreeMap<String, Vec<Method>>) -> Result<(), String> {
        let quick = self.quick.as_mut().and_then(|quick| quick.methods.as_mut());
        for methods in self.methods.as_mut().into_iter().chain(quick) {
            methods
                .resolve(lists)
                .map_err(|problem| format!("group `{}`: {problem}", self.name))?;
        }
        Ok(())
    }

    /// The part that `--quick` runs, if there is one.
    pub(super) fn into_quick(mut self) -> Option<Self> {
        let quick = self.quick.take()?;
        self.domains = quick.domains.unwrap_or(self.domains);
        self.spacings = quick.spacings.unwrap_or(self.spacings);
        self.params = quick.params.or(self.params);
        self.methods = quick.methods.or(self.methods);
        self.adapt = quick.adapt.or(self.adapt);
        self.equal_triangles = quick.equal_triangles.or(self.equal_triangles);
        self.t = quick.t.unwrap_or(self.t);
        self.c_b = quick.c_b.unwrap_or(self.c_b);
        self.repeats = quick.repeats.unwrap_or(self.repeats);
        if let Some((tallied, draws)) = self.tally.as_mut().zip(quick.draws) {
            tallied.draws = draws;
        }
        Some(self)
    }

    /// How many combinations its lists have.
    pub(super) fn combinations(&self) -> usize {
        if self.tally.is_some() {
            return 0;
        }
        let methods = self.methods.as_ref().map_or(1, |methods| methods.list().len());
        let params = self.params.as_ref().map_or(1, Vec::len);
        let lists = [
            self.domains.len(),
            self.spacings.len(),
            self.t.len(),
            self.c_b.len(),
            self.seeds.len(),
            self.counts().len(),
            self.adapt.as_ref().map_or(1, Vec::len),
            self.threads.len(),
        ];
        lists
            .into_iter()
            .fold(methods.saturating_mul(params), usize::saturating_mul)
    }

    /// Whether what it asks for can be had.
    fn check(&self) -> Result<(), String> {
        if let Some(Err(error)) = self.poisson.as_ref().map(|name| Problem::named(name, Rect::EMPTY)) {
            return Err(error.to_string());
        }
        if self.adapt.is_some() && self.poisson.is_none() {
            return Err("`adapt` needs a problem to adapt to, such as `poisson = \"corner\"`".into());
        }
        for adapt in self.adapt.iter().flatten() {
            adapt.check()?;
        }
        if let Some(tallied) = &self.tally {
            tallied.check(&self.domains)?;
            self.check_what_is_drawn_from()?;
        }
        if self.timed && self.repeats == 0 {
            return Err("`repeats` must be at least 1".into());
        }
        Ok(())
    }

    /// Whether a group that is tallied has lists to draw from, and nothing that only rows can have.
    fn check_what_is_drawn_from(&self) -> Result<(), String> {
        let lists = [
            ("domains", self.domains.is_empty()),
            ("methods", self.methods()?.is_empty()),
            ("spacings", self.spacings.is_empty()),
            ("t", self.t.is_empty()),
            ("c_b", self.c_b.is_empty()),
        ];
        if let Some((name, _)) = lists.iter().find(|(_, is_empty)| *is_empty) {
            return Err(format!("`{name}` is empty; fill it"));
        }
        let of_rows = [
            ("timed", self.timed),
            ("poisson", self.poisson.is_some()),
            ("adapt", self.adapt.is_some()),
            ("equal_triangles", self.equal_triangles.is_some()),
        ];
        match of_rows.iter().find(|(_, is_there)| *is_there) {
            Some((name, _)) => Err(format!(
                "a group that is tallied has no `{name}`; remove it, or `tally`"
            )),
            None => Ok(()),
        }
    }

    /// The group's cells, domain by domain, within a domain spacing by spacing, within a spacing method by method.
    pub(super) fn cells(&self, budget: CellBudget) -> Result<Vec<PlannedCell>, String> {
        self.check()?;
        if self.tally.is_some() {
            return Ok(Vec::new());
        }
        let methods = self.methods()?;
        let asked = |domain: &String, spacing: &String, method: &Method| {
            let mut cells = Vec::new();
            let adaptations = self.adaptations();
            for ((&seed, triangles), adapt) in self
                .seeds
                .iter()
                .flat_map(|seed| self.counts().into_iter().map(move |n| (seed, n)))
                .flat_map(|asked| adaptations.iter().map(move |adapt| (asked, *adapt)))
            {
                for (t, c_b) in self.t.iter().flat_map(|t| self.c_b.iter().map(move |c_b| (t, c_b))) {
                    cells.extend(self.threads.iter().map(|&threads| Cell {
                        domain: domain.clone(),
                        mesher: method.mesher.clone(),
                        params: method.params.clone(),
                        spacing: spacing.clone(),
                        t: t.get(),
                        c_b: c_b.get(),
                        seed,
                        lfs_cap: self.lfs_cap,
                        triangles,
                        threads,
                        poisson: self.poisson.clone(),
                        adapt,
                        timed: self.timed,
                    }));
                }
            }
            cells
        };
        let planned = |cell: Cell| PlannedCell {
            key: key(&self.name, &cell),
            group: self.name.clone(),
            budget: self.budget.unwrap_or(budget),
            repeats: if self.timed { self.repeats } else { 1 },
            cell,
        };
        let mut cells = Vec::new();
        for domain in &self.domains {
            for spacing in &self.spacings {
                let own = methods.iter().flat_map(|method| asked(domain, spacing, method));
                cells.extend(own.map(planned));
            }
        }
        Ok(cells)
    }

    /// The numbers of triangles asked for, or none once.
    fn counts(&self) -> Vec<Option<u64>> {
        match &self.equal_triangles {
            None => vec![None],
            Some(counts) => counts.list().iter().copied().map(Some).collect(),
        }
    }

    /// The adaptations asked for, or none once.
    fn adaptations(&self) -> Vec<Option<Adapt>> {
        match &self.adapt {
            None => vec![None],
            Some(adaptations) => adaptations.iter().copied().map(Some).collect(),
        }
    }

    /// What the group says of meshers, in one form.
    ///
    /// # Errors
    /// That it says nothing, or two things.
    pub fn methods(&self) -> Result<Vec<Method>, String> {
        match (&self.mesher, &self.methods, &self.params) {
            (Some(mesher), None, params) => {
                let params = params.clone().unwrap_or_else(|| vec![Parameters::new()]);
                let method = |params| Method {
                    mesher: mesher.clone(),
                    params,
                };
                Ok(params.into_iter().map(method).collect())
            }
            (None, Some(methods), None) => Ok(methods.list().to_vec()),
            _ => Err("say `mesher`, with `params` where it needs some, or else `methods`".into()),
        }
    }
}

/// The key of a row: everything the cell asks for, readable.
fn key(group: &str, cell: &Cell) -> String {
    let mut key = format!("{group}/{}/{}/{}", cell.domain, cell.spacing, cell.mesher);
    for (name, value) in &cell.params {
        key.push_str(&format!(",{name}={}", parameter_text(value)));
    }
    key.push_str(&format!("/t={}/c_b={}", cell.t, cell.c_b));
    for (text, differs) in [
        (format!("/seed={}", cell.seed), cell.seed != 0),
        ("/no-lfs-cap".into(), !cell.lfs_cap),
        (
            format!("/triangles={}", cell.triangles.unwrap_or_default()),
            cell.triangles.is_some(),
        ),
        (format!("/threads={}", cell.threads), cell.threads != 1),
        (
            format!("/poisson={}", cell.poisson.as_deref().unwrap_or_default()),
            cell.poisson.is_some(),
        ),
        (
            cell.adapt.map(|adapt| format!("/adapt={adapt}")).unwrap_or_default(),
            cell.adapt.is_some(),
        ),
        ("/timed".into(), cell.timed),
    ] {
        if differs {
            key.push_str(&text);
        }
    }
    key
}
