//! Random domains against definitions so simple that they are unlikely to be wrong: loops over rings.

use crate::domain::{Domain, FaultKind, Place, Pslg, faults, gallery, repair};
use crate::domain::{Fill, InputSegment};
use crate::geometry::DVec2;
use crate::geometry::predicates::{Meeting, segments_meet};
use proptest::prelude::*;

type Ring = Vec<DVec2>;

fn edges(ring: &Ring) -> impl Iterator<Item = [DVec2; 2]> + '_ {
    (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]])
}

fn signed_area(ring: &Ring) -> f64 {
    edges(ring).map(|[a, b]| 0.5 * a.perp_dot(b)).sum()
}

/// Even-odd rule, rounded: only for points well off every edge.
fn is_odd(rings: &[Ring], x: DVec2) -> bool {
    let crossed =
        |[a, b]: [DVec2; 2]| (a.y <= x.y) != (b.y <= x.y) && a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x) > x.x;
    rings.iter().flat_map(edges).filter(|&ends| crossed(ends)).count() % 2 == 1
}

fn distance_to(rings: &[Ring], x: DVec2) -> f64 {
    let distance = |ends| crate::geometry::segments::closest_on_segment(ends, x).distance(x);
    rings.iter().flat_map(edges).map(distance).fold(f64::INFINITY, f64::min)
}

fn even_odd(rings: &[Ring]) -> Pslg {
    let mut pslg = Pslg::new("rings");
    for ring in rings {
        pslg.add_ring(ring.iter().copied(), 1);
    }
    pslg.fill = Fill::EvenOdd {
        flips: vec![true; pslg.segments.len()],
    };
    pslg
}

/// A random simple polygon, in it a hole around a point inside, in that an island, and so on: rings in rings.
fn nested(count: usize, seed: u64, depth: usize) -> Vec<Ring> {
    let outer = gallery::domain(&format!("random-simple:n={count},seed={seed}"))
        .unwrap()
        .unwrap();
    let mut rings = vec![outer.vertices().to_vec()];
    let centre = outer.face_points()[1].unwrap();
    let mut radius = 0.9 * outer.index().nearest(centre).unwrap().1;
    for level in 0..depth {
        let sides = 3 + (seed as usize + level) % 5;
        let angle = |k: usize| (seed % 7) as f64 + k as f64 * std::f64::consts::TAU / sides as f64;
        rings.push(
            (0..sides)
                .map(|k| centre + radius * DVec2::from_angle(angle(k)))
                .collect(),
        );
        radius *= 0.4;
    }
    rings
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn rings_in_rings_have_the_area_and_the_inside_of_loops(
        count in 3..40usize,
        seed in 0..1000u64,
        depth in 0..5usize,
        points in prop::collection::vec((-0.1..1.1f64, -0.1..1.1f64), 200),
    ) {
        let rings = nested(count, seed, depth);
        let domain = Domain::new(even_odd(&rings)).unwrap();
        let expected: f64 = rings.iter().zip([1.0, -1.0].iter().cycle()).map(|(r, sign)| sign * signed_area(r).abs()).sum();
        prop_assert!((domain.area() - expected).abs() < 1e-12);
        prop_assert_eq!(domain.faces().len(), rings.len() + 1);
        for (x, y) in points {
            let x = DVec2::new(x, y);
            if distance_to(&rings, x) > 1e-9 {
                prop_assert_eq!(domain.contains(x), is_odd(&rings, x), "{}", x);
            }
            // On the height of a vertex the ray runs through it.
            let level = DVec2::new(x.x, domain.vertices()[(seed as usize) % domain.vertices().len()].y);
            if distance_to(&rings, level) > 1e-9 {
                prop_assert_eq!(domain.contains(level), is_odd(&rings, level), "{}", level);
            }
        }
        for &v in domain.vertices() {
            prop_assert!(domain.contains(v));
            prop_assert!(matches!(domain.place(v), Place::Segment(_)));
        }
        for (face, point) in domain.face_points().iter().enumerate().skip(1) {
            prop_assert_eq!(domain.place(point.unwrap()), Place::Face(face));
        }
    }

    #[test]
    fn faces_do_not_change_when_the_domain_is_moved(count in 3..30usize, seed in 0..1000u64, turns in 0..4u32, power in -60..60i32) {
        // Quarter turns, mirroring and powers of two are exact, so everything must agree to the last bit.
        let rings = nested(count, seed, 2);
        let plain = Domain::new(even_odd(&rings)).unwrap();
        let scale = f64::from(power).exp2();
        let turn = |p: DVec2| (0..turns).fold(p * scale, |p, _| p.perp());
        let moved: Vec<Ring> = rings.iter().map(|ring| ring.iter().map(|&p| turn(p)).collect()).collect();
        let moved = Domain::new(even_odd(&moved)).unwrap();
        prop_assert_eq!(plain.faces().len(), moved.faces().len());
        prop_assert!((plain.area() * scale * scale - moved.area()).abs() <= 1e-12 * moved.area());
        prop_assert!((plain.smallest_input_angle_deg() - moved.smallest_input_angle_deg()).abs() < 1e-9);
        prop_assert_eq!(plain.acute_vertices(), moved.acute_vertices());
        for s in 0..plain.segments().len() {
            prop_assert_eq!(plain.is_boundary(s), moved.is_boundary(s));
        }
    }

    /// Euler's formula: vertices − segments + faces = 1 + components, whatever the segments are.
    #[test]
    fn repaired_tangles_are_valid_and_obey_euler(
        points in prop::collection::vec((0..40u32, 0..40u32), 3..25),
        ends in prop::collection::vec((0..25usize, 0..25usize), 3..40),
    ) {
        let mut pslg = Pslg::new("tangle");
        for (x, y) in &points {
            pslg.add_vertex(DVec2::new(f64::from(*x) / 7.0, f64::from(*y) / 3.0));
        }
        for (a, b) in ends {
            pslg.segments.push(InputSegment { a: a % points.len(), b: b % points.len(), marker: 1 });
        }
        let (mended, report) = repair(pslg.clone());
        let left: Vec<_> = faults(&mended).into_iter().filter(|fault| fault.kind != FaultKind::TooFew).collect();
        prop_assert!(left.is_empty(), "{:?}", left);
        // The grid step is at most twice 2^-32 of 14; snapping may add a few steps.
        prop_assert!(report.largest_displacement < 1e-7, "{}", report);
        prop_assert_eq!(repair(mended.clone()).1.is_empty(), true);
        if let Ok(domain) = Domain::new(mended) {
            let used = domain.vertices().len() - domain.isolated().len();
            let components = components(&domain);
            prop_assert_eq!(used + domain.faces().len(), domain.segments().len() + 1 + components);
        }
    }

    /// Random closed tours cross themselves, on a coarse lattice they also run along each other; mended, they have the
    /// inside of the even-odd rule.
    #[test]
    fn repaired_rings_keep_their_inside(
        rings in prop::collection::vec(prop::collection::vec((0..1000u32, 0..1000u32), 3..12), 1..4),
        lattice in prop::sample::select(vec![5u32, 1000]),
        points in prop::collection::vec((0.0..1.0f64, 0.0..1.0f64), 50),
    ) {
        let unit = |k: u32| f64::from(k % lattice) / f64::from(lattice);
        let ring = |ring: Vec<(u32, u32)>| -> Ring { ring.into_iter().map(|(x, y)| DVec2::new(unit(x), unit(y))).collect() };
        let rings: Vec<Ring> = rings.into_iter().map(ring).collect();
        let (mended, _) = repair(even_odd(&rings));
        // Rings that run back and forth on themselves may leave nothing.
        let left: Vec<_> = faults(&mended).into_iter().filter(|fault| fault.kind != FaultKind::TooFew).collect();
        prop_assert!(left.is_empty(), "{:?}", left);
        let Ok(domain) = Domain::new(mended) else {
            return Ok(());
        };
        for (x, y) in points {
            let x = DVec2::new(x, y);
            if distance_to(&rings, x) > 1e-7 {
                prop_assert_eq!(domain.contains(x), is_odd(&rings, x), "{}", x);
            }
        }
    }
}

/// Connected components of the segments, by spreading labels until nothing changes.
fn components(domain: &Domain) -> usize {
    let mut label: Vec<usize> = (0..domain.vertices().len()).collect();
    let mut changed = true;
    while changed {
        changed = false;
        for segment in domain.segments() {
            let least = label[segment.a].min(label[segment.b]);
            changed |= label[segment.a] != least || label[segment.b] != least;
            (label[segment.a], label[segment.b]) = (least, least);
        }
    }
    let mut roots: Vec<usize> = domain.segments().iter().map(|segment| label[segment.a]).collect();
    roots.sort_unstable();
    roots.dedup();
    roots.len()
}

#[test]
fn the_oracle_knows_a_square_in_a_square() {
    let square = |low: f64, high: f64| {
        vec![
            DVec2::splat(low),
            DVec2::new(high, low),
            DVec2::splat(high),
            DVec2::new(low, high),
        ]
    };
    let rings = [square(0.0, 4.0), square(1.0, 3.0)];
    assert!(
        is_odd(&rings, DVec2::splat(0.5)) && !is_odd(&rings, DVec2::splat(2.0)) && !is_odd(&rings, DVec2::splat(5.0))
    );
    assert_eq!(
        (signed_area(&rings[0]), distance_to(&rings, DVec2::splat(2.0))),
        (16.0, 1.0)
    );
}

#[test]
fn validation_finds_every_crossing_that_a_loop_finds() {
    let outline: Vec<DVec2> = (0..60)
        .map(|k| DVec2::from_angle(f64::from(k) * 2.3) * (1.0 + f64::from(k % 7)))
        .collect();
    let pslg = even_odd(std::slice::from_ref(&outline));
    let ends: Vec<[DVec2; 2]> = edges(&outline).collect();
    let pairs = (0..ends.len()).flat_map(|r| (r + 1..ends.len()).map(move |s| (r, s)));
    let crossings =
        pairs.filter(|&(r, s)| segments_meet(ends[r][0], ends[r][1], ends[s][0], ends[s][1]) == Meeting::Cross);
    let found: Vec<(usize, usize)> = faults(&pslg)
        .iter()
        .map(|fault| (fault.segments[0], fault.segments[1]))
        .collect();
    assert_eq!(found, crossings.collect::<Vec<_>>());
    assert!(!found.is_empty());
}
