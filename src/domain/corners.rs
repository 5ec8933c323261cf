//! Angles between neighbouring segments at every vertex: the input angles of the paper's hypothesis (§5.1).

use super::{Domain, Face, Segment};
use crate::geometry::tolerance::{ACUTE_MARGIN, NO_ANGLE, RIGHT_ANGLE_DEG};
use crate::geometry::{DVec2, turn};
use std::f64::consts::{FRAC_PI_3, TAU};

/// The part of a vertex' neighbourhood between two segments that follow one another around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge {
    /// The segment on the clockwise side.
    pub from: usize,
    /// The segment on the counter-clockwise side; equal to `from` where the vertex has one segment.
    pub to: usize,
    /// Angle from `from` to `to`, counter-clockwise, in radians, in (0, 2π].
    pub angle: f64,
    /// The face the wedge opens into.
    pub face: usize,
    /// Whether that face belongs to the domain.
    pub inside: bool,
}

impl Wedge {
    /// Whether the wedge is an angle under 90° that opens to the outside.
    pub fn is_notch(&self) -> bool {
        !self.inside && self.angle > NO_ANGLE && self.angle.to_degrees() < 90.0 - RIGHT_ANGLE_DEG
    }
}

/// The wedges of every vertex and what follows from them.
#[derive(Clone, Debug, Default)]
pub(super) struct Corners {
    start: Vec<usize>,
    wedges: Vec<Wedge>,
    smallest_input: f64,
    smallest_segment: f64,
    acute: Vec<usize>,
}

impl Corners {
    /// Measures every wedge; `around` lists each vertex' outgoing half-edges counter-clockwise.
    pub fn new<'a>(
        vertices: &[DVec2],
        segments: &[Segment],
        faces: &[Face],
        around: impl Fn(usize) -> &'a [usize],
    ) -> Self {
        let mut corners = Self {
            start: vec![0],
            smallest_input: TAU,
            smallest_segment: TAU,
            ..Self::default()
        };
        for (v, &at) in vertices.iter().enumerate() {
            let outgoing = around(v);
            let direction = |h: usize| {
                let segment = &segments[h / 2];
                vertices[if h.is_multiple_of(2) { segment.b } else { segment.a }] - at
            };
            for (i, &h) in outgoing.iter().enumerate() {
                let next = outgoing[(i + 1) % outgoing.len()];
                let angle = if next == h {
                    TAU
                } else {
                    turn(direction(h), direction(next))
                };
                let segment = &segments[h / 2];
                let face = if h.is_multiple_of(2) {
                    segment.left
                } else {
                    segment.right
                };
                corners.note(
                    v,
                    Wedge {
                        from: h / 2,
                        to: next / 2,
                        angle,
                        face,
                        inside: faces[face].inside,
                    },
                );
            }
            corners.start.push(corners.wedges.len());
        }
        corners
    }

    fn note(&mut self, v: usize, wedge: Wedge) {
        self.wedges.push(wedge);
        self.smallest_segment = self.smallest_segment.min(wedge.angle);
        if wedge.inside {
            self.smallest_input = self.smallest_input.min(wedge.angle);
            let is_acute = wedge.angle > NO_ANGLE && wedge.angle < FRAC_PI_3 - ACUTE_MARGIN;
            if is_acute && self.acute.last() != Some(&v) {
                self.acute.push(v);
            }
        }
    }
}

impl Domain {
    /// The wedges between the segments at vertex `v`, counter-clockwise; none where it is isolated.
    pub fn wedges(&self, v: usize) -> &[Wedge] {
        &self.corners.wedges[self.corners.start[v]..self.corners.start[v + 1]]
    }

    /// The unit vector along segment `s` away from its end `v`, and the segment's length.
    pub fn away(&self, s: usize, v: usize) -> (DVec2, f64) {
        let segment = self.segments()[s];
        let other = if segment.a == v { segment.b } else { segment.a };
        let along = self.vertices()[other] - self.vertices()[v];
        (along / along.length(), along.length())
    }

    /// The smallest angle between segments that opens into the domain, in degrees. The paper assumes at least 90.
    pub fn smallest_input_angle_deg(&self) -> f64 {
        self.corners.smallest_input.to_degrees()
    }

    /// The smallest angle between two segments at a common vertex, inside or outside, in degrees; 360 if none meet.
    pub fn smallest_segment_angle_deg(&self) -> f64 {
        self.corners.smallest_segment.to_degrees()
    }

    /// Whether no two neighbouring segments meet at an angle under 90°, inside or outside, as §5.1 assumes.
    pub fn has_no_acute_angle(&self) -> bool {
        self.smallest_segment_angle_deg() >= 90.0 - RIGHT_ANGLE_DEG
    }

    /// The vertices with an angle under 60° that opens into the domain, in order: triangles that touch them are
    /// excused from the angle bound.
    pub fn acute_vertices(&self) -> &[usize] {
        &self.corners.acute
    }
}
