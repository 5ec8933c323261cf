//! `lfs:geodesic` from SPEC to certificate: arms of a domain that are close outside it are not refined for each other.

use biting::delaunay::triangulate;
use biting::domain::{Domain, Pslg, gallery};
use biting::geometry::DVec2;
use biting::mesh::{Mesh, Piece};
use biting::meshers::{self, MeshError, Parameters, Request, Trace, parameter_value};
use biting::quality::{Bounds, Certificate, Statistics, judge};
use biting::spacing::{self, GEODESIC_T, Options, Prepared, Rule, Spacing, Uniform};
use proptest::prelude::*;

const T: f64 = 0.25;
const C_B: f64 = 0.75;

fn named(name: &str) -> Domain {
    gallery::domain(name)
        .expect("a gallery name")
        .expect("a gallery domain")
}

fn prepared(domain: &Domain, spec: &str) -> Prepared {
    spacing::build(spec, domain, &Options::new(T, C_B)).expect("a spacing")
}

fn mesh(domain: &Domain, spacing: &dyn Spacing, params: &[(&str, &str)], c_b: f64) -> Result<Mesh, MeshError> {
    mesh_by("biting", domain, spacing, params, c_b)
}

fn mesh_by(
    mesher: &str,
    domain: &Domain,
    spacing: &dyn Spacing,
    params: &[(&str, &str)],
    c_b: f64,
) -> Result<Mesh, MeshError> {
    let params = params
        .iter()
        .map(|(name, value)| ((*name).to_owned(), parameter_value(value)));
    let params: Parameters = params.collect();
    let entry = meshers::find(mesher).expect("a mesher");
    let mesher = (entry.make)(&params).expect("parameters");
    mesher.mesh(domain, spacing, &Request::new(c_b), &mut Trace::default())
}

fn judged(domain: &Domain, spacing: &dyn Spacing, mesh: &Mesh, c_b: f64) -> (Statistics, Certificate) {
    let entry = meshers::find("biting").expect("biting");
    let bounds = Bounds {
        spacing,
        c_b,
        rule: Rule::Earlier,
        lfs_cap: true,
        integral: None,
        integral_error: 0.0,
        guaranteed: &entry.guaranteed(&Parameters::new(), domain, spacing, c_b),
    };
    judge(domain, mesh, Some(&bounds))
}

/// Triangles of the mesh of a domain by biting, and its smallest angle beside input angles of 60° or more, once its
/// certificate holds.
fn measured(domain: &Domain, spec: &str) -> (usize, f64) {
    let f = prepared(domain, spec).function;
    let mesh = mesh(domain, f.as_ref(), &[], C_B).unwrap_or_else(|error| panic!("{} {spec}: {error}", domain.name()));
    let (statistics, certificate) = judged(domain, f.as_ref(), &mesh, C_B);
    let broken: Vec<_> = certificate.broken().collect();
    assert!(certificate.holds, "{} {spec}: {broken:?}", domain.name());
    let claims = [
        "packing-disjoint",
        "coverage",
        "min-angle",
        "nn-vertex-upper",
        "nn-point-lower",
    ];
    if domain.has_no_acute_angle() {
        assert!(
            claims
                .iter()
                .all(|claim| certificate.check(claim).is_some_and(|check| check.applies))
        );
    }
    (mesh.triangles.len(), statistics.min_angle_free_deg.unwrap_or(60.0))
}

#[test]
fn two_arms_have_a_third_of_the_triangles() {
    let domain = named("two-arms");
    let [(plane, _), (inside, smallest)] = ["lfs", "lfs:geodesic"].map(|spec| measured(&domain, spec));
    assert!(3 * inside < plane, "{inside} {plane}");
    assert!(smallest > 14.47, "{smallest}");
}

#[test]
fn elsewhere_there_are_no_more() {
    // The comb's gaps are as wide as its teeth, so that nothing is to be had; star and random-simple have acute angles.
    for name in [
        "comb",
        "gear",
        "l-shape",
        "star",
        "plate-hole",
        "random-simple",
        "interface",
    ] {
        let domain = named(name);
        let [plane, inside] = ["lfs", "lfs:geodesic"].map(|spec| measured(&domain, spec).0);
        assert!(inside as f64 <= 1.02 * plane as f64 + 10.0, "{name}: {inside} {plane}");
    }
}

#[test]
fn it_goes_with_others() {
    let domain = named("two-arms");
    for spec in ["min(lfs:geodesic, uniform:0.1)", "min(expr:0.05 + 0.2*y, lfs:geodesic)"] {
        let (triangles, _) = measured(&domain, spec);
        let (plane, _) = measured(&domain, &spec.replace(":geodesic", ""));
        assert!(triangles < plane, "{spec}: {triangles} {plane}");
    }
}

#[test]
fn runs_are_equal() {
    let domain = named("two-arms");
    let meshes = [0; 2].map(|_| {
        let f = prepared(&domain, "lfs:geodesic").function;
        mesh(&domain, f.as_ref(), &[], C_B).expect("a mesh")
    });
    assert!(meshes[0] == meshes[1]);
}

#[test]
fn what_is_not_proved_is_declined() {
    let domain = named("two-arms");
    let f = prepared(&domain, "lfs:geodesic").function;
    let told = |result: Result<Mesh, MeshError>| match result {
        Err(MeshError::Declined(reason)) => reason,
        other => panic!("{other:?}"),
    };
    assert!(told(mesh(&domain, f.as_ref(), &[("rule", "later")], C_B)).contains("use rule=earlier"));
    assert!(told(mesh(&domain, f.as_ref(), &[], 3.1 * GEODESIC_T)).contains("limit the spacing's gradient"));
    for mesher in ["quadtree-mis", "advancing-front"] {
        assert!(told(mesh_by(mesher, &domain, f.as_ref(), &[], C_B)).contains("use lfs as spacing"));
    }
    let [inside, plane] = ["lfs:geodesic", "lfs"].map(|spec| {
        let f = prepared(&domain, spec).function;
        let mesh = mesh_by("delaunay-refinement", &domain, f.as_ref(), &[], C_B).expect("a mesh");
        mesh.triangles.len()
    });
    assert!(2 * inside < plane, "{inside} {plane}");
}

/// Constant, with distances measured inside the domain.
struct Constant(f64);

impl Spacing for Constant {
    fn at(&self, _: DVec2) -> f64 {
        self.0
    }

    fn lipschitz(&self) -> f64 {
        0.0
    }

    fn is_geodesic(&self) -> bool {
        true
    }
}

/// Circles of 0.35 around points of the left arm of two-arms hold all of the right arm, and reach nothing of it.
#[test]
fn circles_on_one_arm_do_not_cover_the_other() {
    let domain = named("two-arms");
    let inner = (0..domain.segments().len())
        .find(|&s| domain.ends(s).iter().all(|end| end.x == 0.3))
        .expect("the left side of the gap");
    let start = domain.ends(inner)[0];
    let mut points = domain.vertices().to_vec();
    let mut on_segments = vec![Vec::new(); domain.segments().len()];
    for k in 1..10 {
        let y = 0.3 + 0.2 * f64::from(k);
        on_segments[inner].push(((y - start.y).abs(), points.len() as u32));
        points.push(DVec2::new(0.3, y));
    }
    let mesh = triangulate(&domain, points, Piece::chains(&domain, on_segments)).expect("a mesh");
    let holds = |spacing: &dyn Spacing, claim: &str| {
        let (_, certificate) = judged(&domain, spacing, &mesh, 1.0);
        certificate.check(claim).expect("a check").holds
    };
    assert!(holds(&Uniform(0.35), "coverage") && !holds(&Constant(0.35), "coverage"));
    // The two upper corners of the gap are 0.02 apart in the plane, and nobody minds inside.
    assert!(!holds(&Uniform(0.1), "packing-disjoint") && !holds(&Uniform(0.1), "nn-vertex-lower"));
    // Those at its bottom are too near in both senses.
    assert!(!holds(&Constant(0.1), "packing-disjoint") && !holds(&Constant(0.1), "nn-vertex-lower"));
    assert!(holds(&Uniform(0.02), "packing-disjoint") && holds(&Constant(0.02), "packing-disjoint"));
    let broken = |spacing: &dyn Spacing, claim: &str| {
        let (_, certificate) = judged(&domain, spacing, &mesh, 1.0);
        certificate.check(claim).expect("a check").broken
    };
    for claim in ["packing-disjoint", "nn-vertex-lower"] {
        assert!(broken(&Constant(0.1), claim) < broken(&Uniform(0.1), claim), "{claim}");
    }
}

#[test]
fn the_judge_sees_what_is_too_coarse_or_too_dense() {
    let domain = named("two-arms");
    let f = prepared(&domain, "lfs:geodesic").function;
    let mesh = mesh(&domain, f.as_ref(), &[], C_B).expect("a mesh");
    let holds = |c_b: f64, claim: &str| {
        judged(&domain, f.as_ref(), &mesh, c_b)
            .1
            .check(claim)
            .expect("a check")
            .holds
    };
    assert!(holds(C_B, "coverage") && !holds(0.8 * C_B, "coverage"));
    assert!(holds(C_B, "packing-disjoint") && !holds(1.3 * C_B, "packing-disjoint"));
    assert!(holds(C_B, "nn-vertex-lower") && !holds(1.4 * C_B, "nn-vertex-lower"));
}

/// A box with slots cut into it from above, each with its width, depth and lean: arms close outside, with corners of any angle.
fn slotted(slots: &[(f64, f64, f64)]) -> Option<Domain> {
    let width = slots.len() as f64 + 1.0;
    let mut points = vec![(0.0, 0.0), (width, 0.0), (width, 2.0)];
    for (k, (width, depth, lean)) in slots.iter().enumerate().rev() {
        let middle = k as f64 + 1.0;
        let [left, right] = [middle - 0.5 * width, middle + 0.5 * width];
        points.extend([
            (right, 2.0),
            (right + lean, 2.0 - depth),
            (left + lean, 2.0 - depth),
            (left, 2.0),
        ]);
    }
    points.push((0.0, 2.0));
    let mut pslg = Pslg::new("slotted");
    pslg.add_ring(points.into_iter().map(DVec2::from), 1);
    Domain::new(pslg).ok()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn arms_of_all_kinds_are_meshed_and_certified(
        slots in prop::collection::vec((0.003f64..0.3, 0.3f64..1.7, -0.3f64..0.3), 1..4),
        is_upright in any::<bool>(),
    ) {
        let slots: Vec<_> = slots.into_iter().map(|(w, d, lean)| (w, d, if is_upright { 0.0 } else { lean })).collect();
        if let Some(domain) = slotted(&slots) {
            let [(plane, _), (inside, smallest)] = ["lfs", "lfs:geodesic"].map(|spec| measured(&domain, spec));
            prop_assert!(inside as f64 <= 1.05 * plane as f64 + 10.0, "{} {}", inside, plane);
            prop_assert!(smallest > 14.47);
        }
    }

    #[test]
    fn random_polygons_are_meshed_and_certified(seed in 0u64..10_000, count in 5usize..30) {
        let domain = named(&format!("random-simple:n={count},seed={seed}"));
        let [(plane, _), (inside, _)] = ["lfs", "lfs:geodesic"].map(|spec| measured(&domain, spec));
        prop_assert!(inside as f64 <= 1.1 * plane as f64 + 10.0, "{} {}", inside, plane);
    }
}
