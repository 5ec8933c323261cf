//! What it expected of cases that are tallied.

use crate::suite::analysis::expect::Finding;
use crate::suite::rows::tally::{Family, Tally, Verdict};
use crate::suite::run::plan::Expectations;

/// At most so many commands are named; the tables have them.
const NAMED: usize = 3;

/// Holds every expectation of cases that are tallied against their families.
pub(super) fn findings(expect: &Expectations, families: &[Family]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let limits = [
        (Verdict::Panicked, expect.panicked, "panics or ends its process"),
        (Verdict::Hung, expect.hung, "hangs"),
        (Verdict::Invalid, expect.invalid, "breaks a guaranteed check"),
    ];
    for (verdict, most, what) in limits {
        if let Some(most) = most {
            findings.push(counted(families, verdict, most, what));
        }
    }
    if let Some(most) = expect.declined_share {
        let tallies = families.iter().flat_map(|family| &family.tallies);
        findings.extend(Tally::by_method(tallies).iter().map(|tally| declined(tally, most)));
    }
    if let Some(most) = expect.skipped_families {
        let skipped = families.iter().filter(|family| family.skipped.is_some());
        let names: Vec<&str> = skipped.map(|family| family.name.as_str()).collect();
        findings.push(Finding {
            expected: format!("at most {most} families are skipped"),
            found: format!("{} {}", names.len(), names.join(", ")).trim_end().to_owned(),
            holds: names.len() as u64 <= most,
        });
    }
    findings
}

fn counted(families: &[Family], verdict: Verdict, most: u64, what: &str) -> Finding {
    let all = Tally::sum("", families.iter().flat_map(|family| &family.tallies));
    let (count, tried) = (all.count(verdict), all.tried());
    let uncertified = families.iter().flat_map(|family| &family.uncertified);
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

    fn family(name: &str, cases: &[(Verdict, u64)]) -> Family {
        let tally = Tally {
            method: "biting".into(),
            cases: BTreeMap::from_iter(cases.iter().copied()),
            ..Tally::default()
        };
        Family {
            name: name.into(),
            tallies: vec![tally],
            ..Family::default()
        }
    }

    fn holds(expect: &Expectations, families: &[Family]) -> Vec<bool> {
        findings(expect, families).iter().map(|finding| finding.holds).collect()
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
        let good = family(
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
                holds(&expect, &[good.clone(), family("b", &[(verdict, 1)])]),
                wanted,
                "{verdict:?}"
            );
        }
        // What is refused is no valid domain, so it does not make the share smaller.
        let refused = family("b", &[(Verdict::Declined, 1), (Verdict::Refused, 1000)]);
        assert_eq!(
            holds(&expect, &[good.clone(), refused]),
            [true, true, true, false, true]
        );
        let mut skipped = family("b", &[]);
        skipped.skipped = Some("not there".into());
        assert_eq!(holds(&expect, &[good, skipped]), [true, true, true, true, false]);
        assert!(findings(&Expectations::default(), &[]).is_empty());
    }
}
