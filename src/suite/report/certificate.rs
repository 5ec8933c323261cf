//! How often each claim of the certificate held, and where one did not.

use super::angle::margin_of;
use super::markdown::{degrees, number, parameter, table};
use super::page::MOST_LINES;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{Setting, measured, setting};
use crate::suite::rows::numbers::first_seen;
use crate::suite::rows::record::{Report, Row};
use crate::theory::Claim;

/// What the unstated hypothesis of Theorem 6.8 does, over meshes without angles under 90°, capped by lfs, t ≤ 1/3.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct LowOverlaps {
    /// Meshes with c_b + t ≤ 1, where circles of neighbouring input vertices cannot overlap.
    apart: usize,
    /// Of these, how many break the bound.
    apart_broken: usize,
    /// Meshes in which such circles meet low.
    low: usize,
    /// Of these, how many break the bound.
    low_broken: usize,
    /// The remaining meshes that break the bound.
    unexplained: usize,
    /// Smallest angle less its bound where circles meet low, at its worst, in degrees.
    worst_margin: f64,
}

/// Counts them.
fn low_overlaps(results: &Results) -> LowOverlaps {
    let mut found = LowOverlaps::default();
    for report in results
        .rows
        .iter()
        .filter(|row| results.is_ours(row))
        .filter_map(measured)
    {
        if setting(report) == Setting::Acute || !report.lfs_cap || report.t_effective > 1.0 / 3.0 {
            continue;
        }
        let Some(check) = report.certificate.check(Claim::MinAngle) else {
            continue;
        };
        let is_broken = usize::from(!check.holds);
        if setting(report) == Setting::LowOverlap {
            found.low += 1;
            found.low_broken += is_broken;
            found.worst_margin = found.worst_margin.min(margin_of(report).unwrap_or(0.0));
        } else {
            found.unexplained += is_broken;
        }
        if report.c_b + report.t_effective <= 1.0 {
            found.apart += 1;
            found.apart_broken += is_broken;
        }
    }
    found
}

/// What the sweep shows of a hypothesis that the paper uses without saying so.
fn hypothesis_finding(results: &Results) -> Option<String> {
    let found = low_overlaps(results);
    (found.low_broken > 0).then(|| {
        format!(
            "**A hypothesis the paper does not state.** Theorem 6.8 rests on Lemma 6.4, which bounds how high the circles \
             of neighbouring boundary vertices meet only where edge protection put one of the two. Where the circles of a \
             segment's two input vertices already cover it between them, nothing bounds it, and the front vertex above \
             them makes a flat triangle. Without angles under 90° and with t ≤ 1/3 that broke the bound in {} of the {} \
             meshes where such circles meet lower than (9), by up to {}, and nothing else broke it ({} other meshes). With \
             c_b + t ≤ 1 it cannot happen, since f ≤ lfs is at most half a segment's length in its middle: {} of {} such \
             meshes broke the bound. So Theorem 6.8 needs c_b + t ≤ 1.",
            found.low_broken,
            found.low,
            degrees(-found.worst_margin),
            found.unexplained,
            found.apart_broken,
            found.apart
        )
    })
}

/// How often one claim of the certificate held.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ClaimTally {
    pub(super) mesher: String,
    pub(super) claim: Claim,
    pub(super) lemma: String,
    /// Cells in which it is guaranteed, and in how many of these it held.
    pub(super) guaranteed: (usize, usize),
    /// Cells in which it is only measured, and in how many of these it held.
    pub(super) measured: (usize, usize),
}

/// One tally for each mesher and claim, the claims in the certificates' order.
pub(super) fn claim_tallies(rows: &[Row]) -> Vec<ClaimTally> {
    let mut tallies: Vec<ClaimTally> = Vec::new();
    let reports = rows.iter().filter_map(measured);
    for (report, check) in reports.flat_map(|report| report.certificate.checks.iter().map(move |check| (report, check)))
    {
        let is_same = |tally: &ClaimTally| tally.claim == check.claim && tally.mesher == report.mesher;
        let known = tallies.iter().position(is_same);
        let place = known.unwrap_or_else(|| {
            tallies.push(ClaimTally {
                mesher: report.mesher.clone(),
                claim: check.claim,
                lemma: check.lemma.clone(),
                guaranteed: (0, 0),
                measured: (0, 0),
            });
            tallies.len() - 1
        });
        let tally = &mut tallies[place];
        let counts = if check.applies {
            &mut tally.guaranteed
        } else {
            &mut tally.measured
        };
        counts.0 += 1;
        counts.1 += usize::from(check.holds);
    }
    tallies
}

/// How many certificates hold.
pub(super) fn findings(results: &Results) -> Vec<String> {
    hypothesis_finding(results)
        .into_iter()
        .chain(finding(results))
        .collect()
}

fn finding(results: &Results) -> Option<String> {
    let reports: Vec<&Report> = results.rows.iter().filter_map(measured).collect();
    let holding = reports.iter().filter(|report| report.certificate.holds).count();
    let forced = reports.iter().filter(|report| report.forced_pieces > 0).count();
    (!reports.is_empty()).then(|| {
        format!(
            "**Certificate.** Every guaranteed check holds in {holding} of {} meshes. Boundary pieces that are no \
             Delaunay edges had to be forced in {forced}.",
            reports.len()
        )
    })
}

/// How often each claim held, and every cell in which one did not.
pub(super) fn text(results: &Results) -> String {
    let tallies = claim_tallies(&results.rows);
    if tallies.is_empty() {
        return String::new();
    }
    let of = |(count, held): (usize, usize)| {
        if count == 0 {
            "–".into()
        } else {
            format!("{held} of {count}")
        }
    };
    let meshers = first_seen(tallies.iter().map(|tally| tally.mesher.as_str()));
    let claims = first_seen(tallies.iter().map(|tally| tally.claim.name()));
    let mut head = vec!["claim".to_string(), "paper".to_string()];
    for mesher in &meshers {
        head.extend([format!("{mesher}: held where guaranteed"), "held elsewhere".to_string()]);
    }
    let line = |claim: &str| {
        let own = |mesher: &str| {
            tallies
                .iter()
                .find(|tally| tally.claim.name() == claim && tally.mesher == mesher)
        };
        let lemma = meshers
            .iter()
            .find_map(|mesher| own(mesher))
            .map(|tally| tally.lemma.clone());
        let mut cells = vec![claim.to_string(), lemma.unwrap_or_default()];
        for mesher in &meshers {
            let (guaranteed, measured) =
                own(mesher).map_or(((0, 0), (0, 0)), |tally| (tally.guaranteed, tally.measured));
            cells.extend([of(guaranteed), of(measured)]);
        }
        cells
    };
    let lines: Vec<_> = claims.into_iter().map(line).collect();
    let mut text =
        "## Certificate\n\nIn how many meshes each claim held: where it is guaranteed (its hypotheses hold), and \
         where it is only measured.\n\n"
            .to_string();
    text += &table(&head.iter().map(String::as_str).collect::<Vec<_>>(), &lines);
    for (applies, title) in [
        (true, "Guaranteed checks that failed"),
        (false, "Bounds that ours broke where a hypothesis fails"),
    ] {
        let lines = broken_checks(results, applies);
        text += &format!("### {title}: {}\n\n", lines.len());
        let head = [
            "mesher",
            "domain",
            "spacing",
            "t",
            "effective t",
            "c_b",
            "claim",
            "worst",
            "bound",
            "broken",
            "at",
            "input angle",
            "segment angle",
            "circles meet low",
            "forced pieces",
        ];
        if !lines.is_empty() {
            text += &table(&head, &lines[..lines.len().min(MOST_LINES)]);
        }
        if lines.len() > MOST_LINES {
            text += &format!("and {} more in `rows.jsonl`.\n\n", lines.len() - MOST_LINES);
        }
    }
    text
}

/// Checks that did not hold, as lines of a table: the guaranteed ones of all methods, or those only measured, of the
/// mesher in question.
pub(super) fn broken_checks(results: &Results, applies: bool) -> Vec<Vec<String>> {
    let mut lines = Vec::new();
    for report in results
        .rows
        .iter()
        .filter(|row| applies || results.is_ours(row))
        .filter_map(measured)
    {
        for check in report
            .certificate
            .checks
            .iter()
            .filter(|check| check.applies == applies && !check.holds)
        {
            let at = check.at.map(|[x, y]| format!("({}, {})", number(x), number(y)));
            lines.push(vec![
                report.mesher.clone(),
                report.domain.clone(),
                report.spacing.clone(),
                parameter(report.t),
                parameter(report.t_effective),
                parameter(report.c_b),
                check.claim.to_string(),
                number(check.worst),
                number(check.bound),
                check.broken.to_string(),
                at.unwrap_or_else(|| "–".into()),
                degrees(report.smallest_input_angle_deg),
                degrees(report.smallest_segment_angle_deg),
                report.certificate.low_head_on.to_string(),
                report.forced_pieces.to_string(),
            ]);
        }
    }
    lines
}
