//! `run.toml`: what made the tables beside it, and the plan as it was run.

use crate::suite::rows::record::Provenance;
use serde::{Deserialize, Serialize};

/// What made the tables of a folder.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunFile {
    /// The plan's text.
    pub plan: String,
    /// Who made the meshes, in the order of time: one, but where a run was resumed by other code, or lines of an earlier run stayed.
    pub made: Vec<Made>,
}

/// Code and machine that made meshes, and when.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Made {
    /// Code and machine; the date is that of the first mesh.
    #[serde(flatten)]
    pub by: Provenance,
    /// Of the last mesh, RFC 3339, UTC.
    pub until: String,
}

impl Made {
    fn is_like(&self, other: &Self) -> bool {
        let undated = |made: &Self| Provenance {
            date: String::new(),
            ..made.by.clone()
        };
        undated(self) == undated(other)
    }
}

/// Who made all that, after those who made the lines that stayed: one entry for each code and machine.
pub(super) fn made<'a>(provenances: impl Iterator<Item = &'a Provenance>, earlier: &[Made]) -> Vec<Made> {
    let now = provenances.map(|by| Made {
        by: by.clone(),
        until: by.date.clone(),
    });
    let mut all: Vec<Made> = Vec::new();
    for one in earlier.iter().cloned().chain(now) {
        match all.iter_mut().find(|known| known.is_like(&one)) {
            Some(known) => {
                // Dates of one form are in order as texts.
                known.by.date = known.by.date.clone().min(one.by.date);
                known.until = known.until.clone().max(one.until);
            }
            None => all.push(one),
        }
    }
    all.sort_by(|a, b| a.by.date.cmp(&b.by.date));
    all
}

impl RunFile {
    /// As it is written: the plan last, for it is long.
    pub(super) fn text(&self) -> String {
        toml::to_string_pretty(self).unwrap_or_default()
    }
}
