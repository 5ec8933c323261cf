//! What rows say together: medians, quantiles, fitted slopes, and cells gathered by (t, c_b).
//!
//! Charts and pages take their numbers from here, so that a table and a figure cannot disagree.

use crate::geometry::tolerance::RIGHT_ANGLE_DEG;
use crate::suite::rows::numbers::{distinct, first_seen, median, quantile};
use crate::suite::rows::record::{Outcome, Report, Row};

/// Whether two neighbouring segments meet at an angle under 90°, inside or outside: §5.1 assumes that none do.
pub fn is_acute(report: &Report) -> bool {
    report.smallest_segment_angle_deg < 90.0 - RIGHT_ANGLE_DEG
}

/// How the setting of a mesh relates to the one in which Theorem 6.8 is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// No angle under 90°, and no circles of neighbouring input vertices that meet low.
    Papers,
    /// No angle under 90°, but somewhere the circles of a segment's two vertices cover it between them and meet lower
    /// than Lemma 6.4 would have it, or had to be held apart for it (`head_on = part`): possible only where c_b + t > 1, and
    /// excluded in the paper without a word.
    LowOverlap,
    /// Two neighbouring segments meet at an angle under 90°, which the paper excludes.
    Acute,
}

/// The setting of a mesh.
pub fn setting(report: &Report) -> Setting {
    if is_acute(report) {
        Setting::Acute
    } else if report.certificate.low_head_on > 0
        || report.counts.get("segments_parted").is_some_and(|count| *count > 0.0)
    {
        Setting::LowOverlap
    } else {
        Setting::Papers
    }
}

/// The report of a row that was measured.
pub fn measured(row: &Row) -> Option<&Report> {
    row.report.as_ref().filter(|_| row.outcome == Outcome::Measured)
}

/// A mesher's parameter as text, from the report (all parameters) or else the cell (those that differ from defaults).
pub fn parameter<'a>(row: &'a Row, name: &str) -> Option<&'a str> {
    let reported = row.report.as_ref().and_then(|report| report.params.get(name));
    reported.or_else(|| row.cell.params.get(name))?.as_str()
}

/// The kind of a spacing: what stands before the first colon or bracket, such as `lfs`, `expr` or `min`.
pub fn family(spacing: &str) -> &str {
    spacing.split([':', '(']).next().unwrap_or(spacing)
}

/// Longer spacings are called by their family's name alone: they would not fit over a chart.
const LONGEST_TITLE: usize = 24;

/// More spacings of one family than this are taken together.
const MOST_OF_A_FAMILY: usize = 4;

/// Splits rows by their spacing, as [`specs_by_title`] does.
pub fn by_spacing<'a>(rows: &[&'a Row]) -> Vec<(String, Vec<&'a Row>)> {
    let specs: Vec<&str> = rows.iter().map(|row| row.cell.spacing.as_str()).collect();
    let own = |specs: &[&str]| {
        let is_own = |row: &&&Row| specs.contains(&row.cell.spacing.as_str());
        rows.iter().filter(is_own).copied().collect()
    };
    specs_by_title(&specs)
        .into_iter()
        .map(|(title, specs)| (title, own(&specs)))
        .collect()
}

/// The different ones of some spacings: `lfs` first, since the paper's sizes refer to it, then the others in the order in
/// which they first appear, those of one family side by side. Each comes under a title: the spacing itself where it is
/// short, else its family's name, numbered where the family has several.
pub fn specs_by_title<'a>(specs: &[&'a str]) -> Vec<(String, Vec<&'a str>)> {
    let mut families = first_seen(specs.iter().map(|spec| family(spec)));
    families.sort_by_key(|name| *name != "lfs");
    let mut split = Vec::new();
    for name in families {
        let own = first_seen(specs.iter().copied().filter(|spec| family(spec) == name));
        if own.len() > MOST_OF_A_FAMILY {
            split.push((name.to_string(), own));
            continue;
        }
        let count = own.len();
        for (place, spec) in own.into_iter().enumerate() {
            let title = match (spec.chars().count() <= LONGEST_TITLE, count) {
                (true, _) => spec.to_string(),
                (false, 1) => name.to_string(),
                (false, _) => format!("{name} {}", place + 1),
            };
            split.push((title, vec![spec]));
        }
    }
    split
}

/// Rows over t × c_b.
#[derive(Clone, Debug)]
pub struct Grid<'a> {
    /// Nominal t, ascending.
    pub ts: Vec<f64>,
    /// Biting constants, ascending.
    pub c_bs: Vec<f64>,
    /// The rows themselves.
    pub rows: Vec<&'a Row>,
}

impl<'a> Grid<'a> {
    /// Gathers `rows`, measured or not.
    pub fn of(rows: impl IntoIterator<Item = &'a Row>) -> Self {
        let rows: Vec<&Row> = rows.into_iter().collect();
        Self {
            ts: distinct(rows.iter().map(|row| row.cell.t)),
            c_bs: distinct(rows.iter().map(|row| row.cell.c_b)),
            rows,
        }
    }

    /// Every measured report with its row, in row order.
    pub fn reports(&self) -> impl Iterator<Item = (&'a Row, &'a Report)> {
        self.rows.iter().filter_map(|row| Some((*row, measured(row)?)))
    }

    /// The rows asked for at (t, c_b).
    pub fn at(&self, t: f64, c_b: f64) -> Vec<&'a Row> {
        let here = |row: &&Row| row.cell.t == t && row.cell.c_b == c_b;
        self.rows.iter().copied().filter(here).collect()
    }

    /// The median of `value` over the reports at (t, c_b).
    pub fn median(&self, t: f64, c_b: f64, value: impl Fn(&Report) -> Option<f64>) -> Option<f64> {
        median(
            self.at(t, c_b)
                .into_iter()
                .filter_map(measured)
                .filter_map(value)
                .collect(),
        )
    }

    /// The same without the domains that have acute angles, as far as their reports tell.
    pub fn without_acute(&self) -> Self {
        let reports = self.reports().filter(|(_, report)| is_acute(report));
        let acute = first_seen(reports.map(|(row, _)| row.cell.domain.as_str()));
        Self::of(
            self.rows
                .iter()
                .copied()
                .filter(|row| !acute.contains(&row.cell.domain.as_str())),
        )
    }

    /// One summary for each (t, c_b) of which every row was measured: a pair that lost its large domains would look
    /// better or worse than it is.
    pub fn pairs(&self) -> Vec<Pair> {
        let all = self.ts.iter().flat_map(|t| self.c_bs.iter().map(|c_b| (*t, *c_b)));
        all.filter_map(|(t, c_b)| self.pair(t, c_b)).collect()
    }

    fn pair(&self, t: f64, c_b: f64) -> Option<Pair> {
        let rows = self.at(t, c_b);
        let reports: Vec<&Report> = rows.iter().filter_map(|row| measured(row)).collect();
        let angles = reports.iter().filter_map(|report| report.statistics.min_angle_free_deg);
        let complete = !rows.is_empty() && reports.len() == rows.len();
        complete.then_some(Pair {
            t,
            c_b,
            smallest_angle_deg: quantile(angles.collect(), 0.0)?,
            size_ratio_lfs: median(reports.iter().map(|report| report.size_ratio_lfs).collect())?,
            domains: rows.len(),
        })
    }
}

/// What one (t, c_b) gives over all its domains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Nominal t.
    pub t: f64,
    /// Biting constant.
    pub c_b: f64,
    /// Smallest `min_angle_free_deg` over the domains.
    pub smallest_angle_deg: f64,
    /// Median of triangles / ∫ dA / lfs² over the domains.
    pub size_ratio_lfs: f64,
    /// How many domains.
    pub domains: usize,
}

/// The pairs no other pair beats in both smallest angle and size, from few triangles to many.
pub fn unbeaten_pairs(pairs: &[Pair]) -> Vec<Pair> {
    unbeaten(pairs, |pair| pair.size_ratio_lfs, |pair| pair.smallest_angle_deg)
}

/// Those of some meshes that no other beats in both size and angle, from small to large.
pub fn unbeaten<T: Clone>(all: &[T], size: impl Fn(&T) -> f64, angle: impl Fn(&T) -> f64) -> Vec<T> {
    let mut sorted = all.to_vec();
    sorted.sort_by(|a, b| size(a).total_cmp(&size(b)).then(angle(b).total_cmp(&angle(a))));
    let mut best = f64::NEG_INFINITY;
    sorted.retain(|mesh| {
        let wins = angle(mesh) > best;
        best = best.max(angle(mesh));
        wins
    });
    sorted
}

/// Without the noise of the last digits, as parameters are told.
pub fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}
