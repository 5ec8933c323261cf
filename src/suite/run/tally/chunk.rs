//! What a run of cases comes to: counts, and every case that is not certified.

use crate::suite::rows::hash::digest;
use crate::suite::rows::journal::Record;
use crate::suite::rows::record::Provenance;
use crate::suite::run::tally::family::Trial;
use crate::suite::run::tally::trial::{Tried, Verdict};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A line of the journal.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Chunk {
    /// [`crate::suite::run::tally::family::Part::key`].
    pub key: String,
    /// The family's name.
    pub family: String,
    /// Why nothing was run, where nothing was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skipped: Option<String>,
    /// Random domains thrown away since they were no valid PSLG, once for each domain.
    pub discarded: u64,
    /// One for each method, in the plan's order.
    pub tallies: Vec<Tally>,
    /// Cases that are not certified.
    pub uncertified: Vec<Uncertified>,
    /// A hash of the fingerprints of all meshes, in order: equal on every run.
    pub digest: String,
    /// What made it, and when it was done.
    pub provenance: Provenance,
}

impl Record for Chunk {
    fn key(&self) -> &str {
        &self.key
    }
}

/// How the cases of a method ended.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Mesher and parameters.
    pub method: String,
    /// Cases by verdict; those that no case had are left out.
    pub cases: BTreeMap<Verdict, u64>,
    /// Triangles of all meshes.
    pub triangles: u64,
    /// Seconds of all cases, from the domain's name to the verdict.
    pub seconds: f64,
}

impl Tally {
    /// Cases that ended so.
    pub fn count(&self, verdict: Verdict) -> u64 {
        self.cases.get(&verdict).copied().unwrap_or(0)
    }

    /// All cases.
    pub fn tried(&self) -> u64 {
        self.cases.values().sum()
    }

    /// Cases whose domain is a valid PSLG.
    pub fn valid(&self) -> u64 {
        self.tried() - self.count(Verdict::Refused)
    }

    /// Adds the cases of another tally.
    pub fn add(&mut self, other: &Self) {
        for (&verdict, &count) in &other.cases {
            *self.cases.entry(verdict).or_default() += count;
        }
        self.triangles += other.triangles;
        self.seconds += other.seconds;
    }
}

/// A case that is not certified.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Uncertified {
    /// Mesher and parameters.
    pub method: String,
    /// How it ended.
    pub verdict: Verdict,
    /// Gallery name or file.
    pub domain: String,
    /// Why.
    pub reason: String,
    /// The command that runs it again.
    pub command: String,
}

impl Uncertified {
    /// The reason without what is special to one case: its numbers and its domain.
    pub fn kind(&self) -> String {
        kind(&self.reason, &self.domain)
    }
}

impl Chunk {
    /// A chunk of no cases yet.
    pub fn new(key: &str, family: &str, methods: Vec<String>) -> Self {
        let tally = |method| Tally {
            method,
            ..Tally::default()
        };
        Self {
            key: key.to_owned(),
            family: family.to_owned(),
            tallies: methods.into_iter().map(tally).collect(),
            ..Self::default()
        }
    }

    /// Counts a case; `is_new_domain` where it is the first of its domain.
    pub fn note(&mut self, trial: &Trial, tried: &Tried, is_new_domain: bool) {
        let method = trial.method();
        if is_new_domain {
            self.discarded += tried.discarded as u64;
        }
        self.digest = digest(&self.digest, &tried.fingerprint);
        if let Some(tally) = self.tallies.iter_mut().find(|tally| tally.method == method) {
            *tally.cases.entry(tried.verdict).or_default() += 1;
            tally.triangles += tried.triangles as u64;
            tally.seconds += tried.seconds;
        }
        self.uncertified.extend(tried.reason.iter().map(|reason| Uncertified {
            method: method.clone(),
            verdict: tried.verdict,
            domain: trial.cell.domain.clone(),
            reason: reason.clone(),
            command: trial.command(),
        }));
    }
}

/// A reason without what is special to one case: its numbers and its domain.
fn kind(reason: &str, domain: &str) -> String {
    let mut kind = String::new();
    let mut is_number = false;
    let mut last = ' ';
    for c in reason.replace(domain, "the domain").chars() {
        let begins = c.is_ascii_digit() && !last.is_alphanumeric() && last != '_';
        let goes_on = is_number && (c.is_ascii_digit() || c == '.' || c == 'e' || (c == '-' && last == 'e'));
        if begins && !is_number {
            // A sign belongs to its number.
            if kind.ends_with('-') {
                kind.pop();
            }
            kind.push('#');
        } else if !goes_on {
            kind.push(c);
        }
        is_number = begins || goes_on;
        last = c;
    }
    kind
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_has_no_numbers() {
        let reason = "fan:seed=3: the size 1.5e-17 at (-0.25, 1e9) is below lfs2 (3); 12 of 13.";
        assert_eq!(
            kind(reason, "fan:seed=3"),
            "the domain: the size # at (#, #) is below lfs2 (#); # of #"
        );
    }
}
