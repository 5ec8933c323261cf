//! The paper's figures from real runs, and a replay of a run.

pub mod replay;

use std::path::{Path, PathBuf};

/// Draws all figures, or those whose name begins with `only`, into `folder`, and returns what was written.
pub fn write(_folder: &Path, _only: Option<&str>) -> Result<Vec<PathBuf>, String> {
    Err("no figure is drawn yet".into())
}
