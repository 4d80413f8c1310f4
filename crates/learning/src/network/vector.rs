//! Loops over slices, compiled for the widest vectors the processor has.
#![expect(
    clippy::inline_always,
    reason = "only what is inlined into the dispatched function is compiled for wide vectors"
)]

use pulp::Arch;

/// Values that sums run through at a time.
const LANES: usize = 16;

/// Runs a loop compiled for the widest vectors there are.
#[inline(always)]
pub(crate) fn wide<R>(run: impl FnOnce() -> R) -> R {
    Arch::new().dispatch(run)
}

/// eˣ with a relative error below 2·10⁻⁷ (Cephes' `expf`), without branches; 0
/// below −87, where single precision ends, and e⁸⁸ above 88.
#[inline(always)]
pub(crate) fn exp(x: f32) -> f32 {
    const LEAST: f32 = -87.0;
    // 1.5·2²³: adding it rounds to a whole number, which its lowest bits then hold.
    const ROUND: f32 = 12_582_912.0;
    // ln 2 in two parts, so that the first product is exact.
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    let inside = x.clamp(LEAST, 88.0);
    let shifted = inside * std::f32::consts::LOG2_E + ROUND;
    let power = shifted - ROUND;
    let r = inside - power * LN_2_HIGH - power * LN_2_LOW;
    let mut tail = 1.987_569_1e-4;
    for coefficient in [1.398_199_9e-3, 8.333_452e-3, 4.166_579_6e-2, 0.166_666_66, 0.5] {
        tail = tail * r + coefficient;
    }
    let mantissa = tail * r * r + r + 1.0;
    let exponent =
        (shifted.to_bits().wrapping_sub(ROUND.to_bits()) << 23).wrapping_add(1_f32.to_bits());
    let value = mantissa * f32::from_bits(exponent);
    if x < LEAST { 0.0 } else { value }
}

/// Logistic function 1 / (1 + e⁻ˣ).
#[inline(always)]
pub(crate) fn sigmoid(x: f32) -> f32 {
    1.0 / (1.0 + exp(-x))
}

/// Hyperbolic tangent.
#[inline(always)]
pub(crate) fn tanh(x: f32) -> f32 {
    2.0 * sigmoid(2.0 * x) - 1.0
}

/// Largest value; −∞ of none.
#[inline(always)]
pub(crate) fn largest(values: &[f32]) -> f32 {
    fold(
        [f32::NEG_INFINITY; LANES],
        values,
        values,
        |most, value, _| if value > most { value } else { most },
    )
    .into_iter()
    .fold(f32::NEG_INFINITY, f32::max)
}

/// Sum of values.
#[inline(always)]
pub(crate) fn sum(values: &[f32]) -> f32 {
    fold([0.0; LANES], values, values, |sum, value, _| sum + value).iter().sum()
}

/// Scalar product.
#[inline(always)]
pub(crate) fn dot(left: &[f32], right: &[f32]) -> f32 {
    fold([0.0; LANES], left, right, |sum, left, right| sum + left * right).iter().sum()
}

/// `sum += factor · values`.
#[inline(always)]
pub(crate) fn add_scaled(sum: &mut [f32], factor: f32, values: &[f32]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}

/// `sum += Σ factor · row` over some rows of a matrix, [row, column], four at a time.
#[inline(always)]
pub(crate) fn add_rows_scaled(sum: &mut [f32], entries: &[(u32, f32)], matrix: &[f32]) {
    let count = sum.len();
    let row = |index: u32| &matrix[index as usize * count..][..count];
    let (fours, rest) = entries.as_chunks::<4>();
    for &[(i, a), (j, b), (k, c), (l, d)] in fours {
        let (x, y, z, w) = (row(i), row(j), row(k), row(l));
        for k in 0..count {
            sum[k] += (a * x[k] + b * y[k]) + (c * z[k] + d * w[k]);
        }
    }
    for &(index, factor) in rest {
        add_scaled(sum, factor, row(index));
    }
}

/// Folds lanes of two slices of one length, in an order that depends on the length
/// alone.
#[inline(always)]
fn fold(
    mut lanes: [f32; LANES],
    left: &[f32],
    right: &[f32],
    combine: impl Fn(f32, f32, f32) -> f32,
) -> [f32; LANES] {
    let (left, left_rest) = left.as_chunks::<LANES>();
    let (right, right_rest) = right.as_chunks::<LANES>();
    for (left, right) in left.iter().zip(right) {
        for ((lane, &left), &right) in lanes.iter_mut().zip(left).zip(right) {
            *lane = combine(*lane, left, right);
        }
    }
    for ((lane, &left), &right) in lanes.iter_mut().zip(left_rest).zip(right_rest) {
        *lane = combine(*lane, left, right);
    }
    lanes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_is_that_of_double_precision() {
        for step in -87_000..=88_000 {
            let x = step as f32 / 1000.0;
            let exact = f64::from(x).exp();
            let error = (f64::from(exp(x)) - exact) / exact;
            assert!(error.abs() < 2e-7, "e^{x}: relative error {error}");
        }
        assert!(exp(-1e6).to_bits() == 0 && exp(0.0).to_bits() == 1_f32.to_bits());
    }

    #[test]
    fn gates_saturate_without_overflow() {
        for (x, expected) in [(-1e4, -1.0), (0.0, 0.0), (1e4, 1.0)] {
            assert!((tanh(x) - expected).abs() < 1e-6);
        }
        for step in -1000..=1000 {
            let x = step as f32 / 100.0;
            assert!((f64::from(tanh(x)) - f64::from(x).tanh()).abs() < 3e-7);
        }
    }

    #[test]
    fn sums_take_all_values_of_any_length() {
        for length in 0..70 {
            let values: Vec<f32> = (0..length).map(|value| value as f32).collect();
            let expected = values.iter().sum::<f32>();
            assert!((sum(&values) - expected).abs() < 1e-3);
            assert!((dot(&values, &vec![2.0; length]) - 2.0 * expected).abs() < 1e-3);
            if length > 0 {
                assert!((largest(&values) - (length - 1) as f32).abs() < 1e-6);
            }
        }
    }
}
