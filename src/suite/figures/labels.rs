//! Which circles the paper's labels name: p₁ of B(p₁), p₁ and p₂ of M(p₁, p₂) (§6.2).

use super::tolerance::ON_CIRCLE as ON;
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::segments::closest_on_segment;
use crate::meshers::{Bite, Reason};

/// The label of a bite of edge protection.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Label {
    /// Which segment is protected.
    pub segment: usize,
    /// The bites whose circles leave the segment at `points`, as far as there are any: a cut corner has none.
    pub circles: Vec<Option<usize>>,
    /// q of B(p₁), or q₁ and q₂ of M(p₁, p₂).
    pub points: Vec<DVec2>,
}

/// The label of bite `k`, if edge protection made it.
pub(crate) fn label(domain: &Domain, bites: &[Bite], k: usize) -> Option<Label> {
    let (segment, points) = match bites[k].reason {
        Reason::Progressive { segment } => (segment, vec![bites[k].centre]),
        Reason::Middle { segment, between } => (segment, between.to_vec()),
        Reason::InputVertex | Reason::CutCorner | Reason::FrontVertex => return None,
    };
    let earlier = &bites[..k];
    let ends = domain.ends(segment);
    let circles = points.iter().map(|&q| circle_through(earlier, ends, q)).collect();
    Some(Label {
        segment,
        circles,
        points,
    })
}

/// The bite whose circle passes through `q`, best one centred on the segment itself.
pub(crate) fn circle_through(bites: &[Bite], ends: [DVec2; 2], q: DVec2) -> Option<usize> {
    let off_circle = |bite: &Bite| (bite.centre.distance(q) - bite.radius).abs() / bite.radius;
    let through = (0..bites.len()).filter(|&k| off_circle(&bites[k]) < ON);
    through.min_by(|&one, &other| {
        let rank = |k: usize| {
            let Bite { centre, radius, .. } = bites[k];
            let is_beside = closest_on_segment(ends, centre).distance(centre) > ON * radius;
            (is_beside, off_circle(&bites[k]))
        };
        let (one, other) = (rank(one), rank(other));
        one.0.cmp(&other.0).then(one.1.total_cmp(&other.1))
    })
}
