//! Step 2: the candidates, each the centre of a circle: points on the input segments, and samples in the leaves.
//!
//! # On segments
//! The length of a segment in units of s is Λ = ∫ dx / s. If it is divided evenly in that measure into ⌊Λ⌋ parts, the
//! division points are about s apart; if some are nearer than s, fewer parts are made. Each part is divided again, by
//! the oversampling factor. All these points are candidates. Those of the even division come first in the order of
//! insertion, so that the pieces of a segment are equally long unless something else is in the way.
//!
//! # In leaves
//! The oversampling factor is the number of points per side of a leaf, each in the middle of its square
//! ([`Sampling::Regular`]) or anywhere in it ([`Sampling::Jittered`]). They are made when a leaf is processed, and not
//! at all if one circle covers the leaf: a mesh of 10⁶ triangles has about 10⁷ candidates, most of which are never
//! examined.

use super::balance::Leaf;
use super::{Field, QuadtreeMis};
use crate::geometry::near::Disc;
use crate::geometry::{DVec2, tolerance};
use crate::meshers::MeshError;
use crate::meshers::sizing::Sizing;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

/// Where samples are in their squares.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sampling {
    /// In the middle.
    #[default]
    Regular,
    /// Anywhere, by seed.
    Jittered,
}

/// Step of the sum that measures a segment, over s.
const MEASURING_STEP: f64 = 0.25;

/// The factor by which the number of parts falls each time that the points turn out to be less than s apart. The reason
/// is the error of the sum that measured the segment, which is below t² / 100 of it.
const SHORTER: f64 = 0.99;

/// A candidate on a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OnSegment {
    pub segment: usize,
    /// Distance from the segment's first vertex.
    pub position: f64,
    pub disc: Disc,
    /// Whether it is a point of the segment's even division.
    pub even: bool,
}

/// The candidates on all segments: segment by segment, the points of the even division first, small circles before large
/// ones, then the points between, from end to end.
pub(super) fn circles(field: &Field) -> Result<Vec<OnSegment>, MeshError> {
    let mut candidates = Vec::new();
    let (mesher, domain) = (field.mesher, field.domain);
    let mut random = Pcg64::seed_from_u64(field.seed);
    for segment in 0..domain.segments().len() {
        let ruler = Ruler::new(domain.ends(segment), segment, &field.sizing)?;
        let mut even = ruler.even_division()?;
        let parts = even.len() + 1;
        even.sort_by(|one, other| one.disc.radius.total_cmp(&other.disc.radius));
        candidates.extend(even);
        let factor = mesher.oversample as usize;
        for between in (1..parts * factor).filter(|k| !k.is_multiple_of(factor)) {
            let shift = match mesher.sampling {
                Sampling::Regular => 0.0,
                Sampling::Jittered => random.random_range(-0.5..0.5),
            };
            let share = (between as f64 + shift) / (parts * factor) as f64;
            candidates.push(ruler.candidate(share, false)?);
        }
    }
    Ok(candidates)
}

/// Measures a segment in units of s.
struct Ruler<'a> {
    sizing: &'a Sizing<'a>,
    segment: usize,
    start: DVec2,
    direction: DVec2,
    /// Positions along the segment, each with ∫ dx / s up to there.
    marks: Vec<(f64, f64)>,
}

impl<'a> Ruler<'a> {
    fn new([start, end]: [DVec2; 2], segment: usize, sizing: &'a Sizing<'a>) -> Result<Self, MeshError> {
        let length = start.distance(end);
        let direction = (end - start) / length;
        let mut marks = vec![(0.0, 0.0)];
        let (mut position, mut measured, mut size) = (0.0, 0.0, sizing.at(start)?);
        while position < length {
            let step = if sizing.t() > 0.0 {
                MEASURING_STEP * size
            } else {
                length
            };
            let next = if position + 1.5 * step < length {
                position + step
            } else {
                length
            };
            let next_size = sizing.at(start + direction * next)?;
            measured += 0.5 * (next - position) * (1.0 / size + 1.0 / next_size);
            (position, size) = (next, next_size);
            marks.push((position, measured));
        }
        Ok(Self {
            sizing,
            segment,
            start,
            direction,
            marks,
        })
    }

    /// The candidate at a share of the segment's length in units of s.
    fn candidate(&self, share: f64, even: bool) -> Result<OnSegment, MeshError> {
        let last = self.marks.len() - 1;
        let wanted = share * self.marks[last].1;
        let after = self.marks.partition_point(|mark| mark.1 < wanted).clamp(1, last);
        let (before, after) = (self.marks[after - 1], self.marks[after]);
        let position = before.0 + (after.0 - before.0) * (wanted - before.1) / (after.1 - before.1);
        let centre = self.start + self.direction * position;
        let radius = self.sizing.at(centre)?;
        Ok(OnSegment {
            segment: self.segment,
            position,
            disc: Disc { centre, radius },
            even,
        })
    }

    /// The inner points of the division into as many equal parts, in units of s, as keep points s apart. For neighbours
    /// the smaller of their two s counts; for the first and the last point, the s at the ends.
    fn even_division(&self) -> Result<Vec<OnSegment>, MeshError> {
        let last = self.marks.len() - 1;
        let ends = [0, last].map(|mark| self.marks[mark].0);
        let end_sizes = [
            self.sizing.at(self.start)?,
            self.sizing.at(self.start + self.direction * ends[1])?,
        ];
        let mut parts = (self.marks[last].1 * (1.0 + tolerance::COVERED)).floor();
        while parts > 1.0 {
            let points = (1..parts as usize).map(|k| self.candidate(k as f64 / parts, true));
            let points = points.collect::<Result<Vec<_>, _>>()?;
            let inner = points.windows(2).all(|pair| {
                let smaller = pair[0].disc.radius.min(pair[1].disc.radius);
                pair[1].position - pair[0].position >= smaller * (1.0 - tolerance::COVERED)
            });
            let apart = |point: &OnSegment, end: usize| {
                (point.position - ends[end]).abs() >= end_sizes[end] * (1.0 - tolerance::COVERED)
            };
            if inner && apart(&points[0], 0) && apart(&points[points.len() - 1], 1) {
                return Ok(points);
            }
            parts = (parts - 1.0).min((parts * SHORTER).floor());
        }
        Ok(Vec::new())
    }
}

/// One row of the samples of a leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Number of the leaf in its tile.
    pub leaf: usize,
    /// The number of the row, from below.
    pub number: u32,
    /// Middle of the row's part of the leaf.
    pub centre: DVec2,
    /// Half the width and height of that part.
    pub half: DVec2,
}

/// A row of the samples of a leaf; rows are counted from below.
pub(super) fn row(mesher: &QuadtreeMis, leaf: usize, place: &Leaf, number: u32) -> Row {
    let half = DVec2::new(place.half, place.half / f64::from(mesher.oversample));
    let bottom = place.centre.y - place.half;
    Row {
        leaf,
        number,
        centre: DVec2::new(place.centre.x, bottom + f64::from(2 * number + 1) * half.y),
        half,
    }
}

/// The samples of a row, from the left.
pub(super) fn samples<'a>(mesher: &'a QuadtreeMis, row: &'a Row, random: &'a mut Pcg64) -> impl Iterator<Item = DVec2> {
    let left = row.centre.x - row.half.x;
    (0..mesher.oversample).map(move |column| {
        let middle = DVec2::new(left + f64::from(2 * column + 1) * row.half.y, row.centre.y);
        match mesher.sampling {
            Sampling::Regular => middle,
            Sampling::Jittered => {
                let mut shift = || random.random_range(-row.half.y..row.half.y);
                middle + DVec2::new(shift(), shift())
            }
        }
    })
}
