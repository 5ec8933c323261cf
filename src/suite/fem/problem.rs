//! Poisson problems −Δu = g whose u, ∇u and g are known in closed form.

use super::FemError;
use crate::geometry::{DVec2, Rect};
use std::f64::consts::PI;

/// A known solution. u has no unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Problem {
    /// sin(π ξ) sin(π η), ξ and η from 0 to 1 across the box: zero on the boundary of a rectangle.
    Smooth {
        /// The box.
        bounds: Rect,
    },
    /// atan((r − radius) / width), r the distance from the centre: a front along a circle. At the
    /// centre u has the tip of a cone, so that is best outside the domain.
    Layer {
        /// Centre of the circle.
        centre: DVec2,
        /// Its radius, > 0.
        radius: f64,
        /// Half the width of the front, > 0.
        width: f64,
    },
    /// exp(−(r / width)²), r the distance from the centre: flat away from a bump.
    Peak {
        /// Where it is 1.
        centre: DVec2,
        /// Where it is 1/e, as a distance from the centre, > 0.
        width: f64,
    },
    /// exp(−(x − wall) / width): steep beside a wall x = `wall` on the left of the domain.
    BoundaryLayer {
        /// Where it is 1.
        wall: f64,
        /// In what distance it falls by e, > 0.
        width: f64,
    },
    /// r^power cos(power · φ) around a reflex corner, φ the angle from its bisector: harmonic, with an infinite gradient at the
    /// corner where power < 1. The ray against the bisector must lie outside the domain. Zero on both sides of an angle
    /// π / power.
    Corner {
        /// The corner.
        at: DVec2,
        /// Direction of the bisector of the angle inside the domain, of any length.
        bisector: DVec2,
        /// π over the angle.
        power: f64,
    },
}

/// A problem that plans name, made for the box of a domain.
#[derive(Clone, Copy, Debug)]
pub struct Named {
    /// Its name.
    pub name: &'static str,
    /// The problem for a domain with this box.
    pub make: fn(Rect) -> Problem,
}

/// All problems that have a name.
pub const PROBLEMS: [Named; 5] = [
    // One wave across the box: suits uniform meshes.
    Named {
        name: "smooth",
        make: |bounds| Problem::Smooth { bounds },
    },
    // A front of width 0.04 along a circle around a point beside the lower left corner.
    Named {
        name: "layer",
        make: |bounds| Problem::Layer {
            centre: bounds.min - 0.05 * longer(bounds),
            radius: 0.7 * longer(bounds),
            width: 0.02 * longer(bounds),
        },
    },
    // A bump of radius 0.05 in the middle of the lower left quarter: suits meshes graded to it.
    Named {
        name: "peak",
        make: |bounds| Problem::Peak {
            centre: bounds.min + 0.25 * bounds.size(),
            width: 0.05 * longer(bounds),
        },
    },
    // A layer of width 0.02 along the left side: suits meshes graded to that side.
    Named {
        name: "boundary-layer",
        make: |bounds| Problem::BoundaryLayer {
            wall: bounds.min.x,
            width: 0.02 * longer(bounds),
        },
    },
    // The singularity at the reflex corner of l-shape, for that domain alone: suits meshes graded to the corner.
    Named {
        name: "corner",
        make: |bounds| Problem::Corner {
            at: bounds.centre(),
            bisector: -bounds.size(),
            power: 2.0 / 3.0,
        },
    },
];

fn longer(bounds: Rect) -> f64 {
    bounds.size().max_element()
}

impl Problem {
    /// The problem of that name in [`PROBLEMS`], for a domain with the given box.
    pub fn named(name: &str, bounds: Rect) -> Result<Self, FemError> {
        match PROBLEMS.iter().find(|problem| problem.name == name) {
            Some(problem) => Ok((problem.make)(bounds)),
            None => Err(FemError::UnknownProblem {
                name: name.to_owned(),
                known: PROBLEMS.map(|problem| problem.name).join(", "),
            }),
        }
    }

    /// u(x).
    pub fn value(&self, x: DVec2) -> f64 {
        match *self {
            Self::Smooth { bounds } => {
                let phase = PI * (x - bounds.min) / bounds.size();
                phase.x.sin() * phase.y.sin()
            }
            Self::Layer { centre, radius, width } => ((x.distance(centre) - radius) / width).atan(),
            Self::Peak { centre, width } => (-(x - centre).length_squared() / (width * width)).exp(),
            Self::BoundaryLayer { wall, width } => (-(x.x - wall) / width).exp(),
            Self::Corner { at, bisector, power } => {
                let (r, angle) = polar(x - at, bisector);
                r.powf(power) * (power * angle).cos()
            }
        }
    }

    /// ∇u(x).
    pub fn gradient(&self, x: DVec2) -> DVec2 {
        match *self {
            Self::Smooth { bounds } => {
                let size = bounds.size();
                let phase = PI * (x - bounds.min) / size;
                PI / size * DVec2::new(phase.x.cos() * phase.y.sin(), phase.x.sin() * phase.y.cos())
            }
            Self::Layer { centre, radius, width } => {
                let r = x.distance(centre);
                let s = (r - radius) / width;
                (x - centre) / (r * width * (1.0 + s * s))
            }
            Self::Peak { centre, width } => -2.0 / (width * width) * self.value(x) * (x - centre),
            Self::BoundaryLayer { width, .. } => DVec2::new(-self.value(x) / width, 0.0),
            Self::Corner { at, bisector, power } => {
                let (r, angle) = polar(x - at, bisector);
                let outward = (x - at) / r;
                let slope = power * r.powf(power - 1.0);
                slope * ((power * angle).cos() * outward - (power * angle).sin() * outward.perp())
            }
        }
    }

    /// g(x) = −Δu(x).
    pub fn source(&self, x: DVec2) -> f64 {
        match *self {
            Self::Smooth { bounds } => {
                let waves = PI / bounds.size();
                waves.length_squared() * self.value(x)
            }
            Self::Layer { centre, radius, width } => {
                // −(u″ + u′ / r) of a function of r.
                let r = x.distance(centre);
                let s = (r - radius) / width;
                let slope = 1.0 / (width * (1.0 + s * s));
                2.0 * s * slope * slope - slope / r
            }
            Self::Peak { centre, width } => {
                let s = (x - centre).length_squared() / (width * width);
                4.0 / (width * width) * (1.0 - s) * self.value(x)
            }
            Self::BoundaryLayer { width, .. } => -self.value(x) / (width * width),
            Self::Corner { .. } => 0.0,
        }
    }
}

/// Distance, and angle from the axis in (−π, π].
fn polar(x: DVec2, axis: DVec2) -> (f64, f64) {
    (x.length(), axis.perp_dot(x).atan2(axis.dot(x)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use exmex::{Differentiate, Express, FlatEx};
    use proptest::prelude::*;

    const BOUNDS: Rect = Rect {
        min: DVec2::new(-1.0, 2.0),
        max: DVec2::new(1.0, 3.0),
    };

    /// u of each of [`PROBLEMS`] for [`BOUNDS`], written anew: exmex differentiates it.
    const FORMULAS: [&str; 5] = [
        "sin(PI*(x+1)/2)*sin(PI*(y-2))",
        "atan((sqrt((x+1.1)^2+(y-1.9)^2)-1.4)/0.04)",
        "exp(0-((x+0.5)^2+(y-2.25)^2)/0.01)",
        "exp(0-(x+1)/0.04)",
        // cos(2/3 angle from (-2, -1)) by way of atan2 on the half plane where one atan is enough, see the test.
        "(x^2+(y-2.5)^2)^(1/3)*cos(2/3*atan((x-2*(y-2.5))/(2*x+(y-2.5))))",
    ];

    type Parsed = FlatEx<f64>;

    /// u, its two slopes and its two second derivatives, by exmex; a derivative by a variable the formula lacks is none.
    fn by_exmex(formula: &str) -> (Parsed, [Option<[Parsed; 2]>; 2]) {
        let u = Parsed::parse(formula).unwrap();
        let variables = u.var_names().len();
        let twice = |k: usize| {
            (k < variables).then(|| {
                let slope = u.clone().partial(k).unwrap();
                [slope.clone(), slope.partial(k).unwrap()]
            })
        };
        (u.clone(), [twice(0), twice(1)])
    }

    fn evaluate(f: &Parsed, x: DVec2) -> f64 {
        f.eval(&[x.x, x.y][..f.var_names().len()]).unwrap()
    }

    #[test]
    fn values_gradients_and_sources_are_those_of_exmex() {
        for (named, formula) in PROBLEMS.iter().zip(FORMULAS) {
            let problem = Problem::named(named.name, BOUNDS).unwrap();
            let (u, derivatives) = by_exmex(formula);
            for k in 0..300 {
                // Points that fill the box evenly without lining up, by the golden ratio.
                let at = DVec2::new((0.5 + f64::from(k)) / 300.0, (0.618_033_988_7 * f64::from(k)).fract());
                let mut x = BOUNDS.min + at * BOUNDS.size();
                let along = (x - BOUNDS.centre()).dot(-BOUNDS.size().normalize());
                if named.name == "corner" && along.abs() < 1e-2 {
                    continue;
                } else if named.name == "corner" {
                    // Into the half plane around the bisector, where the formula's atan holds.
                    x = BOUNDS.centre() + along.signum() * (x - BOUNDS.centre());
                }
                let [slope, second] = [0, 1].map(|order| {
                    let part = |k: usize| derivatives[k].as_ref().map_or(0.0, |d| evaluate(&d[order], x));
                    DVec2::new(part(0), part(1))
                });
                let steep = slope.length().max(1e-3);
                assert!((problem.value(x) - evaluate(&u, x)).abs() <= 1e-12, "{problem:?} {x}");
                assert!(
                    problem.gradient(x).distance(slope) <= 1e-9 * steep,
                    "{problem:?} {x} {slope}"
                );
                let source = -second.element_sum();
                let scale = second.abs().max_element().max(1e-3);
                assert!(
                    (problem.source(x) - source).abs() <= 1e-9 * scale,
                    "{problem:?} {x} {source}"
                );
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        /// Finite differences need no formula written anew, and see all around the corner.
        #[test]
        fn gradients_and_sources_are_differences_of_values(k in 0..5usize, s in 0.0f64..1.0, t in 0.0f64..1.0) {
            let problem = Problem::named(PROBLEMS[k].name, BOUNDS).unwrap();
            let x = BOUNDS.min + DVec2::new(s, t) * BOUNDS.size();
            let away = x - BOUNDS.centre();
            prop_assume!(PROBLEMS[k].name != "corner" || away.length() > 0.1 && (away.x < -0.01 || away.y < -0.01));
            let step = 1e-4;
            let u = |dx: f64, dy: f64| problem.value(x + step * DVec2::new(dx, dy));
            let slope = DVec2::new(u(1.0, 0.0) - u(-1.0, 0.0), u(0.0, 1.0) - u(0.0, -1.0)) / (2.0 * step);
            prop_assert!(problem.gradient(x).distance(slope) < 1e-3, "{} {slope}", problem.gradient(x));
            let laplace = (u(1.0, 0.0) + u(-1.0, 0.0) + u(0.0, 1.0) + u(0.0, -1.0) - 4.0 * u(0.0, 0.0)) / (step * step);
            prop_assert!((problem.source(x) + laplace).abs() < 0.05, "{} {laplace}", problem.source(x));
        }
    }

    #[test]
    fn the_corner_vanishes_on_both_sides_of_the_l_shape() {
        let problem = Problem::named(
            "corner",
            Rect {
                min: DVec2::ZERO,
                max: DVec2::splat(2.0),
            },
        )
        .unwrap();
        for x in [DVec2::new(2.0, 1.0), DVec2::new(1.0, 1.3), DVec2::ONE] {
            assert!(problem.value(x).abs() < 1e-15, "{x}");
        }
        assert!((problem.value(DVec2::ZERO) - 2f64.powf(1.0 / 3.0)).abs() < 1e-14);
    }

    #[test]
    fn names_are_found_and_others_are_told() {
        let told = Problem::named("wave", BOUNDS).unwrap_err().to_string();
        assert_eq!(
            told,
            "problem `wave` is unknown; there are smooth, layer, peak, boundary-layer, corner"
        );
    }
}
