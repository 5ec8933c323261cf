//! Stiffness matrix and load of the free vertices; the boundary's values are eliminated.

use super::element::Element;
use super::matrix::Matrix;
use super::quadrature::Quadrature;
use super::{FemError, Problem};
use crate::geometry::DVec2;
use crate::mesh::{Adjacency, Mesh};

/// A x = b for the values at the free vertices.
#[derive(Debug)]
pub(super) struct System {
    /// A: ∫ ∇φ_i · ∇φ_j, symmetric positive definite.
    pub matrix: Matrix,
    /// b: ∫ g φ_i, less what the boundary's values contribute.
    pub load: Vec<f64>,
    /// The row of each vertex, none where its value is given or no triangle uses it.
    row_of: Vec<Option<u32>>,
    /// u at the vertices of the boundary, 0 elsewhere.
    given: Vec<f64>,
}

impl System {
    /// u_h at every vertex of the mesh, 0 where no triangle uses it.
    pub fn at_vertices(&self, free: &[f64]) -> Vec<f64> {
        let value = |(row, given): (&Option<u32>, &f64)| row.map_or(*given, |row| free[row as usize]);
        self.row_of.iter().zip(&self.given).map(value).collect()
    }
}

/// What a vertex is to the problem.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    Unused,
    Boundary,
    Free,
}

/// Assembles the system of the mesh.
pub(super) fn assemble(mesh: &Mesh, elements: &[Element], problem: &Problem) -> Result<System, FemError> {
    let adjacency = mesh.adjacency();
    let roles = roles(mesh.points.len(), &adjacency)?;
    let mut rows = 0;
    let mut number = |role: &Role| {
        (*role == Role::Free).then(|| {
            rows += 1;
            rows - 1
        })
    };
    let row_of: Vec<Option<u32>> = roles.iter().map(&mut number).collect();
    let given = |(role, x): (&Role, &DVec2)| match role {
        Role::Boundary => problem.value(*x),
        Role::Free | Role::Unused => 0.0,
    };
    let mut system = System {
        matrix: Matrix::zeros(&row_of, &adjacency.vertex_neighbours()),
        load: vec![0.0; rows as usize],
        given: roles.iter().zip(&mesh.points).map(given).collect(),
        row_of,
    };
    let quadrature = Quadrature::new();
    let source = |element: &Element| {
        let [part] = quadrature.magnitudes(element.corners, element.area, &|x| [problem.source(x)]);
        part
    };
    let total: f64 = elements.iter().map(source).sum();
    let area: f64 = elements.iter().map(|element| element.area).sum();
    for element in elements {
        let floor = total * (element.area / area);
        system.add(element, problem, &quadrature, floor);
    }
    // Boundary values that no free vertex feels do not reach the load, but they do reach the error.
    if system.load.iter().chain(&system.given).all(|value| value.is_finite()) {
        Ok(system)
    } else {
        Err(FemError::NotFinite { part: "load" })
    }
}

fn roles(vertices: usize, adjacency: &Adjacency) -> Result<Vec<Role>, FemError> {
    let mut roles = vec![Role::Unused; vertices];
    for edge in adjacency.edges() {
        if !edge.is_manifold() {
            let ([a, b], uses) = (edge.ends, edge.uses);
            return Err(FemError::NotManifold { a, b, uses });
        }
        for vertex in edge.ends {
            let role = &mut roles[vertex as usize];
            if edge.is_boundary() {
                *role = Role::Boundary;
            } else if *role == Role::Unused {
                *role = Role::Free;
            }
        }
    }
    Ok(roles)
}

impl System {
    /// Adds a triangle's part; the floor is the integral of |g| over a triangle that needs no digits of its own.
    fn add(&mut self, element: &Element, problem: &Problem, quadrature: &Quadrature, floor: f64) {
        let rows = element.vertices.map(|vertex| self.row_of[vertex]);
        if rows.iter().all(Option::is_none) {
            return;
        }
        let load = quadrature.integrate(element.corners, element.area, [floor; 3], &|x| {
            let source = problem.source(x);
            element.barycentric(x).map(|weight| source * weight)
        });
        for i in 0..3 {
            let Some(row) = rows[i] else { continue };
            self.load[row as usize] += load[i];
            for (j, column) in rows.into_iter().enumerate() {
                let stiffness = element.stiffness(i, j);
                match column {
                    Some(column) => self.matrix.add(row, column, stiffness),
                    None => self.load[row as usize] -= stiffness * self.given[element.vertices[j]],
                }
            }
        }
    }
}
