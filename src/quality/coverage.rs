//! Packing circles are disjoint (Lemma 5.4) and biting circles cover the domain (Theorem 5.5), without sampling.

use super::boundary::NO_SEGMENT;
use super::discs::{Disc, DiscTree};
use super::subject::{Sizes, Subject};
use super::tally::{Tally, Worst};
use super::{Check, parallel};
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::tolerance::{CENTRE_ULPS, CERTIFICATE};
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

/// `packing-disjoint` and `coverage`.
pub fn checks(subject: &Subject, sizes: &Sizes) -> [Check; 2] {
    let c_p = sizes.bounds.c_b / (2.0 + sizes.t());
    let discs = sizes.circles.discs();
    let parts = parallel::map_ranges(discs.len(), |range| {
        let (mut packing, mut covering) = (Tally::new(Worst::Smallest), Tally::new(Worst::Largest));
        let mut arcs = Vec::new();
        for disc in &discs[range] {
            arcs.clear();
            // Far more circles meet this one only where a mesh is much finer than f; then what is to be known, soon is.
            let (mut is_covered, mut broken) = (false, 0);
            sizes.circles.meeting(disc.centre, disc.radius, |other| {
                if other.id != disc.id {
                    if broken < MOST_BROKEN {
                        broken += usize::from(see_pair(&mut packing, disc, other, c_p, sizes));
                    }
                    if !is_covered {
                        is_covered = add_arc(&mut arcs, disc, other);
                    }
                }
                match is_covered && broken == MOST_BROKEN {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            });
            let gap = match is_covered {
                true => 0.0,
                false => largest_gap(disc, &mut arcs, subject.domain),
            };
            covering.see(gap, disc.centre, gap > 0.0);
        }
        (packing, covering)
    });
    let (packing, covering): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
    let covering = Tally::all(Worst::Largest, covering).join(along_segments(subject, &sizes.circles));
    let check = |tally: Tally, claim, lemma, bound| tally.check(claim, lemma, sizes.applies(claim), bound);
    let coverage = check(covering, "coverage", "Theorem 5.5", 0.0);
    [
        check(
            Tally::all(Worst::Smallest, packing),
            "packing-disjoint",
            "Lemma 5.4",
            1.0,
        ),
        if coverage.holds {
            Check { at: None, ..coverage }
        } else {
            coverage
        },
    ]
}

/// Most broken pairs that are counted for a circle.
const MOST_BROKEN: usize = 256;

/// Notes distance over sum of packing radii, once for each pair, and says whether they overlap.
fn see_pair(packing: &mut Tally, disc: &Disc, other: &Disc, c_p: f64, sizes: &Sizes) -> bool {
    let [f, g] = [disc.id, other.id].map(|k| sizes.at_vertex[k as usize]);
    let radii = c_p * (f + g);
    let ratio = disc.centre.distance(other.centre) / radii;
    let coordinate = disc.centre.abs().max(other.centre.abs()).max_element();
    let rounding = CENTRE_ULPS * f64::EPSILON * coordinate / radii;
    let is_broken = ratio < 1.0 - CERTIFICATE - rounding;
    if disc.id < other.id {
        packing.see(ratio, disc.centre.midpoint(other.centre), is_broken);
    }
    is_broken
}

/// Notes the arc of a circle in another disc, and says whether the whole circle is known to be covered now: that is looked
/// into whenever there are twice as many arcs.
fn add_arc(arcs: &mut Vec<(f64, f64)>, disc: &Disc, other: &Disc) -> bool {
    match covered_arc(disc, other) {
        Arc::All => return true,
        Arc::Part(from, to) => arcs.push((from, to)),
        Arc::None => return false,
    }
    arcs.len() >= MANY_ARCS && arcs.len().is_power_of_two() && longest_gap(arcs, |_| true) == 0.0
}

/// So many arcs are worth a look.
const MANY_ARCS: usize = 64;

/// The part of a circle that lies in another closed disc.
enum Arc {
    None,
    /// From an angle in [−π, π) on, counter-clockwise to a larger one.
    Part(f64, f64),
    All,
}

fn covered_arc(disc: &Disc, other: &Disc) -> Arc {
    let offset = other.centre - disc.centre;
    let distance = offset.length();
    if distance + disc.radius <= other.radius {
        return Arc::All;
    }
    if distance + other.radius <= disc.radius {
        return Arc::None;
    }
    // Law of cosines, as a product so that large radii do not cancel.
    let cosine =
        (distance + (disc.radius - other.radius) * (disc.radius + other.radius) / distance) / (2.0 * disc.radius);
    let (middle, half) = (offset.to_angle(), cosine.clamp(-1.0, 1.0).acos());
    let from = middle - half;
    let from = if from < -PI { from + TAU } else { from };
    Arc::Part(from, from + 2.0 * half)
}

/// The longest arc of the circle that is in no covered part but in the domain, in radians; 0 if there is none.
fn largest_gap(disc: &Disc, arcs: &mut [(f64, f64)], domain: &Domain) -> f64 {
    let in_domain = |angle: f64| domain.contains(disc.centre + disc.radius * DVec2::from_angle(angle));
    if arcs.is_empty() {
        // A circle that meets no disc cannot cross the boundary either where that is covered.
        return if in_domain(0.0) { TAU } else { 0.0 };
    }
    longest_gap(arcs, in_domain)
}

/// The longest gap between arcs whose middle is `wanted`; 0 if there is none.
fn longest_gap(arcs: &mut [(f64, f64)], wanted: impl Fn(f64) -> bool) -> f64 {
    arcs.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    // What reaches over the end of the turn covers the beginning.
    let mut reach = arcs.iter().map(|arc| arc.1 - TAU).fold(f64::NEG_INFINITY, f64::max);
    let mut largest = 0.0;
    for &mut (from, to) in arcs {
        if from > reach && from - reach > largest && wanted(0.5 * (reach + from)) {
            largest = from - reach;
        }
        reach = reach.max(to);
    }
    largest
}

/// Input segments are covered along their length: the longest uncovered stretch of each piece, over the piece's length.
fn along_segments(subject: &Subject, circles: &DiscTree) -> Tally {
    let points = &subject.mesh.points;
    let edges = subject.adjacency.edges().iter().zip(&subject.boundary.segment);
    let pieces = edges
        .filter(|(_, segment)| **segment != NO_SEGMENT)
        .map(|(edge, _)| edge.ends.map(|k| points[k as usize]));
    // A segment that is no chain of edges is looked at whole.
    let lost = subject.boundary.lost.iter().map(|(s, _)| subject.domain.ends(*s));
    let pieces: Vec<[DVec2; 2]> = pieces.chain(lost).collect();
    let parts = parallel::map_ranges(pieces.len(), |range| {
        let mut tally = Tally::new(Worst::Largest);
        for ends in &pieces[range] {
            let (gap, at) = uncovered_stretch(*ends, circles);
            tally.see(gap, at, gap > 0.0);
        }
        tally
    });
    Tally::all(Worst::Largest, parts)
}

/// The longest uncovered stretch of a segment, over the segment's length, and its middle.
fn uncovered_stretch([a, b]: [DVec2; 2], circles: &DiscTree) -> (f64, DVec2) {
    let (middle, direction) = (a.midpoint(b), b - a);
    let length = direction.length();
    let along = direction / length;
    let mut stretches = Vec::new();
    circles.meeting(middle, 0.5 * length, |disc| {
        let offset = disc.centre - a;
        let (foot, off) = (offset.dot(along), offset.perp_dot(along));
        let half = (disc.radius - off.abs()) * (disc.radius + off.abs());
        if half >= 0.0 {
            stretches.push((foot - half.sqrt(), foot + half.sqrt()));
        }
        match stretches.last() {
            Some(&(from, to)) if from <= 0.0 && to >= length => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    });
    stretches.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    let (mut reach, mut worst) = (0.0, (0.0, middle));
    for (from, to) in stretches.into_iter().chain([(length, length)]) {
        let gap = (from.min(length) - reach) / length;
        if gap > worst.0 {
            worst = (gap, a + along * 0.5 * (reach + from.min(length)));
        }
        reach = reach.max(to);
    }
    worst
}
