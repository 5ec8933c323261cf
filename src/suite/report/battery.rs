//! `README.md` of an experiment of batteries: how many cases ended how, and why.

use super::markdown::{number, plain, table};
use super::page::bullets;
use crate::suite::analysis::expect_battery::{self, by_method, sums};
use crate::suite::rows::numbers::first_seen;
use crate::suite::run::plan::{Expectations, Plan};
use crate::suite::run::tally::chunk::{Chunk, Tally};
use crate::suite::run::tally::trial::Verdict;

/// Most reasons a table has.
const MOST_REASONS: usize = 40;

/// The columns after a family's or a method's name: those that may happen, then those that must not.
const VERDICTS: [(Verdict, &str); 7] = [
    (Verdict::Certified, "certified"),
    (Verdict::Declined, "declined"),
    (Verdict::Stopped, "stopped by budget"),
    (Verdict::Refused, "refused: no valid PSLG"),
    (Verdict::Panicked, "panicked"),
    (Verdict::Hung, "hung"),
    (Verdict::Invalid, "invalid"),
];

/// The whole page.
pub(super) fn page(chunks: &[Chunk], plan: &Plan, name: &str) -> String {
    let mut text = format!("# Results of `{name}`\n\n");
    text += &format!("Made by `biting report results/{name}` from the chunks and the plan beside this page.\n\n");
    text += &format!("**Question.** {}\n\n", plan.question.trim());
    let findings = findings(chunks);
    text += &format!(
        "**In short.** {}\n\n## Findings\n\n{}\n",
        findings[0].clone(),
        bullets(findings)
    );
    text += &expected(chunks, &plan.expect);
    text += &what_was_run(chunks, name);
    text += &families(chunks);
    text += &methods(chunks);
    text += &shares(chunks);
    text + &reasons(chunks)
}

/// How cases ended, and what was not run.
pub(super) fn findings(chunks: &[Chunk]) -> Vec<String> {
    let all = total(chunks);
    let count = |verdict| all.count(verdict);
    let never = [Verdict::Panicked, Verdict::Hung, Verdict::Invalid].map(count);
    let never = match never {
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
    let most = by_method(chunks)
        .into_iter()
        .max_by(|a, b| share(a).total_cmp(&share(b)));
    findings.extend(most.map(|tally| {
        format!(
            "Of valid domains, {} declines the most: {}.",
            tally.method,
            percent(tally.count(Verdict::Declined), tally.valid())
        )
    }));
    let refused = count(Verdict::Refused);
    if refused > 0 {
        findings.push(format!(
            "{refused} cases have a domain that is no valid PSLG, and were refused with the reason."
        ));
    }
    for chunk in chunks {
        if let Some(reason) = &chunk.skipped {
            findings.push(format!("Skipped, so not passed: {}, {reason}.", chunk.family));
        }
    }
    findings
}

fn total(chunks: &[Chunk]) -> Tally {
    let mut all = Tally::default();
    chunks
        .iter()
        .flat_map(|chunk| &chunk.tallies)
        .for_each(|tally| all.add(tally));
    all
}

fn percent(part: u64, whole: u64) -> String {
    format!("{:.2} %", 100.0 * part as f64 / whole.max(1) as f64)
}

fn expected(chunks: &[Chunk], expect: &Expectations) -> String {
    let findings = expect_battery::findings(expect, chunks);
    if findings.is_empty() {
        return String::new();
    }
    let line = |finding: &crate::suite::analysis::expect::Finding| {
        let holds = if finding.holds { "yes" } else { "**no**" };
        vec![finding.expected.clone(), finding.found.clone(), holds.to_owned()]
    };
    let lines: Vec<_> = findings.iter().map(line).collect();
    "## What was expected\n\n".to_owned() + &table(&["expected", "found", "holds"], &lines)
}

fn what_was_run(chunks: &[Chunk], name: &str) -> String {
    let command = match name.strip_suffix("-quick") {
        Some(plan) => format!("sweep experiments/{plan}.toml --quick"),
        None => format!("sweep experiments/{name}.toml"),
    };
    let all = |texts: Vec<String>| first_seen(texts.iter().map(String::as_str)).join("; ");
    let made = || chunks.iter().map(|chunk| &chunk.provenance);
    let versions = made().map(|made| {
        let commit: String = made.commit.chars().take(12).collect();
        let dirty = if made.dirty { " with changes" } else { "" };
        format!("biting {} {commit}{dirty}, {}", made.version, made.rustc)
    });
    let machines = made().map(|made| format!("{}, {} cores, {}", made.cpu, made.cores, made.os));
    let mut dates: Vec<&str> = made().map(|made| made.date.as_str()).collect();
    dates.sort_unstable();
    let days = [dates.first(), dates.last()].map(|date| date.map(|date| date.chars().take(16).collect::<String>()));
    let [first, last] = days.map(Option::unwrap_or_default);
    let sum = total(chunks);
    let lines = [
        ("Command", format!("`cargo run --release -- {command}`")),
        ("Version", all(versions.collect())),
        ("Machine", all(machines.collect())),
        ("Lines written", format!("{first} to {last} UTC")),
        (
            "Work",
            format!("{} triangles, {} core-seconds", sum.triangles, number(sum.seconds)),
        ),
    ];
    let text: String = lines
        .iter()
        .map(|(what, value)| format!("* {what}: {}\n", plain(value)))
        .collect();
    let about = "Each case is one mesh, in a process of its own that may die or hang, judged by the whole certificate: the structure \
                 and every bound that its method guarantees under the hypotheses that hold. Every domain is meshed by every method; \
                 spacing, t and c_b are drawn for each mesh. The two bounds on the number of vertices need ∫ dA/f², \
                 which is found for one domain in ten of each family. A case is certified if there is a mesh and every guaranteed check \
                 holds, declined if a typed error says why there is none, stopped if a budget of triangles or seconds ended it \
                 or was going to.\n\n";
    format!("## What was run\n\n{about}{text}\n")
}

/// The counts of a tally, verdict by verdict.
fn counts(tally: &Tally) -> impl Iterator<Item = String> {
    VERDICTS
        .map(|(verdict, _)| tally.count(verdict).to_string())
        .into_iter()
}

fn families(chunks: &[Chunk]) -> String {
    let families = first_seen(chunks.iter().map(|chunk| chunk.family.as_str()));
    let row = |name: &str, own: &[&Chunk]| {
        let mut sum = Tally::default();
        own.iter()
            .flat_map(|chunk| &chunk.tallies)
            .for_each(|tally| sum.add(tally));
        let discarded: u64 = own.iter().map(|chunk| chunk.discarded).sum();
        let mut line = vec![name.to_owned(), sum.tried().to_string()];
        line.extend(counts(&sum));
        line.push(discarded.to_string());
        line.push(number(1e3 * sum.seconds / sum.tried().max(1) as f64));
        line
    };
    let mut lines: Vec<Vec<String>> = families
        .iter()
        .map(|&family| {
            let own: Vec<&Chunk> = chunks.iter().filter(|chunk| chunk.family == family).collect();
            row(family, &own)
        })
        .collect();
    lines.push(row("all", &chunks.iter().collect::<Vec<_>>()));
    let mut head = vec!["family", "tried"];
    head.extend(VERDICTS.map(|(_, title)| title));
    head.extend(["draws thrown away", "ms a case"]);
    "## Families\n\n".to_owned() + &table(&head, &lines)
}

fn methods(chunks: &[Chunk]) -> String {
    let line = |tally: &Tally| {
        let mut line = vec![tally.method.clone(), tally.tried().to_string()];
        line.extend(counts(tally));
        line.push(number(tally.triangles as f64 / tally.tried().max(1) as f64));
        line
    };
    let lines: Vec<_> = by_method(chunks).iter().map(line).collect();
    let mut head = vec!["method", "tried"];
    head.extend(VERDICTS.map(|(_, title)| title));
    head.push("triangles a case");
    "## Methods\n\n".to_owned() + &table(&head, &lines)
}

/// Declined and stopped, family by family and method by method.
fn shares(chunks: &[Chunk]) -> String {
    let families = first_seen(chunks.iter().map(|chunk| chunk.family.as_str()));
    let methods = by_method(chunks);
    let lines = families.iter().map(|&family| {
        let own = chunks.iter().filter(|chunk| chunk.family == family);
        let tallies = sums(own.flat_map(|chunk| &chunk.tallies), |tally| &tally.method);
        let cell = |method: &Tally| {
            let found = tallies.iter().find(|tally| tally.method == method.method);
            found.map_or_else(
                || "–".to_owned(),
                |tally| {
                    let (declined, stopped) = (tally.count(Verdict::Declined), tally.count(Verdict::Stopped));
                    format!("{declined} + {stopped} of {}", tally.valid())
                },
            )
        };
        let mut line = vec![family.to_owned()];
        line.extend(methods.iter().map(cell));
        line
    });
    let mut head = vec!["family"];
    head.extend(methods.iter().map(|tally| tally.method.as_str()));
    "## Declined + stopped, of valid domains\n\n".to_owned() + &table(&head, &lines.collect::<Vec<_>>())
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
fn reasons(chunks: &[Chunk]) -> String {
    let mut all: Vec<Reason> = Vec::new();
    for case in chunks.iter().flat_map(|chunk| &chunk.uncertified) {
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
        return "## Why not certified\n\nEvery case is.\n".into();
    }
    all.sort_by_key(|reason| std::cmp::Reverse((reason.verdict, reason.count)));
    let line = |reason: &Reason| {
        let verdict = VERDICTS.iter().find(|(verdict, _)| *verdict == reason.verdict);
        vec![
            verdict.map_or("", |(_, title)| title).to_owned(),
            reason.count.to_string(),
            reason.method.to_owned(),
            reason.kind.clone(),
            format!("`{}`", reason.example),
        ]
    };
    let lines: Vec<_> = all.iter().take(MOST_REASONS).map(line).collect();
    let mut text = "## Why not certified\n\nNumbers in a reason stand as `#`; the command shows one of its cases.\n\n"
        .to_owned()
        + &table(&["ended", "cases", "method", "reason", "one of them"], &lines);
    if all.len() > MOST_REASONS {
        text += &format!("and {} more kinds in `chunks.jsonl`.\n", all.len() - MOST_REASONS);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::run::tally::chunk::Uncertified;
    use std::collections::BTreeMap;

    fn chunk(family: &str, method: &str, cases: &[(Verdict, u64)], kind: &str) -> Chunk {
        let mut chunk = Chunk::new(family, family, vec![method.into()]);
        chunk.tallies[0].cases = BTreeMap::from_iter(cases.iter().copied());
        chunk.discarded = 2;
        let one = Uncertified {
            method: method.into(),
            verdict: Verdict::Declined,
            domain: family.into(),
            reason: kind.into(),
            command: format!("biting mesh {family}"),
        };
        chunk.uncertified = vec![one; cases[1].1 as usize];
        chunk
    }

    #[test]
    fn the_page_adds_up_chunks_and_tells_why() {
        let chunks = [
            chunk(
                "fan",
                "biting",
                &[(Verdict::Certified, 7), (Verdict::Declined, 1)],
                "too small",
            ),
            chunk(
                "fan",
                "biting",
                &[(Verdict::Certified, 6), (Verdict::Declined, 2)],
                "too small",
            ),
            chunk(
                "grid",
                "other",
                &[(Verdict::Certified, 3), (Verdict::Declined, 1)],
                "too large",
            ),
        ];
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("robustness.toml");
        let text = "question = \"What breaks?\"\n[expect]\ndeclined_share = 0.2\n[[group]]\nname = \"hard\"\ntally = { families = [\"fan\"] }\ndomains = [\"x\"]\n\
                    methods = [{ mesher = \"biting\" }]\nspacings = [\"lfs\"]\nt = [0.25]\nc_b = [0.5]\n";
        std::fs::write(&file, text).expect("written");
        let page = page(&chunks, &Plan::read(&file).expect("a plan"), "robustness");
        for told in [
            "**Question.** What breaks?",
            "* Of 20 hard cases, 16 ended certified, 4 declined and 0 stopped by a budget; none panicked, hung or was invalid.",
            "| other declines at most 20 % of valid domains | 1 of 4 (25.00 %) | **no** |",
            "`cargo run --release -- sweep experiments/robustness.toml`",
            "| fan | 16 | 13 | 3 | 0 | 0 | 0 | 0 | 0 | 4 |",
            "| fan | 3 + 0 of 16 | – |",
            "| declined | 3 | biting | too small | `biting mesh fan` |",
        ] {
            assert!(page.contains(told), "{told}\n{page}");
        }
        let place = |text: &str| page.find(text).expect(text);
        assert!(place("too small") < place("too large"), "the commonest first");
    }
}
