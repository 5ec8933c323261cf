//! Findings from reading the paper that no optimum shows: hypotheses used without being stated, steps that do not follow,
//! misprints.

use super::demonstration::{Demonstration, MeshRun, right_angle, shown, strip};
use crate::suite::rows::record::Report;
use crate::theory::Claim;

/// How grave a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A statement is false as it stands.
    False,
    /// Something is used that was neither assumed nor proved.
    Unstated,
    /// A slip of the pen.
    Misprint,
}

impl Kind {
    /// As a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::False => "false as stated",
            Self::Unstated => "used, not stated",
            Self::Misprint => "misprint",
        }
    }
}

/// One finding.
#[derive(Clone, Copy)]
pub struct Finding {
    /// Unique, in kebab case.
    pub name: &'static str,
    /// A line.
    pub title: &'static str,
    /// Where in the paper.
    pub place: &'static str,
    /// How grave.
    pub kind: Kind,
    /// What is wrong or missing, and why; with its proof or counterexample.
    pub why: &'static str,
    /// What becomes of the paper's statements.
    pub consequence: &'static str,
    /// What shows it.
    pub demonstration: Option<Demonstration>,
}

fn angles(report: &Report) -> Vec<super::demonstration::Shown> {
    vec![
        shown("smallest angle, degrees", report.statistics.min_angle_deg),
        shown("asin(1/2 − t), degrees", report.min_angle_bound_deg),
        shown(
            "segments whose two circles meet too low",
            report.certificate.low_head_on as f64,
        ),
    ]
}

fn forced(report: &Report) -> Vec<super::demonstration::Shown> {
    vec![
        shown(
            "boundary pieces that are no Delaunay edges",
            report.forced_pieces as f64,
        ),
        shown("c_b + t", report.c_b + report.t_effective),
        shown(
            "smallest input angle on any side, degrees",
            report.smallest_segment_angle_deg,
        ),
    ]
}

fn overlaps(report: &Report) -> Vec<super::demonstration::Shown> {
    let check = |claim| report.certificate.check(claim);
    vec![
        shown(
            "smallest |x − y| / (c_p (f(x) + f(y))), to be at least 1",
            check(Claim::PackingDisjoint)
                .and_then(|check| check.worst)
                .unwrap_or(f64::NAN),
        ),
        shown(
            "overlapping pairs of packing circles",
            check(Claim::PackingDisjoint).map_or(0.0, |check| check.broken as f64),
        ),
        shown("smallest angle, degrees", report.statistics.min_angle_deg),
        shown("asin(1/2 − t), degrees", report.min_angle_bound_deg),
    ]
}

/// All, in the order of the paper.
pub static FINDINGS: &[Finding] = &[
    Finding {
        name: "definition-2.2",
        title: "A mesh is well shaped by its largest radius-edge ratio, not by its smallest",
        place: "Definition 2.2",
        kind: Kind::Misprint,
        why: "\"The minimum radius-edge ratio over all of its elements is bounded from above\" holds for a mesh with a single good triangle. Meant is the maximum.",
        consequence: "None: everything later uses the maximum.",
        demonstration: None,
    },
    Finding {
        name: "boundary-lfs",
        title: "f ≤ lfs on the boundary does not give f ≤ lfs inside",
        place: "Lemma 2.1",
        kind: Kind::False,
        why: "In a strip of width 2 the local feature size is 2 on the long sides, far from the ends, but 1 on the middle line. The function 2 + dist(x, ∂Ω), held down to \
              lfs near the ends, is 1-Lipschitz and at most lfs on the whole boundary, yet 3 on the middle line. The entry of Lemma 2.1 has the general bound 2 + α.",
        consequence: "Every mesher here caps f by lfs in the whole domain, which is what §5 and §6 use.",
        demonstration: Some(Demonstration::Numbers(strip)),
    },
    Finding {
        name: "cap-needed",
        title: "Disjoint packing circles need f ≤ lfs and c_b ≤ 1",
        place: "Lemma 5.4, and everything that rests on it",
        kind: Kind::Unstated,
        why: "\"Either x is bitten before y, or y before x. It implies |x − y| ≥ c_b min(f(x), f(y))\": true for points chosen on the front, but input vertices are all bitten, \
              covered or not. Two of them are at least lfs apart (Lemma 5.1), so f ≤ lfs and c_b ≤ 1 are needed. Without the cap circles of one vertex hold others.",
        consequence: "Lemmas 5.4, 5.7, 5.8, Theorems 5.5, 5.11 and all of §6 hold with f ≤ lfs and c_b ≤ 1 as hypotheses. §5.1 says h ≤ lfs in passing, §5.2 c_b < 1.",
        demonstration: Some(Demonstration::Mesh(MeshRun {
            domain: "plate-hole",
            spacing: "uniform:0.2",
            t: 0.25,
            c_b: 0.75,
            lfs_cap: false,
            shows: overlaps,
        })),
    },
    Finding {
        name: "right-angle",
        title: "At a right angle circles stay on their own side of the corner's circle only for t ≤ √2 − 1",
        place: "§5.1 step 4, Lemma 5.4 for middle circles, §6.3 (\"it is a contradiction\")",
        kind: Kind::Unstated,
        why: "A vertex q at distance c_b f(v) from a corner v of 90° may have a radius of (1 + t) c_b f(v). Its circle then reaches √((1 + t)² − 1) c_b f(v) along the other side, \
              beyond the circle of v once 2t + t² > 1. So a boundary vertex of the other side may be bitten before and lie in a later circle, and a middle point \
              may be covered already. The proofs in §6.3 exclude both without saying so.",
        consequence: "True for t ≤ √2 − 1 = 0.4142, so for the t ≤ 1/3 of §6, and not for the t = 1/2 recommended for practice. The implementation tests every point of a \
              segment against all circles, and skips what is covered.",
        demonstration: Some(Demonstration::Numbers(right_angle)),
    },
    Finding {
        name: "touching-circles",
        title: "A gap of length zero needs a middle circle too",
        place: "§5.1 step 4, Lemmas 6.3 and 6.4",
        kind: Kind::Unstated,
        why: "Let the circles of two consecutive boundary vertices touch, in a point of their segment. Then the segment is covered, no circle is left to bite on it, and the \
              front has a vertex on the segment itself: h_r = 0, which neither lemma sees, since neither vertex is labelled by the other. \"Intersects\" must be \
              read as \"meets or touches\", and q₁ = q₂ be bitten as a middle point.",
        consequence: "With that reading nothing changes. The implementation bites it.",
        demonstration: None,
    },
    Finding {
        name: "head-on",
        title: "The angle bound fails where the circles of a segment's two input vertices cover it between them",
        place: "§6.3 (\"we only need to analyze the case that p₂ is labelled with M(p₁, p₃)\"), Theorem 6.8",
        kind: Kind::False,
        why: "Two input vertices of one segment have no labels. If their circles overlap, step 4 finds nothing to bite, and Lemmas 6.3 and 6.4 say nothing of the height at which \
              they meet, which may be as low as one likes: the front vertex there is bitten and makes a flat triangle with them. It takes c_b + t > 1: with m the \
              middle of a segment of length L, f(m) ≤ lfs(m) ≤ L/2, hence c_b f ≤ (c_b + t) L/2 at both ends.",
        consequence: "Theorem 6.8 holds with c_b + t ≤ 1 as a further hypothesis; or for all c_b ≤ 1 if such circles are made smaller and a third is put between them, which is \
              what biting does by default here (head_on=part).",
        demonstration: Some(Demonstration::Mesh(MeshRun {
            domain: "annulus",
            spacing: "lfs",
            t: 0.05,
            c_b: 1.0,
            lfs_cap: true,
            shows: angles,
        })),
    },
    Finding {
        name: "forced-pieces",
        title: "Boundary pieces need not be Delaunay edges",
        place: "§5.1 step 6; Lemma 6.1 (\"because the mesh is a Delaunay triangulation\")",
        kind: Kind::Unstated,
        why: "A middle piece is up to 3/2 radii long, and at t = 0 the circles of its ends meet √7/4 radii above it, where they are seen under acos(−1/8) = 97.2°. On an inner segment, \
              with vertices there on both sides, the two angles add up to more than 180°: the piece is no edge of the Delaunay triangulation of the \
              centres, and the segment is not in the mesh. On a boundary with the domain on one side only, c_b ≤ 2/(3 + t) keeps all else out of the piece's circle.",
        consequence: "The triangulation must be constrained. Lemma 6.1 then needs, and nobody has proved, that no vertex hidden behind a forced piece is inside the circumcircle of a triangle that sees \
              its circumcentre; the angle bound held in every committed mesh with forced pieces.",
        demonstration: Some(Demonstration::Mesh(MeshRun {
            domain: "interface",
            spacing: "lfs",
            t: 1.0 / 3.0,
            c_b: 0.5,
            lfs_cap: true,
            shows: forced,
        })),
    },
    Finding {
        name: "theorem-5.5-c_p",
        title: "The packing constant in the proof of Theorem 5.5",
        place: "Theorem 5.5, proof",
        kind: Kind::Misprint,
        why: "\"Noting c_p = 2c_b/(2 + α c_b)\" should be c_p = c_b/(2 + α c_b), which the next lines use; the factor 2 belongs to the spacing function 2 c_p f of the statement.",
        consequence: "None.",
        demonstration: None,
    },
    Finding {
        name: "lemma-6.1-order",
        title: "Which circle is bitten first",
        place: "Lemma 6.1, proof",
        kind: Kind::Misprint,
        why: "\"B(q, c_b f(p)) is bitten before B(q, c_b f(q))\" should be B(p, c_b f(p)).",
        consequence: "None.",
        demonstration: None,
    },
    Finding {
        name: "section-6.3-indices",
        title: "Whose circle p₁ is on",
        place: "§6.3, second paragraph",
        kind: Kind::Misprint,
        why: "If p₁ is on B(p₂, c_b f(p₂)) then |p₁ − p₂| = c_b f(p₂), not c_b f(p₁), and it is |p₂ − x| < |p₁ − p₂| that puts x in the circle of p₂.",
        consequence: "None: the argument is right with the indices exchanged.",
        demonstration: None,
    },
    Finding {
        name: "lemma-6.4-radical",
        title: "A factor under the root",
        place: "Lemma 6.4, proof, last display",
        kind: Kind::Misprint,
        why: "√((3 − t)(1 − t) a) should be √((3 − t)(1 − t)) a: h_r is a length.",
        consequence: "None.",
        demonstration: None,
    },
    Finding {
        name: "lemma-6.7-range",
        title: "Lemma 6.7 is claimed for larger t than what it uses",
        place: "Lemma 6.7",
        kind: Kind::Unstated,
        why: "It is stated for t < (√17 − 3)/2 = 0.5615, but uses Lemma 6.6, stated for t ≤ 1/2 and true for t ≤ 0.3984 only.",
        consequence: "The search proves (12) for t up to 0.55 all the same, by the sharper |e − p₁|² ≤ c² − b² in place of |e − p₁| ≤ c (entry of Lemma 6.7).",
        demonstration: None,
    },
];
