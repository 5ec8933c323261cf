//! What `build` makes of a SPEC.

use crate::spacing::testing::{gallery, points_inside};
use crate::spacing::*;

#[test]
fn every_spacing_is_capped_limited_and_named() {
    for name in ["unit-square", "comb", "interface"] {
        let domain = gallery(name);
        let lfs = lfs_of(&domain).unwrap();
        for spec in [
            "lfs",
            "uniform:0.02",
            "uniform:1",
            "expr:0.05+0.5*x*x",
            "min(uniform:0.1, expr:0.01+abs(y))",
        ] {
            let prepared = build(spec, &domain, &Options::new(0.25, 0.5)).unwrap();
            assert_eq!(prepared.spec, spec);
            assert!(prepared.lfs_cap && 0.5 * prepared.function.lipschitz() <= 0.25);
            for x in points_inside(&domain, 200) {
                let value = prepared.function.at(x);
                assert!(value > 0.0 && value <= lfs.at(x), "{name} {spec} at {x}: {value}");
            }
        }
    }
}

#[test]
fn a_cap_that_never_bites_leaves_the_function_alone() {
    let domain = gallery("unit-square");
    for (spec, lipschitz) in [("uniform:0.5", 0.0), ("expr:0.1+0.3*x", 0.3)] {
        let prepared = build(spec, &domain, &Options::with_alpha(1.0)).unwrap();
        let found = prepared.function.lipschitz();
        assert!(lipschitz <= found && found <= 1.011 * lipschitz, "{spec}: {found}");
    }
}

#[test]
fn the_cap_can_be_lifted() {
    let domain = gallery("unit-square");
    let options = Options {
        lfs_cap: false,
        ..Options::with_alpha(0.5)
    };
    let prepared = build("uniform:7", &domain, &options).unwrap();
    assert!(!prepared.lfs_cap);
    assert_eq!(prepared.function.at(DVec2::ZERO), 7.0);
}

#[test]
fn options_out_of_range_are_refused() {
    let domain = gallery("unit-square");
    for alpha in [0.0, -1.0, f64::NAN] {
        assert!(matches!(
            build("lfs", &domain, &Options::with_alpha(alpha)),
            Err(SpacingError::Option { .. })
        ));
    }
    for limit_factor in [0.0, -0.5, 1.0, 1.5, f64::NAN] {
        let options = Options {
            limit_factor,
            ..Options::with_alpha(0.5)
        };
        let told = build("lfs", &domain, &options).err();
        assert!(
            matches!(
                told,
                Some(SpacingError::Option {
                    name: "limit_factor",
                    ..
                })
            ),
            "{told:?}"
        );
    }
}

#[test]
fn alpha_is_t_over_c_b_and_t_is_c_b_times_the_constant() {
    let expected = Options {
        alpha: 0.25,
        lfs_cap: true,
        limit_factor: 0.9,
    };
    assert_eq!(Options::new(0.125, 0.5), expected);
    assert_eq!(Options::with_alpha(0.25), expected);
}

#[test]
fn lfs_is_capped_by_itself() {
    let domain = gallery("l-shape");
    let options = Options {
        lfs_cap: false,
        ..Options::with_alpha(1.0)
    };
    let (lfs, prepared) = (lfs_of(&domain).unwrap(), build("lfs", &domain, &options).unwrap());
    assert!(prepared.lfs_cap);
    for x in points_inside(&domain, 50) {
        assert_eq!(prepared.function.at(x), lfs.at(x));
    }
}

/// f(x) = 3 + 2x, with the bounds that follow from its constant.
struct Sloped;

impl Spacing for Sloped {
    fn at(&self, x: DVec2) -> f64 {
        3.0 + 2.0 * x.x
    }

    fn lipschitz(&self) -> f64 {
        2.0
    }
}

#[test]
fn bounds_on_a_box_follow_from_the_constant_and_the_centre() {
    let cell = Rect {
        min: DVec2::new(1.0, 2.0),
        max: DVec2::new(4.0, 6.0),
    };
    // 8 at the centre, half the diagonal of 5 from the corners.
    assert_eq!((Sloped.lower_bound(cell), Sloped.upper_bound(cell)), (3.0, 13.0));
    assert_eq!(
        (Uniform(7.0).lower_bound(cell), Uniform(7.0).upper_bound(cell)),
        (7.0, 7.0)
    );
    assert_eq!((Uniform(7.0).at(DVec2::X), Uniform(7.0).lipschitz()), (7.0, 0.0));
}
