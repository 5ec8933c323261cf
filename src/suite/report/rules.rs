//! Who bites whom: the paper's rule beside that of the later point, at equal t and at equal guaranteed angle.
//!
//! With the rule of the later point the guaranteed angle is asin((1 − t) / 2), the paper's asin(1/2 − t) at half the t. So a
//! mesh by the paper's rule is set beside three by the other: of the same t and c_b; of twice the t at the same c_b, where f may
//! grow twice as fast; and of twice t and c_b, where f stays and circles are twice as large.

use super::drawer::Drawer;
use super::markdown::{degrees, number, parameter, table};
use crate::suite::analysis::measures::{MIN_ANGLE, Measure, SIZE_RATIO_LFS, TRIANGLES};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{measured, parameter as named};
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::{distinct, first_seen, median};
use crate::suite::rows::record::{Report, Row};
use crate::suite::run::plan::Section;
use crate::theory::{Promises, Rule};

/// How a mesh by the rule of the later point relates to one by the paper's.
struct Way {
    title: &'static str,
    t_times: f64,
    c_b_times: f64,
}

const WAYS: [Way; 3] = [
    Way {
        title: "same guaranteed angle and α",
        t_times: 2.0,
        c_b_times: 2.0,
    },
    Way {
        title: "same guaranteed angle and c_b",
        t_times: 2.0,
        c_b_times: 1.0,
    },
    Way {
        title: "same t and c_b",
        t_times: 1.0,
        c_b_times: 1.0,
    },
];

/// Meshes by either rule of the same domain, spacing and order.
struct Pairs<'a> {
    reports: Vec<[&'a Report; 2]>,
    asked: usize,
}

impl<'a> Pairs<'a> {
    /// Of those rows by the paper's rule that `wanted` admits, with those that stand in that way to them.
    fn of(rows: &[&'a Row], way: &Way, wanted: impl Fn(&Row) -> bool) -> Self {
        let mut pairs = Self {
            reports: Vec::new(),
            asked: 0,
        };
        for row in rows.iter().filter(|row| !is_later(row) && wanted(row)) {
            let other = rows.iter().find(|other| is_later(other) && is_partner(row, other, way));
            pairs.asked += usize::from(other.is_some());
            if let Some(two) = other.and_then(|other| Some([measured(row)?, measured(other)?])) {
                pairs.reports.push(two);
            }
        }
        pairs
    }

    /// Medians of a measure, by the paper's rule and by the other.
    fn medians(&self, by: &Measure) -> [Option<f64>; 2] {
        [0, 1].map(|k| median(self.reports.iter().filter_map(|two| (by.value)(two[k])).collect()))
    }

    fn least_angle(&self, k: usize) -> Option<f64> {
        let angles = self.reports.iter().filter_map(|two| (MIN_ANGLE.value)(two[k]));
        angles.reduce(f64::min)
    }

    /// The median over pairs of the other's triangles over the paper's.
    fn triangles(&self) -> Option<f64> {
        let ratio = |two: &[&Report; 2]| Some((TRIANGLES.value)(two[1])? / (TRIANGLES.value)(two[0])?);
        median(self.reports.iter().filter_map(ratio).collect())
    }
}

fn is_later(row: &Row) -> bool {
    named(row, "rule") == Some("later")
}

fn is_partner(row: &Row, other: &Row, way: &Way) -> bool {
    let (own, its) = (&row.cell, &other.cell);
    let task = |row: &Row| {
        (
            row.cell.domain.clone(),
            row.cell.spacing.clone(),
            row.cell.seed,
            row.cell.lfs_cap,
        )
    };
    let near = |value: f64, expected: f64| (value - expected).abs() <= 1e-9 * expected;
    task(row) == task(other)
        && named(row, "order") == named(other, "order")
        && near(its.t, way.t_times * own.t)
        && near(its.c_b, way.c_b_times * own.c_b)
}

/// A sentence for each way: the median ratio of triangles over all pairs that were asked for in it.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let rows = results.of(Section::Rules);
    let of = |way: &Way| {
        let pairs = Pairs::of(&rows, way, |_| true);
        Some(format!(
            "At the {}, the rule of the later point needs {} times the triangles of the paper's.",
            way.title,
            number(pairs.triangles()?)
        ))
    };
    WAYS.iter().filter_map(of).collect()
}

/// All ways over all pairs; then a table for each way, with a line for each order, t and c_b by the paper's rule.
pub(super) fn text(results: &Results) -> String {
    let rows = results.of(Section::Rules);
    let papers: Vec<&Row> = rows.iter().copied().filter(|row| !is_later(row)).collect();
    let orders = first_seen(papers.iter().filter_map(|row| named(row, "order")));
    let (ts, c_bs) = (
        distinct(papers.iter().map(|row| row.cell.t)),
        distinct(papers.iter().map(|row| row.cell.c_b)),
    );
    let (mut text, mut whole) = (String::new(), Vec::new());
    for way in &WAYS {
        let mut lines = Vec::new();
        for order in &orders {
            for (t, c_b) in ts.iter().flat_map(|t| c_bs.iter().map(move |c_b| (*t, *c_b))) {
                let wanted = |row: &Row| named(row, "order") == Some(order) && row.cell.t == t && row.cell.c_b == c_b;
                let pairs = Pairs::of(&rows, way, wanted);
                if pairs.asked > 0 {
                    lines.push(line(&pairs, way, order, t, c_b));
                }
            }
        }
        if !lines.is_empty() {
            let all = Pairs::of(&rows, way, |_| true);
            whole.push([vec![way.title.to_owned()], numbers(&all)].concat());
            text += &format!("### At the {}\n\n{}", way.title, table(&HEAD, &lines));
        }
    }
    if whole.is_empty() {
        return text;
    }
    let head = [&["at the"], &HEAD[3..4], &HEAD[6..]].concat();
    PRIOR.to_owned()
        + "Over all orders, t and c_b; ratios are medians over the pairs.\n\n"
        + &table(&head, &whole)
        + &text
}

/// Whose rules and bounds these are.
const PRIOR: &str = "The two rules are known for random samplings: S. A. Mitchell, A. Rand, M. S. Ebeida, C. Bajaj, \"Variable \
    radii Poisson-disk sampling\", CCCG 2012, call the paper's prior-disks and that of the later point current-disks, and have both \
    angle bounds for domains without a boundary. New here are the boundary, the front, the constants and the hypotheses; the \
    proof is in `src/meshers/biting/beyond/rule.rs`.\n\n";

/// The last columns are those of [`numbers`], but for the two bounds.
const HEAD: [&str; 13] = [
    "order",
    "t",
    "c_b",
    "pairs measured",
    "bound, paper",
    "bound, later",
    "smallest angle, paper",
    "worst",
    "later",
    "worst",
    "triangles/∫dA/lfs², paper",
    "later",
    "triangles, later over paper",
];

fn line(pairs: &Pairs, way: &Way, order: &str, t: f64, c_b: f64) -> Vec<String> {
    let both = |one: f64, times: f64| match times {
        1.0 => parameter(one),
        _ => format!("{} : {}", parameter(one), parameter(times * one)),
    };
    let bound = |rule, t| degrees(Promises { rule, t }.min_angle_deg());
    let mut line = vec![order.to_string(), both(t, way.t_times), both(c_b, way.c_b_times)];
    let mut numbers = numbers(pairs).into_iter();
    line.extend(numbers.next());
    line.extend([bound(Rule::Earlier, t), bound(Rule::Later, way.t_times * t)]);
    line.extend(numbers);
    line
}

/// What some pairs say.
fn numbers(pairs: &Pairs) -> Vec<String> {
    let angles = pairs.medians(&MIN_ANGLE);
    let sizes = pairs.medians(&SIZE_RATIO_LFS);
    vec![
        format!("{} of {}", pairs.reports.len(), pairs.asked),
        degrees(angles[0]),
        degrees(pairs.least_angle(0)),
        degrees(angles[1]),
        degrees(pairs.least_angle(1)),
        number(sizes[0]),
        number(sizes[1]),
        number(pairs.triangles()),
    ]
}

/// Smallest angles by either rule against t.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let rows = results.of(Section::Rules);
    if rows.is_empty() {
        return Ok(());
    }
    let caption = "Smallest angles by either rule of who bites whom, against t, with the bound of each.";
    charts::rules(&rows, &drawer.chart("rules", caption))
}
