//! What a replay draws besides circles.

use crate::domain::{Domain, Wedge};
use crate::geometry::DVec2;
use crate::geometry::segments::closest_on_segment;
use crate::mesh::Mesh;
use crate::meshers::{Bite, Reason};
use crate::suite::figures::tolerance::ON_SIDE;
use std::collections::BTreeMap;

/// The boundary as closed rings of input vertices: filled by the even-odd rule, they are the domain.
pub(super) fn rings(domain: &Domain) -> Vec<Vec<u32>> {
    let mut open: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for s in (0..domain.segments().len()).filter(|&s| domain.is_boundary(s)) {
        let segment = domain.segments()[s];
        open.entry(segment.a).or_default().push(s);
        open.entry(segment.b).or_default().push(s);
    }
    // Every vertex has an even number of boundary segments, so a walk ends only where it began.
    let mut rings = Vec::new();
    while let Some(start) = open.iter().find(|(_, left)| !left.is_empty()).map(|(&v, _)| v) {
        let mut ring = Vec::new();
        let mut v = start;
        while let Some(s) = open.get_mut(&v).and_then(Vec::pop) {
            ring.push(v as u32);
            let segment = domain.segments()[s];
            v = if segment.a == v { segment.b } else { segment.a };
            if let Some(left) = open.get_mut(&v) {
                left.retain(|&other| other != s);
            }
        }
        rings.push(ring);
    }
    rings
}

/// Whether each input vertex was cut off instead of bitten.
pub(super) fn cut_vertices(domain: &Domain, bites: &[Bite]) -> Vec<bool> {
    let mut bitten = bites
        .iter()
        .filter(|bite| bite.reason == Reason::InputVertex)
        .peekable();
    let is_next = |vertex: &DVec2| bitten.next_if(|bite| bite.centre == *vertex).is_some();
    // They are bitten in order.
    let is_bitten: Vec<bool> = domain.vertices().iter().map(is_next).collect();
    is_bitten.into_iter().map(|is_bitten| !is_bitten).collect()
}

/// The triangles by which corners that were cut off are given back.
pub(super) fn corner_triangles(mesh: &Mesh, is_cut: &[bool]) -> Vec<u32> {
    let touches = |t: &usize| mesh.triangles[*t].iter().any(|&corner| is_cut_off(is_cut, corner));
    (0..mesh.triangles.len()).filter(touches).map(|t| t as u32).collect()
}

/// The front before the first bite: segments between mesh vertices, without what is cut off.
pub(super) fn first_front(mesh: &Mesh, is_cut: &[bool], corners: &[u32]) -> Vec<[u32; 2]> {
    let mut front: Vec<[u32; 2]> = Vec::new();
    let mut segment_before = None;
    for piece in &mesh.pieces {
        if is_cut_off(is_cut, piece.a) || is_cut_off(is_cut, piece.b) {
            continue;
        }
        match front.last_mut() {
            Some(last) if segment_before == Some(piece.segment) && last[1] == piece.a => last[1] = piece.b,
            _ => front.push([piece.a, piece.b]),
        }
        segment_before = Some(piece.segment);
    }
    let bases = corners.iter().filter_map(|&t| {
        let left = mesh.triangles[t as usize].into_iter();
        let left: Vec<u32> = left.filter(|&corner| !is_cut_off(is_cut, corner)).collect();
        <[u32; 2]>::try_from(left).ok()
    });
    front.extend(bases);
    front
}

fn is_cut_off(is_cut: &[bool], vertex: u32) -> bool {
    is_cut.get(vertex as usize).copied().unwrap_or(false)
}

/// What circles cannot see: of each bite, the sides of notches (angles under 90° that open to the outside) that lie between
/// its centre and points in its circle, as input vertices.
pub(super) fn shadows(domain: &Domain, bites: &[Bite]) -> Vec<[u32; 3]> {
    let notches: Vec<(usize, Wedge)> = (0..domain.vertices().len())
        .flat_map(|v| domain.wedges(v).iter().map(move |wedge| (v, *wedge)))
        .filter(|(_, wedge)| wedge.is_notch())
        .collect();
    let mut shadows = Vec::new();
    for (k, bite) in bites.iter().enumerate() {
        let seen = notches
            .iter()
            .filter_map(|(v, wedge)| far_side(domain, bite, *v, wedge));
        shadows.extend(seen.map(|[vertex, end]| [k as u32, vertex, end]));
    }
    shadows
}

/// The side of a notch behind which the circle of `bite` has points that its centre cannot see.
fn far_side(domain: &Domain, bite: &Bite, v: usize, wedge: &Wedge) -> Option<[u32; 2]> {
    let vertex = domain.vertices()[v];
    let reaches = |s: usize| closest_on_segment(domain.ends(s), bite.centre).distance(bite.centre) <= bite.radius;
    if bite.centre == vertex || !reaches(wedge.from) || !reaches(wedge.to) {
        return None;
    }
    let way = bite.centre - vertex;
    let slack = ON_SIDE * way.length();
    let [first, second] = [wedge.from, wedge.to].map(|s| domain.away(s, v).0);
    let far = if way.perp_dot(first) >= -slack && way.perp_dot(second) > slack {
        wedge.to
    } else if second.perp_dot(way) >= -slack && first.perp_dot(way) > slack {
        wedge.from
    } else {
        return None;
    };
    let segment = domain.segments()[far];
    let end = if segment.a == v { segment.b } else { segment.a };
    Some([v as u32, end as u32])
}
