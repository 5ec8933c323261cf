//! Energy and L2 norms of u and of the error, by quadrature against the exact u and ∇u.

use super::element::Element;
use super::quadrature::Quadrature;
use super::{FemError, Problem};
use crate::geometry::DVec2;

/// Norms over the mesh.
pub(super) struct Norms {
    pub energy_error: f64,
    pub energy_norm: f64,
    pub l2_error: f64,
    pub l2_norm: f64,
}

/// Squares of errors below this part of the squares of u itself are rounding.
const ROUNDING: f64 = 1e-20;

/// The norms for the piecewise linear function with the given values at the mesh's vertices.
pub(super) fn measure(elements: &[Element], nodal: &[f64], problem: &Problem) -> Result<Norms, FemError> {
    let quadrature = Quadrature::new();
    let mut density = [0.0; 4];
    for element in elements {
        let part = quadrature.magnitudes(element.corners, element.area, &integrands(element, nodal, problem));
        add(&mut density, part);
    }
    let area: f64 = elements.iter().map(|element| element.area).sum();
    let [energy_error, energy, l2_error, l2] = density.map(|total| total / area);
    let floor = [
        energy_error.max(ROUNDING * energy),
        energy,
        l2_error.max(ROUNDING * l2),
        l2,
    ];
    let mut squares = [0.0; 4];
    for element in elements {
        let f = integrands(element, nodal, problem);
        let floor = floor.map(|density| density * element.area);
        add(
            &mut squares,
            quadrature.integrate(element.corners, element.area, floor, &f),
        );
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

fn add(total: &mut [f64; 4], part: [f64; 4]) {
    for (total, part) in total.iter_mut().zip(part) {
        *total += part;
    }
}

/// Squares of ∇(u − u_h), ∇u, u − u_h and u on a triangle.
fn integrands(element: &Element, nodal: &[f64], problem: &Problem) -> impl Fn(DVec2) -> [f64; 4] {
    let values = element.vertices.map(|vertex| nodal[vertex]);
    let discrete_gradient = element.gradient(values);
    move |x| {
        let weights = element.barycentric(x);
        let discrete: f64 = (0..3).map(|k| weights[k] * values[k]).sum();
        let (value, gradient) = (problem.value(x), problem.gradient(x));
        [
            (gradient - discrete_gradient).length_squared(),
            gradient.length_squared(),
            (value - discrete).powi(2),
            value.powi(2),
        ]
    }
}
