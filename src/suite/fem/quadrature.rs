//! Integrals over triangles, exact for polynomials of degree 5 and refined until the rest is small.
//!
//! Radon's rule of seven points suits smooth u: linear elements ask for degree 4 at most ((u − u_h)² where u is quadratic).
//! Layers narrower than a triangle would slip through the points of any fixed rule, so a triangle is quartered until
//! quartering it changes nothing that matters: the error of a mesh that misses the layer is then measured, not missed too.
//! A floor, a magnitude below which a triangle's integral needs no digits, decides what matters; without it, the tails of
//! a peak and errors that are all rounding would be refined to the end.

use crate::geometry::DVec2;

/// The change by quartering that ends refinement, relative to the integral of the integrand's magnitude and the floor.
const TOLERANCE: f64 = 1e-6;

/// How often a triangle is quartered at most. A corner singularity r^(−2/3) asks for more at its tip alone, where the area
/// left is 4^(−8) of the triangle's.
const DEPTH: usize = 8;

/// Barycentric coordinates and weights of Radon's rule.
fn rule() -> [([f64; 3], f64); 7] {
    let root = 15f64.sqrt();
    let third = 1.0 / 3.0;
    let (near, far) = ((6.0 - root) / 21.0, (6.0 + root) / 21.0);
    let (near_weight, far_weight) = ((155.0 - root) / 1200.0, (155.0 + root) / 1200.0);
    [
        ([third, third, third], 9.0 / 40.0),
        ([1.0 - 2.0 * near, near, near], near_weight),
        ([near, 1.0 - 2.0 * near, near], near_weight),
        ([near, near, 1.0 - 2.0 * near], near_weight),
        ([1.0 - 2.0 * far, far, far], far_weight),
        ([far, 1.0 - 2.0 * far, far], far_weight),
        ([far, far, 1.0 - 2.0 * far], far_weight),
    ]
}

/// Integrals of N functions at once, and of their magnitudes.
#[derive(Clone, Copy)]
struct Sums<const N: usize> {
    values: [f64; N],
    magnitudes: [f64; N],
}

impl<const N: usize> Sums<N> {
    const ZERO: Self = Self {
        values: [0.0; N],
        magnitudes: [0.0; N],
    };

    fn add(&mut self, weight: f64, values: [f64; N], magnitudes: [f64; N]) {
        for k in 0..N {
            self.values[k] += weight * values[k];
            self.magnitudes[k] += weight * magnitudes[k];
        }
    }

    /// Whether `finer` changes nothing that matters; also true if nothing is finite, which no refinement would mend.
    fn agrees_with(&self, finer: &Self, floor: [f64; N]) -> bool {
        (0..N).all(|k| {
            let change = (self.values[k] - finer.values[k]).abs();
            change <= TOLERANCE * finer.magnitudes[k].max(floor[k]) || !finer.magnitudes[k].is_finite()
        })
    }
}

/// A triangle under refinement.
struct Part<const N: usize> {
    corners: [DVec2; 3],
    area: f64,
    /// The rule on it.
    whole: Sums<N>,
    floor: [f64; N],
}

/// The quadrature, with its points and weights.
pub(super) struct Quadrature {
    rule: [([f64; 3], f64); 7],
}

impl Quadrature {
    pub fn new() -> Self {
        Self { rule: rule() }
    }

    /// ∫ f over the triangle of the given area, for N functions at once, each to [`TOLERANCE`] of the larger of ∫ |f| and
    /// its floor.
    pub fn integrate<const N: usize>(
        &self,
        corners: [DVec2; 3],
        area: f64,
        floor: [f64; N],
        f: &impl Fn(DVec2) -> [f64; N],
    ) -> [f64; N] {
        let whole = self.once(corners, area, f);
        self.refine(
            Part {
                corners,
                area,
                whole,
                floor,
            },
            f,
            DEPTH,
        )
    }

    /// ∫ |f| over the triangle without refinement: good enough for floors.
    pub fn magnitudes<const N: usize>(
        &self,
        corners: [DVec2; 3],
        area: f64,
        f: &impl Fn(DVec2) -> [f64; N],
    ) -> [f64; N] {
        self.once(corners, area, f).magnitudes
    }

    fn once<const N: usize>(&self, [a, b, c]: [DVec2; 3], area: f64, f: &impl Fn(DVec2) -> [f64; N]) -> Sums<N> {
        let mut sums = Sums::ZERO;
        for ([p, q, r], weight) in self.rule {
            let values = f(p * a + q * b + r * c);
            sums.add(area * weight, values, values.map(f64::abs));
        }
        sums
    }

    fn refine<const N: usize>(&self, part: Part<N>, f: &impl Fn(DVec2) -> [f64; N], depth: usize) -> [f64; N] {
        let area = 0.25 * part.area;
        let floor = part.floor.map(|floor| 0.25 * floor);
        let quarters = quarters(part.corners).map(|corners| Part {
            corners,
            area,
            whole: self.once(corners, area, f),
            floor,
        });
        let mut finer = Sums::ZERO;
        for quarter in &quarters {
            finer.add(1.0, quarter.whole.values, quarter.whole.magnitudes);
        }
        if depth == 0 || part.whole.agrees_with(&finer, part.floor) {
            return finer.values;
        }
        let mut total = [0.0; N];
        for quarter in quarters {
            let refined = self.refine(quarter, f, depth - 1);
            for k in 0..N {
                total[k] += refined[k];
            }
        }
        total
    }
}

/// The four triangles between the corners and the middles of the sides.
fn quarters([a, b, c]: [DVec2; 3]) -> [[DVec2; 3]; 4] {
    let [ab, bc, ca] = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

    fn factorial(n: i32) -> f64 {
        (1..=n).map(f64::from).product()
    }

    #[test]
    fn the_rule_is_exact_to_degree_five_and_not_to_six() {
        let quadrature = Quadrature::new();
        let error = |i: i32, j: i32| {
            let found = quadrature.once(CORNERS, 0.5, &|x| [x.x.powi(i) * x.y.powi(j)]).values[0];
            let exact = factorial(i) * factorial(j) / factorial(i + j + 2);
            (found - exact).abs() / exact
        };
        for i in 0..=5 {
            for j in 0..=5 - i {
                assert!(error(i, j) < 1e-14, "x^{i} y^{j}: {}", error(i, j));
            }
        }
        assert!(error(6, 0) > 1e-4);
    }

    #[test]
    fn a_layer_narrower_than_the_rule_sees_is_found() {
        let quadrature = Quadrature::new();
        let layer = |x: DVec2| [1.0 / (1.0 + ((x.x - 0.25) / 0.003).powi(2))];
        let corners = [DVec2::new(-1.0, -1.0), DVec2::new(2.0, -1.0), DVec2::new(0.25, 2.0)];
        let [found] = quadrature.integrate(corners, 4.5, [0.0], &layer);
        // By slices x = const, whose lengths are linear on either side of x = 0.25.
        let exact = slices(|x| layer(DVec2::new(x, 0.0))[0]);
        assert!((found - exact).abs() < 1e-5 * exact, "{found} {exact}");
        let [once] = quadrature.once(corners, 4.5, &layer).values;
        assert!((once - exact).abs() > 0.5 * exact, "{once} {exact}");
    }

    /// ∫ f(x) times the height of the triangle above at x, by two million midpoints.
    fn slices(f: impl Fn(f64) -> f64) -> f64 {
        let count = 2_000_000;
        let step = 3.0 / f64::from(count);
        (0..count)
            .map(|k| -1.0 + (f64::from(k) + 0.5) * step)
            .map(|x| {
                let height = if x < 0.25 { (x + 1.0) / 1.25 } else { (2.0 - x) / 1.75 };
                step * f(x) * 3.0 * height
            })
            .sum()
    }

    #[test]
    fn the_floor_ends_refinement_of_what_does_not_matter() {
        let calls = std::cell::Cell::new(0);
        let noise = |x: DVec2| {
            calls.set(calls.get() + 1);
            [1e-30 * (1e9 * (x.x + x.y)).sin()]
        };
        Quadrature::new().integrate(CORNERS, 0.5, [1e-20], &noise);
        assert_eq!(calls.get(), 7 + 4 * 7);
    }

    #[test]
    fn a_singular_corner_is_resolved() {
        // ∫ r^(−2/3) over the quarter-symmetric triangle: in polar coordinates 3/4 ∫ R(φ)^(4/3) dφ, R the far side.
        let singular = |x: DVec2| [x.length().powf(-2.0 / 3.0)];
        let [found] = Quadrature::new().integrate(CORNERS, 0.5, [0.0], &singular);
        let count = 100_000;
        let step = std::f64::consts::FRAC_PI_2 / f64::from(count);
        let exact: f64 = (0..count)
            .map(|k| (f64::from(k) + 0.5) * step)
            .map(|angle| 0.75 * step * (angle.sin() + angle.cos()).powf(-4.0 / 3.0))
            .sum();
        assert!((found - exact).abs() < 1e-4 * exact, "{found} {exact}");
    }
}
