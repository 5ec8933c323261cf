use super::*;
use crate::delaunay::triangulate;
use crate::domain::Pslg;
use crate::geometry::DVec2;
use crate::geometry::tolerance::CERTIFICATE;
use crate::mesh::Piece;
use crate::theory::Claim;
use proptest::prelude::*;

mod bounds_by_hand;
mod by_later;
mod covering;
mod hypotheses;
mod matching;
mod numbers;
mod rounding;
mod structure;

fn p(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

/// f(x) = base + slope · x.
struct Linear {
    base: f64,
    slope: DVec2,
}

impl Spacing for Linear {
    fn at(&self, x: DVec2) -> f64 {
        self.base + self.slope.dot(x)
    }

    fn lipschitz(&self) -> f64 {
        self.slope.length()
    }
}

const UNIFORM: Linear = Linear {
    base: 1.0,
    slope: DVec2::ZERO,
};

const CLAIMS: [Claim; 12] = [
    Claim::PackingDisjoint,
    Claim::Coverage,
    Claim::BoundaryHeight,
    Claim::MinAngle,
    Claim::MinAngleBeyondCorners,
    Claim::CornerAngles,
    Claim::NnVertexLower,
    Claim::NnVertexUpper,
    Claim::NnPointLower,
    Claim::NnPointUpper,
    Claim::VerticesLower,
    Claim::VerticesUpper,
];

/// The paper's claims, and the one structural claim that not all methods make.
const GUARANTEED: [Claim; 13] = {
    let mut all = [Claim::ConstrainedDelaunay; 13];
    all.split_at_mut(1).1.copy_from_slice(&CLAIMS);
    all
};

/// Bounds with this c_b, and every claim guaranteed.
pub(super) fn bounds(spacing: &dyn Spacing, c_b: f64) -> Bounds<'_> {
    Bounds {
        spacing,
        c_b,
        rule: Rule::Earlier,
        lfs_cap: true,
        integral: Some(Integral {
            value: 1.0,
            error: 0.0,
            evaluations: 0,
        }),
        guaranteed: &GUARANTEED,
    }
}

const SQUARE: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];

fn domain(ring: &[DVec2], inner: &[DVec2]) -> Domain {
    let mut pslg = Pslg::new("test");
    pslg.add_ring(ring.iter().copied(), 1);
    // The ends of an inner segment are vertices of the ring.
    let find = |x: &DVec2| ring.iter().position(|y| y == x).unwrap();
    for ends in inner.chunks(2) {
        let (a, b) = (find(&ends[0]), find(&ends[1]));
        pslg.segments.push(crate::domain::InputSegment { a, b, marker: 0 });
    }
    Domain::new(pslg).unwrap()
}

fn mesh(points: &[DVec2], triangles: &[[u32; 3]]) -> Mesh {
    Mesh {
        point_markers: vec![0; points.len()],
        points: points.to_vec(),
        regions: vec![0.0; triangles.len()],
        triangles: triangles.to_vec(),
        ..Mesh::default()
    }
}

/// The unit square in four triangles around `middle`.
fn fan(middle: DVec2) -> Mesh {
    mesh(
        &[&SQUARE[..], &[middle]].concat(),
        &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    )
}

/// The claims that do not hold.
fn broken(domain: &Domain, mesh: &Mesh, bounds: Option<&Bounds>) -> Vec<Claim> {
    let (_, certificate) = judge(domain, mesh, bounds);
    let broken: Vec<_> = certificate.checks.iter().filter(|check| !check.holds).collect();
    assert!(broken.iter().all(|check| check.broken > 0), "{broken:?}");
    assert_eq!(certificate.holds, broken.iter().all(|check| !check.applies));
    broken.iter().map(|check| check.claim).collect()
}

#[test]
fn a_good_mesh_has_a_whole_certificate() {
    let (_, certificate) = judge(&domain(&SQUARE, &[]), &fan(p(0.5, 0.5)), Some(&bounds(&UNIFORM, 0.7)));
    assert!(certificate.holds, "{certificate:#?}");
    assert_eq!(certificate.checks.len(), 8 + CLAIMS.len());
    assert!(
        certificate
            .checks
            .iter()
            .all(|check| check.holds && check.applies && check.worst.is_some() == (check.claim != Claim::CornerAngles))
    );
    let worst = |claim: Claim| certificate.check(claim).unwrap().worst.unwrap();
    let near = |x: f64, y: f64| (x - y).abs() < 1e-12;
    assert!(near(worst(Claim::PackingDisjoint), 0.5f64.sqrt() / 0.7));
    assert_eq!(worst(Claim::Coverage), 0.0);
    assert!(near(worst(Claim::MinAngle), 45.0));
    assert!(near(worst(Claim::NnVertexLower), 0.5f64.sqrt()) && near(worst(Claim::NnVertexUpper), 0.5f64.sqrt()));
    assert!(near(worst(Claim::NnPointLower), 0.5f64.sqrt() / 2.0) && near(worst(Claim::NnPointUpper), 0.5));
    // Four corners with a quarter of their packing circles inside, and the middle.
    assert!(near(worst(Claim::VerticesUpper), 2.0) && near(worst(Claim::VerticesLower), 5.0));
}

#[test]
fn each_bound_breaks_where_it_should() {
    let (square, good) = (domain(&SQUARE, &[]), fan(p(0.5, 0.5)));
    for (c_b, expected) in [
        (0.45, vec![Claim::Coverage]),
        (0.3, vec![Claim::Coverage, Claim::NnVertexUpper]),
        (0.25, vec![Claim::Coverage, Claim::NnVertexUpper, Claim::VerticesLower]),
        (
            0.11,
            vec![
                Claim::Coverage,
                Claim::NnVertexUpper,
                Claim::NnPointUpper,
                Claim::VerticesLower,
            ],
        ),
        (
            0.75,
            vec![Claim::PackingDisjoint, Claim::NnVertexLower, Claim::NnPointLower],
        ),
        (
            1.4,
            vec![
                Claim::PackingDisjoint,
                Claim::NnVertexLower,
                Claim::NnPointLower,
                Claim::VerticesUpper,
            ],
        ),
    ] {
        assert_eq!(
            broken(&square, &good, Some(&bounds(&UNIFORM, c_b))),
            expected,
            "c_b = {c_b}"
        );
    }
    let flat = broken(&square, &fan(p(0.5, 0.2)), Some(&bounds(&UNIFORM, 0.6)));
    assert!(flat.contains(&Claim::MinAngle), "{flat:?}");
}

#[test]
fn a_hole_in_the_cover_is_seen_from_circles_alone() {
    let ring = [
        p(0.0, 0.0),
        p(0.5, 0.0),
        p(1.0, 0.0),
        p(1.0, 0.5),
        p(1.0, 1.0),
        p(0.5, 1.0),
        p(0.0, 1.0),
        p(0.0, 0.5),
    ];
    let hollow = mesh(
        &ring,
        &[[0, 1, 7], [1, 2, 3], [3, 4, 5], [5, 6, 7], [1, 3, 7], [3, 5, 7]],
    );
    let domain = domain(&ring, &[]);
    let check = |c_b: f64| {
        let (_, certificate) = judge(&domain, &hollow, Some(&bounds(&UNIFORM, c_b)));
        certificate.check(Claim::Coverage).unwrap().clone()
    };
    let open = check(0.3);
    assert!(!open.holds && open.worst.unwrap() > 0.5 && open.at.is_some());
    assert!(check(0.5).holds && !check(0.499).holds);
}

#[test]
fn each_structural_check_breaks_where_it_should() {
    let (square, good) = (domain(&SQUARE, &[]), fan(p(0.5, 0.5)));
    let wrong = |change: &dyn Fn(&mut Mesh)| {
        let mut mesh = good.clone();
        change(&mut mesh);
        broken(&square, &mesh, None)
    };
    assert_eq!(broken(&square, &good, None), []);
    let flipped = wrong(&|mesh| mesh.triangles[0] = [1, 0, 4]);
    assert_eq!(flipped, [Claim::PositiveOrientation, Claim::Area, Claim::ManifoldEdges]);
    let missing = wrong(&|mesh| mesh.triangles.truncate(3));
    assert_eq!(missing, [Claim::Area, Claim::InputSegments, Claim::BoundaryOnSegments]);
    assert_eq!(wrong(&|mesh| mesh.points.push(p(0.3, 0.3))), [Claim::VerticesUsed]);
    let moved = wrong(&|mesh| mesh.points[2] = p(1.0, 1.0 + 1e-12));
    assert_eq!(
        moved,
        [Claim::InputVertices, Claim::InputSegments, Claim::BoundaryOnSegments]
    );
    let twice = wrong(&|mesh| mesh.triangles.push([0, 1, 4]));
    assert_eq!(twice, [Claim::Area, Claim::ManifoldEdges]);
    let flat = wrong(&|mesh| mesh.points[4] = p(0.5, 0.0));
    assert!(flat.contains(&Claim::PositiveOrientation), "{flat:?}");
}

#[test]
fn segments_and_delaunay_edges_are_distinguished() {
    let kite = [p(0.0, 0.0), p(2.0, -1.0), p(4.0, 0.0), p(2.0, 1.0)];
    let long = mesh(&kite, &[[0, 1, 2], [0, 2, 3]]);
    let short = mesh(&kite, &[[0, 1, 3], [1, 2, 3]]);
    let (free, across) = (domain(&kite, &[]), domain(&kite, &[kite[0], kite[2]]));
    assert_eq!(broken(&free, &long, None), [Claim::ConstrainedDelaunay]);
    assert_eq!(broken(&free, &short, None), []);
    assert_eq!(broken(&across, &long, None), []);
    assert_eq!(broken(&across, &short, None), [Claim::InputSegments]);
}

#[test]
fn a_mesh_from_elsewhere_is_matched_by_coordinates() {
    let square = domain(&SQUARE, &[]);
    let shuffled = mesh(
        &[
            p(0.5, 0.5),
            p(0.0, 1.0),
            p(1.0, 0.0),
            p(0.0, 1.0f64.next_down() - 1.0),
            p(1.0, 1.0f64.next_up()),
            p(1.0, 0.5),
        ],
        &[[3, 2, 0], [2, 5, 0], [5, 4, 0], [4, 1, 0], [1, 3, 0]],
    );
    assert_eq!(broken(&square, &shuffled, None), []);
    assert_eq!(
        broken(&square, &Mesh::default(), None),
        [Claim::Area, Claim::InputVertices, Claim::InputSegments]
    );
}

#[test]
fn triangles_at_acute_vertices_are_excused() {
    let sliver = [p(0.0, 0.0), p(4.0, 0.0), p(4.0, 1.0)];
    let domain = domain(&sliver, &[]);
    let (statistics, certificate) = judge(&domain, &mesh(&sliver, &[[0, 1, 2]]), Some(&bounds(&UNIFORM, 0.9)));
    let check = certificate.check(Claim::MinAngle).unwrap();
    assert!(check.holds && check.worst.is_none() && !check.applies, "{check:?}");
    assert_eq!(
        (certificate.excused, statistics.excused, statistics.min_angle_free_deg),
        (1, 1, None)
    );
    assert!((statistics.min_angle_deg - 0.25f64.atan().to_degrees()).abs() < 1e-12);
}

/// An L of three unit squares.
const L: [DVec2; 6] = [
    DVec2::new(0.0, 0.0),
    DVec2::new(2.0, 0.0),
    DVec2::new(2.0, 1.0),
    DVec2::new(1.0, 1.0),
    DVec2::new(1.0, 2.0),
    DVec2::new(0.0, 2.0),
];

/// An L with a square hole, its boundary cut into pieces, and further points inside.
fn l_with_hole(parts: usize, inside: &[(f64, f64)]) -> (Domain, Mesh) {
    let mut pslg = Pslg::new("l");
    pslg.add_ring(L, 1);
    pslg.add_ring([p(0.4, 0.4), p(0.6, 0.4), p(0.6, 0.6), p(0.4, 0.6)], 2);
    pslg.add_hole(p(0.5, 0.5));
    let domain = Domain::new(pslg).unwrap();
    let (mut points, mut pieces) = (domain.vertices().to_vec(), Vec::new());
    for (s, segment) in domain.segments().iter().enumerate() {
        let [a, b] = domain.ends(s);
        let mut last = segment.a as u32;
        for k in 1..parts {
            pieces.push(Piece {
                a: last,
                b: points.len() as u32,
                segment: s as u32,
            });
            last = points.len() as u32;
            points.push(a.lerp(b, k as f64 / parts as f64));
        }
        pieces.push(Piece {
            a: last,
            b: segment.b as u32,
            segment: s as u32,
        });
    }
    for x in inside.iter().map(|&(x, y)| p(x, y)) {
        if domain.contains(x) && !points.contains(&x) {
            points.push(x);
        }
    }
    let mesh = triangulate(&domain, points, pieces).unwrap();
    (domain, mesh)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// Packing and nearest neighbours agree with their definitions, by loops over all pairs.
    #[test]
    fn distances_agree_with_looking_at_all_pairs(
        inside in prop::collection::vec((0.0f64..2.0, 0.0f64..2.0), 1..40),
        slope in (0.0f64..0.2, 0.0f64..0.2),
    ) {
        let (domain, mesh) = l_with_hole(2, &inside);
        let spacing = Linear { base: 0.2, slope: p(slope.0, slope.1) };
        let (statistics, certificate) = judge(&domain, &mesh, Some(&bounds(&spacing, 1.0)));
        let c_p = 1.0 / (2.0 + spacing.lipschitz());
        let pairs = mesh.points.iter().enumerate().flat_map(|(k, x)| mesh.points[..k].iter().map(move |y| (*x, *y)));
        let smallest = pairs.map(|(x, y)| x.distance(y) / (c_p * (spacing.at(x) + spacing.at(y)))).fold(9.0, f64::min);
        let check = certificate.check(Claim::PackingDisjoint).unwrap();
        prop_assert!((check.worst.unwrap() - smallest).abs() < 1e-12 && check.holds == (smallest >= 1.0 - CERTIFICATE));
        let nn = |x: DVec2| mesh.points.iter().filter(|y| **y != x).map(|y| x.distance(*y)).fold(9.0, f64::min);
        let largest = mesh.points.iter().map(|x| nn(*x) / spacing.at(*x)).fold(0.0, f64::max);
        prop_assert!((statistics.nn_over_f.unwrap().max - largest).abs() < 1e-12);
    }
}

#[test]
fn the_result_does_not_depend_on_threads() {
    let inside: Vec<_> = (0..3000)
        .map(|k| {
            (
                2.0 * (k as f64 * 0.618_034).fract(),
                2.0 * (k as f64 * 0.414_214).fract(),
            )
        })
        .collect();
    let (domain, mesh) = l_with_hole(40, &inside);
    let spacing = Linear {
        base: 0.02,
        slope: p(0.01, 0.0),
    };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| judge(&domain, &mesh, Some(&bounds(&spacing, 1.0))))
    };
    assert_eq!(run(1), run(4));
}

#[test]
fn circles_that_meet_low_are_a_hypothesis_on_whole_segments_and_a_fault_on_cut_ones() {
    let square = domain(&SQUARE, &[]);
    let whole = fan(p(0.5, 0.5));
    for (c_b, low) in [(0.51, 4), (0.7, 0)] {
        let (_, certificate) = judge(&square, &whole, Some(&bounds(&UNIFORM, c_b)));
        let check = certificate.check(Claim::BoundaryHeight).unwrap();
        assert!(check.holds, "c_b = {c_b}: {check:?}");
        assert_eq!(certificate.low_head_on, low, "c_b = {c_b}");
        assert_eq!(certificate.check(Claim::MinAngle).unwrap().applies, low == 0);
    }
    // The lower side cut in its middle: circles of radius 0.26 around its three vertices meet low, and step 4 is at fault.
    let cut = mesh(
        &[SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[3], p(0.5, 0.0)],
        &[[0, 4, 3], [4, 2, 3], [4, 1, 2]],
    );
    let (_, certificate) = judge(&square, &cut, Some(&bounds(&UNIFORM, 0.26)));
    let check = certificate.check(Claim::BoundaryHeight).unwrap();
    assert!(!check.holds && check.broken == 2 && check.applies, "{check:?}");
}
