//! A page in which a reader steps through the biting.

use std::path::{Path, PathBuf};

/// Writes the replay of biting `domain` into `folder`, and returns its path.
pub fn write(_folder: &Path, _domain: &str) -> Result<PathBuf, String> {
    Err("no replay is written yet".into())
}
