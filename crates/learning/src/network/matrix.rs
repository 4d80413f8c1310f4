//! Matrices in slices, and their products on one thread.
//!
//! The general product is the usual one (Goto & van de Geijn 2008,
//! doi:10.1145/1356052.1356053) without its outer blocks, which matrices of at most a
//! thousand rows and columns do not need: both sides are packed, and tiles of the
//! result are summed in registers. It runs at 95 % of what a core can multiply and
//! add. The right side, mostly weights, is packed once for all tasks.
#![expect(
    clippy::inline_always,
    reason = "only what is inlined into the dispatched function is compiled for wide vectors"
)]

use super::vector::{add_scaled, dot, wide};
use pulp::{Arch, Simd, WithSimd};

/// Columns of a packed panel.
const WIDTH: usize = 32;

/// Rows up to which a product goes through the right side as it lies: packing it takes
/// longer than a few rows' products.
const FEW_ROWS: usize = 4;

/// A matrix in a slice.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Matrix<'a> {
    values: &'a [f32],
    rows: usize,
    columns: usize,
    /// Distance of neighbouring rows; 1 where columns are contiguous.
    row_step: usize,
    /// Distance of neighbouring columns; 1 where rows are contiguous.
    column_step: usize,
}

impl<'a> Matrix<'a> {
    /// Rows of so many values, one after the other.
    pub(crate) fn new(values: &'a [f32], columns: usize) -> Self {
        let rows = values.len() / columns;
        Self { values, rows, columns, row_step: columns, column_step: 1 }
    }

    /// The rows of one step, [sequence, column], of values [sequence, step, column].
    pub(super) fn at_step(values: &'a [f32], step: usize, steps: usize, columns: usize) -> Self {
        let rows = values.len() / (steps * columns);
        let values = &values[step * columns..];
        Self { values, rows, columns, row_step: steps * columns, column_step: 1 }
    }

    pub(crate) fn transposed(self) -> Self {
        Self {
            rows: self.columns,
            columns: self.rows,
            row_step: self.column_step,
            column_step: self.row_step,
            ..self
        }
    }

    /// Some rows of it.
    pub(crate) fn rows(self, first: usize, count: usize) -> Self {
        Self { values: &self.values[first * self.row_step..], rows: count, ..self }
    }

    /// A row, where rows are contiguous.
    fn row(&self, index: usize) -> &'a [f32] {
        &self.values[index * self.row_step..][..self.columns]
    }
}

/// A matrix to be written, whose rows are contiguous.
#[derive(Debug)]
pub(crate) struct MatrixMut<'a> {
    values: &'a mut [f32],
    columns: usize,
    row_step: usize,
}

impl<'a> MatrixMut<'a> {
    /// Rows of so many values, one after the other.
    pub(crate) fn new(values: &'a mut [f32], columns: usize) -> Self {
        Self { values, columns, row_step: columns }
    }

    /// The rows of one step, [sequence, column], of values [sequence, step, column].
    pub(super) fn at_step(
        values: &'a mut [f32],
        step: usize,
        steps: usize,
        columns: usize,
    ) -> Self {
        Self { values: &mut values[step * columns..], columns, row_step: steps * columns }
    }

    fn rows_mut(&mut self) -> impl Iterator<Item = &mut [f32]> {
        let columns = self.columns;
        self.values.chunks_mut(self.row_step).map(move |row| &mut row[..columns])
    }
}

/// The right side of products.
#[derive(Debug)]
pub(crate) struct Factor<'a> {
    matrix: Matrix<'a>,
    /// What products start from, added to each of their rows.
    bias: &'a [f32],
    /// [panel, row, column of the panel], the bias above the matrix's rows, filled up
    /// with zeros; empty where products have few rows.
    panels: Aligned,
}

impl<'a> Factor<'a> {
    /// A matrix prepared for products with so many rows at a time.
    pub(crate) fn new(matrix: Matrix<'a>, rows: usize) -> Self {
        Self::with_bias(matrix, &[], rows)
    }

    /// A matrix prepared for products with so many rows at a time, to each of which the
    /// bias is added.
    pub(crate) fn with_bias(matrix: Matrix<'a>, bias: &'a [f32], rows: usize) -> Self {
        if rows <= FEW_ROWS {
            return Self { matrix, bias, panels: Aligned::default() };
        }
        let length = (matrix.rows + 1) * WIDTH;
        let mut panels = Aligned::with_capacity(matrix.columns.div_ceil(WIDTH) * length);
        for first in (0..matrix.columns).step_by(WIDTH) {
            let mut row = [0.0; WIDTH];
            let end = (first + WIDTH).min(bias.len());
            for (value, bias) in row.iter_mut().zip(bias.get(first..end).unwrap_or(&[])) {
                *value = *bias;
            }
            panels.room.extend_from_slice(&row);
            pack_panel(&matrix, first, &mut panels.room);
        }
        Self { matrix, bias, panels }
    }
}

/// Values that start where a cache line does: a vector that straddles two lines takes
/// twice as long to load.
#[derive(Debug, Default)]
struct Aligned {
    room: Vec<f32>,
    start: usize,
}

impl Aligned {
    /// Values in a cache line.
    const LINE: usize = 16;

    fn with_capacity(length: usize) -> Self {
        let mut room: Vec<f32> = Vec::with_capacity(length + Self::LINE - 1);
        let start = room.as_ptr().align_offset(Self::LINE * size_of::<f32>()).min(Self::LINE - 1);
        room.resize(start, 0.0);
        Self { room, start }
    }

    const fn is_empty(&self) -> bool {
        self.room.is_empty()
    }

    fn values(&self) -> &[f32] {
        &self.room[self.start..]
    }
}

/// Appends up to [`WIDTH`] columns of a matrix as a panel.
fn pack_panel(matrix: &Matrix<'_>, first: usize, panel: &mut Vec<f32>) {
    let count = WIDTH.min(matrix.columns - first);
    if matrix.column_step == 1 {
        for index in 0..matrix.rows {
            panel.extend_from_slice(&matrix.row(index)[first..first + count]);
            panel.resize(panel.len() + WIDTH - count, 0.0);
        }
        return;
    }
    // Blocks that stay in the cache while their columns are gone through.
    const BLOCK: usize = 16;
    for start in (0..matrix.rows).step_by(BLOCK) {
        let mut rows = [[0.0; WIDTH]; BLOCK];
        for column in 0..count {
            let values = &matrix.values[(first + column) * matrix.column_step + start..];
            for (row, value) in rows.iter_mut().zip(values) {
                row[column] = *value;
            }
        }
        panel.extend_from_slice(rows[..BLOCK.min(matrix.rows - start)].as_flattened());
    }
}

/// `out = left · right`, and the bias.
pub(crate) fn multiply(out: &mut MatrixMut<'_>, left: &Matrix<'_>, right: &Factor<'_>) {
    if right.panels.is_empty() {
        for row in out.rows_mut() {
            if right.bias.is_empty() { row.fill(0.0) } else { row.copy_from_slice(right.bias) }
        }
        add_few_rows(out, left, &right.matrix);
    } else {
        Arch::new().dispatch(Product { out, left, right, add: false });
    }
}

/// `out += left · right`, for a right side without bias.
pub(crate) fn multiply_add(out: &mut MatrixMut<'_>, left: &Matrix<'_>, right: &Factor<'_>) {
    if right.panels.is_empty() {
        add_few_rows(out, left, &right.matrix);
    } else {
        Arch::new().dispatch(Product { out, left, right, add: true });
    }
}

/// A product with a packed right side.
struct Product<'a, 'o> {
    out: &'a mut MatrixMut<'o>,
    left: &'a Matrix<'a>,
    right: &'a Factor<'a>,
    add: bool,
}

impl WithSimd for Product<'_, '_> {
    type Output = ();

    /// Tiles of R rows and V vectors, [`WIDTH`] columns: as many as there are registers
    /// for.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match S::F32_LANES {
            16 => self.tiles::<S, 8, 2>(simd),
            8 => self.tiles::<S, 3, 4>(simd),
            4 => self.tiles::<S, 2, 8>(simd),
            _ => self.tiles::<S, 1, WIDTH>(simd),
        }
    }
}

impl Product<'_, '_> {
    #[inline(always)]
    fn tiles<S: Simd, const R: usize, const V: usize>(self, simd: S) {
        let Self { out, left, right, add } = self;
        let (inner, columns) = (right.matrix.rows, right.matrix.columns);
        let mut strips = vec![[0.0; R]; left.rows.div_ceil(R) * inner];
        for (strip, first) in strips.chunks_exact_mut(inner).zip((0..).step_by(R)) {
            pack_strip(left, first, strip);
        }
        for (panel, first) in
            right.panels.values().chunks_exact((inner + 1) * WIDTH).zip((0..).step_by(WIDTH))
        {
            let (panel, _) = S::as_simd_f32s(panel);
            let (panel, _) = panel.as_chunks::<V>();
            let Some((bias, panel)) = panel.split_first() else { continue };
            let count = WIDTH.min(columns - first);
            let mut rows = out.values.chunks_mut(out.row_step).take(left.rows);
            for strip in strips.chunks_exact(inner) {
                for (sums, row) in tile::<S, R, V>(simd, strip, bias, panel).iter().zip(&mut rows) {
                    put::<S, V>(simd, &mut row[first..first + count], sums, add);
                }
            }
        }
    }
}

/// Adds sums to up to [`WIDTH`] values or puts them in their place.
#[inline(always)]
fn put<S: Simd, const V: usize>(simd: S, row: &mut [f32], sums: &[S::f32s; V], add: bool) {
    if row.len() == WIDTH {
        let (vectors, _) = S::as_mut_simd_f32s(row);
        for (out, sum) in vectors.iter_mut().zip(sums) {
            *out = if add { simd.add_f32s(*out, *sum) } else { *sum };
        }
    } else {
        let mut flat = [0.0; WIDTH];
        let (vectors, _) = S::as_mut_simd_f32s(&mut flat);
        vectors.copy_from_slice(sums);
        for (out, value) in row.iter_mut().zip(flat) {
            *out = if add { *out + value } else { value };
        }
    }
}

/// Copies up to R rows to a strip, [column, row].
#[inline(always)]
fn pack_strip<const R: usize>(matrix: &Matrix<'_>, first: usize, strip: &mut [[f32; R]]) {
    let count = R.min(matrix.rows - first);
    if matrix.column_step == 1 {
        for row in 0..count {
            for (packed, value) in strip.iter_mut().zip(matrix.row(first + row)) {
                packed[row] = *value;
            }
        }
    } else {
        for (column, packed) in strip.iter_mut().enumerate() {
            let start = column * matrix.column_step + first;
            packed[..count].copy_from_slice(&matrix.values[start..start + count]);
        }
    }
}

/// Sums of the bias and the products of a strip with a panel.
#[inline(always)]
fn tile<S: Simd, const R: usize, const V: usize>(
    simd: S,
    strip: &[[f32; R]],
    bias: &[S::f32s; V],
    panel: &[[S::f32s; V]],
) -> [[S::f32s; V]; R] {
    let mut sums = [*bias; R];
    for (left, right) in strip.iter().zip(panel) {
        for (sums, left) in sums.iter_mut().zip(left) {
            let left = simd.splat_f32s(*left);
            for (sum, right) in sums.iter_mut().zip(right) {
                *sum = simd.mul_add_e_f32s(left, *right, *sum);
            }
        }
    }
    sums
}

/// `out += left · right` through the right side as it lies, for contiguous rows on the
/// left.
fn add_few_rows(out: &mut MatrixMut<'_>, left: &Matrix<'_>, right: &Matrix<'_>) {
    let mut sums: Vec<&mut [f32]> = out.rows_mut().take(left.rows).collect();
    let rows: Vec<&[f32]> = (0..left.rows).map(|row| left.row(row)).collect();
    wide(|| {
        if right.column_step == 1 {
            for first in (0..right.rows).step_by(4) {
                let four: Vec<&[f32]> =
                    (first..right.rows.min(first + 4)).map(|row| right.row(row)).collect();
                for (sums, rows) in sums.chunks_mut(2).zip(rows.chunks(2)) {
                    add_rows(sums, rows, first, &four);
                }
            }
        } else {
            let right = right.transposed();
            for column in 0..right.rows {
                for (sum, row) in sums.iter_mut().zip(&rows) {
                    sum[column] += dot(row, right.row(column));
                }
            }
        }
    });
}

/// Adds up to four rows times the factors from `first` on, to up to two sums: a row is
/// loaded once for both.
#[inline(always)]
fn add_rows(sums: &mut [&mut [f32]], factors: &[&[f32]], first: usize, rows: &[&[f32]]) {
    match (sums, factors, rows) {
        ([a, b], [left, right], [x, y, z, w]) => {
            let count = a.len();
            let (b, x, y) = (&mut b[..count], &x[..count], &y[..count]);
            let (z, w) = (&z[..count], &w[..count]);
            let l: [f32; 4] = std::array::from_fn(|k| left[first + k]);
            let r: [f32; 4] = std::array::from_fn(|k| right[first + k]);
            for k in 0..count {
                a[k] += (l[0] * x[k] + l[1] * y[k]) + (l[2] * z[k] + l[3] * w[k]);
                b[k] += (r[0] * x[k] + r[1] * y[k]) + (r[2] * z[k] + r[3] * w[k]);
            }
        }
        (sums, factors, rows) => {
            for (sum, factors) in sums.iter_mut().zip(factors) {
                for (row, factor) in rows.iter().zip(&factors[first..]) {
                    add_scaled(sum, *factor, row);
                }
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

    /// A product of each shape on one kind of vectors.
    fn agrees(multiply_add: impl Fn(&mut MatrixMut<'_>, &Matrix<'_>, Matrix<'_>)) {
        let mut random = stream(2, "test/matrix", 0);
        for rows in [1, 2, 7, 8, 9, 17, 40] {
            for inner in [1, 3, 4, 5, 16, 33] {
                for columns in [1, 2, 3, 8, 15, 20, 33, 70] {
                    let mut draw = |count: usize| -> Vec<f32> {
                        (0..count).map(|_| random.random_range(-1.0..1.0)).collect()
                    };
                    let steps = 3;
                    let (left, right) = (draw(rows * inner), draw(inner * columns));
                    let start = draw(rows * steps * columns);
                    let flip = |values: &[f32], rows: usize, columns: usize| -> Vec<f32> {
                        (0..values.len()).map(|k| values[k % rows * columns + k / rows]).collect()
                    };
                    let (left_flipped, right_flipped) =
                        (flip(&left, rows, inner), flip(&right, inner, columns));
                    let lefts =
                        [Matrix::new(&left, inner), Matrix::new(&left_flipped, rows).transposed()];
                    let rights = [
                        Matrix::new(&right, columns),
                        Matrix::new(&right_flipped, inner).transposed(),
                    ];
                    for (l, r) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        if l == 1 && rows <= FEW_ROWS {
                            continue;
                        }
                        let mut sums = start.clone();
                        let mut out = MatrixMut::at_step(&mut sums, 1, steps, columns);
                        multiply_add(&mut out, &lefts[l], rights[r]);
                        for (index, (sum, start)) in sums.iter().zip(&start).enumerate() {
                            let row = index / (steps * columns);
                            let (step, column) = (index / columns % steps, index % columns);
                            let product: f64 = (0..inner)
                                .map(|k| {
                                    f64::from(left[row * inner + k])
                                        * f64::from(right[k * columns + column])
                                })
                                .sum();
                            let added = if step == 1 { product } else { 0.0 };
                            let error = (f64::from(*sum) - f64::from(*start) - added).abs();
                            assert!(error < ROUNDING, "{rows} {inner} {columns} at {index}");
                        }
                    }
                }
            }
        }
    }

    /// All shapes and orders that occur, small ones above all, with values beside the
    /// result that must stay as they are.
    #[test]
    fn products_are_those_of_the_triple_loop() {
        agrees(|out, left, right| multiply_add(out, left, &Factor::new(right, left.rows)));
    }

    /// The same without the widest vectors: as on processors that lack them.
    #[test]
    fn narrow_vectors_do_the_same() {
        agrees(|out, left, right| {
            let right = &Factor::new(right, FEW_ROWS + 1);
            Product { out, left, right, add: true }.with_simd(pulp::Scalar);
        });
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            agrees(|out, left, right| {
                let right = &Factor::new(right, FEW_ROWS + 1);
                Simd::vectorize(simd, Product { out, left, right, add: true });
            });
        }
    }

    #[test]
    fn a_product_replaces_what_was_there() {
        for rows in [3, 20] {
            let (left, right) = (vec![1.0; rows * 5], vec![2.0; 5 * 40]);
            let mut out = vec![f32::NAN; rows * 40];
            let right = Factor::new(Matrix::new(&right, 40), rows);
            multiply(&mut MatrixMut::new(&mut out, 40), &Matrix::new(&left, 5), &right);
            assert!(out.iter().all(|value| (value - 10.0).abs() < 1e-5));
        }
    }

    #[test]
    fn a_bias_is_added_to_every_row() {
        for (rows, columns) in [(3, 40), (20, 40), (20, 64), (20, 3)] {
            let (left, right) = (vec![1.0; rows * 5], vec![2.0; 5 * columns]);
            let bias: Vec<f32> = (0..columns).map(|column| column as f32).collect();
            let mut out = vec![f32::NAN; rows * columns];
            let right = Factor::with_bias(Matrix::new(&right, columns), &bias, rows);
            multiply(&mut MatrixMut::new(&mut out, columns), &Matrix::new(&left, 5), &right);
            for (index, value) in out.iter().enumerate() {
                assert!((value - 10.0 - (index % columns) as f32).abs() < 1e-5);
            }
        }
    }
}
