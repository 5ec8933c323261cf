//! What an experiment expected of its batteries, held against their chunks.

use crate::suite::analysis::expect::Finding;
use crate::suite::rows::numbers::first_seen;
use crate::suite::run::plan::Expectations;
use crate::suite::run::tally::chunk::{Chunk, Tally};
use crate::suite::run::tally::trial::Verdict;

/// At most so many commands are named; the chunks have them.
const NAMED: usize = 3;

/// Holds every expectation of a plan against its chunks, all of them finished.
pub fn findings(expect: &Expectations, chunks: &[Chunk]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let limits = [
        (Verdict::Panicked, expect.panicked, "panics or ends its process"),
        (Verdict::Hung, expect.hung, "hangs"),
        (Verdict::Invalid, expect.invalid, "breaks a guaranteed check"),
    ];
    for (verdict, most, what) in limits {
        if let Some(most) = most {
            findings.push(counted(chunks, verdict, most, what));
        }
    }
    if let Some(most) = expect.declined_share {
        findings.extend(by_method(chunks).iter().map(|tally| declined(tally, most)));
    }
    if let Some(most) = expect.skipped_families {
        let skipped = chunks.iter().filter(|chunk| chunk.skipped.is_some());
        let names: Vec<&str> = skipped.map(|chunk| chunk.family.as_str()).collect();
        findings.push(Finding {
            expected: format!("at most {most} families are skipped"),
            found: format!("{} {}", names.len(), names.join(", ")).trim_end().to_owned(),
            holds: names.len() as u64 <= most,
        });
    }
    findings
}

/// The tallies of all families, method by method, in the order in which they first stand there.
pub fn by_method(chunks: &[Chunk]) -> Vec<Tally> {
    sums(chunks.iter().flat_map(|chunk| &chunk.tallies), |tally| {
        tally.method.as_str()
    })
}

/// Tallies added up by what `name` gives, in the order in which the names first appear; the sums bear those names.
pub fn sums<'a>(tallies: impl Iterator<Item = &'a Tally> + Clone, name: impl Fn(&'a Tally) -> &'a str) -> Vec<Tally> {
    let one = |wanted: &str| {
        let mut sum = Tally {
            method: wanted.to_owned(),
            ..Tally::default()
        };
        let own = tallies.clone().filter(|tally| name(tally) == wanted);
        own.for_each(|tally| sum.add(tally));
        sum
    };
    first_seen(tallies.clone().map(&name)).into_iter().map(one).collect()
}

fn counted(chunks: &[Chunk], verdict: Verdict, most: u64, what: &str) -> Finding {
    let tallies = || chunks.iter().flat_map(|chunk| &chunk.tallies);
    let count: u64 = tallies().map(|tally| tally.count(verdict)).sum();
    let tried: u64 = tallies().map(Tally::tried).sum();
    let uncertified = chunks.iter().flat_map(|chunk| &chunk.uncertified);
    let commands = uncertified.filter(|case| case.verdict == verdict);
    let named: Vec<String> = commands.take(NAMED).map(|case| format!("`{}`", case.command)).collect();
    let found = format!("{count} of {tried} {}", named.join(", "));
    Finding {
        expected: format!("at most {most} cases: a case {what}"),
        found: found.trim_end().to_owned(),
        holds: count <= most,
    }
}

fn declined(tally: &Tally, most: f64) -> Finding {
    let (count, valid) = (tally.count(Verdict::Declined), tally.valid());
    let share = count as f64 / valid.max(1) as f64;
    Finding {
        expected: format!(
            "{} declines at most {:.0} % of valid domains",
            tally.method,
            100.0 * most
        ),
        found: format!("{count} of {valid} ({:.2} %)", 100.0 * share),
        holds: share <= most,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn chunk(family: &str, cases: &[(Verdict, u64)]) -> Chunk {
        let mut chunk = Chunk::new(family, family, vec!["biting".into()]);
        chunk.tallies[0].cases = BTreeMap::from_iter(cases.iter().copied());
        chunk
    }

    fn holds(expect: &Expectations, chunks: &[Chunk]) -> Vec<bool> {
        findings(expect, chunks).iter().map(|finding| finding.holds).collect()
    }

    #[test]
    fn each_expectation_breaks_by_its_own_cases() {
        let expect = Expectations {
            panicked: Some(0),
            hung: Some(0),
            invalid: Some(0),
            declined_share: Some(0.01),
            skipped_families: Some(0),
            ..Expectations::default()
        };
        let good = chunk(
            "a",
            &[(Verdict::Certified, 99), (Verdict::Declined, 1), (Verdict::Stopped, 0)],
        );
        assert_eq!(holds(&expect, std::slice::from_ref(&good)), [true; 5]);
        for (place, verdict) in [Verdict::Panicked, Verdict::Hung, Verdict::Invalid]
            .into_iter()
            .enumerate()
        {
            let mut wanted = [true; 5];
            wanted[place] = false;
            assert_eq!(
                holds(&expect, &[good.clone(), chunk("b", &[(verdict, 1)])]),
                wanted,
                "{verdict:?}"
            );
        }
        // What is refused is no valid domain, so it does not make the share smaller.
        let refused = chunk("b", &[(Verdict::Declined, 1), (Verdict::Refused, 1000)]);
        assert_eq!(
            holds(&expect, &[good.clone(), refused]),
            [true, true, true, false, true]
        );
        let mut skipped = chunk("b", &[]);
        skipped.skipped = Some("not there".into());
        assert_eq!(holds(&expect, &[good, skipped]), [true, true, true, true, false]);
        assert!(findings(&Expectations::default(), &[]).is_empty());
    }
}
