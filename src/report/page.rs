//! `README.md` of a results folder.

use super::figures::Chart;
use super::findings::{claims, grids, margins, tally};
use super::markdown::{degrees, number, parameter, table};
use crate::experiment::record::Row;

/// The whole page.
pub(super) fn page(rows: &[Row], figures: &[Chart]) -> String {
    let total = tally(rows);
    let mut text = format!("# Results\n\n{} cells, {} measured.\n\n", total.cells, total.measured);
    for (title, grid) in grids(rows) {
        text += &format!("## {title}\n\n");
        let lines = margins(&grid).into_iter().map(|margin| {
            vec![
                parameter(margin.t),
                degrees(margin.plain.map(|s| s.least)),
                degrees(margin.plain.map(|s| s.median)),
                number(margin.acute.map(|s| s.least)),
            ]
        });
        text += &table(&["t", "least", "median", "acute"], &lines.collect::<Vec<_>>());
    }
    for claim in claims(rows) {
        text += &format!(
            "* {} held in {} of {}\n",
            claim.claim, claim.guaranteed.1, claim.guaranteed.0
        );
    }
    for figure in figures {
        text += &format!("![{1}](charts/{0}.svg)\n\n{1}\n\n", figure.name, figure.caption);
    }
    text
}
