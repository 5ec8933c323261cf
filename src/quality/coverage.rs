//! Packing circles are disjoint (Lemma 5.4) and biting circles cover the domain (Theorem 5.5), without sampling.
//!
//! If the boundary is covered, closed discs cover the domain if and only if no arc of one of their circles lies in the
//! domain but in no other disc. Only circles through triangles that are not plainly covered are examined: in a mesh
//! much finer than f, as around a very small angle, every circle would meet every other.

use super::boundary::NO_SEGMENT;
use super::discs::{Disc, DiscTree};
use super::subject::{Sizes, Subject};
use super::tally::{Tally, Worst};
use super::{Check, parallel, shape};
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::tolerance::{CENTRE_ULPS, CERTIFICATE};
use crate::theory::Claim;
use crate::theory::Rule;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

/// `packing-disjoint`.
pub fn packing_check(sizes: &Sizes) -> Check {
    let c_p = sizes.packing_constant();
    let discs = sizes.circles.discs();
    let parts = parallel::map_ranges(discs.len(), |range| {
        let mut packing = Tally::new(Worst::Smallest);
        for disc in &discs[range] {
            let mut broken = 0;
            sizes.circles.meeting(disc.centre, disc.radius, |other| {
                if other.id != disc.id && sizes.are_joined(disc, other) {
                    broken += usize::from(see_pair(&mut packing, disc, other, c_p, sizes));
                }
                break_if(broken == MOST_BROKEN)
            });
        }
        packing
    });
    sizes.check(Tally::all(Worst::Smallest, parts), Claim::PackingDisjoint, 1.0)
}

/// `coverage` of a mesh; `is_whole` says that its triangles are known to make up the domain.
pub fn coverage_check(subject: &Subject, sizes: &Sizes, is_whole: bool) -> Check {
    match sizes.bounds.rule {
        Rule::Earlier => circles_check(subject, sizes, is_whole),
        Rule::Later => eaten::check(subject, sizes, is_whole),
    }
}

fn circles_check(subject: &Subject, sizes: &Sizes, is_whole: bool) -> Check {
    let discs = sizes.circles.discs();
    let open = is_whole.then(|| open_triangles(subject, sizes));
    let parts = parallel::map_ranges(discs.len(), |range| {
        let mut covering = Tally::new(Worst::Largest);
        let mut arcs = Vec::new();
        for disc in &discs[range] {
            let is_asked = open.as_ref().is_none_or(|open| passes_through(disc, open));
            let gap = match &sizes.reached {
                _ if !is_asked => 0.0,
                Some(reached) if reached.is_parted(disc, sizes) => open_arc::longest(disc, subject.domain, sizes),
                _ => gap_on(disc, &mut arcs, subject.domain, sizes),
            };
            covering.see(gap, disc.centre, gap > 0.0);
        }
        covering
    });
    let covering = Tally::all(Worst::Largest, parts).join(along_segments(subject, sizes));
    let coverage = sizes.check(covering, Claim::Coverage, 0.0);
    if coverage.holds {
        Check { at: None, ..coverage }
    } else {
        coverage
    }
}

/// How often a triangle is quartered to see that it is covered.
const QUARTERINGS: usize = 6;

/// Discs around the triangles that are not plainly covered.
fn open_triangles(subject: &Subject, sizes: &Sizes) -> DiscTree {
    let mut radii = vec![0.0; subject.mesh.points.len()];
    for disc in sizes.circles.discs() {
        radii[disc.id as usize] = disc.radius;
    }
    let open = parallel::map(subject.mesh.triangles.len(), |t| {
        let corners = subject.mesh.corners(t);
        let smallest = subject.mesh.triangles[t]
            .map(|k| radii[k as usize])
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        // Every point of a triangle is within its circumradius of a corner.
        let is_plain = shape::circumcentre(corners).distance(corners[0]) <= smallest;
        // If circles count only for what they reach, a disc that holds a part need not cover it.
        let is_covered = || sizes.reached.is_none() && is_covered(corners, &sizes.circles, QUARTERINGS);
        let is_open = !is_plain && !is_covered();
        is_open.then(|| disc_around(corners))
    });
    DiscTree::new(open.into_iter().flatten())
}

/// Whether a triangle can be quartered into parts each of which lies in one disc.
fn is_covered(corners: [DVec2; 3], circles: &DiscTree, quarterings: usize) -> bool {
    let (centre, radius) = disc_around(corners);
    if circles.one_holds(centre, radius) {
        return true;
    }
    let [a, b, c] = corners;
    let [d, e, f] = [b.midpoint(c), c.midpoint(a), a.midpoint(b)];
    let parts = [[d, e, f], [a, f, e], [f, b, d], [e, d, c]];
    quarterings > 0 && parts.into_iter().all(|part| is_covered(part, circles, quarterings - 1))
}

/// Centre and radius of a disc that holds a triangle.
fn disc_around(corners: [DVec2; 3]) -> (DVec2, f64) {
    let centre = shape::centroid(corners);
    (
        centre,
        corners
            .map(|corner| corner.distance(centre))
            .into_iter()
            .fold(0.0, f64::max),
    )
}

/// Whether a disc's circle has a point in one of `places`.
fn passes_through(disc: &Disc, places: &DiscTree) -> bool {
    let mut passes = false;
    places.meeting(disc.centre, disc.radius, |place| {
        passes = disc.centre.distance(place.centre) + place.radius >= disc.radius;
        break_if(passes)
    });
    passes
}

fn break_if(done: bool) -> ControlFlow<()> {
    if done {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

/// The longest arc of a disc's circle that lies in the domain but in no other disc, in radians; 0 if there is none.
fn gap_on(disc: &Disc, arcs: &mut Vec<(f64, f64)>, domain: &Domain, sizes: &Sizes) -> f64 {
    arcs.clear();
    let mut is_inside_another = false;
    sizes.circles.meeting(disc.centre, disc.radius, |other| {
        if other.id != disc.id {
            match covered_arc(disc, other) {
                Arc::All => is_inside_another = true,
                Arc::Part(from, to) => arcs.push((from, to)),
                Arc::None => {}
            }
        }
        break_if(is_inside_another)
    });
    if is_inside_another {
        0.0
    } else {
        largest_gap(disc, arcs, domain)
    }
}

/// Most broken pairs counted for one circle.
const MOST_BROKEN: usize = 256;

/// Notes the distance over the sum of the packing radii, once for each pair, and returns whether the circles overlap.
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

/// The longest arc of the circle that is in the domain but in no covered part, in radians; 0 if there is none.
fn largest_gap(disc: &Disc, arcs: &mut [(f64, f64)], domain: &Domain) -> f64 {
    let in_domain = |angle: f64| domain.contains(disc.centre + disc.radius * DVec2::from_angle(angle));
    arcs.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    // A part that extends beyond the end of the turn covers its beginning.
    let Some(mut reach) = arcs.iter().map(|arc| arc.1 - TAU).reduce(f64::max) else {
        // If the boundary is covered, a circle that meets no disc cannot cross it either.
        return if in_domain(0.0) { TAU } else { 0.0 };
    };
    let mut largest = 0.0;
    for &mut (from, to) in arcs {
        if from - reach > largest && in_domain(0.5 * (reach + from)) {
            largest = from - reach;
        }
        reach = reach.max(to);
    }
    largest
}

/// Whether input segments are covered along their length: the longest uncovered stretch of each piece, over the piece's
/// length.
fn along_segments(subject: &Subject, sizes: &Sizes) -> Tally {
    let points = &subject.mesh.points;
    let edges = subject.adjacency.edges().iter().zip(&subject.boundary.segment);
    let pieces = edges
        .filter(|(_, segment)| **segment != NO_SEGMENT)
        .map(|(edge, _)| edge.ends.map(|k| points[k as usize]));
    // A segment that is not a chain of edges is examined as a whole.
    let lost = subject.boundary.lost.iter().map(|(s, _)| subject.domain.ends(*s));
    let pieces: Vec<[DVec2; 2]> = pieces.chain(lost).collect();
    let parts = parallel::map_ranges(pieces.len(), |range| {
        let mut tally = Tally::new(Worst::Largest);
        for ends in &pieces[range] {
            let (gap, at) = uncovered_stretch(*ends, &sizes.circles, |id, x| sizes.counts(id, x));
            tally.see(gap, at, gap > 0.0);
        }
        tally
    });
    Tally::all(Worst::Largest, parts)
}

/// The longest uncovered stretch of a segment (the first of equal ones), over the segment's length, and its middle. A
/// disc covers a point only if it counts there.
fn uncovered_stretch([a, b]: [DVec2; 2], circles: &DiscTree, counts: impl Fn(u32, DVec2) -> bool) -> (f64, DVec2) {
    let (middle, direction) = (a.midpoint(b), b - a);
    let length = direction.length();
    let along = direction / length;
    let mut stretches = Vec::new();
    circles.meeting(middle, 0.5 * length, |disc| {
        let offset = disc.centre - a;
        let (foot, off) = (offset.dot(along), offset.perp_dot(along));
        let half = (disc.radius - off.abs()) * (disc.radius + off.abs());
        if half >= 0.0 && counts(disc.id, a + along * foot.clamp(0.0, length)) {
            stretches.push((foot - half.sqrt(), foot + half.sqrt()));
        }
        break_if(stretches.last().is_some_and(|&(from, to)| from <= 0.0 && to >= length))
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

mod eaten;
mod open_arc;
#[cfg(test)]
mod tests;
