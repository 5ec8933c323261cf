//! A part of a segment that may be uncovered, and what points eat of it, by either rule.

use crate::geometry::near::{Disc, Near};
use crate::geometry::{DVec2, tolerance};
use crate::meshers::MeshError;
use crate::meshers::biting::beyond::crossing::PassingLine;
use crate::meshers::biting::front::Front;
use crate::theory::Rule;

/// A part of a segment that may be uncovered, seen from the end at which it is bitten next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    pub segment: usize,
    /// The segment's end nearer to `low`, and the unit vector from it to the other end.
    start: DVec2,
    direction: DVec2,
    length: f64,
    /// Whether `start` is the segment's second vertex.
    reversed: bool,
    /// The part, by distance from `start`: its end q₁, at which it is bitten next, and its far end.
    pub low: f64,
    pub high: f64,
}

impl Gap {
    pub fn whole(front: &Front, segment: usize) -> Self {
        let [start, end] = front.domain.ends(segment);
        let length = start.distance(end);
        let ends = front.domain.segments()[segment];
        Self {
            segment,
            start,
            direction: (end - start) / length,
            length,
            reversed: false,
            low: front.cuts.distance(ends.a),
            high: length - front.cuts.distance(ends.b),
        }
    }

    /// The same gap seen from its other end.
    fn turned(self) -> Self {
        Self {
            start: self.start + self.direction * self.length,
            direction: -self.direction,
            reversed: !self.reversed,
            low: self.length - self.high,
            high: self.length - self.low,
            ..self
        }
    }

    /// The part from `low` on.
    pub fn behind(self, low: f64) -> Self {
        Self { low, ..self }
    }

    pub fn at(&self, position: f64) -> DVec2 {
        self.start + self.direction * position
    }

    pub fn circle_at(&self, front: &Front, position: f64) -> Result<Disc, MeshError> {
        let centre = self.at(position);
        Ok(Disc {
            centre,
            radius: front.radius_at(centre)?,
        })
    }

    /// `position` as a distance from the segment's first vertex.
    pub fn along_segment(&self, position: f64) -> f64 {
        if self.reversed {
            self.length - position
        } else {
            position
        }
    }

    /// Where the segment enters and leaves a circle near `circle`, shrunk by [`tolerance::COVERED`].
    fn chord(&self, circle: Disc, near: &Near) -> Option<(f64, f64)> {
        let (along, across) = self.place(circle, near);
        let radius = near.radius * (1.0 - tolerance::COVERED);
        let half_squared = radius * radius - across * across;
        (half_squared > 0.0).then(|| (along - half_squared.sqrt(), along + half_squared.sqrt()))
    }

    /// Where the centre of a disc near `circle` is: its position along the segment, and its distance from the segment's
    /// line, with a sign.
    fn place(&self, circle: Disc, near: &Near) -> (f64, f64) {
        let to_centre = circle.centre + near.offset - self.start;
        (to_centre.dot(self.direction), to_centre.perp_dot(self.direction))
    }

    /// The segment's line relative to the point at `along`, `across`, with g taken as `share` of what it is.
    fn line_past<'a>(&self, front: &Front<'a>, (along, across): (f64, f64), share: f64, guess: f64) -> PassingLine<'a> {
        PassingLine {
            sizing: front.radii,
            foot: self.at(along),
            direction: self.direction,
            away: across.abs(),
            share,
            guess,
        }
    }

    /// The position where the gap leaves what the centre of `near` has eaten. That holds the centre of `circle`, at the
    /// low end of the gap. The position is past the high end if the gap does not leave it, and not above the low end
    /// if, by rounding, the gap has left it already.
    pub fn exit(&self, front: &Front, circle: Disc, near: &Near) -> Result<f64, MeshError> {
        match front.rule {
            Rule::Earlier => Ok(self.chord(circle, near).map_or(self.low, |(_, exit)| exit)),
            Rule::Later => {
                let place = self.place(circle, near);
                let line = self.line_past(front, place, 1.0 - tolerance::COVERED, circle.radius);
                let exit = line.exit([self.low - place.0, self.high - place.0])?;
                Ok(exit.map_or(f64::INFINITY, |exit| place.0 + exit))
            }
        }
    }

    /// The first stretch of the gap that the centre of `near` has eaten. By the rule of the later point, a stretch that
    /// begins before the gap is left out.
    pub fn eaten(&self, front: &Front, circle: Disc, near: &Near) -> Result<Option<(f64, f64)>, MeshError> {
        match front.rule {
            Rule::Earlier => Ok(self.chord(circle, near)),
            Rule::Later => {
                let place = self.place(circle, near);
                let line = self.line_past(front, place, 1.0 - tolerance::COVERED, circle.radius);
                let crossings = line.crossings([self.low - place.0, self.high - place.0])?;
                let mut crossings = crossings.iter().skip_while(|crossing| crossing.rises);
                let Some(entry) = crossings.next() else { return Ok(None) };
                let exit = crossings.next().map_or(self.high, |exit| place.0 + exit.at);
                Ok(Some((place.0 + entry.at, exit)))
            }
        }
    }

    /// What a bite leaves of the gap; each part is bitten at its other end next.
    pub fn without(
        self,
        front: &Front,
        position: f64,
        disc: Disc,
    ) -> Result<impl Iterator<Item = Self> + use<>, MeshError> {
        let (before, after) = match front.rule {
            Rule::Earlier => (position - disc.radius, position + disc.radius),
            Rule::Later => {
                let line = self.line_past(front, (position, 0.0), 1.0, disc.radius);
                let crossings = line.crossings([self.low - position, self.high - position])?;
                let crossing = |rises: bool| crossings.iter().find(|crossing| crossing.rises == rises);
                (
                    crossing(false).map_or(f64::NEG_INFINITY, |entry| position + entry.at),
                    crossing(true).map_or(f64::INFINITY, |exit| position + exit.at),
                )
            }
        };
        let before = Self { high: before, ..self };
        let after = Self { low: after, ..self };
        let parts = [before, after].into_iter().filter(|part| part.low <= part.high);
        Ok(parts.map(Self::turned))
    }
}
