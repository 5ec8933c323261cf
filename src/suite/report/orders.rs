//! Orders of bites side by side.

use super::drawer::Drawer;
use super::markdown::{degrees, number, table};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::series::{OrderGroup, order_groups};
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::{first_seen, median};
use crate::suite::rows::record::{Report, Row};
use crate::suite::run::plan::Section;

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

/// The order with the largest median of the mean smallest angle on each spacing, and what it costs.
pub(super) fn findings(results: &Results) -> Vec<String> {
    finding(results).into_iter().collect()
}

fn finding(results: &Results) -> Option<String> {
    let findings = order_findings(&results.ours(Section::Orders));
    let spacings = first_seen(findings.iter().map(|finding| finding.spacing.as_str()));
    let told: Vec<String> = spacings
        .into_iter()
        .filter_map(|spacing| best_order(&findings, spacing))
        .collect();
    (!told.is_empty()).then(|| format!("**Best order of bites**, by medians over domains: {}.", told.join("; ")))
}

fn best_order(findings: &[OrderFinding], spacing: &str) -> Option<String> {
    let own = || findings.iter().filter(|finding| finding.spacing == spacing);
    let top = |value: fn(&OrderFinding) -> Option<f64>| {
        own().filter(|finding| value(finding).is_some()).max_by(|a, b| {
            value(a)
                .unwrap_or(f64::NEG_INFINITY)
                .total_cmp(&value(b).unwrap_or(f64::NEG_INFINITY))
        })
    };
    let (mean, smallest) = (top(|finding| finding.mean_deg)?, top(|finding| finding.smallest_deg)?);
    let fewest = top(|finding| finding.efficiency.map(|efficiency| -efficiency))?;
    let fastest = own()
        .filter_map(|finding| finding.seconds_per_triangle)
        .fold(f64::INFINITY, f64::min);
    let cost = |finding: &OrderFinding| number(finding.seconds_per_triangle.map(|seconds| seconds / fastest));
    Some(format!(
        "with `{spacing}` `{}` has the largest mean smallest angle ({}, at {} times the time of the fastest order), `{}` \
         the largest smallest angle ({}, at {} times), `{}` the fewest triangles (size efficiency {}, smallest angle {}, \
         mean {})",
        mean.order,
        degrees(mean.mean_deg),
        cost(mean),
        smallest.order,
        degrees(smallest.smallest_deg),
        cost(smallest),
        fewest.order,
        number(fewest.efficiency),
        degrees(fewest.smallest_deg),
        degrees(fewest.mean_deg)
    ))
}

/// Medians of each order and spacing, and where the order is best.
pub(super) fn text(results: &Results) -> String {
    let findings = order_findings(&results.ours(Section::Orders));
    if findings.is_empty() {
        return String::new();
    }
    let head = [
        "spacing",
        "order",
        "measured",
        "smallest angle",
        "mean smallest angle",
        "size efficiency",
        "µs per triangle",
        "best mean on",
        "best smallest on",
    ];
    let line = |finding: &OrderFinding| {
        vec![
            finding.spacing.clone(),
            finding.order.clone(),
            format!("{} of {}", finding.measured, finding.asked),
            degrees(finding.smallest_deg),
            degrees(finding.mean_deg),
            number(finding.efficiency),
            number(finding.seconds_per_triangle.map(|seconds| 1e6 * seconds)),
            finding.best_mean_on.join(", "),
            finding.best_smallest_on.join(", "),
        ]
    };
    let alone = results.ours(Section::Orders).iter().all(|row| row.cell.timed);
    let caution = if alone {
        ""
    } else {
        " Cells ran beside one another, so their times are rough."
    };
    format!(
        "Medians over domains, at one t and c_b; the last columns name the domains on which no other order does \
         better.{caution}\n\n"
    ) + &table(&head, &findings.iter().map(line).collect::<Vec<_>>())
}

/// Medians of each order, and how triangles spread over angles.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let rows = results.ours(Section::Orders);
    let groups = order_groups(&rows);
    if groups.iter().all(|group| group.reports.is_empty()) {
        return Ok(());
    }
    let caption = "Orders of bites: median over domains, and the range from the least to the most.";
    charts::orders(&groups, &drawer.chart("orders", caption))?;
    let caption = "How triangles spread over smallest angles, for each order of bites; mean over meshes.";
    charts::angles_by_order(&groups, &drawer.chart("angles-by-order", caption))
}
