//! How far apart vertices are (Lemmas 5.7 and 5.8) and how many there are (§5.3).

use super::boundary::NO_SEGMENT;
use super::subject::{Sizes, Subject};
use super::tally::{Tally, Worst};
use super::{Check, parallel};
use crate::geometry::DVec2;
use crate::geometry::tolerance::{CENTRE_ULPS, CERTIFICATE};
use crate::spacing::Integral;
use crate::theory::Claim;
use std::f64::consts::TAU;

/// `nn-vertex-lower`, `nn-vertex-upper`, `nn-point-lower`, `nn-point-upper` and, with an integral, `vertices-lower` and
/// `vertices-upper`.
pub fn checks(subject: &Subject, sizes: &Sizes) -> Vec<Check> {
    let (promises, c_b) = (sizes.promises(), sizes.bounds.c_b);
    let between = |[low, high]: [f64; 2]| Between {
        low: c_b * low,
        high: c_b * high,
    };
    let (vertex, point) = (between(promises.nn_at_vertices()), between(promises.nn_at_points()));
    let points = &subject.mesh.points;
    let at_vertices = vertex.measure(points.len(), |k| {
        Some(Sample {
            nn: sizes.nn[k],
            f: sizes.at_vertex[k],
            at: points[k],
        })
    });
    let nn = |at: DVec2, f: f64| {
        Some(Sample {
            nn: sizes.second_nearest(at),
            f,
            at,
        })
    };
    let at_midpoints = point.measure(subject.adjacency.edges().len(), |e| {
        nn(subject.midpoint(e), sizes.at_midpoint[e])
    });
    let at_circumcentres = point.measure(sizes.circumcentres.len(), |triangle| {
        let (centre, f) = sizes.circumcentres[triangle]?;
        nn(centre, f)
    });
    let [low, high] = at_midpoints;
    let [low_too, high_too] = at_circumcentres;
    let mut checks = vertex
        .checks(at_vertices, [Claim::NnVertexLower, Claim::NnVertexUpper], sizes)
        .to_vec();
    let at_points = [low.join(low_too), high.join(high_too)];
    checks.extend(point.checks(at_points, [Claim::NnPointLower, Claim::NnPointUpper], sizes));
    if let Some(integral) = sizes.bounds.integral {
        checks.extend(vertex_counts(subject, sizes, integral));
    }
    checks
}

/// nn and f at a point.
struct Sample {
    nn: f64,
    f: f64,
    at: DVec2,
}

/// The claim that low ≤ nn / f ≤ high.
struct Between {
    low: f64,
    high: f64,
}

impl Between {
    /// The worst values on either side over `count` places; a place without a sample is left out.
    fn measure(&self, count: usize, sample: impl Fn(usize) -> Option<Sample> + Sync) -> [Tally; 2] {
        let parts = parallel::map_ranges(count, |range| {
            let (mut lower, mut upper) = (Tally::new(Worst::Smallest), Tally::new(Worst::Largest));
            for Sample { nn, f, at } in range.filter_map(&sample) {
                let ratio = nn / f;
                // nn is a distance of two centres, which f is compared with, so rounding counts as for packing circles.
                let rounding = CENTRE_ULPS * f64::EPSILON * at.abs().max_element() / f;
                lower.see(ratio, at, ratio < self.low * (1.0 - CERTIFICATE) - rounding);
                upper.see(ratio, at, ratio > self.high * (1.0 + CERTIFICATE) + rounding);
            }
            (lower, upper)
        });
        let (lower, upper): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
        [Tally::all(Worst::Smallest, lower), Tally::all(Worst::Largest, upper)]
    }

    fn checks(&self, [lower, upper]: [Tally; 2], claims: [Claim; 2], sizes: &Sizes) -> [Check; 2] {
        [
            sizes.check(lower, claims[0], self.low),
            sizes.check(upper, claims[1], self.high),
        ]
    }
}

/// Both bounds on the number of vertices, with allowance for the integral's error.
fn vertex_counts(subject: &Subject, sizes: &Sizes, integral: Integral) -> [Check; 2] {
    let Integral { value, error, .. } = integral;
    let integral = [value * (1.0 - error), value * (1.0 + error)];
    let [fewest, most] = sizes.promises().vertices(sizes.bounds.c_b, integral);
    let vertices = subject.mesh.points.len() as f64;
    let shares = packing_shares(subject, sizes);
    let check = |claim: Claim, worst: f64, bound: f64, holds: bool| Check {
        claim,
        lemma: claim.lemma().into(),
        applies: sizes.applies(claim),
        worst: Some(worst),
        bound: Some(bound),
        holds,
        broken: usize::from(!holds),
        at: None,
        witnesses: Vec::new(),
    };
    [
        check(Claim::VerticesLower, vertices, fewest, vertices >= fewest),
        check(Claim::VerticesUpper, shares, most, shares <= most),
    ]
}

/// The sum over vertices of the share of the packing circle that surely lies in the domain.
fn packing_shares(subject: &Subject, sizes: &Sizes) -> f64 {
    let domain = subject.domain;
    let c_p = sizes.packing_constant();
    let mut input = vec![NO_SEGMENT; subject.mesh.points.len()];
    for (v, found) in (0..).zip(&subject.boundary.vertex) {
        if let Some(k) = found {
            input[*k as usize] = v;
        }
    }
    parallel::sum(subject.mesh.points.len(), |k| {
        let v = input[k] as usize;
        let (mut met, mut all_incident) = (0, true);
        domain
            .index()
            .within(subject.mesh.points[k], c_p * sizes.at_vertex[k], |s, _| {
                if domain.is_boundary(s) {
                    let segment = domain.segments()[s];
                    met += 1;
                    all_incident &= segment.a == v || segment.b == v;
                }
            });
        match met {
            0 => 1.0,
            _ if input[k] != NO_SEGMENT && all_incident => domain
                .wedges(v)
                .iter()
                .filter(|wedge| wedge.inside)
                .map(|wedge| wedge.angle / TAU)
                .sum(),
            1 => 0.5,
            _ => 0.0,
        }
    })
}
