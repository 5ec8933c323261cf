//! A static index over segments: which meet a box, which is nearest to a point, which a ray hits first.
//!
//! A balanced binary tree of bounding boxes, built once by median splits and walked without allocating, so that every
//! query costs O(log n) plus what it finds, however unevenly the segments are spread. [`SegmentIndex::right_of`] is
//! exact; it is what faces, nesting and inside tests stand on.

use super::predicates::orient2d;
use super::{DVec2, Rect};

/// Segments in a leaf; about where testing one more segment costs as much as one more box.
const LEAF: usize = 4;

/// Deepest tree: median splits halve, so 2^48 segments would fit.
const DEPTH: usize = 48;

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
    /// The point lies on this segment (or one of its ends); of several, any.
    On(usize),
    /// The first segment to the right, and whether the point is on its left when it is walked from first to second end.
    Segment(usize, bool),
    /// Nothing.
    Nothing,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Rect,
    /// Range in `items` of a leaf; `from == to` marks an inner node, whose first child follows it.
    from: u32,
    to: u32,
    /// Second child of an inner node.
    second: u32,
}

#[derive(Clone, Copy, Debug)]
struct Item {
    ends: [DVec2; 2],
    id: u32,
}

/// A static index over segments given by their two ends.
#[derive(Clone, Debug, Default)]
pub struct SegmentIndex {
    nodes: Vec<Node>,
    items: Vec<Item>,
}

impl SegmentIndex {
    /// Indexes `segments`; queries answer with positions in this order. O(n log n).
    pub fn new(segments: impl IntoIterator<Item = [DVec2; 2]>) -> Self {
        let items: Vec<Item> = segments
            .into_iter()
            .zip(0..)
            .map(|(ends, id)| Item { ends, id })
            .collect();
        let mut index = Self {
            nodes: Vec::with_capacity(items.len()),
            items,
        };
        if !index.items.is_empty() {
            index.split(0, index.items.len());
        }
        index
    }

    /// How many segments are indexed.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    fn split(&mut self, from: usize, to: usize) {
        let bounds = Rect::around(self.items[from..to].iter().flat_map(|item| item.ends));
        let node = self.nodes.len();
        let is_leaf = to - from <= LEAF;
        self.nodes.push(Node {
            bounds,
            from: if is_leaf { from as u32 } else { 0 },
            to: if is_leaf { to as u32 } else { 0 },
            second: 0,
        });
        if is_leaf {
            return;
        }
        let axis = usize::from(bounds.size().y > bounds.size().x);
        let middle = from + (to - from) / 2;
        let key = |item: &Item| item.ends[0][axis] + item.ends[1][axis];
        // The id breaks ties, so that the tree does not depend on the selection algorithm.
        self.items[from..to]
            .select_nth_unstable_by(middle - from, |l, r| key(l).total_cmp(&key(r)).then(l.id.cmp(&r.id)));
        self.split(from, middle);
        self.nodes[node].second = self.nodes.len() as u32;
        self.split(middle, to);
    }

    /// Walks the tree depth first, entering the boxes that `enter` accepts at the time they are reached.
    fn walk<S>(&self, state: &mut S, enter: impl Fn(&S, &Rect) -> bool, visit: impl Fn(&mut S, &Item)) {
        let mut stack = [0u32; DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let at = stack[height];
            let node = &self.nodes[at as usize];
            if !enter(state, &node.bounds) {
                continue;
            }
            if node.from < node.to {
                for item in &self.items[node.from as usize..node.to as usize] {
                    visit(state, item);
                }
            } else {
                stack[height] = node.second;
                stack[height + 1] = at + 1;
                height += 2;
            }
        }
    }

    /// Calls `visit` with every segment that meets the closed box, decided exactly; in no particular order.
    pub fn in_box(&self, bounds: Rect, visit: impl FnMut(usize)) {
        let mut visit = visit;
        self.walk(
            &mut visit,
            |_, node| overlap(node, &bounds),
            |visit, item| {
                if meets_box(item.ends, &bounds) {
                    visit(item.id as usize);
                }
            },
        );
    }

    /// Calls `visit` with every segment at most `radius` from `x` and its distance; in no particular order.
    pub fn within(&self, x: DVec2, radius: f64, visit: impl FnMut(usize, f64)) {
        let mut visit = visit;
        self.walk(
            &mut visit,
            |_, node| node.distance(x) <= radius,
            |visit, item| {
                let distance = closest_on_segment(item.ends, x).distance(x);
                if distance <= radius {
                    visit(item.id as usize, distance);
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

    /// Calls `visit` with segments at most `reach` from `x` and their distances, about the nearest first; it answers with
    /// the reach from then on.
    pub fn nearest_first(&self, x: DVec2, reach: f64, mut visit: impl FnMut(usize, f64) -> f64) {
        let mut reach = reach;
        let mut stack = [(0u32, 0.0); DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let (at, distance) = stack[height];
            if distance > reach {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.from < node.to {
                for item in &self.items[node.from as usize..node.to as usize] {
                    let distance = closest_on_segment(item.ends, x).distance(x);
                    if distance <= reach {
                        reach = visit(item.id as usize, distance);
                    }
                }
            } else {
                let children = [at + 1, node.second].map(|c| (c, self.nodes[c as usize].bounds.distance(x)));
                let nearer = usize::from(children[1].1 < children[0].1);
                stack[height] = children[1 - nearer];
                stack[height + 1] = children[nearer];
                height += 2;
            }
        }
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
        let mut state: (Option<Item>, Option<usize>) = (None, None);
        self.walk(
            &mut state,
            |(first, on), node| {
                on.is_none()
                    && node.min.y <= x.y
                    && x.y <= node.max.y
                    && x.x <= node.max.x
                    && first.is_none_or(|item| node.min.x <= item.ends[0].x.max(item.ends[1].x))
            },
            |(first, on), item| {
                let [a, b] = item.ends;
                if a.x.max(b.x) < x.x || (x.y < a.y && x.y < b.y) || (x.y > a.y && x.y > b.y) {
                    return;
                }
                if !accept(item.id as usize) {
                    return;
                }
                let [low, high] = if a.y <= b.y { [a, b] } else { [b, a] };
                let side = orient2d(low, high, x);
                if side == 0.0 && a.x.min(b.x) <= x.x {
                    *on = Some(item.id as usize);
                } else if side > 0.0 && x.y < high.y && first.is_none_or(|known| is_before(item.ends, known.ends)) {
                    *first = Some(*item);
                }
            },
        );
        match state {
            (_, Some(on)) => Seen::On(on),
            (Some(item), None) => Seen::Segment(item.id as usize, item.ends[0].y < item.ends[1].y),
            (None, None) => Seen::Nothing,
        }
    }

    /// The first segment that the ray from `origin` along `direction` hits among those that `accept` takes, and how
    /// far along as a multiple of `direction`. Rounded arithmetic: for choosing points, not for deciding signs.
    pub fn first_hit(&self, origin: DVec2, direction: DVec2, accept: impl Fn(usize) -> bool) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64)> = None;
        self.walk(
            &mut best,
            |best, node| {
                let to = if let Some((_, share)) = best {
                    *share
                } else {
                    f64::INFINITY
                };
                ray_meets_box(origin, direction, to, node)
            },
            |best, item| {
                let [a, b] = item.ends;
                let along = b - a;
                let cross = direction.perp_dot(along);
                let share = (a - origin).perp_dot(along) / cross;
                let other = (a - origin).perp_dot(direction) / cross;
                let hit = cross != 0.0 && share >= 0.0 && (0.0..=1.0).contains(&other);
                let id = item.id as usize;
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

fn overlap(a: &Rect, b: &Rect) -> bool {
    a.min.cmple(b.max).all() && b.min.cmple(a.max).all()
}

/// Whether a closed segment and a closed box meet: neither the axes nor the segment's normal separate them.
pub(crate) fn meets_box([a, b]: [DVec2; 2], bounds: &Rect) -> bool {
    if !overlap(
        &Rect {
            min: a.min(b),
            max: a.max(b),
        },
        bounds,
    ) {
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

/// Whether the ray reaches the box no later than `to` times its direction; a box it grazes counts.
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
