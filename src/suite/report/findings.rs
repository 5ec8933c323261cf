//! What the rows answer, as numbers; the page only sets them in words.

use super::markdown::{degrees, number, parameter};
use crate::suite::analysis::series::{OrderGroup, TimeSeries, order_groups, time_series};
use crate::suite::analysis::summary::{Grid, Pair, Setting, by_spacing, is_ours, measured, setting};
use crate::suite::rows::numbers::{first_seen, median, quantile};
use crate::suite::rows::record::{Outcome, Report, Row};
use crate::theory::Claim;

/// How cells ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    pub(super) cells: usize,
    pub(super) measured: usize,
    pub(super) skipped: usize,
    pub(super) declined: usize,
    pub(super) failed: usize,
}

/// Counts outcomes.
pub(super) fn tally<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Tally {
    let mut tally = Tally::default();
    for row in rows {
        tally.cells += 1;
        match row.outcome {
            Outcome::Measured => tally.measured += 1,
            Outcome::Skipped => tally.skipped += 1,
            Outcome::Declined => tally.declined += 1,
            Outcome::Failed => tally.failed += 1,
        }
    }
    tally
}

/// Least and median of some numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spread {
    pub(super) count: usize,
    pub(super) least: f64,
    pub(super) median: f64,
    pub(super) most: f64,
}

/// Least, median and most of `values`; absent for none.
pub(super) fn spread(values: Vec<f64>) -> Option<Spread> {
    Some(Spread {
        count: values.len(),
        least: quantile(values.clone(), 0.0)?,
        most: quantile(values.clone(), 1.0)?,
        median: median(values)?,
    })
}

/// How far measured smallest angles lie above asin(1/2 − t_effective), in degrees, at one nominal t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Margin {
    pub(super) t: f64,
    /// Where the hypotheses hold.
    pub(super) papers: Option<Spread>,
    /// Where circles of neighbouring input vertices meet low.
    pub(super) low: Option<Spread>,
    /// Where segments meet at angles under 90°.
    pub(super) acute: Option<Spread>,
}

/// Smallest angle less its bound.
fn margin_of(report: &Report) -> Option<f64> {
    Some(report.statistics.min_angle_free_deg? - report.min_angle_bound_deg)
}

/// Margins over all measured cells of that setting.
pub(super) fn margin(grid: &Grid, of: Setting, t: Option<f64>) -> Option<Spread> {
    let wanted = |(row, report): &(&Row, &Report)| setting(report) == of && t.is_none_or(|t| row.cell.t == t);
    spread(
        grid.reports()
            .filter(wanted)
            .filter_map(|(_, report)| margin_of(report))
            .collect(),
    )
}

/// One [`Margin`] for each t of the grid.
pub(super) fn margins(grid: &Grid) -> Vec<Margin> {
    let at = |t: &f64| Margin {
        t: *t,
        papers: margin(grid, Setting::Papers, Some(*t)),
        low: margin(grid, Setting::LowOverlap, Some(*t)),
        acute: margin(grid, Setting::Acute, Some(*t)),
    };
    grid.ts.iter().map(at).collect()
}

/// What the unstated hypothesis of Theorem 6.8 does, over meshes without angles under 90°, capped by lfs, t ≤ 1/3.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LowOverlaps {
    /// Meshes with c_b + t ≤ 1, where circles of neighbouring input vertices cannot overlap.
    pub(super) apart: usize,
    /// Of these, how many break the bound.
    pub(super) apart_broken: usize,
    /// Meshes in which such circles meet low.
    pub(super) low: usize,
    /// Of these, how many break the bound.
    pub(super) low_broken: usize,
    /// The remaining meshes that break the bound.
    pub(super) unexplained: usize,
    /// Smallest angle less its bound where circles meet low, at its worst, in degrees.
    pub(super) worst_margin: f64,
}

/// Counts them.
pub(super) fn low_overlaps(rows: &[Row]) -> LowOverlaps {
    let mut found = LowOverlaps::default();
    for report in rows.iter().filter(|row| is_ours(row)).filter_map(measured) {
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

/// The pair with the fewest triangles among those whose smallest angle is at least `angle_deg`.
pub(super) fn fewest(pairs: &[Pair], angle_deg: f64) -> Option<Pair> {
    let enough = pairs.iter().filter(|pair| pair.smallest_angle_deg >= angle_deg);
    enough
        .min_by(|a, b| a.size_ratio_lfs.total_cmp(&b.size_ratio_lfs))
        .copied()
}

/// Medians of one order on one spacing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct OrderFinding {
    pub(super) order: String,
    pub(super) spacing: String,
    pub(super) asked: usize,
    pub(super) measured: usize,
    pub(super) smallest_deg: Option<f64>,
    pub(super) mean_deg: Option<f64>,
    pub(super) efficiency: Option<f64>,
    pub(super) seconds_per_triangle: Option<f64>,
    /// Domains on which its mean smallest angle is the largest of all orders.
    pub(super) best_mean_on: Vec<String>,
    /// Domains on which its smallest angle is the largest of all orders.
    pub(super) best_smallest_on: Vec<String>,
}

/// Medians over domains for each spacing and order.
pub(super) fn order_findings(rows: &[&Row]) -> Vec<OrderFinding> {
    let groups = order_groups(rows);
    let middle = |group: &OrderGroup, value: fn(&Report) -> Option<f64>| {
        median(group.reports.iter().filter_map(|report| value(report)).collect())
    };
    let finding = |group: &OrderGroup| OrderFinding {
        order: group.order.to_string(),
        spacing: group.spacing.clone(),
        asked: group.asked,
        measured: group.reports.len(),
        smallest_deg: middle(group, |report| report.statistics.min_angle_free_deg),
        mean_deg: middle(group, |report| Some(report.statistics.mean_min_angle_deg)),
        efficiency: middle(group, |report| Some(report.size_efficiency)),
        seconds_per_triangle: middle(group, |report| {
            Some(report.seconds.total / report.statistics.triangles as f64).filter(|seconds| seconds.is_finite())
        }),
        best_mean_on: best_on(&groups, group, |report| Some(report.statistics.mean_min_angle_deg)),
        best_smallest_on: best_on(&groups, group, |report| report.statistics.min_angle_free_deg),
    };
    groups.iter().map(finding).collect()
}

/// The domains on which no order of the same spacing has a larger median `value` than `group`.
fn best_on(groups: &[OrderGroup], group: &OrderGroup, value: fn(&Report) -> Option<f64>) -> Vec<String> {
    let of = |group: &OrderGroup, domain: &str| {
        let own = group.reports.iter().filter(|report| report.domain == domain);
        median(own.filter_map(|report| value(report)).collect())
    };
    let rivals = || groups.iter().filter(|other| other.spacing == group.spacing);
    let wins = |domain: &&str| {
        let best = rivals()
            .filter_map(|other| of(other, domain))
            .fold(f64::NEG_INFINITY, f64::max);
        of(group, domain).is_some_and(|own| own >= best)
    };
    let domains = first_seen(group.reports.iter().map(|report| report.domain.as_str()));
    domains.into_iter().filter(wins).map(str::to_string).collect()
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
pub(super) fn claims(rows: &[Row]) -> Vec<ClaimTally> {
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

/// The rows of one group of the plan that the paper's own method made.
pub(crate) fn ours<'a>(rows: &'a [Row], group: &str) -> Vec<&'a Row> {
    let mut own = of_group(rows, group);
    own.retain(|row| is_ours(row));
    own
}

/// The grid rows of the paper's own method by spacing.
pub(crate) fn grids(rows: &[Row]) -> Vec<(String, Grid<'_>)> {
    let split = by_spacing(&ours(rows, "grid"));
    split.into_iter().map(|(title, rows)| (title, Grid::of(rows))).collect()
}

/// The rows of one group of the plan.
pub(super) fn of_group<'a>(rows: &'a [Row], group: &str) -> Vec<&'a Row> {
    rows.iter().filter(|row| row.group == group).collect()
}

/// How the time of one step grows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Slope {
    pub(super) name: String,
    /// Of log seconds against log triangles.
    pub(super) slope: Option<f64>,
    /// Median over cells.
    pub(super) seconds_per_triangle: Option<f64>,
    /// Fewest and most triangles.
    pub(super) triangles: (f64, f64),
}

/// The whole mesh first, then its steps.
pub(super) fn slopes(rows: &[Row]) -> Vec<Slope> {
    let series = time_series(&ours(rows, "time"));
    let one = |series: TimeSeries| {
        let triangles: Vec<f64> = series.points.iter().map(|point| point.0).collect();
        let end = |q| quantile(triangles.clone(), q).unwrap_or(0.0);
        Slope {
            slope: series.fit().map(|line| line.slope),
            seconds_per_triangle: median(series.points.iter().map(|point| point.1 / point.0).collect()),
            triangles: (end(0.0), end(1.0)),
            name: series.name,
        }
    };
    series.into_iter().map(one).collect()
}

/// Checks that did not hold, as lines of a table: the guaranteed ones of all methods, or those only measured, of the
/// paper's own.
pub(super) fn broken_checks(rows: &[Row], applies: bool) -> Vec<Vec<String>> {
    let mut lines = Vec::new();
    for report in rows.iter().filter(|row| applies || is_ours(row)).filter_map(measured) {
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
