//! What several checks need to know of a mesh, computed once.

use super::boundary::Boundary;
use super::discs::DiscTree;
use super::protection::Heights;
use super::reached::Reached;
use super::tally::Tally;
use super::{Bounds, Check, hypotheses, parallel, shape};
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::tolerance::CERTIFICATE;
use crate::mesh::{Adjacency, Mesh};
use crate::theory::{Claim, Hypotheses, Promises, packing_constant};

/// A mesh under judgement.
pub struct Subject<'a> {
    pub domain: &'a Domain,
    pub mesh: &'a Mesh,
    pub adjacency: Adjacency,
    pub boundary: Boundary,
    /// For each mesh vertex, the smallest angle in degrees that opens into the domain there, if it is an input vertex
    /// with one under 60°; else infinite.
    acute: Vec<f64>,
    /// How many triangles touch such a vertex.
    pub excused: usize,
    /// The spacing and what is computed from it, if there is one.
    pub sizes: Option<Sizes<'a>>,
}

/// The spacing, and what is computed from it at the mesh.
pub struct Sizes<'a> {
    pub bounds: Bounds<'a>,
    pub hypotheses: Hypotheses,
    /// f at each mesh vertex.
    pub at_vertex: Vec<f64>,
    /// f at the midpoint of each edge.
    pub at_midpoint: Vec<f64>,
    /// Each triangle's circumcentre with f there, if it lies in the domain.
    pub circumcentres: Vec<Option<(DVec2, f64)>>,
    /// The biting circles, enlarged by [`CERTIFICATE`].
    pub circles: DiscTree,
    /// What circles reach inside the domain, if distances are measured there.
    pub reached: Option<Reached>,
    /// Distance from each mesh vertex to the nearest other one.
    pub nn: Vec<f64>,
    /// How high the circles of neighbouring boundary vertices meet.
    pub heights: Heights,
}

impl<'a> Subject<'a> {
    /// Prepares a mesh from anywhere.
    pub fn new(domain: &'a Domain, mesh: &'a Mesh, bounds: Option<&Bounds<'a>>) -> Self {
        let adjacency = mesh.adjacency();
        let boundary = Boundary::find(domain, mesh, &adjacency);
        let mut acute = vec![f64::INFINITY; mesh.points.len()];
        for &v in domain.acute_vertices() {
            if let Some(k) = boundary.vertex[v] {
                let inside = domain.wedges(v).iter().filter(|wedge| wedge.inside);
                acute[k as usize] = inside
                    .map(|wedge| wedge.angle.to_degrees())
                    .fold(f64::INFINITY, f64::min);
            }
        }
        let excused = mesh
            .triangles
            .iter()
            .filter(|triangle| triangle.iter().any(|k| acute[*k as usize].is_finite()))
            .count();
        let sizes = bounds.map(|bounds| Sizes::new(domain, mesh, &adjacency, &boundary, *bounds));
        Self {
            domain,
            mesh,
            adjacency,
            boundary,
            acute,
            excused,
            sizes,
        }
    }

    /// Whether triangle `t` touches a vertex with an acute input angle.
    pub fn is_excused(&self, t: usize) -> bool {
        self.input_angle_deg(t).is_some()
    }

    /// The smallest input angle at the vertices of triangle `t` that have one under 60°, if any has.
    pub fn input_angle_deg(&self, t: usize) -> Option<f64> {
        let angles = self.mesh.triangles[t].iter().map(|k| self.acute[*k as usize]);
        let smallest = angles.fold(f64::INFINITY, f64::min);
        smallest.is_finite().then_some(smallest)
    }

    /// The largest coordinate of the mesh by magnitude.
    pub fn largest_coordinate(&self) -> f64 {
        let largest = |p: &DVec2| p.abs().max_element();
        self.mesh.points.iter().map(largest).fold(0.0, f64::max)
    }

    /// The middle of edge `e` of the adjacency.
    pub fn midpoint(&self, e: usize) -> DVec2 {
        midpoint(self.mesh, &self.adjacency, e)
    }
}

fn midpoint(mesh: &Mesh, adjacency: &Adjacency, e: usize) -> DVec2 {
    let [a, b] = adjacency.edges()[e].ends.map(|k| mesh.points[k as usize]);
    a.midpoint(b)
}

fn second_nearest(circles: &DiscTree, reached: Option<&Reached>, x: DVec2) -> f64 {
    let nearest = circles.second_nearest(x);
    reached.map_or(nearest, |reached| reached.second_nearest(circles, x, nearest))
}

impl<'a> Sizes<'a> {
    fn new(domain: &Domain, mesh: &Mesh, adjacency: &Adjacency, boundary: &Boundary, bounds: Bounds<'a>) -> Self {
        let at = |x: DVec2| bounds.spacing.at(x);
        let at_vertex = parallel::map(mesh.points.len(), |k| at(mesh.points[k]));
        let at_midpoint = parallel::map(adjacency.edges().len(), |e| at(midpoint(mesh, adjacency, e)));
        let circumcentres = parallel::map(mesh.triangles.len(), |triangle| {
            let centre = shape::circumcentre(mesh.corners(triangle));
            (centre.is_finite() && domain.contains(centre)).then(|| (centre, at(centre)))
        });
        let radius = |f: &f64| bounds.c_b * f * (1.0 + CERTIFICATE);
        let circles = DiscTree::new(mesh.points.iter().copied().zip(at_vertex.iter().map(radius)));
        let reached = (bounds.spacing.is_geodesic()).then(|| Reached::new(domain, &circles));
        let nn = parallel::map(mesh.points.len(), |k| {
            second_nearest(&circles, reached.as_ref(), mesh.points[k])
        });
        let heights = Heights::measure(domain, mesh, adjacency, boundary, &bounds, &at_vertex);
        Self {
            bounds,
            hypotheses: hypotheses(domain, &bounds, heights.low_head_on),
            at_vertex,
            at_midpoint,
            circumcentres,
            circles,
            reached,
            nn,
            heights,
        }
    }

    /// Distance from `x` to the second nearest mesh vertex; if distances are measured inside the domain, the radius with which
    /// a disc reaches two.
    pub fn second_nearest(&self, x: DVec2) -> f64 {
        second_nearest(&self.circles, self.reached.as_ref(), x)
    }

    /// Whether the circle of a vertex counts at a point `x` that it holds.
    pub fn counts(&self, id: u32, x: DVec2) -> bool {
        self.reached.as_ref().is_none_or(|reached| reached.counts(id, x))
    }

    /// t as the checks use it.
    pub fn t(&self) -> f64 {
        self.hypotheses.t
    }

    /// The bounds for this rule and t.
    pub fn promises(&self) -> Promises {
        Promises {
            rule: self.bounds.rule,
            t: self.t(),
        }
    }

    /// Whether the method guarantees a claim and the claim's hypotheses hold.
    pub fn applies(&self, claim: Claim) -> bool {
        self.bounds.guaranteed.contains(&claim) && self.hypotheses.imply(claim)
    }

    /// The check of a claim about the spacing, from a tally.
    pub fn check(&self, tally: Tally, claim: Claim, bound: f64) -> Check {
        tally.check(claim, self.applies(claim), bound)
    }

    /// c_p.
    pub fn packing_constant(&self) -> f64 {
        packing_constant(self.bounds.c_b, self.t())
    }
}
