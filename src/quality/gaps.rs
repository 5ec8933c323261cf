//! How large the gaps between packing circles are: the β of Definition 4.1.
//!
//! With packing circles B(p, c_p f(p)) around the mesh vertices p, c_p = c_b / (2 + t), a point q has the gap `gap(q) =
//! min over p of (‖q − p‖ / c_p − f(p)) / f(q)`, and the circles are a β-packing if and only if they are disjoint (the
//! check `packing-disjoint`) and β is at least the largest gap over the domain. By Theorem 5.5 biting reaches β = (1 +
//! t) / (1 − t).
//!
//! # How it is found
//! For constant f the gap is largest at circumcentres, or on the boundary in the middle between two vertices. For
//! graded f the maxima move away from there, by a share of a circle. So the gap is measured at all circumcentres inside
//! the domain and in the middle of all pieces of segments. From the points with the largest gaps, the search climbs
//! with shrinking steps. All these points lie in the domain, so the result is never above the true maximum; it may be
//! below. If distances are measured inside the domain, circles across the outside count here too, which makes the
//! result smaller still.

use super::boundary::NO_SEGMENT;
use super::parallel;
use super::subject::{Sizes, Subject};
use crate::geometry::DVec2;
use crate::geometry::tolerance::CERTIFICATE;
use std::f64::consts::TAU;

/// The number of points from which the search climbs: those with the largest gaps.
const CLIMBED: usize = 32;
/// Directions tried with each step.
const DIRECTIONS: usize = 8;
/// How often the step is halved: from a quarter of a packing circle to about a thousandth of it.
const HALVINGS: usize = 8;
/// Most steps of one length.
const STEPS: usize = 8;

/// The largest gap found; absent without a spacing or without vertices.
pub fn beta(subject: &Subject) -> Option<f64> {
    let sizes = subject.sizes.as_ref()?;
    let gaps = Gaps::new(subject, sizes);
    let mut seeds = gaps.at_circumcentres();
    seeds.extend(gaps.at_pieces());
    // The place breaks ties, so that the order of triangles does not matter.
    let place = |x: DVec2| (x.x.to_bits(), x.y.to_bits());
    seeds.sort_unstable_by(|one, other| other.gap.total_cmp(&one.gap).then(place(one.at).cmp(&place(other.at))));
    seeds.truncate(CLIMBED);
    let tops = parallel::map(seeds.len(), |k| gaps.climb(&seeds[k]));
    tops.into_iter().reduce(f64::max).filter(|beta| beta.is_finite())
}

/// A point from which to climb.
struct Seed {
    at: DVec2,
    gap: f64,
    /// The piece of a segment it lies on.
    piece: Option<[DVec2; 2]>,
}

struct Gaps<'a> {
    subject: &'a Subject<'a>,
    sizes: &'a Sizes<'a>,
    c_p: f64,
    /// Radius of a packing circle over that of the biting circle in the tree.
    share: f64,
}

impl<'a> Gaps<'a> {
    fn new(subject: &'a Subject<'a>, sizes: &'a Sizes<'a>) -> Self {
        let c_p = sizes.packing_constant();
        Self {
            subject,
            sizes,
            c_p,
            share: c_p / (sizes.bounds.c_b * (1.0 + CERTIFICATE)),
        }
    }

    /// The gap at x, where the spacing is f.
    fn gap(&self, x: DVec2, f: f64) -> f64 {
        self.sizes.circles.nearest_rim(x, self.share) / (self.c_p * f)
    }

    fn at_circumcentres(&self) -> Vec<Seed> {
        let all = &self.sizes.circumcentres;
        let gaps = parallel::map(all.len(), |triangle| all[triangle].map(|(x, f)| (x, self.gap(x, f))));
        largest(
            gaps.into_iter()
                .flatten()
                .map(|(at, gap)| Seed { at, gap, piece: None }),
        )
    }

    fn at_pieces(&self) -> Vec<Seed> {
        let edges = self.subject.adjacency.edges();
        let on_segment = |e: &usize| self.subject.boundary.segment[*e] != NO_SEGMENT;
        let pieces: Vec<usize> = (0..edges.len()).filter(on_segment).collect();
        let gaps = parallel::map(pieces.len(), |k| {
            let at = self.subject.midpoint(pieces[k]);
            (at, self.gap(at, self.sizes.at_midpoint[pieces[k]]))
        });
        largest(gaps.into_iter().zip(&pieces).map(|((at, gap), e)| Seed {
            at,
            gap,
            piece: Some(edges[*e].ends.map(|v| self.subject.mesh.points[v as usize])),
        }))
    }

    /// The largest gap to which steps from a seed lead: along its piece first, if it lies on one.
    fn climb(&self, seed: &Seed) -> f64 {
        let reach = 0.25 * self.c_p * self.sizes.bounds.spacing.at(seed.at);
        let (mut at, mut best) = (seed.at, seed.gap);
        if let Some([from, to]) = seed.piece {
            let direction = (to - from).normalize_or_zero();
            let within = |x: DVec2| (x - from).dot(direction) > 0.0 && (to - x).dot(direction) > 0.0;
            (at, best) = self.ascend((at, best), reach, &[direction, -direction], within);
        }
        let around: [DVec2; DIRECTIONS] =
            std::array::from_fn(|k| DVec2::from_angle(TAU * k as f64 / DIRECTIONS as f64));
        self.ascend((at, best), reach, &around, |x| self.subject.domain.contains(x))
            .1
    }

    /// Goes uphill in these directions while points are `within`, and halves the steps when none leads further up.
    fn ascend(
        &self,
        (mut at, mut best): (DVec2, f64),
        reach: f64,
        directions: &[DVec2],
        within: impl Fn(DVec2) -> bool,
    ) -> (DVec2, f64) {
        let mut step = reach;
        for _ in 0..HALVINGS {
            for _ in 0..STEPS {
                let tried = directions.iter().map(|direction| at + step * *direction);
                let above = tried
                    .filter(|x| within(*x))
                    .map(|x| (x, self.gap(x, self.sizes.bounds.spacing.at(x))));
                let Some(higher) = above
                    .filter(|(_, gap)| *gap > best)
                    .reduce(|a, b| if b.1 > a.1 { b } else { a })
                else {
                    break;
                };
                (at, best) = higher;
            }
            step *= 0.5;
        }
        (at, best)
    }
}

/// At least the [`CLIMBED`] seeds with the largest gaps, and all that tie with the last one kept.
fn largest(seeds: impl Iterator<Item = Seed>) -> Vec<Seed> {
    let mut seeds: Vec<Seed> = seeds.collect();
    if seeds.len() > CLIMBED {
        let (_, last, _) = seeds.select_nth_unstable_by(CLIMBED, |one, other| other.gap.total_cmp(&one.gap));
        let least = last.gap;
        seeds.retain(|seed| seed.gap >= least);
    }
    seeds
}

#[cfg(test)]
mod tests {
    use crate::domain::{Domain, gallery};
    use crate::geometry::DVec2;
    use crate::mesh::Mesh;
    use crate::meshers::biting::{Biting, Corners, HeadOn, Order};
    use crate::meshers::{Budget, Mesher, Request, Trace};
    use crate::quality::judge;
    use crate::quality::tests::bounds;
    use crate::spacing::{self, Options, Spacing};
    use crate::theory::Rule;

    fn beta(domain: &Domain, mesh: &Mesh, spacing: &dyn Spacing, c_b: f64) -> f64 {
        judge(domain, mesh, Some(&bounds(spacing, c_b)))
            .0
            .beta
            .expect("there is a spacing")
    }

    /// Definition 4.1 at one point, by a loop over all vertices.
    fn gap(mesh: &Mesh, spacing: &dyn Spacing, c_b: f64, q: DVec2) -> f64 {
        let c_p = c_b / (2.0 + c_b * spacing.lipschitz());
        let gaps = mesh
            .points
            .iter()
            .map(|p| (q.distance(*p) / c_p - spacing.at(*p)) / spacing.at(q));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// The largest gap over a dense grid of points of the domain, and over a grid ten times as dense around its best.
    fn sampled(domain: &Domain, mesh: &Mesh, spacing: &dyn Spacing, c_b: f64) -> f64 {
        const SIDE: usize = 81;
        let best_in = |middle: DVec2, size: DVec2| {
            let at = |k: usize| DVec2::new((k % SIDE) as f64, (k / SIDE) as f64) / (SIDE - 1) as f64 - 0.5;
            let points = (0..SIDE * SIDE).map(|k| middle + at(k) * size);
            let inside = points
                .filter(|q| domain.contains(*q))
                .map(|q| (gap(mesh, spacing, c_b, q), q));
            inside
                .reduce(|a, b| if b.0 > a.0 { b } else { a })
                .expect("points inside")
        };
        let bounds = domain.bounds();
        let (coarse, at) = best_in(bounds.centre(), bounds.size());
        best_in(at, 8.0 / SIDE as f64 * bounds.size()).0.max(coarse)
    }

    #[test]
    fn beta_of_bitten_meshes_agrees_with_sampling_and_theorem_5_5() {
        for (name, spec, t, c_b) in [
            ("unit-square", "uniform:0.2", 0.25, 0.8),
            ("l-shape", "lfs", 0.3, 0.9),
            ("star", "lfs", 0.2, 0.6),
            ("unit-square", "expr:0.05 + 0.3*x", 0.3, 0.9),
        ] {
            let domain = gallery::domain(name).expect("a name").expect("a domain");
            let prepared = spacing::build(spec, &domain, &Options::new(t, c_b)).expect("a spacing");
            let spacing = &*prepared.function;
            let request = Request {
                c_b,
                seed: 0,
                threads: 1,
                budget: Budget::default(),
            };
            for order in [Order::Largest, Order::Fifo] {
                let mesh = Biting {
                    rule: Rule::Earlier,
                    order,
                    corners: Corners::Bite,
                    head_on: HeadOn::Leave,
                }
                .mesh(&domain, spacing, &request, &mut Trace::default())
                .expect("a mesh");
                let found = beta(&domain, &mesh, spacing, c_b);
                let dense = sampled(&domain, &mesh, spacing, c_b);
                let t = c_b * spacing.lipschitz();
                let bound = crate::theory::beta(t);
                assert!(found >= dense - 1e-9, "{name} {order:?}: {found} under {dense}");
                assert!(found <= dense + 0.03, "{name} {order:?}: {found} far above {dense}");
                assert!(found <= bound * (1.0 + 1e-8), "{name} {order:?}: {found} above {bound}");
                assert!(found > 0.3, "{name} {order:?}: {found}");
            }
        }
    }

    #[test]
    fn beta_by_hand() {
        // Corners and middle of the unit square with f = 1 and c_b = c_p · 2 = 0.5: the largest gap is in the middle of a
        // side, half a side from its ends and from the centre: 0.5 / 0.25 − 1 = 1.
        let domain = gallery::domain("unit-square").expect("a name").expect("a domain");
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y, DVec2::splat(0.5)];
        let mut mesh = Mesh {
            points: corners.to_vec(),
            triangles: vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
            ..Mesh::default()
        };
        let uniform = spacing::Uniform(1.0);
        assert!((beta(&domain, &mesh, &uniform, 0.5) - 1.0).abs() < 1e-12);
        // Without the middle the centre is √½ away from all: √½ / 0.25 − 1.
        mesh.points.truncate(4);
        mesh.triangles = vec![[0, 1, 2], [0, 2, 3]];
        assert!((beta(&domain, &mesh, &uniform, 0.5) - (8f64.sqrt() - 1.0)).abs() < 1e-12);
    }

    /// If triangles at the boundary are obtuse, their circumcentres lie outside, and the gap is largest on a segment.
    #[test]
    fn the_largest_gap_may_lie_on_a_segment_away_from_its_middle() {
        let flat = |turn: f64, x: f64| {
            let place = |x: f64, y: f64| DVec2::from_angle(turn).rotate(DVec2::new(x, y));
            let ring = [place(0.0, 0.0), place(1.0, 0.0), place(1.0, 0.4), place(0.0, 0.4)];
            let mut pslg = crate::domain::Pslg::new("flat");
            pslg.add_ring(ring, 1);
            let mesh = Mesh {
                points: [&ring[..], &[place(x, 0.1)]].concat(),
                triangles: vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
                ..Mesh::default()
            };
            beta(
                &Domain::new(pslg).expect("a domain"),
                &mesh,
                &spacing::Uniform(1.0),
                0.5,
            )
        };
        // On the upper side, at u from the farther corner, u² = (0.55 − u)² + 0.3². Circumcentres inside are 0.32 from
        // their corners.
        let exact = (0.3025 + 0.09) / 1.1 / 0.25 - 1.0;
        // Turned so that no direction tried in the plane follows a segment.
        let turns = [0.2, 1.7, 3.3, 4.9];
        for (turn, x) in turns.into_iter().flat_map(|turn| [(turn, 0.45), (turn, 0.55)]) {
            let found = flat(turn, x);
            assert!(
                found <= exact + 1e-12 && found >= exact - 0.004,
                "{found} where {exact} is right"
            );
        }
    }

    /// Steps of a quarter of a circle's radius may lead past the ends of a piece: gaps there do not count.
    #[test]
    fn no_gap_is_looked_for_outside() {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y, DVec2::splat(0.5)];
        for shift in [DVec2::ZERO, DVec2::splat(3.0), DVec2::splat(-5.0)] {
            let points = corners.map(|x| x + shift);
            let mut pslg = crate::domain::Pslg::new("square");
            pslg.add_ring(points[..4].iter().copied(), 1);
            let mesh = Mesh {
                points: points.to_vec(),
                triangles: vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
                ..Mesh::default()
            };
            // c_p = 5: in the middle of a side ½ / 5 − 1.
            let found = beta(
                &Domain::new(pslg).expect("a domain"),
                &mesh,
                &spacing::Uniform(1.0),
                10.0,
            );
            assert!((found + 0.9).abs() < 1e-8, "{found}");
        }
    }
}
