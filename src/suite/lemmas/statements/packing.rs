//! §5.2: Lemmas 5.2 to 5.4 and Theorem 5.5.

use super::*;
use crate::suite::lemmas::record::Measured;
use crate::theory::{Claim, beta, packing_constant};

pub(super) const STATEMENTS: &[Statement] = &[LEMMA_5_2_LOWER, LEMMA_5_2_UPPER, LEMMA_5_3, LEMMA_5_4, THEOREM_5_5];

/// |xy| from 0 to 1, where f(x) = 1 and c₀ = 1: α c₀ is the parameter.
const NEAR: Unknown = Unknown {
    name: "|x − y| / (c₀ f(x))",
    range: |_| (0.0, 1.0),
};

const LEMMA_5_2_LOWER: Statement = Statement {
    name: "lemma-5.2-lower",
    place: "Lemma 5.2, (1), left",
    quantity: "f(y) / f(x) where |x − y| ≤ c₀ f(x)",
    printed: Bound {
        says: "1 − α c₀",
        at: |t| 1.0 - t,
    },
    parameter: "α c₀",
    range: (0.0, 1.0),
    range_says: "any c₀ ≥ 0; empty beyond α c₀ = 1",
    used_by: &["Theorem 5.5", "Lemmas 5.7, 5.8, 6.1, 6.3, 6.4, 6.7"],
    problem: Problem {
        unknowns: &[NEAR, SLOPE],
        constraints: &[],
        quantity: |t, v| number(1.0) + t * v[0] * v[1],
    },
    ..PLAIN
};

const LEMMA_5_2_UPPER: Statement = Statement {
    name: "lemma-5.2-upper",
    place: "Lemma 5.2, (1), right",
    sense: Sense::AtMost,
    printed: Bound {
        says: "1 + α c₀",
        at: |t| 1.0 + t,
    },
    ..LEMMA_5_2_LOWER
};

/// Two points at distance D, g = 1 at the first and 1 + slope t D at the second.
fn second_radius(t: Number, distance: Number, slope: Number) -> Number {
    number(1.0) + t * slope * distance
}

/// |xy| of two circles with an overlap: |xy| = 1 + (1 + slope t |xy|) − overlap.
pub(super) fn meeting_distance(t: Number, v: &[Number]) -> Number {
    (number(2.0) - v[0]) / (number(1.0) - t * v[1])
}

pub(super) fn two_circles(t: f64, v: &[f64]) -> Vec<Labelled> {
    vec![
        centre("x", 0.0, 0.0, 1.0),
        centre("y", v[0], 0.0, 1.0 + t * v[1] * v[0]),
    ]
}

pub(super) const LEMMA_5_3: Statement = Statement {
    name: "lemma-5.3",
    place: "Lemma 5.3",
    quantity: "|x − y| / (γ min(f(x), f(y))) where B(x, γ f(x)) and B(y, γ f(y)) meet",
    sense: Sense::AtMost,
    printed: Bound {
        says: "2 / (1 − α γ)",
        at: |t| 2.0 / (1.0 - t),
    },
    parameter: "α γ",
    range: (0.0, 0.75),
    range_says: "α γ < 1",
    used_by: &["Lemma 5.4 (γ = c_p)", "c_e and Lemma 5.7 (γ = c_b)"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "overlap γ f(x) + γ f(y) − |x − y| of the circles, where γ f(x) = 1 is the smaller radius",
                range: |_| (0.0, 2.0),
            },
            Unknown {
                name: "slope from x to y, as a share of α",
                range: |_| (0.0, 1.0),
            },
        ],
        constraints: &[],
        quantity: meeting_distance,
    },
    points: |t, v| two_circles(t, &[(2.0 - v[0]) / (1.0 - t * v[1]), v[1]]),
    ..PLAIN
};

const LEMMA_5_4: Statement = Statement {
    name: "lemma-5.4",
    place: "Lemma 5.4",
    quantity: "|x − y| / (c_b (f(x) + f(y))) for two centres: the largest c_p / c_b whose circles are disjoint",
    printed: Bound {
        says: "1 / (2 + t)",
        at: |t| packing_constant(1.0, t),
    },
    range: (0.0, 1.0),
    range_says: "any t",
    silent: &[
        "c_b ≤ 1 and f ≤ lfs: input vertices are bitten whether or not another's circle covers them, and only Lemma 5.1 keeps them apart",
        "middle circles are centred outside all earlier circles: at a right angle this needs t ≤ √2 − 1, unless what circles of other segments cover is skipped",
    ],
    used_by: &["Theorem 5.5", "Theorem 5.11"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "|x − y|, where c_b f(x) = 1 and x is bitten first",
                range: |_| (0.0, 8.0),
            },
            SLOPE,
        ],
        constraints: &[
            Constraint {
                says: "y is outside the circle of x",
                slack: |_, v| v[0] - number(1.0),
            },
            Constraint {
                says: "f(y) > 0",
                slack: |t, v| second_radius(t, v[0], v[1]),
            },
        ],
        // D / (2 + s t D) as 1 / (2 / D + s t): each unknown once.
        quantity: |t, v| number(1.0) / (number(2.0) / v[0].max(number(1e-9)) + t * v[1]),
    },
    measured: Some(Measured {
        claim: Claim::PackingDisjoint,
        sense: Sense::AtLeast,
        quantity: Some(|worst, _, t| worst / (2.0 + t)),
    }),
    points: two_circles,
    ..PLAIN
};

const THEOREM_5_5: Statement = Statement {
    name: "theorem-5.5",
    place: "Theorem 5.5",
    quantity: "β: the radius around y, over c_p f(y), at which it meets a packing circle",
    sense: Sense::AtMost,
    printed: Bound {
        says: "(1 + t) / (1 − t)",
        at: beta,
    },
    range: (0.0, 0.75),
    range_says: "t < 1",
    silent: &[
        "every point of the domain is in a biting circle (the front does not end early, and circles see what they cover)",
    ],
    used_by: &["Theorem 5.6", "Theorem 5.11"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "|x − y|, where c_b f(x) = 1 and the circle of x covers y",
                range: |_| (0.0, 1.0),
            },
            SLOPE,
        ],
        constraints: &[],
        // β c_p f(y) + c_p f(x) = |xy| with c_p = c_b / (2 + t)
        quantity: |t, v| (v[0] * (number(2.0) + t) - number(1.0)) / second_radius(t, v[0], v[1]),
    },
    points: two_circles,
    ..PLAIN
};
