//! Near-queries among discs of any radii: a static tree of bounding boxes.
//!
//! The certificate has its own index, apart from the grid that biting uses: this one assumes nothing about how radii
//! vary.

use crate::geometry::{DVec2, Rect};
use std::ops::ControlFlow;

/// Discs per leaf.
const LEAF: usize = 8;
/// Most levels of the tree: discs are halved down to a leaf, so 2^48 discs would fit.
const DEPTH: usize = 48;

/// A disc and its index in the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Centre.
    pub centre: DVec2,
    /// Radius; 0 makes it a point.
    pub radius: f64,
    /// Index among the discs given.
    pub id: u32,
}

/// A box around the centres of some discs.
struct Node {
    bounds: Rect,
    /// Largest radius within.
    radius: f64,
    /// The second child; the first one follows its parent.
    second: u32,
    /// The discs below, a range of [`DiscTree::discs`].
    range: [u32; 2],
}

/// Discs in a tree of boxes.
pub struct DiscTree {
    nodes: Vec<Node>,
    discs: Vec<Disc>,
}

impl DiscTree {
    /// Builds the tree of discs given in any order. O(n log n).
    pub fn new(discs: impl Iterator<Item = (DVec2, f64)>) -> Self {
        let discs: Vec<Disc> = discs
            .zip(0..)
            .map(|((centre, radius), id)| Disc { centre, radius, id })
            .collect();
        let mut tree = Self {
            nodes: Vec::with_capacity(discs.len() / 2 + 1),
            discs,
        };
        if !tree.discs.is_empty() {
            tree.split(0, tree.discs.len());
        }
        tree
    }

    /// All discs; most that are near each other are next to each other.
    pub fn discs(&self) -> &[Disc] {
        &self.discs
    }

    fn split(&mut self, from: usize, to: usize) {
        let discs = &mut self.discs[from..to];
        let bounds = Rect::around(discs.iter().map(|disc| disc.centre));
        let radius = discs.iter().map(|disc| disc.radius).fold(0.0, f64::max);
        let node = self.nodes.len();
        self.nodes.push(Node {
            bounds,
            radius,
            second: 0,
            range: [from as u32, to as u32],
        });
        if to - from <= LEAF {
            return;
        }
        let (wide, middle) = (bounds.size().x >= bounds.size().y, (to - from) / 2);
        discs.select_nth_unstable_by(middle, |u, v| {
            let order = if wide {
                u.centre.x.total_cmp(&v.centre.x)
            } else {
                u.centre.y.total_cmp(&v.centre.y)
            };
            order.then(u.id.cmp(&v.id))
        });
        self.split(from, from + middle);
        self.nodes[node].second = self.nodes.len() as u32;
        self.split(from + middle, to);
    }

    /// Calls `visit` with every disc that has a point in common with the closed disc around `centre`, until it breaks off.
    pub fn meeting(&self, centre: DVec2, radius: f64, mut visit: impl FnMut(&Disc) -> ControlFlow<()>) {
        let mut stack = [0u32; DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let index = stack[height];
            let node = &self.nodes[index as usize];
            let reach = radius + node.radius;
            let outside = (node.bounds.min - centre)
                .max(centre - node.bounds.max)
                .max(DVec2::ZERO);
            if outside.length_squared() > reach * reach {
                continue;
            }
            if node.second != 0 {
                stack[height] = node.second;
                stack[height + 1] = index + 1;
                height += 2;
                continue;
            }
            for disc in &self.discs[node.range[0] as usize..node.range[1] as usize] {
                let reach = radius + disc.radius;
                if disc.centre.distance_squared(centre) <= reach * reach && visit(disc).is_break() {
                    return;
                }
            }
        }
    }

    /// Distance from `x` to the second closest centre; infinite if there are fewer than two.
    pub fn second_nearest(&self, x: DVec2) -> f64 {
        let (mut first, mut second) = (f64::INFINITY, f64::INFINITY);
        let lower = |node: &Node| away_squared(node.bounds, x);
        self.nearest_first(lower, |disc| {
            let distance = disc.centre.distance_squared(x);
            if distance < first {
                (first, second) = (distance, first);
            } else if distance < second {
                second = distance;
            }
            second
        });
        second.sqrt()
    }

    /// The least distance from `x` to a centre less `share` of the disc's radius; infinite if there are no discs.
    pub fn nearest_rim(&self, x: DVec2, share: f64) -> f64 {
        let mut least = f64::INFINITY;
        let lower = |node: &Node| away_squared(node.bounds, x).sqrt() - share * node.radius;
        self.nearest_first(lower, |disc| {
            least = least.min(disc.centre.distance(x) - share * disc.radius);
            least
        });
        least
    }

    /// Whether one of the discs holds the whole disc around `x`. Because of rounding, `false` may be wrong; `true` is not.
    pub fn one_holds(&self, x: DVec2, radius: f64) -> bool {
        let mut is_held = false;
        let lower = |node: &Node| away_squared(node.bounds, x).sqrt() - node.radius;
        self.nearest_first(lower, |disc| {
            is_held |= disc.centre.distance(x) + radius <= disc.radius;
            if is_held { f64::NEG_INFINITY } else { -radius }
        });
        is_held
    }

    /// Passes discs to `look`, those in boxes with small `lower` bounds first. Skips boxes whose lower bound is not
    /// below the limit that `look` returned last.
    fn nearest_first(&self, lower: impl Fn(&Node) -> f64, mut look: impl FnMut(&Disc) -> f64) {
        let mut limit = f64::INFINITY;
        let mut stack = [(0u32, f64::NEG_INFINITY); DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let (index, bound) = stack[height];
            if bound >= limit {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.second != 0 {
                let [one, other] = [index + 1, node.second].map(|k| (k, lower(&self.nodes[k as usize])));
                let (near, far) = if other.1 < one.1 { (other, one) } else { (one, other) };
                stack[height] = far;
                stack[height + 1] = near;
                height += 2;
                continue;
            }
            for disc in &self.discs[node.range[0] as usize..node.range[1] as usize] {
                limit = look(disc);
            }
        }
    }
}

/// The square of the distance from `x` to a box, 0 inside.
fn away_squared(bounds: Rect, x: DVec2) -> f64 {
    (bounds.min - x).max(x - bounds.max).max(DVec2::ZERO).length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn queries_agree_with_looking_at_all(
            discs in prop::collection::vec((0.0f64..4.0, 0.0f64..1.0, 0.0f64..1.0), 0..90),
            x in (-1.0f64..5.0, -1.0f64..2.0),
            radius in 0.0f64..1.0,
            is_tall in any::<bool>(),
            scale in prop::sample::select(vec![0.125, 1.0, 8.0]),
        ) {
            let place = |x: f64, y: f64| scale * if is_tall { DVec2::new(y, x) } else { DVec2::new(x, y) };
            // Mostly small, some large.
            let discs: Vec<_> = discs.iter().map(|&(x, y, r)| (place(x, y), scale * r * r * r)).collect();
            let radius = scale * radius;
            let tree = DiscTree::new(discs.iter().copied());
            let x = place(x.0, x.1);
            let mut ids: Vec<_> = tree.discs().iter().map(|disc| disc.id as usize).collect();
            ids.sort_unstable();
            prop_assert_eq!(ids, (0..discs.len()).collect::<Vec<_>>());
            prop_assert!(tree.discs().iter().all(|disc| discs[disc.id as usize] == (disc.centre, disc.radius)));
            let mut found = Vec::new();
            tree.meeting(x, radius, |disc| {
                found.push(disc.id as usize);
                ControlFlow::Continue(())
            });
            found.sort_unstable();
            let all: Vec<_> = (0..discs.len()).filter(|&k| discs[k].0.distance(x) <= radius + discs[k].1).collect();
            prop_assert_eq!(&found, &all);
            let mut visits = 0;
            tree.meeting(x, radius, |_| {
                visits += 1;
                if visits == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            prop_assert_eq!(visits, all.len().min(3));
            let mut distances: Vec<_> = discs.iter().map(|disc| disc.0.distance(x)).collect();
            distances.sort_by(f64::total_cmp);
            let expected = distances.get(1).copied().unwrap_or(f64::INFINITY);
            let found = tree.second_nearest(x);
            prop_assert!(found == expected || (found - expected).abs() < 1e-15 * scale, "{found} {expected}");
            let rims = discs.iter().map(|(centre, disc)| centre.distance(x) - 0.5 * disc);
            let expected = rims.fold(f64::INFINITY, f64::min);
            prop_assert_eq!(tree.nearest_rim(x, 0.5), expected);
            let held = discs.iter().any(|(centre, disc)| centre.distance(x) + 0.1 * radius < *disc);
            prop_assert_eq!(tree.one_holds(x, 0.1 * radius), held);
        }
    }

    #[test]
    fn discs_that_touch_meet_and_hold() {
        // More than one leaf: the disc in question, and others far away.
        let far = (0..20).map(|k| (DVec2::new(100.0 + f64::from(k), 50.0), 1.0));
        let tree = DiscTree::new(std::iter::once((DVec2::new(3.0, 4.0), 2.0)).chain(far));
        let meets = |radius: f64| {
            let mut found = Vec::new();
            tree.meeting(DVec2::ZERO, radius, |disc| {
                found.push(disc.id);
                ControlFlow::Continue(())
            });
            found
        };
        assert_eq!((meets(3.0), meets(2.9375)), (vec![0], vec![]));
        assert!(tree.one_holds(DVec2::new(3.0, 5.0), 1.0) && !tree.one_holds(DVec2::new(3.0, 5.0), 1.0625));
        // A centre at `x` itself is the nearest; another one there is the second nearest.
        assert_eq!(tree.second_nearest(DVec2::new(100.0, 50.0)), 1.0);
        let twins = DiscTree::new([(DVec2::X, 1.0), (DVec2::X, 2.0), (DVec2::Y, 0.0)].into_iter());
        assert_eq!(twins.second_nearest(DVec2::X), 0.0);
        assert_eq!(
            (twins.nearest_rim(DVec2::X, 0.5), twins.nearest_rim(DVec2::Y, 1.0)),
            (-1.0, 2f64.sqrt() - 2.0)
        );
        let none = DiscTree::new(std::iter::empty());
        assert_eq!(
            (none.second_nearest(DVec2::X), none.nearest_rim(DVec2::X, 1.0)),
            (f64::INFINITY, f64::INFINITY)
        );
        assert!(!none.one_holds(DVec2::X, 0.0) && none.discs().is_empty());
    }
}
