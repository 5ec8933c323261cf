//! Budgets: a mesher that exceeds one gives up with an error that says where it was.

use super::MeshError;
use crate::geometry::DVec2;
use std::time::Instant;

/// Limits that end in [`MeshError::Budget`], never in a hang.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    /// The most vertices that a mesh may have.
    pub max_vertices: Option<usize>,
    /// The most seconds that a mesher may take.
    pub max_seconds: Option<f64>,
    /// The most resident memory that the process may use, in bytes.
    pub max_memory: Option<u64>,
}

/// Holds a running mesher to its budget.
#[derive(Debug)]
pub(super) struct Monitor {
    budget: Budget,
    start: Instant,
}

/// Clock and memory are checked once in this number of vertices.
const VERTICES_BETWEEN_LOOKS: usize = 1 << 12;

impl Monitor {
    pub fn new(budget: &Budget) -> Self {
        Self {
            budget: *budget,
            start: Instant::now(),
        }
    }

    /// Called with the number of vertices so far, and with the place and size of the next one.
    pub fn placed(&self, vertices: usize, at: DVec2, size: f64) -> Result<(), MeshError> {
        // Every mesh has fewer than 2³² vertices: indices are u32.
        let most = self
            .budget
            .max_vertices
            .unwrap_or(usize::MAX)
            .min(u32::MAX as usize / 4);
        if vertices > most {
            return Err(stopped(format!("max_vertices = {most}"), vertices, at, size));
        }
        if vertices.is_multiple_of(VERTICES_BETWEEN_LOOKS) {
            self.look(vertices, at, size)
        } else {
            Ok(())
        }
    }

    /// Checks clock and memory, for work that takes long without placing vertices. Arguments as for [`Self::placed`].
    pub fn look(&self, vertices: usize, at: DVec2, size: f64) -> Result<(), MeshError> {
        let stop = |budget| Err(stopped(budget, vertices, at, size));
        match self.budget {
            Budget {
                max_seconds: Some(most),
                ..
            } if self.start.elapsed().as_secs_f64() > most => stop(format!("max_seconds = {most}")),
            Budget {
                max_memory: Some(most), ..
            } if resident_bytes().is_some_and(|bytes| bytes > most) => stop(format!("max_memory = {most} bytes")),
            _ => Ok(()),
        }
    }
}

fn stopped(budget: String, vertices: usize, at: DVec2, size: f64) -> MeshError {
    MeshError::Budget {
        budget,
        vertices,
        x: at.x,
        y: at.y,
        advice: format!("the target edge length is {size:e} there; ask for larger edges or raise the budget"),
    }
}

/// Resident memory of the process in bytes, if the system reports it (Linux).
pub(crate) fn resident_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim()
        .strip_suffix(" kB")?
        .parse::<u64>()
        .ok()
        .map(|kilobytes| kilobytes * 1024)
}
