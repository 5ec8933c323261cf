//! Comparisons against numbers worked out by hand.

use super::super::duels::duel;
use super::super::fixture::{asked, done, leave, results, timed};
use super::super::ranks::{self, rankings};
use super::super::standings::standings;
use super::super::{duels, write};
use crate::quality::{Angles, Seams};
use crate::suite::analysis::contest::{Contest, Method};
use crate::suite::analysis::measures::{MIN_ANGLE, TIME, TRIANGLES};
use crate::suite::analysis::remarks::{meetings, samplings};
use crate::suite::rows::record::{Outcome, Row, Try};
use crate::suite::run::plan::Section;
use serde_json::{Map, Value, json};

fn none() -> Value {
    Value::Object(Map::new())
}

/// Two meshers and a variant on three domains; the rival fails on the third.
fn three_domains() -> Vec<Row> {
    let mut rows = Vec::new();
    for (domain, triangles, ours, theirs) in [("a", 1000, 10.0, 8.0), ("b", 2000, 12.0, 16.0), ("c", 3000, 14.0, 0.0)] {
        rows.push(done("meshers", domain, "biting", none(), triangles, ours));
        rows.push(done(
            "meshers",
            domain,
            "biting",
            json!({ "order": "fifo" }),
            triangles,
            ours,
        ));
        if domain == "c" {
            let mut failed = asked("meshers", domain, "rival", none());
            (failed.outcome, failed.reason) = (Outcome::Failed, Some("fronts did not close".into()));
            rows.push(failed);
        } else {
            rows.push(done("meshers", domain, "rival", none(), 2 * triangles, theirs));
        }
    }
    rows
}

#[test]
fn places_are_by_medians_over_common_tasks() {
    let rows = three_domains();
    let all = results(&rows);
    let rankings = rankings(&all.askings(Section::Duels)[0]);
    assert_eq!(rankings[0].by, MIN_ANGLE);
    // Of a and b: ours 10 and 12 above the bound, its variant the same, the rival's 8 and 16.
    let places = [0, 1, 2].map(|method| rankings[0].place(method).unwrap().0);
    assert_eq!(places, [2, 2, 1]);
    let triangles = rankings.iter().find(|ranking| ranking.by == TRIANGLES).unwrap();
    assert_eq!(
        [0, 1, 2].map(|method| triangles.place(method).unwrap()),
        [(1, 1500.0), (1, 1500.0), (3, 3000.0)]
    );
    let told = ranks::findings(&all);
    let expected = "At equal edge length biting is 2nd of 3 methods by smallest angle, 1st by triangles, 1st by time per triangle.";
    assert_eq!(told, [expected]);
}

#[test]
fn other_pages_quote_a_table_of_one_method_a_mesher() {
    let told = standings(&results(&three_domains()), &["biting", "rival", "nobody"]);
    let table: Vec<&str> = told.lines().collect();
    let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
    let [ours, theirs] = [2, 3].map(|k: usize| cells(table[k]));
    assert_eq!(
        [ours[1].as_str(), ours[2].as_str(), ours[6].as_str()],
        ["biting", "25.48", "**1500**"]
    );
    assert_eq!(
        [theirs[1].as_str(), theirs[2].as_str(), theirs[6].as_str()],
        ["rival", "**26.48**", "3000"]
    );
    assert_eq!(table.len(), 4, "{told}");
    assert_eq!(standings(&results(&three_domains()), &["biting", "nobody"]), "");
}

#[test]
fn methods_are_named_by_what_differs() {
    let of = |params: Value| Method::of(&asked("meshers", "a", "biting", params));
    assert_eq!(of(none()).label, "biting");
    assert_eq!(of(json!({ "order": "largest" })), of(none()));
    assert_eq!(of(json!({ "order": "fifo" })).label, "biting order=fifo");
    assert!(of(none()).is_default && of(none()).place == 0 && !of(json!({ "order": "fifo" })).is_default);
}

#[test]
fn a_contest_counts_who_failed_and_compares_on_common_tasks() {
    let rows = three_domains();
    let results = results(&rows);
    let contest = results.at_equal_size(Section::Methods);
    let labels: Vec<&str> = contest.methods.iter().map(|method| method.label.as_str()).collect();
    assert_eq!(labels, ["biting", "biting order=fifo", "rival"]);
    assert_eq!((contest.leads(), contest.tasks.len()), (vec![0, 2], 3));
    assert_eq!(contest.common(&contest.all()), [0, 1]);
    assert_eq!(contest.common(&[0, 1]), [0, 1, 2]);
    assert_eq!(
        (contest.count(2, Outcome::Failed), contest.count(2, Outcome::Measured)),
        (1, 2)
    );
    assert_eq!(
        contest.median(0, &[0, 1], |report| Some(report.statistics.triangles as f64)),
        Some(1500.0)
    );
    assert!(results.at_equal_count(Section::Methods).tasks.is_empty());
    let alone: Vec<Row> = rows.into_iter().filter(|row| row.cell.mesher == "biting").collect();
    assert!(!Contest::of(&alone).has_several_meshers());
}

#[test]
fn duels_by_hand() {
    let rows = three_domains();
    let contest = Contest::of(&rows);
    let smallest = duel(&contest, [0, 2], &MIN_ANGLE).unwrap();
    assert_eq!((smallest.better, smallest.worse, smallest.of), (1, 1, 2));
    assert!((smallest.difference + 1.0).abs() < 1e-9);
    assert_eq!(smallest.ends.map(|(task, _)| task), [0, 1]);
    assert!((smallest.ends[0].1 - 2.0).abs() < 1e-9 && (smallest.ends[1].1 + 4.0).abs() < 1e-9);
    // Half the triangles is better; the difference is ours less theirs.
    let triangles = duel(&contest, [0, 2], &TRIANGLES).unwrap();
    assert_eq!(
        (triangles.better, triangles.worse, triangles.difference),
        (2, 0, -1500.0)
    );
    // The fixture gives every mesh a microsecond a triangle.
    let time = duel(&contest, [0, 2], &TIME).unwrap();
    assert_eq!((time.better, time.worse), (0, 0));
}

/// Cells of a rival that samples 2 and 16 points a side, on two domains.
fn densities() -> Vec<Row> {
    let mut rows = Vec::new();
    for (domain, scale) in [("a", 1), ("b", 4)] {
        rows.push(done("oversampling", domain, "biting", none(), 1000 * scale, 10.0));
        for (points, is_complete, triangles) in [(16, false, 1100), (2, false, 800), (2, true, 1200)] {
            let params = json!({ "oversample": points, "complete": is_complete });
            rows.push(done("oversampling", domain, "rival", params, triangles * scale, 10.0));
        }
    }
    rows
}

#[test]
fn densities_by_hand() {
    let rows = densities();
    let found = samplings(&Contest::of(&rows), "biting");
    let told: Vec<_> = found
        .iter()
        .map(|one| (one.points, one.is_complete, one.triangles, one.seconds))
        .collect();
    // The fixture's seconds go with its triangles.
    let same = |ratio| (Some(ratio), Some(ratio));
    let expected = [
        (2.0, false, same(0.8)),
        (16.0, false, same(1.1)),
        (2.0, true, same(1.2)),
    ];
    for (told, expected) in told.iter().zip(expected) {
        assert_eq!((told.0, told.1), (expected.0, expected.1));
        assert!((told.2.unwrap() - expected.2.0.unwrap()).abs() < 1e-12, "{told:?}");
        assert!((told.3.unwrap() - expected.2.1.unwrap()).abs() < 1e-12, "{told:?}");
    }
    assert_eq!(found[0].tasks, [2, 2]);
}

fn angles(triangles: usize, mean_deg: f64) -> Angles {
    Angles {
        triangles,
        min_deg: 10.0,
        mean_deg,
        p05_deg: 30.0,
        share_under_30: 0.1,
    }
}

/// A rival that marks where fronts met, worse there on two of three domains.
fn fronts() -> Vec<Row> {
    let means = [("a", 40.0, 50.0), ("b", 45.0, 44.0), ("c", 30.0, 55.0)];
    let one = |(domain, there, elsewhere): (&str, f64, f64)| {
        let mut row = done("meshers", domain, "front", none(), 1000, 10.0);
        if let Some(report) = &mut row.report {
            report.statistics.seams = Some(Seams {
                met: angles(100, there),
                elsewhere: angles(900, elsewhere),
            });
        }
        row
    };
    means.into_iter().map(one).collect()
}

#[test]
fn meetings_by_hand() {
    let mut rows = fronts();
    rows.extend(three_domains());
    let found = meetings(&rows);
    assert_eq!(found.len(), 1);
    let front = &found[0];
    assert_eq!((front.meshes, front.worse, front.share), ([3, 3], 2, 0.1));
    assert_eq!((front.met.mean_deg, front.elsewhere.mean_deg), (40.0, 50.0));
}

/// Everything together, and cells at equal count, one of which missed.
fn everything() -> Vec<Row> {
    let mut rows = three_domains();
    rows.extend(fronts());
    rows.extend(densities());
    for (mesher, triangles) in [("biting", 5010), ("rival", 5900)] {
        let mut cell = done("count", "a", mesher, none(), triangles, 9.0);
        cell.cell.triangles = Some(5000);
        cell.tries = vec![Try {
            c_b: 0.4,
            triangles: Some(triangles as u64),
        }];
        rows.push(cell);
    }
    for (mesher, power) in [("biting", 1.0), ("rival", 1.5)] {
        for size in [10_000usize, 40_000, 160_000] {
            let cell = done("time", &format!("square-{size}"), mesher, none(), size, 9.0);
            rows.push(timed(cell, 1e-6 * (size as f64).powf(power)));
        }
    }
    rows
}

#[test]
fn the_page_sets_meshers_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    leave(&everything(), folder.path());
    let text = std::fs::read_to_string(write(folder.path()).unwrap()).unwrap();
    for expected in [
        "| rival | 2 of 3 | 0 | 0 | 1 of 3 |",
        "2 of 3 tasks were measured by all",
        "1 of 2 meshes did not come so near, the farthest being 18.0 % off",
        "### biting against rival, at equal edge length",
        "### biting against rival, at equal triangle count",
        "The paper's remark that quality is lost where fronts meet holds for front: mean smallest angle 40.00° there, 50.00° elsewhere",
        "The paper's remark that oversampling costs more holds in part: 2 of 3 densities take longer than biting, 0.800 to 1.20 times",
        "| biting | 3 of 3 | 10000 to 160000 |",
        "| `meshers/c/rival/{}` | failed | fronts did not close |",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
    for chart in [
        "meshers",
        "meshers-angles",
        "meshers-domains",
        "meshers-count",
        "meshers-count-angles",
        "meshers-count-domains",
        "meshers-time",
        "seams",
        "oversampling",
    ] {
        for ending in ["png", "svg"] {
            assert!(text.contains(&format!("charts/{chart}.{ending}")), "{chart}");
            assert!(
                folder.path().join(format!("charts/{chart}.{ending}")).is_file(),
                "{chart}"
            );
        }
    }
    let drawn = std::fs::read_to_string(folder.path().join("charts/meshers-domains.svg")).unwrap();
    assert!(drawn.contains("failed"), "a failure shows in the chart");
    let drawn = std::fs::read_to_string(folder.path().join("charts/meshers.svg")).unwrap();
    assert!(drawn.contains("rival (2 of 3)"), "and beside the name");
}

#[test]
fn the_findings_tell_of_every_rival() {
    let told = duels::findings(&results(&everything()));
    for expected in [
        "At equal edge length biting is better than rival in 1 of 7 measures; smallest angle 25.48° against 26.48°",
        "At equal edge length biting is better than front in",
        "At equal triangle count biting is better than rival in 0 of 5 measures",
    ] {
        assert!(
            told.iter().any(|line| line.starts_with(expected)),
            "{expected}: {told:#?}"
        );
    }
}
