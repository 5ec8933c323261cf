//! Enclosures hold what they must and little more.

use super::*;
use proptest::prelude::*;
use std::f64::consts::E;

fn of(low: f64, high: f64) -> Interval {
    Interval::new(low, high)
}

/// Whether `bounds` hold `low` and `high` and step out by a few ulp at most.
fn assert_is(bounds: Interval, low: f64, high: f64, what: &str) {
    let close =
        |found: f64, expected: f64| found == expected || (found - expected).abs() <= 1e-14 * expected.abs().max(1e-300);
    assert!(
        bounds.low <= low && close(bounds.low, low),
        "{what}: from {:?}, expected {low:?}",
        bounds.low
    );
    assert!(
        bounds.high >= high && close(bounds.high, high),
        "{what}: to {:?}, expected {high:?}",
        bounds.high
    );
}

/// Smallest and largest of a function of one number over the ends and what lies between them.
fn extremes(range: Interval, between: &[f64], function: impl Fn(f64) -> f64) -> (f64, f64) {
    let inside = between.iter().copied().filter(|x| range.low < *x && *x < range.high);
    let values = inside.chain([range.low, range.high]).map(function);
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

/// The same of two numbers, which must be largest and smallest at the corners.
fn corners(a: Interval, b: Interval, function: impl Fn(f64, f64) -> f64) -> (f64, f64) {
    let values = [(a.low, b.low), (a.low, b.high), (a.high, b.low), (a.high, b.high)].map(|(x, y)| function(x, y));
    values
        .into_iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn functions_of_one_number_are_enclosed_tightly(start in -4.0f64..4.0, width in 0.0f64..3.0) {
        let range = of(start, start + width);
        type Case = (&'static str, fn(Interval) -> Interval, fn(f64) -> f64);
        let cases: [Case; 14] = [
            ("abs", Interval::abs, f64::abs),
            ("exp", Interval::exp, f64::exp),
            ("atan", Interval::atan, f64::atan),
            ("tanh", Interval::tanh, f64::tanh),
            ("negative", |a| -a, |a| -a),
            ("square", Interval::square, |a| a * a),
            ("0th power", |a| a.power_whole(0), |_| 1.0),
            ("1st power", |a| a.power_whole(1), |a| a),
            ("2nd power", |a| a.power_whole(2), |a| a * a),
            ("3rd power", |a| a.power_whole(3), |a| a * a * a),
            ("4th power", |a| a.power_whole(4), |a| (a * a) * (a * a)),
            ("5th power", |a| a.power_whole(5), |a| (a * a) * (a * a) * a),
            ("6th power", |a| a.power_whole(6), |a| (a * a * a) * (a * a * a)),
            ("7th power", |a| a.power_whole(7), |a| (a * a * a) * (a * a * a) * a),
        ];
        for (what, bounds, value) in cases {
            let (low, high) = extremes(range, &[0.0], value);
            // Tests and bounds round powers in another order.
            let slack = if what.ends_with("power") { 4.0 * f64::EPSILON } else { 0.0 };
            let bounds = bounds(range);
            let looser = of(bounds.low - slack * bounds.low.abs(), bounds.high + slack * bounds.high.abs());
            assert_is(looser, low, high, what);
        }
        let peaks: Vec<f64> = (-8..=8).map(|k| f64::from(k) * FRAC_PI_2).collect();
        let (low, high) = extremes(range, &peaks, f64::sin);
        assert_is(range.sin(), low, high, "sin");
        let (low, high) = extremes(range, &peaks, f64::cos);
        assert_is(range.cos(), low, high, "cos");
        prop_assert!(range.cos().has_zero() || range.tan() != Interval::WHOLE);
        if range.tan() != Interval::WHOLE {
            assert_is(range.tan(), range.low.tan(), range.high.tan(), "tan");
        } else {
            prop_assert!(peaks.iter().any(|peak| range.low - 1e-8 <= *peak && *peak <= range.high + 1e-8));
        }
    }

    #[test]
    fn functions_of_a_positive_number_are_enclosed_tightly(start in 1e-3f64..4.0, width in 0.0f64..3.0) {
        let range = of(start, start + width);
        assert_is(range.sqrt(), range.low.sqrt(), range.high.sqrt(), "sqrt");
        assert_is(range.ln(), range.low.ln(), range.high.ln(), "ln");
        for power in [0.5, 2.5, -0.5, -1.5] {
            let (low, high) = extremes(range, &[], |a| a.powf(power));
            assert_is(range.power(power), low, high, "fixed power");
        }
        for (power, value) in [(-1, (|a| 1.0 / a) as fn(f64) -> f64), (-2, |a| 1.0 / (a * a)), (-3, |a| 1.0 / (a * a * a))] {
            let (low, high) = extremes(range, &[], value);
            let bounds = range.power_whole(power);
            assert_is(of(bounds.low * (1.0 - 1e-15), bounds.high * (1.0 + 1e-15)), low, high, "negative power");
        }
    }

    #[test]
    fn operations_are_enclosed_tightly(
        a in (-4.0f64..4.0, 0.0f64..3.0), b in (-4.0f64..4.0, 0.0f64..3.0),
    ) {
        let (a, b) = (of(a.0, a.0 + a.1), of(b.0, b.0 + b.1));
        type Case = (&'static str, Interval, fn(f64, f64) -> f64);
        let cases: [Case; 5] = [
            ("+", a + b, |x, y| x + y),
            ("-", a - b, |x, y| x - y),
            ("*", a * b, |x, y| x * y),
            ("min", a.min(b), f64::min),
            ("max", a.max(b), f64::max),
        ];
        for (what, bounds, value) in cases {
            let (low, high) = corners(a, b, value);
            assert_is(bounds, low, high, what);
        }
        if b.has_zero() {
            prop_assert_eq!(a / b, Interval::WHOLE);
        } else {
            let (low, high) = corners(a, b, |x, y| x / y);
            assert_is(a / b, low, high, "/");
        }
        let (low, high) = corners(a.abs(), b.abs(), |x, y| (x * x + y * y).sqrt());
        let hypot = a.hypot(b);
        prop_assert!(hypot.low <= low && hypot.low >= low * (1.0 - 1e-14) - 1e-300);
        prop_assert!(hypot.high >= high && hypot.high <= high * (1.0 + 1e-14));
        let (low, high) = corners(a.abs() + Interval::point(0.5), b, f64::powf);
        let power = (a.abs() + Interval::point(0.5)).power_varying(b);
        prop_assert!(power.low <= low && power.low >= low * (1.0 - 1e-12));
        prop_assert!(power.high >= high && power.high <= high * (1.0 + 1e-12));
        prop_assert_eq!(a.hull(b), of(a.low.min(b.low), a.high.max(b.high)));
        prop_assert_eq!(a.magnitude(), a.low.abs().max(a.high.abs()));
    }
}

#[test]
fn what_ieee_754_rounds_right_is_stepped_out_by_one_float() {
    let (a, b) = (Interval::point(0.1), Interval::point(-0.7));
    let around = |value: f64| of(value.next_down(), value.next_up());
    assert_eq!((a + b, a - b), (around(0.1 - 0.7), around(0.1 + 0.7)));
    assert_eq!((a * b, a / b), (around(0.1 * -0.7), around(0.1 / -0.7)));
    assert_eq!((a.sqrt(), b.square()), (around(0.1f64.sqrt()), around(0.7 * 0.7)));
}

#[test]
fn elementary_functions_are_stepped_out_by_four_ulp() {
    let one = Interval::point(1.0);
    for (bounds, value) in [
        (one.exp(), E),
        (Interval::point(0.5).ln(), 0.5f64.ln()),
        (one.atan(), 1f64.atan()),
    ] {
        let (below, above) = (value - bounds.low, bounds.high - value);
        let most = 4.0 * f64::EPSILON * value.abs();
        for step in [below, above] {
            assert!(
                step >= most && step <= most * 1.6,
                "{value}: {step} where {most} is wanted"
            );
        }
    }
}

#[test]
fn nothing_is_known_where_a_value_is_missing() {
    let below = of(-1.0, 4.0);
    assert_eq!(
        [below.sqrt(), below.ln(), below.power(0.5), below.power(-1.0)],
        [Interval::WHOLE; 4]
    );
    assert_eq!(below.power_varying(Interval::point(2.0)), Interval::WHOLE);
    let from_zero = of(0.0, 4.0);
    assert_eq!([from_zero.power(-0.5), from_zero.power_whole(-1)], [Interval::WHOLE; 2]);
    assert_eq!([of(f64::NAN, 1.0), of(1.0, f64::NAN)], [Interval::WHOLE; 2]);
    let endless = of(1.0, f64::INFINITY);
    assert_eq!(
        [
            endless / endless,
            Interval::WHOLE / endless,
            Interval::point(1.0) / below
        ],
        [Interval::WHOLE; 3]
    );
    assert_eq!(
        [of(0.0, 1.0), of(-1.0, 0.0)].map(|divisor| Interval::point(1.0) / divisor),
        [Interval::WHOLE; 2]
    );
    // At 0 itself roots and powers are known.
    assert_is(from_zero.sqrt(), 0.0, 2.0, "sqrt from 0");
    assert_is(from_zero.power(0.5), 0.0, 2.0, "fixed power from 0");
    assert_is(from_zero.power(0.0), 1.0, 1.0, "power 0 from 0");
    let varying = from_zero.power_varying(of(1.0, 2.0));
    assert!(
        varying.low == 0.0 && (16.0..16.001).contains(&varying.high),
        "{varying:?}"
    );
    let logarithm = from_zero.ln();
    assert!(
        logarithm.low == f64::NEG_INFINITY && (4f64.ln()..1.4).contains(&logarithm.high),
        "{logarithm:?}"
    );
}

#[test]
fn sizes_are_never_negative_and_waves_never_above_1() {
    let zero = Interval::point(0.0);
    for bounds in [
        zero + zero,
        of(0.0, 2.0) * of(0.0, 3.0),
        zero.square(),
        zero.sqrt(),
        of(-1000.0, 0.0).exp(),
    ] {
        assert_eq!(bounds.low, 0.0, "{bounds:?}");
    }
    assert_eq!(of(0.0, 2.0).power(1.5).low, 0.0);
    assert!((of(-1.0, 2.0) + zero).low < -1.0 && (zero + of(-1.0, 2.0)).low < -1.0);
    assert!((of(-1.0, 2.0) * of(0.0, 3.0)).low < -3.0 && (of(0.0, 3.0) * of(-1.0, 2.0)).low < -3.0);
    assert_eq!(
        (of(-50.0, 50.0).tanh(), of(-1.0, 7.0).sin()),
        (of(-1.0, 1.0), of(-1.0, 1.0))
    );
    let quarter = of(FRAC_PI_2 - 1e-4, FRAC_PI_2 - 1e-4).sin();
    assert!(quarter.high < 1.0 && quarter.low > 0.999_999);
    // Beside its peak a wave is bounded by 1, whether or not the peak is counted in.
    assert_eq!(Interval::point(FRAC_PI_2 - 1e-10).sin().high, 1.0);
    assert_eq!(Interval::point(-FRAC_PI_2 - 1e-10).sin().low, -1.0);
    assert_eq!(
        (Interval::point(1e-10).cos().high, Interval::point(PI + 1e-10).cos().low),
        (1.0, -1.0)
    );
    assert_eq!(
        (
            Interval::point(TAU - 1e-10).cos().high,
            Interval::point(-1e-10).cos().high
        ),
        (1.0, 1.0)
    );
}

#[test]
fn angles_up_to_a_million_are_known() {
    for angle in [1e6, -1e6] {
        assert_is(
            Interval::point(angle).sin(),
            angle.sin(),
            angle.sin(),
            "sin of a million",
        );
    }
    for range in [of(0.0, 1e6f64.next_up()), of(2e6, 2e6), of(-2e6, 1.0), Interval::WHOLE] {
        assert_eq!(
            (range.sin(), range.cos(), range.tan()),
            (of(-1.0, 1.0), of(-1.0, 1.0), Interval::WHOLE)
        );
    }
}

#[test]
fn a_constant_of_0_makes_0_of_whatever_it_is_multiplied_with() {
    let zero = Interval::point(0.0);
    for other in [Interval::WHOLE, of(1.0, f64::INFINITY), of(-1.0, 2.0)] {
        assert_eq!((zero * other, other * zero), (zero, zero));
    }
    let half = of(0.0, 1.0) * of(2.0, f64::INFINITY);
    assert_eq!((half.low, half.high), (0.0, f64::INFINITY));
    let mixed = of(-1.0, 0.0) * of(0.0, f64::INFINITY);
    assert!(
        mixed.low == f64::NEG_INFINITY && (0.0..1e-300).contains(&mixed.high),
        "{mixed:?}"
    );
}

#[test]
fn signs_are_seen_at_the_ends() {
    assert!(of(0.0, 1.0).has_zero() && of(-1.0, 0.0).has_zero() && of(-1.0, 1.0).has_zero());
    assert!(!of(0.5, 1.0).has_zero() && !of(-1.0, -0.5).has_zero());
    assert_eq!(of(-3.0, 2.0).abs(), of(0.0, 3.0));
    assert_eq!(
        (of(0.0, 2.0).abs(), of(-2.0, 0.0).abs(), of(-3.0, -2.0).abs()),
        (of(0.0, 2.0), of(0.0, 2.0), of(2.0, 3.0))
    );
}

#[test]
fn what_two_bounds_allow_is_what_they_have_in_common() {
    assert_eq!(of(0.0, 2.0).meet(of(1.0, 3.0)), of(1.0, 2.0));
    assert_eq!(of(0.0, 2.0).meet(of(2.0, 3.0)), of(2.0, 2.0));
    assert_eq!(of(0.0, 2.0).meet(of(2.5, 3.0)), of(0.0, 2.0));
}
