//! Quadtree cells that meet Ω, and a point of Ω in each.

use crate::domain::Domain;
use crate::geometry::segments::meets_box;
use crate::geometry::{DVec2, Rect};
use crate::spacing::{Spacing, SpacingError};

/// Deepest cell: 2⁻⁴⁵ of the domain, about the resolution of coordinates.
pub const DEPTH: usize = 45;

/// Most cells that [`check_positive`] visits.
const BUDGET: usize = 1_000_000;

/// A cell that meets Ω.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Where.
    pub rect: Rect,
    /// The segments that meet it; if there are none, the whole cell lies inside Ω.
    pub crossing: Vec<u32>,
}

impl Cell {
    /// The square around the domain.
    pub fn root(domain: &Domain) -> Self {
        let bounds = domain.bounds();
        let half = DVec2::splat(0.5 * bounds.size().max_element());
        let rect = Rect {
            min: bounds.centre() - half,
            max: bounds.centre() + half,
        };
        Self {
            rect,
            crossing: (0..domain.segments().len() as u32).collect(),
        }
    }

    /// The quarters that meet Ω, decided exactly. All segments belong to the closure of Ω, so a cell that one meets
    /// meets Ω; a cell that none meets lies in one face.
    pub fn split(&self, domain: &Domain) -> impl Iterator<Item = Self> {
        let meeting = move |rect: Rect| {
            let meets = |s: &u32| meets_box(domain.ends(*s as usize), &rect);
            let crossing: Vec<u32> = self.crossing.iter().copied().filter(meets).collect();
            let is_met = !crossing.is_empty() || self.crossing.is_empty() || domain.contains(rect.centre());
            is_met.then_some(Self { rect, crossing })
        };
        self.rect.quarters().into_iter().filter_map(meeting)
    }

    /// A point of the cell and of Ω: the centre if it is in Ω, else a point of a segment.
    pub fn point(&self, domain: &Domain) -> DVec2 {
        let centre = self.rect.centre();
        match self.crossing.first() {
            Some(&segment) if !domain.contains(centre) => clipped_middle(domain.ends(segment as usize), self.rect),
            _ => centre,
        }
    }
}

/// The middle of the part of a segment that lies in `cell`.
fn clipped_middle([a, b]: [DVec2; 2], cell: Rect) -> DVec2 {
    let along = b - a;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        if along[axis] != 0.0 {
            let (one, two) = (
                (cell.min[axis] - a[axis]) / along[axis],
                (cell.max[axis] - a[axis]) / along[axis],
            );
            from = from.max(one.min(two));
            to = to.min(one.max(two));
        }
    }
    a + (0.5 * (from + to)).clamp(0.0, 1.0) * along
}

/// Proves f > 0 on Ω by lower bounds on ever smaller cells.
///
/// # Errors
/// [`SpacingError::NotPositive`] at a point where f is not, [`SpacingError::Unproved`] where the proof gets stuck.
pub fn check_positive(function: &dyn Spacing, domain: &Domain) -> Result<(), SpacingError> {
    if function.lower_bound(domain.bounds()) > 0.0 {
        return Ok(());
    }
    let mut pending = vec![(Cell::root(domain), 0)];
    let mut looked_at = 0;
    while let Some((cell, depth)) = pending.pop() {
        looked_at += 1;
        if function.lower_bound(cell.rect) > 0.0 {
            continue;
        }
        let x = cell.point(domain);
        let value = function.at(x);
        if !(value > 0.0 && value.is_finite()) {
            return Err(SpacingError::NotPositive { value, x: x.x, y: x.y });
        }
        if depth == DEPTH || looked_at > BUDGET {
            return Err(SpacingError::Unproved { value, x: x.x, y: x.y });
        }
        pending.extend(cell.split(domain).map(|part| (part, depth + 1)));
    }
    Ok(())
}

#[cfg(test)]
mod tests;
