//! Bites on a segment, with the points of §5.1 and §6.2: what figures 2 and 5 show.

use super::front::meeting_points;
use super::run::Run;
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use crate::meshers::Reason;

/// A bite labelled B(p₁).
#[derive(Clone, Copy, Debug)]
pub(super) struct Progressive {
    /// Which segment.
    pub segment: usize,
    /// B(p₁, c_b f(p₁)), bitten before.
    pub p1: Disc,
    /// B(q, c_b f(q)), the progressive circle.
    pub q: Disc,
    /// Where the two circles meet inside the domain.
    pub r: DVec2,
    /// The distance of r to the segment.
    pub h_r: f64,
}

/// A bite labelled M(p₁, p₂).
#[derive(Clone, Copy, Debug)]
pub(super) struct Middle {
    /// Which segment.
    pub segment: usize,
    /// The circles of p₁ and p₂, bitten before.
    pub p1: Disc,
    pub p2: Disc,
    /// Where p₁ is labelled B(p₀): the circle of p₀.
    pub p0: Option<Disc>,
    /// Where the circles of p₁ and p₂ leave the segment, with the circles there would be at these points.
    pub q1: Disc,
    pub q2: Disc,
    /// B(q, c_b f(q)), the middle circle.
    pub q: Disc,
    /// Where the circles of p₁ and q meet inside the domain.
    pub r: DVec2,
    /// The distance of r to the segment.
    pub h_r: f64,
}

/// Every bite labelled B(p₁) of a run, on segments that are level with the domain above.
pub(super) fn progressive(run: &Run) -> Vec<Progressive> {
    let found = run.bites.iter().enumerate().filter_map(|(k, bite)| {
        let Reason::Progressive { segment } = bite.reason else {
            return None;
        };
        let (p1, q) = (run.disc(run.circle_through(bite.centre, segment, k)?), run.disc(k));
        let (r, h_r) = meeting_above(run, segment, &p1, &q)?;
        Some(Progressive { segment, p1, q, r, h_r })
    });
    found.filter(|found| run.is_level(found.segment)).collect()
}

/// Every bite labelled M(p₁, p₂) of a run, on segments that are level with the domain above.
pub(super) fn middle(run: &Run) -> Vec<Middle> {
    let found = run.bites.iter().enumerate().filter_map(|(k, bite)| {
        let Reason::Middle { segment, between } = bite.reason else {
            return None;
        };
        let parents = between.map(|point| run.circle_through(point, segment, k));
        // p₁ is the one that is labelled itself, if there is one.
        let origin = |k: usize| match run.bites[k].reason {
            Reason::Progressive { .. } => run.circle_through(run.bites[k].centre, segment, k),
            _ => None,
        };
        let turned = parents[0].and_then(origin).is_none();
        let pick = |side: usize| if turned { 1 - side } else { side };
        let (first, second) = (parents[pick(0)]?, parents[pick(1)]?);
        let (p1, p2, q) = (run.disc(first), run.disc(second), run.disc(k));
        let (r, h_r) = meeting_above(run, segment, &p1, &q)?;
        Some(Middle {
            segment,
            p1,
            p2,
            p0: origin(first).map(|k| run.disc(k)),
            q1: run.disc_at(between[pick(0)]),
            q2: run.disc_at(between[pick(1)]),
            q,
            r,
            h_r,
        })
    });
    found.filter(|found| run.is_level(found.segment)).collect()
}

/// The point r inside the domain where two circles on a segment meet, and its distance to it.
fn meeting_above(run: &Run, segment: usize, one: &Disc, other: &Disc) -> Option<(DVec2, f64)> {
    let [a, b] = run.case.domain.ends(segment);
    let points = meeting_points(one, other)?;
    let r = points
        .into_iter()
        .filter(|point| run.case.domain.contains(*point))
        .max_by(|u, v| u.y.total_cmp(&v.y))?;
    let h_r = (b - a).perp_dot(r - a).abs() / a.distance(b);
    Some((r, h_r))
}

/// How much two radii differ, as a share of the larger.
pub(super) fn difference(one: &Disc, other: &Disc) -> f64 {
    (one.radius - other.radius).abs() / one.radius.max(other.radius)
}
