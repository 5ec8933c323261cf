//! Rows of several meshers on the same tasks: who was asked what, and what all of them managed.
//!
//! Medians over the meshes that happened to come out would flatter a method that fails on hard tasks, so methods are
//! compared on the tasks that all of them measured, and everything else is counted.

use crate::meshers::{MESHERS, Parameters};
use crate::suite::analysis::summary::{measured, specs_by_title};
use crate::suite::peers::{AnyEntry, PEERS};
use crate::suite::rows::numbers::{distinct, median};
use crate::suite::rows::record::parameter_text;
use crate::suite::rows::record::{Cell, Outcome, Report, Row};
use crate::suite::rows::times::Times;

/// A mesher with parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Method {
    /// Place of the mesher in `MESHERS` and behind them `PEERS`, which gives its colour and marker; behind all where it is
    /// no more there.
    pub place: usize,
    /// The mesher's name, and the parameters that differ from its defaults.
    pub label: String,
    /// Whether all parameters are at their defaults.
    pub is_default: bool,
    /// The mesher's name.
    pub mesher: String,
}

impl Method {
    /// The method of a row.
    pub fn of(row: &Row) -> Self {
        let mesher = &row.cell.mesher;
        let defaults = AnyEntry::find(mesher).map(|entry| entry.complete(&Parameters::new()));
        let defaults = defaults.unwrap_or_default();
        let all = row.cell.complete();
        let differing = all.iter().filter(|(name, value)| defaults.get(*name) != Some(value));
        let differing: Vec<String> = differing
            .map(|(name, value)| format!("{name}={}", parameter_text(value)))
            .collect();
        Self {
            place: AnyEntry::all()
                .position(|entry| entry.name() == *mesher)
                .unwrap_or(MESHERS.len() + PEERS.len()),
            label: std::iter::once(mesher.clone())
                .chain(differing.iter().cloned())
                .collect::<Vec<_>>()
                .join(" "),
            is_default: differing.is_empty(),
            mesher: mesher.clone(),
        }
    }
}

/// What several methods are asked for alike.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a>(&'a Cell);

impl Asked<'_> {
    fn is_of(&self, cell: &Cell) -> bool {
        let own = self.0;
        (
            &own.domain,
            &own.spacing,
            own.t,
            own.c_b,
            own.seed,
            own.lfs_cap,
            own.triangles,
            own.threads,
            &own.poisson,
        ) == (
            &cell.domain,
            &cell.spacing,
            cell.t,
            cell.c_b,
            cell.seed,
            cell.lfs_cap,
            cell.triangles,
            cell.threads,
            &cell.poisson,
        )
    }
}

impl<'a> std::ops::Deref for Asked<'a> {
    type Target = Cell;

    fn deref(&self) -> &Cell {
        self.0
    }
}

/// Methods on tasks.
#[derive(Clone, Debug)]
pub struct Contest<'a> {
    /// In the order of `MESHERS`, the defaults of each first.
    pub methods: Vec<Method>,
    /// Tasks that at least two methods were asked to do, in row order.
    pub tasks: Vec<Asked<'a>>,
    /// For each method, its row for each task, if it was asked.
    rows: Vec<Vec<Option<&'a Row>>>,
}

impl<'a> Contest<'a> {
    /// Gathers rows; of several for one method and task the first counts.
    pub fn of(rows: impl IntoIterator<Item = &'a Row>) -> Self {
        let mut tasks: Vec<(Asked<'a>, Vec<(Method, &'a Row)>)> = Vec::new();
        for row in rows {
            let known = tasks.iter().position(|(asked, _)| asked.is_of(&row.cell));
            let place = known.unwrap_or_else(|| {
                tasks.push((Asked(&row.cell), Vec::new()));
                tasks.len() - 1
            });
            let (own, method) = (&mut tasks[place].1, Method::of(row));
            if own.iter().all(|(other, _)| *other != method) {
                own.push((method, row));
            }
        }
        tasks.retain(|(_, own)| own.len() > 1);
        let mut methods: Vec<Method> = Vec::new();
        for (method, _) in tasks.iter().flat_map(|(_, own)| own) {
            if !methods.contains(method) {
                methods.push(method.clone());
            }
        }
        methods.sort_by(|a, b| {
            let order = |method: &Method| (method.place, method.mesher.clone(), !method.is_default);
            order(a)
                .cmp(&order(b))
                .then_with(|| in_number_order(&a.label, &b.label))
        });
        let row_of = |method: &Method, own: &[(Method, &'a Row)]| {
            own.iter().find(|(other, _)| other == method).map(|(_, row)| *row)
        };
        let rows = methods
            .iter()
            .map(|method| tasks.iter().map(|(_, own)| row_of(method, own)).collect())
            .collect();
        Self {
            methods,
            tasks: tasks.into_iter().map(|(asked, _)| asked).collect(),
            rows,
        }
    }

    /// Only the tasks that `keep` keeps.
    pub fn only(&self, keep: impl Fn(&Asked) -> bool) -> Self {
        let kept: Vec<usize> = (0..self.tasks.len()).filter(|task| keep(&self.tasks[*task])).collect();
        Self {
            methods: self.methods.clone(),
            tasks: kept.iter().map(|task| self.tasks[*task]).collect(),
            rows: self
                .rows
                .iter()
                .map(|own| kept.iter().map(|task| own[*task]).collect())
                .collect(),
        }
    }

    /// Whether there are tasks for more than one mesher.
    pub fn has_several_meshers(&self) -> bool {
        self.leads().len() > 1
    }

    /// The method that stands for a mesher, if it took part.
    pub fn lead_of(&self, mesher: &str) -> Option<usize> {
        self.leads().into_iter().find(|k| self.methods[*k].mesher == mesher)
    }

    /// The rows of a method, whatever came of them.
    pub fn rows(&self, method: usize) -> impl Iterator<Item = &'a Row> {
        self.rows[method].iter().copied().flatten()
    }

    /// The most different t with which one domain and spacing stand among the tasks.
    pub fn most_t(&self) -> usize {
        let of = |asked: &Asked| {
            let alike = self
                .tasks
                .iter()
                .filter(|other| (&other.domain, &other.spacing) == (&asked.domain, &asked.spacing));
            distinct(alike.map(|other| other.t)).len()
        };
        self.tasks.iter().map(of).max().unwrap_or(0)
    }

    /// Splits tasks by their spacing, titled as everywhere.
    pub fn by_spacing(&self, tasks: &[usize]) -> Vec<(String, Vec<usize>)> {
        let specs: Vec<&str> = tasks.iter().map(|task| self.tasks[*task].spacing.as_str()).collect();
        let all = specs_by_title(&specs);
        let own = |specs: &[&str]| {
            let is_own = |task: &&usize| specs.contains(&self.tasks[**task].spacing.as_str());
            tasks.iter().filter(is_own).copied().collect()
        };
        all.into_iter().map(|(title, specs)| (title, own(&specs))).collect()
    }

    /// How many of a method's rows ended so.
    pub fn count(&self, method: usize, outcome: Outcome) -> usize {
        self.rows(method).filter(|row| row.outcome == outcome).count()
    }

    /// A method's row for a task, if it was asked.
    pub fn row(&self, method: usize, task: usize) -> Option<&'a Row> {
        self.rows[method][task]
    }

    /// What a method measured on a task.
    pub fn report(&self, method: usize, task: usize) -> Option<&'a Report> {
        measured(self.rows[method][task]?)
    }

    /// Whether a method measured at least half of what it was asked: others take no part in medians over common tasks, which
    /// would have few tasks left.
    pub fn takes_part(&self, method: usize) -> bool {
        let measured = self.count(method, Outcome::Measured);
        measured > 0 && 2 * measured >= self.rows(method).count()
    }

    /// The tasks that all of `methods` measured, but for those that take no part.
    pub fn common(&self, methods: &[usize]) -> Vec<usize> {
        let able: Vec<usize> = methods
            .iter()
            .copied()
            .filter(|method| self.takes_part(*method))
            .collect();
        let by_all = |task: &usize| able.iter().all(|method| self.report(*method, *task).is_some());
        (0..self.tasks.len())
            .filter(|task| !able.is_empty() && by_all(task))
            .collect()
    }

    /// One method for each mesher: with its defaults, or the first there is.
    pub fn leads(&self) -> Vec<usize> {
        let all = 0..self.methods.len();
        all.filter(|k| *k == 0 || self.methods[*k].mesher != self.methods[k - 1].mesher)
            .collect()
    }

    /// All methods.
    pub fn all(&self) -> Vec<usize> {
        (0..self.methods.len()).collect()
    }

    /// The values of a method over some tasks, those it has.
    pub fn values(&self, method: usize, tasks: &[usize], value: impl Fn(&Report) -> Option<f64>) -> Vec<f64> {
        tasks
            .iter()
            .filter_map(|task| value(self.report(method, *task)?))
            .collect()
    }

    /// The median of those, where it measured all of the tasks.
    pub fn median(&self, method: usize, tasks: &[usize], value: impl Fn(&Report) -> Option<f64>) -> Option<f64> {
        let has_all = tasks.iter().all(|task| self.report(method, *task).is_some());
        median(self.values(method, tasks, value)).filter(|_| has_all)
    }

    /// Pairs of values of two methods on the tasks where both have one.
    pub fn pairs(&self, [a, b]: [usize; 2], value: impl Fn(&Report) -> Option<f64>) -> Vec<(usize, [f64; 2])> {
        let pair = |task: usize| Some((task, [value(self.report(a, task)?)?, value(self.report(b, task)?)?]));
        (0..self.tasks.len()).filter_map(pair).collect()
    }
}

/// By text, but numbers of more digits later: `oversample=16` after `oversample=4`.
fn in_number_order(a: &str, b: &str) -> std::cmp::Ordering {
    let parts = |text: &str| {
        let words = text.split([' ', '=']);
        words
            .map(|word| (word.parse::<f64>().unwrap_or(f64::NEG_INFINITY), word.to_string()))
            .collect::<Vec<_>>()
    };
    let (a, b) = (parts(a), parts(b));
    let each = a
        .iter()
        .zip(&b)
        .map(|(a, b)| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
    each.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
        .then(a.len().cmp(&b.len()))
}

impl Contest<'_> {
    /// Those of some tasks on which all of the methods have a value: not all times can be believed. A method that has none on
    /// any of them does not take part.
    pub fn having(&self, methods: &[usize], tasks: &[usize], value: fn(&Report) -> Option<f64>) -> Vec<usize> {
        let has = |method: usize, task: usize| self.report(method, task).and_then(value).is_some();
        let takes_part = |method: &usize| tasks.iter().any(|&task| has(*method, task));
        let methods: Vec<usize> = methods.iter().copied().filter(takes_part).collect();
        let all_have = |task: &usize| methods.iter().all(|&method| has(method, *task));
        tasks.iter().copied().filter(all_have).collect()
    }
}

/// Why there is no time to quote of some reports, in two words.
pub fn doubt<'a>(reports: impl IntoIterator<Item = &'a Report>) -> &'static str {
    let mut times = reports.into_iter().filter_map(|report| report.times.as_ref());
    times.find_map(Times::doubt).unwrap_or("not timed")
}

/// Seconds a triangle, where the seconds can be believed.
pub fn seconds_per_triangle(report: &Report) -> Option<f64> {
    Some(report.believable_seconds()? / report.statistics.triangles as f64).filter(|seconds| seconds.is_finite())
}
