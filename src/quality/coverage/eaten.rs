//! Coverage by the rule of the later point: every point z of the domain has a vertex within g(z) = c_b f(z).
//!
//! The distance to the nearest vertex less g changes by at most 1 + t times the way. So a triangle is decided from its
//! centroid, or quartered. Near a point where the two are equal, as many front vertices are, a bounded number of parts is left
//! at each quartering, since the difference falls away from there on all sides; what is within [`CERTIFICATE`] of being
//! covered is.

use super::{Subject, Tally, Worst, disc_around, parallel};
use crate::geometry::DVec2;
use crate::geometry::tolerance::CERTIFICATE;
use crate::quality::Check;
use crate::quality::subject::Sizes;
use crate::theory::Claim;
use std::collections::VecDeque;

/// Most quarterings of a triangle and its parts.
const QUARTERED: usize = 1 << 15;

/// `coverage`, worst being the largest distance to the nearest vertex over g found; `is_whole` where the triangles are known to
/// make up the domain.
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
        // Triangles that are not those of the domain tell nothing of it.
        tally.see(f64::INFINITY, subject.domain.bounds().centre(), true);
    }
    Check {
        lemma: "rule of the later".into(),
        ..sizes.check(tally, Claim::Coverage, 1.0)
    }
}

/// Notes distance over g at a point, returns both, and says whether the point is covered.
fn see(tally: &mut Tally, x: DVec2, sizes: &Sizes, f: f64) -> (f64, f64, bool) {
    let (distance, g) = (sizes.circles.nearest_rim(x, 0.0), sizes.bounds.c_b * f);
    let is_covered = distance <= g * (1.0 + CERTIFICATE);
    tally.see(distance / g, x, !is_covered);
    (distance, g, is_covered)
}

/// Whether all points of a triangle are covered; larger parts first, so that it ends soon where some are not. Nothing is
/// told where too many parts would be needed.
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
