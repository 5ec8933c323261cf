//! Pages with meshers outside this crate, with a frontier, and with Poisson problems, against numbers worked out by hand.

use super::super::fixture::{asked, done, results};
use super::super::{duels, frontier, peers, poisson, tasks};
use crate::suite::fem::{Solution, Solver, Spectrum};
use crate::suite::rows::record::{Outcome, Outside, Row};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The lines of a page that start so.
fn starting<'a>(page: &'a str, start: &str) -> Vec<&'a str> {
    page.lines().filter(|line| line.starts_with(start)).collect()
}

/// The same by a peer, which told of its run.
fn outside(domain: &str, mesher: &str, triangles: usize, margin: f64) -> Row {
    let mut row = done("meshers", domain, mesher, json!({}), triangles, margin);
    let report = row.report.as_mut().expect("measured");
    let times = report.times.as_mut().expect("timed");
    times.rss_before_bytes = 30_000_000;
    times.peak_rss_bytes = 50_000_000;
    if domain == "b" {
        times.samples = vec![1.0, 2.0, 2.5];
    }
    report.outside = Some(Outside {
        version: "4.5.6".into(),
        set_up_seconds: BTreeMap::from([
            ("imports".into(), 0.5),
            ("read".into(), 0.25),
            ("size_field".into(), 0.125),
        ]),
        repeats_differ: mesher == "mmg",
    });
    row
}

fn with_peers() -> Vec<Row> {
    let mut rows = Vec::new();
    for (domain, margins) in [("a", [10.0, 20.0, 5.0]), ("b", [10.0, 8.0, 12.0])] {
        rows.push(done("meshers", domain, "biting", json!({}), 1000, margins[0]));
        rows.push(outside(domain, "gmsh", 1100, margins[1]));
        rows.push(outside(domain, "mmg", 900, margins[2]));
        let mut missing = asked("meshers", domain, "netgen", json!({}));
        missing.reason = Some("not installed; so install it".into());
        rows.push(missing);
        let mut broken = outside(domain, "bamg", 500, 1.0);
        (broken.outcome, broken.reason) = (Outcome::Failed, Some("its mesh breaks input-vertices".into()));
        rows.push(broken);
    }
    rows
}

#[test]
fn peers_are_told_with_versions_and_what_they_break() {
    let rows = with_peers();
    let results = results(&rows);
    let page = peers::text(&results);
    let gmsh = starting(&page, "| [gmsh]");
    assert_eq!(
        gmsh,
        ["| [gmsh](../../baselines/gmsh/README.md) | 4.5.6 | 2 | 0 | 0 | 0 | 0.500, 0.250, 0.125 | yes |"]
    );
    assert!(starting(&page, "| [mmg]")[0].ends_with("| no |"), "its repeats differ");
    // Of netgen nothing is known but that it is not there.
    assert_eq!(
        starting(&page, "| [netgen]"),
        ["| [netgen](../../baselines/netgen/README.md) |  | 0 | 0 | 0 | 2 | –, –, – | – |"]
    );
    assert_eq!(starting(&page, "### "), ["### What becomes of the boundary"]);
    assert!(
        starting(&page, "| bamg |")[0].starts_with("| bamg | 0 of 2 | a, b |"),
        "{page}"
    );
    assert_eq!(starting(&page, "| gmsh |"), ["| gmsh | 2 of 2 | – | – |"]);
    let tasks = tasks::text(&results);
    let tables = [
        "### a, `lfs`, at equal edge length",
        "### b, `lfs`, at equal edge length",
    ];
    assert_eq!(starting(&tasks, "### "), tables);
    // A mesh that is none of the domain is shown with its numbers and what it breaks; memory and repeats as they were told.
    let broken = starting(&tasks, "| bamg |");
    assert!(
        broken[0].contains("| 500 |") && broken[0].ends_with("failed: its mesh breaks input-vertices |"),
        "{broken:?}"
    );
    let told = starting(&tasks, "| gmsh |");
    assert!(told[0].contains("| 1.00 | 5 % | 50.0 (30.0) |"), "{told:?}");
    // Repeats that lie far apart make no speed.
    assert!(told[1].contains("| busy machine | 75 % | 50.0 (30.0) |"), "{told:?}");
    assert!(starting(&tasks, "| netgen |")[0].contains("skipped: not installed"));
}

#[test]
fn who_is_best_is_counted_task_by_task() {
    let results = results(&with_peers());
    let told = duels::findings(&results);
    // Smallest angles: on a gmsh has 34.5, on b mmg has 26.5; ours is 2nd on both, with 24.5/34.5 and 24.5/26.5 of the best.
    let expected = "At equal edge length gmsh has the best smallest angle on 1 of 2 tasks; biting is 2nd in the median, with 0.817 times the best.";
    assert!(told.contains(&expected.to_owned()), "{told:#?}");
    let page = duels::text(&results);
    assert!(
        page.contains("| smallest angle (°) | gmsh on 1, mmg on 1 | 2nd | 0.817 |"),
        "{page}"
    );
    // A mesh that failed does not win by its few triangles.
    assert!(page.contains("| triangles | mmg on 2 | 2nd |"), "{page}");
}

/// A frontier's row: smallest angle and triangles / ∫ dA / lfs².
fn point(domain: &str, mesher: &str, params: Value, angle: f64, size: f64) -> Row {
    let mut row = done(
        "frontier",
        domain,
        mesher,
        params,
        1000,
        angle - 0.25f64.asin().to_degrees(),
    );
    row.report.as_mut().expect("measured").size_ratio_lfs = size;
    row
}

#[test]
fn biting_is_measured_by_triangle_at_equal_angle() {
    let angle = |degrees: f64| json!({ "angle": degrees, "size": "none" });
    let rows = vec![
        point("a", "biting", json!({}), 22.0, 6.0),
        point("a", "biting", json!({ "order": "fifo" }), 26.0, 9.0),
        point("a", "triangle", angle(20.0), 21.0, 1.5),
        point("a", "triangle", angle(25.0), 27.0, 3.0),
        point("b", "biting", json!({}), 22.0, 4.0),
        point("b", "biting", json!({ "order": "fifo" }), 26.0, 8.0),
        point("b", "triangle", angle(20.0), 20.0, 1.0),
        point("b", "triangle", angle(25.0), 25.0, 2.0),
    ];
    let results = results(&rows);
    let families = frontier::by_domain(&results);
    assert_eq!(families.len(), 3, "a, b, and both");
    let labels: Vec<&str> = families[0].1.iter().map(|family| family.label.as_str()).collect();
    assert_eq!(
        labels,
        ["biting", "biting order=fifo", "triangle"],
        "what is swept is no family"
    );
    // At 20° biting has 6 on a and 4 on b where Triangle has 1.5 and 1: four times on both.
    let told = frontier::findings(&results);
    assert!(
        told[0].contains("biting needs 4.00 times as many") && told[0].contains("over 2 domains"),
        "{told:?}"
    );
    // At 25° fifo has 9 and 8, Triangle 3 and 2; at biting's own 22° Triangle needs its setting of 25°.
    let page = frontier::text(&results);
    assert!(page.contains("| 25° | 2 | 3.50 | 3.00 (a) | 4.00 (b) |"), "{page}");
    assert!(
        told[1].contains("nearest to Triangle on all domains is biting, t = 0.25, c_b = 0.75, with 2.00 times"),
        "{told:?}"
    );
    let first = starting(&page, "| a |");
    assert!(
        first.iter().any(|line| line.contains("| 6.00 (4.00) | 1.50 |")),
        "{first:?}"
    );
}

#[test]
fn errors_are_compared_per_unknown() {
    let solved = |mesher: &str, count: u64, scale: f64| {
        let mut row = done("poisson", "a", mesher, json!({}), count as usize, 10.0);
        row.cell.poisson = Some("smooth".into());
        row.cell.triangles = Some(count);
        let unknowns = count as usize / 2;
        row.report.as_mut().expect("measured").poisson = Some(Solution {
            unknowns,
            energy_error: scale * 2.0 / (unknowns as f64).sqrt(),
            energy_norm: 2.0,
            l2_error: scale * 3.0 / unknowns as f64,
            l2_norm: 1.0,
            solver: Solver::Cholesky,
            iterations: 40,
            converged: true,
            spectrum: Some(Spectrum {
                largest: 7.0,
                largest_preconditioned: 2.0,
                smallest_preconditioned: 0.01,
                condition_preconditioned: 200.0,
            }),
        });
        row
    };
    let rows: Vec<Row> = [("biting", 1.2), ("gmsh", 1.0)]
        .into_iter()
        .flat_map(|(mesher, scale)| [1000, 4000].map(|count| solved(mesher, count, scale)))
        .collect();
    let results = results(&rows);
    let page = poisson::text(&results);
    assert!(page.contains("### smooth on a, sizes by `lfs`"), "{page}");
    assert!(
        starting(&page, "| biting |")[0].starts_with("| biting | 2 of 2 | 1.20 | 3.60 |"),
        "{page}"
    );
    assert!(
        starting(&page, "| gmsh |")[0].contains("| 1.00 | 3.00 |") && page.contains("| 7.00 | 200 |"),
        "{page}"
    );
    assert!(
        page.contains("| energy error · √unknowns | 1.20 | 1.10 | 1.20 |"),
        "{page}"
    );
    let told = &poisson::findings(&results)[0];
    assert!(
        told.ends_with("biting's energy error per unknown is 1.20 times that of the best method."),
        "{told}"
    );
}
