//! Adaptation (§2.2, last paragraph): from mesh to mesh, each by the spacing that the error on the one before asks for.
//!
//! # Steps of a round
//! 1. Mesh by the spacing so far, limited to α = t / c_b.
//! 2. Solve the Poisson problem on it, or sample u at its vertices.
//! 3. Recover the Hessian at the vertices ([`recovered_eigenvalues`]).
//! 4. The error of linear interpolation for edges as long as nn of the old mesh is |λ|max nn² / 6 (`spacing/hessian.rs`). Times
//!    the factor √(eps / error) the edges have the error eps: under 1 it refines, over 1 it coarsens, by no more than
//!    [`MOST`] a round, since values on a coarse mesh are not to be believed further.
//! 5. The new spacing has nn times the factor over c_b at the old vertices, is linear between them ([`Nodal`]) and capped by
//!    lfs: so edges of the next mesh, c_b f, are what the factor asks for.
//!
//! Rounds end when the spacing has settled ([`SETTLED`], [`SETTLED_SHARE`], [`STILL_FINER`]), or after as many as are asked for.
//!
//! # Deviation from the paper
//! Li et al. coarsen by a maximal independent set of the old points and add new ones beside it. Biting places every point
//! where circles on its front meet, which is what its bounds rest on; points that are there before have no circles to be
//! on. So the next mesh is bitten afresh, with its full certificate, and what the independent set would have kept is
//! measured beside it: [`Round::independent`] old points are pairwise farther apart than packing circles of radius c_b f / 2
//! reach, and [`Round::kept`] of the new mesh's points are old points.
//!
//! # Reference
//! X.-Y. Li, S.-H. Teng, A. Üngör, "Simultaneous refinement and coarsening: adaptive meshing with moving boundaries",
//! 7th International Meshing Roundtable, 1998.

use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::near::{Disc, DiscGrid};
use crate::mesh::Mesh;
use crate::meshers::{Budget, Request};
use crate::spacing::{Lfs, Min, NearestNeighbour, Nodal, Spacing, Tolerance, limit, recovered_eigenvalues};
use crate::suite::fem::{self, Problem, Solution};
use crate::suite::rows::adapted::{Adapt, Round};
use crate::suite::rows::record::Cell;
use crate::suite::run::runner::mesher;
use rustc_hash::FxHashSet;

use std::sync::Arc;

/// A round makes edges at most so many times longer or shorter.
pub const MOST: f64 = 4.0;

/// A vertex has settled where the next spacing is within this share of the last one.
pub const SETTLED: f64 = 0.1;

/// The spacing has settled when this share of the vertices has.
pub const SETTLED_SHARE: f64 = 0.95;

/// The spacing has not settled while any vertex asks for less than this share of the last one: a corner has few vertices.
pub const STILL_FINER: f64 = 0.5;

/// No spacing is smaller than this share of the longer side of the domain's box. Less than for a formula, since here a
/// singularity has a finite recovered Hessian, and coming down to a point costs few vertices.
const SMALLEST: f64 = 1e-6;

/// No round makes more vertices than this: what its eps asks for is then too fine.
const MOST_VERTICES: usize = 2_000_000;

/// How far a round may go.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// [`crate::spacing::Options::limit_factor`].
    pub factor: f64,
    /// Most vertices of its mesh, two millions by default.
    pub vertices: Option<usize>,
}

/// Why there is no spacing to end with.
#[derive(Clone, Debug, PartialEq)]
pub struct Ended {
    /// In words.
    pub reason: String,
    /// Whether a mesh reached the most vertices.
    pub is_budget: bool,
}

impl From<String> for Ended {
    fn from(reason: String) -> Self {
        let is_budget = false;
        Self { reason, is_budget }
    }
}

/// The spacing that adaptation ends with, capped by `lfs` if there is one, but not limited, and the rounds to it from `start`.
///
/// # Errors
/// The round, and why it ended without a spacing.
pub fn run(
    domain: &Domain,
    lfs: Option<Arc<Lfs>>,
    start: Arc<dyn Spacing>,
    cell: &Cell,
    limits: Limits,
) -> Result<(Arc<dyn Spacing>, Vec<Round>), Ended> {
    let adapt = cell.adapt.ok_or_else(|| "no adaptation is asked for".to_owned())?;
    adapt.check()?;
    let name = cell
        .poisson
        .as_deref()
        .ok_or_else(|| "adaptation needs a problem with a known u".to_owned())?;
    let problem = Problem::named(name, domain.bounds()).map_err(|error| error.to_string())?;
    let loops = Loop {
        domain,
        lfs,
        problem,
        cell,
        adapt,
        limits,
    };
    let mut spacing = start;
    let mut limited = loops.limited(spacing.clone())?;
    let mut rounds: Vec<Round> = Vec::new();
    let mut before = FxHashSet::default();
    for number in 1..=adapt.rounds {
        let told = |reason: String| format!("round {number} of adaptation: {reason}");
        let mesh = loops.mesh(&*limited).map_err(|ended| Ended {
            reason: told(ended.reason),
            ..ended
        })?;
        let (solution, values) = loops.values(&mesh).map_err(told)?;
        spacing = loops.next(&mesh, &values).map_err(told)?;
        let next = loops.limited(spacing.clone()).map_err(told)?;
        let round = loops.round(&mesh, &solution, [&*limited, &*next], &before);
        rounds.push(round);
        (limited, before) = (next, mesh.points.iter().map(bits).collect());
        if round.settled >= SETTLED_SHARE && round.least_change >= STILL_FINER {
            break;
        }
    }
    Ok((spacing, rounds))
}

fn bits(point: &DVec2) -> [u64; 2] {
    point.to_array().map(f64::to_bits)
}

/// What all rounds share.
struct Loop<'a> {
    domain: &'a Domain,
    lfs: Option<Arc<Lfs>>,
    problem: Problem,
    cell: &'a Cell,
    adapt: Adapt,
    limits: Limits,
}

impl Loop<'_> {
    fn limited(&self, spacing: Arc<dyn Spacing>) -> Result<Arc<dyn Spacing>, String> {
        let alpha = self.cell.t / self.cell.c_b;
        limit(spacing, self.domain, alpha, self.limits.factor).map_err(|error| error.to_string())
    }

    fn mesh(&self, spacing: &dyn Spacing) -> Result<Mesh, Ended> {
        let mesher = mesher(self.cell)?;
        let request = Request {
            c_b: self.cell.c_b,
            seed: self.cell.seed,
            threads: self.cell.threads,
            budget: Budget {
                max_vertices: Some(self.limits.vertices.unwrap_or(MOST_VERTICES)),
                ..Budget::default()
            },
        };
        let mesh = mesher.mesh(self.domain, spacing, &request);
        mesh.map_err(|error| Ended {
            reason: error.to_string(),
            is_budget: error.is_budget(),
        })
    }

    /// The solution on the mesh, and what stands for u at its vertices.
    fn values(&self, mesh: &Mesh) -> Result<(Solution, Vec<f64>), String> {
        let solved = fem::solve_at_vertices(mesh, &self.problem).map_err(|error| error.to_string())?;
        Ok(match self.adapt.sample {
            true => (solved.0, mesh.points.iter().map(|&x| self.problem.value(x)).collect()),
            false => solved,
        })
    }

    /// The spacing for the next mesh, not yet limited.
    fn next(&self, mesh: &Mesh, values: &[f64]) -> Result<Arc<dyn Spacing>, String> {
        let bounds = self.domain.bounds();
        let tolerance = Tolerance {
            eps: self.adapt.eps,
            min: Some(SMALLEST * bounds.size().max_element()),
            max: None,
        };
        let eigenvalues = recovered_eigenvalues(mesh, values)?;
        let nn = NearestNeighbour::new(mesh)?;
        let wanted = |(&x, eigenvalue): (&DVec2, f64)| {
            let old = nn.at(x);
            // The length with the error eps over the old one is √(eps / error).
            let factor = tolerance.length(eigenvalue, bounds) / old;
            old * factor.clamp(1.0 / MOST, MOST) / self.cell.c_b
        };
        let wanted: Vec<f64> = mesh.points.iter().zip(eigenvalues).map(wanted).collect();
        let mut parts: Vec<Arc<dyn Spacing>> = vec![Arc::new(Nodal::new(mesh, &wanted)?)];
        parts.extend(self.lfs.clone().map(|lfs| lfs as Arc<dyn Spacing>));
        Ok(Min::of(parts, bounds))
    }

    fn round(
        &self,
        mesh: &Mesh,
        solution: &Solution,
        [last, next]: [&dyn Spacing; 2],
        before: &FxHashSet<[u64; 2]>,
    ) -> Round {
        let changes: Vec<f64> = mesh.points.iter().map(|&x| next.at(x) / last.at(x)).collect();
        let settled = changes.iter().filter(|change| (*change - 1.0).abs() <= SETTLED).count();
        Round {
            vertices: mesh.points.len(),
            triangles: mesh.triangles.len(),
            l2_error: solution.l2_error / solution.l2_norm,
            energy_error: solution.energy_error / solution.energy_norm,
            settled: settled as f64 / mesh.points.len() as f64,
            least_change: changes.into_iter().fold(f64::INFINITY, f64::min),
            independent: independent(&mesh.points, next, self.cell.c_b).len(),
            kept: mesh.points.iter().filter(|point| before.contains(&bits(point))).count(),
        }
    }
}

/// A maximal set of the points whose packing circles B(x, c_b f(x) / 2) do not meet, as indices: the points in their order,
/// which has the domain's own vertices first, as far as those before leave room.
pub fn independent(points: &[DVec2], spacing: &dyn Spacing, c_b: f64) -> Vec<usize> {
    let mut kept = Vec::new();
    let mut grid = DiscGrid::new((0.5 * c_b * spacing.lipschitz()).min(0.99));
    let mut near = Vec::new();
    for (k, &centre) in points.iter().enumerate() {
        let radius = 0.5 * c_b * spacing.at(centre);
        grid.meeting(centre, radius, &mut near);
        if near.is_empty() {
            grid.insert(Disc { centre, radius });
            kept.push(k);
        }
    }
    kept
}

#[cfg(test)]
mod tests;
