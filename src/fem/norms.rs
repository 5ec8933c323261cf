//! Energy and L2 norms of u and of the error, by quadrature against the exact u and ∇u.

use super::element::Element;
use super::quadrature::Quadrature;
use super::{FemError, Problem};
use crate::mesh::Mesh;

/// Norms over the mesh.
pub(super) struct Norms {
    pub energy_error: f64,
    pub energy_norm: f64,
    pub l2_error: f64,
    pub l2_norm: f64,
}

/// The norms for the piecewise linear function with the given values at the mesh's vertices.
pub(super) fn measure(mesh: &Mesh, elements: &[Element], nodal: &[f64], problem: &Problem) -> Result<Norms, FemError> {
    debug_assert_eq!(mesh.points.len(), nodal.len());
    let quadrature = Quadrature::new();
    let mut squares = [0.0; 4];
    for element in elements {
        let values = element.vertices.map(|vertex| nodal[vertex]);
        let discrete_gradient = element.gradient(values);
        let integrals = quadrature.integrate(element.corners, element.area, &|x| {
            let weights = element.barycentric(x);
            let discrete: f64 = (0..3).map(|k| weights[k] * values[k]).sum();
            let (value, gradient) = (problem.value(x), problem.gradient(x));
            [
                (gradient - discrete_gradient).length_squared(),
                gradient.length_squared(),
                (value - discrete).powi(2),
                value.powi(2),
            ]
        });
        for (square, integral) in squares.iter_mut().zip(integrals) {
            *square += integral;
        }
    }
    let [energy_error, energy_norm, l2_error, l2_norm] = squares.map(f64::sqrt);
    if squares.iter().all(|square| square.is_finite()) {
        Ok(Norms {
            energy_error,
            energy_norm,
            l2_error,
            l2_norm,
        })
    } else {
        Err(FemError::NotFinite { part: "norms" })
    }
}
