//! The triangles that integration starts from: no longer than f / λ, so that f varies within one at most by its own size.
//!
//! They are the constrained Delaunay triangulation of the domain, with its segments cut into pieces of about f / λ, and with a
//! point in the middle of each cell of a quadtree, about as large, that no segment meets; longer triangles are bisected. The
//! domain's own triangulation would not do: a long segment opposite to many short ones, or a round outline of many segments,
//! makes needles, each of which would be cut into as many parts as a wide triangle.

use crate::delaunay::triangulate;
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::mesh::Piece;
use crate::spacing::Spacing;
use crate::spacing::cover::{Cell, DEPTH};
use crate::spacing::integral::{EVALUATIONS_A_PART, MAX_EVALUATIONS, SpacingError, Triangle, centroid, checked};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Triangles are shorter than this share of the domain, so that the error is a sum over hundreds of them and not an accident.
const COARSEST: f64 = 1.0 / 32.0;

/// Most triangles: more could not all be visited once. No mesh can be made where f is that small.
const MOST: usize = MAX_EVALUATIONS / EVALUATIONS_A_PART;

/// The triangles, in an order that does not depend on the number of threads.
///
/// # Errors
/// [`SpacingError::TooSmall`] if there would be too many, [`SpacingError::NotPositive`] if f is not,
/// [`SpacingError::Triangulation`] if the domain cannot be triangulated.
pub fn triangles(function: &dyn Spacing, domain: &Domain) -> Result<Vec<Triangle>, SpacingError> {
    let slope = function.lipschitz();
    let coarsest = COARSEST * domain.bounds().diagonal();
    // If λ is infinite, nothing is known of f nearby.
    let reach = |value: f64| {
        if slope.is_finite() {
            coarsest.min(value / slope)
        } else {
            coarsest
        }
    };
    let reach_at = |x: DVec2| checked(function, x).map(reach);
    let base = base(domain, reach_at, MOST)?;
    let triangles = base.map_or(Ok(None), |base| cut(base, reach_at, MOST))?;
    triangles.ok_or_else(|| narrowest(function, domain))
}

/// The triangulation of the domain with further points on its segments and inside; none if it would have more than `most`
/// triangles, of which there are about two per point inside.
pub(super) fn base(
    domain: &Domain,
    reach_at: impl Fn(DVec2) -> Result<f64, SpacingError> + Sync,
    most: usize,
) -> Result<Option<Vec<Triangle>>, SpacingError> {
    let mut points = domain.vertices().to_vec();
    let mut pieces = Vec::new();
    for (segment, ends) in domain.segments().iter().zip(0..) {
        let first = points.len() as u32;
        let room = most.saturating_sub(points.len());
        let Some(between) = inner_points(domain.ends(ends as usize), &reach_at, room)? else {
            return Ok(None);
        };
        points.extend(between);
        let between = first..points.len() as u32;
        let chain: Vec<u32> = std::iter::once(segment.a as u32)
            .chain(between)
            .chain([segment.b as u32])
            .collect();
        pieces.extend(chain.windows(2).map(|pair| Piece {
            a: pair[0],
            b: pair[1],
            segment: ends,
        }));
    }
    let room = (most / 2).saturating_sub(points.len());
    let Some(inside) = middles(domain, &reach_at, room)? else {
        return Ok(None);
    };
    points.extend(inside);
    let mesh = triangulate(domain, points, pieces)?;
    let corners = |triangle: &[u32; 3]| triangle.map(|vertex| mesh.points[vertex as usize]);
    Ok(Some(mesh.triangles.iter().map(corners).collect()))
}

/// The middles of the quadtree's cells that no segment meets, each with a diagonal of at most f / λ in its middle.
pub(super) fn middles(
    domain: &Domain,
    reach_at: impl Fn(DVec2) -> Result<f64, SpacingError> + Sync,
    room: usize,
) -> Result<Option<Vec<DVec2>>, SpacingError> {
    let mut middles = Vec::new();
    let mut level = vec![Cell::root(domain)];
    for _ in 0..DEPTH {
        let looked = level.par_iter().map(|cell| {
            let x = cell.point(domain);
            let is_small = cell.rect.diagonal() <= reach_at(x)?;
            Ok(match (is_small, cell.crossing.is_empty()) {
                (true, true) => (Some(x), Vec::new()),
                (true, false) => (None, Vec::new()),
                (false, _) => (None, cell.split(domain).collect()),
            })
        });
        let looked: Vec<(Option<DVec2>, Vec<Cell>)> = looked.collect::<Result<_, SpacingError>>()?;
        let (found, parts): (Vec<_>, Vec<_>) = looked.into_iter().unzip();
        middles.extend(found.into_iter().flatten());
        level = parts.into_iter().flatten().collect();
        if middles.len() + level.len() > room {
            return Ok(None);
        }
    }
    Ok(Some(middles))
}

/// Points between the ends, by bisection, that leave no piece longer than f / λ at its middle.
pub(super) fn inner_points(
    ends: [DVec2; 2],
    reach_at: impl Fn(DVec2) -> Result<f64, SpacingError>,
    room: usize,
) -> Result<Option<Vec<DVec2>>, SpacingError> {
    let mut pending = vec![ends];
    let mut points = Vec::new();
    while let Some([a, b]) = pending.pop() {
        let middle = a.midpoint(b);
        if middle != a && middle != b && a.distance(b) > reach_at(middle)? {
            pending.extend([[middle, b], [a, middle]]);
        } else if b != ends[1] {
            points.push(b);
        }
        if points.len() + pending.len() > room {
            return Ok(None);
        }
    }
    Ok(Some(points))
}

/// Bisects until no edge is longer than f / λ at the centroid; none if there are more than `most` then.
pub(super) fn cut(
    base: Vec<Triangle>,
    reach_at: impl Fn(DVec2) -> Result<f64, SpacingError> + Sync,
    most: usize,
) -> Result<Option<Vec<Triangle>>, SpacingError> {
    let count = AtomicUsize::new(base.len());
    let resolve = |triangle: Triangle| {
        let mut pending = vec![triangle];
        let mut resolved = Vec::new();
        while let Some(next) = pending.pop() {
            let start = longest_edge(&next);
            let longest = next[start].distance(next[(start + 1) % 3]);
            if longest <= reach_at(centroid(&next))? {
                resolved.push(next);
                continue;
            }
            pending.extend(bisect(&next));
            // Whatever the order of the threads, this happens if and only if there are more in the end.
            if count.fetch_add(1, Ordering::Relaxed) >= most {
                return Ok(None);
            }
        }
        Ok(Some(resolved))
    };
    let parts: Option<Vec<Vec<Triangle>>> = base
        .into_par_iter()
        .map(resolve)
        .collect::<Result<Option<_>, SpacingError>>()?;
    Ok(parts.map(|parts| parts.concat()))
}

/// The error that names where f is smallest, among all ends and middles of segments, where lfs has its minima.
pub(super) fn narrowest(function: &dyn Spacing, domain: &Domain) -> SpacingError {
    let places = (0..domain.segments().len())
        .map(|s| domain.ends(s))
        .flat_map(|[a, b]| [a, a.midpoint(b), b]);
    let lowest = places
        .map(|x| (function.at(x), x))
        .min_by(|one, other| one.0.total_cmp(&other.0));
    let (value, at) = lowest.unwrap_or((f64::NAN, DVec2::NAN));
    SpacingError::TooSmall {
        value,
        x: at.x,
        y: at.y,
    }
}

/// The corner at which the longest edge starts; of equal ones the first.
pub(super) fn longest_edge(triangle: &Triangle) -> usize {
    let length = |corner: usize| triangle[corner].distance_squared(triangle[(corner + 1) % 3]);
    (1..3).fold(
        0,
        |best, corner| if length(corner) > length(best) { corner } else { best },
    )
}

/// The two halves on either side of the middle of the longest edge.
pub(super) fn bisect(triangle: &Triangle) -> [Triangle; 2] {
    let start = longest_edge(triangle);
    let [a, b, c] = [0, 1, 2].map(|offset| triangle[(start + offset) % 3]);
    let middle = 0.5 * (a + b);
    [[a, middle, c], [middle, b, c]]
}
