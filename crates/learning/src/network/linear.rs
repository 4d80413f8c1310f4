//! Fully connected layers.

use super::matrix::{Factor, Matrix, MatrixMut, multiply};
use super::orthogonal::orthogonal;
use super::sparse::SparseRows;
use super::vector::wide;
use rayon::prelude::*;
use sonarfleet::random::Stream;

/// A fully connected layer y = x·W + b. Its weights lie in one slice: W
/// [input, output], then b `[output]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Linear {
    /// Length of x.
    pub inputs: usize,
    /// Length of y.
    pub outputs: usize,
}

/// Rows that one task computes, whatever the number of threads, so that the bits do
/// not depend on it.
const ROWS_PER_TASK: usize = 64;

impl Linear {
    /// Number of weights.
    pub const fn weight_count(&self) -> usize {
        (self.inputs + 1) * self.outputs
    }

    /// Orthogonal weights of a gain, and biases 0.
    pub fn initialise(&self, weights: &mut [f32], gain: f64, random: &mut Stream) {
        let (matrix, bias) = weights.split_at_mut(self.inputs * self.outputs);
        orthogonal(matrix, self.outputs, gain, random);
        bias.fill(0.0);
    }

    /// `y = x·W + b` for x [row, input] and y [row, output].
    pub fn forward(&self, weights: &[f32], x: &[f32], y: &mut [f32]) {
        let (w, bias) = weights.split_at(self.inputs * self.outputs);
        let w = Factor::with_bias(Matrix::new(w, self.outputs), bias, x.len() / self.inputs);
        y.par_chunks_mut(ROWS_PER_TASK * self.outputs)
            .zip(x.par_chunks(ROWS_PER_TASK * self.inputs))
            .for_each(|(y, x)| {
                let mut y = MatrixMut::new(y, self.outputs);
                multiply(&mut y, &Matrix::new(x, self.inputs), &w);
            });
    }

    /// The same for sparse x.
    pub(super) fn forward_sparse(&self, weights: &[f32], x: &SparseRows, y: &mut [f32]) {
        let (w, bias) = weights.split_at(self.inputs * self.outputs);
        x.multiply(w, bias, y);
    }

    /// The gradient in x, [row, input], from that in y.
    pub fn backward_input(&self, weights: &[f32], y_gradient: &[f32], x_gradient: &mut [f32]) {
        let w = Matrix::new(&weights[..self.inputs * self.outputs], self.outputs);
        let w = Factor::new(w.transposed(), y_gradient.len() / self.outputs);
        x_gradient
            .par_chunks_mut(ROWS_PER_TASK * self.inputs)
            .zip(y_gradient.par_chunks(ROWS_PER_TASK * self.outputs))
            .for_each(|(x, y)| {
                let mut x = MatrixMut::new(x, self.inputs);
                multiply(&mut x, &Matrix::new(y, self.outputs), &w);
            });
    }

    /// The gradient in the weights, from x and the gradient in y.
    pub fn backward_weights(&self, x: &[f32], y_gradient: &[f32], gradient: &mut [f32]) {
        let (w, bias) = gradient.split_at_mut(self.inputs * self.outputs);
        rayon::join(|| self.backward_matrix(x, y_gradient, w), || sum_of_rows(y_gradient, bias));
    }

    /// The same for sparse x.
    pub(super) fn backward_weights_sparse(
        &self,
        x: &SparseRows,
        y_gradient: &[f32],
        gradient: &mut [f32],
    ) {
        let (w, bias) = gradient.split_at_mut(self.inputs * self.outputs);
        rayon::join(
            || x.transposed_multiply(y_gradient, self.outputs, w),
            || sum_of_rows(y_gradient, bias),
        );
    }

    /// `gradient = xᵀ · y_gradient`, [input, output].
    pub(super) fn backward_matrix(&self, x: &[f32], y_gradient: &[f32], gradient: &mut [f32]) {
        let inputs = Matrix::new(x, self.inputs).transposed();
        // Rows of `inputs` are not contiguous: always packed.
        let y = Factor::new(Matrix::new(y_gradient, self.outputs), usize::MAX);
        gradient.par_chunks_mut(ROWS_PER_TASK * self.outputs).enumerate().for_each(|(task, w)| {
            let part = inputs.rows(task * ROWS_PER_TASK, w.len() / self.outputs);
            multiply(&mut MatrixMut::new(w, self.outputs), &part, &y);
        });
    }
}

/// Rectified linear units, in place.
pub(super) fn relu(values: &mut [f32]) {
    wide(|| {
        for value in values {
            *value = if *value > 0.0 { *value } else { 0.0 };
        }
    });
}

/// The gradient before rectified linear units from that after them, in place.
pub(super) fn relu_backward(outputs: &[f32], gradient: &mut [f32]) {
    wide(|| {
        for (slope, &output) in gradient.iter_mut().zip(outputs) {
            *slope = if output > 0.0 { *slope } else { 0.0 };
        }
    });
}

fn sum_of_rows(rows: &[f32], sum: &mut [f32]) {
    sum.fill(0.0);
    wide(|| {
        for row in rows.chunks_exact(sum.len()) {
            for (sum, value) in sum.iter_mut().zip(row) {
                *sum += value;
            }
        }
    });
}
