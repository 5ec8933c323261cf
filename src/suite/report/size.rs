//! Triangles over what spacing and local feature size ask for, over the grid of t and c_b.

use super::drawer::Drawer;
use super::markdown::{number, parameter, table};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{Grid, measured};
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::spread;
use crate::suite::rows::record::Report;
use crate::suite::run::plan::Section;

/// Between what bounds the two ratios lie.
pub(super) fn findings(results: &Results) -> Vec<String> {
    finding(results).into_iter().collect()
}

fn finding(results: &Results) -> Option<String> {
    let (title, grid) = results.grids(Section::Size).into_iter().next()?;
    let of = |value: fn(&Report) -> f64| spread(grid.reports().map(|(_, report)| value(report)).collect());
    let (by_f, by_lfs, efficiency) = (
        of(|r| r.size_ratio)?,
        of(|r| r.size_ratio_lfs)?,
        of(|r| r.size_efficiency)?,
    );
    Some(format!(
        "**Size** of bitten meshes, with spacing `{title}`. Triangles/∫dA/f² lie between {} and {}, times (√3/4)c_b² between {} and {} \
         (median {}). Triangles/∫dA/lfs² lie between {} and {}.",
        number(by_f.least),
        number(by_f.most),
        number(efficiency.least),
        number(efficiency.most),
        number(efficiency.median),
        number(by_lfs.least),
        number(by_lfs.most)
    ))
}

/// Tables t × c_b of medians over domains.
pub(super) fn text(results: &Results) -> String {
    let mut text = String::new();
    for (index, (title, grid)) in results.grids(Section::Size).iter().enumerate() {
        text +=
            &format!("Triangles/∫dA/f² with `{title}`, median over the measured domains (how many of how many):\n\n");
        text += &t_by_c_b(grid, |report| report.size_ratio);
        if index == 0 {
            text += &format!("Triangles/∫dA/lfs² with `{title}`, likewise:\n\n");
            text += &t_by_c_b(grid, |report| report.size_ratio_lfs);
        }
    }
    text
}

/// A table with a line for each t and a column for each c_b.
fn t_by_c_b(grid: &Grid, value: fn(&Report) -> f64) -> String {
    let head: Vec<String> = grid
        .c_bs
        .iter()
        .map(|c_b| format!("c_b = {}", parameter(*c_b)))
        .collect();
    let head: Vec<&str> = std::iter::once("t").chain(head.iter().map(String::as_str)).collect();
    let cell = |t: f64, c_b: f64| {
        let rows = grid.at(t, c_b);
        let done = rows.iter().filter(|row| measured(row).is_some()).count();
        match grid.median(t, c_b, value) {
            Some(middle) if done == rows.len() => number(middle),
            Some(middle) => format!("{} ({done} of {})", number(middle), rows.len()),
            None => format!("– (0 of {})", rows.len()),
        }
    };
    let line = |t: &f64| {
        std::iter::once(parameter(*t))
            .chain(grid.c_bs.iter().map(|c_b| cell(*t, *c_b)))
            .collect()
    };
    table(&head, &grid.ts.iter().map(line).collect::<Vec<Vec<String>>>())
}

/// Both ratios over t and c_b, and size efficiency.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let grids = results.grids(Section::Size);
    let Some(first) = grids
        .first()
        .filter(|_| grids.iter().any(|(_, grid)| grid.reports().next().is_some()))
    else {
        return Ok(());
    };
    let first = std::slice::from_ref(first);
    let caption = "Triangles over ∫dA/f² for each t and c_b, median over domains; * where some domains are missing.";
    let stem = drawer.chart("size-heat", caption);
    charts::heat_map(&grids, charts::SIZE_RATIO, &stem)?;
    let stem = drawer.chart("size-against-t", "The same against t, one line for each c_b.");
    charts::against_t(&grids, charts::SIZE_RATIO, &stem)?;
    let caption = "Triangles over ∫dA/lfs² for each t and c_b, median over domains; * where some domains are missing.";
    let stem = drawer.chart("size-lfs-heat", caption);
    charts::heat_map(first, charts::SIZE_RATIO_LFS, &stem)?;
    let stem = drawer.chart("size-lfs-against-t", "The same against t, one line for each c_b.");
    charts::against_t(first, charts::SIZE_RATIO_LFS, &stem)?;
    let caption = "Size efficiency of each mesh against t / c_b; the dashed lines hold for constant f.";
    charts::efficiency(&grids, &drawer.chart("efficiency", caption))
}
