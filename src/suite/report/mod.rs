//! Pages made from the rows alone.
//!
//! [`write()`] reads `rows.jsonl` of a results folder and writes `README.md` and `charts/` beside it. The same rows give
//! the same bytes, in whatever order they were written.

mod adapt;
mod angles;
mod battery;
mod claims;
mod corners;
mod duels;
mod figures;
mod findings;
mod frontiers;
pub(crate) mod markdown;
mod meshes;
mod page;
mod peers;
mod poisson;
mod quote;
mod ranks;
mod rivals;
mod rules;
mod sections;
mod standings;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;

pub(crate) use findings::{grids, ours};
pub use quote::quote_findings;

use crate::files::write_whole;
use crate::suite::charts::ChartError;
use crate::suite::rows::journal::{JournalError, read_rows};
use crate::suite::rows::record::{ROWS, Row};
use crate::suite::run::battery::CHUNKS;
use crate::suite::run::battery::chunk::Chunk;
use crate::suite::run::plan::Plan;
use std::path::{Path, PathBuf};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The rows could not be read.
    #[error(transparent)]
    Rows(#[from] JournalError),
    /// A chart could not be made.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The page could not be written.
    #[error("could not write {}", path.display())]
    Write {
        /// Which file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

/// Reads `folder/rows.jsonl`, or `folder/chunks.jsonl` where there is that in its place, writes `folder/charts/*.svg`, `*.png` and `folder/README.md`, and returns the page's path.
///
/// # Errors
/// [`ReportError`]: no rows there, a line that is no row, or a file that cannot be written.
pub fn write(folder: &Path) -> Result<PathBuf, ReportError> {
    if is_battery(folder) {
        return write_battery(folder);
    }
    let rows = read(&folder.join(ROWS))?;
    let figures = figures::draw(&rows, &folder.join("charts"))?;
    let pictures = meshes::draw(&rows, &folder.join("charts"))?;
    let path = folder.join("README.md");
    let text = page::page(&rows, &figures, &pictures, &heading(folder));
    write_whole(&path, text.as_bytes()).map_err(|source| ReportError::Write {
        path: path.clone(),
        source,
    })?;
    Ok(path)
}

/// Whether the folder holds tallied cases in place of rows.
fn is_battery(folder: &Path) -> bool {
    !folder.join(ROWS).exists() && folder.join(CHUNKS).exists()
}

fn write_battery(folder: &Path) -> Result<PathBuf, ReportError> {
    let chunks: Vec<Chunk> = read_rows(&folder.join(CHUNKS))?;
    let expect = Plan::read(&folder.join("plan.toml")).map(|plan| plan.expect);
    let path = folder.join("README.md");
    let text = battery::page(&chunks, &heading(folder), &expect.unwrap_or_default());
    write_whole(&path, text.as_bytes()).map_err(|source| ReportError::Write {
        path: path.clone(),
        source,
    })?;
    Ok(path)
}

/// The main findings of a folder, as other pages quote them.
fn findings_in_short(folder: &Path) -> Result<String, ReportError> {
    if is_battery(folder) {
        return Ok(battery::finding_lines(&read_rows(&folder.join(CHUNKS))?));
    }
    Ok(page::findings_in_short(&read(&folder.join(ROWS))?))
}

/// The folder's name, and the question of the plan that lies in it, if there is one.
fn heading(folder: &Path) -> page::Heading {
    let plan = Plan::read(&folder.join("plan.toml")).ok();
    page::Heading {
        name: folder
            .file_name()
            .map(|name| name.to_string_lossy().into_owned())
            .unwrap_or_default(),
        question: plan.map(|plan| plan.question.trim().to_string()),
    }
}

/// The rows, sorted by what was asked, since cells that run side by side end in any order.
pub(crate) fn read(path: &Path) -> Result<Vec<Row>, JournalError> {
    let mut rows: Vec<Row> = read_rows(path)?;
    rows.sort_by(|a, b| {
        let names = |row: &Row| (row.group.clone(), row.cell.spacing.clone(), row.cell.domain.clone());
        let by_t = a.cell.t.total_cmp(&b.cell.t);
        names(a)
            .cmp(&names(b))
            .then(by_t)
            .then(a.cell.c_b.total_cmp(&b.cell.c_b))
            .then(a.key.cmp(&b.key))
    });
    Ok(rows)
}
