//! Collects the worst value of a check and the places that broke it.

use super::{Check, WITNESSES};
use crate::geometry::DVec2;
use crate::theory::Claim;

/// Which values of a check are bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worst {
    /// The smallest is the worst: the claim is a lower bound.
    Smallest,
    /// The largest is the worst: the claim is an upper bound.
    Largest,
}

/// The worst value seen so far with its place, and the number of values that broke the claim.
#[derive(Clone, Debug)]
pub struct Tally {
    which: Worst,
    worst: Option<(f64, DVec2)>,
    broken: usize,
    witnesses: Vec<[f64; 2]>,
}

impl Tally {
    /// A tally that has seen nothing yet.
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

    /// Adds what a later part saw; of equal worst values the earlier one stays.
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

    /// The check, which holds if nothing broke the claim.
    pub fn check(self, claim: Claim, applies: bool, bound: f64) -> Check {
        Check {
            claim,
            lemma: claim.lemma().into(),
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

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> DVec2 {
        DVec2::new(x, 0.0)
    }

    #[test]
    fn the_worst_is_the_first_of_the_worst_values() {
        for (which, worst) in [(Worst::Smallest, 2.0), (Worst::Largest, 7.0)] {
            let mut tally = Tally::new(which);
            for (value, place) in [(4.0, 0.0), (2.0, 1.0), (7.0, 2.0), (2.0, 3.0), (7.0, 4.0)] {
                tally.see(value, at(place), false);
            }
            let place = if which == Worst::Smallest { 1.0 } else { 2.0 };
            // Parts joined give the same as the whole.
            let mut later = Tally::new(which);
            later.see(worst, at(9.0), false);
            let parts = Tally::all(which, [tally.clone(), later.clone()]).check(Claim::Area, true, 0.0);
            let whole = tally.check(Claim::MinAngle, true, 5.0);
            assert_eq!((whole.worst, whole.at), (Some(worst), Some([place, 0.0])));
            assert_eq!((parts.worst, parts.at), (whole.worst, whole.at));
            assert_eq!((whole.claim, whole.lemma.as_str()), (Claim::MinAngle, "Theorem 6.8"));
            assert!(whole.holds && whole.applies && whole.bound == Some(5.0) && whole.witnesses.is_empty());
        }
    }

    #[test]
    fn all_that_break_a_claim_are_counted_and_the_first_few_listed() {
        let of = |places: std::ops::Range<usize>| {
            let mut tally = Tally::new(Worst::Largest);
            places.for_each(|k| tally.see(1.0, at(k as f64), k != 2));
            tally
        };
        let first: Vec<[f64; 2]> = [0, 1, 3, 4, 5, 6, 7, 8].map(|k| [f64::from(k), 0.0]).to_vec();
        for parts in [
            vec![of(0..12)],
            vec![of(0..5), of(5..12)],
            vec![of(0..0), of(0..11), of(11..12)],
        ] {
            let check = Tally::all(Worst::Largest, parts).check(Claim::Area, false, f64::INFINITY);
            assert_eq!((check.broken, &check.witnesses), (11, &first));
            assert!(!check.holds && !check.applies && check.bound.is_none());
        }
        assert_eq!(of(0..12).check(Claim::Area, true, 0.0).witnesses, first);
        let nothing = Tally::new(Worst::Largest).check(Claim::Area, true, 0.0);
        assert!(nothing.holds && nothing.worst.is_none() && nothing.at.is_none());
        let mut endless = Tally::new(Worst::Largest);
        endless.see(f64::INFINITY, at(3.0), true);
        let endless = endless.check(Claim::Area, true, 0.0);
        assert_eq!((endless.worst, endless.at), (None, Some([3.0, 0.0])));
    }
}
