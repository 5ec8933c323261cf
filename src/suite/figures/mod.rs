//! The paper's figures from real runs, those of the study, and a replay of a run.
//!
//! A figure is one file: it finds its instance among runs of biting, as a struct of the quantities the paper names; picture,
//! caption and numbers are made from that struct. [`FIGURES`] lists them all; command line, table and tests iterate it.

mod drawing;
mod edge;
mod figure1;
mod figure2;
mod figure3;
mod figure4;
mod figure5;
mod front;
pub(crate) mod labels;
mod page;
mod run;
mod study;
#[cfg(test)]
mod tests;
pub(crate) mod tolerance;

use crate::suite::analysis::results::Results;
use crate::suite::files::write_whole;
use drawing::{Drawing, Picture};
use run::Run;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// A figure of the list.
pub struct Entry {
    /// Name of its files, and on the command line.
    pub name: &'static str,
    /// What it shows, in a line.
    pub title: &'static str,
    draw: fn(&Material) -> Result<Drawing<'_>, String>,
}

/// Every figure, in the order of the table.
pub static FIGURES: &[Entry] = &[
    Entry {
        name: "figure1",
        title: "Figure 1: the biting scheme, step by step",
        draw: |_| Ok(figure1::find()?.drawing()),
    },
    Entry {
        name: "figure2",
        title: "Figure 2: edge protection",
        draw: |material| Ok(figure2::find(material.runs())?.drawing()),
    },
    Entry {
        name: "figure3",
        title: "Figure 3: biting, packing and extended circles",
        draw: |material| Ok(figure3::find(material.runs())?.drawing()),
    },
    Entry {
        name: "figure4",
        title: "Figure 4: triangles of the first and the second subset",
        draw: |material| Ok(figure4::find(material.runs())?.drawing()),
    },
    Entry {
        name: "figure5",
        title: "Figure 5: biting circles on the boundary",
        draw: |material| Ok(figure5::find(material.runs())?.drawing()),
    },
    Entry {
        name: "study-angle",
        title: "Study: smallest angles against the bound of Theorem 6.8",
        draw: study::angle,
    },
    Entry {
        name: "study-size",
        title: "Study: size of the mesh against t and c_b",
        draw: study::size,
    },
    Entry {
        name: "study-time",
        title: "Study: time a triangle against size",
        draw: study::time,
    },
    Entry {
        name: "study-meshers",
        title: "Study: one domain by every mesher",
        draw: study::meshers,
    },
    Entry {
        name: "study-spacing",
        title: "Study: where geometry and where the solution decides (§2)",
        draw: study::spacing,
    },
];

/// The experiment whose rows the figures of the study show.
const SWEEP: &str = "sweep";

/// What figures are made from, made once and only where one needs it.
struct Material {
    /// The folder of results.
    results: PathBuf,
    runs: OnceLock<Vec<Run>>,
    sweep: OnceLock<Result<Results, String>>,
}

impl Material {
    fn new(results: &Path) -> Self {
        Self {
            results: results.to_path_buf(),
            runs: OnceLock::new(),
            sweep: OnceLock::new(),
        }
    }

    /// The runs that figures 2 to 5 are found in.
    fn runs(&self) -> &[Run] {
        self.runs.get_or_init(run::searched)
    }

    /// The results of the sweep.
    fn sweep(&self) -> Result<&Results, String> {
        let read = || {
            let folder = self.results.join(SWEEP);
            Results::read(&folder).map_err(|error| {
                format!(
                    "{error}; the figures of the study are drawn from a sweep: run this where {} is, name its folder by --results, \
                     or draw only others by --only",
                    folder.display()
                )
            })
        };
        self.sweep.get_or_init(read).as_ref().map_err(Clone::clone)
    }
}

/// Draws all figures, or those whose name begins with `only`, into `folder/figures` from runs and from the rows under `results`;
/// writes `folder/README.md`, the table of all; and returns what was written.
///
/// # Errors
/// A message: no figure of that name, rows that cannot be read, a file that cannot be written.
pub fn write(folder: &Path, results: &Path, only: Option<&str>) -> Result<Vec<PathBuf>, String> {
    let wanted = |entry: &&Entry| only.is_none_or(|only| entry.name.starts_with(only));
    let entries: Vec<&Entry> = FIGURES.iter().filter(wanted).collect();
    if entries.is_empty() {
        let names: Vec<&str> = FIGURES.iter().map(|entry| entry.name).collect();
        return Err(format!(
            "no figure is called {}; there are {}",
            only.unwrap_or_default(),
            names.join(", ")
        ));
    }
    let material = Material::new(results);
    let mut written = Vec::new();
    for entry in entries {
        let drawing = (entry.draw)(&material).map_err(|error| format!("{}: {error}", entry.name))?;
        written.extend(write_one(entry, &drawing, &folder.join("figures"))?);
    }
    let path = folder.join("README.md");
    save(&path, &page::readme(FIGURES))?;
    written.push(path);
    Ok(written)
}

/// Writes the files of one figure.
fn write_one(entry: &Entry, drawing: &Drawing, folder: &Path) -> Result<Vec<PathBuf>, String> {
    let stem = folder.join(entry.name);
    match &drawing.picture {
        Picture::Sheet(sheet) => sheet.write(&stem),
        Picture::Chart(draw) => draw(&stem),
    }
    .map_err(|error| {
        let source = std::error::Error::source(&error).map(|source| format!(": {source}"));
        format!("{error}{}", source.unwrap_or_default())
    })?;
    save(&stem.with_extension("json"), &page::numbers(drawing))?;
    save(&stem.with_extension("md"), &page::caption(entry, drawing))?;
    Ok(["svg", "png", "json", "md"]
        .iter()
        .map(|ending| stem.with_extension(ending))
        .collect())
}

fn save(path: &Path, text: &str) -> Result<(), String> {
    write_whole(path, text.as_bytes()).map_err(|error| format!("could not write {}: {error}", path.display()))
}
