//! Kinds that are about the outline.

use super::draft::Draft;
use crate::domain::gallery::random;
use crate::geometry::DVec2;
use std::f64::consts::{PI, TAU};

/// Random points untangled.
pub(super) fn polygon(draft: &mut Draft) {
    let (count, seed) = (draft.count(3, 16), draft.seed());
    draft.start_with(random::simple(count, seed));
}

/// A convex polygon.
pub(super) fn convex(draft: &mut Draft) {
    let (count, seed) = (draft.count(3, 20), draft.seed());
    draft.start_with(random::convex(count, seed));
}

/// The unit square, or a simple polygon.
pub(super) fn any(draft: &mut Draft) {
    if draft.chance(0.5) {
        square(draft);
    } else {
        let (count, seed) = (draft.count(3, 10), draft.seed());
        draft.start_with(random::simple(count, seed));
    }
}

/// The unit square.
pub(super) fn square(draft: &mut Draft) {
    draft.ring(&[DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
}

/// A ring of `count` points around `centre`, at directions in order and distances from `least` to 1 times `radius`.
pub(super) fn star_ring(draft: &mut Draft, centre: DVec2, radius: f64, count: usize, least: f64) -> Vec<DVec2> {
    let start = draft.number(0.0, TAU);
    let point = |draft: &mut Draft, k: usize| {
        let angle = start + (k as f64 + draft.number(-0.3, 0.3)) * TAU / count as f64;
        centre + radius * draft.number(least, 1.0) * DVec2::from_angle(angle)
    };
    (0..count).map(|k| point(draft, k)).collect()
}

/// A star with tips of 1° to 40°, some cut off short.
pub(super) fn needles(draft: &mut Draft) {
    let tips = draft.count(3, 7);
    let inner = draft.number(0.1, 0.3);
    let start = draft.number(0.0, TAU);
    let mut points = Vec::new();
    for tip in 0..tips {
        let middle = start + tip as f64 * TAU / tips as f64;
        let half = (0.5 * draft.power(0.0, 1.6)).to_radians();
        // The base of the tip lies on the inner circle, as wide as its angle asks, and no wider than there is room.
        let length = draft.number(0.3, 0.7);
        let wide = (length * half.tan() / inner).min(0.8 * PI / tips as f64);
        points.push(inner * DVec2::from_angle(middle - wide));
        points.push((inner + length) * DVec2::from_angle(middle));
        points.push(inner * DVec2::from_angle(middle + wide));
    }
    draft.ring(&points);
}

/// A triangle or quadrilateral with a corner of 1° to 30°.
pub(super) fn wedge(draft: &mut Draft) {
    let half = (0.5 * draft.power(0.0, 1.5)).to_radians();
    let along = draft.direction();
    let arm = |length: f64, angle: f64| length * DVec2::from_angle(angle).rotate(along);
    let (first, second) = (draft.number(0.3, 1.0), draft.number(0.3, 1.0));
    let mut points = vec![DVec2::ZERO, arm(first, -half)];
    if draft.chance(0.5) {
        points.push(arm(first.max(second) + draft.number(0.05, 0.5), 0.0));
    }
    points.push(arm(second, half));
    draft.ring(&points);
}

/// Cells of a square grid, every grid point on the outline a vertex: collinear and cocircular points everywhere.
pub(super) fn grid(draft: &mut Draft) {
    const SIDE: usize = 5;
    let mut taken = [[false; SIDE]; SIDE];
    let (mut column, mut row) = (draft.count(0, SIDE - 1), draft.count(0, SIDE - 1));
    for _ in 0..draft.count(3, 20) {
        taken[column][row] = true;
        let step = |draft: &mut Draft, at: usize| match draft.count(0, 1) {
            0 => at.saturating_sub(1),
            _ => (at + 1).min(SIDE - 1),
        };
        if draft.chance(0.5) {
            column = step(draft, column);
        } else {
            row = step(draft, row);
        }
    }
    let unit = if draft.chance(0.5) { 0.25 } else { 0.1 };
    let mut corner = [[None; SIDE + 1]; SIDE + 1];
    let is_taken = |c: usize, r: usize| c < SIDE && r < SIDE && taken[c][r];
    for c in 0..SIDE + 1 {
        for r in 0..SIDE + 1 {
            let (right, up) = ([(c, r), (c, r.wrapping_sub(1))], [(c, r), (c.wrapping_sub(1), r)]);
            for (sides, end) in [(right, (c + 1, r)), (up, (c, r + 1))] {
                let [first, second] = sides.map(|(c, r)| is_taken(c, r));
                if first == second && !(first && draft.chance(0.15)) {
                    continue;
                }
                let mut vertex = |(c, r): (usize, usize)| {
                    *corner[c][r].get_or_insert_with(|| draft.pslg.add_vertex(unit * DVec2::new(c as f64, r as f64)))
                };
                let ends = [vertex((c, r)), vertex(end)];
                draft.join(ends[0], ends[1]);
            }
        }
    }
    // Cells that are not taken but enclosed.
    for c in 0..SIDE {
        for r in 0..SIDE {
            if !taken[c][r] && is_enclosed(&taken, c, r) {
                draft.pslg.add_hole(unit * DVec2::new(c as f64 + 0.5, r as f64 + 0.5));
            }
        }
    }
}

/// Whether no path leads from a cell to the grid's rim without crossing a taken cell.
fn is_enclosed<const SIDE: usize>(taken: &[[bool; SIDE]; SIDE], column: usize, row: usize) -> bool {
    let mut seen = [[false; SIDE]; SIDE];
    let mut open = vec![(column, row)];
    while let Some((c, r)) = open.pop() {
        if taken[c][r] || std::mem::replace(&mut seen[c][r], true) {
            continue;
        }
        if c == 0 || r == 0 || c == SIDE - 1 || r == SIDE - 1 {
            return false;
        }
        open.extend([(c - 1, r), (c + 1, r), (c, r - 1), (c, r + 1)]);
    }
    true
}

/// Regular polygons around one centre, some with spokes: cocircular points.
pub(super) fn cocircular(draft: &mut Draft) {
    let count = draft.count(3, 16);
    let rings = draft.count(1, 3);
    let corner = |radius: f64, k: usize| radius * DVec2::from_angle(TAU * k as f64 / count as f64);
    // A ring lies within the next, whose sides come as near to the centre as the cosine says.
    let shrink = draft.number(0.3, 0.95) * (PI / count as f64).cos();
    for ring in 0..rings {
        let radius = shrink.powi(ring as i32);
        let points: Vec<DVec2> = (0..count).map(|k| corner(radius, k)).collect();
        draft.ring(&points);
    }
    if draft.chance(0.3) {
        draft.pslg.add_hole(DVec2::ZERO);
    } else if draft.chance(0.5)
        && let Some(centre) = draft.vertex(DVec2::ZERO)
    {
        let spokes = draft.count(1, count);
        for k in 0..spokes {
            draft.join(centre, (rings - 1) * count + k);
        }
    }
    if rings > 1 && draft.chance(0.4) {
        for k in 0..draft.count(1, count) {
            draft.join(k, count + k);
        }
    }
}

/// A polygon whose sides are divided by further vertices, as nearly collinear as rounding or a kink of up to 1e-3 leaves them.
pub(super) fn divided(draft: &mut Draft) {
    let (count, seed) = (draft.count(3, 8), draft.seed());
    let kink = if draft.chance(0.5) {
        0.0
    } else {
        draft.power(-13.0, -3.0)
    };
    let coarse = draft.chance(0.4);
    let outline: Vec<DVec2> = match draft.chance(0.3) {
        true => vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y],
        false => random::simple(count, seed).vertices,
    };
    let mut points = Vec::new();
    for (k, &from) in outline.iter().enumerate() {
        let to = outline[(k + 1) % outline.len()];
        points.push(from);
        let pieces = draft.count(1, 5);
        for piece in 1..pieces {
            let share = if coarse {
                piece as f64 / pieces as f64
            } else {
                draft.number(0.0, 1.0)
            };
            points.push(from.lerp(to, share) + kink * draft.number(-1.0, 1.0) * (to - from).perp());
        }
    }
    sort_along(&mut points, &outline);
    if !draft.ring(&points) {
        draft.start_with(random::simple(count, seed));
    }
}

/// Puts the points between two corners of `outline` in the order in which they come.
fn sort_along(points: &mut [DVec2], outline: &[DVec2]) {
    let mut corners = outline.iter().peekable();
    let mut begin = 0;
    while let Some(&corner) = corners.next() {
        let next = corners.peek().copied();
        let end = (begin + 1..points.len())
            .find(|&k| Some(&points[k]) == next)
            .unwrap_or(points.len());
        points[begin + 1..end].sort_by(|a, b| corner.distance(*a).total_cmp(&corner.distance(*b)));
        begin = end;
    }
}

/// A comb of teeth and gaps of widths that differ a hundredfold.
pub(super) fn comb(draft: &mut Draft) {
    let teeth = draft.count(2, 5);
    let mut x = 0.0;
    let mut points = vec![DVec2::ZERO];
    for _ in 0..teeth {
        let (width, gap) = (draft.power(-2.0, -0.5), draft.power(-2.0, -0.5));
        let (tip, slant) = (draft.number(0.25, 0.6), draft.number(-0.3, 0.3) * width);
        points.extend([
            DVec2::new(x + gap, 0.2),
            DVec2::new(x + gap + slant, tip),
            DVec2::new(x + gap + width + slant, tip),
            DVec2::new(x + gap + width, 0.2),
        ]);
        x += gap + width;
    }
    points.push(DVec2::new(x + 0.1, 0.0));
    points.reverse();
    draft.ring(&points);
}
