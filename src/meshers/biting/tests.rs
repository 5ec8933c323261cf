//! What the certificate does not see: the rules of step 4, the orders, refusals.

use crate::Case;
use crate::domain::gallery;
use crate::meshers::biting::*;
use crate::meshers::{Budget, Reason, Waiting};
use crate::spacing::{ControlSpacing, Options, build};
use crate::theory::Claim;
use proptest::prelude::*;

mod by_later;

fn request(c_b: f64) -> Request {
    Request {
        c_b,
        seed: 0,
        threads: 1,
        budget: Budget {
            max_vertices: Some(50_000),
            ..Budget::default()
        },
    }
}

/// The paper to the letter.
fn with(order: Order) -> Biting {
    Biting {
        order,
        rule: Rule::Earlier,
        corners: Corners::Bite,
        head_on: HeadOn::Leave,
    }
}

fn square() -> Domain {
    gallery::domain("unit-square")
        .expect("a gallery name")
        .expect("a valid domain")
}

/// The spacing of a SPEC, not capped by lfs.
fn uncapped(domain: &Domain, spec: &str, alpha: f64) -> std::sync::Arc<dyn Spacing> {
    let options = Options {
        lfs_cap: false,
        ..Options::with_alpha(alpha)
    };
    build(spec, domain, &options).expect("a spacing").function
}

/// Positions of the centres on the lower side of the unit square, sorted.
fn on_lower_side(bitten: &Bitten) -> Vec<f64> {
    let mut xs: Vec<f64> = bitten.centres.iter().filter(|p| p.y == 0.0).map(|p| p.x).collect();
    xs.sort_by(f64::total_cmp);
    xs
}

fn bite_square(size: f64, order: Order) -> Bitten {
    let domain = square();
    let spacing = uncapped(&domain, &format!("uniform:{size}"), 1.0);
    with(order)
        .bite(&domain, &*spacing, &request(1.0), &mut Trace::default())
        .expect("a bitten square")
}

#[test]
fn circles_that_touch_get_a_middle_circle() {
    assert_eq!(on_lower_side(&bite_square(0.5, Order::Fifo)), [0.0, 0.5, 1.0]);
}

#[test]
fn circles_that_overlap_get_none() {
    assert_eq!(on_lower_side(&bite_square(0.51, Order::Fifo)), [0.0, 1.0]);
}

#[test]
fn a_gap_that_one_circle_closes_gets_the_middle_circle() {
    // Circles of 0.4 leave the gap from 0.4 to 0.6; either end's circle would reach the other circle.
    let xs = on_lower_side(&bite_square(0.4, Order::Fifo));
    assert_eq!(xs.len(), 3);
    assert!((xs[1] - 0.5).abs() < 1e-15, "{xs:?}");
}

#[test]
fn a_gap_is_bitten_at_its_ends_first() {
    // From 0.3 to 0.7: the circle at 0.3 ends at 0.6, a gap of 0.1 is left and gets its middle circle.
    let xs = on_lower_side(&bite_square(0.3, Order::Fifo));
    let expected = [0.0, 0.3, 0.65, 1.0];
    assert!(
        xs.iter().zip(expected).all(|(x, e)| (x - e).abs() < 1e-10) && xs.len() == 4,
        "{xs:?}"
    );
}

#[test]
fn the_far_end_is_bitten_where_its_circle_is_too_small_to_reach_back() {
    // f falls from left to right: the circle at q1 reaches the right vertex's circle, the one at q2 does not reach q1.
    let domain = square();
    let spacing = uncapped(&domain, "expr: 0.51 - 0.33*x", 0.33);
    let bitten = Biting::default()
        .bite(&domain, &*spacing, &request(1.0), &mut Trace::default())
        .expect("bitten");
    let xs = on_lower_side(&bitten);
    assert!(
        xs.iter().any(|x| (x - 0.82).abs() < 1e-9),
        "q2 = 1 - f(1) = 0.82 is bitten: {xs:?}"
    );
}

#[test]
fn every_order_keeps_the_first_layer() {
    let first = bite_square(0.05, Order::Fifo);
    let boundary = |bitten: &Bitten| bitten.pieces.clone();
    for order in Order::ALL {
        let bitten = bite_square(0.05, order);
        assert_eq!(
            boundary(&bitten),
            boundary(&first),
            "{order:?}: the boundary is bitten before the interior"
        );
        assert_eq!(bitten.centres[..4], first.centres[..4], "{order:?}");
    }
}

#[test]
fn the_seed_matters_to_random_only() {
    let domain = square();
    let spacing = uncapped(&domain, "uniform:0.05", 1.0);
    for order in Order::ALL {
        let bite = |seed| {
            let request = Request { seed, ..request(1.0) };
            with(order)
                .bite(&domain, &*spacing, &request, &mut Trace::default())
                .expect("bitten")
        };
        assert_eq!(bite(1) != bite(2), order == Order::Random, "{order:?}");
    }
}

#[test]
fn a_spacing_too_steep_is_declined() {
    let domain = square();
    let spacing = build("lfs", &domain, &Options::with_alpha(f64::INFINITY))
        .expect("lfs")
        .function;
    let declined = Biting::default().mesh(&domain, &*spacing, &request(1.0), &mut Trace::default());
    assert!(
        matches!(&declined, Err(MeshError::Declined(reason)) if reason.contains("below 1")),
        "{declined:?}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Packing and coverage hold on any domain, for any spacing and order.
    #[test]
    fn packing_and_coverage_hold_for_any_spacing_and_order(
        low in 0.02..0.3f64,
        slope in 0.0..0.8f64,
        order in prop::sample::select(Order::ALL.to_vec()),
        name in prop::sample::select(vec!["unit-square", "plate-hole", "interface", "random-simple"]),
    ) {
        let domain = gallery::domain(name).expect("a gallery name").expect("a valid domain");
        let spacing = uncapped(&domain, &format!("expr: {low} + {slope}*sqrt((x-0.3)^2 + (y-0.4)^2 + 0.001)"), 0.9);
        let case = Case::of(domain, ControlSpacing { spec: String::new(), lfs_cap: false, function: spacing }, 1.0);
        let mesher = Biting { corners: Corners::Bite, head_on: HeadOn::Leave, ..with(order) };
        let mesh = case.mesh(&mesher).expect("a mesh");
        let (_, certificate) = case.judge_of(&mesh, &mesher);
        prop_assert!(certificate.check(Claim::Coverage).expect("a check").applies);
        prop_assert!(certificate.holds, "{:?}", certificate.broken().collect::<Vec<_>>());
    }
}

/// The mesh with corners cut off, its certificate, and the counts of the run.
fn cut(domain: &Domain, c_b: f64) -> (Mesh, crate::quality::Certificate, Trace) {
    let case = Case::new(domain.clone(), "lfs", 0.25, c_b).expect("lfs");
    let mut trace = Trace::default();
    let mesh = case
        .mesh_as(&Biting::default(), &request(c_b), &mut trace)
        .expect("a mesh");
    let (_, certificate) = case.judge_of(&mesh, &Biting::default());
    (mesh, certificate, trace)
}

/// The smallest angle of the mesh in degrees, and the number of triangles at each input vertex.
fn angles_and_degrees(mesh: &Mesh) -> (f64, Vec<usize>) {
    let mut degrees = vec![0; mesh.input_vertices];
    let mut smallest = f64::INFINITY;
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        let angles = crate::quality::shape::angles_deg(mesh.corners(t));
        smallest = angles.into_iter().fold(smallest, f64::min);
        let inputs = triangle.iter().filter(|k| (**k as usize) < mesh.input_vertices);
        inputs.for_each(|&k| degrees[k as usize] += 1);
    }
    (smallest, degrees)
}

#[test]
fn a_corner_cut_off_is_one_triangle_and_its_cut_is_not_split() {
    let domain = gallery::domain("star")
        .expect("a gallery name")
        .expect("a valid domain");
    for c_b in [0.25, 0.75] {
        let (mesh, certificate, trace) = cut(&domain, c_b);
        assert!(certificate.holds);
        assert!(trace.counts.contains(&("corners_cut", 5.0)));
        let (smallest, degrees) = angles_and_degrees(&mesh);
        assert!(domain.acute_vertices().iter().all(|&v| degrees[v] == 1), "{degrees:?}");
        assert!(smallest > 25.0, "{smallest}");
    }
}

#[test]
fn without_corners_cutting_changes_nothing() {
    for name in ["unit-square", "l-shape", "plate-hole", "interface"] {
        let domain = gallery::domain(name).expect("a gallery name").expect("a valid domain");
        let spacing = build("lfs", &domain, &Options::new(0.25, 0.5)).expect("lfs").function;
        let mesh = |corners| {
            let mesher = Biting {
                corners,
                ..Biting::default()
            };
            mesher
                .mesh(&domain, &*spacing, &request(0.5), &mut Trace::default())
                .expect("a mesh")
        };
        assert_eq!(mesh(Corners::Bite), mesh(Corners::Cut), "{name}");
    }
}

#[test]
fn corners_of_random_polygons_are_cut_off_and_given_back() {
    for seed in 0..12 {
        let name = format!("random-simple:n=20,seed={seed}");
        let domain = gallery::domain(&name).expect("a gallery name").expect("a valid domain");
        let (mesh, certificate, trace) = cut(&domain, 0.25);
        let broken: Vec<_> = certificate.broken().collect();
        assert!(broken.is_empty(), "{name}: {broken:?}");
        let (_, degrees) = angles_and_degrees(&mesh);
        assert!(trace.counts.contains(&("angles_narrowed", 0.0)));
        assert!(
            domain.acute_vertices().iter().all(|&v| degrees[v] == 1),
            "{name}: {degrees:?}"
        );
    }
}

/// A gallery domain with a spacing, capped and limited.
fn case(name: &str, spec: &str, t: f64, c_b: f64) -> Case {
    let domain = gallery::domain(name).expect("a gallery name").expect("a valid domain");
    Case::new(domain, spec, t, c_b).expect("a spacing")
}

/// Certifies the mesh of the default parameters on a domain with corners, for a spacing, t and c_b.
fn keeps_its_bounds(name: &str, spec: &str, t: f64, c_b: f64) {
    let case = case(name, spec, t, c_b);
    let mesh = case.mesh(&Biting::default()).expect("a mesh");
    let (_, certificate) = case.judge_of(&mesh, &Biting::default());
    assert!(
        certificate
            .check(Claim::MinAngleBeyondCorners)
            .expect("a check")
            .applies
    );
    let broken: Vec<_> = certificate.broken().collect();
    assert!(broken.is_empty(), "{name}: {broken:?}");
}

#[test]
fn found_cases_keep_their_bounds() {
    // Two segments of a fan face each other beyond the end of a shorter one between them.
    keeps_its_bounds("random-pslg:kind=fan,seed=500", "expr:0.1", 0.25, 0.25);
    // A notch of 15° whose sides are 1e-6 long, where coordinates are 0.5.
    keeps_its_bounds("random-simple:n=67,seed=150", "lfs", 0.25, 0.25);
    // A centre across a notch sees the notch's vertex, but not the segment behind it.
    keeps_its_bounds("random-simple:n=77,seed=92", "lfs", 0.25, 0.75);
    // Fans between notches of one vertex.
    keeps_its_bounds("random-pslg:kind=fan,seed=4", "lfs", 0.25, 0.75);
    // Circles of a segment's ends that meet low, since c_b + t is above 1.
    keeps_its_bounds("l-shape", "lfs", 0.25, 1.0);
}

#[test]
fn every_bite_is_noted_with_what_it_did_to_the_front() {
    let domain = gallery::domain("plate-hole")
        .expect("a gallery name")
        .expect("a valid domain");
    let spacing = build("lfs", &domain, &Options::with_alpha(0.5)).expect("a spacing");
    for order in Order::ALL {
        let mut trace = Trace::noting_bites();
        let bitten = with(order)
            .bite(&domain, &*spacing.function, &request(0.5), &mut trace)
            .expect("a bitten plate");
        let bites = trace.bites.expect("bites were to be noted");
        assert_eq!(bites.iter().map(|bite| bite.centre).collect::<Vec<_>>(), bitten.centres);
        let mut waiting: std::collections::BTreeMap<u32, Waiting> = Default::default();
        for bite in &bites {
            match bite.reason {
                Reason::Middle { between: [q1, q2], .. } => {
                    assert!(bite.centre.distance(0.5 * (q1 + q2)) < 1e-15, "{bite:?}");
                }
                Reason::FrontVertex => {
                    let chosen = waiting[&bite.gone[0]];
                    assert_eq!(chosen.point, bite.centre);
                    let place = |vertex: &Waiting| (vertex.rank, vertex.serial);
                    if !matches!(order, Order::Lifo | Order::Random) {
                        assert!(
                            waiting.values().all(|other| place(&chosen) <= place(other)),
                            "{order:?}"
                        );
                    }
                }
                _ => assert!(bite.gone.is_empty()),
            }
            for serial in &bite.gone {
                let bitten_away = waiting.remove(serial).expect("it was there, and is gone once");
                assert!(bitten_away.point.distance(bite.centre) < bite.radius);
            }
            for vertex in &bite.appeared {
                for circle in vertex.circles.map(|circle| &bites[circle as usize]) {
                    assert!((vertex.point.distance(circle.centre) / circle.radius - 1.0).abs() < 1e-9);
                }
                assert!(waiting.insert(vertex.serial, *vertex).is_none());
            }
        }
        assert!(waiting.is_empty(), "{order:?}: {} are left", waiting.len());
    }
}
