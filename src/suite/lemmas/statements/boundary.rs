//! §6.2: how high above a segment the circles of neighbouring boundary vertices meet (Lemmas 6.3 and 6.4).

use super::*;
use crate::geometry::near;
use crate::suite::lemmas::record::{Corrected, Measured};
use crate::theory::Claim;
use crate::theory::least_meeting_height;

pub(super) const STATEMENTS: &[Statement] = &[LEMMA_6_3, LEMMA_6_3_STEP, LEMMA_6_4, LEMMA_6_4_STEP, EQUATION_10];

const LABELLED: &str = "one of two neighbouring boundary vertices is labelled by the other: not so where the circles of the two input vertices of a \
                        segment cover it between them (possible only for c_b + t > 1), nor where circles touch and no middle circle is put there";

/// Height over the segment at which circles of radii 1 and b meet whose centres are c apart.
pub(super) fn meeting_height(b: Number, c: Number) -> Number {
    let along = (number(1.0) + c.square() - b.square()) / (number(2.0) * c);
    (number(1.0) - along.square()).root()
}

/// The upper point of circles of radii 1 and b whose centres are c apart, the first at the origin.
fn upper_point(b: f64, c: f64) -> Labelled {
    place("r", (1.0 + c * c - b * b) / (2.0 * c), near::meeting_height(c, 1.0, b))
}

/// What Lemma 6.3 has h_r / (c_b f(p₁)) be at least, (8); of Lemma 6.4 it is [`least_meeting_height`].
pub fn least_progressive_height(t: f64) -> f64 {
    (1.0 - t) * ((3.0 - t) * (1.0 + t)).sqrt() / 2.0
}

const LEMMA_6_3: Statement = Statement {
    name: "lemma-6.3",
    place: "Lemma 6.3, (8)",
    quantity: "h_r / (c_b f(p₁)) over a progressive piece: q = B(p₁)",
    printed: Bound {
        says: "(1 − t) √((3 − t)(1 + t)) / 2",
        at: least_progressive_height,
    },
    range: (0.0, 0.75),
    range_says: "any t < 1",
    used_by: &["the analysis of the second subset (§6.3)"],
    problem: Problem {
        // |p₁q| = c_b f(p₁) = 1
        unknowns: &[SLOPE],
        constraints: &[],
        quantity: |t, v| meeting_height(number(1.0) + t * v[0], number(1.0)),
    },
    // On meshes the certificate holds all pieces against (9), whichever label: see Lemma 6.4.
    points: |t, v| {
        let b = 1.0 + t * v[0];
        vec![
            centre("p₁", 0.0, 0.0, 1.0),
            centre("q", 1.0, 0.0, b),
            upper_point(b, 1.0),
        ]
    },
    ..PLAIN
};

/// sin θ is at least the smaller of its values at the two ends, and the lower end is the smaller.
const LEMMA_6_3_STEP: Statement = Statement {
    name: "lemma-6.3-step",
    place: "Lemma 6.3, proof: which of the two ends is the smaller",
    quantity: "(1 + t) √((3 + t)(1 − t)) − (1 − t) √((3 − t)(1 + t))",
    printed: Bound { says: "0", at: |_| 0.0 },
    range: (0.0, 0.75),
    range_says: "any t < 1",
    used_by: &["Lemma 6.3"],
    problem: Problem {
        unknowns: &[],
        constraints: &[],
        quantity: |t, _| {
            let one = number(1.0);
            let three = number(3.0);
            (one + t) * ((three + t) * (one - t)).root() - (one - t) * ((three - t) * (one + t)).root()
        },
    },
    ..PLAIN
};

/// Unknowns of a middle piece, where c_b f(p₁) = |p₁q₁| = 1.
pub(super) const MIDDLE: [Unknown; 3] = [
    Unknown {
        name: "c_b f(q₁), where c_b f(p₁) = 1",
        range: |t| (1.0 - t, 1.0 + t),
    },
    Unknown {
        name: "|q₁q₂| / (c_b f(q₁)): the circle of q₁ reaches q₂",
        range: |_| (0.0, 1.0),
    },
    Unknown {
        name: "slope from q₁ to q, as a share of t",
        range: |_| (-1.0, 1.0),
    },
];

/// c_b f(q), and c = |p₁q|, from those.
pub(super) fn middle(t: Number, v: &[Number]) -> (Number, Number) {
    let [d, share, slope] = [v[0], v[1], v[2]];
    let half = number(0.5) * share;
    // q is in the middle of q₁ and q₂.
    (d * (number(1.0) + t * slope * half), number(1.0) + half * d)
}

pub(super) fn middle_points(t: f64, v: &[f64]) -> Vec<Labelled> {
    let [d, share, slope] = [v[0], v[1], v[2]];
    let half = 0.5 * share * d;
    let (b, c) = (d + t * slope * half, 1.0 + half);
    vec![
        centre("p₁", 0.0, 0.0, 1.0),
        centre("q₁", 1.0, 0.0, d),
        centre("q", c, 0.0, b),
        place("q₂", 1.0 + 2.0 * half, 0.0),
        upper_point(b, c),
    ]
}

const LEMMA_6_4: Statement = Statement {
    name: "lemma-6.4",
    place: "Lemma 6.4, (9)",
    quantity: "h_r / (c_b f(p₁)) over a middle piece: q = M(p₁, p₂)",
    printed: Bound {
        says: "(1 − t) √((t² − 4t + 7)(1 − t²)) / 4",
        at: least_meeting_height,
    },
    range: (0.0, 0.75),
    range_says: "any t < 1",
    silent: &[LABELLED],
    used_by: &["(10)", "the analysis of the second subset (§6.3)"],
    problem: Problem {
        unknowns: &MIDDLE,
        constraints: &[],
        quantity: |t, v| {
            let (b, c) = middle(t, v);
            meeting_height(b, c)
        },
    },
    measured: Some(Measured {
        claim: Claim::BoundaryHeight,
        sense: Sense::AtLeast,
        quantity: Some(|worst, _, _| worst),
    }),
    points: middle_points,
    ..PLAIN
};

/// g of the proof over its value at 1 / (1 − t).
const LEMMA_6_4_STEP: Statement = Statement {
    name: "lemma-6.4-step",
    place: "Lemma 6.4, proof: g(x) is least at x = 1 / (1 − t)",
    quantity: "g(x) / g(1 / (1 − t)) for 1 / (1 + t) ≤ x ≤ 1 / (1 − t)",
    printed: Bound { says: "1", at: |_| 1.0 },
    range: (0.0, 0.75),
    range_says: "any t < 1",
    used_by: &["Lemma 6.4"],
    problem: Problem {
        unknowns: &[Unknown {
            name: "x = f(p₁) / f(q₁)",
            range: |t| (1.0 / (1.0 + t), 1.0 / (1.0 - t)),
        }],
        constraints: &[],
        quantity: |t, v| {
            let g = |x: Number| {
                let upper = x + number(0.25) * (number(3.0) - t);
                let lower = x - number(0.25) * (number(1.0) - t);
                (upper * lower).root() / (number(2.0) * x.square() + x)
            };
            g(v[0]) / g(number(1.0) / (number(1.0) - t))
        },
    },
    ..PLAIN
};

/// The least h_r / c: (9) over c / a = (3 − t) / 2.
pub(super) fn corrected_10(t: f64) -> f64 {
    2.0 * least_meeting_height(t) / (3.0 - t)
}

const EQUATION_10: Statement = Statement {
    name: "equation-10",
    place: "After Lemma 6.4, (10)",
    quantity: "h_r / c over a middle piece, c = |p₁q|",
    printed: Bound {
        says: "(1 − t)(3 − t) √((t² − 4t + 7)(1 − t²)) / 8",
        at: |t| least_meeting_height(t) * (3.0 - t) / 2.0,
    },
    range: (0.0, 0.75),
    range_says: "any t < 1",
    silent: &[LABELLED],
    used_by: &["Lemma 6.6"],
    problem: Problem {
        quantity: |t, v| {
            let (b, c) = middle(t, v);
            meeting_height(b, c) / c
        },
        ..LEMMA_6_4.problem
    },
    corrected: Some(Corrected {
        bound: Bound {
            says: "(1 − t) √((t² − 4t + 7)(1 − t²)) / (2 (3 − t))",
            at: corrected_10,
        },
        range: (0.0, 0.75),
        why: "h_r / c = (h_r / a)(a / c), and at x = a / d = 1 / (1 − t), where both are least, c / a = 1 + d / (2a) = (3 − t) / 2. The printed formula \
              multiplies (9) by that ratio where it should divide by it: at t = 0 it asks for h_r / c ≥ 3√7/8 = 0.99, when circles of radius 1 whose \
              centres are 3/2 apart meet at height √7/4 = 0.66, which is 0.44 of c. In terms of x, h_r / c = 2 √((3 − t)(1 − t)) \
              √((x + (3 − t)/4)(x − (1 − t)/4)) / (2x + 1)², which falls in x.",
        consequence: "Lemma 6.6 does not follow for all t ≤ 1/2: the corrected ratio is at least 1/4 only for t ≤ 0.3984.",
    }),
    measured: None,
    points: middle_points,
    ..PLAIN
};
