//! Triangles over what spacing and local feature size ask for, over the grid of t and c_b.

use super::drawer::Drawer;
use super::markdown::{number, parameter, table};
use crate::suite::analysis::measures::{Measure, SIZE_EFFICIENCY, SIZE_RATIO, SIZE_RATIO_LFS};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{Grid, measured};
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::spread;
use crate::suite::run::plan::Section;

/// Between what bounds the two ratios lie, for the first spacing.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let grids = results.grids(Section::Size);
    let Some((title, grid)) = grids.first() else {
        return Vec::new();
    };
    let of = |by: &Measure| spread(grid.reports().filter_map(|(_, report)| (by.value)(report)).collect());
    let by_f = of(&SIZE_EFFICIENCY).map(|spread| {
        let [least, most, middle] = [spread.least, spread.most, spread.median].map(number);
        format!(
            "With `{title}`, triangles/∫dA/f² times (√3/4)c_b² lies between {least} and {most}, in the median {middle}, over {} meshes.",
            spread.count
        )
    });
    let by_lfs = of(&SIZE_RATIO_LFS).map(|spread| {
        let [least, most] = [spread.least, spread.most].map(number);
        format!("With `{title}`, triangles/∫dA/lfs² lies between {least} and {most}, by t and c_b.")
    });
    by_f.into_iter().chain(by_lfs).collect()
}

/// Tables t × c_b of medians over domains.
pub(super) fn text(results: &Results) -> String {
    let mut text = String::new();
    for (index, (title, grid)) in results.grids(Section::Size).iter().enumerate() {
        let measures = if index == 0 {
            &[SIZE_RATIO, SIZE_RATIO_LFS][..]
        } else {
            &[SIZE_RATIO]
        };
        for by in measures {
            text += &format!(
                "{} with `{title}`, median over the measured domains (how many of how many):\n\n",
                by.title
            );
            text += &t_by_c_b(grid, by);
        }
    }
    text
}

/// A table with a line for each t and a column for each c_b.
fn t_by_c_b(grid: &Grid, by: &Measure) -> String {
    let head: Vec<String> = grid
        .c_bs
        .iter()
        .map(|c_b| format!("c_b = {}", parameter(*c_b)))
        .collect();
    let head: Vec<&str> = std::iter::once("t").chain(head.iter().map(String::as_str)).collect();
    let cell = |t: f64, c_b: f64| {
        let rows = grid.at(t, c_b);
        let done = rows.iter().filter(|row| measured(row).is_some()).count();
        match grid.median(t, c_b, by.value) {
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
    charts::heat_map(&grids, &SIZE_RATIO, &stem)?;
    let stem = drawer.chart("size-against-t", "The same against t, one line for each c_b.");
    charts::against_t(&grids, &SIZE_RATIO, &stem)?;
    let caption = "Triangles over ∫dA/lfs² for each t and c_b, median over domains; * where some domains are missing.";
    let stem = drawer.chart("size-lfs-heat", caption);
    charts::heat_map(first, &SIZE_RATIO_LFS, &stem)?;
    let stem = drawer.chart("size-lfs-against-t", "The same against t, one line for each c_b.");
    charts::against_t(first, &SIZE_RATIO_LFS, &stem)?;
    let caption = "Size efficiency of each mesh against t / c_b; the dashed lines hold for constant f.";
    charts::efficiency(&grids, &drawer.chart("efficiency", caption))
}
