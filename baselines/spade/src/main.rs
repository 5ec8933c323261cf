//! spade's own Delaunay refinement behind the protocol of ../../PROTOCOL.md.

#[path = "../../peer.rs"]
mod peer;

use peer::{Domain, Failure, Mesh, Size};
use spade::handles::{FixedFaceHandle, InnerTag};
use spade::{
    AngleLimit, ConstrainedDelaunayTriangulation, Point2, PositionInTriangulation, RefinementParameters, Triangulation,
};
use std::collections::HashSet;
use std::process::ExitCode;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

fn main() -> ExitCode {
    peer::serve("2.15.1", mesh)
}

fn mesh(domain: &Domain, size: &Size, angle: f64) -> Result<Mesh, Failure> {
    let limits = RefinementParameters::new()
        .with_angle_limit(AngleLimit::from_deg(angle))
        .with_max_additional_vertices(usize::MAX);
    let limits = match *size {
        Size::AnglesAlone => limits,
        Size::Uniform(edge) => limits.with_max_allowed_area(peer::equilateral_area(edge)),
        Size::Field => {
            return Err(Failure::Declined(
                "spade refines to one area everywhere: it takes no size function".into(),
            ));
        }
    };
    let mut cdt = triangulate(domain)?;
    let excludes_itself = exclusion_is_ours(&cdt, domain);
    let result = cdt.refine(limits.exclude_outer_faces(excludes_itself));
    if !result.refinement_complete {
        return Err(Failure::Failed("spade left the refinement incomplete".into()));
    }

    let outside = outside(&cdt, domain);
    let inside = cdt.inner_faces().filter(|face| !outside.contains(&face.fix()));
    let corners = inside.map(|face| face.vertices().map(|vertex| vertex.index()));
    let position = |vertex| {
        let point = cdt
            .vertex(spade::handles::FixedVertexHandle::from_index(vertex))
            .position();
        [point.x, point.y]
    };
    let mut mesh = Mesh::compacted(corners, position, cdt.num_vertices());
    mesh.counts
        .insert("outside_refined".into(), u8::from(!excludes_itself).into());
    Ok(mesh)
}

fn triangulate(domain: &Domain) -> Result<Cdt, Failure> {
    let points = domain.points.iter().map(|&[x, y]| Point2::new(x, y)).collect();
    let mut crossings = 0;
    let cdt = Cdt::try_bulk_load_cdt(points, domain.segments.clone(), |_| crossings += 1)
        .map_err(|error| Failure::Declined(format!("spade refuses a point: {error:?}")))?;
    if cdt.num_vertices() != domain.points.len() {
        return Err(Failure::Declined("two points of the domain coincide".into()));
    }
    if crossings > 0 {
        return Err(Failure::Declined(
            "two segments cross, and the crossing is no vertex of the domain".into(),
        ));
    }
    Ok(cdt)
}

/// Whether spade, told to exclude what is outside, would exclude just that. It goes by the parity of the constraints crossed
/// on the way out, and so is wrong where a segment has the same side of the domain's boundary to its left and right. It is
/// asked by a refinement that may insert nothing.
fn exclusion_is_ours(cdt: &Cdt, domain: &Domain) -> bool {
    let nothing = RefinementParameters::new()
        .with_max_additional_vertices(0)
        .exclude_outer_faces(true);
    let excluded = cdt.clone().refine(nothing).excluded_faces;
    excluded.into_iter().collect::<HashSet<_>>() == outside(cdt, domain)
}

/// The faces that a path from the outer face or from a hole's point reaches without crossing a segment.
fn outside(cdt: &Cdt, domain: &Domain) -> HashSet<FixedFaceHandle<InnerTag>> {
    let mut to_visit = Vec::new();
    for edge in cdt.convex_hull() {
        if !edge.is_constraint_edge() {
            to_visit.extend(edge.rev().face().as_inner());
        }
    }
    for &[x, y] in &domain.holes {
        // A refinement of the hole may have put a vertex or an edge on its point.
        let edges: Vec<_> = match cdt.locate(Point2::new(x, y)) {
            PositionInTriangulation::OnFace(face) => cdt.face(face).adjacent_edges().to_vec(),
            PositionInTriangulation::OnEdge(edge) => vec![cdt.directed_edge(edge)],
            PositionInTriangulation::OnVertex(vertex) => cdt.vertex(vertex).out_edges().collect(),
            _ => continue,
        };
        to_visit.extend(edges.into_iter().filter_map(|edge| edge.face().as_inner()));
    }
    let mut reached = HashSet::new();
    while let Some(face) = to_visit.pop() {
        if reached.insert(face.fix()) {
            let open = face
                .adjacent_edges()
                .into_iter()
                .filter(|edge| !edge.is_constraint_edge());
            to_visit.extend(open.filter_map(|edge| edge.rev().face().as_inner()));
        }
    }
    reached
}
