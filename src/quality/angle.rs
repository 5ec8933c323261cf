//! The smallest angle against Theorem 6.8.

use super::subject::{Sizes, Subject};
use super::tally::{Tally, Worst};
use super::{Check, min_angle_bound_deg, parallel, shape};
use crate::geometry::DVec2;
use crate::geometry::tolerance::CERTIFICATE;

/// `min-angle`, in degrees, over the triangles that touch no vertex with an input angle under 60°.
pub fn check(subject: &Subject, sizes: &Sizes) -> Check {
    let bound = min_angle_bound_deg(sizes.t());
    let parts = parallel::map_ranges(subject.mesh.triangles.len(), |range| {
        let mut tally = Tally::new(Worst::Smallest);
        for t in range.filter(|t| !subject.is_excused(*t)) {
            let corners = subject.mesh.corners(t);
            let [a, b, c] = shape::angles_deg(corners);
            let smallest = a.min(b).min(c);
            tally.see(
                smallest,
                corners.iter().sum::<DVec2>() / 3.0,
                smallest < bound * (1.0 - CERTIFICATE),
            );
        }
        tally
    });
    Tally::all(Worst::Smallest, parts).check("min-angle", "Theorem 6.8", sizes.applies("min-angle"), bound)
}
