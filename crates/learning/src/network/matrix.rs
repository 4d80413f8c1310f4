//! Matrices in slices, and their products on one thread.

use super::vector::{dot, wide};
use ndarray::linalg::general_mat_mul;
use ndarray::{ArrayView2, ArrayViewMut2, ShapeBuilder};

/// Rows up to which a product goes through the right matrix as it lies: packing it for
/// the general kernel takes longer than a few rows' products.
const FEW_ROWS: usize = 8;

const FITS: &str = "the slice holds the matrix";

/// A slice seen as rows of so many columns.
pub(crate) fn matrix(values: &[f32], columns: usize) -> ArrayView2<'_, f32> {
    ArrayView2::from_shape((values.len() / columns, columns), values).expect(FITS)
}

/// A slice seen as rows of so many columns.
pub(crate) fn matrix_mut(values: &mut [f32], columns: usize) -> ArrayViewMut2<'_, f32> {
    ArrayViewMut2::from_shape((values.len() / columns, columns), values).expect(FITS)
}

/// The rows of one step, [sequence, column], of values [sequence, step, column].
pub(super) fn at_step(
    values: &[f32],
    step: usize,
    steps: usize,
    columns: usize,
) -> ArrayView2<'_, f32> {
    let shape = (values.len() / (steps * columns), columns).strides((steps * columns, 1));
    ArrayView2::from_shape(shape, &values[step * columns..]).expect(FITS)
}

/// The rows of one step, [sequence, column], of values [sequence, step, column].
pub(super) fn at_step_mut(
    values: &mut [f32],
    step: usize,
    steps: usize,
    columns: usize,
) -> ArrayViewMut2<'_, f32> {
    let shape = (values.len() / (steps * columns), columns).strides((steps * columns, 1));
    ArrayViewMut2::from_shape(shape, &mut values[step * columns..]).expect(FITS)
}

/// `out = left · right`.
pub(crate) fn multiply(
    out: &mut ArrayViewMut2<'_, f32>,
    left: &ArrayView2<'_, f32>,
    right: &ArrayView2<'_, f32>,
) {
    if left.nrows() <= FEW_ROWS {
        out.fill(0.0);
        multiply_add(out, left, right);
    } else {
        general_mat_mul(1.0, left, right, 0.0, out);
    }
}

/// `out += left · right`.
pub(crate) fn multiply_add(
    out: &mut ArrayViewMut2<'_, f32>,
    left: &ArrayView2<'_, f32>,
    right: &ArrayView2<'_, f32>,
) {
    if left.nrows() > FEW_ROWS || !add_few_rows(out, left, right) {
        general_mat_mul(1.0, left, right, 1.0, out);
    }
}

/// The product for a few rows, where all rows, of the right matrix or of its
/// transpose, lie in slices; false where they do not, and nothing is done.
fn add_few_rows(
    out: &mut ArrayViewMut2<'_, f32>,
    left: &ArrayView2<'_, f32>,
    right: &ArrayView2<'_, f32>,
) -> bool {
    let rows: Option<Vec<&[f32]>> = left.rows().into_iter().map(|row| row.to_slice()).collect();
    let Some(rows) = rows else { return false };
    let mut sums = Vec::with_capacity(rows.len());
    for sum in out.rows_mut() {
        let Some(sum) = sum.into_slice() else { return false };
        sums.push(sum);
    }
    if let Some(values) = right.to_slice() {
        wide(|| {
            let columns = right.ncols();
            for (four, first) in values.chunks(4 * columns).zip((0..).step_by(4)) {
                for (sum, row) in sums.iter_mut().zip(&rows) {
                    add_four(sum, &row[first..], four);
                }
            }
        });
        true
    } else if let Some(values) = right.t().to_slice() {
        wide(|| {
            for (column, right) in values.chunks_exact(right.nrows()).enumerate() {
                for (sum, row) in sums.iter_mut().zip(&rows) {
                    sum[column] += dot(row, right);
                }
            }
        });
        true
    } else {
        false
    }
}

/// Adds up to four rows times the first factors.
#[expect(clippy::inline_always, reason = "to be compiled for wide vectors")]
#[inline(always)]
fn add_four(sum: &mut [f32], factors: &[f32], rows: &[f32]) {
    let columns = sum.len();
    if let (&[a, b, c, d, ..], true) = (factors, rows.len() == 4 * columns) {
        let (first, rest) = rows.split_at(columns);
        let (second, rest) = rest.split_at(columns);
        let (third, fourth) = rest.split_at(columns);
        for k in 0..columns {
            sum[k] += (a * first[k] + b * second[k]) + (c * third[k] + d * fourth[k]);
        }
    } else {
        for (row, factor) in rows.chunks_exact(columns).zip(factors) {
            for (sum, value) in sum.iter_mut().zip(row) {
                *sum += factor * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;
    use sonarfleet::random::stream;

    /// Single precision over a few dozen products of size 1.
    const ROUNDING: f64 = 1e-5;

    /// All shapes and strides that occur, small ones above all, with values beside the
    /// result that must stay as they are.
    #[test]
    fn products_are_those_of_the_triple_loop() {
        let mut random = stream(2, "test/matrix", 0);
        for rows in [1, 2, 7, 8, 9, 17] {
            for inner in [1, 3, 4, 5, 16, 33] {
                for columns in [1, 2, 3, 8, 15, 20, 33] {
                    let mut draw = |count: usize| -> Vec<f32> {
                        (0..count).map(|_| random.random_range(-1.0..1.0)).collect()
                    };
                    let steps = 3;
                    let (left, right) = (draw(rows * inner), draw(inner * columns));
                    let start = draw(rows * steps * columns);
                    let transposed: Vec<f32> = (0..columns * inner)
                        .map(|k| right[k % inner * columns + k / inner])
                        .collect();
                    for right in [matrix(&right, columns), matrix(&transposed, inner).t()] {
                        let mut sums = start.clone();
                        let mut out = at_step_mut(&mut sums, 1, steps, columns);
                        multiply_add(&mut out, &matrix(&left, inner), &right);
                        for (index, (sum, start)) in sums.iter().zip(&start).enumerate() {
                            let (row, step, column) = (
                                index / (steps * columns),
                                index / columns % steps,
                                index % columns,
                            );
                            let product: f64 = (0..inner)
                                .map(|k| {
                                    f64::from(left[row * inner + k]) * f64::from(right[[k, column]])
                                })
                                .sum();
                            let added = if step == 1 { product } else { 0.0 };
                            let error = (f64::from(*sum) - f64::from(*start) - added).abs();
                            assert!(error < ROUNDING, "{rows} {inner} {columns} at {index}");
                        }
                        let mut out = vec![f32::NAN; rows * columns];
                        multiply(&mut matrix_mut(&mut out, columns), &matrix(&left, inner), &right);
                        assert!(out.iter().all(|value| value.is_finite()));
                    }
                }
            }
        }
    }
}
