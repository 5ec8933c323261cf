//! `paper/errata.md`, from the records and the findings.

use super::findings::{FINDINGS, Finding};
use super::record::Labelled;
use super::table::{Line, sign};
use crate::suite::report::markdown::{number, table};

/// The page.
///
/// # Errors
/// A demonstration that could not be run.
pub fn page(lines: &[Line]) -> Result<String, String> {
    let mut text = String::from(
        "# Errata of \"Biting: Advancing Front Meets Sphere Packing\"\n\n\
         Made by `cargo run --release -- lemmas`: numbers and configurations are computed, proofs are written in `src/suite/lemmas`. Each entry stands by itself: what is printed in the version at hand (the journal's may differ), what is true, a proof or a counterexample, and what \
         becomes of the statements that rest on it. The judgement of all statements, also of those that are right, is in [results/lemmas](../results/lemmas/README.md).\n\n\
         **In short.** Theorem 6.8, the angle bound asin(1/2 − t), survives for t ≤ 1/3 with four hypotheses that the paper does not state: f ≤ lfs in the whole domain and c_b ≤ 1; c_b + t ≤ 1; \
         a middle circle where circles touch; a constrained triangulation. One step stays open: a circumcentre that sees a vertex only across a piece of an inner segment that had to be forced. Formula (10) is wrong, Lemma 6.6 with it for t > 0.398, and Lemma 2.1 is false; the constants of Lemmas 5.7 (left) and \
         5.8 can be improved.\n\n## Formulas\n\n",
    );
    for line in lines.iter().filter(|line| line.statement.corrected.is_some()) {
        text += &formula(line);
    }
    text += "## Hypotheses, steps and misprints\n\n";
    for finding in FINDINGS {
        text += &entry(finding)?;
    }
    text += &examples();
    Ok(text)
}

/// One entry of a formula, with the configuration that shows it.
pub fn formula(line: &Line) -> String {
    let statement = &line.statement;
    let Some(corrected) = &statement.corrected else {
        return String::new();
    };
    let mut text = format!(
        "### {}: {}\n\n* Bounded: {}.\n* Printed: {} {} (range: {}). Verdict: {}.\n* True: {} {}. Verdict: {}.\n* Why: {}\n* Consequence: {}\n",
        statement.place,
        line.printed.word(),
        statement.quantity,
        sign(statement),
        statement.printed.says,
        statement.range_says,
        line.told(&line.printed),
        sign(statement),
        corrected.bound.says,
        line.corrected
            .as_ref()
            .map_or(String::new(), |verdict| line.told(verdict)),
        corrected.why,
        corrected.consequence,
    );
    text += &format!("* Again: `cargo run --release -- lemmas --only {}`\n\n", statement.name);
    let rows: Vec<Vec<String>> = line
        .judged
        .iter()
        .step_by(2)
        .map(|one| {
            let optimum = &one.optimum;
            vec![
                number(one.parameter),
                number((statement.printed.at)(one.parameter)),
                number(optimum.found),
                number((corrected.bound.at)(one.parameter)),
                told(&(statement.points)(one.parameter, &optimum.at)),
            ]
        })
        .collect();
    text + &table(
        &[
            statement.parameter,
            "printed",
            "optimum",
            "corrected",
            "a configuration that attains it",
        ],
        &rows,
    )
}

fn told(points: &[Labelled]) -> String {
    let point = |point: &Labelled| {
        let radius = point
            .radius
            .map_or(String::new(), |radius| format!(" radius {radius:.4}"));
        format!("{} ({:.4}, {:.4}){radius}", point.label, point.at[0], point.at[1])
    };
    points.iter().map(point).collect::<Vec<_>>().join("; ")
}

/// One finding, with its demonstration done again.
///
/// # Errors
/// A demonstration that could not be run.
pub fn entry(finding: &Finding) -> Result<String, String> {
    let mut text = format!(
        "### {}\n\n* Where: {}. {}.\n* Why: {}\n* Consequence: {}\n",
        finding.title,
        finding.place,
        capitalised(finding.kind.word()),
        finding.why,
        finding.consequence
    );
    if let Some(demonstration) = &finding.demonstration {
        let shown: Vec<String> = demonstration
            .run()?
            .iter()
            .map(|shown| format!("{}: {}", shown.name, number(shown.value)))
            .collect();
        text += &format!(
            "* Shown by `{}`: {}.\n",
            demonstration.command(finding.name),
            shown.join("; ")
        );
    }
    Ok(text + "\n")
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters
        .next()
        .map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The two worked examples at the end of §6, as printed and with the corrected constants of Lemma 5.8.
fn examples() -> String {
    let rows: Vec<Vec<String>> = [
        (0.25, "f/(10α)", "11f/(9α)", "14.48°"),
        (1.0 / 3.0, "f/(8α)", "2f/α", "9.59°"),
    ]
    .iter()
    .map(|&(t, lower, upper, angle): &(f64, &str, &str, &str)| {
        let [printed_lower, printed_upper] = [t / (2.0 + 2.0 * t), (3.0 - t) * t / (1.0 - t).powi(2)];
        let [least, most] = [t / (2.0 + t), 2.0 * t / (1.0 - t)];
        vec![
            number(t),
            format!("{lower} = {} f/α", number(printed_lower)),
            format!("{} f/α", number(least)),
            format!("{upper} = {} f/α", number(printed_upper)),
            format!("{} f/α", number(most)),
            format!("{angle} = {:.2}°", (0.5 - t).asin().to_degrees()),
        ]
    })
    .collect();
    "## The worked examples at the end of §6\n\nRight as printed, given the lemmas; the corrected constants of Lemma 5.8 are nearer.\n\n".to_owned()
        + &table(
            &["t", "nn ≥, printed", "nn ≥, corrected", "nn ≤, printed", "nn ≤, corrected", "smallest angle"],
            &rows,
        )
}
