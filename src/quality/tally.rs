//! Collects the worst value of a check and who broke it.

use super::{Check, WITNESSES};
use crate::geometry::DVec2;

/// Which values of a check are bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worst {
    /// The smallest is the worst: the claim is a lower bound.
    Smallest,
    /// The largest is the worst: the claim is an upper bound.
    Largest,
}

/// The worst value seen so far, where, and how many broke the claim.
#[derive(Clone, Debug)]
pub struct Tally {
    which: Worst,
    worst: Option<(f64, DVec2)>,
    broken: usize,
    witnesses: Vec<[f64; 2]>,
}

impl Tally {
    /// Nothing seen yet.
    pub fn new(which: Worst) -> Self {
        Self {
            which,
            worst: None,
            broken: 0,
            witnesses: Vec::new(),
        }
    }

    /// Notes a value at a place, and whether it breaks the claim.
    pub fn see(&mut self, value: f64, at: DVec2, broken: bool) {
        let is_worse = |worst: f64| match self.which {
            Worst::Smallest => value < worst,
            Worst::Largest => value > worst,
        };
        if self.worst.is_none_or(|(worst, _)| is_worse(worst)) {
            self.worst = Some((value, at));
        }
        if broken {
            self.broken += 1;
            if self.witnesses.len() < WITNESSES {
                self.witnesses.push(at.to_array());
            }
        }
    }

    /// Adds what a later part saw; of equal values the earlier one stays.
    pub fn join(mut self, later: Self) -> Self {
        if let Some((value, at)) = later.worst {
            self.see(value, at, false);
        }
        self.broken += later.broken;
        self.witnesses.extend(later.witnesses);
        self.witnesses.truncate(WITNESSES);
        self
    }

    /// Joins parts in order.
    pub fn all(which: Worst, parts: impl IntoIterator<Item = Self>) -> Self {
        parts.into_iter().fold(Self::new(which), Self::join)
    }

    /// The check; it holds if nothing broke it.
    pub fn check(self, claim: &str, lemma: &str, applies: bool, bound: f64) -> Check {
        Check {
            claim: claim.to_string(),
            lemma: lemma.to_string(),
            applies,
            worst: self.worst.map(|(value, _)| value).filter(|value| value.is_finite()),
            bound: Some(bound).filter(|bound| bound.is_finite()),
            holds: self.broken == 0,
            broken: self.broken,
            at: self.worst.map(|(_, at)| at.to_array()),
            witnesses: self.witnesses,
        }
    }
}
