//! Orders of bites side by side.

use super::drawer::Drawer;
use super::markdown::{number, table, told, value};
use crate::suite::analysis::measures::{MEAN_ANGLE, MIN_ANGLE, Measure, SIZE_EFFICIENCY, TIME};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::series::{OrderGroup, order_groups};
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::{first_seen, median};
use crate::suite::run::plan::Section;

/// What orders are compared by.
const MEASURES: [Measure; 4] = [MIN_ANGLE, MEAN_ANGLE, SIZE_EFFICIENCY, TIME];

/// The median of a group by a measure.
fn middle(group: &OrderGroup, by: &Measure) -> Option<f64> {
    median(group.reports.iter().filter_map(|report| (by.value)(report)).collect())
}

/// The domains on which no order of the same spacing has a better median than `group`.
pub(super) fn best_on<'a>(groups: &[OrderGroup<'a>], group: &OrderGroup<'a>, by: &Measure) -> Vec<&'a str> {
    let of = |group: &OrderGroup, domain: &str| {
        let own = group.reports.iter().filter(|report| report.domain == domain);
        median(own.filter_map(|report| (by.value)(report)).collect())
    };
    let alike = || groups.iter().filter(|other| other.spacing == group.spacing);
    let wins = |domain: &&str| {
        of(group, domain).is_some_and(|own| {
            let mut others = alike().filter_map(|other| of(other, domain));
            others.all(|other| by.gain(own, other) >= 0.0)
        })
    };
    let domains = first_seen(group.reports.iter().map(|report| report.domain.as_str()));
    domains.into_iter().filter(wins).collect()
}

/// For each spacing the order with the largest median of the mean smallest angle, and what it costs.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let rows = results.ours(Section::Orders);
    let groups = order_groups(&rows);
    let spacings = first_seen(groups.iter().map(|group| group.spacing.as_str()));
    spacings
        .into_iter()
        .filter_map(|spacing| best_order(&groups, spacing))
        .collect()
}

fn best_order(groups: &[OrderGroup], spacing: &str) -> Option<String> {
    let own = || groups.iter().filter(|group| group.spacing == spacing);
    let with = |by: Measure| own().filter_map(move |group| Some((group, middle(group, &by)?)));
    let (best, mean) = with(MEAN_ANGLE).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let fastest = with(TIME).map(|(_, time)| time).reduce(f64::min);
    let cost = fastest.zip(middle(best, &TIME)).map(|(fastest, own)| {
        let times = number(own / fastest);
        format!(", at {times} times the time of the fastest order")
    });
    Some(format!(
        "With `{spacing}`, order `{}` has the largest mean smallest angle, {} in the median over domains{}.",
        best.order,
        told(&MEAN_ANGLE, mean),
        cost.unwrap_or_default()
    ))
}

/// Medians of each order and spacing, and where the order is best.
pub(super) fn text(results: &Results) -> String {
    let rows = results.ours(Section::Orders);
    let groups = order_groups(&rows);
    if groups.is_empty() {
        return String::new();
    }
    let labels = MEASURES.map(|measure| measure.label());
    let mut head = vec!["spacing", "order", "measured"];
    head.extend(labels.iter().map(String::as_str));
    head.extend(["best mean on", "best smallest on"]);
    let line = |group: &OrderGroup| {
        let mut line = vec![
            group.spacing.clone(),
            group.order.to_owned(),
            format!("{} of {}", group.reports.len(), group.asked),
        ];
        line.extend(MEASURES.iter().map(|by| value(by, middle(group, by))));
        line.extend([MEAN_ANGLE, MIN_ANGLE].map(|by| best_on(&groups, group, &by).join(", ")));
        line
    };
    "Medians over domains, at one t and c_b, times from cells that ran alone, with repeats that spread by less than 0.1 of their \
     median; the last columns name the domains on which no other order does better.\n\n"
        .to_owned()
        + &table(&head, &groups.iter().map(line).collect::<Vec<_>>())
}

/// Medians of each order, and how triangles spread over angles.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let rows = results.ours(Section::Orders);
    let groups = order_groups(&rows);
    if groups.iter().all(|group| group.reports.is_empty()) {
        return Ok(());
    }
    let caption = "Orders of bites: median over domains, and the range from the least to the most.";
    charts::orders(&groups, &MEASURES, &drawer.chart("orders", caption))?;
    let caption = "How triangles spread over smallest angles, for each order of bites; mean over meshes.";
    charts::angles_by_order(&groups, &drawer.chart("angles-by-order", caption))
}
