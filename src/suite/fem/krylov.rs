//! Conjugate gradients preconditioned by the diagonal, and the spectrum's ends from the same three-term recurrences.
//!
//! References: M. R. Hestenes, E. Stiefel, "Methods of Conjugate Gradients for Solving Linear Systems" (1952); for the
//! tridiagonal matrix of its coefficients, Y. Saad, "Iterative Methods for Sparse Linear Systems", §6.7.3; for the accuracy
//! of Lanczos from a random vector, J. Kuczyński, H. Woźniakowski, "Estimating the Largest Eigenvalue by the Power and
//! Lanczos Algorithms with a Random Start" (1992).

use super::matrix::Matrix;
use super::tridiagonal::Tridiagonal;
use super::{FemError, Spectrum};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Lanczos steps for a largest eigenvalue. From a random vector the relative error, always from below, is expected to be
/// at most 0.103 (ln(n (k − 1)⁴) / (k − 1))² for k steps: 0.3 % at n = 10⁶, whatever the matrix. An isolated eigenvalue,
/// such as one bad triangle makes, is found up to rounding.
pub(super) const STEPS: usize = 200;

/// Conjugate gradients, from zero; can be run on.
pub(super) struct ConjugateGradients<'a> {
    matrix: &'a Matrix,
    /// Reciprocals of the diagonal.
    preconditioner: Vec<f64>,
    solution: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    /// r · D⁻¹ r.
    energy: f64,
    load_norm: f64,
    /// How far each iteration went along its direction.
    lengths: Vec<f64>,
    /// How much of its direction each iteration kept.
    kept: Vec<f64>,
}

impl<'a> ConjugateGradients<'a> {
    /// At the start, with zero for a solution.
    pub fn new(matrix: &'a Matrix, load: &[f64]) -> Self {
        let preconditioner: Vec<f64> = matrix.diagonal().iter().map(|diagonal| 1.0 / diagonal).collect();
        let direction: Vec<f64> = load.iter().zip(&preconditioner).map(|(r, d)| r * d).collect();
        Self {
            matrix,
            energy: dot(load, &direction),
            preconditioner,
            solution: vec![0.0; load.len()],
            residual: load.to_vec(),
            direction,
            image: vec![0.0; load.len()],
            load_norm: dot(load, load).sqrt(),
            lengths: Vec::new(),
            kept: Vec::new(),
        }
    }

    /// Iterates until the residual is at most `to` times the right-hand side; false if that takes more than `limit`
    /// iterations in all, or if rounding leaves no direction to go.
    pub fn run(&mut self, to: f64, limit: usize) -> bool {
        while self.relative_residual() > to {
            if self.lengths.len() >= limit || !self.step() {
                return false;
            }
        }
        true
    }

    /// Iterations so far.
    pub fn iterations(&self) -> usize {
        self.lengths.len()
    }

    /// The solution, after running on.
    pub fn finish(mut self, to: f64, limit: usize) -> Result<Vec<f64>, FemError> {
        if self.run(to, limit) {
            Ok(self.solution)
        } else {
            Err(FemError::NotConverged {
                iterations: self.iterations(),
                residual: self.relative_residual(),
            })
        }
    }

    fn relative_residual(&self) -> f64 {
        if self.load_norm > 0.0 {
            dot(&self.residual, &self.residual).sqrt() / self.load_norm
        } else {
            0.0
        }
    }

    fn step(&mut self) -> bool {
        self.matrix.multiply(&self.direction, &mut self.image);
        let length = self.energy / dot(&self.direction, &self.image);
        if !length.is_finite() || length <= 0.0 {
            return false;
        }
        let mut energy = 0.0;
        for k in 0..self.residual.len() {
            self.solution[k] += length * self.direction[k];
            self.residual[k] -= length * self.image[k];
            energy += self.residual[k] * self.residual[k] * self.preconditioner[k];
        }
        let kept = energy / self.energy;
        for k in 0..self.residual.len() {
            self.direction[k] = self.residual[k] * self.preconditioner[k] + kept * self.direction[k];
        }
        self.energy = energy;
        self.lengths.push(length);
        self.kept.push(kept);
        true
    }

    /// The preconditioned matrix on the Krylov space so far, in the basis of the scaled residuals.
    fn tridiagonal(&self) -> Tridiagonal {
        let before = |k: usize| {
            if k > 0 {
                self.kept[k - 1] / self.lengths[k - 1]
            } else {
                0.0
            }
        };
        let steps = 0..self.lengths.len();
        Tridiagonal {
            diagonal: steps.clone().map(|k| 1.0 / self.lengths[k] + before(k)).collect(),
            beside: steps.map(|k| self.kept[k].sqrt() / self.lengths[k]).collect(),
        }
    }
}

/// The ends of the spectrum, from what conjugate gradients have done and two runs of Lanczos; none without unknowns.
pub(super) fn spectrum(cg: &ConjugateGradients) -> Option<Spectrum> {
    let size = cg.matrix.size();
    let plain = lanczos(size, |x, y| cg.matrix.multiply(x, y));
    let scale: Vec<f64> = cg.preconditioner.iter().map(|d| d.sqrt()).collect();
    let mut scaled = vec![0.0; size];
    let preconditioned = lanczos(size, |x, y| {
        for k in 0..size {
            scaled[k] = scale[k] * x[k];
        }
        cg.matrix.multiply(&scaled, y);
        for k in 0..size {
            y[k] *= scale[k];
        }
    });
    let [_, largest] = plain.extremes()?;
    // By symmetry the right-hand side may have no part in an end of the spectrum; a random vector hardly ever lacks one. Both
    // estimates are from inside.
    let [smallest, largest_preconditioned] = match (preconditioned.extremes()?, cg.tridiagonal().extremes()) {
        ([low, high], Some([cg_low, cg_high])) => [low.min(cg_low), high.max(cg_high)],
        (random, None) => random,
    };
    Some(Spectrum {
        largest,
        largest_preconditioned,
        smallest_preconditioned: smallest,
        condition_preconditioned: largest_preconditioned / smallest,
    })
}

/// The operator on the Krylov space of a random vector, after [`STEPS`] steps or when the space is exhausted. Lost
/// orthogonality is accepted: it repeats extreme eigenvalues and does not move them.
fn lanczos(size: usize, mut apply: impl FnMut(&[f64], &mut [f64])) -> Tridiagonal {
    let mut random = Pcg64::seed_from_u64(0);
    let mut vector: Vec<f64> = (0..size)
        .map(|_| random.next_u64() as f64 / u64::MAX as f64 - 0.5)
        .collect();
    let norm = dot(&vector, &vector).sqrt();
    vector.iter_mut().for_each(|v| *v /= norm);
    let mut previous = vec![0.0; size];
    let mut next = vec![0.0; size];
    let mut result = Tridiagonal::default();
    let mut beside = 0.0;
    for _ in 0..STEPS.min(size) {
        apply(&vector, &mut next);
        let diagonal = dot(&vector, &next);
        for k in 0..size {
            next[k] -= diagonal * vector[k] + beside * previous[k];
        }
        result.diagonal.push(diagonal);
        beside = dot(&next, &next).sqrt();
        if beside <= f64::EPSILON * diagonal.abs() {
            break;
        }
        result.beside.push(beside);
        for k in 0..size {
            (previous[k], vector[k]) = (vector[k], next[k] / beside);
        }
    }
    result
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}
