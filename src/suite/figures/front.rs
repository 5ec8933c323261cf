//! What circles bitten so far leave uncovered: arcs of the circles, and pieces of the input segments (§5.1, "the front becomes
//! a set of segments and arcs").
//!
//! Recomputed from domain and circles by comparing every pair, apart from the mesher's own front, which keeps vertices alone
//! and none before the boundary is covered.

use super::tolerance::NOTHING;
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::near::{Disc, Near, circle_intersections};
use crate::geometry::tolerance::COVERED;
use crate::suite::charts::scene::Arc;
use std::f64::consts::TAU;

/// Whether `disc` covers `point`.
pub(super) fn covers(disc: &Disc, point: DVec2) -> bool {
    point.distance(disc.centre) < disc.radius * (1.0 - COVERED)
}

/// The arcs of all circles that lie in the domain and in no other circle, each with the index of its circle.
pub(super) fn arcs(domain: &Domain, discs: &[Disc]) -> Vec<(usize, Arc)> {
    let own = |(index, disc): (usize, &Disc)| {
        let others: Vec<&Disc> = discs
            .iter()
            .enumerate()
            .filter(|(k, _)| *k != index)
            .map(|(_, disc)| disc)
            .collect();
        let near: Vec<&Disc> = others.into_iter().filter(|other| meet(disc, other)).collect();
        let mut cuts = cuts_by_domain(domain, disc);
        cuts.extend(near.iter().flat_map(|other| cuts_by_disc(disc, other)));
        let is_left = |point| domain.contains(point) && !near.iter().any(|other| covers(other, point));
        let arcs = parts(disc, cuts, is_left);
        arcs.into_iter().map(move |arc| (index, arc)).collect::<Vec<_>>()
    };
    discs.iter().enumerate().flat_map(own).collect()
}

/// The parts of input segments that lie in no circle.
pub(super) fn pieces(domain: &Domain, discs: &[Disc]) -> Vec<[DVec2; 2]> {
    let own = |segment: usize| {
        let ends = domain.ends(segment);
        let at = |share: f64| ends[0].lerp(ends[1], share);
        let mut cuts: Vec<f64> = discs.iter().flat_map(|disc| crossings(disc, ends)).collect();
        cuts.extend([0.0, 1.0]);
        cuts.sort_by(f64::total_cmp);
        let is_left = |share: f64| !discs.iter().any(|disc| covers(disc, at(share)));
        let parts = cuts.windows(2).filter(|cut| cut[1] - cut[0] > NOTHING);
        let left = parts.filter(|cut| is_left(0.5 * (cut[0] + cut[1])));
        left.map(|cut| [at(cut[0]), at(cut[1])]).collect::<Vec<_>>()
    };
    (0..domain.segments().len()).flat_map(own).collect()
}

/// The arcs of a circle inside the domain.
pub(super) fn in_domain(domain: &Domain, disc: &Disc) -> Vec<Arc> {
    parts(disc, cuts_by_domain(domain, disc), |point| domain.contains(point))
}

/// Where two circles meet: the points of both.
pub(super) fn meeting_points(one: &Disc, other: &Disc) -> Option<[DVec2; 2]> {
    let offset = other.centre - one.centre;
    let near = Near {
        id: 0,
        offset,
        distance_squared: offset.length_squared(),
        radius: other.radius,
    };
    let is_within = one.radius - other.radius;
    let may_meet = near.distance_squared > is_within * is_within && meet(one, other);
    may_meet.then(|| circle_intersections(one.radius, &near).map(|relative| one.centre + relative))
}

fn meet(one: &Disc, other: &Disc) -> bool {
    one.centre.distance(other.centre) < one.radius + other.radius
}

fn cuts_by_disc(disc: &Disc, other: &Disc) -> Vec<f64> {
    let points = meeting_points(disc, other).into_iter().flatten();
    points.map(|point| (point - disc.centre).to_angle()).collect()
}

fn cuts_by_domain(domain: &Domain, disc: &Disc) -> Vec<f64> {
    let ends = (0..domain.segments().len()).map(|segment| domain.ends(segment));
    let cuts = ends.flat_map(|ends| {
        let shares = crossings(disc, ends);
        shares
            .into_iter()
            .map(move |share| (ends[0].lerp(ends[1], share) - disc.centre).to_angle())
    });
    cuts.collect()
}

/// Where a segment crosses a circle, as shares of the segment.
fn crossings(disc: &Disc, ends: [DVec2; 2]) -> Vec<f64> {
    let length = ends[0].distance(ends[1]);
    let direction = (ends[1] - ends[0]) / length;
    let to_centre = disc.centre - ends[0];
    let (along, across) = (to_centre.dot(direction), to_centre.perp_dot(direction));
    let half_squared = disc.radius * disc.radius - across * across;
    if half_squared <= 0.0 {
        return Vec::new();
    }
    let half = half_squared.sqrt();
    let shares = [along - half, along + half].map(|position| position / length);
    shares.into_iter().filter(|share| (0.0..=1.0).contains(share)).collect()
}

/// The parts of a circle, cut at some angles, whose middles are wanted; neighbours are joined.
fn parts(disc: &Disc, mut cuts: Vec<f64>, is_wanted: impl Fn(DVec2) -> bool) -> Vec<Arc> {
    let arc = |start: f64, sweep: f64| Arc {
        disc: *disc,
        start,
        sweep,
    };
    cuts.iter_mut().for_each(|cut| *cut = cut.rem_euclid(TAU));
    cuts.sort_by(f64::total_cmp);
    let gaps: Vec<Arc> = (0..cuts.len())
        .map(|k| {
            let end = cuts.get(k + 1).copied().unwrap_or(cuts[0] + TAU);
            arc(cuts[k], end - cuts[k])
        })
        .filter(|gap| gap.sweep > NOTHING)
        .collect();
    let wanted: Vec<bool> = gaps.iter().map(|gap| is_wanted(gap.at(0.5))).collect();
    let Some(first) = wanted.iter().position(|wanted| !wanted) else {
        let is_whole = !gaps.is_empty() || is_wanted(disc.centre + disc.radius * DVec2::X);
        return is_whole.then(|| Arc::whole(*disc)).into_iter().collect();
    };
    let mut joined: Vec<Arc> = Vec::new();
    let mut goes_on = false;
    for k in (0..gaps.len()).map(|k| (first + k) % gaps.len()) {
        match joined.last_mut().filter(|_| goes_on && wanted[k]) {
            Some(last) => last.sweep += gaps[k].sweep,
            None if wanted[k] => joined.push(gaps[k]),
            None => {}
        }
        goes_on = wanted[k];
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain;

    fn disc(x: f64, y: f64, radius: f64) -> Disc {
        Disc {
            centre: DVec2::new(x, y),
            radius,
        }
    }

    #[test]
    fn a_corner_circle_leaves_a_quarter_and_two_cut_sides() {
        let square = domain::load("unit-square").unwrap();
        let left = arcs(&square, &[disc(0.0, 0.0, 0.5)]);
        assert_eq!(left.len(), 1);
        assert!((left[0].1.sweep - 0.25 * TAU).abs() < 1e-12, "{left:?}");
        let pieces = pieces(&square, &[disc(0.0, 0.0, 0.5)]);
        let length: f64 = pieces.iter().map(|[a, b]| a.distance(*b)).sum();
        assert!((length - 3.0).abs() < 1e-12, "{pieces:?}");
    }

    #[test]
    fn a_circle_within_is_whole_and_one_within_another_gone() {
        let square = domain::load("unit-square").unwrap();
        let (large, small) = (disc(0.5, 0.5, 0.3), disc(0.5, 0.5, 0.1));
        assert_eq!(arcs(&square, &[large]), [(0, Arc::whole(large))]);
        assert_eq!(arcs(&square, &[large, small]), [(0, Arc::whole(large))]);
        assert_eq!(in_domain(&square, &large), [Arc::whole(large)]);
        assert!(in_domain(&square, &disc(0.5, 0.5, 2.0)).is_empty());
    }

    #[test]
    fn two_circles_leave_what_neither_covers() {
        let square = domain::load("unit-square").unwrap();
        let discs = [disc(0.4, 0.5, 0.2), disc(0.6, 0.5, 0.2)];
        let left = arcs(&square, &discs);
        assert_eq!(left.len(), 2, "joined over the angle 0");
        for (k, arc) in left {
            assert!((arc.sweep - TAU * 2.0 / 3.0).abs() < 1e-9);
            let other = discs[1 - k];
            assert!(arc.points(50).iter().all(|point| !covers(&other, *point)));
        }
        let [one, other] = meeting_points(&discs[0], &discs[1]).unwrap();
        assert!((one - other).perp_dot(DVec2::Y).abs() < 1e-12 && one.distance(other) > 0.3);
    }
}
