//! §5.3: nearest neighbours (Lemmas 5.7 and 5.8) and the size of the mesh (Theorem 5.11).

use super::packing::{meeting_distance, two_circles};
use super::*;
use crate::geometry::interval::Interval;
use crate::suite::lemmas::record::{Corrected, Measured};
use crate::theory::Claim;
use std::f64::consts::PI;

pub(super) const STATEMENTS: &[Statement] = &[
    LEMMA_5_7_LOWER,
    LEMMA_5_7_UPPER,
    LEMMA_5_8_LOWER,
    LEMMA_5_8_UPPER,
    THEOREM_5_11_LOWER,
    THEOREM_5_11_UPPER,
];

const VERTICES_APART: &[&str] = &["c_b ≤ 1 and f ≤ lfs, as for Lemma 5.4"];

const LEMMA_5_7_LOWER: Statement = Statement {
    name: "lemma-5.7-lower",
    place: "Lemma 5.7, (2), left",
    quantity: "nn(x) / (c_b f(x)) at a mesh vertex x",
    printed: Bound {
        says: "1 − t",
        at: |t| papers(t).nn_at_vertices()[0],
    },
    range: (0.0, 0.75),
    range_says: "t < 1",
    silent: VERTICES_APART,
    used_by: &["Theorem 5.11"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "|x − y|, where c_b f(x) = 1 and y is bitten first",
                range: |_| (0.0, 2.0),
            },
            SLOPE,
        ],
        constraints: &[Constraint {
            says: "x is outside the circle of y",
            slack: |t, v| v[0] - (number(1.0) + t * v[1] * v[0]),
        }],
        quantity: |_, v| v[0],
    },
    corrected: Some(Corrected {
        bound: Bound {
            says: "1 / (1 + t)",
            at: |t| 1.0 / (1.0 + t),
        },
        range: (0.0, 0.75),
        why: "The proof takes f(y) ≥ (1 − t) f(x), which is at distance c_b f(x); but y is nearer than that. With y bitten first, \
              |x − y| ≥ c_b f(y) ≥ c_b f(x) − t |x − y|, hence |x − y| ≥ c_b f(x) / (1 + t).",
        consequence: "The lemma holds; the corrected constant is larger, and attained.",
    }),
    measured: Some(Measured {
        claim: Claim::NnVertexLower,
        sense: Sense::AtLeast,
        quantity: Some(|worst, c_b, _| worst / c_b),
    }),
    points: two_circles,
    ..PLAIN
};

const LEMMA_5_7_UPPER: Statement = Statement {
    name: "lemma-5.7-upper",
    place: "Lemma 5.7, (2), right",
    quantity: "nn(x) / (c_b f(x)) at a mesh vertex x",
    sense: Sense::AtMost,
    printed: Bound {
        says: "2 / (1 − t)",
        at: |t| papers(t).nn_at_vertices()[1],
    },
    range: (0.0, 0.75),
    range_says: "t < 1",
    silent: &[
        "the circle of x does not hold all of its part of the domain, or another vertex is in it: true, since every input vertex is a mesh vertex",
    ],
    used_by: &["Theorem 5.11"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "overlap of the circles of x and y, where c_b f(x) = 1 and that of y covers a point of the circle of x",
                range: |_| (0.0, 2.0),
            },
            SLOPE,
        ],
        constraints: &[],
        quantity: meeting_distance,
    },
    measured: Some(Measured {
        claim: Claim::NnVertexUpper,
        sense: Sense::AtMost,
        quantity: Some(|worst, c_b, _| worst / c_b),
    }),
    points: |t, v| two_circles(t, &[(2.0 - v[0]) / (1.0 - t * v[1]), v[1]]),
    ..PLAIN
};

const LEMMA_5_8_LOWER: Statement = Statement {
    name: "lemma-5.8-lower",
    place: "Lemma 5.8, (3), left",
    quantity: "nn(y) / (c_b f(y)) at a point y that is no mesh vertex",
    printed: Bound {
        says: "1 / (2 + 2t)",
        at: |t| papers(t).nn_at_points()[0],
    },
    range: (0.0, 1.0),
    range_says: "any t",
    silent: VERTICES_APART,
    used_by: &["Theorem 5.11", "the examples t = 1/4 and t = 1/3"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "nn(y), the larger of |xy| and |yz|, where c_b f(x) = 1 and x is bitten before z: twice that is at least |xz| ≥ 1",
                range: |_| (0.5, 2.0),
            },
            Unknown {
                name: "|xy| / nn(y)",
                range: |_| (0.0, 1.0),
            },
            SLOPE,
        ],
        constraints: &[],
        quantity: |t, v| v[0] / (number(1.0) + t * v[2] * v[1] * v[0]).max(number(1e-9)),
    },
    corrected: Some(Corrected {
        bound: Bound {
            says: "1 / (2 + t)",
            at: |t| 1.0 / (2.0 + t),
        },
        range: (0.0, 1.0),
        why: "Let m be the second smallest distance from y to mesh vertices, x and z the two nearest, x bitten first. Then 2m ≥ |x − z| ≥ c_b f(x), and \
              f(y) ≤ f(x) + α m, not only (1 + t) f(x): c_b f(y) ≤ 2m + t m. So m ≥ c_b f(y) / (2 + t) = c_p f(y).",
        consequence: "The lemma holds; the corrected constant is larger, and attained half-way between x and z where z is on the circle of x. For t = 1/4 it \
              is f / (9 α) in place of f / (10 α), for t = 1/3 f / (7 α) in place of f / (8 α).",
    }),
    measured: Some(Measured {
        claim: Claim::NnPointLower,
        sense: Sense::AtLeast,
        quantity: Some(|worst, c_b, _| worst / c_b),
    }),
    points: |t, v| {
        let near = v[0] * v[1];
        vec![
            centre("x", 0.0, 0.0, 1.0),
            centre("y", near, 0.0, 1.0 + t * v[2] * near),
            place("z", near + v[0], 0.0),
        ]
    },
    ..PLAIN
};

const LEMMA_5_8_UPPER: Statement = Statement {
    name: "lemma-5.8-upper",
    place: "Lemma 5.8, (3), right",
    quantity: "nn(y) / (c_b f(y)) at a point y that is no mesh vertex",
    sense: Sense::AtMost,
    printed: Bound {
        says: "(3 − t) / (1 − t)²",
        at: |t| papers(t).nn_at_points()[1],
    },
    range: (0.0, 0.75),
    range_says: "t < 1",
    silent: &[
        "where the way from x through y leaves the domain before it leaves the circle of x, the boundary there is covered by a circle centred on it (t ≤ √2 − 1 at right angles)",
    ],
    used_by: &["Theorem 5.11", "the examples t = 1/4 and t = 1/3"],
    problem: Problem {
        unknowns: &[
            Unknown {
                name: "|x − y|, where c_b f(x) = 1 and the circle of x covers y",
                range: |_| (0.0, 1.0),
            },
            SLOPE,
            Unknown {
                name: "|y − z|, where the circle of z covers the point at which the way from x through y leaves the circle of x",
                range: |t| (0.0, 4.0 / (1.0 - t).powi(2)),
            },
        ],
        constraints: &[Constraint {
            says: "z reaches that point: |yz| ≤ (1 − |xy|) + c_b f(z), and f(z) ≤ f(y) + α |yz|",
            slack: |t, v| number(2.0) - v[0] + t * v[1] * v[0] - (number(1.0) - t) * v[2],
        }],
        // Where nn(y) is |xy| instead, it is at most 1 / (1 − t).
        quantity: |t, v| v[2] / (number(1.0) + t * v[1] * v[0]),
    },
    effort: Effort::within(1e-4),
    corrected: Some(Corrected {
        bound: Bound {
            says: "2 / (1 − t)",
            at: |t| 2.0 / (1.0 - t),
        },
        range: (0.0, 0.75),
        why: "The proof goes from y to x and on to a neighbour of x, which may be on the far side of x. Take instead the point w where the way \
              from x through y leaves the circle of x, at distance c_b f(x) − |x − y| from y, and the circle of some z ≠ x that covers w: \
              |y − z| ≤ c_b f(x) − |x − y| + c_b f(z), with c_b f(x) ≤ c_b f(y) + t |x − y| and c_b f(z) ≤ c_b f(y) + t |y − z|. Together \
              (1 − t) |y − z| ≤ 2 c_b f(y) − (1 − t) |x − y|. Where that way leaves the domain first, at e on a segment, the boundary circle that \
              covers e (or the next one along the segment) takes the part of z.",
        consequence: "The lemma holds; the corrected constant is that of Lemma 5.7, smaller by (3 − t) / (2 − 2t): by 1.5 at t = 0 and 2 at t = 1/3. For t = 1/4 it is \
              2f / (3α) in place of 11f / (9α), for t = 1/3 f / α in place of 2f / α.",
    }),
    measured: Some(Measured {
        claim: Claim::NnPointUpper,
        sense: Sense::AtMost,
        quantity: Some(|worst, c_b, _| worst / c_b),
    }),
    points: |t, v| {
        vec![
            centre("x", 0.0, 0.0, 1.0),
            centre("y", v[0], 0.0, 1.0 + t * v[1] * v[0]),
            place("w", 1.0, 0.0),
            place("z", v[0] + v[2], 0.0),
        ]
    },
    ..PLAIN
};

/// ∫ over the unit disc of dA / (1 + s r)², from rings.
fn disc_integral(slope: Number) -> Number {
    const RINGS: usize = 16;
    let mut sum = number(0.0);
    for ring in 0..RINGS {
        let [inner, outer] = [ring, ring + 1].map(|k| k as f64 / RINGS as f64);
        let area = number(PI) * number(outer * outer - inner * inner);
        sum = sum + area / (number(1.0) + slope * Number::fixed(Interval::new(inner, outer))).square();
    }
    sum
}

const THEOREM_5_11_LOWER: Statement = Statement {
    name: "theorem-5.11-lower",
    place: "Theorem 5.11 (the paper prints no constant; this one is from Theorem 5.5)",
    quantity: "∫ dA / f² over a biting circle: vertices ≥ ∫_Ω dA / f² over it, since biting circles cover the domain",
    sense: Sense::AtMost,
    printed: Bound {
        says: "π c_b² / (1 − t)², in units of c_b²",
        at: |t| PI / (1.0 - t).powi(2),
    },
    range: (0.0, 0.5),
    range_says: "t < 1",
    used_by: &["vertices ≥ (1 − t)² / (π c_b²) ∫ dA / f²"],
    problem: Problem {
        unknowns: &[Unknown {
            name: "slope of f away from the centre, as a share of t",
            range: |_| (-1.0, 1.0),
        }],
        constraints: &[],
        quantity: |t, v| disc_integral(t * v[0]),
    },
    effort: Effort {
        gap: 1e-3,
        most_boxes: 300,
    },
    measured: Some(Measured {
        claim: Claim::VerticesLower,
        sense: Sense::AtLeast,
        quantity: None,
    }),
    ..PLAIN
};

const THEOREM_5_11_UPPER: Statement = Statement {
    name: "theorem-5.11-upper",
    place: "Theorem 5.11 (the paper prints no constant; this one is from Lemma 5.4)",
    quantity: "∫ dA / f² over a packing circle, which are disjoint",
    sense: Sense::AtLeast,
    printed: Bound {
        says: "π / (4 (1 + t)²), in units of c_b²",
        at: |t| PI / (4.0 * (1.0 + t).powi(2)),
    },
    range: (0.0, 0.5),
    range_says: "any t",
    silent: VERTICES_APART,
    used_by: &["vertices, by share of packing circle, ≤ 4 (1 + t)² / (π c_b²) ∫ dA / f²"],
    problem: Problem {
        unknowns: &[Unknown {
            name: "slope of f away from the centre, as a share of t",
            range: |_| (-1.0, 1.0),
        }],
        constraints: &[],
        // Radius 1 / (2 + t) where c_b f = 1: the disc scaled to 1.
        quantity: |t, v| disc_integral(t * v[0] / (number(2.0) + t)) / (number(2.0) + t).square(),
    },
    effort: Effort {
        gap: 1e-3,
        most_boxes: 300,
    },
    measured: Some(Measured {
        claim: Claim::VerticesUpper,
        sense: Sense::AtMost,
        quantity: None,
    }),
    ..PLAIN
};
