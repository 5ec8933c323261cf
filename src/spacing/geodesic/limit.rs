//! The limited spacing: the larger of two limited functions. One is the limited lfs of the plane
//! ([`crate::spacing::limit`]). The other is linear on each triangle of a mesh of the domain, with no gradient longer than α.
//!
//! # Guarantee
//! * Each is α-Lipschitz in the length d of ways inside Ω, and so is the larger of the two (Lemma 2.3). The first is in the
//!   plane; the other changes along a way by at most α times its length, triangle by triangle.
//! * Each is at most f on Ω: the first since lfs is, the other as follows. Let g_i be f at the corners p_i of a triangle and
//!   λ the Lipschitz constant of f. At a point x = Σ w_i p_i of the triangle, f(x) ≥ Σ w_i (g_i − λ ‖x − p_i‖), and Σ w_i ‖x
//!   − p_i‖ ≤ (Σ w_i ‖x − p_i‖²)^½ ≤ D, the radius of the smallest circle around the triangle: R² − ‖x − c‖² is what the sum
//!   of squares is, with the circumcentre c and radius R. So values of at most f − λ D for all triangles at a vertex are low
//!   enough, and lowering them further ([`Slopes::limit`]) does no harm.
//! * It is positive, as no value falls below the smallest of them.
//!
//! # How near the largest α-Lipschitz function it comes
//! It is nowhere below the limited lfs. Where the other function could be above that by more than a share 1 − k, k being
//! [`crate::spacing::Options::limit_factor`], its triangles are halved until λ D is at most a share 1 − k of the spacing at
//! vertices where it is not limited, and α D elsewhere. That proves no factor, since functions that are linear on triangles
//! cannot follow the cones and creases of the largest one. On `two-arms`, `comb`, `star` and `l-shape` it was nowhere below 0.45
//! of an upper bound of the largest, and asked for at most 1.4 times the triangles in all (the tests check both).
//!
//! # Cost
//! It takes about ten times as long to prepare as lfs: 10 s in place of 1 s for the 3601 segments of `aegean`.

use crate::delaunay::triangulate;
use crate::domain::Domain;
use crate::geometry::{DVec2, Rect};
use crate::mesh::{Mesh, Piece};
use crate::spacing::from_mesh::old_mesh::OldMesh;
use crate::spacing::geodesic::cones;
use crate::spacing::geodesic::slopes::Slopes;
use crate::spacing::{Spacing, SpacingError};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// In every triangle f varies by at most this share of its value.
const COARSEST: f64 = 0.5;

/// Most vertices of the mesh.
const MOST: usize = 2_000_000;

/// At most this number of triangles in a thousand that are to be halved are not worth another round.
const FEW: usize = 5;

/// A value counts as lowered if it is less than this share of what it was.
const LOWERED: f64 = 0.97;

/// A spacing limited by distances inside the domain.
#[derive(Clone)]
pub struct GeodesicLimited {
    mesh: OldMesh,
    values: Vec<f64>,
    alpha: f64,
    /// The limited lfs of the plane.
    plane: Arc<dyn Spacing>,
}

/// A function at most `function` on Ω and `alpha`-Lipschitz in the length of ways inside Ω.
///
/// # Errors
/// [`SpacingError::NotPositive`] if `function` is not, [`SpacingError::TooManyCells`] if it is so small that the mesh would
/// have too many triangles, [`SpacingError::Triangulation`].
pub fn limit(
    function: &dyn Spacing,
    domain: &Domain,
    alpha: f64,
    factor: f64,
) -> Result<GeodesicLimited, SpacingError> {
    let in_plane = function.in_plane().ok_or(SpacingError::Geodesic {
        message: "has been limited already; limit it once",
    })?;
    let mut refinement = Refinement {
        domain,
        function,
        plane: crate::spacing::limit(in_plane, domain, alpha, factor)?,
        in_plane: Vec::new(),
        slope: function.lipschitz(),
        values: Vec::new(),
        mesh: Mesh {
            points: domain.vertices().to_vec(),
            pieces: Piece::chains(domain, (0..domain.segments().len()).map(|_| Vec::new())),
            ..Mesh::default()
        },
    };
    loop {
        refinement.triangulate()?;
        let coarse = refinement.coarse();
        if !coarse.is_empty() {
            refinement.split(&coarse, alpha)?;
            continue;
        }
        let (values, coarse) = refinement.limited(alpha, 1.0 - factor);
        if coarse.len() <= FEW * refinement.mesh.triangles.len() / 1000 {
            return GeodesicLimited::new(&refinement.mesh, &values, alpha, refinement.plane);
        }
        refinement.split(&coarse, alpha)?;
    }
}

/// The mesh as it is refined.
struct Refinement<'a> {
    domain: &'a Domain,
    function: &'a dyn Spacing,
    /// The limited lfs of the plane, and its values at the vertices.
    plane: Arc<dyn Spacing>,
    in_plane: Vec<f64>,
    /// The function's Lipschitz constant.
    slope: f64,
    mesh: Mesh,
    /// The function at the vertices.
    values: Vec<f64>,
}

impl Refinement<'_> {
    /// Triangulates the points, and evaluates the function at new ones.
    fn triangulate(&mut self) -> Result<(), SpacingError> {
        let Mesh { points, pieces, .. } = std::mem::take(&mut self.mesh);
        self.mesh = triangulate(self.domain, points, pieces)?;
        let new = &self.mesh.points[self.values.len()..];
        let values: Vec<f64> = new.par_iter().map(|&x| self.function.at(x)).collect();
        if let Some(k) = values.iter().position(|&value| !(value > 0.0 && value.is_finite())) {
            let (value, [x, y]) = (values[k], new[k].to_array());
            return Err(SpacingError::NotPositive { value, x, y });
        }
        self.in_plane.par_extend(new.par_iter().map(|&x| self.plane.at(x)));
        self.values.extend(values);
        Ok(())
    }

    /// By how much the function may vary in a triangle: λ D.
    fn variation(&self, t: usize) -> f64 {
        self.slope * enclosing_radius(self.mesh.corners(t))
    }

    /// The triangles in which the function may vary by more than a share of its smallest value at the corners; each
    /// with how many times that is too much.
    fn coarse(&self) -> Vec<(usize, f64)> {
        let excess = |t: usize| self.variation(t) / (COARSEST * self.lowest(t, &self.values));
        self.exceeding(excess)
    }

    fn exceeding(&self, excess: impl Fn(usize) -> f64) -> Vec<(usize, f64)> {
        let all = (0..self.mesh.triangles.len()).map(|t| (t, excess(t)));
        all.filter(|&(_, excess)| excess > 1.0).collect()
    }

    fn lowest(&self, t: usize, values: &[f64]) -> f64 {
        let values = self.mesh.triangles[t].map(|v| values[v as usize]);
        values.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// The limited values, and the triangles that must be smaller for the values to come nearer to the largest possible: those
    /// at vertices where more than `share` is missing, if α D is more than `share` of the value, or λ D at a vertex that was not
    /// lowered.
    fn limited(&self, alpha: f64, share: f64) -> (Vec<f64>, Vec<(usize, f64)>) {
        let mut largest = vec![0.0f64; self.values.len()];
        for (t, corners) in self.mesh.triangles.iter().enumerate() {
            let variation = self.variation(t);
            for v in corners.map(|v| v as usize) {
                largest[v] = largest[v].max(variation);
            }
        }
        let start: Vec<f64> = self.values.iter().zip(&largest).map(|(value, by)| value - by).collect();
        let mut slopes = Slopes {
            points: &self.mesh.points,
            triangles: &self.mesh.triangles,
            values: cones::lowest(self.domain, &self.mesh, &start, alpha),
        };
        slopes.limit(alpha, &start);
        let values = slopes.values;
        let stays = |v: u32| values[v as usize] >= LOWERED * start[v as usize];
        let largest = cones::lowest(self.domain, &self.mesh, &self.values, alpha);
        let is_missing = |v: u32| {
            let v = v as usize;
            values[v].max(self.in_plane[v]) < (1.0 - share) * largest[v]
        };
        let coarse = self.exceeding(|t| {
            let corners = self.mesh.triangles[t];
            if !corners.into_iter().any(is_missing) {
                return 0.0;
            }
            let steepness = if corners.into_iter().any(stays) {
                1.0
            } else {
                alpha / self.slope
            };
            steepness * self.variation(t) / (share * self.lowest(t, &values))
        });
        (values, coarse)
    }

    /// Puts points in the middle of edges: of the longest edge of each triangle, and of all its long ones if it is far too
    /// large.
    fn split(&mut self, triangles: &[(usize, f64)], alpha: f64) -> Result<(), SpacingError> {
        let mut edges: Vec<[u32; 2]> = Vec::new();
        for &(t, excess) in triangles {
            let [a, b, c] = self.mesh.triangles[t];
            let sides = [[a, b], [b, c], [c, a]];
            let length = |side: [u32; 2]| {
                let [p, q] = side.map(|v| self.mesh.points[v as usize]);
                p.distance(q)
            };
            let longest = sides.into_iter().map(length).fold(0.0, f64::max);
            let least = if excess > 2.0 { 0.5 * longest } else { longest };
            let long = sides.into_iter().filter(|&side| length(side) >= least);
            edges.extend(long.map(|[v, w]| [v.min(w), v.max(w)]));
        }
        edges.sort_unstable();
        edges.dedup();
        let piece_of: FxHashMap<[u32; 2], usize> = (self.mesh.pieces.iter())
            .zip(0..)
            .map(|(piece, k)| ([piece.a.min(piece.b), piece.a.max(piece.b)], k))
            .collect();
        for ends in edges {
            let [p, q] = ends.map(|v| self.mesh.points[v as usize]);
            let (middle, new) = (p.midpoint(q), self.mesh.points.len() as u32);
            if middle == p || middle == q || self.mesh.points.len() >= MOST {
                return Err(SpacingError::TooManyCells {
                    cells: MOST,
                    alpha,
                    x: middle.x,
                    y: middle.y,
                });
            }
            self.mesh.points.push(middle);
            if let Some(&k) = piece_of.get(&ends) {
                let piece = self.mesh.pieces[k];
                self.mesh.pieces[k].b = new;
                self.mesh.pieces.push(Piece { a: new, ..piece });
            }
        }
        Ok(())
    }
}

/// The radius of the smallest circle around a triangle: half the longest edge if the angle opposite is obtuse.
fn enclosing_radius([a, b, c]: [DVec2; 3]) -> f64 {
    let mut squares = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
    squares.sort_by(f64::total_cmp);
    if squares[0] + squares[1] <= squares[2] {
        return 0.5 * squares[2].sqrt();
    }
    let twice_area = (b - a).perp_dot(c - a).abs();
    squares.map(f64::sqrt).iter().product::<f64>() / (2.0 * twice_area)
}

impl GeodesicLimited {
    fn new(mesh: &Mesh, values: &[f64], alpha: f64, plane: Arc<dyn Spacing>) -> Result<Self, SpacingError> {
        let (mesh, kept) = OldMesh::new(mesh).map_err(|message| SpacingError::Mesh {
            spec: "lfs:geodesic".to_owned(),
            message,
        })?;
        Ok(Self {
            values: kept.into_iter().map(|v| values[v]).collect(),
            mesh,
            alpha,
            plane,
        })
    }

    fn in_triangle(&self, t: usize, x: DVec2) -> f64 {
        let [a, b, c] = self.mesh.corners(t);
        let [u, v, w] = self.mesh.triangles[t].map(|k| self.values[k as usize]);
        let area = (b - a).perp_dot(c - a);
        let (second, third) = ((x - a).perp_dot(c - a) / area, (b - a).perp_dot(x - a) / area);
        u + (v - u) * second + (w - u) * third
    }

    fn over(&self, cell: Rect, start: f64, choose: impl Fn(f64, f64) -> f64) -> f64 {
        let mut chosen = start;
        self.mesh.deciding(cell, |t, _| {
            let values = self.mesh.triangles[t].map(|k| self.values[k as usize]);
            chosen = values.into_iter().fold(chosen, &choose);
        });
        chosen
    }
}

impl Spacing for GeodesicLimited {
    fn at(&self, x: DVec2) -> f64 {
        let mut value = f64::INFINITY;
        self.mesh.holding(x, |t, at| value = value.min(self.in_triangle(t, at)));
        value.max(self.plane.at(x))
    }

    fn lipschitz(&self) -> f64 {
        self.alpha
    }

    fn is_geodesic(&self) -> bool {
        true
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        // Rounding in the interpolation.
        let linear = (1.0 - 1e-12) * self.over(cell, f64::INFINITY, f64::min);
        linear.max(self.plane.lower_bound(cell))
    }

    fn upper_bound(&self, cell: Rect) -> f64 {
        let linear = (1.0 + 1e-12) * self.over(cell, 0.0, f64::max);
        linear.max(self.plane.upper_bound(cell))
    }
}
