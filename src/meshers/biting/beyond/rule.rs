//! Who bites whom: what the rule of the later point changes.
//!
//! # Idea
//! Let g = c_b f be t-Lipschitz with t < 1. By the paper's rule a point x eats the circle B(x, g(x)). By the rule of
//! the later point ([`Rule::Later`]) it eats every y to which it is too near, { y : ‖x − y‖ < g(y) }. Along a ray from
//! x, the distance less g rises. So what x eats is star-shaped, lies between B(x, g(x) / (1 + t)) and B(x, g(x) / (1 −
//! t)), and is a circle if f is constant. The front is where the distance to the nearest point is g. Its vertices are
//! the points y with two nearest points, ‖y − x₁‖ = ‖y − x₂‖ = g(y), which lie on edges of the Voronoi diagram. So the
//! search for a pair of points takes the part of their bisector to which no third point is nearer (mostly there is
//! none), and [`PassingLine`] finds where this part leaves what is eaten. A front vertex y is eaten by every point
//! nearer than g(y).
//!
//! # What is known and what is new
//! Mitchell, Rand, Ebeida and Bajaj compare rules for random samplings of domains without a boundary. The paper's rule
//! is their *prior-disks*, the rule of the later point their *current-disks*. With L for t, they prove sin θ ≥ (1 − 2L)
//! / 2 for the first and sin θ ≥ (1 − L) / 2 for the second, so the bound of the first subset below is theirs. New here
//! are the boundary (the second subset, edge protection, corners of 90° and more, for any t < 1), the front of a bite
//! that is not a circle, the constants of nn and β, and the hypotheses under which all of this holds.
//!
//! # The smallest angle
//! Let f ≤ lfs, c_b ≤ 1, no angle under 90°. **First subset.** The circumcentre c of a triangle is a point of the
//! domain that sees it. Its nearest points are at distance R, the radius, and it is eaten, so R ≤ g(c). Let q be the
//! later end of the shortest edge, which is l long. Then l ≥ g(q) ≥ g(c) − t R ≥ (1 − t) R, and
//!
//! > sin θ = l / 2R ≥ (1 − t) / 2,
//!
//! The paper's rule has 1/2 − t instead: there the circle that holds c belongs to a third point, which costs t R once
//! more. **Second subset.** A piece p₁ p₂ of a segment, c = ‖p₁ p₂‖, separates the triangle from its circumcentre. The
//! circle's chord lies in the piece, the triangle in the half disc over it. A vertex x off the segment has ‖x − pᵢ‖ ≥
//! g(x). For an interior point the reason is that it is later than pᵢ. On a segment that does not meet this one, it
//! follows from lfs(x). On a segment that meets this one in a vertex v, it follows from ‖x − pᵢ‖ ≥ ‖x − v‖ ≥ g(x). The
//! angle φ at x is at least 90°. And R ≤ c / (2 sin φ): of the circles through x that hold neither pᵢ and have their
//! centre beyond the piece, the one through both is the largest. Of the ends of the shortest edge that are off the
//! segment, let x be the later. Then l ≥ g(x) and sin θ ≥ g(x) sin φ / c. The piece determines how large g is:
//! - if one end was put on the border of what the other had eaten, c = g(p₂), and g(x) ≥ c − t ‖x − p₂‖;
//! - if one end is the middle of a gap whose end q₁ is on the border of what p₁ had eaten, then with a = ‖q₁ − p₁‖ =
//!   g(q₁), a ≤ c ≤ 3a/2 and g(x) ≥ a − t ‖x − q₁‖;
//! - two input vertices without a point between them do not occur: the middle m of a segment has g(m) ≤ c_b lfs(m) ≤
//!   ‖p₁ p₂‖ / 2, so it is not eaten. (By the paper's rule they occur if c_b + t > 1, and their circles meet low.)
//!
//! As in Lemmas 6.3 and 6.4, front vertices over a piece are equally far from its ends, so they are h = √(g² − c²/4)
//! above it. Over pieces of the first kind h ≥ c √(1 / (1 + t)² − 1/4), over those of the second kind h is at least the
//! root of √(c²/4 + h²) + t √((a − c/2)² + h²) = a for c = 3a/2. Both are positive for t < 1; at t = 1/4 they are 0.624
//! c and 0.297 c.
//!
//! Finding the least g(x) sin φ / c over all such x is a problem in two unknowns and c. For every t < 1 it is above (1
//! − t) / 2: by a factor of 1.32 at t = 0, and by more for all other t tried. In the first case there is no such x for
//! t < √2 − 1. A test repeats the search. So the bound of the first subset holds for all triangles and all t < 1. (As
//! in the paper, circumcentres that see a vertex across a piece of an inner segment are left out; such pieces are
//! counted as forced.)
//!
//! # Distances, packing, size
//! Any two points x and y are at least min(g(x), g(y)) apart, so Lemma 5.4 holds as it stands, c_p = c_b / (2 + t). For
//! the rest, let x be the point itself or the one nearest to y:
//! - nn(x) ≥ g(x) / (1 + t): either ‖x − y‖ ≥ g(x), or ‖x − y‖ ≥ g(y) ≥ g(x) − t ‖x − y‖;
//! - nn(x) ≤ 2 g(x) / (1 − t): a point z on the border of what x has eaten is also eaten by another point, or on the
//!   border of what that has eaten, and g(z) ≤ g(x) + t g(z);
//! - nn(y) ≥ g(y) / (2 + t) elsewhere: with x and z the two nearest points, 2 nn(y) ≥ ‖x − z‖ ≥ g of the later ≥ g(y) −
//!   t nn(y);
//! - nn(y) ≤ (3 + t) / (1 − t) · g(y): ‖y − x‖ ≤ g(y), g(x) ≤ (1 + t) g(y), and x has a neighbour within 2 g(x) / (1 − t);
//! - β = 1 + 2t instead of (1 + t) / (1 − t) in Theorem 5.5: D = ‖x − y‖ ≤ g(y) has
//!   β g(y) + g(x) ≥ (1 + β) g(y) − t D ≥ (2 + t) D.
//!
//! # Other rules
//! With the smaller of g(x) and g(y) (*smaller-disks* in that paper) the same bound follows, with more points, since it
//! asks for less distance. With the larger (*bigger-disks*) the circle that holds the circumcentre may be one of the
//! paper's rule, and only 1/2 − t follows.
//!
//! # Reference
//! S. A. Mitchell, A. Rand, M. S. Ebeida, C. Bajaj, "Variable radii Poisson-disk sampling", 24th Canadian Conference on
//! Computational Geometry (CCCG), 2012.

use crate::geometry::near::{Disc, Near, circle_intersections};
use crate::geometry::{DVec2, tolerance};
use crate::meshers::MeshError;
use crate::meshers::biting::beyond::crossing::PassingLine;
use crate::meshers::biting::front::Front;
use crate::theory::Rule;

/// Radii and distances are rounded, so searches reach farther by this factor.
const ROOM: f64 = 1.0 + 1e-6;

/// A point where the borders of what two points have eaten meet.
#[derive(Clone, Copy, Debug)]
pub(in crate::meshers::biting) struct Meeting {
    /// The place, relative to the first of the two points.
    pub relative: DVec2,
    /// By the rule of the later point, g there: every point nearer than that has eaten the place.
    pub reach: Option<f64>,
}

impl Front<'_> {
    /// Collects the bitten discs that share a point with what the centre of `disc` eats.
    pub(in crate::meshers::biting) fn near_bite(&self, disc: Disc, near: &mut Vec<Near>) {
        match self.rule {
            Rule::Earlier => self.bitten.meeting(disc.centre, disc.radius, near),
            Rule::Later => self.bitten.sharing(disc.centre, disc.radius, near),
        }
    }

    /// The discs that have eaten the centre of `disc`, seen or not.
    pub(in crate::meshers::biting) fn covering(&self, disc: Disc) -> Vec<Near> {
        let mut near = Vec::new();
        match self.rule {
            Rule::Earlier => self
                .bitten
                .covering(disc.centre, disc.radius, tolerance::COVERED, &mut near),
            Rule::Later => {
                self.bitten.within(disc.centre, disc.radius, &mut near);
                let shrunk = disc.radius * (1.0 - tolerance::COVERED);
                near.retain(|other| other.distance_squared < shrunk * shrunk);
            }
        }
        near
    }

    /// A disc that holds all that the centre of `disc` eats.
    pub(in crate::meshers::biting) fn around_bite(&self, disc: Disc) -> Disc {
        match self.rule {
            Rule::Earlier => disc,
            Rule::Later => Disc {
                radius: disc.radius * ROOM / (1.0 - self.radii.t()),
                ..disc
            },
        }
    }

    /// Where the border of what `disc` eats meets that of `near[index]`. By the rule of the later point, only meetings
    /// that no other disc of `near` has eaten.
    pub(in crate::meshers::biting) fn meetings(
        &self,
        disc: Disc,
        near: &[Near],
        index: usize,
    ) -> Result<Vec<Meeting>, MeshError> {
        let other = &near[index];
        match self.rule {
            Rule::Earlier => {
                let points = circle_intersections(disc.radius, other);
                Ok(points.map(|relative| Meeting { relative, reach: None }).to_vec())
            }
            Rule::Later => self.meetings_on_bisector(disc, near, index),
        }
    }

    fn meetings_on_bisector(&self, disc: Disc, near: &[Near], index: usize) -> Result<Vec<Meeting>, MeshError> {
        let other = &near[index];
        let Some(bisector) = self.bisector(disc, near, index) else {
            return Ok(Vec::new());
        };
        let half = 0.5 * other.offset;
        let line = PassingLine {
            sizing: self.radii,
            foot: disc.centre + half,
            direction: bisector.direction,
            away: half.length(),
            share: 1.0,
            guess: disc.radius,
        };
        let mut crossings = Vec::new();
        for range in bisector.outside(
            disc.radius.max(other.radius) / (ROOM * (1.0 + self.radii.t())),
            half.length(),
        ) {
            crossings.extend(line.crossings(range)?);
        }
        let meeting = |crossing: &crate::meshers::biting::beyond::crossing::Crossing| {
            // If f is constant, this is the same point as by the paper's rule, bit by bit.
            let circle = Near {
                radius: crossing.radius,
                ..*other
            };
            let relative = match crossing.radius == disc.radius {
                true => circle_intersections(crossing.radius, &circle)[usize::from(crossing.at > 0.0)],
                false => half + bisector.direction * crossing.at,
            };
            Meeting {
                relative,
                reach: Some(crossing.radius),
            }
        };
        Ok(crossings.iter().map(meeting).collect())
    }

    /// The part of the bisector of a disc's centre and a near one that may hold front vertices: in the box of the
    /// domain, not too far away, and, up to rounding, no nearer to a third centre.
    fn bisector(&self, disc: Disc, near: &[Near], index: usize) -> Option<Bisector> {
        let other = &near[index];
        let reach = ROOM * disc.radius.min(other.radius) / (1.0 - self.radii.t());
        let across = reach * reach - 0.25 * other.distance_squared;
        if across <= 0.0 {
            return None;
        }
        let mut bisector = Bisector {
            direction: (other.offset / other.distance_squared.sqrt()).perp(),
            from: -across.sqrt(),
            to: across.sqrt(),
        };
        let half = 0.5 * other.offset;
        let bounds = self.domain.bounds();
        bisector.keep_within(disc.centre + half, [bounds.min, bounds.max]);
        let rounding = 8.0 * tolerance::COVERED * reach * reach;
        for (k, third) in near.iter().enumerate() {
            if k == index || self.beside_notch[third.id as usize] {
                continue;
            }
            // The points p with 2 p·u > ‖u‖² are nearer to the third centre u.
            let along = 2.0 * bisector.direction.dot(third.offset);
            let beyond = third.distance_squared - other.offset.dot(third.offset);
            if along > 0.0 {
                bisector.to = bisector.to.min((beyond + rounding) / along);
            } else if along < 0.0 {
                bisector.from = bisector.from.max((beyond + rounding) / along);
            }
            if bisector.from >= bisector.to {
                return None;
            }
        }
        Some(bisector)
    }
}

/// A part of a bisector, by signed distance from its foot.
struct Bisector {
    direction: DVec2,
    from: f64,
    to: f64,
}

impl Bisector {
    /// The parts of the bisector that are farther than `radius` from the two centres, of which its foot is `away`.
    /// Nearer parts are eaten, since g cannot fall so fast.
    fn outside(&self, radius: f64, away: f64) -> impl Iterator<Item = [f64; 2]> + use<> {
        let across = radius * radius - away * away;
        let parts = if across > 0.0 {
            let eaten = across.sqrt();
            [[self.from, self.to.min(-eaten)], [self.from.max(eaten), self.to]]
        } else {
            [[self.from, self.to], [0.0, 0.0]]
        };
        parts.into_iter().filter(|[from, to]| from < to)
    }

    fn keep_within(&mut self, foot: DVec2, [min, max]: [DVec2; 2]) {
        for axis in 0..2 {
            let (way, low, high) = (self.direction[axis], min[axis] - foot[axis], max[axis] - foot[axis]);
            if way != 0.0 {
                self.from = self.from.max((low / way).min(high / way));
                self.to = self.to.min((low / way).max(high / way));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    /// A piece from (0, 0) to (c, 0) where g is at least `size` − t ‖x − q‖.
    struct Piece {
        length: f64,
        /// The place of q along the piece.
        q: f64,
        size: f64,
    }

    /// The least of g(x) sin φ / c over the points of a box that §6.3 allows, with g as small as it may be, and where
    /// it is.
    fn least(piece: &Piece, t: f64, [low, high]: [[f64; 2]; 2], side: usize) -> Option<(f64, [f64; 2])> {
        let mut best: Option<(f64, [f64; 2])> = None;
        let step = |axis: usize| (high[axis] - low[axis]) / side as f64;
        for (i, j) in (0..=side).flat_map(|i| (0..=side).map(move |j| (i, j))) {
            let x = [low[0] + i as f64 * step(0), low[1] + j as f64 * step(1)];
            let away = |from: f64| (x[0] - from).hypot(x[1]);
            let (one, other) = (away(0.0), away(piece.length));
            let g = (piece.size - t * away(piece.q)).max(0.0);
            let is_far = one.min(other) >= g && x[1] > 0.0;
            let is_obtuse = one * one + other * other <= piece.length * piece.length;
            // ½ ‖x − p₁‖ ‖x − p₂‖ sin φ = ½ c · height.
            let sine = g * x[1] / (one * other);
            if is_far && is_obtuse && best.is_none_or(|(least, _)| sine < least) {
                best = Some((sine, x));
            }
        }
        best
    }

    /// The same over all points, on finer and finer grids around the best.
    fn least_of_all(piece: &Piece, t: f64) -> f64 {
        let half = 0.5 * piece.length;
        let Some((mut sine, mut at)) = least(piece, t, [[0.0, 0.0], [piece.length, half]], 160) else {
            return f64::INFINITY;
        };
        let mut room = half / 20.0;
        for _ in 0..4 {
            let low = [(at[0] - room).max(0.0), (at[1] - room).max(0.0)];
            let high = [(at[0] + room).min(piece.length), (at[1] + room).min(half)];
            if let Some((finer, place)) = least(piece, t, [low, high], 40).filter(|(finer, _)| *finer < sine) {
                (sine, at) = (finer, place);
            }
            room *= 0.2;
        }
        sine
    }

    #[test]
    fn the_bound_of_the_first_subset_holds_beside_the_boundary() {
        for t in [0.0, 0.1, 0.25, 1.0 / 3.0, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97] {
            let bound = 0.5 * (1.0 - t);
            let progressive = Piece {
                length: 1.0,
                q: 1.0,
                size: 1.0,
            };
            let least = least_of_all(&progressive, t);
            assert!(least > 2.0 * bound, "{t}: {least} {bound}");
            assert!(t > 0.41 || least == f64::INFINITY, "{t}: {least}");
            for k in 0..=10 {
                let middle = Piece {
                    length: 1.0 + 0.05 * f64::from(k),
                    q: 1.0,
                    size: 1.0,
                };
                let least = least_of_all(&middle, t);
                assert!(least > 1.32 * bound, "{t}, {}: {least} {bound}", middle.length);
            }
        }
        // √7 / 4 by hand: x is 1 from both ends of a piece of 3/2.
        let middle = Piece {
            length: 1.5,
            q: 1.0,
            size: 1.0,
        };
        assert!((least_of_all(&middle, 0.0) - 7f64.sqrt() / 4.0).abs() < 1e-4);
    }
}
