//! Where a line leaves what a point has eaten, by the rule of the later point.
//!
//! # Idea
//! Let x be a point at distance `away` from a line, and w the signed distance along the line from the foot of x. At w,
//! the point x has eaten the line where F(w) = √(away² + w²) − share · g(w) is negative. Since g is t-Lipschitz, the
//! slope of F is within t of w / √(away² + w²). So with w₀ = t away / √(1 − t²), F rises from w₀ on and falls up to
//! −w₀. On either side there is at most one crossing, and it is found between two points of different sign. In between,
//! F may wiggle as g does. There its slope is at most 2t, so an interval has no crossing if the values at its two ends
//! are too far from 0 for that slope. All other intervals are halved a few times. After that F is assumed to have at
//! most one extremum in each, so that an extremum which only touches 0 does not cost a step for every bit.

use crate::geometry::DVec2;
use crate::geometry::tolerance::EATEN;
use crate::meshers::MeshError;
use crate::meshers::sizing::Sizing;

/// How often the stretch where F may wiggle is halved, before F is assumed to have at most one extremum in each part.
const HALVINGS: usize = 6;
/// Steps to the extremum: 0.618⁴⁸ is 1e-10.
const STEPS_TO_EXTREMUM: usize = 48;
const GOLDEN: f64 = 0.618_033_988_749_894_8;
/// Most steps to a crossing that is known to exist. Every third step halves the interval.
const STEPS: usize = 200;

/// A line that passes a point.
#[derive(Clone, Copy)]
pub(in crate::meshers::biting) struct PassingLine<'a> {
    pub sizing: Sizing<'a>,
    /// The foot of the point on the line.
    pub foot: DVec2,
    /// The line's direction, a unit vector.
    pub direction: DVec2,
    /// How far the point is from the line.
    pub away: f64,
    /// The factor by which g is taken smaller.
    pub share: f64,
    /// A first guess of g at the crossing.
    pub guess: f64,
}

/// A place where F changes sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::meshers::biting) struct Crossing {
    /// Signed distance from the foot.
    pub at: f64,
    /// g there.
    pub radius: f64,
    /// Whether F rises there: whether the line, in its direction, leaves what is eaten.
    pub rises: bool,
}

/// F at a point of the line, with g.
#[derive(Clone, Copy)]
struct Sample {
    at: f64,
    excess: f64,
    radius: f64,
}

impl PassingLine<'_> {
    /// All crossings in [from, to], in their order along the line.
    pub fn crossings(&self, [from, to]: [f64; 2]) -> Result<Vec<Crossing>, MeshError> {
        let mut found = Vec::new();
        if from >= to {
            return Ok(found);
        }
        let t = self.sizing.t();
        let turn = t * self.away / (1.0 - t * t).sqrt();
        let mut ends = vec![from];
        ends.extend([-turn, turn].into_iter().filter(|w| from < *w && *w < to));
        ends.push(to);
        for pair in ends.windows(2) {
            let [first, last] = [pair[0], pair[1]];
            if -turn < last && first < turn {
                self.halve([self.sample(first)?, self.sample(last)?], 0, &mut found)?;
                continue;
            }
            // F is largest at the end away from the foot: if it is negative there, it is negative everywhere.
            let (near, far) = if first >= turn { (first, last) } else { (last, first) };
            let far = self.sample(far)?;
            if far.excess >= 0.0 {
                let near = self.sample(near)?;
                let both = if near.at < far.at { [near, far] } else { [far, near] };
                found.extend(self.only_crossing(both)?);
            }
        }
        Ok(found)
    }

    /// The first point of [from, to] that is not eaten: `from` itself if it is not, none if all are.
    pub fn exit(&self, [from, to]: [f64; 2]) -> Result<Option<f64>, MeshError> {
        if self.sample(from)?.excess >= 0.0 {
            return Ok(Some(from));
        }
        let first = self.crossings([from, to])?.into_iter().find(|crossing| crossing.rises);
        Ok(first.map(|crossing| crossing.at))
    }

    fn sample(&self, w: f64) -> Result<Sample, MeshError> {
        let x = self.foot + self.direction * w;
        let radius = self.sizing.unchecked(x);
        if !radius.is_finite() {
            let value = self.sizing.spacing.at(x);
            return Err(MeshError::Spacing { value, x: x.x, y: x.y });
        }
        Ok(Sample {
            at: w,
            excess: self.away.hypot(w) - self.share * radius,
            radius,
        })
    }

    /// The crossing between two samples where F is monotone, if there is one.
    fn only_crossing(&self, [mut low, mut high]: [Sample; 2]) -> Result<Option<Crossing>, MeshError> {
        let rises = low.excess < high.excess;
        if (low.excess < 0.0) == (high.excess < 0.0) {
            return Ok(None);
        }
        let across = |radius: f64| ((self.share * radius).powi(2) - self.away * self.away).max(0.0).sqrt();
        let side = if rises { 1.0 } else { -1.0 };
        // The first step looks for a fixed point of w ↦ √((share · g(w))² − away²): for constant g that is the crossing
        // itself.
        let mut next = side * across(self.guess);
        let mut last = low;
        for step in 0..STEPS {
            let middle = 0.5 * (low.at + high.at);
            if middle <= low.at || middle >= high.at {
                break;
            }
            if !(low.at < next && next < high.at) || step % 3 == 2 {
                next = middle;
            }
            let sample = self.sample(next)?;
            if (sample.excess < 0.0) == (low.excess < 0.0) {
                low = sample;
            } else {
                high = sample;
            }
            if sample.excess.abs() <= EATEN * sample.radius {
                break;
            }
            next = match step {
                0 => side * across(sample.radius),
                _ => sample.at - sample.excess * (sample.at - last.at) / (sample.excess - last.excess),
            };
            last = sample;
        }
        let nearest = if high.excess.abs() < low.excess.abs() {
            high
        } else {
            low
        };
        Ok(Some(Crossing {
            at: nearest.at,
            radius: nearest.radius,
            rises,
        }))
    }

    /// All crossings between two samples where the slope of F is at most 2t, after `halvings` halvings of the stretch
    /// between −w₀ and w₀.
    fn halve(&self, [low, high]: [Sample; 2], halvings: usize, found: &mut Vec<Crossing>) -> Result<(), MeshError> {
        let changes = (low.excess < 0.0) != (high.excess < 0.0);
        let bridge = 2.0 * self.sizing.t() * (high.at - low.at);
        if !changes && low.excess.abs() + high.excess.abs() > bridge {
            return Ok(());
        }
        if halvings < HALVINGS {
            let middle = self.sample(0.5 * (low.at + high.at))?;
            self.halve([low, middle], halvings + 1, found)?;
            return self.halve([middle, high], halvings + 1, found);
        }
        if changes {
            found.extend(self.only_crossing([low, high])?);
        } else if let Some(turn) = self.other_side([low, high])? {
            found.extend(self.only_crossing([low, turn])?);
            found.extend(self.only_crossing([turn, high])?);
        }
        Ok(())
    }

    /// A sample of the other sign between two of the same sign, if there is one: found by golden sections on the way to
    /// the one extremum of F.
    fn other_side(&self, [low, high]: [Sample; 2]) -> Result<Option<Sample>, MeshError> {
        let side = if low.excess < 0.0 { 1.0 } else { -1.0 };
        let (mut from, mut to) = (low.at, high.at);
        let at = |share: f64, from: f64, to: f64| self.sample(from + share * (to - from));
        let mut inner = [at(1.0 - GOLDEN, from, to)?, at(GOLDEN, from, to)?];
        for _ in 0..STEPS_TO_EXTREMUM {
            if let Some(other) = inner
                .into_iter()
                .find(|sample| (sample.excess < 0.0) != (low.excess < 0.0))
            {
                return Ok(Some(other));
            }
            if side * inner[0].excess > side * inner[1].excess {
                to = inner[1].at;
                inner = [at(1.0 - GOLDEN, from, to)?, inner[0]];
            } else {
                from = inner[0].at;
                inner = [inner[1], at(GOLDEN, from, to)?];
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshers::{Budget, Request};
    use crate::spacing::Spacing;
    use proptest::prelude::*;

    /// Waves of slope up to α along x.
    struct Waves {
        height: f64,
        alpha: f64,
        frequency: f64,
    }

    impl Spacing for Waves {
        fn at(&self, x: DVec2) -> f64 {
            self.height + self.alpha * (self.frequency * x.x).sin() / self.frequency
        }

        fn lipschitz(&self) -> f64 {
            self.alpha
        }
    }

    fn crossings(waves: &Waves, away: f64, range: [f64; 2]) -> Vec<Crossing> {
        let domain = crate::domain::gallery::domain("unit-square")
            .expect("a name")
            .expect("a domain");
        let request = Request {
            c_b: 1.0,
            seed: 0,
            threads: 1,
            budget: Budget::default(),
        };
        let line = PassingLine {
            sizing: Sizing::new(&domain, waves, &request),
            foot: DVec2::new(0.0, 0.5),
            direction: DVec2::X,
            away,
            share: 1.0,
            guess: waves.height,
        };
        line.crossings(range).expect("a finite spacing")
    }

    #[test]
    fn a_constant_radius_is_left_where_its_circle_is() {
        let flat = Waves {
            height: 0.5,
            alpha: 0.0,
            frequency: 1.0,
        };
        let found = crossings(&flat, 0.3, [-2.0, 2.0]);
        assert_eq!(found.len(), 2);
        assert!((found[0].at + 0.4).abs() < 1e-13 && !found[0].rises);
        assert!((found[1].at - 0.4).abs() < 1e-13 && found[1].rises);
        assert!(crossings(&flat, 0.51, [-2.0, 2.0]).is_empty() && crossings(&flat, 0.3, [0.5, 0.2]).is_empty());
        assert_eq!(crossings(&flat, 0.0, [-2.0, 0.0]).len(), 1);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]
        #[test]
        fn no_crossing_is_missed(
            height in 0.2..0.6f64, alpha in 0.0..0.9f64, frequency in 1.0..12.0f64, away in 0.0..0.6f64,
            from in -1.0..0.0f64, to in 0.0..1.0f64,
        ) {
            let waves = Waves { height, alpha, frequency };
            let found = crossings(&waves, away, [from, to]);
            let excess = |w: f64| away.hypot(w) - waves.at(DVec2::new(w, 0.0));
            for crossing in &found {
                prop_assert!(excess(crossing.at).abs() < 1e-11, "{crossing:?}");
                prop_assert!((crossing.radius - away.hypot(crossing.at)).abs() < 1e-11);
            }
            prop_assert!(found.windows(2).all(|two| two[0].at <= two[1].at && two[0].rises != two[1].rises));
            // Every change of sign between samples has a crossing in between.
            let at = |k: i32| from + (to - from) * f64::from(k) / 2000.0;
            for k in 0..2000 {
                let (low, high) = (at(k), at(k + 1));
                let within = found.iter().filter(|crossing| low - 1e-12 <= crossing.at && crossing.at <= high + 1e-12);
                if (excess(low) < 0.0) != (excess(high) < 0.0) {
                    prop_assert!(within.count() > 0, "between {low} and {high}");
                }
            }
        }
    }
}
