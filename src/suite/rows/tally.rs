//! What cases leave that are tallied: counts by family and method, and each case that is not certified.

use crate::suite::rows::hash::digest;
use crate::suite::rows::journal::Record;
use crate::suite::rows::numbers::first_seen;
use crate::suite::rows::record::Provenance;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The journal of chunks of a run in progress.
pub const CHUNKS: &str = "journal-cases.jsonl";

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// There is a mesh, and every guaranteed check of its certificate holds.
    Certified,
    /// A typed error says why there is none, though the domain is valid.
    Declined,
    /// A budget ended it, or it was expected to need more than the budget has.
    Stopped,
    /// The domain is no valid PSLG, and was refused with the reason.
    Refused,
    /// It panicked, or ended its process.
    Panicked,
    /// It was not done long after its time budget.
    Hung,
    /// A guaranteed check of the certificate fails.
    Invalid,
}

impl Verdict {
    /// All, those that may happen first, then those that must not.
    pub const ALL: [Self; 7] = [
        Self::Certified,
        Self::Declined,
        Self::Stopped,
        Self::Refused,
        Self::Panicked,
        Self::Hung,
        Self::Invalid,
    ];
}

impl std::fmt::Display for Verdict {
    /// As tables name it.
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        self.serialize(f)
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

    /// The sum of some tallies, under a name in place of the method's.
    pub fn sum<'a>(name: &str, tallies: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut sum = Self {
            method: name.to_owned(),
            ..Self::default()
        };
        tallies.into_iter().for_each(|tally| sum.add(tally));
        sum
    }

    /// The sums of some tallies method by method, in the order in which the methods first appear.
    pub fn by_method<'a>(tallies: impl Iterator<Item = &'a Self> + Clone) -> Vec<Self> {
        let methods = first_seen(tallies.clone().map(|tally| tally.method.as_str()));
        let of = |method: &&str| Self::sum(method, tallies.clone().filter(|tally| tally.method == *method));
        methods.iter().map(of).collect()
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

/// A line of the journal: a run of cases of one family.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Chunk {
    /// Family, numbers of its cases, and a hash of what is asked.
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
}

impl Record for Chunk {
    fn key(&self) -> &str {
        &self.key
    }
}

/// What the cases of a family came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Family {
    /// Its name.
    pub name: String,
    /// Why nothing was run, where nothing was.
    pub skipped: Option<String>,
    /// Random domains thrown away since they were no valid PSLG.
    pub discarded: u64,
    /// A hash of the digests of its chunks, in order.
    pub digest: String,
    /// One for each method, in the plan's order.
    pub tallies: Vec<Tally>,
    /// Cases that are not certified.
    pub uncertified: Vec<Uncertified>,
}

impl Family {
    /// The families of all chunks, in the order in which they first appear.
    pub fn of(chunks: &[Chunk]) -> Vec<Self> {
        let names = first_seen(chunks.iter().map(|chunk| chunk.family.as_str()));
        let one = |name: &&str| {
            let own = || chunks.iter().filter(|chunk| chunk.family == *name);
            Self {
                name: (*name).to_owned(),
                skipped: own().find_map(|chunk| chunk.skipped.clone()),
                discarded: own().map(|chunk| chunk.discarded).sum(),
                digest: own().fold(String::new(), |before, chunk| digest(&before, &chunk.digest)),
                tallies: Tally::by_method(own().flat_map(|chunk| &chunk.tallies)),
                uncertified: own().flat_map(|chunk| chunk.uncertified.iter().cloned()).collect(),
            }
        };
        names.iter().map(one).collect()
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
