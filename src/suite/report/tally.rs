//! Cases that are tallied: how many ended how, and why.

use super::markdown::{number, table};
use crate::suite::analysis::results::Results;
use crate::suite::rows::tally::{Family, Tally, Verdict};

/// Most reasons a table has.
const MOST_REASONS: usize = 40;

/// The columns after a family's or a method's name.
fn titles() -> [&'static str; 7] {
    Verdict::ALL.map(|verdict| match verdict {
        Verdict::Certified => "certified",
        Verdict::Declined => "declined",
        Verdict::Stopped => "stopped by budget",
        Verdict::Refused => "refused: no valid PSLG",
        Verdict::Panicked => "panicked",
        Verdict::Hung => "hung",
        Verdict::Invalid => "invalid",
    })
}

/// The tallies of some families.
fn tallies(families: &[Family]) -> impl Iterator<Item = &Tally> + Clone {
    families.iter().flat_map(|family| &family.tallies)
}

/// How cases ended, and what was not run.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let all = Tally::sum("all", tallies(&results.families));
    let count = |verdict| all.count(verdict);
    let never = match [Verdict::Panicked, Verdict::Hung, Verdict::Invalid].map(count) {
        [0, 0, 0] => "none panicked, hung or was invalid".to_owned(),
        [panicked, hung, invalid] => format!("{panicked} panicked, {hung} hung, {invalid} were invalid"),
    };
    let mut findings = vec![format!(
        "Of {} hard cases, {} ended certified, {} declined and {} stopped by a budget; {never}.",
        all.tried(),
        count(Verdict::Certified),
        count(Verdict::Declined),
        count(Verdict::Stopped)
    )];
    let share = |tally: &Tally| tally.count(Verdict::Declined) as f64 / tally.valid().max(1) as f64;
    let methods = Tally::by_method(tallies(&results.families));
    let most = methods.iter().max_by(|a, b| share(a).total_cmp(&share(b)));
    findings.extend(most.map(|tally| {
        format!(
            "Of valid domains, {} declines the most: {:.2} %.",
            tally.method,
            100.0 * share(tally)
        )
    }));
    let refused = count(Verdict::Refused);
    if refused > 0 {
        findings.push(format!(
            "{refused} cases have a domain that is no valid PSLG, and were refused with the reason."
        ));
    }
    let skipped = results
        .families
        .iter()
        .filter_map(|family| Some((&family.name, family.skipped.as_ref()?)));
    findings.extend(skipped.map(|(name, reason)| format!("Skipped, so not passed: {name}, {reason}.")));
    findings
}

/// What a case is, then counts by family, by method and by both, then reasons.
pub(super) fn text(results: &Results) -> String {
    let families = &results.families;
    if tallies(families).next().is_none() {
        return String::new();
    }
    let all = Tally::sum("all", tallies(families));
    let about = "Each case is one mesh, in a process of its own that may die or hang, judged by the whole certificate: the structure \
                 and every bound that its method guarantees under the hypotheses that hold. Every domain is meshed by every method; \
                 spacing, t and c_b are drawn for each mesh. The two bounds on the number of vertices need ∫ dA/f², \
                 which is found for one domain in ten of each family. A case is certified if there is a mesh and every guaranteed check \
                 holds, declined if a typed error says why there is none, stopped if a budget of triangles or seconds ended it \
                 or was going to.";
    format!(
        "{about} In all {} triangles were made in {} core-seconds.\n\n",
        all.triangles,
        number(all.seconds)
    ) + &by_family(families, &all)
        + &by_method(families)
        + &by_both(families)
        + &reasons(families)
}

/// The counts of a tally, verdict by verdict.
fn counts(tally: &Tally) -> impl Iterator<Item = String> {
    Verdict::ALL.map(|verdict| tally.count(verdict).to_string()).into_iter()
}

fn by_family(families: &[Family], all: &Tally) -> String {
    let row = |sum: &Tally, discarded: u64| {
        let mut line = vec![sum.method.clone(), sum.tried().to_string()];
        line.extend(counts(sum));
        line.push(discarded.to_string());
        line.push(number(1e3 * sum.seconds / sum.tried().max(1) as f64));
        line
    };
    let mut lines: Vec<Vec<String>> = families
        .iter()
        .map(|family| row(&Tally::sum(&family.name, &family.tallies), family.discarded))
        .collect();
    lines.push(row(all, families.iter().map(|family| family.discarded).sum()));
    let head = [
        &["family", "tried"],
        &titles()[..],
        &["draws thrown away", "ms per case"],
    ]
    .concat();
    "### Families\n\n".to_owned() + &table(&head, &lines)
}

fn by_method(families: &[Family]) -> String {
    let line = |tally: &Tally| {
        let mut line = vec![tally.method.clone(), tally.tried().to_string()];
        line.extend(counts(tally));
        line.push(number(tally.triangles as f64 / tally.tried().max(1) as f64));
        line
    };
    let lines: Vec<_> = Tally::by_method(tallies(families)).iter().map(line).collect();
    let head = [&["method", "tried"], &titles()[..], &["triangles per case"]].concat();
    "### Methods\n\n".to_owned() + &table(&head, &lines)
}

/// Declined and stopped, family by family and method by method.
fn by_both(families: &[Family]) -> String {
    let methods = Tally::by_method(tallies(families));
    let line = |family: &Family| {
        let cell = |method: &Tally| {
            let found = family.tallies.iter().find(|tally| tally.method == method.method);
            found.map_or_else(
                || "–".to_owned(),
                |tally| {
                    let (declined, stopped) = (tally.count(Verdict::Declined), tally.count(Verdict::Stopped));
                    format!("{declined} + {stopped} of {}", tally.valid())
                },
            )
        };
        std::iter::once(family.name.clone())
            .chain(methods.iter().map(cell))
            .collect()
    };
    let mut head = vec!["family"];
    head.extend(methods.iter().map(|tally| tally.method.as_str()));
    "### Declined + stopped, of valid domains\n\n".to_owned()
        + &table(&head, &families.iter().map(line).collect::<Vec<_>>())
}

/// A kind of reason, and how often it was given.
struct Reason<'a> {
    method: &'a str,
    verdict: Verdict,
    /// Its numbers and names replaced by `#`.
    kind: String,
    count: u64,
    /// The command of the first of them.
    example: &'a str,
}

/// Why cases are not certified, the gravest and commonest first, each with a command that shows it.
fn reasons(families: &[Family]) -> String {
    let mut all: Vec<Reason> = Vec::new();
    for case in families.iter().flat_map(|family| &family.uncertified) {
        let kind = case.kind();
        let same =
            |known: &&mut Reason| (known.method, known.verdict, &known.kind) == (&*case.method, case.verdict, &kind);
        match all.iter_mut().find(same) {
            Some(known) => known.count += 1,
            None => all.push(Reason {
                method: &case.method,
                verdict: case.verdict,
                kind,
                count: 1,
                example: &case.command,
            }),
        }
    }
    if all.is_empty() {
        return "### Why not certified\n\nEvery case is.\n".into();
    }
    all.sort_by_key(|reason| std::cmp::Reverse((reason.verdict, reason.count)));
    let line = |reason: &Reason| {
        let place = Verdict::ALL.iter().position(|verdict| *verdict == reason.verdict);
        vec![
            place.map_or("", |place| titles()[place]).to_owned(),
            reason.count.to_string(),
            reason.method.to_owned(),
            reason.kind.clone(),
            format!("`{}`", reason.example),
        ]
    };
    let lines: Vec<_> = all.iter().take(MOST_REASONS).map(line).collect();
    let mut text = "### Why not certified\n\nNumbers in a reason stand as `#`; the command shows one of its cases.\n\n"
        .to_owned()
        + &table(&["ended", "cases", "method", "reason", "one of them"], &lines);
    if all.len() > MOST_REASONS {
        text += &format!("and {} more kinds are in `cases.csv`.\n", all.len() - MOST_REASONS);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::{fixture, page};
    use super::*;
    use crate::suite::rows::tally::Uncertified;
    use crate::suite::run::plan::{Expectations, Section};
    use std::collections::BTreeMap;

    fn family(name: &str, method: &str, [certified, declined]: [u64; 2], reason: &str) -> Family {
        let one = Uncertified {
            method: method.into(),
            verdict: Verdict::Declined,
            domain: name.into(),
            reason: reason.into(),
            command: format!("biting mesh {name}"),
        };
        let tally = Tally {
            method: method.into(),
            cases: BTreeMap::from([(Verdict::Certified, certified), (Verdict::Declined, declined)]),
            ..Tally::default()
        };
        Family {
            name: name.into(),
            discarded: 4,
            tallies: vec![tally],
            uncertified: vec![one; declined as usize],
            ..Family::default()
        }
    }

    #[test]
    fn the_page_adds_up_families_and_says_why() {
        let results = Results {
            question: "What breaks?".into(),
            expect: Expectations {
                declined_share: Some(0.2),
                ..Expectations::default()
            },
            sections: BTreeMap::from([(Section::Tally, ["hard".to_owned()].into())]),
            families: vec![
                family("fan", "biting", [13, 3], "too small"),
                family("grid", "other", [3, 1], "too large"),
            ],
            rows: Vec::new(),
            ..fixture::results(&[fixture::row("grid", "a", "lfs", 0.25, 0.5, "fifo")])
        };
        let page = page::page(&results, &[(Section::Tally, Vec::new())], "robustness");
        for expected in [
            "**Question.** What breaks?",
            "**In short.** Of 20 hard cases, 16 ended certified, 4 declined and 0 stopped by a budget; none panicked, hung or was invalid.",
            "| other declines at most 20 % of valid domains | 1 of 4 (25.00 %) | **no** |",
            "`cargo run --release -- sweep experiments/robustness.toml`",
            "| fan | 16 | 13 | 3 | 0 | 0 | 0 | 0 | 0 | 4 |",
            "| fan | 3 + 0 of 16 | – |",
            "| declined | 3 | biting | too small | `biting mesh fan` |",
        ] {
            assert!(page.contains(expected), "{expected}\n{page}");
        }
        let place = |text: &str| page.find(text).expect(text);
        assert!(place("too small") < place("too large"), "the commonest first");
    }
}
