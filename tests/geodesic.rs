//! `lfs:geodesic` from SPEC to certificate: arms of a domain that are close across the outside are not refined for each
//! other.

use biting::Case;
use biting::delaunay::triangulate;
use biting::domain::{Domain, Pslg, gallery};
use biting::geometry::DVec2;
use biting::mesh::{Mesh, Piece};
use biting::meshers::biting::Biting;
use biting::meshers::{self, MeshError, Parameters, parameter_value};
use biting::quality::Certificate;
use biting::spacing::{ControlSpacing, Spacing, Uniform};
use biting::theory::{Claim, GEODESIC_T};
use proptest::prelude::*;

const T: f64 = 0.25;
const C_B: f64 = 0.75;

fn named(name: &str) -> Domain {
    gallery::domain(name)
        .expect("a gallery name")
        .expect("a gallery domain")
}

/// The domain with that spacing, for c_b = 0.75.
fn case(domain: &Domain, spec: &str) -> Case {
    Case::new(domain.clone(), spec, T, C_B).expect("a spacing")
}

/// The same case with another c_b.
fn with_c_b(case: &Case, c_b: f64) -> Case {
    Case { c_b, ..case.clone() }
}

/// A case with a constant spacing that counts as capped by lfs.
fn constant(domain: &Domain, function: impl Spacing + 'static) -> Case {
    let spacing = ControlSpacing {
        lfs_cap: true,
        ..ControlSpacing::uncapped(function)
    };
    Case::of(domain.clone(), spacing, 1.0)
}

fn mesh_by(mesher: &str, case: &Case, params: &[(&str, &str)]) -> Result<Mesh, MeshError> {
    let params = params
        .iter()
        .map(|(name, value)| ((*name).to_owned(), parameter_value(value)));
    let params: Parameters = params.collect();
    let entry = meshers::find(mesher).expect("a mesher");
    case.mesh(&*(entry.make)(&params).expect("parameters"))
}

fn bitten(case: &Case) -> Mesh {
    case.mesh(&Biting::default())
        .unwrap_or_else(|error| panic!("{} {}: {error}", case.domain.name(), case.spacing.spec))
}

fn certificate(case: &Case, mesh: &Mesh) -> Certificate {
    case.judge_of(mesh, &Biting::default()).1
}

/// The number of triangles of a domain's mesh by biting, and its smallest angle, leaving out triangles at input angles
/// under 60°. Asserts the certificate.
fn measured(domain: &Domain, spec: &str) -> (usize, f64) {
    let case = case(domain, spec);
    let mesh = bitten(&case);
    let (statistics, certificate) = case.judge_of(&mesh, &Biting::default());
    let broken: Vec<_> = certificate.broken().collect();
    assert!(certificate.holds, "{} {spec}: {broken:?}", domain.name());
    let claims = [
        Claim::PackingDisjoint,
        Claim::Coverage,
        Claim::MinAngle,
        Claim::NnVertexUpper,
        Claim::NnPointLower,
    ];
    if domain.has_no_acute_angle() {
        assert!(
            claims
                .iter()
                .all(|claim| certificate.check(*claim).is_some_and(|check| check.applies))
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
    // The comb's gaps are as wide as its teeth, so nothing can be saved; star and random-simple have acute angles.
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
    let meshes = [0; 2].map(|_| bitten(&case(&domain, "lfs:geodesic")));
    assert!(meshes[0] == meshes[1]);
}

#[test]
fn what_is_not_proved_is_declined() {
    let domain = named("two-arms");
    let inside = case(&domain, "lfs:geodesic");
    let declined = |result: Result<Mesh, MeshError>| match result {
        Err(MeshError::Declined(reason)) => reason,
        other => panic!("{other:?}"),
    };
    assert!(declined(mesh_by("biting", &inside, &[("rule", "later")])).contains("use rule=earlier"));
    let steep = with_c_b(&inside, 3.1 * GEODESIC_T);
    assert!(declined(steep.mesh(&Biting::default())).contains("limit the spacing's gradient"));
    for mesher in ["quadtree-mis", "advancing-front"] {
        assert!(declined(mesh_by(mesher, &inside, &[])).contains("use lfs as spacing"));
    }
    let [inside, plane] = [inside, case(&domain, "lfs")].map(|case| {
        let mesh = mesh_by("delaunay-refinement", &case, &[]).expect("a mesh");
        mesh.triangles.len()
    });
    assert!(2 * inside < plane, "{inside} {plane}");
}

/// A constant spacing with distances measured inside the domain.
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

/// Circles of radius 0.35 around points of the left arm of two-arms hold all of the right arm, and reach nothing of it.
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
    let check = |case: Case, claim: Claim| certificate(&case, &mesh).check(claim).expect("a check").clone();
    let plane = |size: f64, claim: Claim| check(constant(&domain, Uniform(size)), claim);
    let inside = |size: f64, claim: Claim| check(constant(&domain, Constant(size)), claim);
    assert!(plane(0.35, Claim::Coverage).holds && !inside(0.35, Claim::Coverage).holds);
    // The two upper corners of the gap are 0.02 apart in the plane, which does not matter inside.
    assert!(!plane(0.1, Claim::PackingDisjoint).holds && !plane(0.1, Claim::NnVertexLower).holds);
    // The two at its bottom are too near in both senses.
    assert!(!inside(0.1, Claim::PackingDisjoint).holds && !inside(0.1, Claim::NnVertexLower).holds);
    assert!(plane(0.02, Claim::PackingDisjoint).holds && inside(0.02, Claim::PackingDisjoint).holds);
    for claim in [Claim::PackingDisjoint, Claim::NnVertexLower] {
        assert!(inside(0.1, claim).broken < plane(0.1, claim).broken, "{claim}");
    }
}

#[test]
fn the_judge_sees_what_is_too_coarse_or_too_dense() {
    let domain = named("two-arms");
    let case = case(&domain, "lfs:geodesic");
    let mesh = bitten(&case);
    let holds = |c_b: f64, claim: Claim| {
        let certificate = certificate(&with_c_b(&case, c_b), &mesh);
        certificate.check(claim).expect("a check").holds
    };
    assert!(holds(C_B, Claim::Coverage) && !holds(0.8 * C_B, Claim::Coverage));
    assert!(holds(C_B, Claim::PackingDisjoint) && !holds(1.3 * C_B, Claim::PackingDisjoint));
    assert!(holds(C_B, Claim::NnVertexLower) && !holds(1.4 * C_B, Claim::NnVertexLower));
}

/// A box with slots cut into it from above, each with its width, depth and lean: arms that are close across the
/// outside, with corners of any angle.
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
