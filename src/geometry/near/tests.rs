//! Queries against loops over all discs, circles against Pythagoras.

use super::*;
use proptest::prelude::*;

#[test]
fn circles_meet_where_pythagoras_says() {
    assert!((meeting_height(6.0, 5.0, 5.0) - 4.0).abs() < 1e-15);
    assert!((meeting_height(21.0, 13.0, 20.0) - 12.0).abs() < 1e-14);
    assert_eq!(meeting_height(3.0, 1.0, 1.0), 0.0);
}

/// Radius 0.01 + t·|x|: t-Lipschitz, graded over two powers of ten.
fn disc_at(centre: DVec2, t: f64) -> Disc {
    Disc {
        centre,
        radius: 0.01 + t * centre.x.abs(),
    }
}

/// A disc as one at the origin sees it.
fn seen(x: f64, y: f64, radius: f64) -> Near {
    let offset = DVec2::new(x, y);
    Near {
        id: 0,
        offset,
        distance_squared: offset.length_squared(),
        radius,
    }
}

#[test]
fn circles_cross_on_both_circles_right_point_first() {
    for (radius, other) in [
        (1.0, seen(1.0, 0.0, 1.0)),
        (2.0, seen(0.0, 3.0, 2.5)),
        (5.0, seen(-3.0, 1.0, 2.2)),
        (0.25, seen(0.2, -0.3, 0.5)),
    ] {
        let [right, left] = circle_intersections(radius, &other);
        for point in [right, left] {
            assert!((point.length() - radius).abs() < 1e-14);
            assert!((point.distance(other.offset) - other.radius).abs() < 1e-14);
        }
        assert!(other.offset.perp_dot(right) < 0.0 && other.offset.perp_dot(left) > 0.0);
    }
    assert_eq!(circle_intersections(1.0, &seen(3.0, 0.0, 2.0)), [DVec2::X; 2]);
    assert_eq!(circle_intersections(1.0, &seen(0.0, 4.0, 2.0)), [1.625 * DVec2::Y; 2]);
}

#[test]
fn a_level_is_the_binary_exponent() {
    for (radius, level) in [(1.0, 0), (1.99, 0), (2.0, 1), (0.75, -1), (1e-300, -997)] {
        assert_eq!(level_of(radius), level);
        assert_eq!(inverse_cell_size(level), 0.5f64.powi(level + 1));
    }
}

#[test]
fn cells_are_half_open_and_eight_by_eight_make_a_block() {
    for (coordinate, cell) in [
        (0.0, 0),
        (0.49, 0),
        (0.5, 1),
        (3.75, 7),
        (-0.25, -1),
        (-0.5, -1),
        (-0.75, -2),
    ] {
        assert_eq!(cell_of(coordinate, 2.0), cell);
    }
    assert_eq!(
        [(0, 0), (7, 0), (0, 1), (8, 9), (-1, -1)].map(|(c, r)| cell_in_block(c, r)),
        [0, 7, 8, 8, 63]
    );
}

#[test]
fn discs_are_open_and_counted() {
    let mut grid = DiscGrid::new(0.0);
    assert_eq!(grid.len(), 0);
    let discs = [0.0, 4.0].map(|x| Disc {
        centre: DVec2::new(x, 0.0),
        radius: 1.0,
    });
    assert_eq!(discs.map(|disc| grid.insert(disc)), [0, 1]);
    assert_eq!(grid.len(), 2);
    assert_eq!(
        (grid.disc(1), grid.discs().collect::<Vec<_>>()),
        (discs[1], discs.to_vec())
    );
    let mut near = Vec::new();
    let mut covering = |x: f64, tolerance: f64| {
        grid.covering(DVec2::new(x, 0.0), 1.0, tolerance, &mut near);
        near.iter().map(|disc| disc.id).collect::<Vec<_>>()
    };
    assert_eq!(covering(1.0, 0.0), [0u32; 0]);
    assert_eq!(covering(0.95, 0.0), [0]);
    assert_eq!(covering(0.95, 0.1), [0u32; 0]);
    assert_eq!(covering(0.85, 0.1), [0]);
    assert_eq!(covering(1.05, 0.1), [0u32; 0]);
    grid.meeting(DVec2::new(2.0, 0.0), 1.0, &mut near);
    assert!(near.is_empty());
    grid.around(DVec2::new(2.0, 0.0), 1.0, 1.25, &mut near);
    assert_eq!(near.len(), 2);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn queries_find_what_a_loop_finds(
        centres in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 1..200),
        query in (-1.0..1.0f64, -1.0..1.0f64),
        t in 0.0..0.9f64,
        share in 0.0..3.0f64,
        scale in prop::sample::select(vec![1.0, 1024.0, 1.0 / 1024.0]),
    ) {
        let disc_at = |centre: DVec2, t| {
            let disc = disc_at(centre, t);
            Disc { centre: scale * disc.centre, radius: scale * disc.radius }
        };
        let discs: Vec<Disc> = centres.iter().map(|&c| disc_at(c.into(), t)).collect();
        let mut grid = DiscGrid::new(t);
        discs.iter().for_each(|&disc| { grid.insert(disc); });
        let query = disc_at(query.into(), t);
        let loop_over = |keep: &dyn Fn(&Disc) -> bool| -> Vec<u32> {
            (0..discs.len() as u32).filter(|&id| keep(&discs[id as usize])).collect()
        };
        let mut near = Vec::new();
        let sorted = |near: &[Near]| { let mut ids: Vec<u32> = near.iter().map(|n| n.id).collect(); ids.sort_unstable(); ids };
        grid.meeting(query.centre, query.radius, &mut near);
        prop_assert_eq!(sorted(&near), loop_over(&|d| d.centre.distance(query.centre) < d.radius + query.radius));
        grid.covering(query.centre, query.radius, 0.0, &mut near);
        prop_assert_eq!(sorted(&near), loop_over(&|d| d.centre.distance(query.centre) < d.radius));
        grid.within(query.centre, query.radius, &mut near);
        prop_assert_eq!(sorted(&near), loop_over(&|d| d.centre.distance(query.centre) < query.radius));
        grid.sharing(query.centre, query.radius, &mut near);
        let reach = |r: f64| 2.0 * r / (1.0 - t);
        prop_assert_eq!(
            sorted(&near),
            loop_over(&|d| d.centre.distance(query.centre) < reach(d.radius.min(query.radius)))
        );
        let reach = query.radius * share.min(0.9 / t);
        grid.around(query.centre, query.radius, reach, &mut near);
        prop_assert_eq!(sorted(&near), loop_over(&|d| d.centre.distance(query.centre) < d.radius + reach));
    }
}
