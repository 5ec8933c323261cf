//! How peers get the size function: a balanced quadtree whose leaves hold f at their corners, in one file which all of them
//! interpolate the same way (`baselines/PROTOCOL.md`).
//!
//! Inside a leaf the value is bilinear; a corner that hangs on the side of a larger leaf has the mean of that side's ends,
//! so that the whole is continuous.

use crate::domain::Domain;
use crate::geometry::{DVec2, Rect};
use crate::spacing::Spacing;
use crate::spacing::cover::Cell;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Deepest leaf, so that corners have coordinates in u32 on the grid of the smallest leaves.
const DEPTH: u32 = 30;

/// The root's side on that grid.
const SIDE: u32 = 1 << DEPTH;

/// A leaf in which f may change by more than this share of itself, by its Lipschitz constant, is split in any case: features
/// smaller than the leaf could hide between the points where f is evaluated.
const UNSEEN: f64 = 1.0;

/// First of the four children of a leaf.
const NONE: i32 = -1;

/// The first bytes of a file.
const MAGIC: &[u8; 8] = b"BITFIELD";

/// f interpolated on a balanced quadtree over the square around the domain.
#[derive(Clone, Debug)]
pub struct SizeField {
    root: Rect,
    /// For each cell the first of its children, or [`NONE`]: left below, right below, left above, right above.
    children: Vec<i32>,
    /// Values at the corners in the same order; of leaves only.
    corners: Vec<[f64; 4]>,
}

/// A square on the grid of the smallest leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Square {
    x: u32,
    y: u32,
    side: u32,
}

impl Square {
    const ROOT: Self = Self { x: 0, y: 0, side: SIDE };

    fn quarters(self) -> [Self; 4] {
        let side = self.side / 2;
        [(0, 0), (side, 0), (0, side), (side, side)].map(|(dx, dy)| Self {
            x: self.x + dx,
            y: self.y + dy,
            side,
        })
    }

    fn corners(self) -> [(u32, u32); 4] {
        let Self { x, y, side } = self;
        [(x, y), (x + side, y), (x, y + side), (x + side, y + side)]
    }
}

impl SizeField {
    /// Samples `spacing` over `domain`, splitting cells that meet it until the interpolated value at their centre and at the
    /// middles of their sides is within a share `error` of the exact one.
    pub fn of(spacing: &dyn Spacing, domain: &Domain, error: f64) -> Self {
        let mut tree = Tree::refined(spacing, domain, error);
        tree.balance();
        tree.with_values(spacing, domain)
    }

    /// The file of `baselines/PROTOCOL.md`.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        for number in [self.root.min.x, self.root.min.y, self.root.size().x] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend((self.children.len() as u64).to_le_bytes());
        bytes.extend(self.children.iter().flat_map(|child| child.to_le_bytes()));
        bytes.extend(self.corners.iter().flatten().flat_map(|value| value.to_le_bytes()));
        bytes
    }
}

/// The bilinear interpolant of values at the corners of the unit square.
fn bilinear([a, b, c, d]: [f64; 4], p: DVec2) -> f64 {
    let (below, above) = (a + p.x * (b - a), c + p.x * (d - c));
    below + p.y * (above - below)
}

/// The quadtree while it grows.
struct Tree {
    root: Rect,
    squares: Vec<Square>,
    children: Vec<i32>,
}

impl Tree {
    /// The tree that follows f, level by level.
    fn refined(spacing: &dyn Spacing, domain: &Domain, error: f64) -> Self {
        let whole = Cell::root(domain);
        let mut tree = Self {
            root: whole.rect,
            squares: vec![Square::ROOT],
            children: vec![NONE],
        };
        let mut level = vec![(0, whole)];
        while !level.is_empty() {
            let split: Vec<_> = level
                .par_iter()
                .filter(|(at, cell)| tree.squares[*at].side > 1 && !is_near(spacing, domain, cell, error))
                .map(|(at, cell)| (*at, cell.split(domain).collect::<Vec<_>>()))
                .collect();
            level = Vec::new();
            for (at, parts) in split {
                let first = tree.split(at);
                for part in parts {
                    // Which quarter it is, by its centre: parts that miss the domain are not among them.
                    let middle = tree.squares[first + 3];
                    let beyond = part.rect.centre().cmpgt(tree.place((middle.x, middle.y)));
                    level.push((first + usize::from(beyond.x) + 2 * usize::from(beyond.y), part));
                }
            }
        }
        tree
    }

    /// Splits a leaf; the index of its first child.
    fn split(&mut self, leaf: usize) -> usize {
        let first = self.squares.len();
        self.children[leaf] = first as i32;
        self.squares.extend(self.squares[leaf].quarters());
        self.children.extend([NONE; 4]);
        first
    }

    /// Splits leaves until those that share a side differ by one level at most.
    fn balance(&mut self) {
        let mut pending: Vec<usize> = (0..self.squares.len()).collect();
        while let Some(at) = pending.pop() {
            if self.children[at] != NONE {
                continue;
            }
            let Square { x, y, side } = self.squares[at];
            let beside = [
                x.checked_sub(1).map(|left| (left, y)),
                (x + side < SIDE).then_some((x + side, y)),
                y.checked_sub(1).map(|below| (x, below)),
                (y + side < SIDE).then_some((x, y + side)),
            ];
            for unit in beside.into_iter().flatten() {
                let leaf = self.leaf_at(unit);
                if self.squares[leaf].side > 2 * side {
                    let first = self.split(leaf);
                    pending.push(at);
                    pending.extend(first..first + 4);
                }
            }
        }
    }

    /// The leaf that holds a unit square of the grid.
    fn leaf_at(&self, (x, y): (u32, u32)) -> usize {
        let mut at = 0;
        while self.children[at] != NONE {
            let first = self.children[at] as usize;
            let middle = self.squares[first + 3];
            at = first + usize::from(x >= middle.x) + 2 * usize::from(y >= middle.y);
        }
        at
    }

    fn place(&self, (x, y): (u32, u32)) -> DVec2 {
        self.root.min + self.root.size() * DVec2::new(f64::from(x), f64::from(y)) / f64::from(SIDE)
    }

    fn with_values(self, spacing: &dyn Spacing, domain: &Domain) -> SizeField {
        let leaves = || (0..self.squares.len()).filter(|at| self.children[*at] == NONE);
        let nodes: BTreeSet<(u32, u32)> = leaves().flat_map(|at| self.squares[at].corners()).collect();
        let nodes: Vec<_> = nodes.into_iter().map(|node| (node, self.carrier(node))).collect();
        let standing: Vec<_> = nodes.iter().filter(|(_, carrier)| carrier.is_none()).collect();
        let exact = |(node, _): &&((u32, u32), _)| (*node, value(spacing, domain, self.place(*node)));
        let mut values: BTreeMap<_, f64> = standing.par_iter().map(exact).collect();
        let carriers: BTreeMap<_, _> = nodes
            .iter()
            .filter_map(|(node, carrier)| Some((*node, (*carrier)?)))
            .collect();
        for node in carriers.keys() {
            hang(*node, &carriers, &mut values);
        }
        let of_leaf = |at: usize| match self.children[at] {
            NONE => self.squares[at].corners().map(|node| values[&node]),
            _ => [0.0; 4],
        };
        SizeField {
            root: self.root,
            corners: (0..self.squares.len()).map(of_leaf).collect(),
            children: self.children,
        }
    }

    /// The ends of the leaf's side on which a node hangs, if it does.
    fn carrier(&self, (x, y): (u32, u32)) -> Option<[(u32, u32); 2]> {
        let sides = |at: u32| [at.checked_sub(1), (at < SIDE).then_some(at)];
        let units = sides(x)
            .into_iter()
            .flatten()
            .flat_map(|x| sides(y).into_iter().flatten().map(move |y| (x, y)));
        for unit in units {
            let leaf = self.squares[self.leaf_at(unit)];
            if leaf.corners().contains(&(x, y)) {
                continue;
            }
            let upright = x == leaf.x || x == leaf.x + leaf.side;
            return Some(if upright {
                [(x, leaf.y), (x, leaf.y + leaf.side)]
            } else {
                [(leaf.x, y), (leaf.x + leaf.side, y)]
            });
        }
        None
    }
}

/// The value of a hanging node: the mean of its side's ends, one of which may hang on a still larger leaf.
fn hang(
    node: (u32, u32),
    carriers: &BTreeMap<(u32, u32), [(u32, u32); 2]>,
    values: &mut BTreeMap<(u32, u32), f64>,
) -> f64 {
    if let Some(known) = values.get(&node) {
        return *known;
    }
    let mean = 0.5
        * carriers[&node]
            .map(|end| hang(end, carriers, values))
            .iter()
            .sum::<f64>();
    values.insert(node, mean);
    mean
}

/// f at `x`, which may lie outside the domain, where f need not be positive: there f at the domain's nearest point.
fn value(spacing: &dyn Spacing, domain: &Domain, x: DVec2) -> f64 {
    let plain = spacing.at(x);
    if plain > 0.0 && plain.is_finite() {
        return plain;
    }
    let nearest = domain.index().nearest(x);
    nearest.map_or(plain, |(segment, _)| {
        spacing.at(crate::geometry::segments::closest_on_segment(domain.ends(segment), x))
    })
}

/// Whether the bilinear function on a cell is near enough to f.
fn is_near(spacing: &dyn Spacing, domain: &Domain, cell: &Cell, error: f64) -> bool {
    let Rect { min, max } = cell.rect;
    let at = |x: f64, y: f64| value(spacing, domain, min + (max - min) * DVec2::new(x, y));
    let centre = at(0.5, 0.5);
    let change = spacing.lipschitz() * cell.rect.diagonal();
    if change <= error * centre {
        return true;
    }
    if change > UNSEEN * centre && change.is_finite() {
        return false;
    }
    let corners = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
    let is_off = |x: f64, y: f64, exact: f64| {
        let apart = (bilinear(corners, DVec2::new(x, y)) - exact).abs();
        apart > error * exact
    };
    let middles = [(0.5, 0.0), (1.0, 0.5), (0.5, 1.0), (0.0, 0.5)];
    !is_off(0.5, 0.5, centre) && !middles.iter().any(|(x, y)| is_off(*x, *y, at(*x, *y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::load;
    use crate::spacing::{Options, build};

    impl SizeField {
        /// The interpolated value at `x`; outside the root square that of the nearest point in it.
        fn at(&self, x: DVec2) -> f64 {
            let size = self.root.size();
            let mut p = ((x - self.root.min) / size).clamp(DVec2::ZERO, DVec2::ONE);
            let mut cell = 0;
            while self.children[cell] != NONE {
                p *= 2.0;
                let (right, above) = (p.x >= 1.0, p.y >= 1.0);
                p -= DVec2::new(f64::from(right), f64::from(above));
                cell = self.children[cell] as usize + usize::from(right) + 2 * usize::from(above);
            }
            bilinear(self.corners[cell], p)
        }
    }

    fn sampled(name: &str, spec: &str, error: f64) -> (Domain, std::sync::Arc<dyn Spacing>, SizeField) {
        let domain = load(name).expect("a gallery domain");
        let built = build(spec, &domain, &Options::with_alpha(0.4))
            .expect("a spacing")
            .function;
        let field = SizeField::of(&*built, &domain, error);
        (domain, built, field)
    }

    #[test]
    fn the_interpolated_value_is_near_the_exact_one() {
        for (name, spec) in [("plate-hole", "lfs"), ("unit-square", "expr:0.01 + 0.2*abs(x - 0.3)")] {
            let (domain, exact, field) = sampled(name, spec, 0.02);
            let bounds = domain.bounds();
            let mut worst: f64 = 0.0;
            for k in 0..40_000 {
                let share = DVec2::new(f64::from(k % 200) / 199.0, f64::from(k / 200) / 199.0);
                let x = bounds.min + bounds.size() * share;
                if domain.contains(x) {
                    worst = worst.max((field.at(x) / exact.at(x) - 1.0).abs());
                }
            }
            // It is compared in nine points of a leaf only.
            assert!(worst < 0.05, "{name} {spec}: {worst}");
        }
    }

    #[test]
    fn it_is_continuous_across_leaves() {
        let (domain, _, field) = sampled("comb", "lfs", 0.02);
        let bounds = domain.bounds();
        let step = 1e-9 * bounds.size().max_element();
        for k in 0..=1024 {
            for across in 0..=16 {
                // Lines on which leaves meet.
                let along = f64::from(k) / 1024.0;
                let on = field.root.min + field.root.size() * DVec2::new(along, f64::from(across) / 16.0);
                let [one, two] = [-step, step].map(|dy| field.at(on + DVec2::new(0.0, dy)));
                assert!((one / two - 1.0).abs() < 1e-5, "{on}: {one} and {two}");
            }
        }
    }

    #[test]
    fn neighbours_differ_by_one_level() {
        let domain = load("two-arms").expect("a gallery domain");
        let built = build("lfs", &domain, &Options::with_alpha(0.4))
            .expect("a spacing")
            .function;
        let mut tree = Tree::refined(&*built, &domain, 0.05);
        tree.balance();
        for at in (0..tree.squares.len()).filter(|at| tree.children[*at] == NONE) {
            let Square { x, y, side } = tree.squares[at];
            for unit in [(x + side, y), (x, y + side)]
                .into_iter()
                .filter(|(x, y)| *x < SIDE && *y < SIDE)
            {
                let other = tree.squares[tree.leaf_at(unit)].side;
                assert!(other <= 2 * side, "{side} beside {other}");
            }
        }
    }

    #[test]
    fn a_uniform_spacing_is_one_cell_and_its_file_is_as_the_protocol_says() {
        let (_, _, field) = sampled("unit-square", "uniform:0.125", 0.02);
        assert_eq!(field.children.len(), 1);
        let mut expected = b"BITFIELD".to_vec();
        for number in [0.0f64, 0.0, 1.0] {
            expected.extend(number.to_le_bytes());
        }
        expected.extend(1u64.to_le_bytes());
        expected.extend((-1i32).to_le_bytes());
        for _ in 0..4 {
            expected.extend(0.125f64.to_le_bytes());
        }
        assert_eq!(field.to_bytes(), expected);
        assert_eq!(field.at(DVec2::new(7.0, -3.0)), 0.125);
    }
}
