//! Extreme eigenvalues of symmetric tridiagonal matrices, by bisection on Sturm counts.
//!
//! Reference: J. H. Wilkinson, "The Algebraic Eigenvalue Problem", chapter 5.

/// A symmetric tridiagonal matrix.
#[derive(Clone, Debug, Default)]
pub(super) struct Tridiagonal {
    /// The diagonal.
    pub diagonal: Vec<f64>,
    /// Beside it; as long as the diagonal less one. What is longer is not read.
    pub beside: Vec<f64>,
}

impl Tridiagonal {
    /// Smallest and largest eigenvalue, to a few units in the last place of the larger magnitude; none of the empty matrix.
    pub fn extremes(&self) -> Option<[f64; 2]> {
        let size = self.diagonal.len();
        let side = |k: usize| self.beside.get(k).filter(|_| k + 1 < size).map_or(0.0, |b| b.abs());
        let radius = |k: usize| side(k) + if k > 0 { side(k - 1) } else { 0.0 };
        let low = (0..size).map(|k| self.diagonal[k] - radius(k)).reduce(f64::min)?;
        let high = (0..size).map(|k| self.diagonal[k] + radius(k)).reduce(f64::max)?;
        Some([self.eigenvalue(1, low, high), self.eigenvalue(size, low, high)])
    }

    /// The eigenvalue number `rank`, from 1, which lies in the interval.
    fn eigenvalue(&self, rank: usize, mut low: f64, mut high: f64) -> f64 {
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high || !middle.is_finite() {
                return middle;
            }
            if self.count_below(middle) >= rank {
                high = middle;
            } else {
                low = middle;
            }
        }
    }

    /// How many eigenvalues are below x: the negative pivots of T − x.
    fn count_below(&self, x: f64) -> usize {
        let mut count = 0;
        let mut pivot = 1.0;
        for (k, diagonal) in self.diagonal.iter().enumerate() {
            let beside = if k > 0 { self.beside[k - 1] } else { 0.0 };
            pivot = diagonal - x - beside * (beside / pivot);
            if pivot == 0.0 {
                // An eigenvalue of a leading part: moved off by less than rounding, as the count is of one side only.
                pivot = f64::EPSILON * (diagonal.abs() + beside.abs()).max(f64::MIN_POSITIVE);
            }
            count += usize::from(pivot < 0.0);
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_difference_has_its_known_eigenvalues() {
        for size in [1usize, 2, 5, 100] {
            let matrix = Tridiagonal {
                diagonal: vec![2.0; size],
                beside: vec![-1.0; size - 1],
            };
            let exact = |k: usize| 2.0 - 2.0 * (std::f64::consts::PI * k as f64 / (size + 1) as f64).cos();
            let [low, high] = matrix.extremes().unwrap();
            assert!((low - exact(1)).abs() < 1e-14, "{size}: {low}");
            assert!((high - exact(size)).abs() < 1e-14, "{size}: {high}");
        }
    }

    #[test]
    fn zeros_and_separate_blocks_are_no_trouble() {
        assert_eq!(Tridiagonal::default().extremes(), None);
        let blocks = Tridiagonal {
            diagonal: vec![0.0, 3.0, -1.0],
            beside: vec![0.0, 0.0],
        };
        let [low, high] = blocks.extremes().unwrap();
        assert!((low + 1.0).abs() < 1e-15 && (high - 3.0).abs() < 1e-15);
        let zeros = Tridiagonal {
            diagonal: vec![0.0; 3],
            beside: vec![0.0; 2],
        };
        assert_eq!(zeros.extremes(), Some([0.0, 0.0]));
    }
}
