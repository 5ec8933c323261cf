//! How often each claim of the certificate held, and where one did not.

use super::angle::margin_of;
use super::markdown::{degrees, number, parameter, table};
use super::page::MOST_LINES;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{Setting, measured, setting};
use crate::suite::rows::numbers::first_seen;
use crate::suite::rows::record::{Report, Row};
use crate::theory::Claim;

/// What the unstated hypothesis of Theorem 6.8 does, over meshes of ours without angles under 90°, capped by lfs, with t ≤ 1/3
/// and c_b ≤ 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Hypothesis {
    /// Meshes with c_b + t ≤ 1, where circles of neighbouring input vertices cannot overlap, and how many break the bound.
    kept: [usize; 2],
    /// The others, and how many break the bound.
    broken: [usize; 2],
    /// Those of the others in which such circles meet low, and how many break the bound.
    low: [usize; 2],
    /// Smallest angle less its bound at its worst, in degrees.
    worst_margin: f64,
}

impl Hypothesis {
    fn of(results: &Results) -> Self {
        let mut found = Self::default();
        let ours = results.rows.iter().filter(|row| results.is_ours(row));
        for report in ours.filter_map(measured) {
            let is_meant = report.lfs_cap && report.t_effective <= 1.0 / 3.0 && report.c_b <= 1.0;
            let Some(check) = report.certificate.check(Claim::MinAngle) else {
                continue;
            };
            let setting = setting(report);
            if setting == Setting::Acute || !is_meant {
                continue;
            }
            let note = |[meshes, broken]: &mut [usize; 2]| {
                *meshes += 1;
                *broken += usize::from(!check.holds);
            };
            if report.c_b + report.t_effective <= 1.0 {
                note(&mut found.kept);
            } else {
                note(&mut found.broken);
                if setting == Setting::LowOverlap {
                    note(&mut found.low);
                }
            }
            found.worst_margin = found.worst_margin.min(margin_of(report).unwrap_or(0.0));
        }
        found
    }

    /// In a sentence, where the bound broke.
    fn finding(self) -> Option<String> {
        let ([kept, kept_broken], [meshes, broken]) = (self.kept, self.broken);
        (broken > 0).then(|| {
            format!(
                "Theorem 6.8 also needs c_b + t ≤ 1: without it {broken} of {meshes} meshes broke the bound, with it {kept_broken} of {kept}."
            )
        })
    }

    /// At length, where the bound broke.
    fn text(self) -> String {
        let [low, low_broken] = self.low;
        let Some(finding) = self.finding() else {
            return String::new();
        };
        format!(
            "### A hypothesis the paper does not state\n\n{finding}\n\nTheorem 6.8 rests on Lemma 6.4. That lemma bounds how high the \
             circles of neighbouring boundary vertices meet, but only where edge protection put one of the two. If the circles of \
             a segment's two input vertices already cover it between them, nothing bounds that height, and the front vertex above \
             them makes a flat triangle. With c_b + t ≤ 1 they cannot, since f ≤ lfs is at most half a segment's length in \
             its middle. Of {low} meshes where such circles meet lower than (9), {low_broken} broke the bound, at worst by {}. Counted \
             are meshes without angles under 90° between segments, capped by lfs, with t ≤ 1/3 and c_b ≤ 1.\n\n",
            degrees(-self.worst_margin)
        )
    }
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

/// How many certificates hold, and what the paper does not state.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let reports: Vec<&Report> = results.rows.iter().filter_map(measured).collect();
    let count = |wanted: fn(&Report) -> bool| reports.iter().filter(|report| wanted(report)).count();
    let whole = (!reports.is_empty()).then(|| {
        format!(
            "Every guaranteed check holds in {} of {} meshes; boundary pieces that are no Delaunay edges had to be forced in {}.",
            count(|report| report.certificate.holds),
            reports.len(),
            count(|report| report.forced_pieces > 0)
        )
    });
    Hypothesis::of(results).finding().into_iter().chain(whole).collect()
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
    let mut text = "In how many meshes each claim held: where it is guaranteed (its hypotheses hold), and \
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
            text += &format!("and {} more in `broken.csv`.\n\n", lines.len() - MOST_LINES);
        }
    }
    text + &Hypothesis::of(results).text()
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
