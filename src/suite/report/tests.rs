//! Findings against numbers worked out by hand, and the page as files.

mod adaptation;
mod contests;
mod peers;
mod rules;

use super::angle::margins;
use super::certificate::{self, broken_checks, claim_tallies};
use super::fewest::fewest;
use super::fixture::{leave, measured, results, row, sweep, timed};
use super::orders::best_on;
use super::time::slopes;
use super::{ReportError, orders, page, write};
use crate::meshers::{Budget, Request};
use crate::suite::analysis::measures::{MEAN_ANGLE, MIN_ANGLE};
use crate::suite::analysis::series::order_groups;
use crate::suite::analysis::summary::{Grid, Setting, unbeaten_pairs};
use crate::suite::rows::record::{Outcome, Provenance, Row};
use crate::suite::rows::tables::RUN;
use crate::suite::run::plan::Section;
use crate::suite::run::prepare::Store;
use crate::suite::run::{measure, runner};
use crate::theory::Claim;
use std::collections::BTreeMap;
use std::path::Path;

fn cell(domain: &str, t: f64, c_b: f64) -> Row {
    row("grid", domain, "lfs", t, c_b, "fifo")
}

/// Two domains of right angles and one acute at t = 0.25, 0.5; c_b = 1; one cell of the second skipped.
fn three_domains() -> Vec<Row> {
    vec![
        measured(cell("a", 0.25, 1.0), 90.0, 1000, 1.0),
        measured(cell("b", 0.25, 1.0), 90.0, 1000, 4.0),
        measured(cell("c", 0.25, 1.0), 36.0, 1000, -2.0),
        measured(cell("a", 0.5, 1.0), 90.0, 1000, 7.0),
        cell("b", 0.5, 1.0),
        measured(cell("c", 0.5, 1.0), 36.0, 1000, 3.0),
    ]
}

#[test]
fn margins_by_hand() {
    let rows = three_domains();
    let grid = Grid::of(&rows);
    let plain = margins(&grid, Setting::Papers, Some(0.25)).unwrap();
    assert_eq!(plain.count, 2);
    assert!((plain.least - 1.0).abs() < 1e-9 && (plain.median - 2.5).abs() < 1e-9 && (plain.most - 4.0).abs() < 1e-9);
    assert!((margins(&grid, Setting::Acute, Some(0.25)).unwrap().least + 2.0).abs() < 1e-9);
    assert_eq!(margins(&grid, Setting::Papers, Some(0.5)).unwrap().count, 1);
    assert_eq!(margins(&grid, Setting::Papers, None).unwrap().count, 3);
}

#[test]
fn pairs_need_all_their_domains() {
    let rows = three_domains();
    let grid = Grid::of(&rows);
    let plain = grid.without_acute().pairs();
    // At t = 0.5 domain b was skipped, so that pair is out; at t = 0.25 the worse of 14.48° + 1° and + 4° counts.
    assert_eq!((plain.len(), plain[0].t, plain[0].domains), (1, 0.25, 2));
    assert!((plain[0].smallest_angle_deg - 15.477_512).abs() < 1e-5);
    assert!((plain[0].size_ratio_lfs - 9.2).abs() < 1e-12);
    assert_eq!(fewest(&plain, 15.0), Some(plain[0]));
    assert_eq!(fewest(&plain, 16.0), None);
    assert!((grid.pairs()[0].smallest_angle_deg - 12.477_512).abs() < 1e-5);
}

#[test]
fn the_frontier_keeps_what_nothing_beats() {
    let rows = sweep();
    let grid = Grid::of(
        rows.iter()
            .filter(|row| row.group == "grid" && row.cell.spacing == "lfs"),
    );
    let pairs = grid.pairs();
    let best = unbeaten_pairs(&pairs);
    let beats = |a: &crate::suite::analysis::summary::Pair, b: &crate::suite::analysis::summary::Pair| {
        let no_worse = a.smallest_angle_deg >= b.smallest_angle_deg && a.size_ratio_lfs <= b.size_ratio_lfs;
        no_worse && (a.smallest_angle_deg, a.size_ratio_lfs) != (b.smallest_angle_deg, b.size_ratio_lfs)
    };
    for pair in &pairs {
        assert_eq!(
            best.contains(pair),
            !pairs.iter().any(|other| beats(other, pair)),
            "{pair:?}"
        );
    }
}

#[test]
fn orders_by_hand() {
    let order = |domain: &str, order: &str, margin: f64| {
        measured(row("orders", domain, "lfs", 0.5, 1.0, order), 90.0, 1000, margin)
    };
    let rows = [
        order("a", "fifo", 20.0),
        order("b", "fifo", 24.0),
        order("a", "lifo", 21.0),
        row("orders", "b", "lfs", 0.5, 1.0, "lifo"),
    ];
    let results = results(&rows);
    let page = orders::text(&results);
    // The fixture's mean is half the smallest angle plus 36°, its bound at t = 0.5 is 0.
    for line in [
        "| lfs | fifo | 2 of 2 | 22.00 | 47.00 |",
        "| lfs | lifo | 1 of 2 | 21.00 | 46.50 |",
    ] {
        assert!(page.contains(line), "{line}\n{page}");
    }
    let rows = results.ours(Section::Orders);
    let groups = order_groups(&rows);
    let [fifo, lifo] = &groups[..] else {
        panic!("two orders")
    };
    assert_eq!(best_on(&groups, fifo, &MEAN_ANGLE), ["b"]);
    assert_eq!(best_on(&groups, lifo, &MIN_ANGLE), ["a"]);
    assert_eq!(
        orders::findings(&results),
        [
            "With `lfs`, order `fifo` has the largest mean smallest angle, 47.00° in the median over domains, at 1.00 times the time of the fastest order."
        ]
    );
}

#[test]
fn slopes_of_a_power_law() {
    let mut rows: Vec<Row> = Vec::new();
    for power in 10..14 {
        let cell = row("time", "unit-square", "uniform:1", 0.25, 1.0 / f64::from(power), "fifo");
        rows.push(timed(
            measured(cell, 90.0, 1 << power, 1.0),
            (f64::from(power) * 1.25).exp2(),
        ));
    }
    let slopes = slopes(&results(&rows));
    assert_eq!(slopes[0].name, "whole mesh");
    assert!((slopes[0].slope.unwrap() - 1.25).abs() < 1e-12);
    assert!((slopes[1].slope.unwrap() - 1.0).abs() < 1e-12);
    assert_eq!(slopes[0].triangles, (1024.0, 8192.0));
}

#[test]
fn a_broken_bound_is_listed_with_its_place() {
    let rows = three_domains();
    let angle = claim_tallies(&rows)
        .into_iter()
        .find(|tally| tally.claim == Claim::MinAngle)
        .unwrap();
    assert_eq!((angle.guaranteed, angle.measured), ((5, 4), (0, 0)));
    let results = results(&rows);
    let broken = broken_checks(&results, true);
    assert_eq!(broken.len(), 1);
    assert_eq!(broken[0][1], "c");
    assert!(broken[0].contains(&"(0.250, 0.750)".to_string()) && broken[0].contains(&"36.00°".to_string()));
    assert!(broken_checks(&results, false).is_empty());
    let finding = &certificate::findings(&results)[0];
    assert!(finding.contains("holds in 4 of 5 meshes;"), "{finding}");
}

#[test]
fn a_failure_shows_on_the_page() {
    let mut rows = three_domains();
    rows[4].outcome = Outcome::Failed;
    rows[4].reason = Some("no triangle | at (0.1, 0.2)".into());
    let text = page::page(&results(&rows), &[(Section::Size, Vec::new())], "made-up");
    assert!(text.contains("| grid | 5 of 6 | 0 | 0 | 1 of 6 |"), "{text}");
    assert!(text.contains("| b | 1 of 2 | 0 | 0 | 1 of 2 |"), "{text}");
    assert!(
        text.contains("| `grid/b/lfs/0.5/1/fifo` | failed | no triangle \\| at (0.1, 0.2) |"),
        "{text}"
    );
    // A median over survivors says so.
    assert!(text.contains("| 0.5 | 4.60 (2 of 3) |"), "{text}");
}

#[test]
fn a_page_of_nothing_measured() {
    let text = page::page(
        &results(&[cell("a", 0.25, 1.0)]),
        &[(Section::Fewest, Vec::new())],
        "made-up",
    );
    assert!(
        text.contains("Skipped 1 of 1") && text.contains("Nothing was measured for it.") && !text.contains("NaN"),
        "{text}"
    );
}

/// A row measured in earnest.
fn in_earnest(domain: &str) -> Row {
    let mut row = cell(domain, 0.25, 0.5);
    let prepared = Store::new(None, false).prepare_for_t(&row.cell).unwrap();
    let mesher = runner::mesher(&row.cell).unwrap();
    let request = Request {
        c_b: 0.5,
        seed: 0,
        threads: 1,
        budget: Budget::default(),
    };
    let run = measure::run(&prepared, &mesher, &request).unwrap();
    row.report = Some(measure::judge(
        &prepared,
        &row.cell,
        &mesher,
        &run,
        &Provenance::default(),
    ));
    row.outcome = Outcome::Measured;
    row
}

#[test]
fn a_mesh_is_drawn_again_if_it_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let mut rows = vec![in_earnest("l-shape"), cell("no-such-domain", 0.25, 0.5)];
    leave(&rows, folder.path());
    let page = std::fs::read_to_string(write(folder.path()).unwrap()).unwrap();
    assert!(page.contains("(charts/mesh-l-shape.png)"), "{page}");
    assert!(folder.path().join("charts/mesh-l-shape.png").is_file());
    if let Some(report) = &mut rows[0].report {
        report.fingerprint = "another".into();
    }
    leave(&rows, folder.path());
    let page = std::fs::read_to_string(write(folder.path()).unwrap()).unwrap();
    assert!(!page.contains("charts/mesh-"), "{page}");
}

#[test]
fn no_rows_are_an_error() {
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(write(folder.path()), Err(ReportError::Results(_))));
}

/// Every file under `folder`, but the rows, by its name.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for part in [folder.to_path_buf(), folder.join("charts")] {
        for entry in std::fs::read_dir(part).unwrap().map(|entry| entry.unwrap().path()) {
            let name = entry.file_name().unwrap().to_string_lossy().into_owned();
            if entry.is_file() && !name.ends_with(".csv") && name != RUN {
                found.insert(name, std::fs::read(&entry).unwrap());
            }
        }
    }
    found
}

#[test]
fn the_same_rows_in_any_order_give_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let mut rows = sweep();
    let mut written = Vec::new();
    for name in ["a/sweep", "b/sweep"] {
        let folder = folder.path().join(name);
        leave(&rows, &folder);
        write(&folder).unwrap();
        written.push(files(&folder));
        rows.reverse();
    }
    assert!(written[0] == written[1]);
    let page = String::from_utf8(written[0]["README.md"].clone()).unwrap();
    assert_eq!(written[0].len(), 2 * 11 + 1);
    for (name, bytes) in written[0].iter().filter(|(name, _)| *name != "README.md") {
        assert!(page.contains(&format!("charts/{name}")), "{name} is on the page");
        let most = if name.ends_with(".svg") { 300_000 } else { 200_000 };
        assert!((2_000..most).contains(&bytes.len()), "{name} has {} bytes", bytes.len());
    }
}

/// Words of a sentence, by blanks.
fn words(sentence: &str) -> usize {
    sentence.split_whitespace().count()
}

#[test]
fn findings_are_short_and_headlines_shorter() {
    let mut pages = 0;
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for folder in std::fs::read_dir(root.join("results")).unwrap().flatten() {
        let Ok(page) = std::fs::read_to_string(folder.path().join("README.md")) else {
            continue;
        };
        let name = folder.path().display().to_string();
        let headline = page.lines().find_map(|line| line.strip_prefix("**In short.** "));
        for sentence in headline
            .unwrap_or_else(|| panic!("{name} has no headline"))
            .split_inclusive(". ")
        {
            let count = words(sentence);
            assert!(count <= 25, "{name}: {count} words: {sentence}");
        }
        let findings = page.split("## Findings\n\n").nth(1).unwrap_or_default();
        for finding in findings.lines().map_while(|line| line.strip_prefix("* ")) {
            let count = words(finding);
            assert!(count <= 30, "{name}: {count} words: {finding}");
            pages += 1;
        }
    }
    assert!(pages > 40, "{pages} findings");
}
