//! The last resort: what is left of the front is closed from its own nodes alone.

use super::front::{Front, NONE, Triangle};
use crate::delaunay::triangulate_cavities;
use crate::meshers::MeshError;

impl Front<'_> {
    /// Fills what the front still encloses with the constrained Delaunay triangulation of the front's nodes.
    pub fn close_by_force(&mut self) -> Result<(), MeshError> {
        if self.length == 0 {
            return Ok(());
        }
        let live: Vec<u32> = self.live().collect();
        let mut nodes: Vec<u32> = live.iter().map(|&edge| self.edge(edge).from).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let points: Vec<_> = nodes.iter().map(|&node| self.at(node)).collect();
        let place = |node: u32| nodes.partition_point(|&other| other < node) as u32;
        let edges: Vec<u32> = live.iter().copied().filter(|&e| self.edge(e).next != e).collect();
        let ends: Vec<[u32; 2]> = edges
            .iter()
            .map(|&edge| [self.edge(edge).from, self.edge(edge).to].map(place))
            .collect();
        let found = triangulate_cavities(&points, &ends)?;
        self.tally.closed_by_force += found.len();
        for (corners, edge) in found {
            self.triangles.push(Triangle {
                corners: corners.map(|corner| nodes[corner as usize]),
                across: [NONE; 3],
                face: self.edge(edges[edge as usize]).face,
                is_seam: true,
            });
        }
        live.into_iter().for_each(|edge| self.remove_edge(edge));
        Ok(())
    }
}
