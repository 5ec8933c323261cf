//! A replay: one page in which a reader steps through the biting, forward and back, or lets it run.
//!
//! # Parts
//! * [`record`](mod@record) runs biting through a [`Trace`] that notes every bite, and turns what it noted into a
//!   [`Recording`]: columns of whole numbers, small enough to stand in the page;
//! * [`labels`](crate::suite::figures::labels) finds p₁ and p₂ of the paper's labels B(p₁) and M(p₁, p₂);
//! * [`outline`] has what is drawn besides circles: rings of the domain, the first front, corners cut off, and what a circle
//!   cannot see;
//! * `page.html`, `replay.css` and the scripts `state.js` (what is so after k bites, and why: functions without side
//!   effects), `words.js` (that in words), `layers.js` and `drawing.js` (the picture), `pointer.js`, `panel.js` and
//!   `controls.js` are joined to one file that needs no other.

mod outline;
mod record;
#[cfg(test)]
mod tests;

use record::Recording;

use crate::meshers::{Budget, MeshError, Request, Trace};
use crate::suite::files::write_whole;
use crate::suite::peers::AnyMesher;
use crate::suite::rows::record::Cell;
use crate::suite::run::prepare::Store;
use crate::suite::run::runner;
use crate::theory::Rule;
use std::path::{Path, PathBuf};

/// Most bites: a page of more would be larger than about 3 MB, and no longer play smoothly.
pub const MOST_BITES: usize = 20_000;

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("replay.css");
const SCRIPTS: [&str; 7] = [
    include_str!("state.js"),
    include_str!("words.js"),
    include_str!("layers.js"),
    include_str!("drawing.js"),
    include_str!("pointer.js"),
    include_str!("panel.js"),
    include_str!("controls.js"),
];

/// Why there is no replay.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {
    /// The domain, the spacing or a parameter is not right, or the page cannot be written.
    #[error("{0}")]
    Input(String),
    /// Biting did not finish.
    #[error("{0}; a replay has at most {MOST_BITES} bites: ask for a larger spacing, t or c_b")]
    Mesh(#[from] MeshError),
}

/// Writes the replay of `cell`, which names biting as its mesher, into `folder` and returns its path.
///
/// # Errors
/// [`ReplayError`].
pub fn write(folder: &Path, cell: &Cell) -> Result<PathBuf, ReplayError> {
    let recording = recording(cell)?;
    let path = folder.join(format!("replay-{}.html", recording.about.domain));
    let page = page(&recording).map_err(ReplayError::Input)?;
    write_whole(&path, page.as_bytes())
        .map_err(|error| ReplayError::Input(format!("cannot write {}: {error}", path.display())))?;
    Ok(path)
}

/// Bites as `cell` asks, and records it.
fn recording(cell: &Cell) -> Result<Recording, ReplayError> {
    let input = |error: &dyn std::fmt::Display| ReplayError::Input(error.to_string());
    let AnyMesher::Ours(mesher) = runner::mesher(cell).map_err(ReplayError::Input)? else {
        return Err(ReplayError::Input(record::no_bites(cell)));
    };
    if mesher.rule() == Rule::Later {
        let told = "a replay draws circles that bite, and by rule=later points eat what is no circle; leave out rule";
        return Err(ReplayError::Input(told.into()));
    }
    let store = Store::new(None, false);
    let prepared = store.prepare_for_t(cell).map_err(|error| input(&error))?;
    let request = Request {
        seed: cell.seed,
        threads: cell.threads,
        budget: Budget {
            max_vertices: Some(MOST_BITES),
            ..Budget::default()
        },
        ..Request::new(cell.c_b)
    };
    let mut trace = Trace::noting_bites();
    let mesh = prepared.case(cell.c_b).mesh_as(&*mesher, &request, &mut trace)?;
    let bites = trace.bites.unwrap_or_default();
    record::record(cell, &prepared, &mesh, &bites).map_err(ReplayError::Input)
}

/// The page of a recording. Equal recordings give equal pages, byte by byte.
fn page(recording: &Recording) -> Result<String, String> {
    let data = serde_json::to_string(recording).map_err(|error| error.to_string())?;
    // Only strings can hold this character, and JSON reads the escape too: no text of ours can end the element it is in.
    let data = data.replace('<', "\\u003c");
    let script = SCRIPTS.join("\n");
    let mut rest = PAGE;
    let mut page = String::with_capacity(data.len() + script.len() + PAGE.len() + STYLE.len());
    for (mark, part) in [("{{style}}", STYLE), ("{{data}}", &data), ("{{script}}", &script)] {
        let (before, after) = rest.split_once(mark).ok_or_else(|| format!("page.html lacks {mark}"))?;
        page += before;
        page += part.trim_end();
        rest = after;
    }
    Ok(page + rest)
}
