//! Pieces: what encroaches upon them, where they are split, and when they may be.

use super::triangles::Flaw;
use super::{DelaunayRefinement, Encroachment};
use crate::delaunay::Refinable;
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::meshers::MeshError;
use std::f64::consts::FRAC_PI_3;

/// To improve an angle, no vertex comes nearer to another than this share of what input and sizes ask for there. The
/// proofs that refinement ends need shares of about 1/30.
pub(super) const FLOOR: f64 = 1.0 / 1024.0;

/// To improve an angle, no piece at an acute vertex becomes shorter than this share of what the features and sizes
/// around it ask for: the nearest feature that could require a shorter piece is that far away.
pub(super) const SHELL_FLOOR: f64 = 1.0 / 4.0;

/// Why a triangle or a piece is left as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Left {
    /// The angle is the input's, or mending it would shorten the pieces at an acute vertex below [`SHELL_FLOOR`].
    AtAcuteVertex,
    /// Coordinates do not resolve the point.
    ByRounding,
    /// Edges would become shorter than [`FLOOR`].
    ByFloor,
}

/// When a vertex is too near to a piece.
pub(super) struct Nearness {
    /// Squared cosine of the angle under which a piece is seen from the rim of its lens; 0 for the circle.
    cosine_squared: f64,
    /// Whether free vertices in the diametral circle are removed for a split, as by Chew.
    pub clears: bool,
}

impl Nearness {
    pub fn new(parameters: &DelaunayRefinement) -> Self {
        let is_lens = parameters.encroachment == Encroachment::Lens;
        let cosine = (2.0 * parameters.angle.to_radians()).cos();
        Self {
            cosine_squared: if is_lens { cosine * cosine } else { 0.0 },
            clears: is_lens,
        }
    }

    /// Whether `x` encroaches upon the piece with these ends.
    pub fn encroaches(&self, ends: [DVec2; 2], x: DVec2) -> bool {
        let [to_a, to_b] = ends.map(|end| end - x);
        let dot = to_a.dot(to_b);
        dot < 0.0 && dot * dot >= self.cosine_squared * to_a.length_squared() * to_b.length_squared()
    }
}

/// Whether `x` lies inside the circle that has the piece with these ends as diameter.
pub(super) fn in_diametral_circle(ends: [DVec2; 2], x: DVec2) -> bool {
    (ends[0] - x).dot(ends[1] - x) < 0.0
}

/// Acute input angles and the concentric shells around them.
pub(super) struct Shells {
    /// For each segment, the shortest piece that may be made at its first and last vertex to improve an angle; none if
    /// that vertex has no acute angle beside the segment.
    shortest: Vec<[Option<f64>; 2]>,
    length: Vec<f64>,
    /// For each input vertex, whether it has an acute angle.
    is_acute: Vec<bool>,
}

/// Where a piece is to be split.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    /// The place, as a share of the segment.
    pub share: f64,
    /// Length of the shorter part, or of the one at an acute vertex.
    pub part: f64,
    /// The shortest that this part may be to improve an angle; none away from acute vertices.
    pub shortest: Option<f64>,
}

impl Shells {
    /// Finds the acute angles; `size` gives s.
    pub fn new(domain: &Domain, size: impl Fn(DVec2) -> Result<f64, MeshError>) -> Result<Self, MeshError> {
        let ends = (0..domain.segments().len()).map(|segment| domain.ends(segment));
        let mut shells = Self {
            shortest: vec![[None; 2]; domain.segments().len()],
            length: ends.map(|[a, b]| a.distance(b)).collect(),
            is_acute: vec![false; domain.vertices().len()],
        };
        for &vertex in domain.acute_vertices() {
            shells.is_acute[vertex] = true;
            let x = domain.vertices()[vertex];
            let shortest = SHELL_FLOOR * feature_size_at(domain, vertex).min(size(x)?);
            let acute = |wedge: &&crate::domain::Wedge| wedge.inside && wedge.angle < FRAC_PI_3;
            for wedge in domain.wedges(vertex).iter().filter(acute) {
                for segment in [wedge.from, wedge.to] {
                    let end = usize::from(domain.segments()[segment].b == vertex);
                    shells.shortest[segment][end] = Some(shortest);
                }
            }
        }
        Ok(shells)
    }

    /// Whether a vertex of the triangulation is an input vertex with an acute angle.
    pub fn is_acute(&self, vertex: u32) -> bool {
        self.is_acute.get(vertex as usize).copied().unwrap_or(false)
    }

    /// Where to split a piece: in the middle or, at an acute vertex, at a distance from it that is a power of two,
    /// between one and two thirds of the piece.
    pub fn split(&self, triangulation: &Refinable, piece: u32) -> Split {
        let segment = triangulation.piece(piece).segment as usize;
        let [from, to] = triangulation.shares(piece);
        let length = (to - from) * self.length[segment];
        let [first, last] = self.shortest[segment];
        let shell = power_of_two_below(length / 1.5);
        if let (Some(shortest), true) = (first, from == 0.0) {
            return Split {
                share: shell / self.length[segment],
                part: shell,
                shortest: Some(shortest),
            };
        }
        if let (Some(shortest), true) = (last, to == 1.0) {
            return Split {
                share: 1.0 - shell / self.length[segment],
                part: shell,
                shortest: Some(shortest),
            };
        }
        Split {
            share: 0.5 * (from + to),
            part: 0.5 * length,
            shortest: None,
        }
    }
}

impl Split {
    /// Whether the split may be made: for a size always, for an angle down to the floors.
    pub fn check(&self, flaw: Flaw, floor: f64) -> Result<(), Left> {
        match (flaw, self.shortest) {
            (Flaw::Size, _) => Ok(()),
            (Flaw::Angle, Some(shortest)) if self.part < shortest => Err(Left::AtAcuteVertex),
            (Flaw::Angle, _) if self.part < floor => Err(Left::ByFloor),
            (Flaw::Angle, _) => Ok(()),
        }
    }
}

/// lfs at an input vertex (Definition 2.1): the distance to the nearest feature that is not incident to it.
pub(super) fn feature_size_at(domain: &Domain, vertex: usize) -> f64 {
    let x = domain.vertices()[vertex];
    let segments = domain.segments();
    let is_apart = |s: usize| segments[s].a != vertex && segments[s].b != vertex;
    let nearest = domain.index().nearest_where(x, is_apart);
    let own = domain.wedges(vertex).iter().map(|wedge| {
        let [a, b] = domain.ends(wedge.from);
        a.distance(b)
    });
    let others = domain.isolated().iter().filter(|&&other| other != vertex);
    let isolated = others.map(|&other| x.distance(domain.vertices()[other]));
    let nearest = nearest.map_or(f64::INFINITY, |(_, distance)| distance);
    own.chain(isolated).fold(nearest, f64::min)
}

/// The largest power of two that is at most `length`.
fn power_of_two_below(length: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    f64::from_bits(length.to_bits() & !MANTISSA)
}
