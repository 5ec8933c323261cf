//! What gradient limiting promises: F ≤ f, F ≥ k f_α, F is α-Lipschitz.

use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::spacing::cover::Cell;
use crate::spacing::limit::{MAX_CELLS, envelope, limit};
use crate::spacing::testing::{gallery, points_inside, pseudo_random_points};
use crate::spacing::{Expression, Spacing, SpacingError, lfs_of};
use proptest::prelude::*;
use std::sync::Arc;

/// f_α from above: the minimum over many samples of Ω.
fn envelope_by_samples(f: &dyn Spacing, samples: &[DVec2], alpha: f64, x: DVec2) -> f64 {
    samples
        .iter()
        .map(|&y| f.at(y) + alpha * x.distance(y))
        .fold(f64::INFINITY, f64::min)
}

/// `low` names points where f(y) + α‖x − y‖ is likely to be smallest; with them the reference is at most `slack`
/// above f_α.
fn assert_promises(f: &Arc<dyn Spacing>, domain: &Domain, alpha: f64, low: impl Fn(DVec2) -> Vec<DVec2>, slack: f64) {
    let limited = limit(f.clone(), domain, alpha, 0.9).unwrap();
    assert!(limited.lipschitz() <= alpha);
    let samples = points_inside(domain, 1500);
    let ends = domain.vertices().iter().copied();
    for x in samples.iter().copied().chain(ends) {
        let (value, highest) = (limited.at(x), f.at(x));
        assert!(value <= highest, "F({x}) = {value} > f = {highest}");
    }
    for &x in samples.iter().take(100) {
        let low: Vec<DVec2> = low(x).into_iter().filter(|&y| domain.contains(y)).chain([x]).collect();
        let reference = envelope_by_samples(f.as_ref(), &samples, alpha, x);
        let reference = reference.min(envelope_by_samples(f.as_ref(), &low, alpha, x));
        let value = limited.at(x);
        assert!(
            value >= 0.9 * (reference - slack),
            "F({x}) = {value}, f_α up to {reference}"
        );
    }
    assert_is_lipschitz(limited.as_ref(), domain, alpha);
    assert_lists_change_nothing(f.as_ref(), domain, alpha, &samples);
}

/// Search and lists return the same, to the last bit.
fn assert_lists_change_nothing(f: &dyn Spacing, domain: &Domain, alpha: f64, samples: &[DVec2]) {
    let searched = envelope(f, domain, [alpha, 0.9], MAX_CELLS).unwrap();
    let listed = searched.clone().listed(domain);
    for &x in samples.iter().chain(domain.vertices()) {
        assert_eq!(listed.at(x), searched.at(x), "{x}");
    }
}

/// On random pairs near and far, along segments, and across borders of cells.
fn assert_is_lipschitz(f: &dyn Spacing, domain: &Domain, alpha: f64) {
    let bounds = domain.bounds();
    let random = pseudo_random_points(600);
    let mut pairs: Vec<(DVec2, DVec2)> = Vec::new();
    for pair in random.chunks_exact(2) {
        let place = |p: DVec2| bounds.min + p * bounds.size();
        pairs.push((place(pair[0]), place(pair[1])));
        for shrink in [1e-2, 1e-5, 1e-8] {
            pairs.push((
                place(pair[0]),
                place(pair[0]) + shrink * (pair[1] - DVec2::splat(0.5)) * bounds.size(),
            ));
        }
        let [a, b] = domain.ends((pair[0].x * domain.segments().len() as f64) as usize);
        pairs.push((a.lerp(b, pair[0].y), a.lerp(b, pair[1].x)));
        // Borders of cells lie at whole multiples of powers of two from the root's corner.
        let root = Cell::root(domain).rect;
        let border = root.min + (64.0 * pair[0]).floor() / 64.0 * root.size();
        pairs.push((border - DVec2::splat(1e-9), border + DVec2::splat(1e-9)));
    }
    for (x, y) in pairs {
        let (change, allowed) = ((f.at(x) - f.at(y)).abs(), alpha * x.distance(y));
        assert!(
            change <= allowed + 1e-12 * f.at(x),
            "{x} {y}: changes by {change}, allowed {allowed}"
        );
    }
}

#[test]
fn limited_lfs_keeps_its_promises() {
    for name in ["unit-square", "l-shape", "plate-hole", "comb", "gear"] {
        let domain = gallery(name);
        let lfs: Arc<dyn Spacing> = Arc::new(lfs_of(&domain).unwrap());
        for alpha in [0.05, 0.25, 0.6, 0.85, 0.95, 1.0] {
            assert_promises(
                &lfs,
                &domain,
                alpha,
                |_| middles(&domain),
                0.01 * domain.bounds().diagonal(),
            );
        }
    }
}

#[test]
fn on_the_square_the_limited_lfs_is_near_its_closed_form() {
    // lfs of the unit square is at least ½ everywhere, and ½ at the middle of each side and at the centre.
    let domain = gallery("unit-square");
    let lfs: Arc<dyn Spacing> = Arc::new(lfs_of(&domain).unwrap());
    for factor in [0.8, 0.9, 0.98] {
        let limited = limit(lfs.clone(), &domain, 0.25, factor).unwrap();
        let corner = 0.5 + 0.25 * 0.5;
        let found = limited.at(DVec2::ZERO);
        assert!(
            factor * corner <= found && found <= corner,
            "{found}, closed form {corner}"
        );
    }
}

#[test]
fn steep_expressions_are_limited_even_without_a_lipschitz_constant() {
    let domain = gallery("l-shape");
    for alpha in [0.1, 0.5] {
        let steep = |text: &str, low: &dyn Fn(DVec2) -> DVec2| {
            let f: Arc<dyn Spacing> = Arc::new(Expression::new(text, domain.bounds()).unwrap());
            assert_promises(&f, &domain, alpha, |x| vec![low(x)], 0.0);
        };
        steep("0.01+sqrt(abs(x-0.3))", &|x| DVec2::new(0.3, x.y));
        steep("0.05+abs(y-0.5)*3", &|x| DVec2::new(x.x, 0.5));
        // Where the parabola is as steep as α.
        let ring = |x: DVec2| DVec2::ONE + 0.5 * alpha * (x - DVec2::ONE).normalize_or_zero();
        steep("min(0.4, 0.02+hypot(x-1,y-1)^2)", &ring);
    }
}

fn middles(domain: &Domain) -> Vec<DVec2> {
    (0..domain.segments().len())
        .map(|s| 0.5 * (domain.ends(s)[0] + domain.ends(s)[1]))
        .collect()
}

#[test]
fn a_small_value_outside_the_domain_does_not_count() {
    // f is tiny in the notch of the L only; there is no reason to be small inside.
    let domain = gallery("l-shape");
    let notch = points_outside(&domain);
    let text = format!("max(0.001, min(0.2, 3*(hypot(x-{}, y-{})-0.1)))", notch.x, notch.y);
    let f: Arc<dyn Spacing> = Arc::new(Expression::new(&text, domain.bounds()).unwrap());
    let limited = limit(f.clone(), &domain, 0.01, 0.9).unwrap();
    for x in points_inside(&domain, 200) {
        assert_eq!(f.at(x), 0.2);
        assert!(limited.at(x) >= 0.9 * 0.2);
    }
}

fn points_outside(domain: &Domain) -> DVec2 {
    let bounds = domain.bounds();
    let corners = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE].map(|p| bounds.min + (0.5 * p + 0.25) * bounds.size());
    corners.into_iter().find(|&x| !domain.contains(x)).unwrap()
}

#[test]
fn spacings_that_are_not_positive_are_refused() {
    let domain = gallery("unit-square");
    for text in ["x", "x-0.5", "0-1", "ln(x)", "sqrt(x-0.5)"] {
        let f: Arc<dyn Spacing> = Arc::new(Expression::new(text, domain.bounds()).unwrap());
        for alpha in [0.1, f64::INFINITY] {
            let error = limit(f.clone(), &domain, alpha, 0.9).err();
            assert!(
                matches!(
                    error,
                    Some(
                        SpacingError::NotPositive { .. }
                            | SpacingError::Unproved { .. }
                            | SpacingError::Unresolved { .. }
                    )
                ),
                "{text}: {error:?}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn limited_lfs_of_random_polygons_keeps_its_promises(seed in 0u64..1000, alpha in 0.05f64..0.95) {
        let domain = gallery(&format!("random-simple:n=12,seed={seed}"));
        let lfs: Arc<dyn Spacing> = Arc::new(lfs_of(&domain).unwrap());
        // Valleys of lfs are narrow: along the segments and on a grid.
        let along = |s: usize| { let [a, b] = domain.ends(s); (0..=100).map(move |k| a.lerp(b, f64::from(k) / 100.0)) };
        let low: Vec<DVec2> = (0..domain.segments().len()).flat_map(along).chain(points_inside(&domain, 8000)).collect();
        assert_promises(&lfs, &domain, alpha, |_| low.clone(), 0.01 * domain.bounds().diagonal());
    }
}
