//! Checks of the smallest angle (Theorem 6.8), and of angles at corners.

use super::subject::{Sizes, Subject};
use super::tally::{Tally, Worst};
use super::{Check, parallel, shape};
use crate::geometry::DVec2;
use crate::geometry::tolerance::{CERTIFICATE, SAME_VERTEX_ULPS};
use crate::theory::Claim;

/// `min-angle` and `min-angle-beyond-corners`: in degrees, over the triangles that touch no vertex with an input angle
/// under 60°. They differ in their hypotheses.
pub fn checks(subject: &Subject, sizes: &Sizes) -> [Check; 2] {
    let bound = sizes.promises().min_angle_deg();
    let tally = over_triangles(subject, |tally, t| {
        if !subject.is_excused(t) {
            let corners = subject.mesh.corners(t);
            let smallest = smallest_angle(corners);
            tally.see(
                smallest,
                shape::centroid(corners),
                smallest < bound * (1.0 - CERTIFICATE),
            );
        }
    });
    [
        sizes.check(tally.clone(), Claim::MinAngle, bound),
        sizes.check(tally, Claim::MinAngleBeyondCorners, bound),
    ]
}

/// `corner-angles`: angles of triangles at vertices with an input angle under 60°, over the smallest input angle there.
pub fn corner_check(subject: &Subject, sizes: &Sizes) -> Check {
    // Coordinates are rounded, which changes the angle opposite to a short edge.
    let ulp = SAME_VERTEX_ULPS * f64::EPSILON * subject.largest_coordinate();
    let tally = over_triangles(subject, |tally, t| {
        if let Some(input) = subject.input_angle_deg(t) {
            let corners = subject.mesh.corners(t);
            let [a, b, c] = corners;
            let shortest = a.distance(b).min(b.distance(c)).min(c.distance(a));
            let share = smallest_angle(corners) / input;
            tally.see(
                share,
                shape::centroid(corners),
                share < 1.0 - CERTIFICATE - ulp / shortest,
            );
        }
    });
    sizes.check(tally, Claim::CornerAngles, 1.0)
}

fn smallest_angle(corners: [DVec2; 3]) -> f64 {
    let [a, b, c] = shape::angles_deg(corners);
    a.min(b).min(c)
}

/// Passes every triangle to a tally.
fn over_triangles(subject: &Subject, see: impl Fn(&mut Tally, usize) + Sync) -> Tally {
    let parts = parallel::map_ranges(subject.mesh.triangles.len(), |range| {
        let mut tally = Tally::new(Worst::Smallest);
        range.for_each(|t| see(&mut tally, t));
        tally
    });
    Tally::all(Worst::Smallest, parts)
}
