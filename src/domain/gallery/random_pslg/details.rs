//! Kinds that are about what lies inside an outline.

use super::draft::Draft;
use super::outlines;
use crate::geometry::DVec2;
use std::f64::consts::TAU;

/// A box or polygon with small holes, some of them near each other or the outline.
pub(super) fn holes(draft: &mut Draft) {
    outlines::any(draft);
    for _ in 0..draft.count(1, 5) {
        let (centre, radius) = (draft.point(), draft.power(-2.0, -0.6));
        let corners = draft.count(3, 7);
        let ring = outlines::star_ring(draft, centre, radius, corners, 0.5);
        draft.hole(&ring, centre);
    }
}

/// Rings within rings, holes and land by turns, turned against one another.
pub(super) fn islands(draft: &mut Draft) {
    let centre = DVec2::splat(0.5);
    let corners = draft.count(3, 8);
    let (mut radius, mut gap) = (1.0, 0.0);
    for depth in 0..draft.count(2, 5) {
        let ring = outlines::star_ring(draft, centre, radius, corners, 0.9);
        // A hole point lies between this ring and the next, which is the smaller the further in it is.
        if draft.ring(&ring) && depth % 2 == 1 {
            gap = radius;
        }
        radius *= draft.number(0.3, 0.7) * (std::f64::consts::PI / corners as f64).cos();
        if depth % 2 == 1 && gap > 0.0 {
            let inside = 0.5 * (ring[0] - centre) * (1.0 + radius / gap) + centre;
            draft.pslg.add_hole(inside);
        }
    }
}

/// Segments between vertices of an outline and points inside, some of them with hanging ends.
pub(super) fn chords(draft: &mut Draft) {
    outlines::any(draft);
    for _ in 0..draft.count(1, 8) {
        let last = draft.pslg.vertices.len() - 1;
        let from = draft.count(0, last);
        if draft.chance(0.5) {
            let to = draft.count(0, last);
            draft.join(from, to);
        } else {
            let to = draft.point();
            draft.reach(from, to);
        }
    }
}

/// Isolated points, some of them near vertices or segments.
pub(super) fn points(draft: &mut Draft) {
    outlines::any(draft);
    for _ in 0..draft.count(1, 10) {
        let x = if draft.chance(0.5) {
            draft.point()
        } else {
            near_something(draft, -4.0)
        };
        draft.vertex(x);
    }
}

/// A point beside a vertex or a segment, at a distance from 10 to the power `least` to a tenth.
fn near_something(draft: &mut Draft, least: f64) -> DVec2 {
    let away = draft.power(least, -1.0) * draft.direction();
    let segment = draft.count(0, draft.pslg.segments.len() - 1);
    let [a, b] = draft.pslg.ends(segment);
    match draft.chance(0.5) {
        true => a + away,
        false => a.lerp(b, draft.number(0.1, 0.9)) + away,
    }
}

/// Segments from one vertex, 1° to 20° apart, some of them joined at their other ends.
pub(super) fn fan(draft: &mut Draft) {
    outlines::any(draft);
    let apex = if draft.chance(0.5) {
        let x = draft.point();
        draft.vertex(x)
    } else {
        Some(draft.count(0, draft.pslg.vertices.len() - 1))
    };
    let Some(apex) = apex else {
        return;
    };
    let at = draft.pslg.vertices[apex];
    let mut angle = draft.number(0.0, TAU);
    let mut last = None;
    for _ in 0..draft.count(2, 7) {
        let length = draft.number(0.05, 0.6);
        let tip = draft.reach(apex, at + length * DVec2::from_angle(angle));
        if let (Some(last), Some(tip)) = (last, tip)
            && draft.chance(0.3)
        {
            draft.join(last, tip);
        }
        last = tip;
        angle += draft.power(0.0, 1.3).to_radians();
    }
}

/// Cracks of one to three segments, from the boundary or free.
pub(super) fn slits(draft: &mut Draft) {
    outlines::any(draft);
    for _ in 0..draft.count(1, 5) {
        let mut at = if draft.chance(0.4) {
            Some(draft.count(0, draft.pslg.vertices.len() - 1))
        } else {
            let x = draft.point();
            draft.vertex(x)
        };
        let mut ahead = draft.direction();
        for _ in 0..draft.count(1, 3) {
            let Some(from) = at else {
                break;
            };
            let step = draft.power(-2.0, -0.4);
            ahead = DVec2::from_angle(draft.number(-1.5, 1.5)).rotate(ahead);
            at = draft.reach(from, draft.pslg.vertices[from] + step * ahead);
        }
    }
}

/// Features that almost touch: points, ends and small holes 1e-9 to 1e-3 from others.
pub(super) fn touch(draft: &mut Draft) {
    outlines::any(draft);
    for _ in 0..draft.count(1, 3) {
        let gap = draft.power(-9.0, -3.0);
        let segment = draft.count(0, draft.pslg.segments.len() - 1);
        let [a, b] = draft.pslg.ends(segment);
        let foot = match draft.chance(0.3) {
            true => a,
            false => a.lerp(b, draft.number(0.1, 0.9)),
        };
        let side = if draft.chance(0.5) { 1.0 } else { -1.0 };
        let across = side * (b - a).perp().normalize_or_zero();
        let near = foot + gap * across;
        match draft.count(0, 2) {
            0 => {
                draft.vertex(near);
            }
            1 => {
                // A segment whose end stops short.
                let far = near + draft.number(0.05, 0.3) * DVec2::from_angle(draft.number(-1.0, 1.0)).rotate(across);
                if let Some(far) = draft.vertex(far) {
                    draft.reach(far, near);
                }
            }
            _ => {
                let size = draft.number(0.05, 0.2);
                let wide = draft.number(0.2, 0.6);
                let arm = |angle: f64| size * DVec2::from_angle(angle).rotate(across);
                let ring = [near, near + arm(wide), near + arm(-wide)];
                draft.hole(&ring, (ring[0] + ring[1] + ring[2]) / 3.0);
            }
        }
    }
}

/// A graph of random segments in a box, between few points so that many meet at one.
pub(super) fn network(draft: &mut Draft) {
    outlines::square(draft);
    let points: Vec<DVec2> = (0..draft.count(3, 10)).map(|_| draft.point()).collect();
    net(draft, &points);
}

/// The same with points of a grid: collinear, cocircular, parallel, all of it exactly.
pub(super) fn lattice(draft: &mut Draft) {
    let side = draft.count(2, 5);
    let at = |x: usize, y: usize| DVec2::new(x as f64, y as f64);
    let mut ring: Vec<DVec2> = (0..side).map(|k| at(k, 0)).collect();
    ring.extend((0..side).map(|k| at(side, k)));
    ring.extend((0..side).map(|k| at(side - k, side)));
    ring.extend((0..side).map(|k| at(0, side - k)));
    draft.ring(&ring);
    let points: Vec<DVec2> = (0..draft.count(2, 8))
        .map(|_| at(draft.count(1, side), draft.count(1, side)))
        .collect();
    net(draft, &points);
}

fn net(draft: &mut Draft, points: &[DVec2]) {
    for &x in points {
        draft.vertex(x);
    }
    for _ in 0..draft.count(2, 14) {
        let last = draft.pslg.vertices.len() - 1;
        let (from, to) = (draft.count(0, last), draft.count(0, last));
        draft.join(from, to);
    }
}

/// A little of everything.
pub(super) fn mixed(draft: &mut Draft) {
    outlines::any(draft);
    for _ in 0..draft.count(2, 4) {
        let last = draft.pslg.vertices.len() - 1;
        match draft.count(0, 4) {
            0 => {
                let (centre, radius, corners) = (draft.point(), draft.power(-2.0, -0.8), draft.count(3, 6));
                let ring = outlines::star_ring(draft, centre, radius, corners, 0.4);
                if draft.chance(0.5) {
                    draft.hole(&ring, centre);
                } else {
                    draft.ring(&ring);
                }
            }
            1 => {
                let (from, to) = (draft.count(0, last), draft.count(0, last));
                draft.join(from, to);
            }
            2 => {
                let (from, to) = (draft.count(0, last), draft.point());
                draft.reach(from, to);
            }
            3 => {
                let x = near_something(draft, -6.0);
                draft.vertex(x);
            }
            _ => {
                let from = draft.point();
                let to = from + draft.power(-3.0, -0.5) * draft.direction();
                if let Some(from) = draft.vertex(from) {
                    draft.reach(from, to);
                }
            }
        }
    }
}
