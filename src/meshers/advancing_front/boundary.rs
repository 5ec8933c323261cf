//! The initial front: the domain's segments cut into pieces of about s.

use super::front::{Front, NONE};
use crate::geometry::DVec2;
use crate::mesh::Piece;
use crate::meshers::MeshError;

/// s is sampled along a segment in steps of this share of it. Since s is t-Lipschitz, the trapezoids between are
/// accurate to some thousandths of a piece.
const STEP: f64 = 0.25;

/// Makes the nodes on the boundary and the front through them, and returns the pieces. The front runs along both sides
/// of an inner segment; vertices that no segment touches become nodes.
pub(super) fn boundary(front: &mut Front) -> Result<Vec<Piece>, MeshError> {
    let domain = front.domain;
    for &vertex in domain.vertices() {
        let size = front.sizing.at(vertex)?;
        front.add_node(vertex, size)?;
    }
    let mut pieces = Vec::new();
    for segment in 0..domain.segments().len() {
        let mut chain = vec![domain.segments()[segment].a as u32];
        for (at, size) in cuts(front, segment)? {
            chain.push(front.add_node(at, size)?);
        }
        chain.push(domain.segments()[segment].b as u32);
        pieces.extend(chain.windows(2).map(|ends| Piece {
            a: ends[0],
            b: ends[1],
            segment: segment as u32,
        }));
    }
    open(front, &pieces);
    Ok(pieces)
}

/// The nodes that cut a segment into a whole number of pieces, each with s there. ∫ 1/s is the same on each piece, and
/// as near to 1 as can be.
fn cuts(front: &Front, segment: usize) -> Result<Vec<(DVec2, f64)>, MeshError> {
    let [start, end] = front.domain.ends(segment);
    let length = start.distance(end);
    let place = |along: f64| start.lerp(end, along / length);
    let (mut along, mut size) = (0.0, front.sizing.at(start)?);
    // For each sample: position, number of pieces up to there, s there.
    let mut samples = vec![(0.0, 0.0, size)];
    let mut pieces = 0.0;
    while along < length {
        let step = (STEP * size).min(length - along);
        // A step that would leave less than half a step goes to the end.
        let next = if length - (along + step) <= 0.5 * step {
            length
        } else {
            along + step
        };
        let next_size = front.sizing.at(place(next))?;
        pieces += 0.5 * (next - along) * (1.0 / size + 1.0 / next_size);
        (along, size) = (next, next_size);
        samples.push((along, pieces, size));
        front
            .monitor
            .placed(front.nodes.len() + pieces as usize, place(along), size)?;
    }
    let count = pieces.round().max(1.0);
    let mut found = Vec::new();
    let mut sample = 1;
    for cut in 1..count as usize {
        let wanted = cut as f64 * pieces / count;
        while samples[sample].1 < wanted {
            sample += 1;
        }
        let ((low, before, _), (high, after, _)) = (samples[sample - 1], samples[sample]);
        let at = place(low + (high - low) * (wanted - before) / (after - before));
        found.push((at, front.sizing.at(at)?));
    }
    Ok(found)
}

/// Makes the front along the inner sides of the pieces, and links its edges.
fn open(front: &mut Front, pieces: &[Piece]) {
    let domain = front.domain;
    for piece in pieces {
        let segment = &domain.segments()[piece.segment as usize];
        for (from, to, face) in [(piece.a, piece.b, segment.left), (piece.b, piece.a, segment.right)] {
            if domain.faces()[face].inside {
                front.add_edge(from, to, face as u32, NONE);
            }
        }
    }
    for node in 0..front.nodes.len() as u32 {
        front.relink(node);
    }
    for &vertex in domain.isolated() {
        front.add_edge(
            vertex as u32,
            vertex as u32,
            domain.face_at(domain.vertices()[vertex]) as u32,
            NONE,
        );
    }
    let edges: Vec<u32> = front.live().filter(|&edge| front.edge(edge).next != edge).collect();
    edges.into_iter().for_each(|edge| front.enqueue(edge));
}
