//! [`Domain::new`]: finds the faces of a PSLG, and which of them are inside.

use super::corners::Corners;
use super::error::{DomainError, Fault, FaultKind};
use super::locate::{Locator, Place, look};
use super::pslg::{Fill, InputSegment, Pslg};
use super::subdivision::{Around, DisjointSets, Subdivision};
use super::validate::{self, Report};
use super::{Domain, Face, Segment};
use crate::geometry::segments::SegmentIndex;
use crate::geometry::{DVec2, Rect};

impl Domain {
    /// The inside of one simple polygon, its corners in order, either way round.
    ///
    /// # Errors
    /// [`DomainError::Invalid`] with every fault found.
    pub fn polygon(corners: &[[f64; 2]]) -> Result<Self, DomainError> {
        let mut input = Pslg::new("polygon");
        input.add_ring(corners.iter().map(|&corner| DVec2::from(corner)), 1);
        Self::new(input)
    }

    /// Checks `input`, finds its faces, and decides which are inside.
    ///
    /// Inside are the bounded faces that hold no hole point (or, for polygons with rings, those of odd parity). Segments
    /// and vertices that no inside face touches are left out; [`Domain::notes`] says so. O(n log n).
    ///
    /// # Errors
    /// [`DomainError::Invalid`] with every fault found.
    pub fn new(input: Pslg) -> Result<Self, DomainError> {
        let faults = validate::faults(&input);
        if !faults.is_empty() {
            return Err(invalid(&input, faults));
        }
        let index = SegmentIndex::new((0..input.segments.len()).map(|s| input.ends(s)));
        let subdivision = Subdivision::new(&input.vertices, &input.segments, &index);
        let segments = with_faces(&input.segments, &subdivision);
        let mut classes = Classes {
            notes: input.notes.clone(),
            faces: vec![Face::OUTSIDE; subdivision.faces],
        };
        let mut report = Report {
            pslg: &input,
            faults: Vec::new(),
        };
        classes.classify(&segments, &index, &mut report);
        if report.faults.is_empty() && !classes.faces.iter().any(|face| face.inside) {
            nothing_inside(&mut report, &subdivision, &segments);
        }
        if !report.faults.is_empty() {
            let faults = report.faults;
            return Err(invalid(&input, faults));
        }
        Ok(Self::keep_inside(&input, segments, classes, &index))
    }

    /// Leaves out segments and vertices that no inside face touches, and merges the faces that this joins.
    fn keep_inside(input: &Pslg, segments: Vec<Segment>, classes: Classes, index: &SegmentIndex) -> Self {
        let Classes { faces, mut notes } = classes;
        let touches = |s: &Segment| faces[s.left].inside || faces[s.right].inside;
        let mut on_segment = vec![false; input.vertices.len()];
        let mut keep = vec![false; input.vertices.len()];
        for segment in &segments {
            for v in [segment.a, segment.b] {
                on_segment[v] = true;
                keep[v] |= touches(segment);
            }
        }
        for v in (0..keep.len()).filter(|&v| !on_segment[v]) {
            let place = look(input.vertices[v], &segments, index);
            keep[v] = matches!(place, Place::Face(face) if faces[face].inside);
        }
        let mut number = vec![usize::MAX; keep.len()];
        let kept: Vec<usize> = (0..keep.len()).filter(|&v| keep[v]).collect();
        for (new, &old) in kept.iter().enumerate() {
            number[old] = new;
        }
        let (face_number, faces) = merge_faces(&segments, &faces);
        let total = segments.len();
        let segments: Vec<Segment> = segments
            .into_iter()
            .map(|s| Segment {
                left: face_number[s.left],
                right: face_number[s.right],
                ..s
            })
            .filter(|s| faces[s.left].inside || faces[s.right].inside)
            .map(|s| Segment {
                a: number[s.a],
                b: number[s.b],
                ..s
            })
            .collect();
        let (lost_vertices, lost_segments) = (keep.len() - kept.len(), total - segments.len());
        if lost_vertices + lost_segments > 0 {
            notes.push(format!(
                "left out {lost_vertices} vertices and {lost_segments} segments that touch no inside face"
            ));
        }
        let isolated = kept
            .iter()
            .enumerate()
            .filter(|&(_, &old)| !on_segment[old])
            .map(|(new, _)| new)
            .collect();
        let vertices: Vec<DVec2> = kept.iter().map(|&v| input.vertices[v]).collect();
        let vertex_markers = kept.iter().map(|&v| input.vertex_marker(v)).collect();
        Self::assemble(
            input.name.clone(),
            vertices,
            vertex_markers,
            segments,
            faces,
            isolated,
            notes,
        )
    }

    fn assemble(
        name: String,
        vertices: Vec<DVec2>,
        vertex_markers: Vec<i32>,
        segments: Vec<Segment>,
        faces: Vec<Face>,
        isolated: Vec<usize>,
        notes: Vec<String>,
    ) -> Self {
        let bounds = Rect::around(vertices.iter().copied());
        let ends = |s: usize| [vertices[segments[s].a], vertices[segments[s].b]];
        let index = SegmentIndex::new((0..segments.len()).map(ends));
        let locator = Locator::new(bounds, &segments, ends, &index);
        let plain: Vec<InputSegment> = segments
            .iter()
            .map(|s| InputSegment {
                a: s.a,
                b: s.b,
                marker: s.marker,
            })
            .collect();
        let around = Around::new(&vertices, &plain);
        let corners = Corners::new(&vertices, &segments, &faces, |v| around.at(v));
        let mut area = 0.0;
        for (s, segment) in segments.iter().enumerate() {
            let side = i32::from(faces[segment.left].inside) - i32::from(faces[segment.right].inside);
            let [a, b] = ends(s).map(|p| p - bounds.centre());
            area += f64::from(side) * 0.5 * a.perp_dot(b);
        }
        Self {
            name,
            vertices,
            vertex_markers,
            segments,
            faces,
            bounds,
            area,
            isolated,
            notes,
            index,
            locator,
            corners,
        }
    }
}

fn invalid(input: &Pslg, faults: Vec<Fault>) -> DomainError {
    DomainError::Invalid {
        file: input.source.file.clone(),
        faults,
    }
}

fn with_faces(segments: &[InputSegment], subdivision: &Subdivision) -> Vec<Segment> {
    let side = |h: usize| subdivision.left[h];
    let with = |(s, segment): (usize, &InputSegment)| {
        let &InputSegment { a, b, marker } = segment;
        Segment {
            a,
            b,
            marker,
            left: side(2 * s),
            right: side(2 * s + 1),
        }
    };
    segments.iter().enumerate().map(with).collect()
}

/// The faces with their classes, in the making.
struct Classes {
    faces: Vec<Face>,
    notes: Vec<String>,
}

impl Classes {
    fn classify(&mut self, segments: &[Segment], index: &SegmentIndex, report: &mut Report) {
        let input = report.pslg;
        match &input.fill {
            Fill::HolePoints(points) => {
                for face in &mut self.faces[1..] {
                    face.inside = true;
                }
                for (h, &point) in points.iter().enumerate() {
                    self.hole(h, look(point, segments, index), report);
                }
            }
            Fill::EvenOdd { flips } => self.even_odd(segments, flips),
        }
        for (r, region) in input.regions.iter().enumerate() {
            match look(region.point, segments, index) {
                Place::Face(face) if self.faces[face].inside => {
                    self.faces[face].region = region.attribute;
                    self.faces[face].max_area = region.max_area;
                }
                Place::Face(_) => self.notes.push(format!(
                    "ignored the region point at ({}, {}): it lies outside the domain",
                    region.point.x, region.point.y
                )),
                Place::Segment(s) => {
                    let at = format!("the region point at ({}, {})", region.point.x, region.point.y);
                    let message = format!("{at} lies on {}", report.segment(s));
                    let line = input.source.region_lines.get(r).copied();
                    report.add_point(FaultKind::MisplacedRegion, line, message);
                }
            }
        }
    }

    fn hole(&mut self, h: usize, place: Place, report: &mut Report) {
        let point = report.pslg.holes()[h];
        let at = format!("the hole point at ({}, {})", point.x, point.y);
        let message = match place {
            Place::Face(0) => format!("{at} lies outside every boundary"),
            Place::Face(face) => {
                self.faces[face].inside = false;
                return;
            }
            Place::Segment(s) => format!("{at} lies on {}", report.segment(s)),
        };
        let line = report.pslg.source.hole_lines.get(h).copied();
        report.add_point(FaultKind::MisplacedHole, line, message);
    }

    /// Spreads parity from the unbounded face over the segments; every face is reached.
    fn even_odd(&mut self, segments: &[Segment], flips: &[bool]) {
        let mut beside: Vec<Vec<(usize, bool)>> = vec![Vec::new(); self.faces.len()];
        for (segment, &flip) in segments.iter().zip(flips) {
            beside[segment.left].push((segment.right, flip));
            beside[segment.right].push((segment.left, flip));
        }
        let mut reached = vec![false; self.faces.len()];
        reached[0] = true;
        let mut todo = vec![0];
        while let Some(face) = todo.pop() {
            for &(other, flip) in &beside[face] {
                if !std::mem::replace(&mut reached[other], true) {
                    self.faces[other].inside = self.faces[face].inside != flip;
                    todo.push(other);
                }
            }
        }
    }
}

/// Says why no face is inside: nothing is enclosed, or all that is enclosed is holes.
fn nothing_inside(report: &mut Report, subdivision: &Subdivision, segments: &[Segment]) {
    let input = report.pslg;
    let loose = |v: usize| {
        let outgoing = subdivision.around.at(v);
        outgoing.len() == 1 && segments[outgoing[0] / 2].left == 0
    };
    let open: Vec<usize> = (0..input.vertices.len()).filter(|&v| loose(v)).collect();
    if subdivision.faces > 1 && open.is_empty() {
        let message = "every face that the segments enclose is a hole".to_owned();
        report.add(FaultKind::NothingInside, vec![], vec![], message);
        return;
    }
    let names: Vec<String> = open.iter().take(4).map(|&v| report.vertex(v)).collect();
    let more = if open.len() > 4 {
        format!(" and {} more", open.len() - 4)
    } else {
        String::new()
    };
    let message = format!("the boundary is not closed: it ends at {}{more}", names.join(", "));
    report.add(FaultKind::NotClosed, open, vec![], message);
}

/// Joins the outside faces that only left-out segments separate, and numbers the faces anew.
fn merge_faces(segments: &[Segment], faces: &[Face]) -> (Vec<usize>, Vec<Face>) {
    let mut sets = DisjointSets::new(faces.len());
    for segment in segments {
        if !faces[segment.left].inside && !faces[segment.right].inside {
            sets.join(segment.left, segment.right);
        }
    }
    let mut number = vec![0; faces.len()];
    let mut merged = Vec::new();
    for face in 0..faces.len() {
        let first = sets.find(face);
        if first == face {
            number[face] = merged.len();
            merged.push(faces[face]);
        } else {
            number[face] = number[first];
        }
    }
    (number, merged)
}
