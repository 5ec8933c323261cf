//! What the paper says and what comes out.

use super::findings::FINDINGS;
use super::judge::{Verdict, grid, optima, verdict};
use super::measured::Meshes;
use super::record::{Bound, Formula, Statement};
use super::search::Sense;
use super::statements;
use std::collections::BTreeSet;

/// The verdict on a formula for a statement, on a coarse grid.
fn on(statement: &Statement, bound: &Bound, range: (f64, f64)) -> Verdict {
    verdict(statement, bound, range, &optima(statement, &grid(statement, 4)))
}

/// The statement of this name.
fn statement(name: &str) -> Statement {
    let found = statements::all().into_iter().find(|statement| statement.name == name);
    found.expect("a statement")
}

#[test]
fn every_formula_is_judged_and_only_three_fail() {
    let mut failed = Vec::new();
    for statement in statements::all() {
        let judged = optima(&statement, &grid(&statement, 5));
        assert!(!judged.is_empty(), "{}", statement.name);
        match verdict(&statement, &statement.printed, statement.range, &judged) {
            Verdict::Fails { .. } => failed.push(statement.name),
            Verdict::Open { parameter } => panic!("{} is open at {parameter}", statement.name),
            _ => {}
        }
        if let Some(corrected) = &statement.corrected {
            let verdict = verdict(&statement, &corrected.bound, corrected.range, &judged);
            assert!(verdict.holds(), "{}, corrected: {verdict:?}", statement.name);
        }
    }
    assert_eq!(failed, ["lemma-2.1", "equation-10", "lemma-6.6"]);
}

#[test]
fn a_planted_wrong_formula_is_caught() {
    // Each a plausible slip: a sign, a factor, a root.
    let planted: [(&str, Formula); 6] = [
        ("lemma-5.3", |t| 2.0 / (1.0 + t)),
        ("lemma-5.4", |t| 1.0 / (2.0 - t)),
        ("theorem-5.5", |t| (1.0 + t) / (1.0 - t / 2.0)),
        ("lemma-5.8-lower", |t| 1.0 / (2.0 - t)),
        ("lemma-6.1", |t| 1.0 - t),
        ("lemma-6.3", |t| (1.0 - t) * ((3.0 + t) * (1.0 + t)).sqrt() / 2.0),
    ];
    for (name, at) in planted {
        let statement = statement(name);
        assert!(on(&statement, &statement.printed, statement.range).holds(), "{name}");
        let wrong = Bound { says: "planted", at };
        let verdict = on(&statement, &wrong, statement.range);
        assert!(matches!(verdict, Verdict::Fails { .. }), "{name}: {verdict:?}");
    }
}

#[test]
fn a_bound_a_little_beyond_the_optimum_fails_and_a_little_short_of_it_is_loose() {
    for name in ["lemma-5.4", "theorem-5.5", "lemma-6.2", "lemma-6.4"] {
        let statement = statement(name);
        let judged = optima(&statement, &[0.2]);
        let optimum = judged[0].optimum.found;
        let sign = match statement.sense {
            Sense::AtLeast => 1.0,
            Sense::AtMost => -1.0,
        };
        let share = statement.sense.allows(optimum, optimum * (1.0 - 1e-3 * sign), 0.0);
        assert!(!share, "the order of values is the wrong way round for {name}");
        assert!(
            !statement.sense.allows(optimum * (1.0 + 1e-3 * sign), optimum, 2e-4),
            "{name}"
        );
        assert!(
            statement.sense.allows(optimum * (1.0 - 1e-3 * sign), optimum, 2e-4),
            "{name}"
        );
    }
}

#[test]
fn known_values_come_out() {
    let optimum = |name: &str, t: f64| {
        let statement = statement(name);
        optima(&statement, &[t])[0].optimum.found
    };
    let close = |value: f64, expected: f64| assert!((value - expected).abs() < 2e-4, "{value} {expected}");
    close(optimum("lemma-6.4", 0.0), 7f64.sqrt() / 4.0);
    close(optimum("equation-10", 0.0), 7f64.sqrt() / 6.0);
    close(optimum("lemma-2.1", 1.0), 3.0);
    close(optimum("lemma-5.8-upper", 0.25), 2.0 / 0.75);
    close(optimum("lemma-6.1", 0.25), 0.5);
}

#[test]
fn witnesses_are_what_they_are_said_to_be() {
    // (10) at t = 0: r is on both circles, and its height over |p₁q| is the value found.
    let statement = statement("equation-10");
    for t in [0.0, 0.2, 0.4] {
        let optimum = &optima(&statement, &[t])[0].optimum;
        let points = (statement.points)(t, &optimum.at);
        let find = |label: &str| points.iter().find(|point| point.label == label).expect("a point");
        let [p1, q, r] = ["p₁", "q", "r"].map(find);
        let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        assert!((distance(p1.at, r.at) - p1.radius.expect("a radius")).abs() < 1e-9);
        assert!((distance(q.at, r.at) - q.radius.expect("a radius")).abs() < 1e-9);
        assert!((r.at[1] / distance(p1.at, q.at) - optimum.found).abs() < 1e-6);
    }
}

#[test]
fn lemma_6_6_holds_up_to_0_3984() {
    let statement = statement("lemma-6.6");
    let largest = |t: f64| optima(&statement, &[t])[0].optimum.found;
    assert!(largest(0.398) < 0.625 && largest(0.399) > 0.625);
}

#[test]
fn demonstrations_show_what_the_findings_say() {
    for finding in FINDINGS {
        let Some(demonstration) = &finding.demonstration else {
            continue;
        };
        let shown = demonstration.run().expect("a demonstration");
        let value = |part: &str| {
            let found = shown.iter().find(|shown| shown.name.contains(part));
            found
                .unwrap_or_else(|| panic!("{}: no {part} in {shown:?}", finding.name))
                .value
        };
        match finding.name {
            "boundary-lfs" => {
                assert_eq!((value("long side"), value("lfs at the centre")), (2.0, 1.0));
                assert!((value("largest 1-Lipschitz") - 3.0).abs() < 1e-9);
            }
            "cap-needed" => assert!(value("smallest |x") < 1.0 && value("overlapping") > 0.0),
            "right-angle" => {
                assert!(value("0.3333") < 1.0 && (value("0.4142") - 1.0).abs() < 1e-12 && value("0.5000") > 1.0);
            }
            "head-on" => {
                assert!(value("smallest angle") < 1.0 && value("asin") > 26.0 && value("meet too low") > 0.0);
            }
            "forced-pieces" => {
                assert!(value("no Delaunay") > 0.0 && value("c_b + t") <= 1.0 && value("smallest input") >= 90.0);
            }
            other => panic!("nobody looks at {other}"),
        }
    }
}

#[test]
fn names_are_unique() {
    let names: Vec<&str> = statements::all()
        .iter()
        .map(|statement| statement.name)
        .chain(FINDINGS.iter().map(|finding| finding.name))
        .collect();
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
}

#[test]
fn committed_meshes_keep_every_bound() {
    let results = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("results");
    let meshes = Meshes::read(&results).expect("the committed rows");
    assert!(meshes.count() > 1000);
    for statement in statements::all() {
        let Some(worst) = meshes.worst(&statement) else {
            continue;
        };
        let sense = statement.measured.map_or(statement.sense, |measured| measured.sense);
        let kept = sense.allows(1.0, worst.ratio, 1e-6);
        assert!(kept && worst.meshes > 100, "{}: {worst:?}", statement.name);
        // What its figure shows of meshes is on the safe side of the printed formula too.
        for (t, value) in meshes.by_t(&statement) {
            let bound = (statement.printed.at)(t);
            // Their t is rounded for it.
            assert!(
                statement.sense.allows(bound, value, 1e-4),
                "{} at {t}: {value}",
                statement.name
            );
        }
    }
}
