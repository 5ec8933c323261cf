//! The formulas by hand and by quadrature, and the names of claims.

use super::*;

fn at(rule: Rule, t: f64) -> Promises {
    Promises { rule, t }
}

#[test]
fn a_quarter_by_hand() {
    let (earlier, later) = (at(Rule::Earlier, 0.25), at(Rule::Later, 0.25));
    assert_eq!((earlier.least_sine(), later.least_sine()), (0.25, 0.375));
    assert_eq!(earlier.nn_at_vertices(), [0.75, 2.0 / 0.75]);
    assert_eq!(later.nn_at_vertices(), [0.8, 2.0 / 0.75]);
    assert_eq!(earlier.nn_at_points(), [0.4, 2.75 / 0.5625]);
    assert_eq!(later.nn_at_points(), [1.0 / 2.25, 3.25 / 0.75]);
    assert_eq!(earlier.most_eaten(), PI / 0.5625);
    assert!((later.most_eaten() / PI - 1.2058263184569888).abs() < 1e-12);
}

#[test]
fn without_t_the_rules_agree_and_from_one_on_nothing_is_above() {
    for t in [0.0, 1e-5] {
        let (earlier, later) = (at(Rule::Earlier, t), at(Rule::Later, t));
        assert!((earlier.least_sine() - later.least_sine()).abs() <= t);
        assert!((earlier.most_eaten() - later.most_eaten()).abs() <= 5.0 * t);
        assert!((earlier.nn_at_points()[1] - later.nn_at_points()[1]).abs() <= 5.0 * t);
    }
    for rule in [Rule::Earlier, Rule::Later] {
        let steep = at(rule, 1.0);
        assert_eq!(steep.nn_at_vertices()[1], f64::INFINITY);
        assert_eq!((steep.most_eaten(), steep.least_sine()), (f64::INFINITY, 0.0));
    }
}

#[test]
fn nothing_that_a_point_eats_holds_more_than_promised() {
    // By quadrature: along a ray g falls with slope t, then grows with slope t, so that the border of what is eaten is
    // at `end`.
    for t in [0.1, 0.25, 0.5, 0.75] {
        let most = at(Rule::Later, t).most_eaten();
        let held = |end: f64| {
            let count = 20_000;
            let step = end / f64::from(count);
            let ring = |k: i32| {
                let radius = (f64::from(k) + 0.5) * step;
                let g = (1.0 - t * radius).max(end - t * (end - radius));
                2.0 * PI * radius * step / (g * g)
            };
            (0..count).map(ring).sum::<f64>()
        };
        let ends = (0..=32).map(|k| 1.0 / (1.0 + t * (1.0 - f64::from(k) / 16.0)));
        let largest = ends.map(held).fold(0.0, f64::max);
        assert!((largest / most - 1.0).abs() < 1e-6, "{t}: {largest} {most}");
    }
}

#[test]
fn a_claim_is_written_and_read_by_its_name() {
    let mut names: Vec<&str> = Claim::ALL.iter().map(|claim| claim.name()).collect();
    for claim in Claim::ALL {
        let json = serde_json::to_value(claim).unwrap();
        assert_eq!(json, claim.name());
        assert_eq!(serde_json::from_value::<Claim>(json).unwrap(), claim);
    }
    assert!(Claim::ALL.is_sorted());
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), Claim::ALL.len());
    assert!(serde_json::from_value::<Claim>("min-angel".into()).is_err());
}

#[test]
fn constants_by_hand() {
    assert_eq!(packing_constant(0.75, 0.25), 1.0 / 3.0);
    assert_eq!(beta(0.25), 5.0 / 3.0);
    assert_eq!(beta(1.0), f64::INFINITY);
    assert!((least_meeting_height(0.0) - 7f64.sqrt() / 4.0).abs() < 1e-15);
    // ½ √((¼ − 2 + 7) ¾) / 4.
    assert!((least_meeting_height(0.5) - 63f64.sqrt() / 32.0).abs() < 1e-15);
    assert_eq!(least_meeting_height(1.0), 0.0);
    let [fewest, most] = at(Rule::Earlier, 0.0).vertices(0.5, [1.0, 2.0]);
    assert!((fewest - 4.0 / PI).abs() < 1e-15 && (most - 32.0 / PI).abs() < 1e-14);
}
