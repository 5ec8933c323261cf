//! Biting by the rule of the later point: its bounds, the rule itself checked by loops, and cases in which the two
//! rules agree.

use crate::meshers::biting::tests::*;
use crate::theory::Claim;

/// The mesh by the rule of the later point, and its certificate by the same rule.
fn by_later(name: &str, spec: &str, t: f64, c_b: f64, order: Order) -> (Mesh, crate::quality::Certificate) {
    let case = case(name, spec, t, c_b);
    let mesher = Biting {
        rule: Rule::Later,
        order,
        ..Biting::default()
    };
    let mesh = case
        .mesh(&mesher)
        .unwrap_or_else(|error| panic!("{name}, {spec}, t = {t}, c_b = {c_b}: {error}"));
    let (_, certificate) = case.judge_of(&mesh, &mesher);
    (mesh, certificate)
}

#[test]
fn by_the_rule_of_the_later_point_the_bounds_hold() {
    for name in ["unit-square", "l-shape", "plate-hole", "interface"] {
        for (t, c_b) in [(0.1, 0.2), (0.25, 0.5), (0.5, 0.5), (0.5, 1.0), (0.7, 0.9)] {
            for spec in ["lfs", "expr:0.05 + 0.3*abs(x-0.3)"] {
                let (mesh, certificate) = by_later(name, spec, t, c_b, Order::default());
                let broken: Vec<_> = certificate.broken().collect();
                assert!(broken.is_empty(), "{name} {spec} {t} {c_b}: {broken:?}");
                for claim in [
                    Claim::MinAngle,
                    Claim::Coverage,
                    Claim::PackingDisjoint,
                    Claim::NnVertexUpper,
                    Claim::NnPointLower,
                ] {
                    assert!(certificate.check(claim).expect("a check").applies, "{claim}");
                }
                assert!(mesh.triangles.len() > 2);
            }
        }
    }
}

#[test]
fn where_the_spacing_is_constant_the_rules_agree() {
    for name in ["unit-square", "l-shape", "plate-hole"] {
        let domain = gallery::domain(name).expect("a gallery name").expect("a valid domain");
        let spacing = build("uniform:0.04", &domain, &Options::with_alpha(f64::INFINITY)).expect("a spacing");
        let spacing = match spacing.function.lipschitz() {
            0.0 => spacing.function,
            _ => uncapped(&domain, "uniform:0.04", 1.0),
        };
        for order in Order::ALL {
            let bitten = |rule| {
                let mesher = Biting { rule, ..with(order) };
                mesher
                    .bite(&domain, &*spacing, &request(0.9), &mut Trace::default())
                    .expect("bitten")
            };
            assert_eq!(bitten(Rule::Earlier), bitten(Rule::Later), "{name} {order:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Checked by loops: every point of the domain has a vertex within g, and no vertex has an earlier one within g.
    #[test]
    fn the_rule_of_the_later_point_is_kept(
        low in 0.03..0.3f64,
        slope in 0.0..0.9f64,
        order in prop::sample::select(Order::ALL.to_vec()),
        name in prop::sample::select(vec!["unit-square", "plate-hole", "interface", "random-simple"]),
    ) {
        let domain = gallery::domain(name).expect("a gallery name").expect("a valid domain");
        let spacing = uncapped(&domain, &format!("expr: {low} + {slope}*sqrt((x-0.3)^2 + (y-0.4)^2 + 0.001)"), 0.95);
        let mesher = Biting { rule: Rule::Later, ..with(order) };
        let bitten = mesher.bite(&domain, &*spacing, &request(1.0), &mut Trace::default()).expect("bitten");
        let nearest = |x: DVec2, before: usize| {
            bitten.centres[..before].iter().map(|y| y.distance(x)).fold(f64::INFINITY, f64::min)
        };
        for (k, x) in bitten.centres.iter().enumerate().skip(domain.vertices().len()) {
            prop_assert!(nearest(*x, k) >= spacing.at(*x) * (1.0 - 1e-9), "{x}");
        }
        let bounds = domain.bounds();
        for k in 0..80 * 80 {
            let at = DVec2::new(f64::from(k % 80), f64::from(k / 80)) / 79.0;
            let x = bounds.min + at * bounds.size();
            if domain.contains(x) {
                prop_assert!(nearest(x, bitten.centres.len()) <= spacing.at(x) * (1.0 + 1e-9), "{x}");
            }
        }
    }
}
