//! What the certificate does not check: encroachment, angles, sizes, what is left bad and why, and that refinement
//! ends.

use super::pieces::{Nearness, in_diametral_circle};
use super::*;
use crate::domain::{InputSegment, Pslg, gallery};
use crate::geometry::DVec2;
use crate::geometry::predicates::{Meeting, orient2d, segments_meet};
use crate::meshers::Budget;
use crate::quality::shape::angles_deg;
use crate::quality::{Statistics, judge};
use crate::spacing::{Options, Uniform, build};
use proptest::prelude::*;
use std::sync::Arc;

fn request() -> Request {
    Request {
        c_b: 1.0,
        seed: 0,
        threads: 1,
        budget: Budget {
            max_vertices: Some(60_000),
            ..Budget::default()
        },
    }
}

fn domain(name: &str) -> Domain {
    gallery::domain(name).expect("a gallery name").expect("a valid domain")
}

fn uncapped(domain: &Domain, spec: &str) -> Arc<dyn Spacing> {
    let options = Options {
        lfs_cap: false,
        ..Options::with_alpha(0.5)
    };
    build(spec, domain, &options).expect("a spacing").function
}

/// A mesher for angles only, of the given variant.
fn angles_only(angle: f64, insertion: Insertion, encroachment: Encroachment) -> DelaunayRefinement {
    DelaunayRefinement {
        angle,
        insertion,
        encroachment,
        size_rule: SizeRule::None,
    }
}

/// Every pair of insertion and encroachment.
fn variants(angle: f64) -> impl Iterator<Item = DelaunayRefinement> {
    use {Encroachment::*, Insertion::*};
    let pairs = [
        (Circumcentre, DiametralCircle),
        (Circumcentre, Lens),
        (OffCentre, DiametralCircle),
        (OffCentre, Lens),
    ];
    pairs
        .into_iter()
        .map(move |(insertion, encroachment)| angles_only(angle, insertion, encroachment))
}

struct Run {
    mesh: Mesh,
    statistics: Statistics,
    /// Triangles that the mesher reports as left bad.
    left: f64,
}

/// Meshes, and asserts the structural checks of the certificate.
fn run(mesher: &DelaunayRefinement, domain: &Domain, spacing: &dyn Spacing) -> Run {
    let mut trace = Trace::default();
    let mesh = mesher.mesh(domain, spacing, &request(), &mut trace);
    let mesh = mesh.unwrap_or_else(|error| panic!("{mesher:?} on {}: {error}", domain.name()));
    let (statistics, certificate) = judge(domain, &mesh, None);
    assert!(
        certificate.checks.iter().all(|check| check.holds),
        "{mesher:?} on {}: {certificate:#?}",
        domain.name()
    );
    let left = trace.counts.iter().filter(|(name, _)| name.starts_with("left_"));
    Run {
        mesh,
        statistics,
        left: left.map(|(_, count)| count).sum(),
    }
}

fn smallest_angle(corners: [DVec2; 3]) -> f64 {
    angles_deg(corners).into_iter().fold(f64::INFINITY, f64::min)
}

/// The number of triangles with a smaller angle than asked for, by a loop.
fn skinny(mesh: &Mesh, angle: f64) -> usize {
    let is_skinny = |&t: &usize| smallest_angle(mesh.corners(t)) < angle - 1e-9;
    (0..mesh.triangles.len()).filter(is_skinny).count()
}

/// The number of pairs of a piece and a vertex that encroaches upon it and sees its middle through the domain, by a
/// loop over all.
fn encroached(domain: &Domain, mesh: &Mesh, is_near: impl Fn([DVec2; 2], DVec2) -> bool) -> usize {
    let place = |vertex: u32| mesh.points[vertex as usize];
    let ends = |k: usize| [place(mesh.pieces[k].a), place(mesh.pieces[k].b)];
    let sees = |k: usize, x: DVec2| {
        let [a, b] = ends(k);
        let segment = domain.segments()[mesh.pieces[k].segment as usize];
        let side = orient2d(a, b, x);
        let face = if side > 0.0 { segment.left } else { segment.right };
        let middle = a.midpoint(b);
        let blocks = |other: usize| {
            let [c, d] = ends(other);
            other != k && c != x && d != x && segments_meet(x, middle, c, d) != Meeting::Apart
        };
        side != 0.0 && domain.faces()[face].inside && !(0..mesh.pieces.len()).any(blocks)
    };
    let pairs = (0..mesh.pieces.len()).flat_map(|k| mesh.points.iter().map(move |&x| (k, x)));
    pairs.filter(|&(k, x)| is_near(ends(k), x) && sees(k, x)).count()
}

#[test]
fn angles_are_as_asked_and_no_piece_is_encroached_upon() {
    for name in ["plate-hole", "comb", "two-arms", "gear", "interface", "random-convex"] {
        let domain = domain(name);
        for mesher in [20.7, 28.6].into_iter().flat_map(variants) {
            let Run { mesh, left, .. } = run(&mesher, &domain, &Uniform(1.0));
            assert_eq!((skinny(&mesh, mesher.angle), left), (0, 0.0), "{mesher:?} on {name}");
            let nearness = Nearness::new(&mesher);
            let near = |ends: [DVec2; 2], x| nearness.encroaches(ends, x);
            assert_eq!(encroached(&domain, &mesh, near), 0, "{mesher:?} on {name}");
        }
    }
}

#[test]
fn angles_are_as_asked_on_the_whole_gallery_away_from_acute_vertices() {
    use {Encroachment::*, Insertion::*};
    for name in gallery::ENTRIES.iter().map(|entry| entry.name) {
        let domain = domain(name);
        for mesher in [
            angles_only(20.7, Circumcentre, DiametralCircle),
            angles_only(28.6, OffCentre, Lens),
        ] {
            let free = run(&mesher, &domain, &Uniform(1e6)).statistics.min_angle_free_deg;
            assert!(
                free.is_some_and(|free| free >= mesher.angle - 1e-9),
                "{mesher:?} on {name}: {free:?}"
            );
        }
    }
}

#[test]
fn diametral_circles_make_the_mesh_delaunay_and_lenses_need_fewer_points() {
    let domain = domain("comb");
    let of = |encroachment| {
        run(
            &angles_only(20.7, Insertion::Circumcentre, encroachment),
            &domain,
            &Uniform(1.0),
        )
    };
    let (circles, lenses) = (of(Encroachment::DiametralCircle), of(Encroachment::Lens));
    assert_eq!(encroached(&domain, &circles.mesh, in_diametral_circle), 0);
    assert!(lenses.mesh.points.len() < circles.mesh.points.len());
}

#[test]
fn sizes_are_obeyed_by_every_rule() {
    let domain = domain("plate-hole");
    let spacing = uncapped(&domain, "expr: 0.05 + 0.2*sqrt((x-0.5)^2 + (y-0.5)^2)");
    let mut counts = Vec::new();
    for size_rule in [SizeRule::Area, SizeRule::Edge, SizeRule::Radius, SizeRule::None] {
        let mesher = DelaunayRefinement {
            size_rule,
            ..DelaunayRefinement::default()
        };
        let Run { mesh, left, .. } = run(&mesher, &domain, &*spacing);
        for t in 0..mesh.triangles.len() {
            let [a, b, c] = mesh.corners(t);
            let s = spacing.at((a + b + c) / 3.0);
            let area = 0.5 * (b - a).perp_dot(c - a);
            let edges = [[a, b], [b, c], [c, a]];
            let product: f64 = edges.iter().map(|[p, q]| p.distance(*q)).product();
            let obeyed = match size_rule {
                SizeRule::Area => area <= 0.25 * 3f64.sqrt() * s * s,
                SizeRule::Edge => edges.iter().all(|[p, q]| {
                    let at_most = edges.iter().map(|[p, q]| p.distance(*q)).fold(0.0, f64::max);
                    p.distance(*q) < at_most || at_most <= spacing.at(p.midpoint(*q))
                }),
                SizeRule::Radius => product / (4.0 * area) <= s / 3f64.sqrt() * (1.0 + 1e-12),
                SizeRule::None => true,
            };
            assert!(obeyed, "{size_rule:?}: {a} {b} {c}");
        }
        assert_eq!((skinny(&mesh, mesher.angle), left), (0, 0.0), "{size_rule:?}");
        counts.push(mesh.triangles.len());
    }
    assert!(
        counts[1] > counts[0] && counts[0] > counts[3] && counts[2] > counts[3],
        "{counts:?}"
    );
}

#[test]
fn an_angle_out_of_range_is_refused() {
    for bad in ["-1", "35", "1e9"] {
        let parameters =
            crate::meshers::Parameters::from_iter([("angle".into(), crate::meshers::parameter_value(bad))]);
        let refused = (ENTRY.make)(&parameters).err().expect("refused");
        assert!(
            refused.contains("angle") && refused.contains("from 0 to 34"),
            "{refused}"
        );
    }
}

/// A square with segments from its centre in the given directions, in degrees, so that inner angles can be arbitrarily
/// small.
fn fan(directions: &[f64], length: f64) -> Domain {
    let mut pslg = Pslg::new("fan");
    pslg.add_ring(
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec2::new(x, y)),
        1,
    );
    let a = pslg.add_vertex(DVec2::ZERO);
    for direction in directions {
        let b = pslg.add_vertex(length * DVec2::from_angle(direction.to_radians()));
        pslg.segments.push(InputSegment { a, b, marker: 2 });
    }
    Domain::new(pslg).expect("a valid domain")
}

#[test]
fn small_input_angles_spoil_only_triangles_at_their_vertex() {
    let directions: Vec<f64> = (0..24).map(|k| 15.0 * f64::from(k)).collect();
    let domain = fan(&directions, 0.7);
    for mesher in [20.7, 28.6, 33.0].into_iter().flat_map(variants) {
        let Run { mesh, statistics, left } = run(&mesher, &domain, &Uniform(1.0));
        let free = statistics.min_angle_free_deg.expect("triangles away from the vertex");
        assert!(free >= mesher.angle - 1e-9, "{mesher:?}: {free}");
        assert_eq!(skinny(&mesh, mesher.angle) as f64, left, "{mesher:?}");
    }
}

#[test]
fn sharp_fans_end_and_spoil_nothing_beyond_the_features_round_their_vertex() {
    for (directions, length) in [
        (vec![3.0, 13.0, 33.0, 38.0, 39.0, 100.0], 0.8),
        (vec![0.0, 1.0, 2.0, 3.0, 4.0], 0.5),
    ] {
        let domain = fan(&directions, length);
        for mesher in [20.7, 28.6, 33.0].into_iter().flat_map(variants) {
            let Run { mesh, left, .. } = run(&mesher, &domain, &Uniform(1.0));
            let bad = |&t: &usize| smallest_angle(mesh.corners(t)) < mesher.angle - 1e-9;
            let bad: Vec<[DVec2; 3]> = (0..mesh.triangles.len()).filter(bad).map(|t| mesh.corners(t)).collect();
            assert_eq!(bad.len() as f64, left, "{mesher:?} on {directions:?}");
            let farthest = bad.as_flattened().iter().map(|x| x.length()).fold(0.0, f64::max);
            assert!(farthest < length, "{mesher:?} on {directions:?}: {farthest}");
        }
    }
}

#[test]
fn shells_know_the_features_round_their_vertex() {
    use crate::meshers::delaunay_refinement::pieces::feature_size_at;
    for name in ["star", "random-simple", "interface"] {
        let domain = domain(name);
        let lfs = crate::spacing::lfs_of(&domain).expect("features");
        for vertex in 0..domain.vertices().len() {
            let (found, expected) = (feature_size_at(&domain, vertex), lfs.at(domain.vertices()[vertex]));
            assert!(
                (found - expected).abs() <= 1e-12 * expected,
                "{name} {vertex}: {found}, {expected}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Spikes of any sharpness: refinement ends with a valid mesh, and counts every triangle that it leaves bad.
    #[test]
    fn random_spikes_end_with_every_bad_triangle_counted(
        radii in prop::collection::vec(0.05f64..1.0, 5..25),
        turn in 0.0f64..6.3,
        exponent in -6i32..7,
        angle in prop::sample::select(vec![20.7, 28.6, 33.0, 34.0]),
        variant in 0usize..4,
        sized in any::<bool>(),
    ) {
        let scale = 10f64.powi(exponent);
        let mut pslg = Pslg::new("spikes");
        let count = radii.len() as f64;
        let at = |(k, radius): (usize, &f64)| {
            scale * (DVec2::new(3.0, 5.0) + *radius * DVec2::from_angle(turn + std::f64::consts::TAU * k as f64 / count))
        };
        pslg.add_ring(radii.iter().enumerate().map(at), 1);
        let domain = Domain::new(pslg).expect("a valid domain");
        let mut mesher = variants(angle).nth(variant).expect("one of four");
        let spacing = Uniform(0.1 * scale);
        if sized {
            mesher.size_rule = SizeRule::Area;
        }
        let Run { mesh, left, .. } = run(&mesher, &domain, &spacing);
        prop_assert_eq!(skinny(&mesh, angle) as f64, left);
    }
}

/// Found by the robustness experiment: vertices nearly on one line leave slivers outside, which splits of pieces turn over.
#[test]
fn sides_all_but_straight_can_be_split_again_and_again() {
    let domain = domain("random-pslg:kind=divided,seed=880");
    let spacing = build("lfs", &domain, &Options::new(0.25, 0.75))
        .expect("a spacing")
        .function;
    let request = Request { c_b: 0.75, ..request() };
    let mesh = DelaunayRefinement::default().mesh(&domain, &*spacing, &request, &mut Trace::default());
    let (_, certificate) = judge(&domain, &mesh.expect("a mesh"), None);
    assert!(certificate.holds);
}
