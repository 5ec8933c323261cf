//! Slopes against errors that follow a power of the vertices, on the page, in the finding and as expectations.

use super::super::adaptation;
use super::super::fixture::{measured, results, row};
use crate::suite::analysis::convergence::convergence;
use crate::suite::analysis::expect::findings;
use crate::suite::analysis::results::Results;
use crate::suite::fem::{Solution, Solver};
use crate::suite::rows::adapted::{Adapt, Round};
use crate::suite::rows::record::Row;
use crate::suite::run::plan::{Expectations, SlopeRange};

/// A mesh of so many vertices whose relative error is 10 over them, or, uniform, their power −2/3.
fn mesh(vertices: usize, is_adapted: bool) -> Row {
    let spacing = if is_adapted {
        "lfs".to_owned()
    } else {
        format!("uniform:{vertices}")
    };
    let mut row = measured(
        row("adapt", "l-shape", &spacing, 0.25, 0.75, "largest"),
        90.0,
        2 * vertices,
        1.0,
    );
    row.cell.poisson = Some("corner".into());
    row.cell.adapt = is_adapted.then_some(Adapt {
        eps: 1.0 / vertices as f64,
        rounds: 3,
        sample: false,
    });
    let count = vertices as f64;
    let report = row.report.as_mut().unwrap();
    report.statistics.vertices = vertices;
    report.poisson = Some(Solution {
        unknowns: vertices,
        energy_error: 0.1,
        energy_norm: 1.0,
        l2_error: 2.0
            * if is_adapted {
                10.0 / count
            } else {
                count.powf(-2.0 / 3.0)
            },
        l2_norm: 2.0,
        solver: Solver::Cholesky,
        iterations: 10,
        converged: true,
        spectrum: None,
    });
    report.rounds = vec![Round {
        vertices: vertices / 3,
        triangles: vertices / 2,
        l2_error: 0.25,
        energy_error: 0.5,
        settled: 0.125,
        least_change: 0.5,
        independent: 77,
        kept: 4,
    }];
    row
}

fn rows() -> Vec<Row> {
    let counts = [1_000, 8_000, 64_000];
    let both = |is_adapted: bool| counts.map(|count| mesh(count, is_adapted));
    let mut missing = mesh(125_000, false);
    missing.report = None;
    both(true).into_iter().chain(both(false)).chain([missing]).collect()
}

#[test]
fn slopes_are_those_of_the_powers() {
    let rows = rows();
    let [[adapted, uniform]] = &convergence(&rows.iter().collect::<Vec<_>>())[..] else {
        panic!("one problem on one domain");
    };
    assert!((adapted.slope().unwrap() + 1.0).abs() < 1e-9 && (uniform.slope().unwrap() + 2.0 / 3.0).abs() < 1e-9);
    assert_eq!(
        (adapted.name(), uniform.name()),
        ("adapted".into(), "uniform, 1 missing".into())
    );
    assert!((uniform.at(27_000.0).unwrap() - 1.0 / 900.0).abs() < 1e-9);
    let told = &adaptation::findings(&results(&rows))[0];
    // 64 000^(−2/3) = 1/1600 against 10 / 64 000.
    assert!(
        told.contains(
            "`corner on l-shape`, uniform meshes of 64000 vertices have 4.00 times the L2 error of adapted ones; slopes are -0.667 and -1.000."
        ),
        "{told}"
    );
}

#[test]
fn the_page_has_both_lines_and_the_rounds() {
    let page = adaptation::text(&results(&rows()));
    for part in [
        "### corner on l-shape",
        "| adapted | 3 | 1000 to 64000 |",
        "| uniform, 1 missing | 3 |",
        "| 1 | 21333 | 0.250 | 12.5 % | 77 | 4 |",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
}

#[test]
fn an_expected_slope_holds_or_breaks() {
    let judged = |least: f64, most: f64| {
        let expect = Expectations {
            adapted_slope: Some(SlopeRange { least, most }),
            ..Expectations::default()
        };
        findings(&Results {
            expect,
            ..results(&rows())
        })[0]
            .clone()
    };
    assert!(judged(-1.2, -0.9).holds && !judged(-0.99, -0.9).holds && !judged(-1.2, -1.01).holds);
    assert_eq!(judged(-1.2, -0.9).found, "-1.000");
}
