use super::*;
use crate::domain::{InputSegment, Pslg, gallery};
use crate::spacing::testing::points_by;
use crate::spacing::{Spacing, lfs_of};
use proptest::prelude::*;

fn two_arms() -> Domain {
    gallery::domain("two-arms").unwrap().unwrap()
}

fn ring(name: &str, points: &[(f64, f64)]) -> Domain {
    let mut pslg = Pslg::new(name);
    pslg.add_ring(points.iter().map(|&(x, y)| DVec2::new(x, y)), 1);
    Domain::new(pslg).expect("a valid domain")
}

/// A box with slots cut into it from above, of any width and depth: arms that are close outside.
fn slotted(slots: &[(f64, f64)]) -> Domain {
    let mut points = vec![
        (0.0, 0.0),
        (slots.len() as f64 + 1.0, 0.0),
        (slots.len() as f64 + 1.0, 2.0),
    ];
    for (k, (width, depth)) in slots.iter().enumerate().rev() {
        let middle = k as f64 + 1.0;
        let [left, right] = [middle - 0.5 * width, middle + 0.5 * width];
        points.extend([(right, 2.0), (right, 2.0 - depth), (left, 2.0 - depth), (left, 2.0)]);
    }
    points.push((0.0, 2.0));
    ring("slotted", &points)
}

/// What B(x, r) reaches, by flooding a grid: the slow way. Gives for some radii whether two features that are not incident are
/// met within `step` of what is flooded.
fn flooded(domain: &Domain, x: DVec2, radius: f64, step: f64) -> bool {
    let crosses = |a: DVec2, b: DVec2| {
        (0..domain.segments().len()).any(|s| {
            let [c, d] = domain.ends(s);
            domain.is_boundary(s)
                && crate::geometry::predicates::segments_meet(a, b, c, d) == crate::geometry::predicates::Meeting::Cross
        })
    };
    let at = |cell: (i64, i64)| x + step * DVec2::new(cell.0 as f64, cell.1 as f64);
    let mut seen = FxHashSet::from_iter([(0, 0)]);
    let mut waiting = vec![(0i64, 0i64)];
    let mut met: Vec<[usize; 2]> = Vec::new();
    while let Some(cell) = waiting.pop() {
        for (v, vertex) in domain.vertices().iter().enumerate() {
            if at(cell).distance(*vertex) <= step && vertex.distance(x) <= radius && !crosses(at(cell), *vertex) {
                met.push([v, v]);
            }
        }
        for s in 0..domain.segments().len() {
            let nearest = closest_on_segment(domain.ends(s), at(cell));
            if at(cell).distance(nearest) <= step && !crosses(at(cell), nearest) {
                met.push([domain.segments()[s].a, domain.segments()[s].b]);
            }
        }
        for way in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            let next = (cell.0 + way.0, cell.1 + way.1);
            let (from, to) = (at(cell), at(next));
            let is_reached = to.distance(x) <= radius && domain.contains(to) && !crosses(from, to);
            if is_reached && seen.insert(next) {
                waiting.push(next);
            }
        }
    }
    let apart = |one: &[usize; 2], other: &[usize; 2]| !one.iter().any(|end| other.contains(end));
    met.iter().any(|one| met.iter().any(|other| apart(one, other)))
}

/// Whether the closed disc around `x` through `y` reaches `y`.
fn joins(reach: &Reach, x: DVec2, y: DVec2) -> bool {
    reach.radius_to(x, y) <= x.distance(y) * (1.0 + f64::EPSILON)
}

#[test]
fn two_arms_by_hand() {
    let domain = two_arms();
    let (reach, lfs) = (Reach::new(&domain).unwrap(), lfs_of(&domain).unwrap());
    // Beside the gap between the arms, which is 0.02 wide, and across an arm, which is 0.3 wide.
    let x = DVec2::new(0.29, 1.3);
    assert!((lfs.at(x) - 0.03).abs() < 1e-15);
    assert!((reach.smallest_apart(x) - 0.29).abs() < 1e-15);
    // In the middle of an arm both sides of it are nearest.
    let x = DVec2::new(0.15, 1.3);
    assert!((lfs.at(x) - 0.15).abs() < 1e-15 && (reach.smallest_apart(x) - 0.15).abs() < 1e-15);
    // At the bottom of the gap its two corners are seen at once.
    let x = DVec2::new(0.31, 0.29);
    assert_eq!(reach.smallest_apart(x), lfs.at(x));
    // Both arms from above the bottom's corner: the other arm is reached around the bottom of the gap.
    let x = DVec2::new(0.3, 0.305);
    assert!((reach.smallest_apart(x) - DVec2::new(0.02, 0.0).length()).abs() < 1e-3);
    let part = reach
        .part(DVec2::new(0.15, 1.3), 0.2)
        .expect("the other arm is met and not reached");
    assert!(reach.is_in(&part, DVec2::new(0.29, 1.3)) && !reach.is_in(&part, DVec2::new(0.33, 1.3)));
    assert!(reach.part(DVec2::new(0.15, 1.3), 0.16).is_none());
    assert!(joins(&reach, DVec2::new(0.1, 1.0), DVec2::new(0.2, 1.5)));
    assert!(!joins(&reach, DVec2::new(0.2, 1.3), DVec2::new(0.4, 1.3)));
    assert!(joins(&reach, DVec2::new(0.2, 0.32), DVec2::new(0.4, 0.32)));
}

#[test]
fn where_the_domain_touches_itself_discs_go_through_the_vertex() {
    // Two triangles that share the vertex (0, 0).
    let mut pslg = Pslg::new("bow tie");
    pslg.add_ring([(0.0, 0.0), (2.0, -1.0), (2.0, 1.0)].map(DVec2::from), 1);
    let [above, below] = [0.5, -0.5].map(|y| pslg.add_vertex(DVec2::new(-1.0, y)));
    let sides = [[0, above], [above, below], [below, 0]];
    pslg.segments
        .extend(sides.map(|[a, b]| InputSegment { a, b, marker: 1 }));
    let domain = Domain::new(pslg).expect("a valid domain");
    let (reach, lfs) = (Reach::new(&domain).unwrap(), lfs_of(&domain).unwrap());
    for x in points_by(&domain, 200, 3) {
        let (found, expected) = (reach.smallest_apart(x), lfs.at(x));
        assert!(found >= expected - 1e-15, "{x}: {found} {expected}");
        if x.x.abs() < 0.3 {
            assert!((found - expected).abs() < 1e-15, "{x}: {found} {expected}");
        }
    }
}

#[test]
fn inner_segments_are_crossed() {
    let domain = gallery::domain("unit-square").unwrap().unwrap();
    let reach = Reach::new(&domain).unwrap();
    let lfs = lfs_of(&domain).unwrap();
    for x in points_by(&domain, 100, 1) {
        assert!((reach.smallest_apart(x) - lfs.at(x)).abs() < 1e-15);
        assert!(reach.part(x, 0.4).is_none());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn what_is_reached_is_what_a_grid_floods(
        slots in prop::collection::vec((0.1f64..0.9, 0.3f64..1.7), 1..4),
        seed in 0u64..1000,
    ) {
        let domain = slotted(&slots);
        let (reach, lfs) = (Reach::new(&domain).unwrap(), lfs_of(&domain).unwrap());
        let step = 0.02;
        for x in points_by(&domain, 3, seed) {
            let found = reach.smallest_apart(x);
            prop_assert!(found >= lfs.at(x) - 1e-15);
            prop_assert!(flooded(&domain, x, found + 2.5 * step, step), "{x} {found}");
            prop_assert!(!flooded(&domain, x, found - 2.5 * step, step), "{x} {found}");
        }
    }

    #[test]
    fn no_triangulation_is_special(
        slots in prop::collection::vec((0.01f64..0.9, 0.3f64..1.7), 1..4),
        seed in 0u64..1000,
    ) {
        let domain = slotted(&slots);
        let reach = Reach::new(&domain).unwrap();
        let points = domain.vertices().iter().copied().chain(points_by(&domain, 60, seed + 1));
        let whole = (0..domain.segments().len()).map(|_| Vec::new());
        let finer = triangulate(&domain, points.collect(), Piece::chains(&domain, whole)).unwrap();
        let finer = Reach::of(&domain, finer);
        let asked = points_by(&domain, 40, seed);
        for (k, &x) in asked.iter().enumerate() {
            prop_assert!((reach.smallest_apart(x) - finer.smallest_apart(x)).abs() < 1e-14);
            let y = asked[(k + 1) % asked.len()];
            prop_assert_eq!(joins(&reach, x, y), joins(&finer, x, y));
            let radius = 0.1 * (1 + k % 20) as f64;
            let [one, other] = [reach.part(x, radius), finer.part(x, radius)];
            prop_assert_eq!(one.is_some(), other.is_some());
            for z in asked.iter().filter(|z| z.distance(x) < radius) {
                let held = |reach: &Reach, part: &Option<Part>| part.as_ref().is_none_or(|part| reach.is_in(part, *z));
                prop_assert_eq!(held(&reach, &one), held(&finer, &other));
                let needed = reach.radius_to(x, *z);
                prop_assert!((needed - finer.radius_to(x, *z)).abs() < 1e-14);
                prop_assert!(needed >= x.distance(*z) && held(&reach, &one) == (needed <= radius));
            }
        }
    }

    #[test]
    fn along_a_way_inside_it_changes_no_faster_than_the_way_is_long(
        slots in prop::collection::vec((0.01f64..0.9, 0.3f64..1.7), 1..4),
        seed in 0u64..1000,
    ) {
        let domain = slotted(&slots);
        let reach = Reach::new(&domain).unwrap();
        for pair in points_by(&domain, 80, seed).windows(2) {
            // Segments inside the domain only: other ways are made of them.
            let is_inside = (0..=200).all(|k| domain.contains(pair[0].lerp(pair[1], f64::from(k) / 200.0)));
            if is_inside {
                let change = reach.smallest_apart(pair[0]) - reach.smallest_apart(pair[1]);
                prop_assert!(change.abs() <= pair[0].distance(pair[1]) + 1e-14);
            }
        }
    }
}
