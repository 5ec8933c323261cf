//! What an experiment expected, held against what it left.

mod tally;

use crate::suite::analysis::convergence::{Convergence, convergence};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{self, Setting};
use crate::suite::rows::numbers::first_seen;
use crate::suite::rows::record::{Outcome, Row};
use crate::suite::run::plan::{Section, SlopeRange};
use serde::{Deserialize, Serialize};

/// An expectation and how it came out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// What was expected, in words.
    pub expected: String,
    /// What came out, in words, with the keys of the rows that broke it.
    pub found: String,
    /// Whether it held.
    pub holds: bool,
}

/// At most so many keys are named; the rows have them all.
const NAMED: usize = 5;

/// Holds every expectation of a plan against its rows, all of them finished.
pub fn findings(results: &Results) -> Vec<Finding> {
    let (expect, rows) = (&results.expect, &results.rows[..]);
    let mut findings = Vec::new();
    if expect.certificate_holds {
        findings.push(certificates(rows));
    }
    if let Some(largest_t) = &expect.certificate_whole_up_to_t {
        findings.push(whole_certificates(results, largest_t.get()));
        findings.push(low_overlaps(results));
    }
    if expect.measured_share > 0.0 {
        let measured = count_measured(rows);
        let share = measured as f64 / rows.len().max(1) as f64;
        findings.push(Finding {
            expected: format!(
                "at least {:.0} % of the cells are measured",
                100.0 * expect.measured_share
            ),
            found: format!("{measured} of {} ({:.1} %)", rows.len(), 100.0 * share),
            holds: share >= expect.measured_share,
        });
    }
    if let Some(most) = expect.unmeshed_share {
        findings.extend(unmeshed(rows, most));
    }
    if let Some(range) = expect.adapted_slope {
        findings.extend(adapted_slopes(results, range));
    }
    findings.extend(tally::findings(expect, &results.families));
    for (domain, &least) in &expect.measured_per_domain {
        let measured = count_measured(rows.iter().filter(|row| &row.cell.domain == domain));
        findings.push(Finding {
            expected: format!("at least {least} cells of {domain} are measured"),
            found: measured.to_string(),
            holds: measured >= least,
        });
    }
    findings
}

/// One finding for each mesher: how many of its cells that were tried have no mesh.
fn unmeshed(rows: &[Row], most: f64) -> Vec<Finding> {
    let meshers = first_seen(rows.iter().map(|row| row.cell.mesher.as_str()));
    let one = |mesher: &str| {
        let tried: Vec<&Row> = rows
            .iter()
            .filter(|row| row.cell.mesher == mesher && row.outcome != Outcome::Skipped)
            .collect();
        let without = tried.iter().filter(|row| row.outcome != Outcome::Measured);
        let keys: Vec<String> = without.map(|row| row.key.clone()).collect();
        Finding {
            expected: format!(
                "{mesher} declines or fails at most {:.0} % of the cells it is given",
                100.0 * most
            ),
            found: told(&keys, tried.len()),
            holds: keys.len() as f64 <= most * tried.len() as f64,
        }
    };
    meshers.into_iter().map(one).collect()
}

/// One finding for each problem: how fast the L2 error falls with the vertices of adapted meshes.
fn adapted_slopes(results: &Results, range: SlopeRange) -> Vec<Finding> {
    let SlopeRange { least, most } = range;
    let all = convergence(&results.of(Section::Adaptation));
    let one = |[line, _]: &[Convergence; 2]| Finding {
        expected: format!(
            "the L2 error of adapted meshes falls with a slope from {most} to {least} for {}",
            line.title
        ),
        found: line
            .slope()
            .map_or_else(|| "no slope".into(), |slope| format!("{slope:.3}")),
        holds: line.slope().is_some_and(|slope| (least..=most).contains(&slope)),
    };
    all.iter().map(one).collect()
}

/// Whether anything was measured at all.
pub fn anything_measured(rows: &[Row]) -> bool {
    count_measured(rows) > 0
}

fn count_measured<'a>(rows: impl IntoIterator<Item = &'a Row>) -> usize {
    rows.into_iter().filter(|row| row.outcome == Outcome::Measured).count()
}

fn certificates(rows: &[Row]) -> Finding {
    let broken: Vec<String> = rows
        .iter()
        .filter_map(|row| {
            let certificate = &summary::measured(row)?.certificate;
            let claims: Vec<&str> = certificate.broken().map(|check| check.claim.name()).collect();
            (!certificate.holds).then(|| format!("{} ({})", row.key, claims.join(", ")))
        })
        .collect();
    Finding {
        expected: "in every measured cell every check whose hypotheses hold, holds".into(),
        found: told(&broken, count_measured(rows)),
        holds: broken.is_empty(),
    }
}

/// The mesher in question in the paper's setting: no input angle under 90°, t small, and no circles of neighbouring input vertices that meet
/// low. There every check must hold, whether it is guaranteed or not.
fn whole_certificates(results: &Results, largest_t: f64) -> Finding {
    let inside: Vec<_> = results
        .rows
        .iter()
        .filter(|row| results.is_ours(row))
        .filter_map(|row| Some((row, summary::measured(row)?)))
        .filter(|(row, report)| {
            summary::setting(report) == Setting::Papers && row.cell.lfs_cap && report.t <= largest_t
        })
        .collect();
    let broken: Vec<String> = inside
        .iter()
        .filter_map(|(row, report)| {
            let claims = report.certificate.checks.iter().filter(|check| !check.holds);
            let claims: Vec<&str> = claims.map(|check| check.claim.name()).collect();
            (!claims.is_empty()).then(|| format!("{} ({})", row.key, claims.join(", ")))
        })
        .collect();
    Finding {
        expected: format!(
            "without input angles under 90° and with t ≤ {largest_t:.4} every check holds, unless circles of \
             neighbouring input vertices meet low"
        ),
        found: told(&broken, inside.len()),
        holds: broken.is_empty(),
    }
}

/// Circles of neighbouring input vertices cannot overlap where c_b + t ≤ 1 and f ≤ lfs.
fn low_overlaps(results: &Results) -> Finding {
    let low: Vec<_> = results
        .rows
        .iter()
        .filter(|row| results.is_ours(row))
        .filter_map(|row| Some((row, summary::measured(row)?)))
        .filter(|(row, report)| row.cell.lfs_cap && report.certificate.low_head_on > 0)
        .filter(|(_, report)| summary::setting(report) == Setting::LowOverlap)
        .collect();
    let broken: Vec<String> = low
        .iter()
        .filter(|(_, report)| report.c_b + report.t_effective <= 1.0)
        .map(|(row, _)| row.key.clone())
        .collect();
    Finding {
        expected: "circles of neighbouring input vertices meet low only where c_b + t > 1".into(),
        found: told(&broken, low.len()),
        holds: broken.is_empty(),
    }
}

fn told(broken: &[String], of: usize) -> String {
    if broken.is_empty() {
        return format!("so in all {of}");
    }
    let more = broken.len().saturating_sub(NAMED);
    let named = broken[..broken.len() - more].join("; ");
    let rest = if more > 0 {
        format!("; and {more} more")
    } else {
        String::new()
    };
    format!("broken in {} of {of}: {named}{rest}", broken.len())
}
