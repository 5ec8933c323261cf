//! The target edge length s = c_b f. An f that breaks its contract is refused, and so is an s too small for the
//! coordinates to resolve.

use super::{MeshError, Request};
use crate::domain::Domain;
use crate::geometry::{DVec2, tolerance};
use crate::mesh::Mesh;
use crate::spacing::Spacing;
use std::f64::consts::SQRT_2;

/// s as every mesher evaluates it: equal work for all.
#[derive(Clone, Copy)]
pub(super) struct Sizing<'a> {
    pub spacing: &'a dyn Spacing,
    c_b: f64,
    smallest: f64,
    /// How much rounding of coordinates can add to the difference of two sizes.
    slack: f64,
}

impl<'a> Sizing<'a> {
    pub fn new(domain: &Domain, spacing: &'a dyn Spacing, request: &Request) -> Self {
        let largest_coordinate = domain.bounds().largest_coordinate();
        Self {
            spacing,
            c_b: request.c_b,
            smallest: tolerance::RESOLUTION * largest_coordinate,
            slack: request.c_b * tolerance::LOWER_BOUND * largest_coordinate,
        }
    }

    /// The smallest s allowed: coordinates do not resolve points closer than that well enough.
    pub fn smallest(&self) -> f64 {
        self.smallest
    }

    /// t = c_b · lipschitz(): s is t-Lipschitz.
    pub fn t(&self) -> f64 {
        self.c_b * self.spacing.lipschitz()
    }

    /// s(x) without checks, for points that may lie outside the domain, where f need not be positive or finite.
    pub fn unchecked(&self, x: DVec2) -> f64 {
        self.c_b * self.spacing.at(x)
    }

    /// s(x).
    pub fn at(&self, x: DVec2) -> Result<f64, MeshError> {
        let value = self.spacing.at(x);
        let size = self.c_b * value;
        if !(value > 0.0 && size.is_finite()) {
            return Err(MeshError::Spacing { value, x: x.x, y: x.y });
        }
        if size < self.smallest {
            return Err(MeshError::Declined(format!(
                "the size {size:e} at ({}, {}) is below what coordinates of this size resolve ({:e}); \
                 move the domain to the origin or ask for a larger size there",
                x.x, x.y, self.smallest
            )));
        }
        Ok(size)
    }

    /// Refuses two points whose sizes, as [`Self::at`] returned them, differ by more than a t-Lipschitz s can. Meshers
    /// call this where they rely on it: for a new vertex and those near it.
    pub fn agree(&self, points: [DVec2; 2], sizes: [f64; 2]) -> Result<(), MeshError> {
        let change = (sizes[0] - sizes[1]).abs();
        // Around a right angle the way inside the domain is longer by √2.
        let longer = if self.spacing.is_geodesic() { SQRT_2 } else { 1.0 };
        let allowed =
            longer * self.t() * points[0].distance(points[1]) + tolerance::CERTIFICATE * sizes[0].max(sizes[1]);
        if change > allowed + self.slack {
            return Err(MeshError::NotLipschitz {
                points,
                values: points.map(|x| self.spacing.at(x)),
                alpha: self.spacing.lipschitz(),
            });
        }
        Ok(())
    }

    /// [`Self::agree`] for the ends of every edge, since the search for circles nearby can miss those whose sizes do
    /// not agree.
    pub fn agree_along_edges(&self, mesh: &Mesh) -> Result<(), MeshError> {
        let sizes: Vec<f64> = mesh.points.iter().map(|&x| self.at(x)).collect::<Result<_, _>>()?;
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|corner| corner as usize);
            for (one, other) in [(a, b), (b, c), (c, a)] {
                self.agree([mesh.points[one], mesh.points[other]], [sizes[one], sizes[other]])?;
            }
        }
        Ok(())
    }
}
