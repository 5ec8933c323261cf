//! A static index over segments: which meet a box, which is nearest to a point, which a ray hits first.
//!
//! A [`BoxTree`] of segments, so that every query costs O(log n) plus what it finds, however unevenly they are spread.
//! [`SegmentIndex::right_of`] is exact; faces, nesting and inside tests rest on it.

use super::boxes::{BoxTree, Boxed};
use super::predicates::orient2d;
use super::{DVec2, Rect};

/// The point of the closed segment between `ends` nearest to `x`.
pub fn closest_on_segment(ends: [DVec2; 2], x: DVec2) -> DVec2 {
    let along = ends[1] - ends[0];
    let length2 = along.length_squared();
    if length2 == 0.0 {
        return ends[0];
    }
    let share = (x - ends[0]).dot(along) / length2;
    if share <= 0.0 {
        ends[0]
    } else if share >= 1.0 {
        ends[1]
    } else {
        ends[0] + share * along
    }
}

/// What a point sees when it looks along +x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// The point lies on this segment (or one of its ends); any of them if there are several.
    On(usize),
    /// The first segment to the right, and whether the point is on its left when it is walked from first to second end.
    Segment(usize, bool),
    /// Nothing.
    Nothing,
}

/// A segment by its two ends.
type Ends = [DVec2; 2];

impl Boxed for Ends {
    fn bounds(&self) -> Rect {
        let [a, b] = *self;
        Rect {
            min: a.min(b),
            max: a.max(b),
        }
    }
}

/// A static index over segments given by their two ends.
#[derive(Clone, Debug, Default)]
pub struct SegmentIndex {
    tree: BoxTree<Ends>,
}

impl SegmentIndex {
    /// Indexes `segments`; queries return positions in this order. O(n log n).
    pub fn new(segments: impl IntoIterator<Item = [DVec2; 2]>) -> Self {
        let tree = BoxTree::new(segments);
        Self { tree }
    }

    /// Calls `visit` with every segment that meets the closed box, decided exactly; in no particular order.
    pub fn in_box(&self, bounds: Rect, visit: impl FnMut(usize)) {
        let mut visit = visit;
        self.tree.walk(
            &mut visit,
            |_, node| node.meets(bounds),
            |visit, ends, id| {
                if meets_box(*ends, &bounds) {
                    visit(id);
                }
            },
        );
    }

    /// Calls `visit` with every segment at most `radius` from `x` and its distance; in no particular order.
    pub fn within(&self, x: DVec2, radius: f64, visit: impl FnMut(usize, f64)) {
        let mut visit = visit;
        self.tree.walk(
            &mut visit,
            |_, node| node.distance(x) <= radius,
            |visit, ends, id| {
                let distance = closest_on_segment(*ends, x).distance(x);
                if distance <= radius {
                    visit(id, distance);
                }
            },
        );
    }

    /// The segment nearest to `x` and its distance; the lowest index among equals. `None` without segments.
    pub fn nearest(&self, x: DVec2) -> Option<(usize, f64)> {
        self.nearest_where(x, |_| true)
    }

    /// The nearest segment among those that `accept` takes.
    pub fn nearest_where(&self, x: DVec2, accept: impl Fn(usize) -> bool) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64)> = None;
        self.nearest_first(x, f64::INFINITY, |id, distance| {
            let better = best.is_none_or(|(known, least)| distance < least || (distance == least && id < known));
            if better && accept(id) {
                best = Some((id, distance));
            }
            best.map_or(f64::INFINITY, |(_, least)| least)
        });
        best
    }

    /// Calls `visit` with segments at most `reach` from `x` and their distances, roughly the nearest first; `visit` returns the
    /// reach from then on.
    pub fn nearest_first(&self, x: DVec2, reach: f64, visit: impl FnMut(usize, f64) -> f64) {
        let distance = |ends: &Ends| closest_on_segment(*ends, x).distance(x);
        self.tree.nearest_first(x, reach, distance, visit);
    }

    /// What `x` sees along +x, decided exactly for segments that do not cross.
    ///
    /// A ray through a vertex counts a segment when its lower end is at or below the ray and its upper end above it;
    /// horizontal segments are seen only by points on them. The first segment seen therefore bounds the face of `x`.
    pub fn right_of(&self, x: DVec2) -> Seen {
        self.right_of_where(x, |_| true)
    }

    /// What `x` sees along +x among the segments that `accept` takes.
    pub fn right_of_where(&self, x: DVec2, accept: impl Fn(usize) -> bool) -> Seen {
        let mut state: (Option<(Ends, usize)>, Option<usize>) = (None, None);
        self.tree.walk(
            &mut state,
            |(first, on), node| {
                on.is_none()
                    && node.min.y <= x.y
                    && x.y <= node.max.y
                    && x.x <= node.max.x
                    && first.is_none_or(|([a, b], _)| node.min.x <= a.x.max(b.x))
            },
            |(first, on), ends, id| {
                let [a, b] = *ends;
                if a.x.max(b.x) < x.x || (x.y < a.y && x.y < b.y) || (x.y > a.y && x.y > b.y) {
                    return;
                }
                if !accept(id) {
                    return;
                }
                let [low, high] = if a.y <= b.y { [a, b] } else { [b, a] };
                let side = orient2d(low, high, x);
                if side == 0.0 && a.x.min(b.x) <= x.x {
                    *on = Some(id);
                } else if side > 0.0 && x.y < high.y && first.is_none_or(|(known, _)| is_before(*ends, known)) {
                    *first = Some((*ends, id));
                }
            },
        );
        match state {
            (_, Some(on)) => Seen::On(on),
            (Some(([a, b], id)), None) => Seen::Segment(id, a.y < b.y),
            (None, None) => Seen::Nothing,
        }
    }

    /// The first segment that the ray from `origin` along `direction` hits among those that `accept` takes, and how
    /// far along as a multiple of `direction`. Rounded arithmetic: for choosing points, not for deciding signs.
    pub fn first_hit(&self, origin: DVec2, direction: DVec2, accept: impl Fn(usize) -> bool) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64)> = None;
        self.tree.walk(
            &mut best,
            |best, node| {
                let to = if let Some((_, share)) = best {
                    *share
                } else {
                    f64::INFINITY
                };
                ray_meets_box(origin, direction, to, node)
            },
            |best, ends, id| {
                let [a, b] = *ends;
                let along = b - a;
                let cross = direction.perp_dot(along);
                let share = (a - origin).perp_dot(along) / cross;
                let other = (a - origin).perp_dot(direction) / cross;
                let hit = cross != 0.0 && share >= 0.0 && (0.0..=1.0).contains(&other);
                if hit
                    && best.is_none_or(|(known, least)| share < least || (share == least && id < known))
                    && accept(id)
                {
                    *best = Some((id, share));
                }
            },
        );
        best
    }
}

/// Whether `first` is left of `second`: both meet one horizontal line, do not cross, and are not horizontal.
fn is_before(first: [DVec2; 2], second: [DVec2; 2]) -> bool {
    let upward = |[a, b]: [DVec2; 2]| if a.y <= b.y { [a, b] } else { [b, a] };
    let ([low1, high1], [low2, high2]) = (upward(first), upward(second));
    // Within the common range of heights the order is the same everywhere, so compare where one of them ends.
    let at_low = if low1.y >= low2.y {
        orient2d(low2, high2, low1)
    } else {
        -orient2d(low1, high1, low2)
    };
    let at_high = || {
        if high1.y <= high2.y {
            orient2d(low2, high2, high1)
        } else {
            -orient2d(low1, high1, high2)
        }
    };
    let left = if at_low == 0.0 { at_high() } else { at_low };
    left > 0.0
}

/// Whether a closed segment and a closed box meet: neither the axes nor the segment's normal separate them.
pub(crate) fn meets_box([a, b]: [DVec2; 2], bounds: &Rect) -> bool {
    if ![a, b].bounds().meets(*bounds) {
        return false;
    }
    if bounds.contains(a) || bounds.contains(b) {
        return true;
    }
    let corners = [
        bounds.min,
        DVec2::new(bounds.max.x, bounds.min.y),
        bounds.max,
        DVec2::new(bounds.min.x, bounds.max.y),
    ];
    let sides = corners.map(|corner| orient2d(a, b, corner));
    !(sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0))
}

/// Whether the ray reaches the box within `to` times its direction; a box that it grazes counts.
fn ray_meets_box(origin: DVec2, direction: DVec2, to: f64, bounds: &Rect) -> bool {
    let (mut enter, mut leave) = (0.0f64, to);
    for axis in 0..2 {
        if direction[axis] == 0.0 {
            if origin[axis] < bounds.min[axis] || origin[axis] > bounds.max[axis] {
                return false;
            }
            continue;
        }
        let one = (bounds.min[axis] - origin[axis]) / direction[axis];
        let two = (bounds.max[axis] - origin[axis]) / direction[axis];
        enter = enter.max(one.min(two));
        leave = leave.min(one.max(two));
    }
    // A few ulp of slack, or a box as flat as a segment could be missed by rounding.
    enter <= leave + 4.0 * f64::EPSILON * leave.abs().max(enter.abs())
}

#[cfg(test)]
mod tests;
