//! Control spacing f (§2): positive, finite, α-Lipschitz.
//!
//! A SPEC ([`Spec`]) names a spacing; [`build`] makes the f that a mesher sees from it:
//!
//! 1. the function itself: [`Uniform`], [`Lfs`] (Definition 2.1), [`GeodesicLfs`] (its footnote), [`Expression`], [`Hessian`] (the
//!    nsf of §2.2) and [`Nodal`], the same for a field on an earlier mesh, [`EdgeLength`] and [`NearestNeighbour`] of an earlier
//!    mesh (§2.1), the envelope of sizes at points ([`of_samples`], §2.3), or the [`Min`] of several;
//! 2. capped by lfs, which gives the gns of §2.3, unless [`Options::lfs_cap`] is off;
//! 3. limited to the Lipschitz constant [`Options::alpha`] by [`limit`] (§2.3).
//!
//! With [`GeodesicLfs`] distances are measured inside the domain: it takes the place of lfs in 2, and [`Spacing::lipschitz`] means
//! the length of ways there. Code that relies on it in the plane must ask [`Spacing::is_geodesic`].
//!
//! [`integrate`] computes ∫_Ω dA / f², by which Lemma 5.10 and Theorem 5.11 measure meshes.

use crate::domain::Domain;
use crate::geometry::{DVec2, Rect};
use std::sync::Arc;

mod combine;
pub(crate) mod cover;
mod error;
mod expression;
mod from_mesh;
mod geodesic;
mod integral;
mod lfs;
mod limit;
mod spec;
#[cfg(test)]
pub(crate) mod testing;
mod uniform;

pub use combine::{Min, Scaled};
pub use error::SpacingError;
pub use expression::Expression;
pub use expression::grammar::GrammarError;
pub use expression::hessian::{Hessian, Tolerance};
pub use from_mesh::field::{Nodal, recovered_eigenvalues};
pub use from_mesh::measures::{EdgeLength, NearestNeighbour};

pub use geodesic::GeodesicLfs;
pub use integral::{Integral, estimate_triangles, integrate};
pub use lfs::Lfs;
pub use limit::envelope::of_samples;
pub use limit::limit;
pub use limit::limited::Limited;
pub(crate) use spec::ingredients::Ingredients;
pub use spec::{KINDS, Spec, spec_for_size};
pub use uniform::Uniform;

/// A control spacing function f.
///
/// ```
/// use biting::{Case, domain::Domain, geometry::DVec2, meshers::biting::Biting, spacing::Spacing};
///
/// /// Small at the origin, growing by 0.2 per unit of length.
/// struct Growing;
///
/// impl Spacing for Growing {
///     fn at(&self, x: DVec2) -> f64 {
///         0.05 + 0.2 * x.length()
///     }
///
///     fn lipschitz(&self) -> f64 {
///         0.2
///     }
/// }
///
/// let square = Domain::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])?;
/// let case = Case::from_spacing(square, Growing, 0.25, 0.75)?;
/// assert!(case.judge(&case.mesh(&Biting::default())?).1.holds);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Spacing: Send + Sync {
    /// f(x): finite and positive on the domain, in the length unit of the domain.
    fn at(&self, x: DVec2) -> f64;

    /// α: |f(x) − f(y)| ≤ α ‖x − y‖ for all x, y, proved for the function as evaluated, never sampled.
    /// Infinite if nothing is proved; gradient limiting makes it finite.
    fn lipschitz(&self) -> f64;

    /// Whether distances in [`Spacing::lipschitz`] are measured inside the domain: α times the length of the shortest way from x
    /// to y that stays in it, in place of ‖x − y‖. Circles must then count only for what they reach ([`GeodesicLfs`]).
    fn is_geodesic(&self) -> bool {
        false
    }

    /// Where distances are measured inside the domain: the spacing with lfs as the plane has it, nowhere above this one.
    fn in_plane(&self) -> Option<Arc<dyn Spacing>> {
        None
    }

    /// A proved lower bound of f on the closed box: by default from f at the centre and the Lipschitz constant.
    fn lower_bound(&self, cell: Rect) -> f64 {
        self.at(cell.centre()) - self.lipschitz() * 0.5 * cell.diagonal()
    }

    /// The same if f at the box's centre is known.
    fn lower_bound_from(&self, cell: Rect, _at_centre: f64) -> f64 {
        self.lower_bound(cell)
    }

    /// A proved upper bound of f on the closed box: by default from f at the centre and the Lipschitz constant.
    fn upper_bound(&self, cell: Rect) -> f64 {
        self.at(cell.centre()) + self.lipschitz() * 0.5 * cell.diagonal()
    }
}

/// How [`build`] turns a SPEC into the f that a mesher sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The Lipschitz constant that f is limited to: t / c_b. Infinite for no limiting.
    pub alpha: f64,
    /// Whether f is capped by lfs, as §5 needs. Default true.
    pub lfs_cap: bool,
    /// f is at least this share of the largest α-Lipschitz function below the capped spacing; in (0, 1). A share k of
    /// the spacing is 1/k² in triangles; the index grows with 1/(1 − k)². Default 0.9.
    pub limit_factor: f64,
}

impl Options {
    /// Defaults for given t and c_b: α = t / c_b, capped by lfs.
    pub fn new(t: f64, c_b: f64) -> Self {
        Self::with_alpha(t / c_b)
    }

    /// Defaults for a given α.
    pub fn with_alpha(alpha: f64) -> Self {
        Self {
            alpha,
            lfs_cap: true,
            limit_factor: 0.9,
        }
    }

    fn check(&self) -> Result<(), SpacingError> {
        let alpha_is_right = self.alpha > 0.0;
        let factor_is_right = self.limit_factor > 0.0 && self.limit_factor < 1.0;
        if !alpha_is_right {
            Err(SpacingError::Option {
                name: "alpha = t / c_b",
                value: self.alpha,
                range: "positive",
            })
        } else if !factor_is_right {
            Err(SpacingError::Option {
                name: "limit_factor",
                value: self.limit_factor,
                range: "between 0 and 1",
            })
        } else {
            Ok(())
        }
    }
}

/// A control spacing function f, as a mesher sees it.
#[derive(Clone)]
pub struct ControlSpacing {
    /// The SPEC in canonical form; empty for a function in code.
    pub spec: String,
    /// Whether f is nowhere above lfs.
    pub lfs_cap: bool,
    /// f.
    pub function: Arc<dyn Spacing>,
}

impl ControlSpacing {
    /// A function in code as it is, which may be above lfs: the bounds of §5 and §6 are then measured, not guaranteed.
    pub fn uncapped(function: impl Spacing + 'static) -> Self {
        Self {
            spec: String::new(),
            lfs_cap: false,
            function: Arc::new(function),
        }
    }
}

/// lfs of a domain.
///
/// # Errors
/// See [`Lfs::new`].
pub fn lfs_of(domain: &Domain) -> Result<Lfs, SpacingError> {
    let segments: Vec<[usize; 2]> = domain.segments().iter().map(|segment| [segment.a, segment.b]).collect();
    Lfs::new(domain.vertices(), &segments)
}

/// Makes the f of `spec` on `domain`: parsed, capped by lfs, limited.
///
/// # Errors
/// Everything in [`SpacingError`].
pub fn build(spec: &str, domain: &Domain, options: &Options) -> Result<ControlSpacing, SpacingError> {
    build_with(spec, domain, options, || Ok(Arc::new(lfs_of(domain)?)))
}

/// As [`build`], for callers who have the domain's `lfs` already.
///
/// # Errors
/// Everything in [`SpacingError`].
pub fn build_with(
    spec: &str,
    domain: &Domain,
    options: &Options,
    lfs: impl FnOnce() -> Result<Arc<Lfs>, SpacingError>,
) -> Result<ControlSpacing, SpacingError> {
    options.check()?;
    let parsed = Spec::parse(spec)?;
    let made = Ingredients::new(&parsed, domain, options.lfs_cap, lfs)?;
    Ok(ControlSpacing {
        spec: parsed.to_string(),
        lfs_cap: made.lfs.is_some(),
        function: limit(made.gns, domain, options.alpha, options.limit_factor)?,
    })
}

/// The same for a function in code.
///
/// # Errors
/// Everything in [`SpacingError`].
pub fn control(function: Arc<dyn Spacing>, domain: &Domain, options: &Options) -> Result<ControlSpacing, SpacingError> {
    options.check()?;
    let mut parts = vec![function];
    if options.lfs_cap {
        parts.push(Arc::new(lfs_of(domain)?));
    }
    let capped = Min::of(parts, domain.bounds());
    Ok(ControlSpacing {
        spec: String::new(),
        lfs_cap: options.lfs_cap,
        function: limit(capped, domain, options.alpha, options.limit_factor)?,
    })
}

#[cfg(test)]
mod tests;
