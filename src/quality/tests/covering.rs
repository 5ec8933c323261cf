//! Coverage and packing of whole meshes.

use super::*;
use crate::quality::coverage::coverage_check;
use crate::quality::subject::Subject;
use crate::theory::Claim;

/// Coverage by definition: whether every sample of the domain is in a disc whose radius is changed by `change`.
fn samples_covered(domain: &Domain, mesh: &Mesh, radius: impl Fn(DVec2) -> f64, change: f64) -> bool {
    let samples =
        (0..=SAMPLES).flat_map(|i| (0..=SAMPLES).map(move |j| p(i as f64, j as f64) * (2.0 / SAMPLES as f64)));
    samples
        .filter(|x| domain.contains(*x))
        .all(|x| mesh.points.iter().any(|y| x.distance(*y) <= radius(*y) + change))
}

const SAMPLES: usize = 64;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// The check refutes what samples refute, and confirms what samples prove with room to spare.
    #[test]
    fn coverage_agrees_with_dense_sampling(
        inside in prop::collection::vec((0.0f64..2.0, 0.0f64..2.0), 0..60),
        parts in 1usize..6,
        base in 0.08f64..0.6,
        slope in (-0.1f64..0.2, -0.1f64..0.2),
    ) {
        let (domain, mesh) = l_with_hole(parts, &inside);
        let spacing = Linear { base: base.max(0.01), slope: p(slope.0, slope.1) };
        let radius = |x: DVec2| spacing.at(x).max(1e-3) * (1.0 + CERTIFICATE);
        prop_assume!(mesh.points.iter().all(|x| spacing.at(*x) >= 1e-3));
        let (_, certificate) = judge(&domain, &mesh, Some(&bounds(&spacing, 1.0)));
        let check = certificate.check(Claim::Coverage).unwrap();
        if !samples_covered(&domain, &mesh, radius, 0.0) {
            prop_assert!(!check.holds, "{check:?}");
        }
        // Every point of the domain has a sample of the domain within this distance.
        if samples_covered(&domain, &mesh, radius, -4.0 / SAMPLES as f64) {
            prop_assert!(check.holds, "{check:?}");
        }
    }

    /// Circles through no open triangle need not be examined: they have no gap.
    #[test]
    fn examining_circles_through_open_triangles_finds_all_that_examining_all_of_them_does(
        inside in prop::collection::vec((0.0f64..2.0, 0.0f64..2.0), 0..60),
        parts in 1usize..6,
        base in 0.1f64..0.5,
        slope in (-0.1f64..0.2, -0.1f64..0.2),
    ) {
        let (domain, mesh) = l_with_hole(parts, &inside);
        let spacing = Linear { base, slope: p(slope.0, slope.1) };
        prop_assume!(mesh.points.iter().all(|x| spacing.at(*x) >= 1e-3));
        let subject = Subject::new(&domain, &mesh, Some(&bounds(&spacing, 1.0)));
        let sizes = subject.sizes.as_ref().unwrap();
        prop_assert_eq!(coverage_check(&subject, sizes, true), coverage_check(&subject, sizes, false));
    }
}

#[test]
fn of_circles_that_all_overlap_no_more_than_a_few_hundred_each_are_counted() {
    let mut heap = fan(p(0.5, 0.5));
    heap.points.extend((0..1200).map(|k| p(0.4 + 1e-5 * f64::from(k), 0.6)));
    let (_, certificate) = judge(&domain(&SQUARE, &[]), &heap, Some(&bounds(&UNIFORM, 0.7)));
    let broken = certificate.check(Claim::PackingDisjoint).unwrap().broken;
    // All pairs are 700 000.
    assert!((10_000..256 * 1205).contains(&broken), "{broken}");
}

/// A hole in the mesh is a hole in the cover, although every triangle there is covered.
#[test]
fn where_triangles_are_missing_all_circles_are_examined() {
    let ring = [
        (0.0, 0.0),
        (0.5, 0.0),
        (1.0, 0.0),
        (1.0, 0.5),
        (1.0, 1.0),
        (0.5, 1.0),
        (0.0, 1.0),
        (0.0, 0.5),
    ];
    let ring = ring.map(DVec2::from);
    let corners = [[0, 1, 7], [1, 2, 3], [3, 4, 5], [5, 6, 7]];
    let (_, certificate) = judge(
        &domain(&ring, &[]),
        &mesh(&ring, &corners),
        Some(&bounds(&UNIFORM, 0.4)),
    );
    let check = certificate.check(Claim::Coverage).unwrap();
    assert!(!check.holds && check.broken == 4, "{check:?}");
    // The circle around (½, 0) is bare between the circles around its two neighbours, which are √½ away.
    let bare = std::f64::consts::FRAC_PI_2 - 2.0 * (0.5f64.sqrt() / 0.8).acos();
    assert!((check.worst.unwrap() - bare).abs() < 1e-8, "{check:?}");
}

#[test]
fn a_piece_that_no_chain_follows_is_examined_whole() {
    let (_, certificate) = judge(
        &domain(&SQUARE, &[]),
        &mesh(&SQUARE, &[]),
        Some(&bounds(&UNIFORM, 0.375)),
    );
    let check = certificate.check(Claim::Coverage).unwrap();
    // A quarter of each side is bare.
    let (stretch, middles) = (0.25, [[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]]);
    assert!(!check.holds && check.worst.unwrap() > stretch, "{check:?}");
    assert!(
        middles.iter().all(|middle| check.witnesses.contains(middle)),
        "{check:?}"
    );
}

#[test]
fn circles_and_pieces_that_are_bare_are_counted() {
    // Spokes, √½ long, are covered. A fifth of each side is not, nor is the circle in the middle. The bare arcs of the
    // other circles have their middles outside, and cross the boundary where it is bare.
    let (_, certificate) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.5)), Some(&bounds(&UNIFORM, 0.4)));
    assert_eq!(certificate.check(Claim::Coverage).unwrap().broken, 5);
}
