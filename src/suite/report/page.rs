//! `README.md` of a results folder: what was run, what came out, the charts.

use super::drawer::Chart;
use super::markdown::{number, parameter, plain, table};
use super::sections::Entry;
use crate::suite::analysis::expect::{self, Finding};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{by_spacing, measured};
use crate::suite::rows::numbers::{first_seen, quantile, spread};
use crate::suite::rows::record::{Outcome, Row};
use crate::suite::rows::tables::Made;
use crate::suite::run::plan::Section;

/// The whole page of an experiment: `charts` has what was drawn for each of its sections.
pub(super) fn page(results: &Results, charts: &[(Section, Vec<Chart>)], name: &str) -> String {
    let mut text = format!("# Results of `{name}`\n\n{}", how_it_is_made(name, charts));
    text += &format!("**Question.** {}\n\n", results.question);
    text += &format!("**In short.** {}\n\n", headline(results).join(" "));
    text += &format!("## Findings\n\n{}\n", bullets(findings(results)));
    text += &expected(results);
    text += &what_was_run(results, name);
    for (section, charts) in charts {
        let Entry { title, text: body, .. } = Entry::of(*section);
        let body = body(results);
        text += &format!("## {title}\n\n{body}");
        if body.is_empty() && charts.is_empty() {
            text += "Nothing was measured for it.\n\n";
        }
        text += &charts.iter().map(shown).collect::<String>();
    }
    if results.rows.is_empty() {
        return text;
    }
    text + &unmeasured(&results.rows)
}

/// What the plan expected, and what came out.
fn expected(results: &Results) -> String {
    let line = |finding: Finding| {
        let holds = if finding.holds { "yes" } else { "**no**" };
        vec![finding.expected, finding.found, holds.to_owned()]
    };
    let lines: Vec<_> = expect::findings(results).into_iter().map(line).collect();
    if lines.is_empty() {
        return String::new();
    }
    "## What was expected\n\n".to_owned() + &table(&["expected", "found", "holds"], &lines)
}

/// What makes the page, and from what.
fn how_it_is_made(name: &str, charts: &[(Section, Vec<Chart>)]) -> String {
    let has_pictures = charts
        .iter()
        .flat_map(|(_, charts)| charts)
        .any(|chart| chart.is_picture);
    let pictures = if has_pictures {
        " For pictures of meshes it runs the meshers again, and shows a mesh if it has the fingerprint of its row."
    } else {
        ""
    };
    format!("Made by `biting report results/{name}` from what the run left beside this page.{pictures}\n\n")
}

fn shown(chart: &Chart) -> String {
    let Chart {
        name, title, caption, ..
    } = chart;
    let more = if chart.is_picture {
        String::new()
    } else {
        format!(" ([SVG](charts/{name}.svg))")
    };
    format!("![{title}](charts/{name}.png)\n*{caption}*{more}\n\n")
}

/// What was found, a sentence each.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let sections = results.sections.keys();
    sections
        .flat_map(|section| (Entry::of(*section).findings)(results))
        .collect()
}

/// What answers the question: the first finding of each section that the plan names for it, or of the first that has any.
pub(super) fn headline(results: &Results) -> Vec<String> {
    let first = |section: &Section| (Entry::of(*section).findings)(results).into_iter().next();
    match results.headline.is_empty() {
        true => results.sections.keys().find_map(first).into_iter().collect(),
        false => results.headline.iter().filter_map(first).collect(),
    }
}

fn bullets(lines: impl IntoIterator<Item = String>) -> String {
    lines.into_iter().map(|line| format!("* {line}\n")).collect()
}

fn what_was_run(results: &Results, name: &str) -> String {
    let rows = &results.rows[..];
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
    let of_group = |group: &str| rows.iter().filter(|row| row.group == group).collect::<Vec<_>>();
    let groups = first_seen(rows.iter().map(|row| row.group.as_str()));
    let mut by_group: Vec<_> = groups.iter().map(|group| line(group, &of_group(group))).collect();
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
    let mut text = String::from("## What was run\n\n") + &provenance(results, name);
    if rows.is_empty() {
        return text;
    }
    text += &table(&head("group of cells"), &by_group);
    if meshers.len() > 1 {
        text += &table(&head("mesher"), &by_mesher.collect::<Vec<_>>());
    }
    text += &table(&head("domain"), &by_domain.collect::<Vec<_>>());
    for (title, grid) in results.grids(Section::Angle) {
        let values = |values: &[f64]| {
            let names: Vec<String> = values.iter().map(|value| parameter(*value)).collect();
            names.join(", ")
        };
        let meant = meaning(&title, &grid.rows);
        let (ts, c_bs) = (values(&grid.ts), values(&grid.c_bs));
        text += &format!(
            "Grid of {} with spacing `{title}`{meant} over t = {ts}; c_b = {c_bs}.\n\n",
            results.about
        );
    }
    for (title, rows) in by_spacing(&results.of(Section::Orders)) {
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

/// Command, version, machine and dates.
fn provenance(results: &Results, name: &str) -> String {
    let made = &results.made;
    let all = |text: Vec<String>| first_seen(text.iter().map(String::as_str)).join("; ");
    let command = match name.strip_suffix("-quick") {
        Some(plan) if VERBS.contains(&plan) => format!("{plan} --quick"),
        Some(plan) => format!("sweep experiments/{plan}.toml --quick"),
        None if VERBS.contains(&name) => name.to_string(),
        None => format!("sweep experiments/{name}.toml"),
    };
    let versions = made.iter().map(|Made { by, .. }| {
        let commit: String = by.commit.chars().take(12).collect();
        let dirty = if by.dirty { " with changes" } else { "" };
        format!("biting {} {commit}{dirty}, {}", by.version, by.rustc)
    });
    let machines = made
        .iter()
        .map(|Made { by, .. }| format!("{}, {} cores, {}", by.cpu, by.cores, by.os));
    let minute = |date: &str| date.chars().take(16).collect::<String>();
    let first = made.iter().map(|made| minute(&made.by.date)).min();
    let last = made.iter().map(|made| minute(&made.until)).max();
    let mut lines = vec![
        ("Command", format!("`cargo run --release -- {command}`")),
        ("Version", all(versions.collect())),
        ("Machine", all(machines.collect())),
        (
            "Run",
            format!("{} to {} UTC", first.unwrap_or_default(), last.unwrap_or_default()),
        ),
    ];
    let times = results.rows.iter().filter_map(|row| measured(row)?.times.as_ref());
    let peaks = times.map(|times| times.peak_rss_bytes as f64 / f64::from(1 << 20));
    if let Some(peak) = quantile(peaks.collect(), 1.0) {
        lines.push(("Peak memory of cells that ran alone", format!("{} MiB", number(peak))));
    }
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
    let count = |outcome| rows.iter().filter(|row| row.outcome == outcome).count();
    let skipped = rows.iter().filter(|row| row.outcome == Outcome::Skipped);
    let expected = spread(skipped.map(|row| row.estimated_triangles).collect());
    let expected = expected.map(|spread| {
        let (least, most) = (number(spread.least), number(spread.most));
        format!(" ({least} to {most} triangles expected, more than the budget allows)")
    });
    let mut text = format!(
        "## Cells not measured\n\nSkipped {} of {}{}. Declined {} of {}. Failed {} of {}.\n\n",
        count(Outcome::Skipped),
        rows.len(),
        expected.unwrap_or_default(),
        count(Outcome::Declined),
        rows.len(),
        count(Outcome::Failed),
        rows.len()
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
        text += &format!("and {} more in `meshes.csv`.\n", lines.len() - MOST_LINES);
    }
    text
}
