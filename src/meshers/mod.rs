//! The trait [`Mesher`], what it is asked ([`Request`]) and how it answers, and the list of all meshers.

use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::spacing::Spacing;
use std::time::{Duration, Instant};

pub mod biting;

/// Limits that end in [`MeshError::Budget`], never in a hang.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    /// Most vertices a mesh may have.
    pub max_vertices: Option<usize>,
    /// Most seconds a mesher may take.
    pub max_seconds: Option<f64>,
    /// Most memory of the process, in bytes.
    pub max_memory: Option<u64>,
}

/// What is asked of a mesher besides domain and spacing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// Biting constant: the target edge length at x is c_b f(x).
    pub c_b: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// Threads a mesher may use; the mesh does not depend on it.
    pub threads: usize,
    /// Where to give up.
    pub budget: Budget,
}

/// Why there is no mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// A budget ran out.
    #[error("stopped by {budget} after {vertices} vertices near ({x}, {y}): {advice}")]
    Budget {
        /// Which budget, with its value.
        budget: String,
        /// Vertices placed by then.
        vertices: usize,
        /// Where work was going on.
        x: f64,
        /// Where work was going on.
        y: f64,
        /// What to do.
        advice: String,
    },
    /// The spacing broke its promise at a point.
    #[error("spacing is {value} at ({x}, {y}): it must be finite and positive there")]
    Spacing {
        /// What it returned.
        value: f64,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// The method cannot take this input, and why.
    #[error("declined: {0}")]
    Declined(String),
    /// The points could not be triangulated.
    #[error(transparent)]
    Triangulation(#[from] crate::delaunay::TriangulationError),
}

/// Times the steps of a run by the paper's names and can carry snapshots for figures.
#[derive(Debug, Default)]
pub struct Trace {
    /// Steps in the order they ran.
    pub steps: Vec<(&'static str, Duration)>,
    /// Counts a mesher reports beside its mesh, such as bites or forced pieces.
    pub counts: Vec<(&'static str, f64)>,
}

impl Trace {
    /// Runs `work` as the step `name`.
    pub fn step<T>(&mut self, name: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.steps.push((name, start.elapsed()));
        result
    }

    /// Notes a count.
    pub fn count(&mut self, name: &'static str, value: f64) {
        self.counts.push((name, value));
    }
}

/// A mesh generator: a struct of its paper's parameters.
pub trait Mesher: Send + Sync {
    /// Meshes `domain` with edges of about c_b f. Equal input gives bit-equal output.
    fn mesh(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Mesh, MeshError>;
}
