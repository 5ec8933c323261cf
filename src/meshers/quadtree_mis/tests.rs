//! What the certificate does not check: the quadtree, that the set is independent and maximal, the orders, refusals.

use super::balance::{Leaf, Quadtree, balance};
use super::circles::{circles, row, samples};
use super::*;
use crate::Case;
use crate::domain::{Pslg, gallery};
use crate::geometry::DVec2;
use crate::geometry::tolerance::COVERED;
use crate::meshers::Budget;
use crate::meshers::Parameters;
use crate::quality::Certificate;
use crate::spacing::{ControlSpacing, Options, build};
use crate::theory::Claim;
use proptest::prelude::*;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::sync::Arc;

const REQUEST: Request = Request {
    c_b: 1.0,
    seed: 3,
    threads: 1,
    budget: Budget {
        max_vertices: Some(50_000),
        max_seconds: None,
        max_memory: None,
    },
};

/// A domain of the gallery.
fn domain(name: &str) -> Domain {
    gallery::domain(name).expect("a gallery name").expect("a valid domain")
}

/// The spacing of a SPEC, not capped by lfs.
fn uncapped(domain: &Domain, spec: &str, alpha: f64) -> Arc<dyn Spacing> {
    let options = Options {
        lfs_cap: false,
        ..Options::with_alpha(alpha)
    };
    build(spec, domain, &options).expect("a spacing").function
}

/// A spacing that is small near (0.3, 0.4) and grows outward.
fn growing(domain: &Domain, low: f64, slope: f64) -> Arc<dyn Spacing> {
    uncapped(
        domain,
        &format!("expr: {low} + {slope}*sqrt((x-0.3)^2 + (y-0.4)^2 + 0.001)"),
        0.95,
    )
}

fn pack(mesher: &QuadtreeMis, domain: &Domain, spacing: &dyn Spacing) -> Packing {
    mesher
        .pack(domain, spacing, &REQUEST, &mut Trace::default())
        .expect("a packing")
}

fn certify(mesher: &QuadtreeMis, domain: &Domain, spacing: &Arc<dyn Spacing>, lfs_cap: bool) -> Certificate {
    let spacing = ControlSpacing {
        spec: String::new(),
        lfs_cap,
        function: spacing.clone(),
    };
    let case = Case::of(domain.clone(), spacing, REQUEST.c_b);
    let mesh = case.mesh_as(mesher, &REQUEST, &mut Trace::default()).expect("a mesh");
    case.judge_of(&mesh, mesher).1
}

fn tree_of(mesher: &QuadtreeMis, domain: &Domain, spacing: &dyn Spacing) -> Quadtree {
    balance(&mesher.field(domain, spacing, &REQUEST).expect("in range")).expect("a quadtree")
}

/// Whether two leaves share more than a corner, and whether their sides differ by more than a factor of two.
fn side_by_side(one: &Leaf, other: &Leaf) -> (bool, bool) {
    let between = (one.centre - other.centre).abs() - (one.half + other.half);
    let slack = 1e-9 * one.half.min(other.half);
    let touch = between.max_element().abs() <= slack && between.min_element() < -slack;
    let ratio = one.half / other.half;
    (touch, !(0.4..2.5).contains(&ratio))
}

fn any_mesher() -> impl Strategy<Value = QuadtreeMis> {
    (
        prop::sample::select(vec![2u32, 3, 4, 8]),
        prop::sample::select(vec![Sampling::Regular, Sampling::Jittered]),
        prop::sample::select(Order::ALL.to_vec()),
        0.3..1.0f64,
        any::<bool>(),
    )
        .prop_map(|(oversample, sampling, order, leaf_side, complete)| QuadtreeMis {
            oversample,
            sampling,
            order,
            leaf_side,
            complete,
        })
}

fn any_domain() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "unit-square",
        "l-shape",
        "plate-hole",
        "star",
        "interface",
        "random-simple:n=20,seed=1",
        "random-simple:n=30,seed=2",
        "random-convex:n=9,seed=4",
    ])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn leaves_are_balanced_small_enough_and_fill_the_domain(
        name in any_domain(), low in 0.06..0.2f64, slope in 0.0..0.94f64, leaf_side in 0.3..1.0f64,
    ) {
        let domain = domain(name);
        let spacing = growing(&domain, low, slope);
        let tree = tree_of(&QuadtreeMis { leaf_side, ..QuadtreeMis::default() }, &domain, &*spacing);
        let leaves = &tree.leaves;
        for (k, one) in leaves.iter().enumerate() {
            for other in &leaves[..k] {
                prop_assert_ne!(side_by_side(one, other), (true, true), "{:?} beside {:?}", one, other);
            }
            let anchor = tree.anchor(one);
            let off = domain.index().nearest(anchor).map_or(1.0, |found| found.1);
            prop_assert!((domain.contains(anchor) || off <= 1e-12) && one.rect().distance(anchor) <= 1e-12);
            prop_assert_eq!(one.radius, spacing.at(anchor));
            for x in [anchor, one.rect().min, one.rect().max].into_iter().filter(|&x| domain.contains(x)) {
                prop_assert!(2.0 * one.half <= leaf_side * spacing.at(x) * (1.0 + 1e-9));
            }
        }
        // Boxes of leaves are disjoint and cover the domain, so a fine grid of points finds each in one.
        for k in 0..400 {
            let share = DVec2::new(f64::from(k % 20) + 0.53, f64::from(k / 20) + 0.47) / 20.0;
            let x = domain.bounds().min + share * domain.bounds().size();
            let holding = leaves.iter().filter(|leaf| leaf.rect().contains(x)).count();
            prop_assert!(holding == 1 || !domain.contains(x), "{x} in {holding} leaves");
        }
    }

    /// Checked by a quadratic loop: no centre lies in a circle chosen before it, and every candidate lies in some
    /// circle.
    #[test]
    fn the_set_is_independent_and_maximal(
        mesher in any_mesher(), name in any_domain(), low in 0.03..0.1f64, slope in 0.0..0.94f64,
    ) {
        let domain = domain(name);
        let spacing = growing(&domain, low, slope);
        let centres = pack(&mesher, &domain, &*spacing).centres;
        let radii: Vec<f64> = centres.iter().map(|&x| spacing.at(x)).collect();
        let vertices = domain.vertices().len();
        for i in vertices..centres.len() {
            for j in 0..i {
                let apart = centres[i].distance(centres[j]);
                // The order within a tile and between tiles is not that of the list.
                prop_assert!(apart >= radii[i].min(radii[j]) * (1.0 - 1e-9), "{i} {j} of {vertices}");
            }
        }
        if mesher.sampling == Sampling::Jittered {
            return Ok(());
        }
        let field = mesher.field(&domain, &*spacing, &REQUEST).expect("in range");
        let mut candidates: Vec<DVec2> = circles(&field).expect("candidates").iter().map(|c| c.disc.centre).collect();
        let mut random = Pcg64::seed_from_u64(0);
        for leaf in &tree_of(&mesher, &domain, &*spacing).leaves {
            for number in 0..mesher.oversample {
                let row = row(&mesher, 0, leaf, number);
                candidates.extend(samples(&mesher, &row, &mut random).filter(|&x| domain.contains(x)));
            }
        }
        for x in candidates {
            let is_covered = centres.iter().zip(&radii).any(|(c, r)| c.distance(x) <= r * (1.0 + COVERED));
            prop_assert!(is_covered, "nothing covers the candidate {x}");
        }
    }

    /// What is guaranteed holds for any parameters and any spacing.
    #[test]
    fn guarantees_hold_for_any_parameters(
        mesher in any_mesher(), name in any_domain(), low in 0.02..0.3f64, slope in 0.0..0.9f64,
    ) {
        let domain = domain(name);
        let certificate = certify(&mesher, &domain, &growing(&domain, low, slope), false);
        prop_assert!(certificate.holds, "{:?}", certificate.checks.iter().filter(|c| !c.holds).collect::<Vec<_>>());
    }
}

#[test]
fn complete_covers_the_small_gallery() {
    for name in [
        "unit-square",
        "l-shape",
        "plate-hole",
        "comb",
        "star",
        "interface",
        "random-convex",
        "random-simple",
    ] {
        let domain = domain(name);
        let spacing = build("lfs", &domain, &Options::with_alpha(0.4)).expect("lfs").function;
        for oversample in [2, 8] {
            let mesher = QuadtreeMis {
                oversample,
                complete: true,
                ..QuadtreeMis::default()
            };
            let certificate = certify(&mesher, &domain, &spacing, true);
            let coverage = certificate.check(Claim::Coverage).expect("a spacing is given");
            assert!(coverage.holds && coverage.applies, "{name}: {coverage:?}");
            assert!(certificate.holds, "{name}: {certificate:#?}");
        }
    }
}

#[test]
fn sampling_alone_leaves_gaps_that_fewer_samples_make_wider() {
    let domain = domain("unit-square");
    let spacing = uncapped(&domain, "uniform:0.0371", 1.0);
    let uncovered = |oversample| {
        let mesher = QuadtreeMis {
            oversample,
            ..QuadtreeMis::default()
        };
        certify(&mesher, &domain, &spacing, false)
            .check(Claim::Coverage)
            .map_or(0, |check| check.broken)
    };
    assert!(uncovered(2) > 4 * uncovered(16), "{} {}", uncovered(2), uncovered(16));
}

#[test]
fn threads_change_nothing() {
    let domain = domain("plate-hole");
    let spacing = growing(&domain, 0.004, 0.05);
    for order in Order::ALL {
        let mesher = QuadtreeMis {
            order,
            oversample: 4,
            complete: true,
            ..QuadtreeMis::default()
        };
        let with = |threads| {
            let (request, mut trace) = (Request { threads, ..REQUEST }, Trace::default());
            let packing = mesher
                .pack(&domain, &*spacing, &request, &mut trace)
                .expect("a packing");
            (packing, trace.counts)
        };
        let one = with(1);
        let rounds = one.1.iter().find(|count| count.0 == "rounds").expect("counted").1;
        assert!(rounds > 4.0, "several tiles, {rounds} rounds");
        assert_eq!(with(2), one, "{order:?}");
        assert_eq!(with(5), one, "{order:?}");
    }
}

#[test]
fn the_seed_matters_to_what_is_random_only() {
    let domain = domain("unit-square");
    let spacing = uncapped(&domain, "uniform:0.05", 1.0);
    for order in Order::ALL {
        for sampling in [Sampling::Regular, Sampling::Jittered] {
            let mesher = QuadtreeMis {
                order,
                sampling,
                ..QuadtreeMis::default()
            };
            let with = |seed| {
                let request = Request { seed, ..REQUEST };
                mesher
                    .pack(&domain, &*spacing, &request, &mut Trace::default())
                    .expect("a packing")
            };
            let is_random = order == Order::Random || sampling == Sampling::Jittered;
            assert_eq!(with(1) != with(2), is_random, "{order:?} {sampling:?}");
        }
    }
}

#[test]
fn a_segment_is_divided_evenly() {
    let domain = domain("unit-square");
    for (size, parts) in [(0.1, 10), (0.11, 9), (0.3, 3), (0.9, 1), (0.51, 1), (0.4999, 2)] {
        let spacing = uncapped(&domain, &format!("uniform:{size}"), 1.0);
        let packing = pack(&QuadtreeMis::default(), &domain, &*spacing);
        let mut xs: Vec<f64> = packing.centres.iter().filter(|p| p.y == 0.0).map(|p| p.x).collect();
        xs.sort_by(f64::total_cmp);
        let expected: Vec<f64> = (0..=parts).map(|k| f64::from(k) / f64::from(parts)).collect();
        assert_eq!(xs.len(), expected.len(), "{size}: {xs:?}");
        assert!(
            xs.iter().zip(expected).all(|(x, e)| (x - e).abs() < 1e-12),
            "{size}: {xs:?}"
        );
    }
}

#[test]
fn parameters_out_of_range_are_refused() {
    for (name, value) in [
        ("oversample", 1.into()),
        ("oversample", 65.into()),
        ("leaf_side", 0.0.into()),
        ("leaf_side", 1.5.into()),
    ] {
        let value: serde_json::Value = value;
        let refused = (ENTRY.make)(&Parameters::from_iter([(name.to_owned(), value)]))
            .err()
            .expect("refused");
        assert!(refused.contains(name), "{refused}");
    }
}

#[test]
fn a_spacing_too_steep_is_declined() {
    let domain = domain("unit-square");
    let spacing = uncapped(&domain, "expr: 0.1 + x", f64::INFINITY);
    let declined = QuadtreeMis::default().mesh(&domain, &*spacing, &REQUEST, &mut Trace::default());
    assert!(
        matches!(&declined, Err(MeshError::Declined(reason)) if reason.contains("below 1")),
        "{declined:?}"
    );
}

#[test]
fn a_budget_ends_the_quadtree_too() {
    let domain = domain("unit-square");
    let spacing = uncapped(&domain, "uniform:1e-5", 1.0);
    let stopped = QuadtreeMis::default().mesh(&domain, &*spacing, &REQUEST, &mut Trace::default());
    assert!(
        matches!(&stopped, Err(MeshError::Budget { budget, .. }) if budget.contains("50000")),
        "{stopped:?}"
    );
}

/// A domain far from the origin, where crossings of circles are rounded more than circles are shrunk.
#[test]
fn complete_covers_far_from_the_origin() {
    let mut pslg = Pslg::new("far");
    let corner = DVec2::new(3e5, -7e5);
    pslg.add_ring(
        [(0.0, 0.0), (1.0, 0.1), (1.1, 1.0), (0.1, 1.2)].map(|(x, y)| corner + DVec2::new(x, y)),
        1,
    );
    let domain = Domain::new(pslg).expect("a valid domain");
    let spacing = uncapped(&domain, "uniform:0.037", 1.0);
    let mesher = QuadtreeMis {
        complete: true,
        oversample: 2,
        ..QuadtreeMis::default()
    };
    let certificate = certify(&mesher, &domain, &spacing, false);
    assert!(
        certificate.check(Claim::Coverage).is_some_and(|check| check.holds),
        "{certificate:#?}"
    );
}
