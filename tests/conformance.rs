//! One suite for all meshers: every entry of `MESHERS` on every small domain, then the same scaled, rotated, mirrored,
//! shuffled, run twice and with several threads. The certificate judges; no mesher's name occurs here.

use biting::Case;
use biting::domain::{Domain, Fill, Pslg, gallery};
use biting::geometry::DVec2;
use biting::mesh::{Mesh, files};
use biting::meshers::{Budget, Entry, MESHERS, MeshError, Mesher, Parameters, Request, Trace, parameter_value};
use biting::spacing::{self, Spacing};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

const T: f64 = 0.3;
const C_B: f64 = 0.6;

/// Gallery domains small enough for debug builds.
fn small_gallery() -> Vec<Pslg> {
    let names = [
        "unit-square",
        "l-shape",
        "plate-hole",
        "star",
        "interface",
        "random-convex",
        "random-simple",
    ];
    names
        .iter()
        .map(|name| gallery::pslg(name).expect("a gallery name").expect("a gallery domain"))
        .collect()
}

fn request(threads: usize) -> Request {
    Request {
        c_b: C_B,
        seed: 1,
        threads,
        budget: Budget {
            max_vertices: Some(100_000),
            ..Budget::default()
        },
    }
}

fn case(pslg: &Pslg, spec: &str) -> Case {
    let domain = Domain::new(pslg.clone()).expect("a valid domain");
    Case::new(domain, spec, T, C_B).expect("a spacing")
}

/// A mesher with parameters.
struct Method {
    name: String,
    entry: &'static Entry,
    parameters: Parameters,
}

impl Method {
    fn make(&self) -> Box<dyn Mesher> {
        (self.entry.make)(&self.parameters).expect("parameters are valid")
    }
}

/// Every mesher at its defaults; one with several rules of who bites whom, by each of them.
fn methods() -> Vec<Method> {
    let mut methods = Vec::new();
    for entry in MESHERS {
        let rules = entry.parameters.iter().filter(|parameter| parameter.name == "rule");
        let others = rules.flat_map(|rule| rule.values.split(", ").filter(|value| *value != rule.default));
        let of = |value: &str| Parameters::from_iter([("rule".to_owned(), parameter_value(value))]);
        for parameters in std::iter::once(Parameters::new()).chain(others.map(of)) {
            methods.push(Method {
                name: format!("{} {parameters:?}", entry.name),
                entry,
                parameters,
            });
        }
    }
    methods
}

fn run(method: &Method, case: &Case, threads: usize) -> Result<Mesh, MeshError> {
    case.mesh_as(&*method.make(), &request(threads), &mut Trace::default())
}

/// Meshes, and asserts every guaranteed check of the certificate. A method may decline, with a reason.
fn certified(method: &Method, pslg: &Pslg, spec: &str, what: &str) -> Option<Mesh> {
    let case = case(pslg, spec);
    let mesh = match run(method, &case, 1) {
        Ok(mesh) => mesh,
        Err(MeshError::Declined(reason)) => {
            assert!(!reason.is_empty());
            return None;
        }
        Err(error) => panic!("{} on {} {what}: {error}", method.name, pslg.name),
    };
    let (_, certificate) = case.judge_of(&mesh, &*method.make());
    let broken: Vec<_> = certificate.broken().collect();
    assert!(
        broken.is_empty(),
        "{} on {} {what}: {broken:#?}",
        method.name,
        pslg.name
    );
    assert!(certificate.holds);
    assert_eq!(
        mesh.points[..case.domain.vertices().len()],
        *case.domain.vertices(),
        "input vertices come first, in order"
    );
    Some(mesh)
}

/// The same domain with every point moved by `map`.
fn mapped(pslg: &Pslg, map: impl Fn(DVec2) -> DVec2) -> Pslg {
    let mut moved = pslg.clone();
    moved.vertices.iter_mut().for_each(|p| *p = map(*p));
    moved
        .regions
        .iter_mut()
        .for_each(|region| region.point = map(region.point));
    if let Fill::HolePoints(points) = &mut moved.fill {
        points.iter_mut().for_each(|p| *p = map(*p));
    }
    moved
}

/// The same domain with vertices and segments in another order and segments turned round.
fn shuffled(pslg: &Pslg, seed: u64) -> Pslg {
    let mut random = Pcg64::seed_from_u64(seed);
    let mut order: Vec<usize> = (0..pslg.vertices.len()).collect();
    order.shuffle(&mut random);
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(new, &old)| place[old] = new);
    let mut other = pslg.clone();
    other.vertices = order.iter().map(|&old| pslg.vertices[old]).collect();
    if !pslg.vertex_markers.is_empty() {
        other.vertex_markers = order.iter().map(|&old| pslg.vertex_markers[old]).collect();
    }
    for segment in &mut other.segments {
        (segment.a, segment.b) = (place[segment.b], place[segment.a]);
    }
    if matches!(pslg.fill, Fill::HolePoints(_)) {
        other.segments.shuffle(&mut random);
    }
    other
}

#[test]
fn every_mesher_on_every_small_domain() {
    for method in &methods() {
        for pslg in small_gallery() {
            for spec in ["lfs", "expr: 0.05 + 0.2*(x*x + y*y)"] {
                certified(method, &pslg, spec, spec);
            }
        }
    }
}

/// A SPEC of each of `spacing::KINDS`, in that order; the files are meshes of the domain.
fn kinds(field: &str, sizes: &str, mesh: &str) -> Vec<String> {
    let u = "tanh((x+y-1)/0.2)";
    vec![
        "lfs".into(),
        "lfs:geodesic".into(),
        "uniform:0.1".into(),
        "expr:0.05+0.1*x^2".into(),
        format!("hessian:{u};eps=0.02;max=0.3"),
        format!("field:{field};eps=0.02;min=0.02"),
        format!("points:{sizes};alpha=0.2"),
        format!("el:{mesh}"),
        format!("nn:{mesh};factor=0.8"),
        format!("min(expr:0.1+x, hessian:{u};eps=0.05, nn:{mesh})"),
    ]
}

#[test]
fn every_kind_of_spacing_by_every_mesher() {
    let folder = tempfile::tempdir().expect("a folder");
    for pslg in small_gallery()
        .into_iter()
        .filter(|pslg| ["unit-square", "l-shape"].contains(&pslg.name.as_str()))
    {
        let first = certified(&methods()[0], &pslg, "uniform:0.15", "the mesh to begin with").expect("a mesh");
        let values: Vec<f64> = first.points.iter().map(|x| ((x.x + x.y - 1.0) / 0.2).tanh()).collect();
        let file = |name: &str| folder.path().join(format!("{}-{name}", pslg.name));
        let [field, sizes, mesh] = ["u.node", "sizes.node", "mesh.vtu"].map(file);
        let positive: Vec<f64> = values.iter().map(|value| 0.2 + 0.1 * value).collect();
        files::write_with_values(&first, &values, &field).expect("written");
        files::write_with_values(&first, &positive, &sizes).expect("written");
        files::write(&first, &mesh).expect("written");
        let [field, sizes, mesh] = [field, sizes, mesh].map(|file| file.display().to_string());
        let specs = kinds(&field, &sizes, &mesh);
        assert_eq!(specs.len(), spacing::KINDS.len());
        for (spec, kind) in specs.iter().zip(spacing::KINDS) {
            let start = kind.split([':', '(']).next().unwrap_or_default();
            assert!(spec.starts_with(start), "{spec} is no {kind}");
            for method in &methods() {
                certified(method, &pslg, spec, spec);
            }
        }
    }
}

/// The number of valid domains of a hundred that a method may decline.
const MOST_DECLINED: usize = 1;

#[test]
fn random_domains_are_hardly_ever_declined() {
    for method in &methods() {
        let is_declined = |seed: &usize| {
            let name = format!("random-simple:n=12,seed={seed}");
            let pslg = gallery::pslg(&name).expect("a gallery name").expect("a gallery domain");
            certified(method, &pslg, "lfs", &name).is_none()
        };
        let declined: Vec<usize> = (1..=100).filter(is_declined).collect();
        assert!(declined.len() <= MOST_DECLINED, "{} declines {declined:?}", method.name);
    }
}

#[test]
fn scaled_from_a_millionth_to_a_million() {
    for method in &methods() {
        for pslg in small_gallery() {
            for scale in [1e-6, 1e-3, 1e3, 1e6] {
                certified(
                    method,
                    &mapped(&pslg, |p| p * scale),
                    "lfs",
                    &format!("scaled by {scale:e}"),
                );
            }
        }
    }
}

/// Found by `experiments/robustness.toml`: far from the origin, rounding changes distances of neighbours by more than
/// the share that the certificate allows.
#[test]
fn far_from_the_origin() {
    for method in &methods() {
        for seed in [17, 27, 95] {
            let name = format!("random-pslg:kind=moved,seed={seed}");
            let pslg = gallery::pslg(&name).expect("a gallery name").expect("a gallery domain");
            certified(method, &pslg, "uniform:0.12", "moved");
        }
    }
}

#[test]
fn a_power_of_two_changes_nothing_but_the_scale() {
    for method in &methods() {
        for pslg in small_gallery() {
            let mesh = certified(method, &pslg, "lfs", "as it is");
            let larger = certified(method, &mapped(&pslg, |p| p * 1024.0), "lfs", "scaled by 1024");
            let (Some(mesh), Some(larger)) = (mesh, larger) else {
                continue;
            };
            assert_eq!(
                mesh.triangles.len(),
                larger.triangles.len(),
                "{} on {}",
                method.name,
                pslg.name
            );
        }
    }
}

#[test]
fn rotated_mirrored_and_shuffled() {
    for method in &methods() {
        for pslg in small_gallery() {
            for degrees in [17.0f64, 90.0, 123.0] {
                let turn = DVec2::from_angle(degrees.to_radians());
                certified(
                    method,
                    &mapped(&pslg, |p| turn.rotate(p)),
                    "lfs",
                    &format!("turned by {degrees} degrees"),
                );
            }
            certified(method, &mapped(&pslg, |p| DVec2::new(-p.x, p.y)), "lfs", "mirrored");
            certified(method, &shuffled(&pslg, 5), "lfs", "shuffled");
        }
    }
}

#[test]
fn bit_equal_when_run_twice_and_with_any_number_of_threads() {
    for method in &methods() {
        for pslg in small_gallery() {
            let case = case(&pslg, "lfs");
            let meshes = [1, 1, 2, 4].map(|threads| run(method, &case, threads));
            for mesh in &meshes[1..] {
                assert_eq!(mesh, &meshes[0], "{} on {}", method.name, pslg.name);
            }
        }
    }
}

#[test]
fn a_budget_ends_in_an_error_that_says_where() {
    for method in &methods() {
        let plate = gallery::pslg("plate-hole").expect("a gallery name").expect("a domain");
        let case = case(&plate, "lfs");
        let request = Request {
            budget: Budget {
                max_vertices: Some(100),
                ..Budget::default()
            },
            ..request(1)
        };
        let stopped = case.mesh_as(&*method.make(), &request, &mut Trace::default());
        match stopped {
            Err(MeshError::Budget { budget, vertices, .. }) => {
                assert!(
                    budget.contains("max_vertices = 100") && vertices > 100,
                    "{budget}, {vertices}"
                );
            }
            other => panic!("{}: {other:?}", method.name),
        }
    }
}

/// A spacing that is not positive and finite on one half of the unit square.
struct Broken(f64);

impl Spacing for Broken {
    fn at(&self, x: DVec2) -> f64 {
        if x.x < 0.5 { 0.1 } else { self.0 }
    }

    fn lipschitz(&self) -> f64 {
        0.1
    }
}

#[test]
fn a_spacing_that_is_not_positive_is_reported_with_the_place() {
    let pslg = gallery::pslg("unit-square").expect("a gallery name").expect("a domain");
    let square = Domain::new(pslg).expect("a valid domain");
    for method in &methods() {
        let mesher = method.make();
        for value in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
            let result = mesher.mesh(&square, &Broken(value), &request(1), &mut Trace::default());
            let is_reported = matches!(result, Err(MeshError::Spacing { x, .. }) if x >= 0.5);
            assert!(is_reported, "{} with {value}: {result:?}", method.name);
        }
        let result = mesher.mesh(&square, &Broken(1e-14), &request(1), &mut Trace::default());
        let is_reported = matches!(&result, Err(MeshError::Declined(reason)) if reason.contains("resolve"));
        assert!(is_reported, "{}: {result:?}", method.name);
    }
}

#[test]
fn parameters_are_as_listed() {
    for entry in MESHERS {
        for parameter in entry.parameters {
            let of = |value: &str| Parameters::from_iter([(parameter.name.to_owned(), parameter_value(value))]);
            assert!(
                (entry.make)(&of(parameter.default)).is_ok(),
                "{} {}",
                entry.name,
                parameter.name
            );
            let refused = (entry.make)(&of("no such value")).err().expect("refused");
            assert!(refused.contains("no such value"), "{refused}");
        }
        let unknown = Parameters::from_iter([("nonsense".to_owned(), serde_json::Value::Null)]);
        assert!((entry.make)(&unknown).err().expect("refused").contains("nonsense"));
    }
}
