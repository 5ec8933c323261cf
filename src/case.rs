//! This domain, this f, this c_b: what a mesher meshes, and by what its mesh is judged.

use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::meshers::{MeshError, Mesher, Request, Trace};
use crate::quality::{self, Bounds, Certificate, Statistics};
use crate::spacing::{self, ControlSpacing, Integral, Options, Spacing, SpacingError};
use crate::theory::{Claim, Rule};
use std::sync::Arc;

/// A domain with the f and the c_b by which to mesh it.
///
/// ```
/// use biting::{Case, domain::Domain, meshers::biting::Biting};
///
/// let domain = Domain::polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])?;
/// let case = Case::new(domain, "lfs", 0.25, 0.75)?;
/// let mesh = case.mesh(&Biting::default())?;
/// let (statistics, certificate) = case.judge_of(&mesh, &Biting::default());
/// assert!(certificate.holds && statistics.min_angle_deg > 14.4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Case {
    /// The domain to mesh.
    pub domain: Arc<Domain>,
    /// f as a mesher sees it.
    pub spacing: ControlSpacing,
    /// Biting constant: the target edge length at x is c_b f(x).
    pub c_b: f64,
    /// ∫ dA / f², if it is known: without it the certificate has no bounds on the number of vertices.
    pub integral: Option<Integral>,
}

impl Case {
    /// A case with the spacing that a SPEC names ([`spacing::Spec`]), capped by lfs and limited to α = t / c_b.
    ///
    /// # Errors
    /// [`SpacingError`].
    pub fn new(domain: impl Into<Arc<Domain>>, spec: &str, t: f64, c_b: f64) -> Result<Self, SpacingError> {
        Self::with(domain, spec, c_b, &Options::new(t, c_b))
    }

    /// The same, with the spacing made by `options`.
    ///
    /// # Errors
    /// [`SpacingError`].
    pub fn with(domain: impl Into<Arc<Domain>>, spec: &str, c_b: f64, options: &Options) -> Result<Self, SpacingError> {
        let domain = domain.into();
        let spacing = spacing::build(spec, &domain, options)?;
        Ok(Self::of(domain, spacing, c_b))
    }

    /// A case with a size function in code, capped by lfs and limited to α = t / c_b as that of a SPEC would be.
    ///
    /// # Errors
    /// [`SpacingError`] if `function` is not positive, or nothing bounds its slope.
    pub fn from_spacing(
        domain: impl Into<Arc<Domain>>,
        function: impl Spacing + 'static,
        t: f64,
        c_b: f64,
    ) -> Result<Self, SpacingError> {
        let domain = domain.into();
        let spacing = spacing::control(Arc::new(function), &domain, &Options::new(t, c_b))?;
        Ok(Self::of(domain, spacing, c_b))
    }

    /// A case with a spacing that meshers see as it is, without a cap or a limit.
    pub fn of(domain: impl Into<Arc<Domain>>, spacing: ControlSpacing, c_b: f64) -> Self {
        Self {
            domain: domain.into(),
            spacing,
            c_b,
            integral: None,
        }
    }

    /// The same case with ∫ dA / f², to a relative error of about `error`.
    ///
    /// # Errors
    /// [`SpacingError`].
    pub fn integrated(self, error: f64) -> Result<Self, SpacingError> {
        let integral = spacing::integrate(&*self.spacing.function, &self.domain, error)?;
        Ok(Self {
            integral: Some(integral),
            ..self
        })
    }

    /// The effective t: c_b times the proved Lipschitz constant of f.
    pub fn t(&self) -> f64 {
        self.c_b * self.spacing.function.lipschitz()
    }

    /// The request of [`Case::mesh`]: this c_b, seed 0, one thread, no budget.
    pub fn request(&self) -> Request {
        Request::new(self.c_b)
    }

    /// The mesh that `mesher` makes.
    ///
    /// # Errors
    /// [`MeshError`].
    pub fn mesh(&self, mesher: &dyn Mesher) -> Result<Mesh, MeshError> {
        self.mesh_as(mesher, &self.request(), &mut Trace::default())
    }

    /// The same with another seed, more threads or a budget, and a trace. The c_b is the case's.
    ///
    /// # Errors
    /// [`MeshError`].
    pub fn mesh_as(&self, mesher: &dyn Mesher, request: &Request, trace: &mut Trace) -> Result<Mesh, MeshError> {
        let request = Request {
            c_b: self.c_b,
            ..*request
        };
        mesher.mesh(&self.domain, &*self.spacing.function, &request, trace)
    }

    /// Judges a mesh from anywhere: its structure must be right, the paper's bounds are only measured.
    pub fn judge(&self, mesh: &Mesh) -> (Statistics, Certificate) {
        self.held_to(mesh, Rule::Earlier, &[])
    }

    /// Judges a mesh that `mesher` made, by what that guarantees here.
    pub fn judge_of(&self, mesh: &Mesh, mesher: &dyn Mesher) -> (Statistics, Certificate) {
        self.held_to(mesh, mesher.rule(), &self.guaranteed(mesher))
    }

    /// The claims that `mesher` guarantees for this case; the paper's among them are guaranteed if their hypotheses
    /// hold.
    pub fn guaranteed(&self, mesher: &dyn Mesher) -> Vec<Claim> {
        let is_plain = quality::hypotheses(&self.domain, &self.bounds(mesher.rule(), &[]), 0).is_plain();
        let guarantees = mesher.guarantees().into_iter();
        let here = guarantees.filter(|guarantee| is_plain || !guarantee.plain);
        here.map(|guarantee| guarantee.claim).collect()
    }

    fn held_to(&self, mesh: &Mesh, rule: Rule, guaranteed: &[Claim]) -> (Statistics, Certificate) {
        quality::judge(&self.domain, mesh, Some(&self.bounds(rule, guaranteed)))
    }

    fn bounds<'a>(&'a self, rule: Rule, guaranteed: &'a [Claim]) -> Bounds<'a> {
        Bounds {
            spacing: &*self.spacing.function,
            c_b: self.c_b,
            rule,
            lfs_cap: self.spacing.lfs_cap,
            integral: self.integral,
            guaranteed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::gallery;
    use crate::meshers::biting::{Biting, Corners, HeadOn};
    use crate::spacing::{Expression, Uniform};

    fn domain(name: &str) -> Domain {
        gallery::domain(name).expect("a name").expect("a domain")
    }

    #[test]
    fn a_spec_and_the_same_function_in_code_make_the_same_mesh() {
        let by_spec = Case::new(domain("l-shape"), "expr:0.1 + x", 0.25, 0.75).expect("a case");
        let function = Expression::new("0.1 + x", by_spec.domain.bounds()).expect("an expression");
        let in_code = Case::from_spacing(domain("l-shape"), function, 0.25, 0.75).expect("a case");
        let meshes = [&by_spec, &in_code].map(|case| case.mesh(&Biting::default()).expect("a mesh"));
        assert_eq!(meshes[0], meshes[1]);
        assert!(by_spec.spacing.lfs_cap && in_code.spacing.lfs_cap);
        assert!(in_code.t() <= 0.25 && in_code.spacing.function.lipschitz() <= 1.0 / 3.0);
    }

    #[test]
    fn what_is_guaranteed_depends_on_method_and_case() {
        let to_the_letter = Biting {
            corners: Corners::Bite,
            head_on: HeadOn::Leave,
            ..Biting::default()
        };
        for (name, t, c_b, is_plain) in [
            ("l-shape", 0.25, 0.75, true),
            ("l-shape", 0.3, 0.75, false),
            ("star", 0.25, 0.75, false),
        ] {
            let case = Case::new(domain(name), "lfs", t, c_b).expect("a case");
            let has = |mesher: &Biting| case.guaranteed(mesher).contains(&Claim::Coverage);
            assert_eq!(has(&Biting::default()), is_plain, "{name} {t} {c_b}");
            assert!(has(&to_the_letter));
        }
    }

    #[test]
    fn a_mesh_from_anywhere_is_held_to_its_structure_alone() {
        let fine = Case::of(domain("unit-square"), ControlSpacing::uncapped(Uniform(0.1)), 1.0);
        let coarse = Case::of(domain("unit-square"), ControlSpacing::uncapped(Uniform(0.02)), 1.0);
        let coarse = coarse.integrated(1e-3).expect("an integral");
        let mesh = fine.mesh(&Biting::default()).expect("a mesh");
        let (_, certificate) = coarse.judge(&mesh);
        let coverage = certificate.check(Claim::Coverage).expect("a check");
        assert!(certificate.holds && !coverage.holds && !coverage.applies);
        assert!(certificate.check(Claim::VerticesLower).is_some());
        let (_, certificate) = coarse.judge_of(&mesh, &Biting::default());
        assert!(
            !certificate.holds,
            "biting at that spacing would have covered the square"
        );
    }
}
