//! Elements one at a time and by rows, smoothing and swaps.

use super::*;
use crate::theory::Claim;

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
fn rows_close_small_openings_at_once() {
    let (.., trace) = meshed(&ROWS, &domain("koch"), "uniform:0.03");
    assert!(counted(&trace, "closures") > 0.0);
    let (.., trace) = meshed(&AdvancingFront::DEFAULT, &domain("koch"), "uniform:0.03");
    assert_eq!(counted(&trace, "closures"), 0.0);
}

#[test]
fn a_row_is_made_whole_before_the_next() {
    advanced(&ROWS, &domain("unit-square"), "uniform:0.1", 0, |mut front, _| {
        // Among faces that are not clefts, those of a row come after all those of the rows before it.
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
            certificate.check(Claim::ConstrainedDelaunay).expect("a check").holds,
            "{name}"
        );
        assert!(swapped.min_angle_deg >= plain.min_angle_deg);
        let (_, both, certificate, _) = improved(3, true);
        assert!(
            certificate.check(Claim::ConstrainedDelaunay).expect("a check").holds,
            "{name}"
        );
        assert!(both.mean_min_angle_deg > swapped.mean_min_angle_deg);
    }
}
