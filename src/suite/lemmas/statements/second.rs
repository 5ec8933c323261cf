//! §6.3: triangles that the boundary cuts off from their circumcentre (Lemmas 6.5 to 6.7), and Theorem 6.8.

use super::boundary::{MIDDLE, corrected_10, meeting_height, middle, middle_points};
use super::*;
use crate::suite::lemmas::record::Corrected;

pub(super) const STATEMENTS: &[Statement] = &[
    LEMMA_6_5,
    LEMMA_6_6,
    LEMMA_6_7_STEP,
    LEMMA_6_7,
    THEOREM_6_8,
    THEOREM_6_8_STEP,
];

const OUTSIDE: &str = "no vertex of the triangle is inside the circles of p₁ and p₂: boundary vertices of another segment may be bitten before these; \
                       at right angles they stay outside for t ≤ √2 − 1, given f ≤ lfs and c_b ≤ 1";
const LABELLED: &str =
    "p₁ and p₂ are not both input vertices of one segment whose circles overlap (c_b + t ≤ 1 excludes it)";

const LEMMA_6_5: Statement = Statement {
    name: "lemma-6.5",
    place: "Lemma 6.5",
    quantity: "R · 2 h_r / (h_r² + L²) where the circumcircle, centred behind the segment, holds r",
    sense: Sense::AtMost,
    printed: Bound { says: "1", at: |_| 1.0 },
    parameter: "h_r / L",
    range: (0.1, 1.0),
    range_says: "h_r ≤ L, since a cap whose circle is centred behind its chord is no higher than half the chord",
    silent: &[OUTSIDE],
    used_by: &["Lemma 6.6"],
    problem: Problem {
        // L = 1
        unknowns: &[Unknown {
            name: "R / L",
            range: |_| (1.0, 12.0),
        }],
        constraints: &[Constraint {
            says: "the cap in front of the segment reaches r: R − √(R² − L²) ≥ h_r",
            slack: |h, v| v[0] - (v[0].square() - number(1.0)).root() - h,
        }],
        quantity: |h, v| v[0] * number(2.0) * h / (h.square() + number(1.0)),
    },
    ..PLAIN
};

/// (u² + h²) / (2h) over 2u for a share h of c = 2u.
fn radius_over_width(h: f64) -> f64 {
    (h * h + 0.25) / (2.0 * h)
}

/// R / c by Lemma 6.5 from h_r / c, with the chord as long as the piece.
fn circumradius(share: Number) -> Number {
    (share.square() + number(0.25)) / (number(2.0) * share)
}

const LEMMA_6_6: Statement = Statement {
    name: "lemma-6.6",
    place: "Lemma 6.6, (11)",
    quantity: "R / c of a triangle of the second subset behind a middle piece",
    sense: Sense::AtMost,
    printed: Bound {
        says: "5/8",
        at: |_| 0.625,
    },
    range: (0.0, 0.5),
    range_says: "t ≤ 1/2",
    silent: &[LABELLED, OUTSIDE],
    used_by: &["Lemma 6.7"],
    problem: Problem {
        unknowns: &MIDDLE,
        constraints: &[Constraint {
            says: "the circumcentre is behind the segment: h_r ≤ c / 2",
            slack: |t, v| {
                let (b, c) = middle(t, v);
                number(0.5) * c - meeting_height(b, c)
            },
        }],
        quantity: |t, v| {
            let (b, c) = middle(t, v);
            circumradius(meeting_height(b, c) / c)
        },
    },
    effort: Effort::within(1e-4),
    corrected: Some(Corrected {
        bound: Bound {
            says: "(G² + 1/4) / (2G), G the corrected (10)",
            at: |t| radius_over_width(corrected_10(t)),
        },
        range: (0.0, 0.5),
        why: "It rests on (10), which is wrong: with the corrected G(t), h_r ≥ c/4 holds for t ≤ 0.3984 only. Since h_r ≤ L ≤ c/2 (a cap whose circle \
              is centred behind its chord is no higher than half the chord), (h² + c²/4) / (2h) falls in h, and R / c is at most its \
              value at h = G c: 0.504 at t = 0, 0.583 at t = 1/3, 0.625 at t = 0.3984, 0.729 at t = 1/2. The triangle p₁ q r attains it where r is bitten.",
        consequence: "True as printed for t ≤ 0.3984, so for the t ≤ 1/3 of §6; false for larger t.",
    }),
    points: middle_points,
    ..PLAIN
};

const LEMMA_6_7: Statement = Statement {
    name: "lemma-6.7",
    place: "Lemma 6.7, (12)",
    quantity: "l / R of a triangle of the second subset behind a middle piece",
    sense: Sense::AtLeast,
    printed: Bound {
        says: "8 (2 − 3t − t²) / (5 (3 + t)), the inverse of (12)",
        at: |t| 8.0 * (2.0 - 3.0 * t - t * t) / (5.0 * (3.0 + t)),
    },
    range: (0.0, 0.55),
    range_says: "t < (√17 − 3)/2 = 0.5615, though Lemma 6.6, which it uses, is claimed for t ≤ 1/2",
    silent: &[LABELLED, OUTSIDE],
    used_by: &["Theorem 6.8"],
    problem: Problem {
        quantity: |t, v| {
            let (b, c) = middle(t, v);
            // The end e of the shortest edge that is bitten first is p₁, or q, or outside the circle of q and in the circle over
            // p₁q as diameter: |e − p₁|² ≤ c² − b².
            let inside = number(1.0) - t * (c.square() - b.square()).root();
            let shortest = inside.min(b).min(number(1.0));
            shortest / (c * circumradius(meeting_height(b, c) / c))
        },
        ..LEMMA_6_6.problem
    },
    effort: Effort::within(1e-3),
    points: middle_points,
    ..PLAIN
};

/// l ≥ a − t c of the proof, over R ≤ ρ c.
const LEMMA_6_7_STEP: Statement = Statement {
    name: "lemma-6.7-step",
    place: "Lemma 6.7, proof: (a − t c) / R",
    quantity: "(a − t c) / R behind a middle piece, a = c_b f(p₁), c = |p₁q|",
    range: (0.0, 0.5),
    range_says: "t ≤ 1/2, as for Lemma 6.6",
    used_by: &["Lemma 6.7"],
    problem: Problem {
        quantity: |t, v| {
            let (b, c) = middle(t, v);
            (number(1.0) - t * c) / (c * circumradius(meeting_height(b, c) / c))
        },
        ..LEMMA_6_6.problem
    },
    effort: Effort::within(1e-4),
    corrected: Some(Corrected {
        bound: Bound {
            says: "2 (1 − t(3 + t)/2) / ((3 + t) ρ), ρ the corrected (11)",
            at: |t| (2.0 - 3.0 * t - t * t) / ((3.0 + t) * radius_over_width(corrected_10(t))),
        },
        range: (0.0, 0.5),
        why: "The proof is sound but for Lemma 6.6, whose 5/8 must be replaced by ρ: l ≥ a − t c and c ≤ (3 + t) a / 2 with R ≤ ρ c.",
        consequence: "(12) does not follow from Lemma 6.6 for t > 0.3984, yet it is true up to t = 1/2: c is largest at d = (1 + t) a and R / c at \
                      d = (1 − t) a, never both.",
    }),
    ..LEMMA_6_7
};

const THEOREM_6_8: Statement = Statement {
    name: "theorem-6.8",
    place: "Theorem 6.8, (13), for the second subset; for the first it is Lemma 6.2",
    quantity: "sin θ = l / (2R) of a triangle of the second subset behind a middle piece",
    printed: Bound {
        says: "1/2 − t",
        at: |t| 0.5 - t,
    },
    range: (0.0, 0.5),
    range_says: "t ≤ 1/3 is assumed in §6, and t = 1/2 recommended for practice",
    silent: &[
        LABELLED,
        OUTSIDE,
        "every boundary piece is a Delaunay edge, or the triangulation is constrained and what is hidden is argued apart",
    ],
    used_by: &["the examples t = 1/4 (14.48°) and t = 1/3 (9.59°)"],
    problem: Problem {
        quantity: |t, v| number(0.5) * (LEMMA_6_7.problem.quantity)(t, v),
        ..LEMMA_6_7.problem
    },
    ..LEMMA_6_7
};

const THEOREM_6_8_STEP: Statement = Statement {
    name: "theorem-6.8-step",
    place: "Theorem 6.8, proof: the first subset decides",
    quantity: "4 (2 − 3t − t²) / (5 (3 + t)) − (1/2 − t)",
    printed: Bound { says: "0", at: |_| 0.0 },
    range: (0.0, 0.56),
    range_says: "t < (√17 − 3)/2",
    used_by: &["Theorem 6.8"],
    problem: Problem {
        unknowns: &[],
        constraints: &[],
        quantity: |t, _| {
            let both = number(2.0) - number(3.0) * t - t.square();
            number(4.0) * both / (number(5.0) * (number(3.0) + t)) - (number(0.5) - t)
        },
    },
    ..PLAIN
};
