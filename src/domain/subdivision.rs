//! The faces of a planar straight-line graph, found from its half-edges and exact predicates alone.
//!
//! Half-edge 2s walks segment s from first to second end, 2s + 1 walks it back. Around every vertex the outgoing
//! half-edges are sorted by exact angle; following each half-edge by the next one clockwise at its end traces the loops
//! that have one face on their left. Every connected component has exactly one loop that runs around its outside; the
//! face outside this loop is the one that the component's rightmost vertex sees to its right.

use super::pslg::InputSegment;
use crate::geometry::DVec2;
use crate::geometry::predicates::orient2d;
use crate::geometry::segments::{Seen, SegmentIndex};
use std::cmp::Ordering;

/// The faces beside every segment.
#[derive(Clone, Debug)]
pub(super) struct Subdivision {
    /// The face on the left of every half-edge.
    pub left: Vec<usize>,
    /// Number of faces; face 0 is unbounded.
    pub faces: usize,
    /// Outgoing half-edges of every vertex, counter-clockwise from the direction +x.
    pub around: Around,
}

/// Outgoing half-edges of every vertex, in one flat list.
#[derive(Clone, Debug)]
pub(super) struct Around {
    start: Vec<usize>,
    half_edges: Vec<usize>,
}

impl Around {
    /// Sorts the half-edges around every vertex by exact angle. O(n log n).
    pub fn new(vertices: &[DVec2], segments: &[InputSegment]) -> Self {
        let mut start = vec![0; vertices.len() + 1];
        for segment in segments {
            start[segment.a + 1] += 1;
            start[segment.b + 1] += 1;
        }
        for v in 0..vertices.len() {
            start[v + 1] += start[v];
        }
        let mut fill = start.clone();
        let mut half_edges = vec![0; 2 * segments.len()];
        for h in 0..2 * segments.len() {
            let slot = &mut fill[origin(segments, h)];
            half_edges[*slot] = h;
            *slot += 1;
        }
        for (v, &at) in vertices.iter().enumerate() {
            half_edges[start[v]..start[v + 1]]
                .sort_by(|&g, &h| by_angle(at, vertices[target(segments, g)], vertices[target(segments, h)]));
        }
        Self { start, half_edges }
    }

    /// The half-edges that leave `v`, counter-clockwise.
    pub fn at(&self, v: usize) -> &[usize] {
        &self.half_edges[self.start[v]..self.start[v + 1]]
    }
}

/// Where half-edge `h` starts.
pub(super) fn origin(segments: &[InputSegment], h: usize) -> usize {
    let segment = &segments[h / 2];
    if h.is_multiple_of(2) { segment.a } else { segment.b }
}

/// Where half-edge `h` ends.
pub(super) fn target(segments: &[InputSegment], h: usize) -> usize {
    origin(segments, h ^ 1)
}

/// Exact order of the directions from `at` to `p` and `q` by angle in [0°, 360°).
fn by_angle(at: DVec2, p: DVec2, q: DVec2) -> Ordering {
    let lower = |d: DVec2| d.y < at.y || (d.y == at.y && d.x < at.x);
    lower(p).cmp(&lower(q)).then_with(|| {
        let turn = orient2d(at, p, q);
        0.0f64.total_cmp(&(turn + 0.0))
    })
}

impl Subdivision {
    /// Finds the faces of segments that do not cross, touch or repeat. `index` holds the same segments.
    pub fn new(vertices: &[DVec2], segments: &[InputSegment], index: &SegmentIndex) -> Self {
        let around = Around::new(vertices, segments);
        let (loop_of, loops) = trace_loops(segments, &around);
        let component = components(&loop_of, loops);
        let outer = outer_loops(vertices, &around, &loop_of, &component);
        let (face_of_loop, faces) = faces_of_loops(vertices, index, &loop_of, &component, &outer);
        let left = loop_of.iter().map(|&l| face_of_loop[l]).collect();
        Self { left, faces, around }
    }
}

/// For every half-edge the loop it belongs to, and how many loops there are.
fn trace_loops(segments: &[InputSegment], around: &Around) -> (Vec<usize>, usize) {
    let count = 2 * segments.len();
    let mut next = vec![0; count];
    for v in 0..around.start.len() - 1 {
        let outgoing = around.at(v);
        for (i, &h) in outgoing.iter().enumerate() {
            // Arriving by the twin of h, the face on the left goes on with the neighbour clockwise of h.
            next[h ^ 1] = outgoing[(i + outgoing.len() - 1) % outgoing.len()];
        }
    }
    let mut loop_of = vec![usize::MAX; count];
    let mut loops = 0;
    for first in 0..count {
        if loop_of[first] != usize::MAX {
            continue;
        }
        let mut h = first;
        while loop_of[h] == usize::MAX {
            loop_of[h] = loops;
            h = next[h];
        }
        loops += 1;
    }
    (loop_of, loops)
}

/// For every component, from right to left, the loop that runs around its outside and its rightmost vertex.
fn outer_loops(vertices: &[DVec2], around: &Around, loop_of: &[usize], component: &[usize]) -> Vec<(usize, usize)> {
    let mut order: Vec<usize> = (0..vertices.len()).filter(|&v| !around.at(v).is_empty()).collect();
    order.sort_by(|&u, &v| {
        let (p, q) = (vertices[u], vertices[v]);
        q.x.total_cmp(&p.x).then(q.y.total_cmp(&p.y))
    });
    let mut seen = vec![false; component.len()];
    let mut outer = Vec::new();
    for v in order {
        // All directions lie in (90°, 270°]; the outside lies counter-clockwise of the last.
        let highest = around.at(v)[around.at(v).len() - 1];
        let outside = loop_of[highest];
        if !std::mem::replace(&mut seen[component[outside]], true) {
            outer.push((v, outside));
        }
    }
    outer
}

/// For every loop the lowest loop of its component: loops on the two sides of a segment are connected.
fn components(loop_of: &[usize], loops: usize) -> Vec<usize> {
    let mut sets = DisjointSets::new(loops);
    for sides in loop_of.chunks_exact(2) {
        sets.join(sides[0], sides[1]);
    }
    (0..loops).map(|l| sets.find(l)).collect()
}

/// Numbers the faces: 0 is the unbounded one, then comes one for every loop that does not run around a component.
fn faces_of_loops(
    vertices: &[DVec2],
    index: &SegmentIndex,
    loop_of: &[usize],
    component: &[usize],
    outer: &[(usize, usize)],
) -> (Vec<usize>, usize) {
    let mut is_outer = vec![false; component.len()];
    for &(_, outside) in outer {
        is_outer[outside] = true;
    }
    let mut face_of_loop = vec![0; component.len()];
    let mut faces = 1;
    for inner in (0..component.len()).filter(|&l| !is_outer[l]) {
        face_of_loop[inner] = faces;
        faces += 1;
    }
    // What a rightmost vertex sees to its right belongs to a component that reaches further right, which has its faces already.
    for &(v, outside) in outer {
        let others = |s: usize| component[loop_of[2 * s]] != component[outside];
        face_of_loop[outside] = match index.right_of_where(vertices[v], others) {
            Seen::Segment(s, on_left) => face_of_loop[loop_of[2 * s + usize::from(!on_left)]],
            Seen::On(_) | Seen::Nothing => 0,
        };
    }
    (face_of_loop, faces)
}

/// Union-find with path halving.
#[derive(Clone, Debug)]
pub(super) struct DisjointSets {
    parent: Vec<usize>,
}

impl DisjointSets {
    /// `count` sets of one.
    pub fn new(count: usize) -> Self {
        Self {
            parent: (0..count).collect(),
        }
    }

    /// The representative of `i`'s set: its lowest member.
    pub fn find(&mut self, i: usize) -> usize {
        let mut i = i;
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }

    /// Joins the sets of `i` and `j`.
    pub fn join(&mut self, i: usize, j: usize) {
        let (i, j) = (self.find(i), self.find(j));
        let (low, high) = (i.min(j), i.max(j));
        self.parent[high] = low;
    }
}
