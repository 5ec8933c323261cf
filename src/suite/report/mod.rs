//! Pages made from rows.
//!
//! [`write()`] reads the tables of a results folder and writes `README.md` and `charts/` beside it. The same rows give
//! the same bytes, in whatever order they were written.

mod adaptation;
mod angle;
mod certificate;
mod corners;
mod drawer;
mod duels;
mod fewest;
mod frontier;
pub(crate) mod markdown;
mod meshes;
mod methods;
mod orders;
mod oversampling;
mod page;
mod peers;
mod poisson;
mod quote;
mod ranks;
mod rules;
mod seams;
mod sections;
mod size;
mod standings;
mod tally;
mod tasks;
mod threads;
mod time;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;

pub use quote::quote;

use crate::suite::analysis::results::{Results, ResultsError};
use crate::suite::charts::ChartError;
use crate::suite::files::write_whole;
use crate::suite::run::plan::Section;
use drawer::{Chart, Drawer};
use sections::Entry;
use std::path::{Path, PathBuf};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// Plan or tables could not be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
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

/// Reads the tables of a folder; writes
/// `folder/charts/*.svg`, `*.png` and `folder/README.md`, and returns the page's path.
///
/// # Errors
/// [`ReportError`]: no tables there, a line that cannot be read, or a file that cannot be written.
pub fn write(folder: &Path) -> Result<PathBuf, ReportError> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let results = read(folder)?;
    let text = page::page(&results, &draw(&results, folder)?, &name);
    let path = folder.join("README.md");
    write_whole(&path, text.as_bytes()).map_err(|source| ReportError::Write {
        path: path.clone(),
        source,
    })?;
    Ok(path)
}

/// Draws the charts of every section.
fn draw(results: &Results, folder: &Path) -> Result<Vec<(Section, Vec<Chart>)>, ReportError> {
    let mut drawer = Drawer::new(&folder.join("charts"));
    let mut drawn = Vec::new();
    for &section in results.sections.keys() {
        (Entry::of(section).charts)(results, &mut drawer)?;
        drawn.push((section, drawer.take()));
    }
    Ok(drawn)
}

/// The findings that answer the question of an experiment, each a sentence of at most 25 words.
///
/// # Errors
/// [`ReportError`]: results that cannot be read.
pub fn headline(folder: &Path) -> Result<Vec<String>, ReportError> {
    Ok(page::headline(&read(folder)?))
}

/// The results in a folder.
fn read(folder: &Path) -> Result<Results, ReportError> {
    Ok(Results::read(folder)?)
}
