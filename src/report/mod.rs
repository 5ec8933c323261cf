//! Pages made from the rows alone.
//!
//! [`write`] reads `rows.jsonl` of a results folder and writes `README.md` and `charts/` beside it. The same rows give
//! the same bytes, in whatever order they were written.

mod findings;
mod markdown;
mod page;

#[cfg(test)]
mod fixture;

use crate::charts::{self, ChartError};
use crate::experiment::record::Row;
use crate::experiment::series::{order_groups, time_series};
use crate::experiment::summary::Grid;
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

/// A chart of the page.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Figure {
    /// Its files are `charts/NAME.svg` and `charts/NAME.png`.
    name: &'static str,
    /// One line that says what is to be seen.
    caption: &'static str,
}

/// Reads `folder/rows.jsonl`, writes `folder/charts/*.svg`, `*.png` and `folder/README.md`, and returns the page's path.
///
/// # Errors
/// [`ReportError`]: no rows there, a line that is no row, or a file that cannot be written.
pub fn write(folder: &Path) -> Result<PathBuf, ReportError> {
    let rows = read(&folder.join("rows.jsonl"))?;
    let figures = draw(&rows, &folder.join("charts"))?;
    let path = folder.join("README.md");
    let text = page::page(&rows, &figures);
    write_whole(&path, text.as_bytes()).map_err(|source| ReportError::Write {
        path: path.clone(),
        source,
    })?;
    Ok(path)
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

/// Draws every chart the rows have numbers for.
fn draw(rows: &[Row], folder: &Path) -> Result<Vec<Figure>, ChartError> {
    let mut figures = Vec::new();
    let mut add = |name, caption, drawn: &dyn Fn(&Path) -> Result<(), ChartError>| {
        figures.push(Figure { name, caption });
        drawn(&folder.join(name))
    };
    let grids = findings::grids(rows);
    let all = Grid::of(rows.iter().filter(|row| row.group == "grid"));
    if all.reports().next().is_some() {
        add(
            "angle-against-t",
            "Smallest angle of each mesh against t, with the bound of Theorem 6.8.",
            &|stem| charts::smallest_angle(&all, stem),
        )?;
        add("size-heat", "Triangles over ∫dA/f², median over domains.", &|stem| {
            charts::heat_map(&grids, charts::SIZE_RATIO, stem)
        })?;
        add(
            "size-against-t",
            "Triangles over ∫dA/f² against t, median over domains.",
            &|stem| charts::against_t(&grids, charts::SIZE_RATIO, stem),
        )?;
        let lfs = &grids[..1];
        add(
            "size-lfs-heat",
            "Triangles over ∫dA/lfs², median over domains.",
            &|stem| charts::heat_map(lfs, charts::SIZE_RATIO_LFS, stem),
        )?;
        add(
            "size-lfs-against-t",
            "Triangles over ∫dA/lfs² against t, median over domains.",
            &|stem| charts::against_t(lfs, charts::SIZE_RATIO_LFS, stem),
        )?;
        add("efficiency", "Size efficiency of each mesh against t / c_b.", &|stem| {
            charts::efficiency(&grids, stem)
        })?;
    }
    let ordered: Vec<&Row> = rows.iter().filter(|row| row.group == "orders").collect();
    let groups = order_groups(&ordered);
    if groups.iter().any(|group| !group.reports.is_empty()) {
        add(
            "orders",
            "Orders of bites: median over domains, and the range from the least to the most.",
            &|stem| charts::orders(&groups, stem),
        )?;
    }
    let timed: Vec<&Row> = rows.iter().filter(|row| row.group == "time").collect();
    let series = time_series(&timed);
    if !series.is_empty() {
        add("time", "Seconds against triangles, whole and by step.", &|stem| {
            charts::time(&series, stem)
        })?;
    }
    Ok(figures)
}
