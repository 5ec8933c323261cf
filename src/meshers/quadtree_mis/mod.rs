//! Quadtree and maximal independent set (§4): a circle packing chosen from an oversample of circles.
//!
//! # Idea
//! Refine a quadtree until its leaves are about as large as the edges wanted there. Put more points than needed into
//! every leaf, each the centre of a circle of radius s = c_b f. Of these overlapping circles choose a maximal set, one
//! after the other, in which no circle covers the centre of one chosen later. The centres are well spaced by
//! construction. If the samples were dense, the circles leave no gap, and the Delaunay triangulation of the centres is
//! well shaped (Theorem 4.1).
//!
//! # Steps
//! 1. [`balance::balance`] makes the quadtree: each leaf's side is at most [`QuadtreeMis::leaf_side`] · s, and the
//!    sides of neighbours differ by at most a factor of two;
//! 2. [`circles::circles`]: makes the candidates on the segments; those in the leaves are made when they are examined;
//! 3. [`independent_set::independent_set`] chooses circles on the input vertices, then the edges, then the interior;
//!    with [`QuadtreeMis::complete`] it goes on sampling until no gap remains ([`complete::complete`]);
//! 4. [`triangulate`] makes the constrained Delaunay triangulation of the centres.
//!
//! # Guarantee
//! The triangulation is always constrained Delaunay (`constrained-delaunay`). With t = α c_b < 1 and, so that input
//! vertices are far enough apart, f ≤ lfs and c_b ≤ 1, these checks of the certificate hold too:
//! * no centre lies in a circle chosen before it, ‖x − y‖ ≥ c_b min(f(x), f(y)), so the packing circles of radius
//!   c_b f / (2 + t) are disjoint (Lemma 5.4, `packing-disjoint`, and `vertices-upper`, which follows);
//! * nn ≥ c_b (1 − t) f at vertices (first half of the proof of Lemma 5.7, `nn-vertex-lower`) and
//!   nn ≥ c_b f / (2 + 2t) elsewhere (second half of Lemma 5.8, `nn-point-lower`): neither proof uses coverage.
//!
//! With `complete = true` the circles of radius c_b f cover the domain (`coverage`). So the packing has the β of
//! Theorem 5.5, and `nn-vertex-upper`, `nn-point-upper` and `vertices-lower` hold. With `complete = false` these are
//! only measured, and so is the β reached.
//!
//! The angle bound of Theorem 6.8 is *not* guaranteed, even then. Lemma 6.1 (triangles seen from their circumcentres)
//! needs only packing and coverage, but §6.2 depends on how the biting method places circles along the boundary. An
//! independent set may leave a piece nearly two radii long, with a vertex arbitrarily low above its middle. The even
//! division of segments makes that rare; it happens where input angles are acute.
//!
//! # Cost
//! O(o) near-queries and O(o²) samples per leaf for o = [`QuadtreeMis::oversample`]; f is evaluated once per leaf, once
//! per vertex, and about 4 + o times per vertex on the boundary; O(n log n) for the triangulation. Tiles of leaves are
//! processed in rounds by [`Request::threads`] threads ([`tiles`]); the mesh does not depend on the number of threads.
//!
//! # Deviations from the paper (and why)
//! * §4 chooses circles of radius f / 2 that do not overlap. Here two candidates are in conflict if the circle of
//!   radius c_b f of the one chosen first covers the other. For uniform f this is the same; for graded f it is what
//!   Definition 4.1 and Lemma 5.4 need.
//! * Gaps along the segments are closed, whether `complete` or not ([`edges`]), since interior points in them would lie
//!   too near to the boundary. So all gaps of a mesh are in the interior.
//! * Candidates are ordered only within tiles of at most 4096 leaves, and tiles follow one another, so that the choice
//!   can be parallel without a conflict graph in memory. In the default order the samples are scanned row by row.
//! * Candidates are not stored: at 10⁶ triangles there would be about 10⁸ of them.
//!
//! # Reference
//! G. L. Miller, D. Talmor, S.-H. Teng, N. Walkington, "A Delaunay Based Numerical Method for Three Dimensions:
//! Generation, Formulation, and Partition", STOC 1995; the same with H. Wang, "Control Volume Meshes Using Sphere
//! Packing: Generation, Refinement and Coarsening", 5th International Meshing Roundtable, 1996.

mod balance;
mod circles;
mod complete;
mod edges;
mod independent_set;
mod interior;
#[cfg(test)]
mod tests;
mod tiles;

pub use circles::Sampling;
pub use independent_set::{Order, Packing};

use super::sizing::Sizing;
use super::{Entry, MeshError, Mesher, Monitor, Parameter, Request, Trace, from_parameters, within};
use crate::delaunay::triangulate;
use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::spacing::Spacing;
use crate::theory::{Claim, Guarantee};
use serde::{Deserialize, Serialize};

/// The method and its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct QuadtreeMis {
    /// Samples per side of a leaf, and candidates per part of a segment's even division, 2 to 64. Default 8: each
    /// doubling from 2 to 8 makes the packing about a tenth denser and the gaps less than half as wide. It costs
    /// little, since most rows of samples are covered before they are examined. 16 takes twice the time for a packing a
    /// twentieth denser.
    pub oversample: u32,
    /// Where the samples are in their squares.
    pub sampling: Sampling,
    /// The order in which candidates are considered.
    pub order: Order,
    /// Longest side of a leaf over s = c_b f in it, 1/64 to 1; sides are between half of that and that. Default 1:
    /// "until the leaf is about f". Smaller leaves have the effect of more samples, but each costs a search for the
    /// circles around it.
    pub leaf_side: f64,
    /// Whether to go on sampling where gaps remain, until none is left.
    pub complete: bool,
}

impl Default for QuadtreeMis {
    fn default() -> Self {
        Self {
            oversample: 8,
            sampling: Sampling::default(),
            order: Order::default(),
            leaf_side: 1.0,
            complete: false,
        }
    }
}

pub(super) const ENTRY: Entry = Entry {
    name: "quadtree-mis",
    summary: "maximal independent set of circles on an oversampled quadtree (Miller, Talmor, Teng, Walkington)",
    parameters: &[
        Parameter {
            name: "oversample",
            values: "2 to 64",
            default: "8",
            help: "samples per side of a leaf; the default is where denser samples stop paying",
        },
        Parameter {
            name: "sampling",
            values: "regular, jittered",
            default: "regular",
            help: "samples in the middle of their squares, or anywhere in them by seed",
        },
        Parameter {
            name: "order",
            values: "insertion, degree, spacing, random",
            default: "insertion",
            help: "which candidate is considered first (open in §4): row by row, fewest conflicts, smallest spacing, by seed",
        },
        Parameter {
            name: "leaf_side",
            values: "1/64 to 1",
            default: "1.0",
            help: "longest side of a leaf of the quadtree over s = c_b f",
        },
        Parameter {
            name: "complete",
            values: "true, false",
            default: "false",
            help: "whether to go on sampling where gaps remain, until none is left",
        },
    ],
    make: from_parameters::<QuadtreeMis>,
};

/// The data that all steps share.
struct Field<'a> {
    mesher: &'a QuadtreeMis,
    domain: &'a Domain,
    sizing: Sizing<'a>,
    monitor: Monitor,
    seed: u64,
    threads: usize,
}

impl QuadtreeMis {
    fn field<'a>(
        &'a self,
        domain: &'a Domain,
        spacing: &'a dyn Spacing,
        request: &Request,
    ) -> Result<Field<'a>, MeshError> {
        self.check().map_err(MeshError::Declined)?;
        let sizing = Sizing::new(domain, spacing, request);
        let t = sizing.t();
        if t.is_nan() || t >= 1.0 {
            return Err(MeshError::Declined(format!(
                "quadtree-mis needs t = alpha c_b below 1, and here it is {t}; limit the spacing's gradient (--t)"
            )));
        }
        Ok(Field {
            mesher: self,
            domain,
            sizing,
            monitor: Monitor::new(&request.budget),
            seed: request.seed,
            threads: request.threads,
        })
    }

    /// Steps 1 to 3: the circles, without the triangulation of their centres.
    pub fn pack(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Packing, MeshError> {
        let field = self.field(domain, spacing, request)?;
        let tree = trace.step("balance", || balance::balance(&field))?;
        let candidates = trace.step("circles", || circles::circles(&field))?;
        let packing = trace.step("independent_set", || {
            independent_set::independent_set(&field, &tree, candidates)
        })?;
        packing.note(trace);
        Ok(packing)
    }
}

/// Smallest side of a leaf over s: far below that, only the work grows.
const LEAST_LEAF_SIDE: f64 = 1.0 / 64.0;

impl Mesher for QuadtreeMis {
    fn guarantees(&self) -> Vec<Guarantee> {
        let of_packing = [
            Claim::ConstrainedDelaunay,
            Claim::PackingDisjoint,
            Claim::NnVertexLower,
            Claim::NnPointLower,
            Claim::VerticesUpper,
        ];
        let of_cover = [
            Claim::Coverage,
            Claim::NnVertexUpper,
            Claim::NnPointUpper,
            Claim::VerticesLower,
        ];
        let of_cover = of_cover.into_iter().filter(|_| self.complete);
        of_packing.into_iter().chain(of_cover).map(Guarantee::always).collect()
    }

    fn check(&self) -> Result<(), String> {
        within(&[
            ("oversample", f64::from(self.oversample), 2.0, 64.0),
            ("leaf_side", self.leaf_side, LEAST_LEAF_SIDE, 1.0),
        ])
    }

    fn mesh(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Mesh, MeshError> {
        super::refuse_geodesic(spacing)?;
        let Packing { centres, pieces, .. } = self.pack(domain, spacing, request, trace)?;
        let mesh = trace.step("triangulate", || triangulate(domain, centres, pieces))?;
        Sizing::new(domain, spacing, request).agree_along_edges(&mesh)?;
        Ok(mesh)
    }
}
