//! The numbers in the bounds of biting, for either rule of who bites whom.
//!
//! For [`Rule::Earlier`] they are the paper's; for [`Rule::Later`] the module docs of biting by that rule derive them.

use crate::spacing::Rule;
use std::f64::consts::PI;

/// The bounds for a rule and t = c_b · lipschitz(). Distances are over c_b f.
#[derive(Clone, Copy, Debug)]
pub struct Promises {
    pub rule: Rule,
    pub t: f64,
}

impl Promises {
    /// sin θ ≥ 1/2 − t by Theorem 6.8; (1 − t) / 2 by the rule of the later point. 0 where that is negative.
    pub fn least_sine(self) -> f64 {
        self.rule.of(0.5 - self.t, 0.5 - 0.5 * self.t).max(0.0)
    }

    /// nn at vertices: from 1 − t to 2 / (1 − t) by Lemma 5.7; from 1 / (1 + t) by the rule of the later point.
    pub fn nn_at_vertices(self) -> [f64; 2] {
        let t = self.t;
        let least = self.rule.of((1.0 - t).max(0.0), 1.0 / (1.0 + t));
        [least, self.upper(2.0 / (1.0 - t))]
    }

    /// nn elsewhere: from 1 / (2 + 2t) to (3 − t) / (1 − t)² by Lemma 5.8; from 1 / (2 + t) to (3 + t) / (1 − t) by the
    /// rule of the later point.
    pub fn nn_at_points(self) -> [f64; 2] {
        let t = self.t;
        let least = self.rule.of(1.0 / (2.0 + 2.0 * t), 1.0 / (2.0 + t));
        let most = self.rule.of((3.0 - t) / ((1.0 - t) * (1.0 - t)), (3.0 + t) / (1.0 - t));
        [least, self.upper(most)]
    }

    /// The most that what one point eats can hold of ∫ dA / (c_b f)²: π / (1 − t)², as the docs of the certificate show;
    /// −2π (ln(1 − t) + t) / t² by the rule of the later point, where g grows with t away from it.
    pub fn most_eaten(self) -> f64 {
        let t = self.t;
        let by_later = if t < 1e-4 {
            // The first terms of the series: the formula cancels.
            PI * (1.0 + 2.0 * t / 3.0 + 0.5 * t * t)
        } else {
            -2.0 * PI * ((-t).ln_1p() + t) / (t * t)
        };
        self.upper(self.rule.of(PI / ((1.0 - t) * (1.0 - t)), by_later))
    }

    /// Without t < 1 there is nothing above.
    fn upper(self, bound: f64) -> f64 {
        if self.t < 1.0 { bound } else { f64::INFINITY }
    }
}

#[cfg(test)]
mod tests {
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
        // Along a ray g falls with t to where it must grow, with t, for the border at `end` to be eaten: by quadrature.
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
}
