use crate::spacing::lfs::features::{Feature, Features};
use crate::spacing::lfs::shortlist::*;
use crate::spacing::testing::pseudo_random_points;
use proptest::prelude::*;

fn rect(min: (f64, f64), max: (f64, f64)) -> Rect {
    Rect {
        min: min.into(),
        max: max.into(),
    }
}

fn vertices(points: impl IntoIterator<Item = DVec2>) -> Features {
    let vertex = |(at, index)| Feature::new([at; 2], [index; 2]);
    Features::new(points.into_iter().zip(0..).map(vertex).collect())
}

/// The leaves of a tree: cell, depth, list.
fn leaves(lists: &Shortlists) -> Vec<(Rect, usize, &[u32])> {
    let Tree { nodes, lists: entries } = &lists.tree;
    let mut pending = vec![(lists.root, 0, nodes[0])];
    let mut leaves = Vec::new();
    while let Some((cell, depth, node)) = pending.pop() {
        let first = node.first as usize;
        if node.count == INNER {
            let children = parts(cell, lists.scale.axes(depth))
                .into_iter()
                .zip(&nodes[first..first + 4]);
            pending.extend(children.map(|(part, child)| (part, depth + 1, *child)));
        } else {
            leaves.push((cell, depth, &entries[first..first + node.count as usize]));
        }
    }
    leaves
}

#[test]
fn parts_are_numbered_by_the_first_axis_and_then_by_the_second() {
    let cell = rect((0.0, 0.0), (1.0, 0.5));
    let quarters = [
        rect((0.0, 0.0), (0.5, 0.25)),
        rect((0.0, 0.25), (0.5, 0.5)),
        rect((0.5, 0.0), (1.0, 0.25)),
        rect((0.5, 0.25), (1.0, 0.5)),
    ];
    assert_eq!(parts(cell, [0, 1]), quarters);
    assert_eq!(
        parts(cell, [0, 0]),
        [0.0, 0.25, 0.5, 0.75].map(|x| rect((x, 0.0), (x + 0.25, 0.5)))
    );
}

#[test]
fn the_list_at_a_point_is_that_of_the_leaf_it_is_in_and_decides_as_all_features_do() {
    let points = pseudo_random_points(600);
    // Quarters alone, and strips at the top across one axis or the other.
    for size in [(1.0, 1.0), (1.0, 3.0), (90.0, 1.0)].map(DVec2::from) {
        let (features, all) = (
            vertices(points.iter().map(|x| *x * size)),
            (0..600).collect::<Vec<u32>>(),
        );
        let lists = Shortlists::new(
            &features,
            &all,
            Rect {
                min: DVec2::ZERO,
                max: size,
            },
        );
        let leaves = leaves(&lists);
        let entries: usize = leaves.iter().map(|(_, _, list)| list.len()).sum();
        assert_eq!(lists.size(), (1 + (leaves.len() - 1) / 3 * 4, entries));
        for (cell, _, list) in &leaves {
            assert_eq!(lists.at(cell.centre()), Some(*list));
            for x in [cell.min, cell.centre(), cell.max] {
                assert_eq!(features.decide(list, x).0, features.decide(&all, x).0, "{x}");
                // Of cells that meet in a point one is chosen, whose list does as well.
                let chosen = lists.at(x).expect("in the root");
                assert_eq!(features.decide(chosen, x).0, features.decide(&all, x).0, "{x}");
            }
        }
        for outside in [(-1e-9, 0.5), (0.5, size.y + 1e-6)] {
            assert_eq!(lists.at(outside.into()), None);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn what_may_not_lose_in_a_disc_does_not(
        ends in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0), 4),
        centre in (-1.0f64..1.0, -1.0f64..1.0),
        radius in 0.01f64..0.5,
    ) {
        let ends: Vec<DVec2> = ends.into_iter().map(DVec2::from).collect();
        let (one, other) = (Feature::new([ends[0], ends[1]], [0, 1]), Feature::new([ends[2], ends[3]], [2, 3]));
        let features = Features::new(vec![one, other]);
        let centre = DVec2::from(centre);
        let rival = Rival::new(features.view(0, centre), radius);
        let lead = |x: DVec2| features.view(1, x).distance - features.view(0, x).distance;
        if !rival.may_lose(&features.view(1, centre), 1.0) {
            for k in 0..32 {
                let x = centre + radius * DVec2::from_angle(0.2 * f64::from(k));
                prop_assert!(lead(x) > -1e-12, "{x} {}", lead(x));
            }
        }
    }
}

/// The bound is not idle: it tells apart what a bound by both slopes alone would not.
#[test]
fn of_two_items_on_one_side_the_farther_loses() {
    for slope in [1.0, 0.5] {
        let view = |x: f64| View::new(DVec2::new(x, 0.0), x.abs(), slope * x.abs());
        let rival = Rival::new(view(-5.0), 0.5);
        let may_lose = |to: f64| rival.may_lose(&view(to), slope);
        // Nearer than by the turns of both, not so, at the end of what slopes allow, and beyond that.
        assert_eq!([-5.05, -5.1, -6.0, -7.0].map(may_lose), [true, false, false, false]);
        assert_eq!([5.9, 6.1].map(may_lose), [true, false]);
    }
}

/// Nobody asks so often in a cell small against the function; lists that stay long are left so.
#[test]
fn no_cell_is_much_smaller_than_the_function_in_it() {
    // In the middle of a circle of points all of them matter.
    let circle = (0..64).map(|k| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 64.0));
    let features = vertices(circle);
    let all: Vec<u32> = (0..64).collect();
    let lists = Shortlists::new(&features, &all, rect((-1.0, -1.0), (1.5, 1.25)));
    let (mut short, mut fine) = (0, 0);
    for (cell, _, list) in leaves(&lists) {
        let share = 0.5 * cell.diagonal() / features.decide(&all, cell.centre()).0;
        // The cell that this one is a part of has twice the radius, and f changes by no more than the distance of centres.
        assert!(2.0 * share >= (1.0 - share) / 32.0, "{cell:?}");
        *(if list.len() <= 16 { &mut short } else { &mut fine }) += 1;
    }
    assert!(short > 10 && fine > 0, "{short} {fine}");
}

/// Too near to one another for cells of that depth to tell them apart, and well inside each.
#[test]
fn no_tree_is_deeper_than_coordinates_can_be_told_apart() {
    let place = |k: usize| DVec2::splat(1.0 / 3.0) + 4.0 * f64::EPSILON * DVec2::new((k % 8) as f64, (k / 8) as f64);
    let features = vertices((0..32).map(place));
    let all: Vec<u32> = (0..features.len() as u32).collect();
    let lists = Shortlists::new(&features, &all, rect((-1.0, -1.0), (1.0, 1.0)));
    assert_eq!(leaves(&lists).iter().map(|(_, depth, _)| *depth).max(), Some(DEPTH));
}
