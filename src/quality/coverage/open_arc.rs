//! Coverage if circles count only for what they reach inside the domain.
//!
//! What a circle reaches is bounded by the circle itself and by the boundary of the domain, and by nothing else. So the
//! domain is covered if its boundary is, and if no arc of a circle is left that this circle reaches and no other one
//! does. Nothing changes along an arc between the points where a circle meets others and the boundary, so the middle of
//! each arc decides.

use super::{Arc, Disc, Sizes, covered_arc};
use crate::domain::Domain;
use crate::geometry::DVec2;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

/// Arcs shorter than this, in radians, are rounding errors: circles are enlarged by more.
const SHORTEST: f64 = 1e-12;

/// The longest arc of the disc's circle that it reaches and no other disc does, in radians; 0 if there is none.
pub fn longest(disc: &Disc, domain: &Domain, sizes: &Sizes) -> f64 {
    let mut others = Vec::new();
    let mut ends = vec![-PI, PI];
    sizes.circles.meeting(disc.centre, disc.radius, |other| {
        if other.id != disc.id {
            match covered_arc(disc, other) {
                Arc::All => others.push(*other),
                Arc::Part(from, to) => {
                    others.push(*other);
                    ends.extend([from, if to > PI { to - TAU } else { to }]);
                }
                Arc::None => {}
            }
        }
        ControlFlow::Continue(())
    });
    domain.index().within(disc.centre, disc.radius, |s, _| {
        ends.extend(crossings(disc, domain.ends(s)))
    });
    ends.sort_unstable_by(f64::total_cmp);
    let is_open = |angle: f64| {
        let x = disc.centre + disc.radius * DVec2::from_angle(angle);
        let holds = |other: &Disc| other.centre.distance(x) <= other.radius && sizes.counts(other.id, x);
        domain.contains(x) && sizes.counts(disc.id, x) && !others.iter().any(holds)
    };
    let arcs = ends
        .windows(2)
        .map(|pair| (pair[1] - pair[0], 0.5 * (pair[0] + pair[1])));
    let open = arcs.filter(|&(length, middle)| length > SHORTEST && is_open(middle));
    open.map(|(length, _)| length).fold(0.0, f64::max)
}

/// The angles at which a circle meets the line through `ends`.
fn crossings(disc: &Disc, [a, b]: [DVec2; 2]) -> Vec<f64> {
    let direction = (b - a).normalize_or_zero();
    let to_start = a - disc.centre;
    let away = to_start.perp_dot(direction);
    let half = (disc.radius - away.abs()) * (disc.radius + away.abs());
    if half < 0.0 {
        return Vec::new();
    }
    let foot = to_start - direction * to_start.dot(direction);
    [-half.sqrt(), half.sqrt()]
        .map(|along| (foot + direction * along).to_angle())
        .to_vec()
}
