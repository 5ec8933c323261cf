//! Statistics of meshes small enough to work out.

use super::*;

fn assert_near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
        "{found}, expected {expected}"
    );
}

#[test]
fn statistics_of_four_different_triangles() {
    // Triangles around (½, ⅕): below, at each side and above. Half of one is ½ wide and ⅕ or ⅘ high.
    let (below, above) = (0.4f64.atan().to_degrees(), 1.6f64.atan().to_degrees());
    let beside = 90.0 - above;
    let spacing = Linear {
        base: 1.0,
        slope: p(0.0, 0.5),
    };
    let (found, _) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.2)), Some(&bounds(&spacing, 0.5)));
    assert_near(found.min_angle_deg, below);
    assert_near(found.min_angle_free_deg.unwrap(), below);
    assert_near(found.max_angle_deg, 180.0 - 2.0 * below);
    assert_near(found.mean_min_angle_deg, (below + 2.0 * beside + above) / 4.0);
    // 5 % of the way from the first of four to the last.
    assert_near(found.p05_min_angle_deg, below + 0.15 * (beside - below));
    let bins = [below, beside, beside, above].map(|angle| angle as usize);
    let count = |bin| bins.iter().filter(|known| **known == bin).count() as u64;
    assert_eq!(found.min_angle_histogram, (0..60).map(count).collect::<Vec<_>>());
    assert_eq!(
        [0, 21, 22, 32, 33, 60].map(|degrees| found.share_under(degrees)),
        [0.0, 0.0, 0.25, 0.25, 0.75, 1.0]
    );
    let (low, high) = (0.29f64.sqrt(), 0.89f64.sqrt());
    // The circumradius is a side over twice the sine of the angle opposite; in the lower triangle that angle is 180°
    // less twice `below`.
    assert_near(found.max_radius_edge, 0.5 / (2.0 * below).to_radians().sin() / low);
    // Lengths over c_b f at the middles: lower, upper, left and right side, then spokes from below and above.
    let mut ratios = [
        1.0,
        1.0 / 1.5,
        1.0 / 1.25,
        1.0 / 1.25,
        low / 1.05,
        low / 1.05,
        high / 1.3,
        high / 1.3,
    ]
    .map(|ratio| 2.0 * ratio);
    ratios.sort_by(f64::total_cmp);
    let edges = found.edge_over_size.unwrap();
    let between = |place: usize, share: f64| ratios[place] + share * (ratios[place + 1] - ratios[place]);
    assert_near(edges.p05, between(0, 0.35));
    assert_near(edges.p50, between(3, 0.5));
    assert_near(edges.p95, between(6, 0.65));
    // Each corner is nearest to the middle vertex, and that to the lower corners.
    let nn = found.nn_over_f.unwrap();
    assert_near(nn.min, low / 1.1);
    assert_near(nn.max, high / 1.5);
}

/// Triangles whose angles are 60° up to rounding are in the last bin.
#[test]
fn equilateral_triangles_are_in_the_last_bin() {
    let domain = domain(&SQUARE, &[]);
    for k in 0..360 {
        let turned = |degrees: f64| p(0.5, 0.5) + 0.3 * DVec2::from_angle((degrees + f64::from(k)).to_radians());
        let (found, _) = judge(&domain, &mesh(&[0.0, 120.0, 240.0].map(turned), &[[0, 1, 2]]), None);
        assert_eq!(found.share_under(59), 0.0);
        assert_eq!(
            (found.min_angle_histogram.len(), found.min_angle_histogram[59]),
            (60, 1)
        );
    }
}

#[test]
fn an_empty_mesh_has_no_angles_and_no_shares() {
    let (found, _) = judge(&domain(&SQUARE, &[]), &Mesh::default(), Some(&bounds(&UNIFORM, 0.5)));
    assert_eq!(
        (found.vertices, found.triangles, found.min_angle_free_deg),
        (0, 0, None)
    );
    let numbers = [
        found.min_angle_deg,
        found.max_angle_deg,
        found.mean_min_angle_deg,
        found.p05_min_angle_deg,
    ];
    assert_eq!(numbers, [0.0; 4]);
    assert_eq!(
        (found.share_under(60), found.edge_over_size, found.nn_over_f),
        (0.0, None, None)
    );
    assert_eq!((found.beta, found.seams), (None, None));
}

#[test]
fn angles_where_fronts_met_have_mean_share_and_percentile_of_their_own() {
    let (below, above) = (0.4f64.atan().to_degrees(), 1.6f64.atan().to_degrees());
    let met = Mesh {
        seams: vec![0, 1, 2],
        ..fan(p(0.5, 0.2))
    };
    let seams = judge(&domain(&SQUARE, &[]), &met, None).0.seams.unwrap();
    let smallest = [below, 90.0 - above, above];
    assert_eq!((seams.met.triangles, seams.elsewhere.triangles), (3, 1));
    assert_near(seams.met.min_deg, below);
    assert_near(seams.met.mean_deg, smallest.iter().sum::<f64>() / 3.0);
    assert_near(seams.met.p05_deg, below + 0.1 * (90.0 - above - below));
    assert_near(seams.met.share_under_30, 1.0 / 3.0);
    assert_near(seams.elsewhere.min_deg, 90.0 - above);
    assert_near(seams.elsewhere.share_under_30, 0.0);
    // None is left if all touch a corner under 60°.
    let sliver = [p(0.0, 0.0), p(4.0, 0.0), p(4.0, 1.0)];
    let met = Mesh {
        seams: vec![0],
        ..mesh(&sliver, &[[0, 1, 2]])
    };
    let seams = judge(&domain(&sliver, &[]), &met, None).0.seams.unwrap();
    let none = Angles {
        triangles: 0,
        min_deg: 0.0,
        mean_deg: 0.0,
        p05_deg: 0.0,
        share_under_30: 0.0,
    };
    assert_eq!((seams.met, seams.elsewhere), (none, none));
}

#[test]
fn angles_where_fronts_met_are_distinguished() {
    // Quarters of the square, the upper one cut into two of 45°, 22.5°, 112.5° and 45°, 67.5°, 67.5°.
    let points = [SQUARE.as_slice(), &[p(0.5, 0.5), p(0.5f64.sqrt(), 1.0)]].concat();
    let triangles = [[0, 1, 4], [1, 2, 4], [2, 5, 4], [5, 3, 4], [3, 0, 4]];
    let square = domain(&SQUARE, &[]);
    let met = Mesh {
        seams: vec![2, 3],
        ..mesh(&points, &triangles)
    };
    let (statistics, _) = judge(&square, &met, None);
    let seams = statistics.seams.unwrap();
    assert_eq!((seams.met.triangles, seams.elsewhere.triangles), (2, 3));
    assert!((seams.elsewhere.min_deg - 45.0).abs() < 1e-9 && (seams.elsewhere.mean_deg - 45.0).abs() < 1e-9);
    assert!(seams.met.min_deg < 30.0 && seams.met.share_under_30 == 0.5 && seams.elsewhere.share_under_30 == 0.0);
    assert_eq!(statistics.share_under(30), 0.2);
    assert_eq!(judge(&square, &Mesh { seams: vec![], ..met }, None).0.seams, None);
}

#[test]
fn statistics_of_a_mesh_known_by_hand() {
    let (statistics, _) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.5)), Some(&bounds(&UNIFORM, 0.5)));
    assert_eq!(
        (statistics.vertices, statistics.triangles, statistics.excused),
        (5, 4, 0)
    );
    let near = |x: f64, y: f64| assert!((x - y).abs() < 1e-12, "{x} {y}");
    near(statistics.min_angle_deg, 45.0);
    near(statistics.min_angle_free_deg.unwrap(), 45.0);
    near(statistics.max_angle_deg, 90.0);
    near(statistics.mean_min_angle_deg, 45.0);
    near(statistics.p05_min_angle_deg, 45.0);
    near(statistics.max_radius_edge, 0.5f64.sqrt());
    assert_eq!(statistics.min_angle_histogram.iter().sum::<u64>(), 4);
    let edges = statistics.edge_over_size.unwrap();
    near(edges.p05, 2f64.sqrt());
    near(edges.p50, 0.5 * (2.0 + 2f64.sqrt()));
    near(edges.p95, 2.0);
    let nn = statistics.nn_over_f.unwrap();
    near(nn.min, 0.5f64.sqrt());
    near(nn.max, 0.5f64.sqrt());
    let (bare, _) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.5)), None);
    assert_eq!((bare.edge_over_size, bare.nn_over_f), (None, None));
}
