//! Biting with distances that are measured inside the domain, as for [`lfs:geodesic`](crate::spacing::GeodesicLfs).
//!
//! # Idea
//! A circle B(x, s), s = c_b f(x), bites what it *reaches*: R(x, s), the connected part of B(x, s) ∩ Ω that holds x. Parts of
//! another arm of the domain inside it are left to the circles there, however much larger or smaller they are.
//!
//! # Theorem
//! Let f be α-Lipschitz in d, the length of shortest ways inside Ω, let f ≤ lfs_Ω, c_b ≤ 1 and t = α c_b ≤ √2 − 1, and let no
//! vertex that is cut off have an angle under 180° outside. Then what the paper proves of biting (Lemmas 5.4, 5.7 and 5.8,
//! Theorems 5.5 and 6.8, with their bounds and the further hypotheses that they need in the plane) holds in these words: two
//! points keep a distance, or one is near the other, if they *see* each other, that is if the straight line between them stays
//! in Ω; a circle covers what its centre sees.
//!
//! # Proof
//! For x and y that see each other d(x, y) = ‖x − y‖, and the paper's arguments about them stay as they are. It remains to
//! show that its arguments need no other pairs.
//!
//! *1. A point that is reached, but not seen, is held by another circle that sees it.* As s ≤ lfs_Ω(x), all features that
//! R(x, s) meets are incident to one another, so that it meets at most one vertex. Let z in R(x, s) be hidden from x. The
//! shortest way from x to z in R(x, s) turns at a vertex, so at the only one there is, v, which is not x. Both x and z see v.
//! The outside angle that hides z is at least 90° (narrower ones are [`crate::meshers::biting::beyond::notches`]), so
//! ‖x − v‖² + ‖z − v‖² ≤ s². Input vertices are bitten first, so x is not in the circle of v, and with ‖x − v‖ = a s,
//! a s ≥ s(v) ≥ s − t a s, or a ≥ 1 / (1 + t). Then ‖z − v‖² ≤ (1 − a²) s² ≤ (1 − t a)² s² ≤ s(v)²: the second step asks for
//! a ≥ 2t / (1 + t²), and 1 / (1 + t) is at least that if t² + 2t ≤ 1. So v's circle holds z.
//!
//! *2. Coverage (Theorem 5.5).* What a circle reaches is bounded, inside Ω, by the circle alone; so the front consists of arcs
//! as before, bites go on until all of Ω is reached, and by 1 all of it is seen by centres.
//!
//! *3. Distances (Lemma 5.4).* Of two centres that see each other the later is not in the circle of the earlier. If they do
//! not, a shortest way between them turns at input vertices, which are centres too. Summed up over its parts, d(x, y) ≥
//! c_p (f(x) + f(y)): what centres see of their packing circles has no point in common.
//!
//! *4. Nearest neighbours (Lemmas 5.7, 5.8).* Let z on the rim of what x reaches be covered by another circle, centred at y. If x
//! does not see z, there is a vertex in x's circle by 1. If it does, d(x, y) ≤ s(x) + s(y), and the first turn of a shortest
//! way from x to y, or else y, is a vertex that x sees and no farther away. The rest is the paper's. Nothing is gained by what is
//! reached and not seen: the vertex that hides it is nearer, and reached first.
//!
//! *5. Angles of the first subset (Lemma 6.1).* The triangulation is constrained Delaunay: the circumcircle of a triangle holds no
//! vertex that the triangle sees. Let the circumcentre c see the triangle, and let x see and cover c. Were x inside the
//! circumcircle and hidden from a point p of the triangle, then what hides it would enter the triangle c x p across the side x p
//! and end there, as the two other sides are free. Of its vertices in c x p, the first that a ray from p meets when it turns from c
//! towards x is seen from p and lies in the circumcircle: a contradiction. So ‖x − c‖ ≥ R. The other pairs of the proof, x and
//! c, c and a corner, and two corners of a triangle, see each other.
//!
//! *6. Angles of the second subset (Lemmas 6.3 to 6.7).* The piece p₁ p₂ is the nearest to the triangle of those between it and its
//! circumcentre. Between piece and triangle there is nothing, so that all points named there see each other.
//!
//! The search for circles nearby ([`crate::geometry::near`]) relies on radii being similar. Those of two circles that a point is
//! seen by are, as in 4; others need not be found, by 1.
//!
//! # What is not covered
//! The rule of the later point ([`crate::meshers::biting::beyond::rule`]): it follows lines across the outside, where f is
//! not defined. And t above √2 − 1, where 1 fails: by its numbers, for t = 1/2 and a = 2/3, z may be 0.745 s from v while
//! s(v) = 0.667 s.

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
    /// Some if distances of `spacing` are measured inside the domain; declined if biting is not proved to work.
    pub fn new(biting: &Biting, domain: &Domain, spacing: &dyn Spacing, t: f64) -> Result<Option<Self>, MeshError> {
        if !spacing.is_geodesic() {
            return Ok(None);
        }
        if biting.rule == Rule::Later {
            return Err(MeshError::Declined(
                "rule=later looks along lines that leave the domain, where lfs:geodesic says nothing; use rule=earlier, or \
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
