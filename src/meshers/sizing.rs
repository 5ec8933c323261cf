//! The target edge length s = c_b f, refused where f breaks its promise or coordinates cannot resolve it.

use super::{MeshError, Request};
use crate::domain::Domain;
use crate::geometry::{DVec2, tolerance};
use crate::spacing::Spacing;

/// s as every mesher asks for it: equal work for all.
#[derive(Clone, Copy)]
pub(super) struct Sizing<'a> {
    pub spacing: &'a dyn Spacing,
    c_b: f64,
    smallest: f64,
}

impl<'a> Sizing<'a> {
    pub fn new(domain: &Domain, spacing: &'a dyn Spacing, request: &Request) -> Self {
        Self {
            spacing,
            c_b: request.c_b,
            smallest: tolerance::RESOLUTION * domain.bounds().largest_coordinate(),
        }
    }

    /// The smallest s there may be: points closer than that cannot be told apart well enough.
    pub fn smallest(&self) -> f64 {
        self.smallest
    }

    /// t = c_b · lipschitz(): s is t-Lipschitz.
    pub fn t(&self) -> f64 {
        self.c_b * self.spacing.lipschitz()
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
}
