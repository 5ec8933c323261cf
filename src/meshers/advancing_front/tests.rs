//! What the certificate does not see: the front's invariants, the modes, seams, opening up, the last resort.

use super::front::{NONE, OPEN};
use super::*;
use crate::domain::gallery;
use crate::mesh::Piece;
use crate::meshers::Budget;
use crate::meshers::Parameters;
use crate::quality::{Certificate, Statistics, judge};
use crate::spacing::{Options, Prepared, build};
use proptest::prelude::*;

fn request(c_b: f64) -> Request {
    Request {
        c_b,
        seed: 0,
        threads: 1,
        budget: Budget {
            max_vertices: Some(200_000),
            ..Budget::default()
        },
    }
}

fn domain(name: &str) -> Domain {
    gallery::domain(name).expect("a gallery name").expect("a valid domain")
}

fn prepared(domain: &Domain, spec: &str) -> Prepared {
    let options = Options {
        lfs_cap: false,
        ..Options::with_alpha(0.5)
    };
    build(spec, domain, &options).expect("a spacing")
}

/// Meshes with c_b = 1 and has the structure judged.
fn meshed(method: &AdvancingFront, domain: &Domain, spec: &str) -> (Mesh, Statistics, Certificate, Trace) {
    let mut trace = Trace::default();
    let spacing = prepared(domain, spec).function;
    let mesh = method
        .mesh(domain, &*spacing, &request(1.0), &mut trace)
        .expect("a mesh");
    let (statistics, certificate) = assert_is_mesh(domain, &mesh);
    (mesh, statistics, certificate, trace)
}

const ROWS: AdvancingFront = AdvancingFront {
    advance: Advance::Row,
    ..AdvancingFront::DEFAULT
};

fn counted(trace: &Trace, name: &str) -> f64 {
    trace
        .counts
        .iter()
        .find(|(known, _)| *known == name)
        .expect("a count")
        .1
}

/// Calls `with` with the front of a domain that has advanced `steps` faces, and the pieces of the boundary.
fn advanced<T>(
    method: &AdvancingFront,
    domain: &Domain,
    spec: &str,
    steps: usize,
    with: impl FnOnce(Front, Vec<Piece>) -> T,
) -> T {
    let spacing = prepared(domain, spec).function;
    let request = request(1.0);
    let sizing = Sizing::new(domain, &*spacing, &request);
    let mut front = Front::new(method, domain, sizing, Monitor::new(&request.budget));
    let pieces = boundary::boundary(&mut front).expect("a boundary");
    for _ in 0..steps {
        if let Some(face) = front.pick_face() {
            advance_face(&mut front, &face).expect("a step");
        }
    }
    with(front, pieces)
}

/// The front bounds exactly what is not meshed: its edges turn with it on their left, link up, and stand against sides of
/// triangles; sides of triangles are front, or piece, or shared by two; areas sum to the domain's.
fn assert_front_bounds_the_rest(front: &Front) {
    let mut rest = 0.0;
    let mut length = 0;
    for slot in front.live() {
        let edge = front.edge(slot);
        length += 1;
        rest += 0.5 * front.at(edge.from).perp_dot(front.at(edge.to));
        assert_eq!(front.edge(edge.next).before, slot);
        assert_eq!(front.edge(edge.next).from, edge.to);
        assert_eq!(front.edge(edge.next).face, edge.face);
        assert_ne!(front.edge(edge.next).serial, NONE);
        if edge.right != NONE {
            let triangle = &front.triangles[edge.right as usize];
            let side = triangle
                .side(edge.to, edge.from)
                .expect("a side of the triangle on the right");
            assert_eq!(triangle.across[side], OPEN);
        }
    }
    assert_eq!(length, front.length);
    let mut meshed = 0.0;
    for (index, triangle) in (0u32..)
        .zip(&front.triangles)
        .filter(|(_, triangle)| !triangle.is_deleted())
    {
        let [a, b, c] = triangle.corners.map(|corner| front.at(corner));
        meshed += 0.5 * (b - a).perp_dot(c - a);
        for side in 0..3 {
            let (from, to) = (triangle.corners[side], triangle.corners[(side + 1) % 3]);
            match triangle.across[side] {
                NONE => assert!(
                    !front
                        .leaving(to)
                        .any(|edge| front.edge(edge).to == from && front.edge(edge).right == index)
                ),
                OPEN => assert_eq!(front.between(to, from).map(|edge| front.edge(edge).right), Some(index)),
                other => {
                    let other = &front.triangles[other as usize];
                    let back = other.side(to, from).expect("a shared side");
                    assert_eq!(other.across[back], index);
                }
            }
        }
    }
    let area = front.domain.area();
    assert!(
        (meshed + rest - area).abs() < 1e-9 * area,
        "{meshed} + {rest} is not {area}"
    );
}

/// Closes what is left by force and holds the mesh to its structure.
fn assert_closes_to_a_mesh(mut front: Front, pieces: Vec<Piece>) -> Mesh {
    front.close_by_force().expect("closed");
    assert_eq!(front.length, 0);
    let domain = front.domain;
    let mesh = front.into_mesh(pieces);
    assert_is_mesh(domain, &mesh);
    mesh
}

fn assert_is_mesh(domain: &Domain, mesh: &Mesh) -> (Statistics, Certificate) {
    let (statistics, certificate) = judge(domain, mesh, None);
    let is_broken = |check: &&crate::quality::Check| !check.holds && check.claim != "constrained-delaunay";
    let broken: Vec<_> = certificate.checks.iter().filter(is_broken).collect();
    assert!(broken.is_empty(), "{broken:#?}");
    (statistics, certificate)
}

/// Found on the slanted sides of `two-arms`: a new side ran along three nodes that rounding put on one line, its middle
/// node saw nothing of a side that it lay on, and triangles of 0° filled what was left.
#[test]
fn a_side_along_three_collinear_nodes_is_no_side() {
    let domain = domain("two-arms");
    let spacing = build("lfs", &domain, &Options::new(0.5, 0.6))
        .expect("a spacing")
        .function;
    let mut trace = Trace::default();
    let mesh = AdvancingFront::DEFAULT.mesh(&domain, &*spacing, &request(0.6), &mut trace);
    let (statistics, _) = assert_is_mesh(&domain, &mesh.expect("a mesh"));
    assert_eq!(counted(&trace, "closed_by_force"), 0.0);
    assert!(statistics.min_angle_deg > 5.0, "{}", statistics.min_angle_deg);
}

#[test]
fn the_front_always_bounds_what_is_not_meshed() {
    for method in [AdvancingFront::DEFAULT, ROWS] {
        for name in ["interface", "plate-hole", "random-simple"] {
            let domain = domain(name);
            for steps in [0, 1, 2, 3, 10, 50, 90, 140] {
                advanced(&method, &domain, "uniform:0.09", steps, |front, _| {
                    assert_front_bounds_the_rest(&front);
                });
            }
        }
    }
}

#[test]
fn what_is_left_is_closed_by_force() {
    for name in ["unit-square", "interface", "plate-hole", "star", "random-simple"] {
        let domain = domain(name);
        for steps in [0, 1, 7, 40] {
            advanced(
                &AdvancingFront::DEFAULT,
                &domain,
                "uniform:0.15",
                steps,
                |front, pieces| {
                    let made = front.triangles.len();
                    let mesh = assert_closes_to_a_mesh(front, pieces);
                    assert!(steps > 1 || mesh.triangles.len() > made, "{name}");
                },
            );
        }
    }
}

#[test]
fn the_front_can_be_opened_up_anywhere_and_closes_again() {
    for name in ["interface", "plate-hole", "random-simple"] {
        let domain = domain(name);
        for steps in [5, 20, 45] {
            advanced(
                &AdvancingFront::DEFAULT,
                &domain,
                "uniform:0.08",
                steps,
                |mut front, pieces| {
                    let behind = |front: &Front| front.live().find(|&edge| front.edge(edge).right != NONE);
                    let is_begun = behind(&front).is_some();
                    for _ in 0..5 {
                        let Some(face) = behind(&front) else { break };
                        let base = front.ideal_point(face);
                        if front.open_up(&base) {
                            assert_front_bounds_the_rest(&front);
                        }
                    }
                    assert_eq!(
                        is_begun,
                        front.tally.opened > 0 && front.tally.reopened_elements > 0,
                        "{name} {steps}"
                    );
                    advance_until_empty(&mut front).expect("an empty front");
                    assert_front_bounds_the_rest(&front);
                    assert_eq!(front.length, 0, "nothing is left to be forced");
                    assert_closes_to_a_mesh(front, pieces);
                },
            );
        }
    }
}

#[test]
fn a_place_is_opened_up_twice_at_most() {
    let domain = domain("unit-square");
    advanced(&AdvancingFront::DEFAULT, &domain, "uniform:0.1", 60, |mut front, _| {
        let face = front
            .live()
            .find(|&edge| front.edge(edge).right != NONE)
            .expect("a face");
        let base = front.ideal_point(face);
        let mut times = 0;
        for _ in 0..5 {
            times += usize::from(front.open_up(&base));
            for _ in 0..20 {
                if let Some(face) = front.pick_face() {
                    advance_face(&mut front, &face).expect("a step");
                }
            }
        }
        assert!(times <= 2, "{times}");
    });
}

#[test]
fn a_uniform_square_is_mostly_equilateral() {
    for method in [AdvancingFront::DEFAULT, ROWS] {
        let (_, statistics, ..) = meshed(&method, &domain("unit-square"), "uniform:0.02");
        assert!(
            statistics.mean_min_angle_deg > 57.0,
            "{}",
            statistics.mean_min_angle_deg
        );
        assert!(statistics.min_angle_deg > 20.0, "{}", statistics.min_angle_deg);
    }
}

#[test]
fn segments_are_cut_into_equal_parts_of_the_integral() {
    let domain = domain("unit-square");
    // On the lower side the integral of 1 / (0.1 + 0.1 x) is 10 ln 2 = 6.93: 7 pieces, each a seventh of it.
    advanced(&AdvancingFront::DEFAULT, &domain, "expr: 0.1 + 0.1*x", 0, |front, _| {
        let mut xs: Vec<f64> = front
            .nodes
            .iter()
            .map(|node| node.at)
            .filter(|p| p.y == 0.0)
            .map(|p| p.x)
            .collect();
        xs.sort_by(f64::total_cmp);
        assert_eq!(xs.len(), 8);
        for (k, x) in xs.into_iter().enumerate() {
            let expected = 2f64.powf(k as f64 / 7.0) - 1.0;
            assert!((x - expected).abs() < 2e-3, "{x} is not {expected}");
        }
    });
}

#[test]
fn fronts_of_a_ring_meet_in_its_middle() {
    let domain = domain("annulus");
    let (mesh, ..) = meshed(&AdvancingFront::DEFAULT, &domain, "uniform:0.02");
    let radii: Vec<f64> = mesh
        .points
        .iter()
        .map(|p| p.distance(domain.bounds().centre()))
        .collect();
    let (low, high) = (
        radii.iter().copied().fold(f64::INFINITY, f64::min),
        radii.iter().copied().fold(0.0, f64::max),
    );
    assert!(
        !mesh.seams.is_empty() && mesh.seams.len() < mesh.triangles.len() / 2,
        "{}",
        mesh.seams.len()
    );
    assert!(mesh.seams.windows(2).all(|pair| pair[0] < pair[1]));
    let near_boundary = mesh.seams.iter().filter(|&&t| {
        let corners = mesh.triangles[t as usize];
        corners
            .iter()
            .any(|&corner| radii[corner as usize] < low + 1e-9 || radii[corner as usize] > high - 1e-9)
    });
    assert!(
        near_boundary.count() * 4 < mesh.seams.len(),
        "fronts meet away from the boundary"
    );
}

#[test]
fn rows_close_small_openings_at_once() {
    let (.., trace) = meshed(&ROWS, &domain("koch"), "uniform:0.03");
    assert!(counted(&trace, "closures") > 0.0);
    let (.., trace) = meshed(&AdvancingFront::DEFAULT, &domain("koch"), "uniform:0.03");
    assert_eq!(counted(&trace, "closures"), 0.0);
}

#[test]
fn a_row_is_made_whole_before_the_next() {
    advanced(&ROWS, &domain("unit-square"), "uniform:0.1", 0, |mut front, _| {
        // Among faces that are no clefts, those of a row come after all of the rows before it.
        let mut latest = 0;
        while let Some(face) = front.pick_face() {
            if front.edge(face.base.edge).attempts == 0 && !face.is_cleft() {
                let row = front.edge(face.base.edge).row;
                assert!(row + 2 >= latest, "row {row} after {latest}");
                latest = latest.max(row);
            }
            advance_face(&mut front, &face).expect("a step");
        }
        assert!(latest >= 4, "{latest}");
    });
}

#[test]
fn smoothing_and_swaps_improve_the_mesh() {
    for name in ["plate-hole", "interface", "random-simple"] {
        let domain = domain(name);
        let improved = |smooth, swap| {
            let method = AdvancingFront {
                smooth,
                swap,
                ..AdvancingFront::DEFAULT
            };
            meshed(&method, &domain, "expr: 0.04 + 0.1*(x*x + y*y)")
        };
        let (mesh, plain, ..) = improved(0, false);
        let (smooth_mesh, smooth, ..) = improved(3, false);
        assert_eq!(smooth_mesh.triangles, mesh.triangles, "smoothing moves nodes only");
        assert_eq!(smooth_mesh.pieces, mesh.pieces);
        assert!(smooth.min_angle_deg >= plain.min_angle_deg && smooth.mean_min_angle_deg > plain.mean_min_angle_deg);
        let (swapped_mesh, swapped, certificate, _) = improved(0, true);
        assert_eq!(swapped_mesh.points, mesh.points, "swaps move no node");
        assert!(
            certificate.check("constrained-delaunay").expect("a check").holds,
            "{name}"
        );
        assert!(swapped.min_angle_deg >= plain.min_angle_deg);
        let (_, both, certificate, _) = improved(3, true);
        assert!(
            certificate.check("constrained-delaunay").expect("a check").holds,
            "{name}"
        );
        assert!(both.mean_min_angle_deg > swapped.mean_min_angle_deg);
    }
}

#[test]
fn parameters_out_of_range_are_refused() {
    for (name, value) in [
        ("search", 0.1),
        ("cleft", 150.0),
        ("accept", -1.0),
        ("low", 0.2),
        ("high", 0.5),
        ("smooth", 1e4),
    ] {
        let value = if name == "smooth" {
            serde_json::json!(value as u32)
        } else {
            serde_json::json!(value)
        };
        let refused = (ENTRY.make)(&Parameters::from_iter([(name.to_owned(), value)]))
            .err()
            .expect("refused");
        assert!(refused.contains(name) && refused.contains("from"), "{refused}");
    }
}

/// A spacing that breaks its promise in the middle of the square.
struct Broken(f64);

impl Spacing for Broken {
    fn at(&self, x: crate::geometry::DVec2) -> f64 {
        if x.distance(crate::geometry::DVec2::splat(0.5)) > 0.25 {
            0.1
        } else {
            self.0
        }
    }

    fn lipschitz(&self) -> f64 {
        0.1
    }
}

#[test]
fn a_spacing_that_breaks_its_promise_is_told_with_the_place() {
    for value in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        let told = AdvancingFront::DEFAULT.mesh(
            &domain("unit-square"),
            &Broken(value),
            &request(1.0),
            &mut Trace::default(),
        );
        assert!(
            matches!(told, Err(MeshError::Spacing { x, y, .. }) if (x - 0.5).hypot(y - 0.5) <= 0.25),
            "{value}: {told:?}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Any domain, any size: much larger than the features, much smaller, steeply graded.
    #[test]
    fn every_mesh_is_valid(
        seed in 0..1000u32,
        corners in 4..24usize,
        low in 0.01..0.5f64,
        slope in 0.0..0.5f64,
        by_rows in any::<bool>(),
        centre in (0.0..1.0f64, 0.0..1.0f64),
    ) {
        let domain = domain(&format!("random-simple:n={corners},seed={seed}"));
        let spec = format!("expr: {low} + {slope}*sqrt((x-{})^2 + (y-{})^2 + 0.0001)", centre.0, centre.1);
        let method = if by_rows { ROWS } else { AdvancingFront::DEFAULT };
        let (mesh, ..) = meshed(&method, &domain, &spec);
        prop_assert!(!mesh.triangles.is_empty());
    }

    /// The invariant of the front holds at any moment, on any domain.
    #[test]
    fn the_front_bounds_the_rest_at_any_moment(seed in 0..1000u32, steps in 0..200usize, size in 0.03..0.3f64) {
        let domain = domain(&format!("random-simple:n=14,seed={seed}"));
        advanced(&AdvancingFront::DEFAULT, &domain, &format!("uniform:{size}"), steps, |front, pieces| {
            assert_front_bounds_the_rest(&front);
            assert_closes_to_a_mesh(front, pieces);
        });
    }
}
