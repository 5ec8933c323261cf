//! Smallest angles over the grid of t and c_b, against their bound.

use super::drawer::Drawer;
use super::markdown::{degrees, parameter, table};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{Grid, Setting, setting};
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::{Spread, spread};
use crate::suite::rows::record::{Report, Row};
use crate::suite::run::plan::Section;
use crate::theory::{Promises, Rule};

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
pub(super) fn margin_of(report: &Report) -> Option<f64> {
    Some(report.statistics.min_angle_free_deg? - report.min_angle_bound_deg)
}

/// Margins over all measured cells of that setting.
fn margin(grid: &Grid, of: Setting, t: Option<f64>) -> Option<Spread> {
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

/// The rows of the section, of all spacings.
fn all(results: &Results) -> Grid<'_> {
    Grid::of(results.ours(Section::Angle))
}

/// How far smallest angles lie above asin(1/2 − t).
pub(super) fn findings(results: &Results) -> Vec<String> {
    finding(results).into_iter().collect()
}

fn finding(results: &Results) -> Option<String> {
    let all = all(results);
    let told = |of: Setting| {
        let spread = margin(&all, of, None)?;
        Some(format!(
            "{} to {} above asin(1/2 − t), median {}, over {} meshes",
            degrees(spread.least),
            degrees(spread.most),
            degrees(spread.median),
            spread.count
        ))
    };
    let mut line = format!(
        "**Smallest angle.** Where the hypotheses hold it lies {}.",
        told(Setting::Papers)?
    );
    if let Some(low) = told(Setting::LowOverlap) {
        line += &format!(" Where circles of neighbouring input vertices meet low: {low}.");
    }
    if let Some(acute) = told(Setting::Acute) {
        line += &format!(" Where segments meet at less than 90°: {acute}, leaving out triangles at angles under 60°.");
    }
    Some(line)
}

/// Margins for each t.
pub(super) fn text(results: &Results) -> String {
    let all = all(results);
    if all.reports().next().is_none() {
        return String::new();
    }
    let lines = margins(&all).into_iter().map(|margin| {
        let three = [margin.papers, margin.low, margin.acute]
            .into_iter()
            .flat_map(|spread| {
                let count = spread.map_or(0, |spread| spread.count).to_string();
                [
                    count,
                    degrees(spread.map(|s| s.least)),
                    degrees(spread.map(|s| s.median)),
                ]
            });
        let bound = Promises {
            rule: Rule::Earlier,
            t: margin.t,
        }
        .min_angle_deg();
        [parameter(margin.t), degrees(bound)].into_iter().chain(three).collect()
    });
    let head = [
        "t",
        "asin(1/2 − t)",
        "meshes",
        "least margin",
        "median",
        "meshes, circles meet low",
        "least margin",
        "median",
        "meshes, acute",
        "least margin",
        "median",
    ];
    "How far the smallest angle of a mesh lies above the bound for its effective t (which is smaller than t where the \
     spacing's own Lipschitz constant is): where the hypotheses hold, where circles of neighbouring input vertices meet \
     low (c_b + t > 1), and where segments meet at angles under 90° (acute). Triangles at input angles under 60° are left out; the bound is 0 from t = 1/2 on.\n\n"
        .to_string()
        + &table(&head, &lines.collect::<Vec<_>>())
}

/// Smallest angles against t, and how triangles spread over angles for each t.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let all = Grid::of(
        results
            .grids(Section::Angle)
            .iter()
            .flat_map(|(_, grid)| grid.rows.iter().copied()),
    );
    if all.reports().next().is_none() {
        return Ok(());
    }
    let caption = "Smallest angle of each mesh against t, over the bound of Theorem 6.8. \
                   Points of different c_b are moved apart sideways.";
    charts::smallest_angle(&all, &drawer.chart("angle-against-t", caption))?;
    let caption = "How the triangles of a mesh spread over smallest angles, for each t; mean over meshes.";
    charts::angles_by_t(&results.grids(Section::Angle), &drawer.chart("angles-by-t", caption))
}
