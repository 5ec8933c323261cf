//! Cavities: what directed edges enclose on their left, triangulated from its nodes alone.

use super::{Cdt, TriangulationError, UNKNOWN, load};
use crate::geometry::DVec2;
use spade::Triangulation;
use spade::handles::FixedDirectedEdgeHandle;

/// The constrained Delaunay triangulation of what the directed `edges` have on their left: triangles, each with the index of
/// an edge of the cavity it lies in. Points on no edge may lie in cavities. Both directions of an edge may be given.
///
/// # Errors
/// If edges cross or points coincide; [`TriangulationError::Leak`] if the edges enclose nothing.
pub fn triangulate_cavities(points: &[DVec2], edges: &[[u32; 2]]) -> Result<Vec<([u32; 3], u32)>, TriangulationError> {
    let (mut cdt, handles) = load(points)?;
    let mut sides = Vec::with_capacity(edges.len());
    for &[a, b] in edges {
        let middle = points[a as usize].midpoint(points[b as usize]);
        match cdt.try_add_constraint(handles[a as usize], handles[b as usize])[..] {
            [edge] => sides.push(edge),
            _ => {
                return Err(TriangulationError::Crossing {
                    x: middle.x,
                    y: middle.y,
                });
            }
        }
    }
    let labels = flood(&cdt, &sides)?;
    let labelled = cdt.inner_faces().filter_map(|face| {
        let label = labels[face.fix().index()];
        let corners = face.vertices().map(|vertex| vertex.data().index);
        (label != UNKNOWN).then_some((corners, label))
    });
    Ok(labelled.collect())
}

/// For each face, the index of a side that has it on the left, found through unconstrained edges.
fn flood(cdt: &Cdt, sides: &[FixedDirectedEdgeHandle]) -> Result<Vec<u32>, TriangulationError> {
    let mut labels = vec![UNKNOWN; cdt.num_all_faces()];
    for (index, &side) in (0u32..).zip(sides) {
        let mut reached = vec![side];
        while let Some(edge) = reached.pop() {
            let edge = cdt.directed_edge(edge);
            let Some(face) = edge.face().as_inner() else {
                let [a, b] = edge.positions();
                return Err(TriangulationError::Leak {
                    x: 0.5 * (a.x + b.x),
                    y: 0.5 * (a.y + b.y),
                });
            };
            let label = &mut labels[face.fix().index()];
            if *label == UNKNOWN {
                *label = index;
                let free = face
                    .adjacent_edges()
                    .into_iter()
                    .filter(|edge| !edge.is_constraint_edge());
                reached.extend(free.map(|edge| edge.fix().rev()));
            }
        }
    }
    Ok(labels)
}
