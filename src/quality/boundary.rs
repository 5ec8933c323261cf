//! Finds the domain in a mesh by coordinates alone: input vertices among mesh vertices, segments as chains of edges.
//!
//! What a mesher reports about its pieces is not used: a mesh may come from anywhere, with its vertices in any order.

use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::tolerance::{ALONG_SEGMENT, SAME_VERTEX_ULPS};
use crate::mesh::{Adjacency, Lists, Mesh};

/// Marks an edge that lies on no segment.
pub const NO_SEGMENT: u32 = u32::MAX;

/// The domain as it is found in the mesh.
pub struct Boundary {
    /// The mesh vertex at each input vertex.
    pub vertex: Vec<Option<u32>>,
    /// For each edge of the mesh, by its index in [`Adjacency::edges`], the segment on which it lies, or
    /// [`NO_SEGMENT`].
    pub segment: Vec<u32>,
    /// Segments that are not chains of mesh edges, each with the place where its chain ends.
    pub lost: Vec<(usize, DVec2)>,
}

impl Boundary {
    /// Walks every segment along the edges of the mesh.
    pub fn find(domain: &Domain, mesh: &Mesh, adjacency: &Adjacency) -> Self {
        let ulp = same_vertex_distance(domain, mesh);
        let vertex = find_vertices(domain.vertices(), &mesh.points, ulp);
        let around = adjacency.vertex_neighbours();
        let mut boundary = Self {
            vertex,
            segment: vec![NO_SEGMENT; adjacency.edges().len()],
            lost: Vec::new(),
        };
        for (s, segment) in domain.segments().iter().enumerate() {
            match (boundary.vertex[segment.a], boundary.vertex[segment.b]) {
                (Some(a), Some(b)) => boundary.walk(s, [a, b], ulp, mesh, adjacency, &around),
                _ => boundary.lost.push((s, domain.vertices()[segment.a])),
            }
        }
        boundary
    }

    fn walk(&mut self, s: usize, [from, to]: [u32; 2], ulp: f64, mesh: &Mesh, adjacency: &Adjacency, around: &Lists) {
        let end = mesh.points[to as usize];
        let direction = (end - mesh.points[from as usize]).normalize_or_zero();
        let mut at = from;
        while at != to {
            let here = mesh.points[at as usize];
            let left = (end - here).dot(direction);
            let mut best = None;
            for &next in around.get(at as usize) {
                let step = mesh.points[next as usize] - here;
                let (along, off) = (step.dot(direction), step.perp_dot(direction).abs());
                let fits =
                    along > 0.0 && along <= left * (1.0 + ALONG_SEGMENT) + ulp && off <= ALONG_SEGMENT * along + ulp;
                if fits && best.is_none_or(|(ratio, _)| off / along < ratio) {
                    best = Some((off / along, next));
                }
            }
            let Some((_, next)) = best else {
                self.lost.push((s, here));
                return;
            };
            if let Some(edge) = adjacency.find(at, next) {
                self.segment[edge] = s as u32;
            }
            at = next;
        }
    }
}

/// How far apart the coordinates of one vertex may be in domain and mesh.
pub fn same_vertex_distance(domain: &Domain, mesh: &Mesh) -> f64 {
    let largest = |points: &[DVec2]| {
        points
            .iter()
            .fold(0.0, |largest: f64, p| largest.max(p.abs().max_element()))
    };
    let largest = largest(domain.vertices()).max(largest(&mesh.points));
    SAME_VERTEX_ULPS * (largest.next_up() - largest)
}

/// The mesh vertex at each input vertex: at the same index if all are, else found by coordinates.
fn find_vertices(vertices: &[DVec2], points: &[DVec2], ulp: f64) -> Vec<Option<u32>> {
    let same = |v: DVec2, p: DVec2| (v - p).abs().max_element() <= ulp;
    if points.len() >= vertices.len() && vertices.iter().zip(points).all(|(v, p)| same(*v, *p)) {
        return (0..vertices.len() as u32).map(Some).collect();
    }
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|&i, &j| {
        let (p, q) = (points[i as usize], points[j as usize]);
        p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(i.cmp(&j))
    });
    let place = |k: &u32| points[*k as usize];
    let find = |v: &DVec2| {
        // Almost always a vertex has exactly these coordinates. If not, all vertices of about that x are compared.
        let exact = order.partition_point(|k| place(k).x < v.x || (place(k).x == v.x && place(k).y < v.y));
        if let Some(k) = order.get(exact).filter(|k| place(k) == *v) {
            return Some(*k);
        }
        let first = order.partition_point(|k| place(k).x < v.x - ulp);
        order[first..]
            .iter()
            .take_while(|k| place(k).x <= v.x + ulp)
            .find(|k| same(*v, place(k)))
            .copied()
    };
    vertices.iter().map(find).collect()
}
