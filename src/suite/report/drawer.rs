//! The charts and pictures of a page, drawn into one folder.

use crate::suite::run::prepare::Store;
use std::path::{Path, PathBuf};

/// A chart or picture of the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Chart {
    /// Its files are `charts/NAME.png` and, of a chart, `charts/NAME.svg`.
    pub(super) name: String,
    /// What it shows, for who cannot see it.
    pub(super) title: String,
    /// One line that says what is to be seen.
    pub(super) caption: String,
    /// Whether it is a picture of meshes, which has no SVG.
    pub(super) is_picture: bool,
}

/// Keeps the list of what was drawn.
pub(super) struct Drawer {
    folder: PathBuf,
    charts: Vec<Chart>,
    /// Domains and spacings, for pictures whose meshes are made again.
    pub(super) store: Store,
}

impl Drawer {
    /// Nothing drawn yet.
    pub(super) fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            charts: Vec::new(),
            store: Store::new(None, false),
        }
    }

    /// Where the next chart goes, without ending.
    pub(super) fn chart(&mut self, name: &str, caption: &str) -> PathBuf {
        self.charts.push(Chart {
            name: name.to_owned(),
            title: caption.to_owned(),
            caption: caption.to_owned(),
            is_picture: false,
        });
        self.folder.join(name)
    }

    /// Where the next picture goes, with its ending.
    pub(super) fn picture(&mut self, name: &str, title: &str, caption: &str) -> PathBuf {
        self.charts.push(Chart {
            name: name.to_owned(),
            title: title.to_owned(),
            caption: caption.to_owned(),
            is_picture: true,
        });
        self.file(name)
    }

    /// Where a picture goes that is not on the page.
    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.png"))
    }

    /// What was drawn since this was last asked.
    pub(super) fn take(&mut self) -> Vec<Chart> {
        std::mem::take(&mut self.charts)
    }
}
