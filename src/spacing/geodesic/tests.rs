use crate::geometry::predicates::{Meeting, segments_meet};
use crate::spacing::geodesic::slopes::Slopes;
use crate::spacing::geodesic::*;
use crate::spacing::testing::{gallery, points_by};
use crate::spacing::{Options, build, lfs_of, limit as limited};
use std::sync::Arc;

fn sees(domain: &Domain, x: DVec2, y: DVec2) -> bool {
    let crosses = |s: usize| {
        let [a, b] = domain.ends(s);
        domain.is_boundary(s) && segments_meet(x, y, a, b) == Meeting::Cross
    };
    domain.contains(x.midpoint(y)) && !(0..domain.segments().len()).any(crosses)
}

/// Lengths of shortest ways inside the domain between some points and its vertices, all pairs: by Floyd's algorithm on what sees
/// each other, as shortest ways turn at vertices only. The points come first.
fn ways(domain: &Domain, points: &[DVec2]) -> Vec<Vec<f64>> {
    let all: Vec<DVec2> = points.iter().chain(domain.vertices()).copied().collect();
    let length = |x: DVec2, y: DVec2| {
        if sees(domain, x, y) {
            x.distance(y)
        } else {
            f64::INFINITY
        }
    };
    let mut ways: Vec<Vec<f64>> = (all.iter())
        .map(|&x| all.iter().map(|&y| length(x, y)).collect())
        .collect();
    for over in 0..all.len() {
        for from in 0..all.len() {
            for to in 0..all.len() {
                ways[from][to] = ways[from][to].min(ways[from][over] + ways[over][to]);
            }
        }
    }
    ways
}

fn lfs_inside(domain: &Domain) -> GeodesicLfs {
    GeodesicLfs::new(domain, Arc::new(lfs_of(domain).unwrap())).unwrap()
}

fn geodesic(domain: &Domain) -> Arc<dyn Spacing> {
    Arc::new(lfs_inside(domain))
}

#[test]
fn it_is_lfs_where_nothing_is_near_across_the_outside_and_larger_elsewhere() {
    for name in ["two-arms", "comb", "gear", "plate-hole"] {
        let domain = gallery(name);
        let (lfs, inside) = (lfs_of(&domain).unwrap(), lfs_inside(&domain));
        let mut larger = 0;
        for x in points_by(&domain, 300, 5) {
            let [plane, inside] = [lfs.at(x), inside.at(x)];
            assert!(inside >= plane * (1.0 - 1e-12), "{name} {x}: {inside} {plane}");
            larger += usize::from(inside > plane * (1.0 + 1e-12));
        }
        // The gaps of the comb are as wide as its teeth, those of the gear wider.
        assert!((larger > 0) == (name == "two-arms"), "{name}: {larger}");
        assert!(inside.lower_bound(domain.bounds()) > 0.0 && inside.is_geodesic());
    }
}

#[test]
fn nothing_is_below_half_the_smallest_of_a_vertex() {
    for name in ["two-arms", "comb", "star", "gear"] {
        let domain = gallery(name);
        let lfs = lfs_inside(&domain);
        let smallest = lfs.lower_bound(domain.bounds());
        assert!(points_by(&domain, 500, 9).iter().all(|&x| lfs.at(x) >= smallest));
    }
}

#[test]
fn limited_it_is_below_lipschitz_along_ways_and_near_the_largest() {
    for (name, alpha) in [
        ("two-arms", 1.0 / 3.0),
        ("two-arms", 0.1),
        ("comb", 1.0 / 3.0),
        ("star", 1.0 / 3.0),
        ("l-shape", 0.2),
    ] {
        let domain = gallery(name);
        let function = geodesic(&domain);
        let limited = limit(function.as_ref(), &domain, alpha, 0.9).unwrap();
        assert_eq!(limited.lipschitz(), alpha);
        // Ways also go over points inside, where the function may be lowest.
        let middles = (0..domain.segments().len()).map(|s| domain.ends(s)[0].midpoint(domain.ends(s)[1]));
        let points: Vec<DVec2> = points_by(&domain, 120, 11).into_iter().chain(middles).collect();
        let ways = ways(&domain, &points);
        let all: Vec<DVec2> = points.iter().chain(domain.vertices()).copied().collect();
        let values: Vec<(f64, f64)> = all.iter().map(|&x| (function.at(x), limited.at(x))).collect();
        let (mut worst, mut triangles) = (f64::INFINITY, [0.0; 2]);
        for (k, &(own, low)) in values.iter().enumerate() {
            assert!(
                low > 0.0 && low <= own * (1.0 + 1e-12),
                "{name} {}: {low} {own}",
                all[k]
            );
            let mut largest = own;
            for (j, &(other, other_low)) in values.iter().enumerate() {
                let way = ways[k][j];
                assert!(
                    (low - other_low).abs() <= alpha * way + 1e-12,
                    "{name} {} {}",
                    all[k],
                    all[j]
                );
                largest = largest.min(other + alpha * way);
            }
            worst = worst.min(low / largest);
            triangles[0] += low.powi(-2);
            triangles[1] += largest.powi(-2);
        }
        let more = triangles[0] / triangles[1];
        assert!(worst >= 0.45 && more <= 1.4, "{name} {alpha}: {worst} {more}");
    }
}

#[test]
fn bounds_on_cells_are_bounds() {
    let domain = gallery("two-arms");
    let limited = limit(geodesic(&domain).as_ref(), &domain, 1.0 / 3.0, 0.9).unwrap();
    for x in points_by(&domain, 100, 2) {
        let cell = Rect {
            min: x - DVec2::splat(0.03),
            max: x + DVec2::splat(0.02),
        };
        let [low, high] = [limited.lower_bound(cell), limited.upper_bound(cell)];
        for y in points_by(&domain, 200, 4)
            .into_iter()
            .filter(|&y| cell.contains(y))
            .chain([x])
        {
            assert!(low <= limited.at(y) && limited.at(y) <= high);
        }
    }
}

#[test]
fn where_nothing_is_to_be_limited_it_is_exact() {
    let domain = gallery("two-arms");
    let function = limited(geodesic(&domain), &domain, 1.0, 0.9).unwrap();
    let x = DVec2::new(0.29, 1.3);
    assert!((function.at(x) - 0.29).abs() < 1e-15 && function.is_geodesic());
    let scaled = limited(geodesic(&domain), &domain, 0.95, 0.9).unwrap();
    assert!((scaled.at(x) - 0.95 * 0.29).abs() < 1e-15 && scaled.is_geodesic());
}

#[test]
fn with_others_it_is_the_smallest() {
    let domain = gallery("two-arms");
    let options = Options::with_alpha(1.0);
    let both = build("min(lfs:geodesic, uniform:0.1)", &domain, &options).unwrap();
    assert!(both.lfs_cap && both.function.is_geodesic());
    assert_eq!(both.function.at(DVec2::new(0.29, 1.3)), 0.1);
    // So small a uniform spacing is nowhere above it, and Lipschitz in the plane.
    let uniform = build("min(lfs:geodesic, uniform:0.001)", &domain, &options).unwrap();
    assert!(!uniform.function.is_geodesic());
    for refused in ["min(lfs:geodesic, lfs)", "min(min(lfs, uniform:1), lfs:geodesic)"] {
        let told = build(refused, &domain, &options).err().expect("refused").to_string();
        assert!(told.contains("leave one of them out"), "{told}");
    }
    let told = build("min(lfs:geodesic, expr:0.1 + sqrt(x))", &domain, &options)
        .err()
        .expect("refused");
    assert!(matches!(told, SpacingError::Geodesic { .. }), "{told}");
}

#[test]
fn steep_triangles_are_lowered_and_flat_ones_left() {
    let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(DVec2::from);
    let triangles = [[0, 1, 2], [1, 3, 2]];
    let limit = |values: [f64; 4], alpha: f64| {
        let mut slopes = Slopes {
            points: &points,
            triangles: &triangles,
            values: values.to_vec(),
        };
        slopes.limit(alpha, &values);
        assert!(slopes.steepest() <= alpha, "{} {alpha}", slopes.steepest());
        slopes.values
    };
    assert_eq!(limit([1.0, 1.2, 1.0, 1.2], 0.5), [1.0, 1.2, 1.0, 1.2]);
    // Along the edges from the lowest corner by 0.5 at most, and both together by 0.5 √½.
    let values = limit([1.0, 9.0, 1.0, 9.0], 0.5);
    assert!(
        values
            .iter()
            .zip([1.0, 1.5, 1.0, 1.5])
            .all(|(value, expected)| (value - expected).abs() < 1e-5)
    );
    let values = limit([1.0, 9.0, 9.0, 9.0], 0.5);
    assert!(values[0] == 1.0 && values[1].hypot(values[2]) > 1.0 && values.iter().all(|value| *value >= 1.0));
}
