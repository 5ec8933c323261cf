//! Pages made from the rows alone.
//!
//! [`write()`] reads `rows.jsonl` of a results folder and writes `README.md` and `charts/` beside it. The same rows give
//! the same bytes, in whatever order they were written.

mod figures;
mod findings;
mod markdown;
mod page;
mod sections;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;

use crate::charts::ChartError;
use crate::experiment::plan::Plan;
use crate::experiment::record::Row;
use crate::files::write_whole;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The rows could not be read.
    #[error("could not read {}: run the sweep first, or name its folder", path.display())]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A line is no row.
    #[error("{}:{line} is no row: delete that line, or run the sweep afresh", path.display())]
    Row {
        /// Which file.
        path: PathBuf,
        /// Which line, from 1.
        line: usize,
        /// What is wrong with it.
        source: serde_json::Error,
    },
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

/// Reads `folder/rows.jsonl`, writes `folder/charts/*.svg`, `*.png` and `folder/README.md`, and returns the page's path.
///
/// # Errors
/// [`ReportError`]: no rows there, a line that is no row, or a file that cannot be written.
pub fn write(folder: &Path) -> Result<PathBuf, ReportError> {
    let rows = read(&folder.join("rows.jsonl"))?;
    let figures = figures::draw(&rows, &folder.join("charts"))?;
    let path = folder.join("README.md");
    let text = page::page(&rows, &figures, &heading(folder));
    write_whole(&path, text.as_bytes()).map_err(|source| ReportError::Write {
        path: path.clone(),
        source,
    })?;
    Ok(path)
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

/// Reads rows. Of rows with one key the last stands. They come sorted by what was asked, since cells that run in
/// parallel end in any order. A last line that a kill cut short is left out.
fn read(path: &Path) -> Result<Vec<Row>, ReportError> {
    let text = std::fs::read_to_string(path).map_err(|source| ReportError::Read {
        path: path.to_path_buf(),
        source,
    })?;
    let mut rows = BTreeMap::new();
    for (index, line) in text
        .split_inclusive('\n')
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty())
    {
        match serde_json::from_str::<Row>(line) {
            Ok(row) => rows.insert(row.key.clone(), row),
            Err(_) if !line.ends_with('\n') => continue,
            Err(source) => {
                let (path, line) = (path.to_path_buf(), index + 1);
                return Err(ReportError::Row { path, line, source });
            }
        };
    }
    let mut rows: Vec<Row> = rows.into_values().collect();
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
