//! A sparse symmetric matrix, by rows.

use crate::mesh::Lists;

/// A sparse matrix with both its halves, by rows, each in the order of its columns.
#[derive(Clone, Debug)]
pub(super) struct Matrix {
    /// Row r is `first[r]..first[r + 1]`.
    first: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl Matrix {
    /// A matrix of zeros, with entries on the diagonal and where two vertices that `row_of` numbers are neighbours.
    pub fn zeros(row_of: &[Option<u32>], neighbours: &Lists) -> Self {
        let mut first = vec![0];
        let mut columns = Vec::new();
        for (vertex, row) in row_of.iter().enumerate() {
            let Some(row) = row else { continue };
            let start = columns.len();
            columns.push(*row);
            columns.extend(neighbours.get(vertex).iter().filter_map(|n| row_of[*n as usize]));
            columns[start..].sort_unstable();
            first.push(columns.len());
        }
        let values = vec![0.0; columns.len()];
        Self { first, columns, values }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.first.len() - 1
    }

    /// The entries of a row, as columns and values.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.first[row]..self.first[row + 1];
        let columns = self.columns[range.clone()].iter().map(|column| *column as usize);
        columns.zip(self.values[range].iter().copied())
    }

    /// Adds to an entry of the pattern; an entry outside the pattern stays zero.
    pub fn add(&mut self, row: u32, column: u32, value: f64) {
        let start = self.first[row as usize];
        let entries = &self.columns[start..self.first[row as usize + 1]];
        if let Ok(place) = entries.binary_search(&column) {
            self.values[start + place] += value;
        }
    }

    /// y = A x.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        for (row, y) in y.iter_mut().enumerate() {
            *y = self.row(row).map(|(column, value)| value * x[column]).sum();
        }
    }

    /// The diagonal.
    pub fn diagonal(&self) -> Vec<f64> {
        let at = |row| {
            self.row(row)
                .filter(move |(column, _)| *column == row)
                .map(|(_, value)| value)
        };
        (0..self.size()).map(|row| at(row).sum()).collect()
    }

    /// The parts of compressed storage: starts of rows, columns, values. By symmetry they are those of columns too.
    pub fn compressed(&self) -> (&[usize], &[u32], &[f64]) {
        (&self.first, &self.columns, &self.values)
    }
}
