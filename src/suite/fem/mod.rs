//! What quality is for: a Poisson problem with known solution, solved by linear finite elements on any mesh.
//!
//! −Δu = g in the domain, u given on its whole boundary; u is a [`Problem`] in closed form, so the error is known.
//! [`solve`] goes step by step:
//!
//! 1. `system.rs`: stiffness matrix and load of the free vertices. An edge that one triangle has is on the boundary; the
//!    vertices of such edges get u itself and are eliminated, so that the matrix stays symmetric positive definite.
//! 2. `krylov.rs`: conjugate gradients preconditioned by the diagonal (Jacobi), from zero, counted until the residual has
//!    come down to [`RESIDUAL`]. These iterations, and the extreme eigenvalues, are what is measured.
//! 3. `direct.rs`: u_h by sparse Cholesky up to [`DIRECT_UNKNOWNS`] unknowns, so that its error is free of the
//!    iteration's; beyond, u_h is where conjugate gradients come to [`RESIDUAL_OF_SOLUTION`].
//! 4. `norms.rs`: energy error |u − u_h|_H1 and L2 error against the exact ∇u and u, by quadrature under error control.
//!
//! # What it says about a mesh
//! The energy error per unknown shows whether sizes follow u and whether large angles spoil interpolation; the largest
//! eigenvalue of the stiffness matrix grows like 1 / sin of the smallest angle, and explicit time steps shrink with it.
//! Jacobi hides that growth: the preconditioned matrix of linear triangles has no eigenvalue above 3, and bad triangles
//! show at the lower end, in the condition number and the iterations.
//!
//! # Limits
//! The mesh is taken as it is: whether it conforms to the domain is the certificate's question. A hanging vertex makes
//! boundary edges inside, where u would be given and the error flattered; judge such meshes first.
//!
//! # The sparse solver
//! [rsparse](https://crates.io/crates/rsparse) 1.2 (MIT by its author; the methods are those of Davis's CSparse): Cholesky
//! with approximate minimum degree ordering, pure safe Rust, no dependencies, about 4 s of CPU to build. 10⁵ unknowns
//! take 1.8 s of CPU and 130 MB, 10⁶ 61 s and 1.5 GB, hence [`DIRECT_UNKNOWNS`]; conjugate gradients run anyway and need little.
//! faer 0.24 takes 0.33 s and 6.2 s, but brings 48 crates and 220 s of CPU to every cold build, even with its default
//! features off. nalgebra-sparse 0.12 (20 crates, 59 s) has Cholesky without an ordering and advises against its use;
//! sprs 0.11 (9 crates, 23 s) leaves Cholesky to sprs-ldl, which is LGPL.
//!
//! References: G. Strang, G. Fix, "An Analysis of the Finite Element Method"; J. R. Shewchuk, "What Is a Good Linear Finite
//! Element?" (2002), for the part of angles.

use crate::mesh::Mesh;
use serde::{Deserialize, Serialize};

mod direct;
mod element;
mod krylov;
mod matrix;
mod norms;
mod problem;
mod quadrature;
mod system;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod tridiagonal;

pub use problem::{PROBLEMS, Problem};

/// Residual, relative to the right-hand side, both Euclidean, at which iterations are counted.
pub const RESIDUAL: f64 = 1e-8;

/// Residual at which conjugate gradients give u_h if there is no factorisation: four digits below [`RESIDUAL`], since the error
/// may exceed the residual by the condition number.
pub const RESIDUAL_OF_SOLUTION: f64 = 1e-12;

/// Unknowns up to which u_h comes from a factorisation: about ten seconds and 300 MB.
pub const DIRECT_UNKNOWNS: usize = 250_000;

/// Iterations after which conjugate gradients are given up. A mesh of 10⁶ good triangles needs about 2000.
pub const ITERATIONS: usize = 50_000;

/// Where u_h came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// Sparse Cholesky factorisation.
    Cholesky,
    /// Conjugate gradients, down to [`RESIDUAL_OF_SOLUTION`].
    ConjugateGradients,
}

/// The spectrum's ends, estimated. Estimates lie inside the spectrum, up to rounding.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spectrum {
    /// Largest eigenvalue of the stiffness matrix of the free vertices: 200 steps of Lanczos from a random vector, so from
    /// below, by 0.3 % at most in expectation at 10⁶ unknowns (`krylov.rs`).
    pub largest: f64,
    /// The same of D^(−1/2) A D^(−1/2), D the diagonal of A; at most 3 in exact arithmetic.
    pub largest_preconditioned: f64,
    /// Smallest eigenvalue of D^(−1/2) A D^(−1/2), from the coefficients of conjugate gradients. Iterations that have
    /// converged have seen it, unless the right-hand side has no part in its eigenvector.
    pub smallest_preconditioned: f64,
    /// `largest_preconditioned` / `smallest_preconditioned`.
    pub condition_preconditioned: f64,
}

/// What was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solution {
    /// Free vertices: those that triangles use and that are not on the boundary.
    pub unknowns: usize,
    /// |u − u_h|_H1, the L2 norm of ∇u − ∇u_h.
    pub energy_error: f64,
    /// |u|_H1.
    pub energy_norm: f64,
    /// L2 norm of u − u_h, in the domain's unit of length.
    pub l2_error: f64,
    /// L2 norm of u.
    pub l2_norm: f64,
    /// Where u_h came from.
    pub solver: Solver,
    /// Iterations of conjugate gradients to [`RESIDUAL`], or those done when they were given up.
    pub iterations: usize,
    /// Whether they reached it.
    pub converged: bool,
    /// Eigenvalues; absent without unknowns.
    pub spectrum: Option<Spectrum>,
}

/// Why there is no solution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FemError {
    /// Nothing to solve on.
    #[error("the mesh has no triangles")]
    Empty,
    /// A corner that does not exist.
    #[error("triangle {triangle} has a corner {vertex}, but there are {vertices} vertices")]
    UnknownVertex {
        /// Index of the triangle.
        triangle: usize,
        /// The corner.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A triangle without area, turned over, or with coordinates or a stiffness that are not finite.
    #[error("triangle {triangle} is turned over or degenerate: twice its area is {double_area:e}; repair the mesh")]
    Degenerate {
        /// Index of the triangle.
        triangle: usize,
        /// Twice its signed area.
        double_area: f64,
    },
    /// An edge with more than two triangles, or with two on one side.
    #[error(
        "the edge between vertices {a} and {b} has {uses} triangles, not one on each side: triangles overlap there"
    )]
    NotManifold {
        /// One end.
        a: u32,
        /// The other.
        b: u32,
        /// How many triangles have it.
        uses: u32,
    },
    /// u, ∇u or g is not finite somewhere on the domain, so an integral is not.
    #[error(
        "the known solution is not finite on this domain ({part}): its widths must be positive, its centre away from vertices"
    )]
    NotFinite {
        /// What came out infinite or not a number.
        part: &'static str,
    },
    /// The factorisation met a pivot that is not positive: rounding, in a matrix that is singular to working precision.
    #[error("the stiffness matrix of {unknowns} unknowns is singular to working precision; its triangles are too thin")]
    Singular {
        /// Size of the matrix.
        unknowns: usize,
    },
    /// Too large to factor, and conjugate gradients were given up.
    #[error(
        "conjugate gradients came to a relative residual of {residual:e} in {iterations} iterations and were given up"
    )]
    NotConverged {
        /// Iterations done.
        iterations: usize,
        /// Relative residual reached.
        residual: f64,
    },
    /// A name that is not in [`PROBLEMS`].
    #[error("problem `{name}` is unknown; there are {known}")]
    UnknownProblem {
        /// What was asked for.
        name: String,
        /// The names there are.
        known: String,
    },
}

/// Solves the problem on the mesh and measures. Equal input gives bit-equal output; one thread.
pub fn solve(mesh: &Mesh, problem: &Problem) -> Result<Solution, FemError> {
    Ok(solve_at_vertices(mesh, problem)?.0)
}

/// As [`solve`], with u_h at every vertex of the mesh too, 0 where no triangle uses it.
pub fn solve_at_vertices(mesh: &Mesh, problem: &Problem) -> Result<(Solution, Vec<f64>), FemError> {
    let elements = element::all(mesh)?;
    let system = system::assemble(mesh, &elements, problem)?;
    let mut cg = krylov::ConjugateGradients::new(&system.matrix, &system.load);
    let converged = cg.run(RESIDUAL, ITERATIONS);
    let iterations = cg.iterations();
    let spectrum = krylov::spectrum(&cg);
    let (solver, free) = if system.load.len() <= DIRECT_UNKNOWNS {
        (Solver::Cholesky, direct::solve(&system.matrix, &system.load)?)
    } else {
        (Solver::ConjugateGradients, cg.finish(RESIDUAL_OF_SOLUTION, ITERATIONS)?)
    };
    let nodal = system.at_vertices(&free);
    let norms = norms::measure(&elements, &nodal, problem)?;
    let solution = Solution {
        unknowns: free.len(),
        energy_error: norms.energy_error,
        energy_norm: norms.energy_norm,
        l2_error: norms.l2_error,
        l2_norm: norms.l2_norm,
        solver,
        iterations,
        converged,
        spectrum,
    };
    Ok((solution, nodal))
}
