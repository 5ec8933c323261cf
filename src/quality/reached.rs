//! With distances inside the domain, circles and vertices count only for what they reach there. [`Reach`] finds this
//! from the domain alone.

use super::discs::{Disc, DiscTree};
use super::parallel;
use super::subject::Sizes;
use crate::delaunay::{Part, Reach};
use crate::domain::Domain;
use crate::geometry::DVec2;
use std::ops::ControlFlow;

/// The factor by which the radius of the search for vertices is raised.
const WIDER: f64 = 1.5;

/// What each of the biting circles reaches.
pub struct Reached {
    /// None if the domain cannot be triangulated: then nothing is reached, and no claim holds.
    reach: Option<Reach>,
    parts: Vec<Option<Part>>,
    /// The largest distance that two points of the domain can have.
    farthest: f64,
}

impl Reached {
    /// Finds what these circles reach.
    pub fn new(domain: &Domain, circles: &DiscTree) -> Self {
        let reach = Reach::new(domain).ok();
        let discs = circles.discs();
        let found = parallel::map(discs.len(), |k| {
            let disc = &discs[k];
            (
                disc.id,
                reach.as_ref().and_then(|reach| reach.part(disc.centre, disc.radius)),
            )
        });
        let mut parts = vec![None; discs.len()];
        found.into_iter().for_each(|(id, part)| parts[id as usize] = part);
        Self {
            reach,
            parts,
            farthest: domain.bounds().diagonal(),
        }
    }

    /// Whether circle `id` reaches a point that it holds.
    pub fn counts(&self, id: u32, x: DVec2) -> bool {
        let is_in = |reach: &Reach| self.parts[id as usize].as_ref().is_none_or(|part| reach.is_in(part, x));
        self.reach.as_ref().is_some_and(is_in)
    }

    /// Whether a circle, or one that it meets, does not reach all of the domain that it holds.
    pub fn is_parted(&self, disc: &Disc, sizes: &Sizes) -> bool {
        let mut is_parted = self.reach.is_none();
        sizes.circles.meeting(disc.centre, disc.radius, |other| {
            is_parted |= self.parts[other.id as usize].is_some();
            match is_parted {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        is_parted
    }

    /// The smallest radius with which a disc around `x` reaches two vertices (`x` itself included, if it is one), given
    /// the smallest radius with which it holds two.
    pub fn second_nearest(&self, circles: &DiscTree, x: DVec2, nearest: f64) -> f64 {
        let Some(reach) = &self.reach else { return f64::NAN };
        if nearest.is_infinite() || reach.part(x, nearest).is_none() {
            return nearest;
        }
        let mut radius = nearest;
        while radius <= WIDER * self.farthest {
            let mut radii = Vec::new();
            circles.meeting(x, radius, |disc| {
                if disc.centre.distance(x) <= radius {
                    radii.push(reach.radius_to(x, disc.centre));
                }
                ControlFlow::Continue(())
            });
            radii.sort_by(f64::total_cmp);
            if let Some(second) = radii.get(1).filter(|second| **second <= radius) {
                return *second;
            }
            radius *= WIDER;
        }
        f64::INFINITY
    }
}

impl Sizes<'_> {
    /// Whether two vertices must keep a distance from each other. They need not only if distances are measured inside
    /// the domain, and the circle of the one with the larger spacing holds the other without reaching it.
    pub fn are_joined(&self, one: &Disc, other: &Disc) -> bool {
        let [larger, smaller] = match one.radius >= other.radius {
            true => [one, other],
            false => [other, one],
        };
        let is_held = larger.centre.distance(smaller.centre) <= larger.radius;
        !is_held || self.counts(larger.id, smaller.centre)
    }
}
