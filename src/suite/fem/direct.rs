//! The one door to the sparse direct solver: see the [module's page](super) for why it is rsparse.

use super::FemError;
use super::matrix::Matrix;
use rsparse::data::Sprs;

/// Cholesky with approximate minimum degree ordering of A + Aᵀ, in rsparse's numbering of orderings.
const MINIMUM_DEGREE: i8 = 0;

/// The order as it is.
const NATURAL: i8 = -1;

/// The solution of A x = b for a symmetric positive definite A.
pub(super) fn solve(matrix: &Matrix, right: &[f64]) -> Result<Vec<f64>, FemError> {
    let size = matrix.size();
    if size == 0 {
        return Ok(Vec::new());
    }
    let (first, columns, values) = matrix.compressed();
    let copy = Sprs {
        nzmax: values.len(),
        m: size,
        n: size,
        p: first.iter().map(|start| *start as isize).collect(),
        i: columns.iter().map(|column| *column as usize).collect(),
        x: values.to_vec(),
    };
    // With one unknown there is nothing to order, and the ordering would subtract two.
    let order = if size == 1 { NATURAL } else { MINIMUM_DEGREE };
    let mut solution = right.to_vec();
    rsparse::cholsol(&copy, &mut solution, order).map_err(|_| FemError::Singular { unknowns: size })?;
    Ok(solution)
}
