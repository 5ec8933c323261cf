//! Mends what can be mended in a PSLG without guessing: duplicates, repeats, T-junctions, crossings.
//!
//! Everything that floating-point numbers can express is mended without moving anything: equal vertices become one,
//! segments of length zero and repeats are removed, a segment with a vertex on it is cut there. Where segments cross, the point
//! of crossing is rounded to a grid of [`REPAIR_GRID`] of the PSLG's size; i_overlay finds the crossings and makes sure that
//! the cut and slightly bent pieces cross nothing new. Only segments that cross take part, and their ends stay where
//! they are; [`RepairReport`] says how far the pieces lie from the segments they came from.

use super::FaultKind;
use super::pslg::{Fill, InputSegment, Pslg, Source};
use super::validate::{self, by_place};
use crate::geometry::predicates::{Meeting, segments_meet};
use crate::geometry::segments::SegmentIndex;
use crate::geometry::{DVec2, Rect};
use std::fmt;

#[cfg(doc)]
use crate::geometry::tolerance::REPAIR_GRID;

mod crossings;

/// Rounds in which only crossing segments are put on the grid; bent pieces hardly ever cross anything in the second.
const LOCAL_ROUNDS: usize = 6;

/// Rounds in all; in the later ones every vertex moves to the grid, where pieces cross nothing.
const ROUNDS: usize = 10;

/// What [`repair()`] changed, and by how much.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RepairReport {
    /// Vertices merged into another one: at the same place, or nearer than the grid where segments cross.
    pub merged_vertices: usize,
    /// Segments of length zero removed.
    pub zero_length: usize,
    /// Segments removed because another one joins the same vertices.
    pub repeated: usize,
    /// Cuts of a segment at a vertex that lay on it.
    pub cuts: usize,
    /// New vertices where segments crossed.
    pub crossings: usize,
    /// Vertices that moved.
    pub moved_vertices: usize,
    /// The largest distance by which a vertex moved or a piece left its segment, in the unit of the PSLG.
    pub largest_displacement: f64,
}

impl RepairReport {
    /// Whether nothing was changed.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl fmt::Display for RepairReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("nothing to repair");
        }
        let counts = [
            (self.merged_vertices, "vertices merged"),
            (self.zero_length, "segments of length zero removed"),
            (self.repeated, "repeated segments removed"),
            (self.cuts, "cuts at vertices on segments"),
            (self.crossings, "vertices added at crossings"),
            (self.moved_vertices, "vertices moved"),
        ];
        let told: Vec<String> = counts
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        write!(
            f,
            "{}; largest displacement {:.3e}",
            told.join(", "),
            self.largest_displacement
        )
    }
}

/// Mends what can be mended and says what changed. Coordinates that are not finite, unknown vertices and open boundaries
/// remain, for [`super::Domain::new`] to report. O((n + k) log n) for n segments that meet k times.
pub fn repair(input: Pslg) -> (Pslg, RepairReport) {
    let mut report = RepairReport::default();
    let hopeless = |kind| {
        matches!(
            kind,
            FaultKind::NotFinite | FaultKind::NoSuchVertex | FaultKind::TooSmall | FaultKind::NearlyZero
        )
    };
    let faults = validate::faults(&input);
    if faults.iter().any(|fault| hopeless(fault.kind)) || !faults.iter().any(|fault| fault.kind.is_repairable()) {
        return (input, report);
    }
    let mut work = Work::new(&input);
    for round in 0..ROUNDS {
        work.merge_duplicates(&mut report);
        work.tidy(&mut report);
        work.cut_at_vertices(&mut report);
        work.tidy(&mut report);
        let mut crossing = work.crossing();
        if crossing.is_empty() {
            break;
        }
        let is_global = round >= LOCAL_ROUNDS;
        if is_global {
            crossing = (0..work.segments.len()).collect();
        }
        crossings::split(&mut work, &crossing, is_global, &mut report);
    }
    (work.finish(input), report)
}

/// A segment in the making.
#[derive(Clone, Copy, Debug)]
struct Piece {
    a: usize,
    b: usize,
    marker: i32,
    /// Whether an odd number of rings runs along it, which is what counts under the even-odd rule.
    flips: bool,
}

/// A PSLG in the making.
struct Work {
    vertices: Vec<DVec2>,
    markers: Vec<i32>,
    segments: Vec<Piece>,
}

impl Work {
    fn new(input: &Pslg) -> Self {
        let flips = |s: usize| match &input.fill {
            Fill::HolePoints(_) => true,
            Fill::EvenOdd { flips } => flips[s],
        };
        let piece = |(s, segment): (usize, &InputSegment)| {
            let &InputSegment { a, b, marker } = segment;
            Piece {
                a,
                b,
                marker,
                flips: flips(s),
            }
        };
        Self {
            vertices: input.vertices.clone(),
            markers: (0..input.vertices.len()).map(|v| input.vertex_marker(v)).collect(),
            segments: input.segments.iter().enumerate().map(piece).collect(),
        }
    }

    fn finish(self, input: Pslg) -> Pslg {
        let fill = match input.fill {
            Fill::EvenOdd { .. } => Fill::EvenOdd {
                flips: self.segments.iter().map(|piece| piece.flips).collect(),
            },
            points @ Fill::HolePoints(_) => points,
        };
        let segments = self
            .segments
            .iter()
            .map(|&Piece { a, b, marker, .. }| InputSegment { a, b, marker })
            .collect();
        let source = Source {
            file: format!("{} (repaired)", input.source.file),
            ..Source::default()
        };
        Pslg {
            vertices: self.vertices,
            vertex_markers: self.markers,
            segments,
            fill,
            source,
            ..input
        }
    }

    fn ends(&self, s: usize) -> [DVec2; 2] {
        [self.vertices[self.segments[s].a], self.vertices[self.segments[s].b]]
    }

    fn index(&self) -> SegmentIndex {
        SegmentIndex::new((0..self.segments.len()).map(|s| self.ends(s)))
    }

    /// Merges vertices at the same place into the first of them, with the first marker that is not 0.
    fn merge_duplicates(&mut self, report: &mut RepairReport) {
        let place = |v: &usize| self.vertices[*v] + DVec2::ZERO;
        let mut order: Vec<usize> = (0..self.vertices.len()).collect();
        order.sort_by(|u, v| by_place(place(u), place(v)).then(u.cmp(v)));
        let mut first: Vec<usize> = (0..self.vertices.len()).collect();
        for group in order.chunk_by(|u, v| place(u) == place(v)) {
            for &v in group {
                first[v] = group[0];
            }
        }
        report.merged_vertices += self.merge(&first);
    }

    /// Replaces every vertex v by `into[v]`, which is at most v and is replaced by itself; returns how many were removed.
    fn merge(&mut self, into: &[usize]) -> usize {
        let mut number = vec![0; into.len()];
        let mut kept = 0;
        for v in 0..into.len() {
            if into[v] == v {
                number[v] = kept;
                self.vertices[kept] = self.vertices[v];
                self.markers[kept] = self.markers[v];
                kept += 1;
            } else {
                number[v] = number[into[v]];
                if self.markers[number[v]] == 0 {
                    self.markers[number[v]] = self.markers[v];
                }
            }
        }
        self.vertices.truncate(kept);
        self.markers.truncate(kept);
        for piece in &mut self.segments {
            (piece.a, piece.b) = (number[piece.a], number[piece.b]);
        }
        into.len() - kept
    }

    /// Removes segments of length zero and repeats; of repeats the first stays, with the first marker that is not 0.
    fn tidy(&mut self, report: &mut RepairReport) {
        let before = self.segments.len();
        self.segments.retain(|piece| piece.a != piece.b);
        report.zero_length += before - self.segments.len();
        let key = |s: usize| {
            let piece = &self.segments[s];
            (piece.a.min(piece.b), piece.a.max(piece.b))
        };
        let mut order: Vec<usize> = (0..self.segments.len()).collect();
        order.sort_by_key(|&s| (key(s), s));
        let groups: Vec<Vec<usize>> = order
            .chunk_by(|&r, &s| key(r) == key(s))
            .filter(|group| group.len() > 1)
            .map(<[usize]>::to_vec)
            .collect();
        let mut gone = vec![false; self.segments.len()];
        for group in groups {
            for &s in &group[1..] {
                let repeat = self.segments[s];
                let first = &mut self.segments[group[0]];
                first.flips ^= repeat.flips;
                if first.marker == 0 {
                    first.marker = repeat.marker;
                }
                gone[s] = true;
                report.repeated += 1;
            }
        }
        let mut s = 0;
        self.segments.retain(|_| {
            s += 1;
            !gone[s - 1]
        });
    }

    /// Cuts every segment at the vertices that lie exactly on it.
    fn cut_at_vertices(&mut self, report: &mut RepairReport) {
        let index = self.index();
        let mut cuts: Vec<(usize, usize)> = Vec::new();
        for (v, &p) in self.vertices.iter().enumerate() {
            index.in_box(Rect::around([p]), |s| {
                if self.segments[s].a != v && self.segments[s].b != v {
                    cuts.push((s, v));
                }
            });
        }
        let along = |&(s, v): &(usize, usize)| {
            let [a, b] = self.ends(s);
            let axis = usize::from((b - a).y.abs() > (b - a).x.abs());
            let forward = if b[axis] >= a[axis] { 1.0 } else { -1.0 };
            forward * self.vertices[v][axis]
        };
        cuts.sort_by(|l, r| l.0.cmp(&r.0).then_with(|| along(l).total_cmp(&along(r))));
        report.cuts += cuts.len();
        let mut cuts = cuts.into_iter().peekable();
        let mut pieces = Vec::with_capacity(self.segments.len() + cuts.len());
        for (s, &piece) in self.segments.iter().enumerate() {
            let mut rest = piece;
            while let Some((_, v)) = cuts.next_if(|&(cut, _)| cut == s) {
                pieces.push(Piece { b: v, ..rest });
                rest.a = v;
            }
            pieces.push(rest);
        }
        self.segments = pieces;
    }

    /// The segments that cross another one, in order.
    fn crossing(&self) -> Vec<usize> {
        let index = self.index();
        let crosses = |s: usize| {
            let [a, b] = self.ends(s);
            let mut crosses = false;
            index.in_box(Rect::around([a, b]), |r| {
                let [c, d] = self.ends(r);
                crosses |= segments_meet(a, b, c, d) == Meeting::Cross;
            });
            crosses
        };
        (0..self.segments.len()).filter(|&s| crosses(s)).collect()
    }
}
