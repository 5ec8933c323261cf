//! §6.1: triangles that see their circumcentre (Lemmas 6.1 and 6.2).

use super::*;
use crate::suite::lemmas::record::Measured;
use crate::theory::Claim;

pub(super) const STATEMENTS: &[Statement] = &[LEMMA_6_1, LEMMA_6_2];

const DELAUNAY: &str = "no mesh vertex is inside the circumcircle, also none behind a segment: every boundary piece must be a Delaunay edge, which is never shown";
const COVERED: &str = "the circumcentre is in a biting circle";

/// |xp| where |xc| = D, |pc| = 1 and the angle x c p is given.
fn apart(v: &[Number]) -> Number {
    (v[0].square() + number(1.0) - number(2.0) * v[0] * v[1].cos()).root()
}

const LEMMA_6_1: Statement = Statement {
    name: "lemma-6.1",
    place: "Lemma 6.1, (6)",
    quantity: "shortest edge over circumradius, l / R, of a triangle that sees its circumcentre c",
    printed: Bound {
        says: "1 − 2t",
        at: |t| 1.0 - 2.0 * t,
    },
    silent: &[DELAUNAY, COVERED],
    used_by: &["Lemma 6.2"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "|x − c|, where R = 1 and the circle of x covers c",
                range: |_| (1.0, 3.0),
            },
            Unknown {
                name: "angle x c p, p the end of the shortest edge that is bitten first",
                range: |_| (0.0, std::f64::consts::PI),
            },
        ],
        constraints: &[],
        // l ≥ c_b f(p) ≥ c_b f(x) − t |xp|, and c_b f(x) ≥ |xc|.
        quantity: |t, v| v[0] - t * apart(v),
    },
    points: |t, v| {
        let [x, p] = [v[0], v[1]];
        let edge = x - t * (x * x + 1.0 - 2.0 * x * p.cos()).sqrt();
        // The shortest edge, from p on, as a chord of its length.
        let q = p + 2.0 * (0.5 * edge).asin();
        vec![
            place("c", 0.0, 0.0),
            centre("x", x, 0.0, x),
            centre("p", p.cos(), p.sin(), edge),
            place("q", q.cos(), q.sin()),
        ]
    },
    ..PLAIN
};

const LEMMA_6_2: Statement = Statement {
    name: "lemma-6.2",
    place: "Lemma 6.2, (7); on meshes Theorem 6.8, all triangles",
    quantity: "sin θ of the smallest angle of a triangle that sees its circumcentre",
    printed: Bound {
        says: "1/2 − t",
        at: |t| 0.5 - t,
    },
    used_by: &["Theorem 6.8"],
    problem: Problem {
        quantity: |t, v| number(0.5) * (v[0] - t * apart(v)),
        ..LEMMA_6_1.problem
    },
    measured: Some(Measured {
        claim: Claim::MinAngle,
        sense: Sense::AtLeast,
        quantity: Some(|degrees, _, _| degrees.to_radians().sin()),
    }),
    ..LEMMA_6_1
};
