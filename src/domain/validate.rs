//! Every fault of a PSLG, with the lines and numbers of the file it came from.
//!
//! The order is the order of dependence: coordinates and indices, then duplicates, then how segments meet. Pairs come
//! from a [`SegmentIndex`], so a valid PSLG of n segments costs O(n log n).

use super::error::{Fault, FaultKind};
use super::pslg::Pslg;
use crate::geometry::predicates::{Meeting, segments_meet};
use crate::geometry::segments::SegmentIndex;
use crate::geometry::{DVec2, Rect};
use std::cmp::Ordering;

/// Most faults collected; a hopeless file would otherwise have a quadratic number of crossings.
const MOST_FAULTS: usize = 1000;

/// Largest coordinate: spade takes 3e60, and products of four of them, as in the in-circle test, stay finite. The advice
/// names it.
pub const LARGEST_COORDINATE: f64 = 1e60;

/// Smallest coordinate but 0: spade takes 2e-43, and products of four do not vanish. The advice names it.
const SMALLEST: f64 = 1e-40;

/// Smallest value of the larger side of the bounding box. Rounding leaves coordinates of points between the vertices at 1e-16 of
/// it or at 0, so they too stay above [`SMALLEST`]. The advice names it.
const SMALLEST_SIDE: f64 = 1e-24;

/// Every fault of coordinates, indices and segments; [`super::Domain::new`] judges the faces.
pub fn faults(pslg: &Pslg) -> Vec<Fault> {
    let mut faults = Report {
        pslg,
        faults: Vec::new(),
    };
    faults.numbers();
    if faults.faults.is_empty() {
        faults.duplicate_vertices();
        faults.degenerate_segments();
        faults.meetings();
    }
    faults.faults
}

/// Collects faults of one PSLG.
pub(super) struct Report<'a> {
    pub pslg: &'a Pslg,
    pub faults: Vec<Fault>,
}

impl Report<'_> {
    fn is_full(&self) -> bool {
        self.faults.len() >= MOST_FAULTS
    }

    /// Notes a fault; its line is the latest of the lines concerned, where the file first becomes wrong.
    pub fn add(&mut self, kind: FaultKind, vertices: Vec<usize>, segments: Vec<usize>, message: String) {
        if self.is_full() {
            return;
        }
        let source = &self.pslg.source;
        let line = segments
            .iter()
            .filter_map(|&s| source.segment_lines.get(s))
            .max()
            .or_else(|| vertices.iter().filter_map(|&v| source.vertex_lines.get(v)).max())
            .copied();
        let elsewhere = segments.is_empty() && source.vertex_file.is_some();
        let line = line.filter(|_| !elsewhere);
        self.faults.push(Fault {
            kind,
            vertices,
            segments,
            line,
            message,
        });
    }

    /// Notes a fault of a hole or region point.
    pub fn add_point(&mut self, kind: FaultKind, line: Option<usize>, message: String) {
        self.faults.push(Fault {
            kind,
            vertices: vec![],
            segments: vec![],
            line,
            message,
        });
    }

    /// Vertex `v` as the file counts it, with its line.
    pub fn vertex(&self, v: usize) -> String {
        let source = &self.pslg.source;
        let place = source
            .vertex_file
            .as_ref()
            .map_or_else(String::new, |file| format!(" of {file}"));
        named(
            &format!("vertex {}", v + source.first_number),
            &source.vertex_lines,
            v,
            &place,
        )
    }

    /// Segment `s` as the file counts it, with its line.
    pub fn segment(&self, s: usize) -> String {
        named(
            &format!("segment {}", s + self.pslg.source.first_number),
            &self.pslg.source.segment_lines,
            s,
            "",
        )
    }

    fn numbers(&mut self) {
        let pslg = self.pslg;
        let fits = |p: DVec2| p.is_finite() && p.abs().max_element() <= LARGEST_COORDINATE;
        for (v, &p) in pslg.vertices.iter().enumerate() {
            if !fits(p) {
                self.add(
                    FaultKind::NotFinite,
                    vec![v],
                    vec![],
                    format!("{} is at ({:?}, {:?})", self.vertex(v), p.x, p.y),
                );
            }
        }
        let points = pslg
            .holes()
            .iter()
            .map(|&p| ("hole", p))
            .chain(pslg.regions.iter().map(|r| ("region", r.point)));
        for (what, p) in points.filter(|&(_, p)| !fits(p)) {
            self.add(
                FaultKind::NotFinite,
                vec![],
                vec![],
                format!("a {what} point is at ({:?}, {:?})", p.x, p.y),
            );
        }
        for (s, segment) in pslg.segments.iter().enumerate() {
            let worst = segment.a.max(segment.b);
            if worst >= pslg.vertices.len() {
                let (number, count) = (worst.saturating_add(pslg.source.first_number), pslg.vertices.len());
                let message = format!(
                    "{} ends at vertex {number}, but there are {count} vertices",
                    self.segment(s)
                );
                self.add(FaultKind::NoSuchVertex, vec![], vec![s], message);
            }
        }
        if self.faults.is_empty() && (pslg.vertices.len() < 3 || pslg.segments.len() < 3) {
            let message = format!(
                "only {} vertices and {} segments",
                pslg.vertices.len(),
                pslg.segments.len()
            );
            self.add(FaultKind::TooFew, vec![], vec![], message);
        }
        if self.faults.is_empty() {
            self.size();
        }
        if self.faults.is_empty() {
            self.nearly_zero();
        }
    }

    fn size(&mut self) {
        let bounds = Rect::around(self.pslg.vertices.iter().copied());
        let side = bounds.size().max_element();
        if side > 0.0 && side < SMALLEST_SIDE {
            let [x, y] = bounds.min.to_array();
            let message = format!("all vertices lie in a box at ({x:?}, {y:?}) whose larger side is {side:e}");
            self.add(FaultKind::TooSmall, vec![], vec![], message);
        }
    }

    fn nearly_zero(&mut self) {
        for (v, &p) in self.pslg.vertices.iter().enumerate() {
            if p.to_array().iter().any(|&x| x != 0.0 && x.abs() < SMALLEST) {
                let message = format!("{} is at ({:?}, {:?})", self.vertex(v), p.x, p.y);
                self.add(FaultKind::NearlyZero, vec![v], vec![], message);
            }
        }
    }

    fn duplicate_vertices(&mut self) {
        let place = |&v: &usize| self.pslg.vertices[v] + DVec2::ZERO;
        let mut order: Vec<usize> = (0..self.pslg.vertices.len()).collect();
        order.sort_by(|u, v| by_place(place(u), place(v)).then(u.cmp(v)));
        let mut pairs: Vec<(usize, usize)> = order
            .chunk_by(|u, v| place(u) == place(v))
            .flat_map(|group| group[1..].iter().map(|&v| (group[0], v)))
            .collect();
        pairs.sort_unstable_by_key(|&(_, v)| v);
        for (u, v) in pairs {
            let p = self.pslg.vertices[v];
            let message = format!(
                "{} and {} are both at ({}, {})",
                self.vertex(u),
                self.vertex(v),
                p.x,
                p.y
            );
            self.add(FaultKind::DuplicateVertices, vec![u, v], vec![], message);
        }
    }

    fn degenerate_segments(&mut self) {
        let key = |&s: &usize| {
            let segment = self.pslg.segments[s];
            (segment.a.min(segment.b), segment.a.max(segment.b))
        };
        let mut order: Vec<usize> = (0..self.pslg.segments.len()).collect();
        for &s in &order {
            let (a, b) = key(&s);
            if a == b {
                let message = format!("{} goes from {} to itself", self.segment(s), self.vertex(a));
                self.add(FaultKind::ZeroLength, vec![a], vec![s], message);
            }
        }
        order.sort_by(|r, s| key(r).cmp(&key(s)).then(r.cmp(s)));
        let mut pairs: Vec<(usize, usize)> = order
            .chunk_by(|r, s| key(r) == key(s))
            .flat_map(|group| group[1..].iter().map(|&s| (group[0], s)))
            .collect();
        pairs.sort_unstable_by_key(|&(_, s)| s);
        for (r, s) in pairs {
            let (a, b) = key(&s);
            if a != b {
                let (first, second) = (self.vertex(a), self.vertex(b));
                let message = format!(
                    "{} and {} both join {first} and {second}",
                    self.segment(r),
                    self.segment(s)
                );
                self.add(FaultKind::RepeatedSegment, vec![a, b], vec![r, s], message);
            }
        }
    }

    /// Segments that meet away from a common vertex, and vertices on segments.
    fn meetings(&mut self) {
        let pslg = self.pslg;
        let index = SegmentIndex::new((0..pslg.segments.len()).map(|s| pslg.ends(s)));
        let mut near = Vec::new();
        for s in 0..pslg.segments.len() {
            if self.is_full() {
                return;
            }
            near.clear();
            index.in_box(Rect::around(pslg.ends(s)), |r| near.push(r));
            near.sort_unstable();
            for &r in near.iter().filter(|&&r| r > s) {
                self.meeting(s, r);
            }
        }
        let mut on_segment = vec![false; pslg.vertices.len()];
        for segment in &pslg.segments {
            on_segment[segment.a] = true;
            on_segment[segment.b] = true;
        }
        for v in (0..pslg.vertices.len()).filter(|&v| !on_segment[v]) {
            let mut at = None;
            index.in_box(Rect::around([pslg.vertices[v]]), |s| {
                at = Some(at.map_or(s, |known: usize| known.min(s)))
            });
            if let Some(s) = at {
                self.vertex_on_segment(v, s);
            }
        }
    }

    fn meeting(&mut self, r: usize, s: usize) {
        let pslg = self.pslg;
        let ([a, b], [c, d]) = (pslg.ends(r), pslg.ends(s));
        if a == b || c == d {
            return;
        }
        let (first, second) = (pslg.segments[r], pslg.segments[s]);
        match segments_meet(a, b, c, d) {
            Meeting::Apart => {}
            Meeting::Cross => {
                let p = crossing(a, b, c, d);
                let message = format!(
                    "{} and {} cross near ({}, {})",
                    self.segment(r),
                    self.segment(s),
                    p.x,
                    p.y
                );
                self.add(FaultKind::Crossing, vec![], vec![r, s], message);
            }
            Meeting::Overlap if [a, b].contains(&c) && [a, b].contains(&d) => {
                // The same two places: a repeated segment or two pairs of duplicate vertices, reported already.
            }
            Meeting::Overlap => {
                let message = format!("{} and {} run along each other", self.segment(r), self.segment(s));
                self.add(FaultKind::Overlap, vec![], vec![r, s], message);
            }
            Meeting::Touch => {
                // Ends at the same place are one vertex, or duplicates reported already.
                for (v, ends, on) in [
                    (first.a, [c, d], s),
                    (first.b, [c, d], s),
                    (second.a, [a, b], r),
                    (second.b, [a, b], r),
                ] {
                    let p = pslg.vertices[v];
                    let strictly = !ends.contains(&p) && segments_meet(p, p, ends[0], ends[1]) != Meeting::Apart;
                    if strictly {
                        self.vertex_on_segment(v, on);
                    }
                }
            }
        }
    }

    fn vertex_on_segment(&mut self, v: usize, s: usize) {
        let known = |f: &Fault| f.kind == FaultKind::VertexOnSegment && f.vertices == [v] && f.segments == [s];
        let p = self.pslg.vertices[v];
        if self.pslg.ends(s).contains(&p) || self.faults.iter().any(known) {
            return;
        }
        let message = format!("{} at ({}, {}) lies on {}", self.vertex(v), p.x, p.y, self.segment(s));
        self.add(FaultKind::VertexOnSegment, vec![v], vec![s], message);
    }
}

fn named(what: &str, lines: &[usize], i: usize, file: &str) -> String {
    lines
        .get(i)
        .map_or_else(|| what.to_owned(), |line| format!("{what} (line {line}{file})"))
}

/// Lexicographic order of finite points.
pub(super) fn by_place(p: DVec2, q: DVec2) -> Ordering {
    p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y))
}

/// Where two crossing segments cross, rounded.
pub(super) fn crossing(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> DVec2 {
    let (along, other) = (b - a, d - c);
    a + along * ((c - a).perp_dot(other) / along.perp_dot(other))
}
