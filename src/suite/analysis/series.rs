//! Rows gathered by order of bites, and seconds gathered by step.

use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::summary::{by_spacing, measured, parameter};
use crate::suite::rows::numbers::{Line, first_seen, fit_line};
use crate::suite::rows::record::{Report, Row};

/// What one order gave on one family of spacings.
#[derive(Clone, Debug)]
pub struct OrderGroup<'a> {
    /// The order.
    pub order: &'a str,
    /// The spacing, or its family where domains have different ones.
    pub spacing: String,
    /// Cells asked for.
    pub asked: usize,
    /// The measured ones.
    pub reports: Vec<&'a Report>,
}

/// Gathers rows whose mesher has a parameter `order`, by spacing and order, as they first appear.
pub fn order_groups<'a>(rows: &[&'a Row]) -> Vec<OrderGroup<'a>> {
    let orders = first_seen(rows.iter().filter_map(|row| parameter(row, "order")));
    let mut groups = Vec::new();
    for (spacing, own) in by_spacing(rows) {
        for order in &orders {
            let asked: Vec<&Row> = own
                .iter()
                .copied()
                .filter(|row| parameter(row, "order") == Some(order))
                .collect();
            groups.push(OrderGroup {
                order,
                spacing: spacing.clone(),
                asked: asked.len(),
                reports: asked.into_iter().filter_map(measured).collect(),
            });
        }
    }
    groups
}

/// Seconds of one step, or of the whole, against triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeSeries {
    /// The step's name, `whole mesh` for all of it.
    pub name: String,
    /// (triangles, seconds) of runs whose times can be believed, in row order.
    pub points: Vec<(f64, f64)>,
}

impl TimeSeries {
    /// The whole runs of one method of a contest, the series named after it.
    pub fn of_method(contest: &Contest, method: usize) -> Self {
        let point = |report: &Report| Some((report.statistics.triangles as f64, report.believable_seconds()?));
        let measured: Vec<_> = contest.rows(method).filter_map(measured).filter_map(point).collect();
        let missing = contest.rows(method).count() - measured.len();
        let label = &contest.methods[method].label;
        Self {
            name: match missing {
                0 => label.clone(),
                _ => format!("{label}, {missing} missing"),
            },
            points: measured,
        }
    }

    /// The line through log₁₀ seconds against log₁₀ triangles.
    pub fn fit(&self) -> Option<Line> {
        let positive = self.points.iter().filter(|point| point.0 > 0.0 && point.1 > 0.0);
        fit_line(
            &positive
                .map(|point| (point.0.log10(), point.1.log10()))
                .collect::<Vec<_>>(),
        )
    }
}

/// The whole run and each of its steps, over the measured rows whose times can be believed.
pub fn time_series(rows: &[&Row]) -> Vec<TimeSeries> {
    let reports: Vec<&Report> = rows.iter().filter_map(|row| measured(row)).collect();
    let series = |name: &str, seconds: &dyn Fn(&Report) -> Option<f64>| TimeSeries {
        name: name.to_string(),
        points: reports
            .iter()
            .filter_map(|r| Some((r.statistics.triangles as f64, seconds(r)?)))
            .collect(),
    };
    let times = reports.iter().filter_map(|report| report.believable());
    let steps = first_seen(times.flat_map(|times| times.seconds.steps.keys().map(String::as_str)));
    let whole = series("whole mesh", &Report::believable_seconds);
    let parts = steps
        .into_iter()
        .map(|step| series(step, &|report| report.believable()?.seconds.steps.get(step)?.as_f64()));
    std::iter::once(whole)
        .chain(parts)
        .filter(|series| !series.points.is_empty())
        .collect()
}
