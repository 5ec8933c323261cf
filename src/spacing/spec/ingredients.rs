//! What a spacing is made of before it is limited (§2.3): lfs if it caps, nsf if something else is asked for, and gns, the
//! smaller of the two.

use crate::domain::Domain;
use crate::geometry::Rect;
use crate::mesh::files::{self, MeshFileError};
use crate::spacing::expression::grammar::GrammarError;
use crate::spacing::from_mesh::field::Nodal;
use crate::spacing::{
    EdgeLength, Expression, GeodesicLfs, Hessian, Lfs, Min, NearestNeighbour, Scaled, Spacing, SpacingError, Spec,
    Uniform, of_samples,
};
use std::sync::Arc;

/// lfs, nsf and gns.
#[derive(Clone)]
pub struct Ingredients {
    /// What geometry alone asks for, which f is nowhere above; absent if f is not capped.
    pub lfs: Option<Arc<dyn Spacing>>,
    /// What is asked for besides lfs, if anything is.
    #[cfg_attr(not(feature = "suite"), expect(dead_code, reason = "the suite alone draws it"))]
    pub nsf: Option<Arc<dyn Spacing>>,
    /// The smaller of the two.
    pub gns: Arc<dyn Spacing>,
}

impl Ingredients {
    /// For `spec` on `domain`, capped by lfs if `lfs_cap` or `spec` says so.
    ///
    /// # Errors
    /// Everything in [`SpacingError`].
    pub fn new(
        spec: &Spec,
        domain: &Domain,
        lfs_cap: bool,
        lfs: impl FnOnce() -> Result<Arc<Lfs>, SpacingError>,
    ) -> Result<Self, SpacingError> {
        let is_capped = lfs_cap || spec.is_capped();
        let lfs: Option<Arc<dyn Spacing>> = match is_capped.then(lfs).transpose()? {
            Some(lfs) if spec.is_geodesic() => Some(Arc::new(GeodesicLfs::new(domain, lfs)?)),
            Some(lfs) => Some(lfs),
            None => None,
        };
        let (mut parts, bounds) = (Vec::new(), domain.bounds());
        collect(spec, bounds, &mut parts)?;
        let nsf = (!parts.is_empty()).then(|| Min::of(parts.clone(), bounds));
        parts.extend(lfs.clone());
        let gns = Min::of(parts, bounds);
        if gns.is_geodesic() && gns.lipschitz().is_infinite() {
            return Err(SpacingError::Geodesic {
                message: "needs the others of a min(A, B) to have a Lipschitz constant, and nothing proves one here; use lfs",
            });
        }
        Ok(Self { lfs, nsf, gns })
    }
}

/// The parts of `spec` other than lfs.
fn collect(spec: &Spec, bounds: Rect, parts: &mut Vec<Arc<dyn Spacing>>) -> Result<(), SpacingError> {
    match spec {
        Spec::Lfs | Spec::GeodesicLfs => {}
        Spec::Uniform(value) => parts.push(Arc::new(Uniform(*value))),
        Spec::Expression(text) => parts.push(Arc::new(Expression::new(text, bounds).map_err(told(text))?)),
        Spec::Hessian(text, tolerance) => {
            parts.push(Arc::new(Hessian::new(text, tolerance, bounds).map_err(told(text))?));
        }
        Spec::Field(file, tolerance) => {
            let field = on_mesh(spec, files::read_with_values(file.as_ref()), |(mesh, values)| {
                Nodal::for_field(mesh, values, tolerance, bounds)
            })?;
            parts.push(Arc::new(field));
        }
        Spec::Points { file, factor, alpha } => {
            let factor = factor.unwrap_or(1.0);
            // 1, as for lfs, unless given.
            let read = files::read_points_with_values(file.as_ref());
            let envelope = on_mesh(spec, read, |(points, values)| {
                let values: Vec<f64> = values.iter().map(|value| factor * value).collect();
                of_samples(alpha.unwrap_or(1.0), points, &values)
            })?;
            parts.push(Arc::new(envelope));
        }
        Spec::EdgeLength(file, factor) => {
            let el = on_mesh(spec, files::read(file.as_ref()), EdgeLength::new)?;
            parts.push(times(*factor, Arc::new(el)));
        }
        Spec::NearestNeighbour(file, factor) => {
            let nn = on_mesh(spec, files::read(file.as_ref()), NearestNeighbour::new)?;
            parts.push(times(*factor, Arc::new(nn)));
        }
        Spec::Min(specs) => specs.iter().try_for_each(|spec| collect(spec, bounds, parts))?,
    }
    Ok(())
}

/// The spacing that `make` makes of what was read.
fn on_mesh<M, T>(
    spec: &Spec,
    read: Result<M, MeshFileError>,
    make: impl FnOnce(&M) -> Result<T, String>,
) -> Result<T, SpacingError> {
    let made = read.map_err(|error| error.to_string()).and_then(|mesh| make(&mesh));
    made.map_err(|message| SpacingError::Mesh {
        spec: spec.to_string(),
        message,
    })
}

fn times(factor: Option<f64>, spacing: Arc<dyn Spacing>) -> Arc<dyn Spacing> {
    match factor {
        Some(factor) => Arc::new(Scaled::new(factor, spacing)),
        None => spacing,
    }
}

/// What is wrong with an expression, as an error of the spacing.
fn told(text: &str) -> impl FnOnce(GrammarError) -> SpacingError {
    |source| SpacingError::Parse {
        spec: text.to_owned(),
        column: source.column,
        message: source.message,
    }
}
