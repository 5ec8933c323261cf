//! What a biting circle cannot see: points of the domain beyond a notch.
//!
//! # Idea
//! A notch is an angle under 90° between two segments that opens to the outside. A circle centred on one side of it, or
//! behind that side, reaches across the notch and holds points beyond the other side. The paper's proofs count such a
//! point as covered, but no triangle joins it to that centre, and segments bitten from across a notch are left with
//! pieces far too long for their own circles. So here a circle covers only points that no notch hides from its centre.
//!
//! # Why that leaves no new kind of front
//! Let a circle of radius s(x) have its centre x outside the circle of the notch's vertex v. Behind v it goes on for at
//! most s(x) − ‖x − v‖ ≤ s(v) − (1 − t) ‖x − v‖ ≤ t s(v). So the border of what the notch hides from x lies in the
//! circle of v, and the front consists of arcs of circles as before.

use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use crate::geometry::segments::{SegmentIndex, closest_on_segment};
use crate::geometry::tolerance::SAME_VERTEX_ULPS;

/// An angle under 90° that opens to the outside, counter-clockwise from one ray to the other.
#[derive(Clone, Copy, Debug)]
struct Notch {
    vertex: DVec2,
    /// Unit vectors along its two segments, and the segments' lengths.
    rays: [DVec2; 2],
    lengths: [f64; 2],
}

/// All notches of a domain.
#[derive(Default)]
pub(in crate::meshers::biting) struct Notches {
    notches: Vec<Notch>,
    /// Their segments: those of notch k are at 2k and 2k + 1.
    index: SegmentIndex,
    /// A point no farther than this from a side counts as on it, since centres on segments are rounded.
    slack: f64,
}

impl Notches {
    /// The notches of `domain`.
    pub fn new(domain: &Domain) -> Self {
        let mut notches = Vec::new();
        for (v, &vertex) in domain.vertices().iter().enumerate() {
            for wedge in domain.wedges(v).iter().filter(|wedge| wedge.is_notch()) {
                let ways = [wedge.from, wedge.to].map(|s| domain.away(s, v));
                notches.push(Notch {
                    vertex,
                    rays: ways.map(|(direction, _)| direction),
                    lengths: ways.map(|(_, length)| length),
                });
            }
        }
        let sides = notches.iter().flat_map(|notch| [notch.side(0), notch.side(1)]);
        Self {
            index: SegmentIndex::new(sides),
            notches,
            slack: SAME_VERTEX_ULPS * f64::EPSILON * domain.bounds().largest_coordinate(),
        }
    }

    /// Whether a circle may hold points that its centre cannot see: whether it meets both sides of a notch.
    pub fn are_near(&self, disc: Disc) -> bool {
        let Disc { centre, radius } = disc;
        let mut is_near = false;
        self.index.within(centre, radius, |side, _| {
            let notch = &self.notches[side / 2];
            is_near |= closest_on_segment(notch.side(1 - side % 2), centre).distance(centre) <= radius;
        });
        is_near
    }

    /// Whether a notch lies between the points `x` and `y`.
    pub fn part(&self, x: DVec2, y: DVec2) -> bool {
        let mut parted = false;
        self.index.within(x, x.distance(y) + self.slack, |side, _| {
            let notch = &self.notches[side / 2];
            parted |= side % 2 == 0 && (notch.parts(x, y, self.slack) || notch.parts(y, x, self.slack));
        });
        parted
    }
}

impl Notch {
    fn side(&self, which: usize) -> [DVec2; 2] {
        [self.vertex, self.vertex + self.rays[which] * self.lengths[which]]
    }

    /// Whether the straight line from `x` to `y` crosses the first side and then the second; an end of it may lie on a
    /// side.
    fn parts(&self, x: DVec2, y: DVec2, slack: f64) -> bool {
        let ([first, second], [from, to]) = (self.rays, [x - self.vertex, y - self.vertex]);
        let turn = from.perp_dot(to);
        // Both rays lie between the two ends, seen from the vertex.
        let ends_first = from.perp_dot(first) >= -slack && from.perp_dot(second) > 0.0;
        let ends_second = second.perp_dot(to) >= -slack && first.perp_dot(to) > 0.0;
        let way = to - from;
        let crosses = |ray: DVec2, length: f64| turn <= ray.perp_dot(way) * (length + slack);
        turn > 0.0 && ends_first && ends_second && crosses(first, self.lengths[0]) && crosses(second, self.lengths[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Pslg;

    /// A square with a notch of `degrees` cut into it from above, its vertex in the middle.
    fn notched(degrees: f64) -> Domain {
        let half = (0.5 * degrees.to_radians()).tan();
        let mut pslg = Pslg::new("notched");
        let ring = [
            (-2.0, -1.0),
            (2.0, -1.0),
            (2.0, 1.0),
            (half, 1.0),
            (0.0, 0.0),
            (-half, 1.0),
            (-2.0, 1.0),
        ];
        pslg.add_ring(ring.map(|(x, y)| DVec2::new(x, y)), 1);
        Domain::new(pslg).expect("a valid domain")
    }

    #[test]
    fn a_notch_parts_what_lies_on_both_sides_of_it_above_its_vertex() {
        let domain = notched(40.0);
        let notches = Notches::new(&domain);
        let [left, right] = [DVec2::new(-0.6, 0.5), DVec2::new(0.6, 0.5)];
        assert!(notches.part(left, right) && notches.part(right, left));
        let low = DVec2::new(0.6, -0.6);
        assert!(!notches.part(left, low) && !notches.part(low, right) && !notches.part(left, left));
        // Points on the sides themselves.
        let on = domain.vertices()[3] * 0.5;
        assert!(notches.part(left, on) && notches.part(on, left));
        assert!(!notches.part(right, on) && !notches.part(on, domain.vertices()[3] * 0.75));
        // Above both sides there is nothing in between.
        assert!(!notches.part(DVec2::new(-2.0, 1.1), DVec2::new(2.0, 1.1)));
    }

    #[test]
    fn only_circles_that_meet_both_sides_are_near() {
        let notches = Notches::new(&notched(40.0));
        let disc = |radius| Disc {
            centre: DVec2::new(-0.3, 0.5),
            radius,
        };
        assert!(notches.are_near(disc(0.6)) && !notches.are_near(disc(0.2)));
        assert!(!Notches::new(&notched(100.0)).are_near(disc(0.6)));
    }
}
