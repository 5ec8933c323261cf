//! `README.md` of a results folder: what was run, what came out, the charts.

use super::adapt;
use super::angles;
use super::claims;
use super::corners;
use super::duels;
use super::figures::{Chart, Section};
use super::findings::{grids, of_group, spread, tally};
use super::frontiers;
use super::markdown::{number, parameter, plain, table};
use super::meshes::Picture;
use super::peers;
use super::poisson;
use super::ranks;
use super::rivals;
use super::rules;
use super::sections;
use super::standings::standings;
use crate::suite::analysis::summary::{by_spacing, measured};
use crate::suite::rows::numbers::{first_seen, quantile};
use crate::suite::rows::record::{Outcome, Row};

/// What the page tells besides the rows.
#[derive(Clone, Debug, Default)]
pub(super) struct Heading {
    /// Name of the results folder.
    pub(super) name: String,
    /// The question the plan asks, where the plan lies beside the rows.
    pub(super) question: Option<String>,
}

/// The whole page.
pub(super) fn page(rows: &[Row], charts: &[Chart], pictures: &[Picture], heading: &Heading) -> String {
    let mut text = format!("# Results of `{}`\n\n", heading.name);
    text += "This page and its charts are made from `rows.jsonl` alone, by `biting report`; nothing here is typed.\n\n";
    text += &format!(
        "**Question.** {}\n\n",
        heading.question.as_deref().unwrap_or(DEFAULT_QUESTION)
    );
    text += &main_findings(rows);
    text += &what_was_run(rows, &heading.name);
    let parts = [
        ("Smallest angle against its bound", angles::angles(rows), Section::Angle),
        ("Size", sections::sizes(rows), Section::Size),
        (
            "Fewest triangles for a smallest angle",
            sections::fewest_triangles(rows),
            Section::Fewest,
        ),
        (
            "What a smallest angle costs",
            frontiers::frontiers(rows),
            Section::Frontier,
        ),
        ("Corners", corners::corners(rows), Section::Corners),
        ("Who bites whom", rules::rules(rows), Section::Rules),
        ("Orders of bites", sections::orders(rows), Section::Orders),
        ("Time of biting, step by step", sections::time(rows), Section::Time),
        ("Meshers side by side", rivals::rivals(rows), Section::Rivals),
        ("What quality is for", poisson::poisson(rows), Section::Poisson),
        ("Adaptation", adapt::adaptation(rows), Section::Adaptation),
        ("Beside the meshers people use", peers::peers(rows), Section::Peers),
        (
            "Where biting wins, where it loses, and why",
            duels::duels(rows) + &ranks::ranks(rows),
            Section::Duels,
        ),
        (
            "The paper's claims on its rivals",
            claims::claims(rows),
            Section::Claims,
        ),
    ];
    for (title, part, section) in parts {
        let own: Vec<&Chart> = charts.iter().filter(|chart| chart.section == section).collect();
        if part.is_empty() && own.is_empty() {
            continue;
        }
        text += &format!("## {title}\n\n{part}");
        for Chart { name, caption, .. } in own {
            text += &format!("![{caption}](charts/{name}.png)\n*{caption}* ([SVG](charts/{name}.svg))\n\n");
        }
    }
    text + &drawings(pictures) + &sections::certificate(rows) + &unmeasured(rows)
}

/// A mesh of each domain.
fn drawings(pictures: &[Picture]) -> String {
    if pictures.is_empty() {
        return String::new();
    }
    let one = |picture: &Picture| {
        let Picture { name, title, caption } = picture;
        format!("![{title}](charts/{name}.png)\n*{caption}.*\n\n")
    };
    "## Meshes\n\nMade again from their rows, bit for bit by their fingerprints.\n\n".to_string()
        + &pictures.iter().map(one).collect::<String>()
}

const DEFAULT_QUESTION: &str = "How good and how small are the meshes that biting makes, as t and c_b vary?";

fn main_findings(rows: &[Row]) -> String {
    format!("## Main findings\n\n{}\n", finding_lines(rows))
}

/// One line for each thing asked, with its numbers.
pub(super) fn finding_lines(rows: &[Row]) -> String {
    // Beside peers there are too many rivals for a line each.
    let mut compared = peers::peer_findings(rows);
    if compared.is_empty() {
        compared = duels::duel_findings(rows);
    }
    let others = sections::order_finding(rows)
        .into_iter()
        .chain(compared)
        .chain(ranks::rank_finding(rows))
        .chain(claims::claim_findings(rows));
    bullets(headlines(rows).into_iter().chain(others))
}

/// The findings as another page quotes them: methods are set side by side in a table, and orders left out.
pub(super) fn findings_in_short(rows: &[Row]) -> String {
    let mut lines = headlines(rows);
    lines.extend(claims::claim_findings(rows));
    bullets(lines) + &standings(rows)
}

fn bullets(lines: impl IntoIterator<Item = String>) -> String {
    lines.into_iter().map(|line| format!("* {line}\n")).collect()
}

/// What does not set one method against another.
fn headlines(rows: &[Row]) -> Vec<String> {
    let lines = [
        angles::angle_finding(rows),
        angles::hypothesis_finding(rows),
        sections::size_finding(rows),
        sections::fewest_finding(rows),
        frontiers::frontier_finding(rows),
        poisson::poisson_finding(rows),
        adapt::adaptation_finding(rows),
        corners::corner_finding(rows),
        sections::certificate_finding(rows),
        sections::time_finding(rows),
    ];
    lines.into_iter().flatten().chain(rules::rule_findings(rows)).collect()
}

fn what_was_run(rows: &[Row], name: &str) -> String {
    let count = |rows: &[&Row], outcome: Outcome| rows.iter().filter(|row| row.outcome == outcome).count();
    let line = |name: &str, rows: &[&Row]| {
        let share = |outcome| match count(rows, outcome) {
            0 => "0".to_string(),
            some => format!("{some} of {}", rows.len()),
        };
        let outcomes = [Outcome::Measured, Outcome::Skipped, Outcome::Declined, Outcome::Failed].map(share);
        std::iter::once(name.to_string()).chain(outcomes).collect::<Vec<_>>()
    };
    let head = |what| [what, "measured", "skipped", "declined", "failed"];
    let groups = first_seen(rows.iter().map(|row| row.group.as_str()));
    let mut by_group: Vec<_> = groups.iter().map(|group| line(group, &of_group(rows, group))).collect();
    by_group.push(line("all", &rows.iter().collect::<Vec<_>>()));
    let meshers = first_seen(rows.iter().map(|row| row.cell.mesher.as_str()));
    let by_mesher = meshers.iter().map(|mesher| {
        let own: Vec<&Row> = rows.iter().filter(|row| row.cell.mesher == *mesher).collect();
        line(mesher, &own)
    });
    let domains = first_seen(rows.iter().map(|row| row.cell.domain.as_str()));
    let by_domain = domains.iter().map(|domain| {
        let own: Vec<&Row> = rows.iter().filter(|row| row.cell.domain == *domain).collect();
        line(domain, &own)
    });
    let mut text = String::from("## What was run\n\n") + &provenance(rows, name);
    text += &table(&head("group of cells"), &by_group);
    if meshers.len() > 1 {
        text += &table(&head("mesher"), &by_mesher.collect::<Vec<_>>());
    }
    text += &table(&head("domain"), &by_domain.collect::<Vec<_>>());
    for (title, grid) in grids(rows) {
        let values = |values: &[f64]| {
            let names: Vec<String> = values.iter().map(|value| parameter(*value)).collect();
            names.join(", ")
        };
        let meant = meaning(&title, &grid.rows);
        let (ts, c_bs) = (values(&grid.ts), values(&grid.c_bs));
        text += &format!("Biting's grid with spacing `{title}`{meant} over t = {ts}; c_b = {c_bs}.\n\n");
    }
    for (title, rows) in by_spacing(&of_group(rows, "orders")) {
        let meant = meaning(&title, &rows);
        let domains = first_seen(rows.iter().map(|row| row.cell.domain.as_str())).join("`, `");
        text += &format!("Orders with spacing `{title}`{meant} on `{domains}`.\n\n");
    }
    text
}

/// The spacings behind a title that is not the spacing itself.
fn meaning(title: &str, rows: &[&Row]) -> String {
    let specs = first_seen(rows.iter().map(|row| row.cell.spacing.as_str())).join("`, `");
    if specs == title {
        String::new()
    } else {
        format!(", that is `{specs}`,")
    }
}

/// Verbs whose own plan is that of their name.
const VERBS: [&str; 2] = ["sweep", "compare"];

/// Command, version, machine and date of the measured rows.
fn provenance(rows: &[Row], name: &str) -> String {
    let provenances: Vec<_> = rows
        .iter()
        .filter_map(measured)
        .map(|report| &report.provenance)
        .collect();
    let all = |text: Vec<String>| first_seen(text.iter().map(String::as_str)).join("; ");
    let command = match name.strip_suffix("-quick") {
        Some(plan) if VERBS.contains(&plan) => format!("{plan} --quick"),
        Some(plan) => format!("sweep experiments/{plan}.toml --quick"),
        None if VERBS.contains(&name) => name.to_string(),
        None => format!("sweep experiments/{name}.toml"),
    };
    let versions = provenances.iter().map(|made| {
        let commit: String = made.commit.chars().take(12).collect();
        let dirty = if made.dirty { " with changes" } else { "" };
        format!("biting {} {commit}{dirty}, {}", made.version, made.rustc)
    });
    let machines = provenances
        .iter()
        .map(|made| format!("{}, {} cores, {}", made.cpu, made.cores, made.os));
    let mut dates: Vec<&str> = provenances.iter().map(|made| made.date.as_str()).collect();
    dates.sort_unstable();
    let days = [dates.first(), dates.last()].map(|date| date.map(|date| date.chars().take(16).collect::<String>()));
    let [first, last] = days.map(Option::unwrap_or_default);
    let memory = rows
        .iter()
        .filter_map(measured)
        .map(|report| report.peak_rss_bytes as f64 / f64::from(1 << 20));
    let lines = [
        ("Command", format!("`cargo run --release -- {command}`")),
        ("Version", all(versions.collect())),
        ("Machine", all(machines.collect())),
        ("Run", format!("{first} to {last} UTC")),
        (
            "Peak memory",
            format!("{} MiB", number(quantile(memory.collect(), 1.0))),
        ),
    ];
    let text: String = lines
        .iter()
        .map(|(what, value)| format!("* {what}: {}\n", plain(value)))
        .collect();
    text + "\n"
}

/// Most lines a list of rows has.
pub(super) const MOST_LINES: usize = 40;

/// Cells that did not end measured, with reasons; skipped ones only as a count.
fn unmeasured(rows: &[Row]) -> String {
    let total = tally(rows);
    let skipped = rows.iter().filter(|row| row.outcome == Outcome::Skipped);
    let expected = spread(skipped.map(|row| row.estimated_triangles).collect());
    let expected = expected.map(|spread| {
        let (least, most) = (number(spread.least), number(spread.most));
        format!(" ({least} to {most} triangles expected, more than the budget allows)")
    });
    let mut text = format!(
        "## Cells not measured\n\nSkipped {} of {}{}. Declined {} of {}. Failed {} of {}.\n\n",
        total.skipped,
        total.cells,
        expected.unwrap_or_default(),
        total.declined,
        total.cells,
        total.failed,
        total.cells
    );
    let ended = rows
        .iter()
        .filter(|row| matches!(row.outcome, Outcome::Declined | Outcome::Failed));
    let lines: Vec<Vec<String>> = ended
        .map(|row| {
            let how = if row.outcome == Outcome::Failed {
                "failed"
            } else {
                "declined"
            };
            let reason = row.reason.clone().unwrap_or_default();
            vec![format!("`{}`", row.key), how.to_string(), reason]
        })
        .collect();
    if !lines.is_empty() {
        text += &table(&["cell", "ended", "reason"], &lines[..lines.len().min(MOST_LINES)]);
    }
    if lines.len() > MOST_LINES {
        text += &format!("and {} more in `rows.jsonl`.\n", lines.len() - MOST_LINES);
    }
    text
}
