//! Which triangles share an edge, and which edges share a vertex: tables by index, built in linear time.

/// No triangle.
pub const NONE: u32 = u32::MAX;

/// An edge of the mesh, with the triangles on its sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The ends, the smaller index first.
    pub ends: [u32; 2],
    /// A triangle that runs from the first end to the second, or [`NONE`].
    pub left: u32,
    /// A triangle that runs from the second end to the first, or [`NONE`].
    pub right: u32,
    /// How many triangles have this edge, in either direction.
    pub uses: u32,
}

impl Edge {
    /// Whether one triangle has the edge.
    pub fn is_boundary(&self) -> bool {
        self.uses == 1
    }

    /// Whether at most two triangles have the edge, and no two in the same direction.
    pub fn is_manifold(&self) -> bool {
        self.uses == u32::from(self.left != NONE) + u32::from(self.right != NONE)
    }
}

/// All edges of a set of triangles. Triangles may be of any orientation and meet in any way.
#[derive(Clone, Debug)]
pub struct Adjacency {
    edges: Vec<Edge>,
    /// Edges whose smaller end is v are `edges[first[v]..first[v + 1]]`, in the order of their larger ends.
    first: Vec<u32>,
}

impl Adjacency {
    /// Built from triangles whose corners are below `vertices`.
    pub fn of(triangles: &[[u32; 3]], vertices: usize) -> Self {
        let sides = |t: usize| {
            let [a, b, c] = triangles[t];
            [[a, b], [b, c], [c, a]]
        };
        let mut start = vec![0u32; vertices + 1];
        for t in 0..triangles.len() {
            for [a, b] in sides(t) {
                start[a.min(b) as usize + 1] += 1;
            }
        }
        for v in 0..vertices {
            start[v + 1] += start[v];
        }
        let mut next = start.clone();
        let mut half_edges = vec![(0u32, 0u32, false); 3 * triangles.len()];
        for t in 0..triangles.len() {
            for [a, b] in sides(t) {
                let slot = &mut next[a.min(b) as usize];
                half_edges[*slot as usize] = (a.max(b), t as u32, a < b);
                *slot += 1;
            }
        }
        let mut edges: Vec<Edge> = Vec::with_capacity(half_edges.len() / 2 + vertices);
        let mut first = vec![0u32; vertices + 1];
        for v in 0..vertices {
            let bucket = &mut half_edges[start[v] as usize..start[v + 1] as usize];
            bucket.sort_unstable();
            for &(far, triangle, forward) in bucket.iter() {
                let ends = [v as u32, far];
                if edges.last().is_none_or(|edge| edge.ends != ends) {
                    edges.push(Edge {
                        ends,
                        left: NONE,
                        right: NONE,
                        uses: 0,
                    });
                }
                if let Some(edge) = edges.last_mut() {
                    let side = if forward { &mut edge.left } else { &mut edge.right };
                    *side = (*side).min(triangle);
                    edge.uses += 1;
                }
            }
            first[v + 1] = edges.len() as u32;
        }
        Self { edges, first }
    }

    /// All edges, in the order of their smaller and then their larger ends.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The index in [`Self::edges`] of the edge between two vertices, in either order.
    pub fn find(&self, a: u32, b: u32) -> Option<usize> {
        let v = a.min(b) as usize;
        let (from, to) = (*self.first.get(v)? as usize, *self.first.get(v + 1)? as usize);
        let found = self.edges[from..to].binary_search_by_key(&a.max(b), |edge| edge.ends[1]);
        found.ok().map(|k| from + k)
    }

    /// For each triangle, the triangles across its sides ab, bc, ca ([`NONE`] where there is none).
    pub fn neighbours(&self, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
        let across = |a: u32, b: u32| match self.find(a, b).map(|k| self.edges[k]) {
            Some(edge) if a < b => edge.right,
            Some(edge) => edge.left,
            None => NONE,
        };
        triangles
            .iter()
            .map(|&[a, b, c]| [across(a, b), across(b, c), across(c, a)])
            .collect()
    }

    /// For each vertex, the vertices it has an edge to.
    pub fn vertex_neighbours(&self) -> Lists {
        Lists::group(
            self.first.len() - 1,
            self.edges.iter().flat_map(|edge| {
                let [a, b] = edge.ends;
                [(a, b), (b, a)]
            }),
        )
    }
}

/// One list of numbers for each vertex, all in one allocation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lists {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// Groups pairs (list, item), keeping their order within each list.
    pub fn group(lists: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut start = vec![0u32; lists + 1];
        for (list, _) in pairs.clone() {
            start[list as usize + 1] += 1;
        }
        for k in 0..lists {
            start[k + 1] += start[k];
        }
        let mut next = start.clone();
        let mut items = vec![0; start[lists] as usize];
        for (list, item) in pairs {
            items[next[list as usize] as usize] = item;
            next[list as usize] += 1;
        }
        Self { start, items }
    }

    /// List number `k`.
    pub fn get(&self, k: usize) -> &[u32] {
        &self.items[self.start[k] as usize..self.start[k + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO: [[u32; 3]; 2] = [[0, 1, 2], [2, 1, 3]];

    #[test]
    fn two_triangles_share_an_edge() {
        let adjacency = Adjacency::of(&TWO, 5);
        assert_eq!(adjacency.edges().len(), 5);
        let shared = adjacency.edges()[adjacency.find(2, 1).unwrap()];
        assert_eq!(
            shared,
            Edge {
                ends: [1, 2],
                left: 0,
                right: 1,
                uses: 2
            }
        );
        assert!(shared.is_manifold() && !shared.is_boundary());
        assert_eq!(adjacency.find(0, 3), None);
        assert_eq!(adjacency.find(7, 9), None);
        assert_eq!(adjacency.neighbours(&TWO), [[NONE, 1, NONE], [0, NONE, NONE]]);
        let around = adjacency.vertex_neighbours();
        assert_eq!(around.get(1), [0, 2, 3]);
        assert_eq!(around.get(4), [0u32; 0]);
    }

    #[test]
    fn a_third_triangle_and_a_flipped_one_are_no_manifold() {
        let third = Adjacency::of(&[TWO[0], TWO[1], [1, 2, 4]], 5);
        assert!(!third.edges()[third.find(1, 2).unwrap()].is_manifold());
        let flipped = Adjacency::of(&[TWO[0], [1, 2, 3]], 4);
        let edge = flipped.edges()[flipped.find(1, 2).unwrap()];
        assert!(edge.uses == 2 && !edge.is_manifold());
    }
}
