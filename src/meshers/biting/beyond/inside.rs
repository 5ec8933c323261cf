//! Biting with distances that are measured inside the domain, as for [`lfs:geodesic`](crate::spacing::GeodesicLfs).
//!
//! # Idea
//! A circle B(x, s), s = c_b f(x), bites what it *reaches*: R(x, s), the connected part of B(x, s) ∩ Ω that holds x. If
//! the circle also holds points of another arm of the domain, these are left to the circles of that arm, however much
//! larger or smaller they are.
//!
//! # Theorem
//! Let f be α-Lipschitz in d, the length of shortest ways inside Ω, let f ≤ lfs_Ω, c_b ≤ 1 and t = α c_b ≤ √2 − 1, and
//! let no vertex that is cut off have an angle under 180° outside. Two points *see* each other if the straight line
//! between them stays in Ω. Then the results of the paper on biting (Lemmas 5.4, 5.7 and 5.8, Theorems 5.5 and 6.8)
//! hold for points that see each other: such points keep their distances, or are near each other, and a circle covers
//! what its centre sees. The bounds, and the further hypotheses, are those of the plane.
//!
//! # Proof
//! If x and y see each other, d(x, y) = ‖x − y‖, and the paper's arguments about them stay as they are. It remains to
//! show that these arguments need no other pairs.
//!
//! *1. A point that is reached, but not seen, is held by another circle whose centre sees it.* Since s ≤ lfs_Ω(x), all
//! features that R(x, s) meets are incident to one another, so R(x, s) meets at most one vertex. Let z in R(x, s) be
//! hidden from x. The shortest way from x to z in R(x, s) turns at a vertex, which can only be that one vertex, v, and
//! is not x. Both x and z see v. The outside angle that hides z is at least 90° (for narrower ones see
//! [`crate::meshers::biting::beyond::notches`]), so ‖x − v‖² + ‖z − v‖² ≤ s². Input vertices are bitten first, so x is
//! not in the circle of v, and with ‖x − v‖ = a s, a s ≥ s(v) ≥ s − t a s, or a ≥ 1 / (1 + t). Then ‖z − v‖² ≤ (1 − a²)
//! s² ≤ (1 − t a)² s² ≤ s(v)²: the second step needs a ≥ 2t / (1 + t²), and 1 / (1 + t) is at least that if t² + 2t ≤
//! 1. So v's circle holds z.
//!
//! *2. Coverage (Theorem 5.5).* What a circle reaches is bounded, inside Ω, by the circle alone. So the front consists
//! of arcs as before, bites go on until all of Ω is reached, and by 1 every point of Ω is seen by a centre whose circle
//! holds it.
//!
//! *3. Distances (Lemma 5.4).* Of two centres that see each other, the later is not in the circle of the earlier. If
//! they do not see each other, a shortest way between them turns at input vertices, which are centres too. The sum over
//! its parts is d(x, y) ≥ c_p (f(x) + f(y)). So the parts of packing circles that their centres see have no point in
//! common.
//!
//! *4. Nearest neighbours (Lemmas 5.7, 5.8).* Let z be a point on the rim of what x reaches, covered by another circle,
//! with centre y. If x does not see z, there is a vertex in the circle of x by 1. If x sees z, then d(x, y) ≤ s(x) +
//! s(y), and the first turn of a shortest way from x to y (y itself, if the way is straight) is a vertex that x sees,
//! no farther away. The rest is the paper's proof. It makes no difference that nn counts what is reached, not what is
//! seen: the vertex that hides a reached point is nearer, and is reached first.
//!
//! *5. Angles of the first subset (Lemma 6.1).* The triangulation is constrained Delaunay: the circumcircle of a
//! triangle holds no vertex that the triangle sees. Let the circumcentre c see the triangle, and let x see and cover c.
//! Suppose that x is inside the circumcircle and hidden from a point p of the triangle. Then whatever hides it enters
//! the triangle c x p across the side x p and ends in it, since the two other sides are free. Turn a ray from p,
//! beginning at c, towards x: the first vertex in c x p that it meets is seen from p and lies in the circumcircle, a
//! contradiction. So ‖x − c‖ ≥ R. The other pairs of the proof see each other: x and c, c and a corner, and two corners
//! of a triangle.
//!
//! *6. Angles of the second subset (Lemmas 6.3 to 6.7).* Of the pieces between the triangle and its circumcentre, p₁ p₂
//! is the one nearest to the triangle. Nothing is between piece and triangle, so all points in that proof see each
//! other.
//!
//! The search for circles nearby ([`crate::geometry::near`]) relies on similar radii. Two circles whose centres see a
//! common point have similar radii, as in 4; other circles need not be found, by 1.
//!
//! # Limits
//! The rule of the later point ([`crate::meshers::biting::beyond::rule`]) is excluded, since it follows lines across
//! the outside, where f is not defined. So is t above √2 − 1, where step 1 fails: for t = 1/2 and a = 2/3, z may be
//! 0.745 s from v while s(v) = 0.667 s.

use crate::delaunay::{Part, Reach};
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use crate::meshers::MeshError;
use crate::meshers::biting::Biting;
use crate::spacing::Spacing;
use crate::theory::{GEODESIC_T, Rule};

/// What the circles bitten so far reach inside the domain.
pub(in crate::meshers::biting) struct Inside {
    reach: Reach,
    parts: Vec<Option<Part>>,
}

impl Inside {
    /// None unless the distances of `spacing` are measured inside the domain. Declined if biting is not proved to work.
    pub fn new(biting: &Biting, domain: &Domain, spacing: &dyn Spacing, t: f64) -> Result<Option<Self>, MeshError> {
        if !spacing.is_geodesic() {
            return Ok(None);
        }
        if biting.rule == Rule::Later {
            return Err(MeshError::Declined(
                "rule=later follows lines that leave the domain, where lfs:geodesic is not defined; use rule=earlier, or \
                 lfs as spacing"
                    .into(),
            ));
        }
        if t > GEODESIC_T {
            return Err(MeshError::Declined(format!(
                "with lfs:geodesic biting needs t = alpha c_b of at most {GEODESIC_T:.4}, and here it is {t}; limit the \
                 spacing's gradient (--t), or use lfs as spacing"
            )));
        }
        Ok(Some(Self {
            reach: Reach::new(domain)?,
            parts: Vec::new(),
        }))
    }

    /// The distance from an input vertex to the nearest feature not incident to it.
    pub fn nearest_apart(&self, vertex: DVec2) -> f64 {
        self.reach.smallest_apart(vertex)
    }

    /// Notes the next circle.
    pub fn add(&mut self, disc: Disc) {
        self.parts.push(self.reach.part(disc.centre, disc.radius));
    }

    /// Whether circle `id` reaches a point that it holds.
    pub fn reaches(&self, id: u32, point: DVec2) -> bool {
        let part = self.parts[id as usize].as_ref();
        part.is_none_or(|part| self.reach.is_in(part, point))
    }
}
