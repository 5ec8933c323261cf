//! The front's invariants, opening up, and the last resort.

use super::super::front::{NONE, OPEN};
use super::*;

/// The front bounds exactly what is not meshed. Its edges have that on their left, are linked in loops, and lie against
/// sides of triangles; each side of a triangle is on the front, a piece, or shared by two; areas sum to the domain's.
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

/// Closes what is left by force, and checks the structure of the mesh.
fn assert_closes_to_a_mesh(mut front: Front, pieces: Vec<Piece>) -> Mesh {
    front.close_by_force().expect("closed");
    assert_eq!(front.length, 0);
    let domain = front.domain;
    let mesh = front.into_mesh(pieces);
    assert_is_mesh(domain, &mesh);
    mesh
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

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
