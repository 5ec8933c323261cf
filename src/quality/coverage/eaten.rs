//! Coverage by the rule of the later point: every point z of the domain has a vertex within g(z) = c_b f(z).
//!
//! The distance to the nearest vertex less g changes by at most 1 + t per unit of length. So a triangle is decided by
//! its centroid, or quartered. Many front vertices are points where the distance equals g. Near such a point a bounded
//! number of parts is left at each quartering, since the difference falls off from there on all sides. A point counts
//! as covered if it is within [`CERTIFICATE`] of that.

use super::{Subject, Tally, Worst, disc_around, parallel};
use crate::geometry::DVec2;
use crate::geometry::tolerance::CERTIFICATE;
use crate::quality::Check;
use crate::quality::subject::Sizes;
use crate::theory::Claim;
use std::collections::VecDeque;

/// Most quarterings of a triangle and its parts.
const QUARTERED: usize = 1 << 15;

/// `coverage`: its worst value is the largest distance to the nearest vertex over g. `is_whole` says that the triangles
/// are known to make up the domain.
pub fn check(subject: &Subject, sizes: &Sizes, is_whole: bool) -> Check {
    let seen = parallel::map_ranges(subject.mesh.triangles.len(), |range| {
        let mut tally = Tally::new(Worst::Largest);
        for triangle in range {
            if let Some((centre, f)) = sizes.circumcentres[triangle] {
                see(&mut tally, centre, sizes, f);
            }
            let corners = subject.mesh.corners(triangle);
            if is_covered(corners, &mut tally, sizes).is_none() {
                tally.see(1.0, disc_around(corners).0, true);
            }
        }
        tally
    });
    let mut tally = Tally::all(Worst::Largest, seen);
    if !is_whole {
        // If the triangles do not make up the domain, they show nothing about it.
        tally.see(f64::INFINITY, subject.domain.bounds().centre(), true);
    }
    Check {
        lemma: "rule of the later point".into(),
        ..sizes.check(tally, Claim::Coverage, 1.0)
    }
}

/// Notes distance over g at a point, and returns both and whether the point is covered.
fn see(tally: &mut Tally, x: DVec2, sizes: &Sizes, f: f64) -> (f64, f64, bool) {
    let (distance, g) = (sizes.circles.nearest_rim(x, 0.0), sizes.bounds.c_b * f);
    let is_covered = distance <= g * (1.0 + CERTIFICATE);
    tally.see(distance / g, x, !is_covered);
    (distance, g, is_covered)
}

/// Whether all points of a triangle are covered. Larger parts come first, so that this ends soon if some are not. None
/// if too many parts would be needed.
fn is_covered(corners: [DVec2; 3], tally: &mut Tally, sizes: &Sizes) -> Option<bool> {
    let mut waiting = VecDeque::from([corners]);
    let mut quarterings = 0;
    while let Some(corners) = waiting.pop_front() {
        let (centre, radius) = disc_around(corners);
        let (distance, g, is_centre_covered) = see(tally, centre, sizes, sizes.bounds.spacing.at(centre));
        if !is_centre_covered {
            return Some(false);
        }
        let change = (1.0 + sizes.t()) * radius;
        if distance + change <= g * (1.0 + CERTIFICATE) || change <= g * CERTIFICATE {
            continue;
        }
        quarterings += 1;
        if quarterings > QUARTERED {
            return None;
        }
        let [a, b, c] = corners;
        let [d, e, f] = [b.midpoint(c), c.midpoint(a), a.midpoint(b)];
        waiting.extend([[d, e, f], [a, f, e], [f, b, d], [e, d, c]]);
    }
    Some(true)
}
