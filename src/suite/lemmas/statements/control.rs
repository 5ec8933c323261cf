//! §2, and Lemma 5.1: local feature size and Lipschitz functions.

use super::*;
use crate::suite::lemmas::record::Corrected;

pub(super) const STATEMENTS: &[Statement] = &[LEMMA_2_1, LEMMA_2_3_SUM, LEMMA_2_3_MIN, LEMMA_5_1];

/// Where x lies between the nearest points a and b of two features that do not touch: |xb| = lfs(x) = 1, |xa| ≤ 1.
fn across(v: &[Number]) -> Number {
    let [near, angle] = [v[0], v[1]];
    (near.square() + number(1.0) - number(2.0) * near * angle.cos()).root()
}

const LEMMA_2_1: Statement = Statement {
    name: "lemma-2.1",
    place: "Lemma 2.1",
    quantity: "f(x) / lfs(x) inside, for an α-Lipschitz f that is at most lfs on the boundary",
    sense: Sense::AtMost,
    printed: Bound {
        says: "1 (for α = 1)",
        at: |_| 1.0,
    },
    parameter: "α",
    range: (0.0, 1.0),
    range_says: "stated for α = 1, so for every α ≤ 1",
    used_by: &["§5.2 (\"the spacing function is maximal\")", "Theorem 5.11"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "|x a|, a the nearest point of the nearest feature, where lfs(x) = 1",
                range: |_| (0.0, 1.0),
            },
            Unknown {
                name: "angle a x b, b the nearest point of a feature that does not touch it",
                range: |_| (0.0, std::f64::consts::PI),
            },
        ],
        constraints: &[],
        // A disc around a that reaches b meets both features: f(a) ≤ lfs(a) ≤ |ab|, and f(x) ≤ f(a) + α |xa|; the same from b.
        quantity: |alpha, v| across(v) + alpha * v[0],
    },
    corrected: Some(Corrected {
        bound: Bound {
            says: "2 + α",
            at: |alpha| 2.0 + alpha,
        },
        range: (0.0, 1.0),
        why: "lfs(x) = 1 means that discs of radius 1 around x meet two features that do not touch, at points a and b say, and one \
              of them, a, has |xa| ≤ 1. Then f(a) ≤ lfs(a) ≤ |ab| ≤ 2, hence f(x) ≤ |ab| + α |xa| ≤ 2 + α, and no more can be said: \
              in a long strip of width 2 the function 2 + α dist(x, ∂Ω) is α-Lipschitz and equals lfs on the long sides, yet on the middle \
              line, where lfs = 1, it is 2 + α. Even the constant f = 2, which is 0-Lipschitz, is twice lfs there.",
        consequence: "lfs is not the largest 1-Lipschitz function with its values on the boundary. What needs f ≤ lfs inside (Lemma 5.1 does \
              not, the clearance of boundary circles does not) must assume it or lose a factor; size optimality (Theorem 5.11) \
              survives with constants up to 9 times worse, since a function that obeys lfs on the boundary alone is within a factor 3 of it.",
    }),
    points: |_, v| {
        let [near, angle] = [v[0], v[1]];
        vec![
            place("x", 0.0, 0.0),
            place("a", near, 0.0),
            place("b", angle.cos(), angle.sin()),
        ]
    },
    ..PLAIN
};

const LEMMA_2_3_SUM: Statement = Statement {
    name: "lemma-2.3-sum",
    place: "Lemma 2.3, sum",
    quantity: "|(f + g)(x) − (f + g)(y)| / |x − y| for constants 1 and α₂",
    sense: Sense::AtMost,
    printed: Bound {
        says: "1 + α₂",
        at: |second| 1.0 + second,
    },
    parameter: "α₂",
    range: (0.0, 2.0),
    range_says: "any",
    used_by: &["gns is 1-Lipschitz (§2.3)"],
    problem: Problem {
        unknowns: &[SLOPE, SLOPE],
        constraints: &[],
        quantity: |second, v| (v[0] + second * v[1]).abs(),
    },
    ..PLAIN
};

const LEMMA_2_3_MIN: Statement = Statement {
    name: "lemma-2.3-min",
    place: "Lemma 2.3, minimum (the maximum is that of −f and −g)",
    quantity: "|min(f, g)(x) − min(f, g)(y)| / |x − y| for constants 1 and α₂",
    sense: Sense::AtMost,
    printed: Bound {
        says: "max(1, α₂)",
        at: |second: f64| second.max(1.0),
    },
    parameter: "α₂",
    range: (0.0, 2.0),
    range_says: "any",
    used_by: &["gns is 1-Lipschitz (§2.3)"],
    problem: Problem {
        // |x − y| = 1, f(x) = 0
        unknowns: &[
            SLOPE,
            SLOPE,
            Unknown {
                name: "g(x) − f(x)",
                range: |second| (-2.0 - second, 2.0 + second),
            },
        ],
        constraints: &[],
        quantity: |second, v| {
            let at_y = v[0].min(v[2] + second * v[1]);
            (at_y - v[2].min(number(0.0))).abs()
        },
    },
    effort: Effort::within(5e-3),
    ..PLAIN
};

const LEMMA_5_1: Statement = Statement {
    name: "lemma-5.1",
    place: "Lemma 5.1",
    quantity: "nn(x) / lfs(x) at an input vertex x, nn the distance to the nearest other input vertex",
    sense: Sense::AtLeast,
    printed: Bound { says: "1", at: |_| 1.0 },
    parameter: "–",
    range: (0.0, 0.0),
    range_says: "no parameter",
    used_by: &[
        "c_p ≤ 1/2 keeps packing circles of input vertices apart (§5.2)",
        "Lemma 5.4 for two input vertices",
    ],
    problem: Problem {
        // nn(x) = 1. Two vertices are two features that do not touch, so the disc that reaches the other bounds lfs.
        unknowns: &[Unknown {
            name: "lfs(x)",
            range: |_| (1e-3, 2.0),
        }],
        constraints: &[Constraint {
            says: "a disc that holds two input vertices is no smaller than lfs",
            slack: |_, v| number(1.0) - v[0],
        }],
        quantity: |_, v| number(1.0) / v[0],
    },
    points: |_, _| vec![place("x", 0.0, 0.0), place("nearest input vertex", 1.0, 0.0)],
    ..PLAIN
};
