//! Rows that are mostly zeros, such as occupancy vectors.

use super::vector::{add_rows_scaled, wide};
use rayon::prelude::*;

/// The non-zero values of a batch of rows.
#[derive(Debug, Clone, Default)]
pub(super) struct SparseRows {
    /// Where each row's entries start, and the end of the last.
    starts: Vec<usize>,
    entries: Vec<(u32, f32)>,
}

/// Rows of a product, or of a gradient, that one task computes.
const ROWS_PER_TASK: usize = 64;

/// Values that are looked at together while searching for those that are not zero.
const LANES: usize = 16;

impl SparseRows {
    pub(super) fn fill<'a>(&mut self, rows: impl Iterator<Item = &'a [f32]>) {
        self.starts.clear();
        self.starts.push(0);
        self.entries.clear();
        for row in rows {
            wide(|| self.push(row));
            self.starts.push(self.entries.len());
        }
    }

    #[expect(clippy::inline_always, reason = "to be compiled for wide vectors")]
    #[inline(always)]
    fn push(&mut self, row: &[f32]) {
        for (chunk, first) in row.chunks(LANES).zip((0..).step_by(LANES)) {
            // Without a branch per value: most chunks are all zeros.
            let bits = chunk.iter().fold(0, |bits, value| bits | value.to_bits());
            if bits << 1 != 0 {
                let values = chunk.iter().zip(first..).filter(|&(&value, _)| value != 0.0);
                self.entries.extend(values.map(|(&value, column)| (column, value)));
            }
        }
    }

    fn row(&self, index: usize) -> &[(u32, f32)] {
        &self.entries[self.starts[index]..self.starts[index + 1]]
    }

    /// `out = rows · matrix + bias`: sums of the matrix's rows.
    pub(super) fn multiply(&self, matrix: &[f32], bias: &[f32], out: &mut [f32]) {
        let columns = bias.len();
        out.par_chunks_mut(ROWS_PER_TASK * columns).enumerate().for_each(|(task, out)| {
            wide(|| {
                for (out, row) in out.chunks_exact_mut(columns).zip(task * ROWS_PER_TASK..) {
                    out.copy_from_slice(bias);
                    add_rows_scaled(out, self.row(row), matrix);
                }
            });
        });
    }

    /// `out = rowsᵀ · right`, for right with as many rows and so many columns.
    pub(super) fn transposed_multiply(&self, right: &[f32], columns: usize, out: &mut [f32]) {
        let transposed = self.transposed(out.len() / columns);
        out.par_chunks_mut(ROWS_PER_TASK * columns).enumerate().for_each(|(task, out)| {
            wide(|| {
                for (out, row) in out.chunks_exact_mut(columns).zip(task * ROWS_PER_TASK..) {
                    out.fill(0.0);
                    add_rows_scaled(out, transposed.row(row), right);
                }
            });
        });
    }

    /// The columns as rows, of which there are so many.
    fn transposed(&self, rows: usize) -> Self {
        let mut starts = vec![0; rows + 1];
        for &(column, _) in &self.entries {
            starts[column as usize + 1] += 1;
        }
        for row in 0..rows {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut entries = vec![(0, 0.0); self.entries.len()];
        for row in 0..self.starts.len() - 1 {
            for &(column, value) in self.row(row) {
                entries[next[column as usize]] = (row as u32, value);
                next[column as usize] += 1;
            }
        }
        Self { starts, entries }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_the_dense_matrix() {
        let (rows, inner, columns) = (5, 37, 3);
        let dense: Vec<f32> =
            (0..rows * inner).map(|k| if k % 7 == 0 { k as f32 } else { 0.0 }).collect();
        let matrix: Vec<f32> = (0..inner * columns).map(|k| (k % 11) as f32).collect();
        let mut sparse = SparseRows::default();
        sparse.fill(dense.chunks_exact(inner));
        let mut product = vec![0.0; rows * columns];
        sparse.multiply(&matrix, &[1.0, 2.0, 3.0], &mut product);
        for row in 0..rows {
            for column in 0..columns {
                let expected: f32 = (0..inner)
                    .map(|k| dense[row * inner + k] * matrix[k * columns + column])
                    .sum::<f32>()
                    + (column + 1) as f32;
                assert!((product[row * columns + column] - expected).abs() < 1e-3);
            }
        }
        let mut gradient = vec![9.0; inner * columns];
        sparse.transposed_multiply(&product, columns, &mut gradient);
        for k in 0..inner {
            for column in 0..columns {
                let expected: f32 = (0..rows)
                    .map(|row| dense[row * inner + k] * product[row * columns + column])
                    .sum();
                assert!((gradient[k * columns + column] - expected).abs() <= 1e-5 * expected.abs());
            }
        }
    }
}
