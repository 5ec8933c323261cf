//! The paper, checked line by line: every statement with a bound as a record, judged twice.
//!
//! * **Numerically** ([`search`]): the optimum of the bounded quantity over all configurations that the hypotheses allow, bracketed by
//!   interval branch and bound, against the printed formula, over a grid of the parameter.
//! * **On meshes** ([`measured`]): the worst margin over all committed rows, with the cell it was seen in; and [`nearest`]: what
//!   a search for the mesh nearest to each bound found.
//!
//! [`statements`] has the records in the order of the paper, [`errata`] what came out beside numbers.

pub mod demonstration;
pub mod errata;
pub mod findings;
pub mod judge;
mod linear;
pub mod measured;
pub mod nearest;
pub mod record;
pub mod search;
pub mod slopes;
pub mod statements;
pub mod table;

use crate::suite::charts;
use crate::suite::files::write_whole;
use measured::Meshes;
use std::path::{Path, PathBuf};
use table::Line;

/// Judges all statements and writes `results/lemmas` and `paper/errata.md` below `root`; returns what was judged, and the files.
///
/// # Errors
/// What could not be read, run or written.
pub fn write(root: &Path) -> Result<(Vec<Line>, Vec<PathBuf>), String> {
    let results = root.join("results");
    let meshes = Meshes::read(&results).map_err(|error| error.to_string())?;
    let lines = table::judge_all(&meshes, None);
    let files = [
        (results.join("lemmas/statements.csv"), table::optima_table(&lines)),
        (
            results.join("lemmas/README.md"),
            table::page(&lines, &meshes, &nearest::again(root)?),
        ),
        (root.join("paper/errata.md"), errata::page(&lines)?),
    ];
    let mut written = Vec::new();
    for (path, text) in files {
        write_whole(&path, text.as_bytes()).map_err(|error| format!("could not write {}: {error}", path.display()))?;
        written.push(path);
    }
    for line in &lines {
        if let Some(figure) = line.figure(&meshes) {
            let stem = results.join("lemmas/charts").join(line.statement.figure_name());
            charts::bound(&figure, &stem).map_err(|error| error.to_string())?;
        }
    }
    written.push(results.join("lemmas/charts"));
    Ok((lines, written))
}
#[cfg(test)]
mod tests;
