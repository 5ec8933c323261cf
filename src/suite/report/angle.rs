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

/// The settings of the table's columns, each with what its heads add.
const SETTINGS: [(Setting, &str); 3] = [
    (Setting::Papers, "meshes"),
    (Setting::LowOverlap, "meshes, circles meet low"),
    (Setting::Acute, "meshes, acute"),
];

/// Smallest angle less its bound, degrees.
pub(super) fn margin_of(report: &Report) -> Option<f64> {
    Some(report.statistics.min_angle_free_deg? - report.min_angle_bound_deg)
}

/// Margins over all measured cells of a setting, at one nominal t or at all.
pub(super) fn margins(grid: &Grid, of: Setting, t: Option<f64>) -> Option<Spread> {
    let wanted = |(row, report): &(&Row, &Report)| setting(report) == of && t.is_none_or(|t| row.cell.t == t);
    let own = grid.reports().filter(wanted);
    spread(own.filter_map(|(_, report)| margin_of(report)).collect())
}

/// The rows of the section, of all spacings.
fn all(results: &Results) -> Grid<'_> {
    Grid::of(results.ours(Section::Angle))
}

/// How far smallest angles lie above asin(1/2 − t) where the hypotheses hold.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let finding = margins(&all(results), Setting::Papers, None).map(|spread| {
        let [least, most, middle] = [spread.least, spread.most, spread.median].map(degrees);
        format!(
            "Where the paper's hypotheses hold, the smallest angle lies {least} to {most} above asin(1/2 − t), median {middle}, over \
             {} meshes.",
            spread.count
        )
    });
    finding.into_iter().collect()
}

/// Margins for each t, and for all.
pub(super) fn text(results: &Results) -> String {
    let all = all(results);
    if all.reports().next().is_none() {
        return String::new();
    }
    let line = |t: Option<f64>| {
        let bound = |t| degrees(Promises { rule: Rule::Earlier, t }.min_angle_deg());
        let mut line = vec![t.map_or("all".into(), parameter), t.map_or("–".into(), bound)];
        for (setting, _) in SETTINGS {
            let spread = margins(&all, setting, t);
            line.push(spread.map_or(0, |spread| spread.count).to_string());
            let of = |value: fn(Spread) -> f64| degrees(spread.map(value));
            line.extend([
                of(|spread| spread.least),
                of(|spread| spread.median),
                of(|spread| spread.most),
            ]);
        }
        line
    };
    let mut head = vec!["t", "asin(1/2 − t)"];
    head.extend(
        SETTINGS
            .iter()
            .flat_map(|(_, meshes)| [*meshes, "least margin", "median", "most"]),
    );
    let ts = all.ts.iter().copied().map(Some).chain([None]);
    "How far the smallest angle of a mesh lies above the bound for its effective t (which is smaller than t where the \
     spacing's own Lipschitz constant is): where the hypotheses hold, where circles of neighbouring input vertices meet \
     low (c_b + t > 1), and where segments meet at angles under 90° (acute). Triangles at input angles under 60° are left out; the bound is 0 from t = 1/2 on.\n\n"
        .to_string()
        + &table(&head, &ts.map(line).collect::<Vec<_>>())
}

/// Smallest angles against t, and how triangles spread over angles for each t.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let grids = results.grids(Section::Angle);
    // Spacing by spacing, so that points that coincide lie upon one another as in the other charts.
    let all = Grid::of(grids.iter().flat_map(|(_, grid)| grid.rows.iter().copied()));
    if all.reports().next().is_none() {
        return Ok(());
    }
    let caption = "Smallest angle of each mesh against t, over the bound of Theorem 6.8. \
                   Points of different c_b are moved apart sideways.";
    charts::smallest_angle(&all, &drawer.chart("angle-against-t", caption))?;
    let caption = "How the triangles of a mesh spread over smallest angles, for each t; mean over meshes.";
    charts::angles_by_t(&grids, &drawer.chart("angles-by-t", caption))
}
