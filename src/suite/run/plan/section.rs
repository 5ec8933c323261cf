//! Sections of an experiment's page: what a plan may name, and what follows from its cells where it names none.

use crate::suite::peers::is_peer;
use crate::suite::rows::record::Cell;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::hash::Hash;

/// A section that the page of an experiment may have, in the page's order. Its text and charts are in
/// [`crate::suite::report`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Section {
    /// Smallest angles over t against the bound.
    Angle,
    /// Triangles over ∫ dA / f² and ∫ dA / lfs², over t and c_b.
    Size,
    /// The (t, c_b) with the fewest triangles for a smallest angle.
    Fewest,
    /// What a smallest angle costs each mesher over all its settings.
    Frontier,
    /// Corners bitten beside corners cut off.
    Corners,
    /// The two rules of who bites whom.
    Rules,
    /// Orders of bites.
    Orders,
    /// Time against triangles, step by step.
    Time,
    /// Methods side by side.
    Methods,
    /// Errors of finite elements on each mesh.
    Poisson,
    /// Errors on adapted meshes beside uniform ones.
    Adaptation,
    /// Meshers outside this crate: versions, set-up, boundaries.
    Peers,
    /// Every method on each task.
    Tasks,
    /// Speed by number of threads.
    Threads,
    /// Where the mesher in question wins and loses.
    Duels,
    /// Quality where fronts met.
    Seams,
    /// What the density of samples costs.
    Oversampling,
    /// A picture of a mesh of each domain.
    Meshes,
    /// How many cases ended how, and why: of every group that is tallied.
    Tally,
    /// How often each claim of the certificate held: of every group whose cells have rows.
    Certificate,
}

impl std::fmt::Display for Section {
    /// As plans name it.
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        self.serialize(f)
    }
}

impl Section {
    /// What a page shows of cells by default: of everything that varies, the section that is about it. `about` is the mesher
    /// that the experiment is about.
    pub(super) fn defaults(cells: &[&Cell], about: &str) -> BTreeSet<Self> {
        let ours: Vec<&Cell> = cells.iter().copied().filter(|cell| cell.mesher == about).collect();
        let varies = |parameter: &str| several(&ours, |cell| cell.params.get(parameter).map(ToString::to_string));
        let meshers = several(cells, |cell| &cell.mesher);
        let is_plain = cells
            .iter()
            .all(|cell| cell.triangles.is_none() && cell.poisson.is_none());
        let over_t = several(&ours, |cell| cell.t.to_bits()) && several(&ours, |cell| cell.c_b.to_bits());
        let is_adapted = cells.iter().any(|cell| cell.adapt.is_some());
        let is_size = |cell: &&Cell| cell.timed && cell.spacing.starts_with("uniform:");
        let timed: Vec<&Cell> = cells.iter().copied().filter(is_size).collect();
        let rules = [
            (is_plain && over_t, &[Self::Angle, Self::Size, Self::Fewest][..]),
            (varies("corners"), &[Self::Corners]),
            (varies("rule"), &[Self::Rules]),
            (varies("order") && !meshers, &[Self::Orders]),
            (several(&timed, |cell| &cell.spacing), &[Self::Time]),
            (meshers && !is_adapted, &[Self::Methods, Self::Duels]),
            (
                cells.iter().any(|cell| cell.poisson.is_some()) && !is_adapted,
                &[Self::Poisson],
            ),
            (is_adapted, &[Self::Adaptation]),
            (
                cells.iter().any(|cell| is_peer(&cell.mesher)),
                &[Self::Peers, Self::Tasks],
            ),
            (several(cells, |cell| cell.threads), &[Self::Threads]),
            (
                several(cells, |cell| cell.params.get("oversample").map(ToString::to_string)),
                &[Self::Oversampling],
            ),
        ];
        let held = rules.into_iter().filter(|(holds, _)| *holds);
        held.flat_map(|(_, sections)| sections.iter().copied()).collect()
    }
}

/// Whether a value differs among some cells.
fn several<'a, V: Eq + Hash>(cells: &[&'a Cell], value: impl Fn(&'a Cell) -> V) -> bool {
    let all: std::collections::HashSet<V> = cells.iter().copied().map(value).collect();
    all.len() > 1
}
