//! The smallest eigenvalues of a small dense symmetric matrix, faster than a
//! general eigensolver, which finds them all.

/// The `index`-th smallest eigenvalue (from 0) of a symmetric matrix, [row, column],
/// which is destroyed.
///
/// Householder's tridiagonalisation and multisection with Sturm counts (Golub &
/// Van Loan, *Matrix Computations*, 2013, sections 8.3.1 and 8.4.1): about n³
/// multiplications, exact to the rounding of the matrix.
pub(super) fn symmetric_eigenvalue(matrix: &mut [f64], order: usize, index: usize) -> f64 {
    let largest = matrix.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    if largest < SMALLEST {
        return 0.0;
    }
    let (diagonal, off_diagonal_squared) = tridiagonalise(matrix, order, largest);
    multisection(&diagonal, &off_diagonal_squared, index)
}

/// Matrices of smaller values, whose squares are no longer exact, count as 0.
const SMALLEST: f64 = 1e-100;

/// Rows that are shorter than this times the matrix's largest value count as 0: they
/// are far below its rounding, and the squares of still shorter ones are not exact.
const NEGLIGIBLE: f64 = 1e-25;

/// Diagonal and squared off-diagonal of a tridiagonal matrix with the same
/// eigenvalues. Rows are taken from the last to the second, so that the remaining
/// matrix is always the leading block.
fn tridiagonalise(matrix: &mut [f64], n: usize, largest: f64) -> (Vec<f64>, Vec<f64>) {
    let negligible = (NEGLIGIBLE * largest).powi(2);
    let mut squares = vec![0.0; n];
    let mut product = vec![0.0; n];
    for k in (1..n).rev() {
        let (block, rest) = matrix.split_at_mut(k * n);
        let v = &mut rest[..k];
        let norm_squared: f64 = v.iter().map(|x| x * x).sum();
        if norm_squared < negligible {
            continue;
        }
        // Row k becomes (0, …, 0, ∓norm, diagonal).
        squares[k] = norm_squared;
        let last = v[k - 1];
        if k == 1 || norm_squared <= last * last {
            continue;
        }
        let norm = norm_squared.sqrt();
        v[k - 1] += norm.copysign(last);
        // H = I − βvvᵀ; A ← HAH = A − vwᵀ − wvᵀ with p = βAv, w = p − (β/2)(pᵀv)v.
        let beta = 1.0 / (norm_squared + norm * last.abs());
        let p = &mut product[..k];
        p.fill(0.0);
        // Whole rows: sums of rows run in parallel lanes, scalar products do not.
        for (row, v_i) in block.chunks_exact(n).zip(v.iter()) {
            for (p, a) in p.iter_mut().zip(row) {
                *p += v_i * a;
            }
        }
        let mut along = 0.0;
        for (p, v) in p.iter_mut().zip(v.iter()) {
            *p *= beta;
            along += *p * v;
        }
        for (p, v) in p.iter_mut().zip(v.iter()) {
            *p -= 0.5 * beta * along * v;
        }
        for ((row, v_i), w_i) in block.chunks_exact_mut(n).zip(v.iter()).zip(p.iter()) {
            for ((a, v), w) in row.iter_mut().zip(v.iter()).zip(p.iter()) {
                *a -= v_i * w + w_i * v;
            }
        }
    }
    let diagonal = (0..n).map(|i| matrix[i * n + i]).collect();
    (diagonal, squares)
}

/// Points at which eigenvalues are counted side by side: their divisions overlap.
const SECTIONS: usize = 8;

/// The `index`-th smallest eigenvalue of a tridiagonal matrix.
fn multisection(diagonal: &[f64], off_diagonal_squared: &[f64], index: usize) -> f64 {
    // Gershgorin's discs.
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (i, centre) in diagonal.iter().enumerate() {
        let next = off_diagonal_squared.get(i + 1).copied().unwrap_or(0.0);
        let radius = off_diagonal_squared[i].sqrt() + next.sqrt();
        low = low.min(centre - radius);
        high = high.max(centre + radius);
    }
    let smallest = f64::EPSILON * low.abs().max(high.abs());
    while high - low > smallest {
        let step = (high - low) / (SECTIONS + 1) as f64;
        let points: [f64; SECTIONS] = std::array::from_fn(|i| low + step * (i + 1) as f64);
        let counts = count_below(diagonal, off_diagonal_squared, points, smallest);
        let above = counts.iter().position(|&count| count > index as f64).unwrap_or(SECTIONS);
        if above < SECTIONS {
            high = points[above];
        }
        if above > 0 {
            low = points[above - 1];
        }
        // Where the interval no longer shrinks, neighbouring numbers are reached.
        if step <= 0.25 * smallest {
            break;
        }
    }
    0.5 * (low + high)
}

/// Number of eigenvalues below each point: of negative pivots of T − xI.
fn count_below(
    diagonal: &[f64],
    off_diagonal_squared: &[f64],
    points: [f64; SECTIONS],
    smallest: f64,
) -> [f64; SECTIONS] {
    let mut counts = [0.0; SECTIONS];
    let mut pivots = [1.0; SECTIONS];
    for (centre, square) in diagonal.iter().zip(off_diagonal_squared) {
        for ((pivot, count), point) in pivots.iter_mut().zip(&mut counts).zip(&points) {
            let next = centre - point - square / *pivot;
            // A pivot of 0 is moved by less than the rounding of the matrix.
            *pivot = if next.abs() < 0.01 * smallest { -0.01 * smallest } else { next };
            *count += if *pivot < 0.0 { 1.0 } else { 0.0 };
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;
    use faer::{Mat, Side};
    use rand::Rng;

    /// Rounding of both eigensolvers, relative to the largest eigenvalue.
    const ROUNDING: f64 = 2e-14;

    fn agrees_with_faer(matrix: &[f64], n: usize, what: &str) {
        let matrix: Vec<f64> =
            (0..n * n).map(|k| matrix[(k / n).max(k % n) * n + (k / n).min(k % n)]).collect();
        let whole = Mat::from_fn(n, n, |i, j| matrix[i * n + j]);
        let expected = whole.self_adjoint_eigenvalues(Side::Lower).unwrap();
        let largest = expected.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        for (index, value) in expected.iter().enumerate() {
            let found = symmetric_eigenvalue(&mut matrix.clone(), n, index);
            assert!(
                (found - value).abs() <= ROUNDING * largest.max(1e-300),
                "{what}, order {n}, eigenvalue {index}: {found}, faer {value}"
            );
        }
    }

    #[test]
    fn random_matrices_have_faers_eigenvalues() {
        for index in 0..60 {
            let mut random = stream(5, "test/matrix", index);
            let n = random.random_range(1..45);
            let full = random.random_range(0.05..1.0);
            let matrix: Vec<f64> = (0..n * n)
                .map(|_| {
                    let filled = random.random::<f64>() < full;
                    if filled { random.random_range(-1.0..1.0) } else { 0.0 }
                })
                .collect();
            agrees_with_faer(&matrix, n, "random");
        }
    }

    #[test]
    fn values_of_any_size_are_met() {
        for index in 0..60 {
            let mut random = stream(6, "test/matrix", index);
            let n = random.random_range(2..45);
            // Whole rows are large or so small that their squares vanish.
            let sizes: Vec<f64> =
                (0..n).map(|_| 10.0_f64.powf(random.random_range(-330.0..10.0))).collect();
            let matrix: Vec<f64> = (0..n * n)
                .map(|k| sizes[k / n].min(sizes[k % n]) * random.random_range(-1.0..1.0))
                .collect();
            agrees_with_faer(&matrix, n, "of many sizes");
            let mut tiny: Vec<f64> = matrix.iter().map(|value| 1e-300 * value).collect();
            assert!(symmetric_eigenvalue(&mut tiny, n, n - 1).abs() < 1e-280);
        }
    }

    #[test]
    fn multiple_and_zero_eigenvalues_are_met() {
        for n in [1, 2, 3, 10] {
            agrees_with_faer(&vec![0.0; n * n], n, "zero");
            agrees_with_faer(&vec![1.0; n * n], n, "ones");
            let identity: Vec<f64> =
                (0..n * n).map(|k| f64::from(u8::from(k / n == k % n))).collect();
            agrees_with_faer(&identity, n, "identity");
        }
    }
}
