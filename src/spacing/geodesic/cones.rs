//! The largest α-Lipschitz function below given values at the vertices of a mesh, nearly: a first guess for
//! [`crate::spacing::geodesic::slopes`].
//!
//! It is the least of the cones v_y + α d(x, y) over the vertices y. A vertex takes over the cone of a neighbour, straight
//! from the apex if it sees that, else with the neighbour as apex: shortest ways turn at vertices of the domain,
//! which are vertices of the mesh. Guesses do no harm: the result is lowered until no triangle is too steep.

use crate::domain::Domain;
use crate::geometry::predicates::{Meeting, segments_meet};
use crate::geometry::{DVec2, Rect};
use crate::mesh::Mesh;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The share by which a value must fall before its neighbours are visited again.
const LITTLE: f64 = 1e-9;

/// An apex is left behind when the cone has risen by this share of its value: sight lines stay short then.
const FARTHEST: f64 = 0.7;

/// The least of the cones at each vertex.
pub fn lowest(domain: &Domain, mesh: &Mesh, start: &[f64], alpha: f64) -> Vec<f64> {
    let neighbours = mesh.adjacency().vertex_neighbours();
    let mut values = start.to_vec();
    let mut apexes: Vec<u32> = (0..start.len() as u32).collect();
    let keys = start.iter().map(|value| value.to_bits());
    let mut waiting: BinaryHeap<Reverse<(u64, u32)>> = keys.zip(0..).map(Reverse).collect();
    while let Some(Reverse((key, v))) = waiting.pop() {
        if key != values[v as usize].to_bits() {
            continue;
        }
        let at = |v: u32| mesh.points[v as usize];
        for &w in neighbours.get(v as usize) {
            let apex = apexes[v as usize];
            let over = |apex: u32, value: f64| value + alpha * at(apex).distance(at(w));
            let is_lower = |value: f64| value < values[w as usize] * (1.0 - LITTLE);
            // The apex is no farther than by way of the neighbour.
            let straight = over(apex, start[apex as usize].min(values[apex as usize]));
            if !is_lower(straight) {
                continue;
            }
            let is_near = alpha * at(apex).distance(at(w)) <= FARTHEST * straight;
            let (apex, value) = match is_near && is_seen(domain, at(apex), at(w)) {
                true => (apex, straight),
                false => (v, over(v, values[v as usize])),
            };
            if is_lower(value) {
                (values[w as usize], apexes[w as usize]) = (value, apex);
                waiting.push(Reverse((value.to_bits(), w)));
            }
        }
    }
    values
}

/// Whether the straight line between two points of the domain crosses none of its boundary.
fn is_seen(domain: &Domain, x: DVec2, y: DVec2) -> bool {
    let mut is_seen = true;
    domain.index().in_box(Rect::around([x, y]), |s| {
        let [a, b] = domain.ends(s);
        is_seen &= !domain.is_boundary(s) || segments_meet(x, y, a, b) != Meeting::Cross;
    });
    is_seen
}
