//! Rounds on small domains, and the independent set by definition.

use crate::spacing::Uniform;
use crate::suite::run::adapt::*;
use crate::suite::run::prepare::Store;

fn cell(domain: &str, problem: &str, adapt: Adapt) -> Cell {
    Cell {
        poisson: Some(problem.into()),
        adapt: Some(adapt),
        ..Cell::new(domain, "biting", "lfs", 0.25, 0.75)
    }
}

fn adapt(eps: f64) -> Adapt {
    Adapt {
        eps,
        rounds: 6,
        sample: false,
    }
}

#[test]
fn an_adapted_mesh_is_fine_where_the_solution_is_steep() {
    let store = Store::new(None, false);
    let prepared = store
        .prepare_for_t(&cell("unit-square", "boundary-layer", adapt(2e-2)))
        .unwrap();
    let at = |x: f64| prepared.spacing.function.at(DVec2::new(x, 0.5));
    assert!(at(0.01) < 0.2 * at(0.8), "{} {}", at(0.01), at(0.8));
    let (first, last) = (&prepared.rounds[0], prepared.rounds.last().unwrap());
    assert!(
        prepared.rounds.len() > 1 && last.l2_error < 0.5 * first.l2_error,
        "{:?}",
        prepared.rounds
    );
    assert!(
        prepared
            .rounds
            .iter()
            .all(|round| round.independent > 0 && round.kept <= round.vertices)
    );
    assert!(first.kept == 0 && last.kept >= 4, "{:?}", prepared.rounds);
}

#[test]
fn rounds_are_the_same_every_time_and_sampling_differs() {
    let rounds = |sample: bool| {
        let asked = Adapt { sample, ..adapt(3e-2) };
        let store = Store::new(None, false);
        store.prepare_for_t(&cell("l-shape", "corner", asked)).unwrap().rounds
    };
    assert_eq!(rounds(false), rounds(false));
    assert_ne!(rounds(false), rounds(true));
}

#[test]
fn what_cannot_be_adapted_is_told() {
    let told = |cell: &Cell| Store::new(None, false).prepare_for_t(cell).err().unwrap().to_string();
    let good = cell("unit-square", "smooth", adapt(0.1));
    let without = Cell {
        poisson: None,
        ..good.clone()
    };
    assert_eq!(
        told(&without),
        "on unit-square: adaptation needs a problem with a known u"
    );
    assert!(told(&cell("unit-square", "wave", adapt(0.1))).contains("problem `wave` is unknown"));
    assert!(told(&cell("unit-square", "smooth", adapt(0.0))).contains("eps = 0 must be positive"));
    let none = Adapt {
        rounds: 0,
        ..adapt(0.1)
    };
    assert!(told(&cell("unit-square", "smooth", none)).contains("rounds = 0 would adapt nothing"));
}

#[test]
fn an_independent_set_is_maximal_and_apart() {
    let points: Vec<DVec2> = (0..400)
        .map(|k| DVec2::new((0.618_033_988_7 * f64::from(k)).fract(), f64::from(k) / 400.0))
        .collect();
    let kept = independent(&points, &Uniform(0.2), 0.5);
    let apart = |a: usize, b: usize| points[a].distance(points[b]) >= 0.1 * (1.0 - 1e-12);
    for &a in &kept {
        assert!(kept.iter().all(|&b| a == b || apart(a, b)));
    }
    for k in 0..points.len() {
        assert!(
            kept.contains(&k) || kept.iter().any(|&b| !apart(k, b)),
            "{k} could be kept"
        );
    }
    assert!(kept[0] == 0 && kept.len() < 200);
}
