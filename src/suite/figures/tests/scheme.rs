//! Figure 1.

use super::super::figure1::{self, Figure1};
use super::{is_inside, is_on_circle, is_on_segment};
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use crate::meshers::Reason;
use std::sync::OnceLock;

fn figure() -> &'static Figure1 {
    static FIGURE: OnceLock<Figure1> = OnceLock::new();
    FIGURE.get_or_init(|| figure1::find().unwrap())
}

fn eaten(discs: &[Disc], point: DVec2, share: f64) -> bool {
    discs
        .iter()
        .any(|disc| point.distance(disc.centre) < share * disc.radius)
}

#[test]
fn every_arc_of_the_front_is_uncovered_and_in_the_domain() {
    let Figure1 { run, panels } = figure();
    for panel in panels {
        let discs = run.discs(panel.bitten);
        for (k, arc) in &panel.front_arcs {
            for point in (1..20).map(|k| arc.at(f64::from(k) / 20.0)) {
                assert!(
                    is_on_circle(point, &discs[*k]) && is_inside(run, point),
                    "{}: {point}",
                    panel.title
                );
                assert!(!eaten(&discs, point, 1.0 - 1e-8), "{}: {point} is eaten", panel.title);
            }
        }
        for piece in &panel.front_pieces {
            for point in (1..20).map(|k| piece[0].lerp(piece[1], f64::from(k) / 20.0)) {
                assert!(!eaten(&discs, point, 1.0 - 1e-8), "{}: {point} is eaten", panel.title);
                let segments = 0..run.case.domain.segments().len();
                let mut ends = segments.map(|segment| run.case.domain.ends(segment));
                assert!(ends.any(|ends| is_on_segment(point, ends)), "{}: {point}", panel.title);
            }
        }
    }
}

/// The front is the boundary of what is left: on every circle, points that nothing covers belong to an arc of it.
#[test]
fn no_arc_of_the_front_is_missing() {
    let Figure1 { run, panels } = figure();
    for panel in panels {
        let discs = run.discs(panel.bitten);
        for (k, disc) in discs.iter().enumerate() {
            for step in 0..720 {
                let angle = f64::from(step).to_radians() / 2.0;
                let point = disc.centre + disc.radius * DVec2::from_angle(angle);
                if !is_inside(run, point) || eaten(&discs, point, 1.0 - 1e-6) {
                    continue;
                }
                let mut own = panel.front_arcs.iter().filter(|(circle, _)| *circle == k);
                let holds =
                    own.any(|(_, arc)| (angle - arc.start + 1e-3).rem_euclid(std::f64::consts::TAU) < arc.sweep + 2e-3);
                assert!(holds, "{}: {point} on circle {k}", panel.title);
            }
        }
    }
}

#[test]
fn panels_stop_where_the_paper_does() {
    let Figure1 { run, panels } = figure();
    let vertices = run.case.domain.vertices();
    let counts: Vec<usize> = panels.iter().map(|panel| panel.bitten).collect();
    assert_eq!(counts[..3], [0, vertices.len(), vertices.len() + 1]);
    let centres = |range: std::ops::Range<usize>| run.bites[range].iter().map(|bite| bite.centre);
    assert!(centres(0..counts[1]).all(|centre| vertices.contains(&centre)));
    let boundary =
        |centre: DVec2| (0..run.case.domain.segments().len()).any(|s| is_on_segment(centre, run.case.domain.ends(s)));
    assert!(centres(counts[1]..counts[3]).all(|centre| boundary(centre) && !vertices.contains(&centre)));
    assert!(centres(counts[3]..counts[5]).all(|centre| !boundary(centre)));
    assert_eq!(counts[4], counts[3] + 1);
    let pieces: Vec<usize> = panels.iter().map(|panel| panel.front_pieces.len()).collect();
    assert!(pieces[0] == vertices.len() && pieces[2] > 0, "{pieces:?}");
    assert_eq!(pieces[3..], [0, 0, 0], "a layer of the boundary leaves none of it");
}

#[test]
fn every_centre_is_on_the_front_when_it_is_bitten() {
    let run = &figure().run;
    for (k, bite) in run.bites.iter().enumerate() {
        let before = run.discs(k);
        assert!(!eaten(&before, bite.centre, 1.0 - 1e-8), "bite {k} at an eaten point");
        if bite.reason == Reason::FrontVertex {
            let on = before.iter().filter(|disc| is_on_circle(bite.centre, disc)).count();
            assert!(on >= 2, "bite {k} is on {on} circles");
        }
    }
}

/// A layer of the interior: its centres lie on circles of the layer before, and of no later one.
#[test]
fn a_layer_stands_on_the_one_before() {
    let Figure1 { run, panels } = figure();
    let (from, to) = (panels[3].bitten, panels[5].bitten);
    let layers = figure1::layers(&run.bites);
    assert!(layers[..from].iter().all(|layer| *layer == 0) && layers[from..to].iter().all(|layer| *layer == 1));
    assert!(to == run.bites.len() || layers[to] == 2);
    let boundary = run.discs(from);
    for bite in &run.bites[from..to] {
        let on = boundary.iter().filter(|disc| is_on_circle(bite.centre, disc)).count();
        assert!(on >= 2, "{} is on {on} boundary circles", bite.centre);
    }
    assert!(to - from > 5, "a layer of {} bites shows little", to - from);
}
