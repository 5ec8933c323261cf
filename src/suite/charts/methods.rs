//! Meshers side by side, each in its colour and with its marker.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::dots::{Column, Dot, Dots, apart};
use super::legend::{Entry, Key, legend_row};
use super::panel::{Axis, Panel, span};
use super::style::{self, Marker};
use crate::suite::analysis::contest::{Contest, Method};
use crate::suite::analysis::measures::{BETA, MEAN_ANGLE, MIN_ANGLE, Measure, SIZE_EFFICIENCY, TIME};
use crate::suite::rows::numbers::distinct;
use crate::suite::rows::record::{Outcome, Report, Row};
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// How a row without a report ended, in a word.
fn ending(row: Option<&Row>) -> &'static str {
    match row.map(|row| row.outcome) {
        None => "not asked",
        Some(Outcome::Measured) => "no value",
        Some(Outcome::Skipped) => "skipped",
        Some(Outcome::Declined) => "declined",
        Some(Outcome::Failed) => "failed",
    }
}

/// The names of methods, of variants what makes them differ; where some tasks were not measured, with how many were.
fn names(contest: &Contest) -> Vec<String> {
    let leads = contest.leads();
    let name = |k: usize| {
        let Method { label, mesher, .. } = &contest.methods[k];
        let differing = label.strip_prefix(mesher.as_str()).map(str::trim_start);
        let label = differing.filter(|_| !leads.contains(&k)).unwrap_or(label).to_string();
        let asked = contest.rows(k).count();
        let done = contest.count(k, Outcome::Measured);
        if done == asked {
            label
        } else {
            format!("{label} ({done} of {asked})")
        }
    };
    contest.all().into_iter().map(name).collect()
}

/// Legend of the methods.
fn entries(contest: &Contest, methods: &[usize], key: fn(Marker) -> Key) -> Vec<Entry> {
    let own = methods.iter().map(|k| &contest.methods[*k]);
    own.map(|method| (key(style::method(method)), method.label.clone()))
        .collect()
}

/// Draws, for each method, the median over the tasks that all measured, with the range from smallest to largest: smallest
/// and mean angle, size efficiency, β, time. The name says where a method has not measured all its tasks.
///
/// # Errors
/// [`ChartError`].
pub fn methods(contest: &Contest, stem: &Path) -> Result<(), ChartError> {
    let common = contest.common(&contest.all());
    let column = |measure: Measure| Column {
        label: measure.short_label(),
        is_log: measure == TIME,
        dots: contest
            .all()
            .into_iter()
            .map(|k| Dot {
                line: k,
                shift: 0.0,
                values: contest.values(k, &common, measure.value),
                marker: style::method(&contest.methods[k]),
                missing: "none",
            })
            .collect(),
    };
    let figure = Dots {
        names: names(contest),
        columns: [MIN_ANGLE, MEAN_ANGLE, SIZE_EFFICIENCY, BETA, TIME].map(column).into(),
        key: entries(contest, &contest.leads(), Key::Series),
    };
    write_both(&figure, stem)
}

/// So many methods may say on one line how it came that they have no mesh.
const MOST_WORDS: usize = 6;

/// Draws smallest and mean angle of each of `methods` on each domain, over all tasks there: the median, and the range. Where
/// a method has no mesh, the word says how that came, unless there are many methods.
///
/// # Errors
/// [`ChartError`].
pub fn domains(contest: &Contest, methods: &[usize], stem: &Path) -> Result<(), ChartError> {
    let all: Vec<usize> = (0..contest.tasks.len()).collect();
    let mut lines: Vec<(String, Vec<usize>)> = Vec::new();
    for (title, tasks) in contest.by_spacing(&all) {
        for task in tasks {
            let name = format!("{} {title}", contest.tasks[task].domain);
            match lines.iter_mut().find(|(known, _)| *known == name) {
                Some((_, own)) => own.push(task),
                None => lines.push((name, vec![task])),
            }
        }
    }
    let dots = |measure: Measure| {
        let mut dots = Vec::new();
        for (line, (_, tasks)) in lines.iter().enumerate() {
            for (place, &k) in methods.iter().enumerate() {
                let row = tasks.first().and_then(|task| contest.row(k, *task));
                let values = contest.values(k, tasks, measure.value);
                // Of many, words would stand on one another: the page's tables tell then.
                if values.is_empty() && methods.len() > MOST_WORDS {
                    continue;
                }
                dots.push(Dot {
                    line,
                    shift: apart(place, methods.len()),
                    values,
                    marker: style::method(&contest.methods[k]),
                    missing: ending(row),
                });
            }
        }
        dots
    };
    let column = |measure: Measure| Column {
        label: measure.short_label(),
        is_log: false,
        dots: dots(measure),
    };
    let figure = Dots {
        columns: [MIN_ANGLE, MEAN_ANGLE].map(column).into(),
        key: entries(contest, methods, Key::Series),
        names: lines.iter().map(|(name, _)| name.clone()).collect(),
    };
    write_both(&figure, stem)
}

/// Draws medians over the tasks that all of `methods` measured against t: smallest angle, mean angle and size efficiency,
/// one column for each c_b, one line for each method.
///
/// # Errors
/// [`ChartError`].
pub fn methods_against_t(contest: &Contest, methods: &[usize], stem: &Path) -> Result<(), ChartError> {
    write_both(&AgainstT { contest, methods }, stem)
}

struct AgainstT<'a> {
    contest: &'a Contest<'a>,
    methods: &'a [usize],
}

impl AgainstT<'_> {
    /// Medians over common tasks for each t.
    fn line(&self, method: usize, c_b: f64, value: fn(&Report) -> Option<f64>) -> Vec<(f64, f64)> {
        let own = self.contest.only(|asked| asked.c_b == c_b);
        let common = own.common(self.methods);
        let ts = distinct(common.iter().map(|task| own.tasks[*task].t));
        let point = |t: f64| {
            let here: Vec<usize> = common.iter().copied().filter(|task| own.tasks[*task].t == t).collect();
            Some((t, own.median(method, &here, value)?))
        };
        ts.into_iter().filter_map(point).collect()
    }
}

impl Figure for AgainstT<'_> {
    fn size(&self) -> (u32, u32) {
        (1200, 1090)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let c_bs = distinct(self.contest.tasks.iter().map(|asked| asked.c_b));
        let reach = self.contest.tasks.iter().map(|asked| asked.t).fold(0.0, f64::max);
        let (plots, key) = area.split_vertically((self.size().1 as i32 - 40) * FINE);
        let areas = plots.split_evenly((3, c_bs.len().max(1)));
        for (row, measure) in [MIN_ANGLE, MEAN_ANGLE, SIZE_EFFICIENCY].into_iter().enumerate() {
            let line = |method: &usize, c_b: &f64| self.line(*method, *c_b, measure.value);
            let all = c_bs
                .iter()
                .flat_map(|c_b| self.methods.iter().flat_map(move |method| line(method, c_b)));
            let upward = span(all.map(|point| point.1));
            for (column, c_b) in c_bs.iter().enumerate() {
                let title = if row == 0 {
                    format!("c_b = {c_b}")
                } else {
                    String::new()
                };
                let label = if column == 0 { measure.label() } else { String::new() };
                let x = Axis::linear(if row == 2 { "t" } else { "" }, 0.0..reach * 1.06, 5);
                let y = Axis::linear(&label, upward.clone(), 6);
                let mut panel = Panel::new(&areas[row * c_bs.len() + column], &title, x, y, 76)?;
                for method in self.methods {
                    let marker = style::method(&self.contest.methods[*method]);
                    let points = line(method, c_b);
                    panel.line(&points, marker.colour, FINE as u32)?;
                    for point in points {
                        panel.marker(point, marker)?;
                    }
                }
            }
        }
        legend_row(&key, 62, &entries(self.contest, self.methods, Key::Series))
    }
}
