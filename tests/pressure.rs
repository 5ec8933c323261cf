//! Domains and spacings under pressure, by every mesher: each ends in a certified mesh or in an error that names the place.
//! Found cases have tests named after them; the heavy ones are in `.ci/pressure`.

use biting::Case;
use biting::domain::{Domain, Fill, InputSegment, Pslg};
use biting::geometry::DVec2;
use biting::meshers::{Budget, Entry, MESHERS, MeshError, Mesher, Parameters, Request, Trace};
use biting::spacing::Spacing;

const T: f64 = 0.25;
const C_B: f64 = 0.75;

/// A domain of closed rings; rings after the first are holes.
fn rings(rings: &[&[(f64, f64)]]) -> Pslg {
    let mut pslg = Pslg {
        name: "pressed".into(),
        ..Pslg::default()
    };
    let mut flips = Vec::new();
    for ring in rings {
        let first = pslg.vertices.len();
        pslg.vertices.extend(ring.iter().map(|&(x, y)| DVec2::new(x, y)));
        let count = ring.len();
        pslg.segments.extend((0..count).map(|k| InputSegment {
            a: first + k,
            b: first + (k + 1) % count,
            marker: 1,
        }));
        flips.extend(std::iter::repeat_n(true, count));
    }
    pslg.fill = Fill::EvenOdd { flips };
    pslg
}

/// A pentagon with a triangular hole, no side along an axis.
fn house(scale: f64, offset: f64) -> Pslg {
    let moved = |ring: &[(f64, f64)]| -> Vec<(f64, f64)> {
        ring.iter()
            .map(|&(x, y)| (scale * x + offset, scale * y + offset))
            .collect()
    };
    let walls = moved(&[(0.1, 0.0), (1.3, 0.2), (1.1, 0.9), (0.6, 1.4), (0.0, 0.8)]);
    let door = moved(&[(0.5, 0.4), (0.8, 0.5), (0.6, 0.7)]);
    rings(&[&walls, &door])
}

fn request() -> Request {
    Request {
        c_b: C_B,
        seed: 0,
        threads: 1,
        budget: Budget {
            max_vertices: Some(50_000),
            ..Budget::default()
        },
    }
}

fn mesher(entry: &Entry) -> Box<dyn Mesher> {
    (entry.make)(&Parameters::new()).expect("defaults are valid")
}

/// For every mesher, either its mesh is certified or the error is returned; one error if there is no spacing.
fn pressed(pslg: &Pslg) -> Vec<Result<(), String>> {
    let made = Domain::new(pslg.clone())
        .map_err(|error| error.to_string())
        .and_then(|domain| Case::new(domain, "lfs", T, C_B).map_err(|error| error.to_string()));
    let case = match made {
        Ok(case) => case,
        Err(error) => return vec![Err(error)],
    };
    let by = |entry: &Entry| {
        let mesher = mesher(entry);
        let mesh = match case.mesh_as(&*mesher, &request(), &mut Trace::default()) {
            Ok(mesh) => mesh,
            Err(error @ (MeshError::Declined(_) | MeshError::Budget { .. })) => return Err(error.to_string()),
            Err(error) => panic!("{}: {error}", entry.name),
        };
        let (_, certificate) = case.judge_of(&mesh, &*mesher);
        let broken: Vec<_> = certificate.broken().collect();
        assert!(broken.is_empty(), "{}: {broken:#?}", entry.name);
        Ok(())
    };
    MESHERS.iter().map(by).collect()
}

fn all_certified(pslg: &Pslg, what: &str) {
    for result in pressed(pslg) {
        assert_eq!(result, Ok(()), "{what}");
    }
}

fn all_refused(pslg: &Pslg, words: &str) {
    for result in pressed(pslg) {
        let is_refused = matches!(&result, Err(text) if text.contains(words) && text.contains('('));
        assert!(is_refused, "{words}: {result:?}");
    }
}

#[test]
fn coordinates_from_a_millionth_of_a_millionth_to_a_million_millions() {
    for power in [-12, -9, 9, 12] {
        all_certified(&house(10f64.powi(power), 0.0), &format!("1e{power}"));
    }
}

/// Products of orientations underflowed to 0, so segments far apart counted as meeting.
#[test]
fn coordinates_too_small_for_any_test_are_refused() {
    all_refused(&house(1e-100, 0.0), "larger side is");
    all_refused(&house(1e100, 0.0), "1e60");
}

/// Points on slanted segments are rounded to 1e-7: the area changed by more than its check allowed.
#[test]
fn unit_features_at_an_offset_of_1e9() {
    all_certified(&house(1.0, 1e6), "1e6");
    all_certified(&house(1.0, 1e9), "1e9");
}

/// The integral of 1 / lfs² never converged where features are noise.
#[test]
fn unit_features_at_an_offset_of_1e15_are_refused() {
    all_refused(&house(1.0, 1e15), "too small to resolve");
}

const TOP: [(f64, f64); 3] = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];

fn with_top(bottom: &[(f64, f64)]) -> Vec<(f64, f64)> {
    [bottom, &TOP].concat()
}

/// At 1e-9 packing circles are so small that rounding brings their centres nearer than their radii allow.
#[test]
fn two_vertices_nearly_repeated() {
    for d in [1e-6, 1e-9, 1e-12] {
        all_certified(
            &rings(&[&with_top(&[(0.0, 0.0), (0.5, 0.0), (0.5 + d, 0.0)])]),
            &format!("{d:e}"),
        );
    }
    all_refused(&rings(&[&with_top(&[(0.0, 0.0), (0.5, 0.0), (0.5, 0.0)])]), "both at");
    all_refused(
        &rings(&[&with_top(&[(0.0, 0.0), (0.5, 0.0), (0.5 + 1e-15, 0.0)])]),
        "too small to resolve",
    );
}

#[test]
fn a_vertex_nearly_on_the_line_of_its_neighbours() {
    for d in [1e-6, 1e-9, 1e-12, -1e-6, -1e-9, -1e-12] {
        all_certified(&rings(&[&with_top(&[(0.0, 0.0), (0.37, d)])]), &format!("{d:e}"));
    }
}

#[test]
fn a_hole_that_nearly_touches_a_side() {
    let near = |d: f64| rings(&[&with_top(&[(0.0, 0.0)]), &[(0.4, d), (0.6, 0.3), (0.3, 0.4)]]);
    for d in [1e-6, 1e-9] {
        all_certified(&near(d), &format!("{d:e}"));
    }
    // The error was "must be positive" before, and at 1e-15 there was none.
    for d in [1e-12, 1e-15] {
        all_refused(&near(d), "too small to resolve");
    }
    all_refused(&near(0.0), "lies on");
}

#[test]
fn a_hole_of_a_millionth_and_of_a_thousand_millionth() {
    for d in [1e-6, 1e-9] {
        let at = |x: f64, y: f64| (0.5 + d * x, 0.5 + d * y);
        let speck = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        all_certified(&rings(&[&with_top(&[(0.0, 0.0)]), &speck]), &format!("{d:e}"));
    }
}

/// A spacing that jumps from 0.1 to a smaller value, and returns a Lipschitz constant that denies it.
struct Jump(f64);

impl Spacing for Jump {
    fn at(&self, x: DVec2) -> f64 {
        if x.x < 0.5 { 0.1 } else { self.0 }
    }

    fn lipschitz(&self) -> f64 {
        0.1
    }
}

/// Reported where two vertices show it, with both points and values.
#[test]
fn a_spacing_that_breaks_its_constant_is_reported_with_both_points() {
    let square = Domain::new(rings(&[&with_top(&[(0.0, 0.0)])])).expect("a valid domain");
    for entry in MESHERS {
        for value in [0.3, 0.03, 0.01] {
            match mesher(entry).mesh(&square, &Jump(value), &request(), &mut Trace::default()) {
                Err(MeshError::NotLipschitz { points, values, alpha }) => {
                    assert_eq!(values, points.map(|x| Jump(value).at(x)), "{}", entry.name);
                    assert!((values[0] - values[1]).abs() > alpha * points[0].distance(points[1]));
                }
                other => panic!("{} with {value}: {other:?}", entry.name),
            }
        }
    }
}

/// NaN, 0 and a negative value on the right half.
#[test]
fn a_spacing_that_is_not_positive_is_reported_with_the_place() {
    let square = Domain::new(rings(&[&with_top(&[(0.0, 0.0)])])).expect("a valid domain");
    for entry in MESHERS {
        for bad in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
            match mesher(entry).mesh(&square, &Jump(bad), &request(), &mut Trace::default()) {
                Err(MeshError::Spacing { value, x, .. }) => {
                    assert!(value.to_bits() == bad.to_bits() && x >= 0.5, "{}", entry.name)
                }
                other => panic!("{} with {bad}: {other:?}", entry.name),
            }
        }
    }
}

/// The smallest number that spade takes is 2e-43; below that the error was "triangulation: TooSmall".
#[test]
fn coordinates_that_are_nearly_zero_are_refused_with_line_and_remedy() {
    all_refused(&house(1e-60, 0.0), "larger side is");
    let mut tilted = house(1.0, 0.0);
    tilted.vertices[0].y = 1e-50;
    all_refused(&tilted, "write 0");
    all_certified(&house(1e-20, 0.0), "1e-20");
    all_certified(&house(1e50, 0.0), "1e50");
}
