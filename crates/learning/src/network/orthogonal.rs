//! Orthogonal initialisation.

use rand::Rng;
use sonarfleet::random::Stream;
use std::f64::consts::TAU;

/// Fills a matrix, [row, column], with a uniformly random one whose rows (or, where it
/// has more rows than columns, whose columns) are orthogonal and have length `gain`
/// (Saxe, McClelland & Ganguli 2014, arXiv:1312.6120).
pub fn orthogonal(weights: &mut [f32], columns: usize, gain: f64, random: &mut Stream) {
    let rows = weights.len() / columns;
    let (count, length) = (rows.min(columns), rows.max(columns));
    let mut vectors: Vec<Vec<f64>> = Vec::with_capacity(count);
    while vectors.len() < count {
        let mut vector: Vec<f64> = (0..length).map(|_| gaussian(random)).collect();
        // Twice: the second pass removes what rounding left of the first.
        for _ in 0..2 {
            for known in &vectors {
                let along: f64 = known.iter().zip(&vector).map(|(a, b)| a * b).sum();
                for (value, known) in vector.iter_mut().zip(known) {
                    *value -= along * known;
                }
            }
        }
        let norm = vector.iter().map(|value| value * value).sum::<f64>().sqrt();
        vectors.push(vector.into_iter().map(|value| value / norm).collect());
    }
    for (index, weight) in weights.iter_mut().enumerate() {
        let (row, column) = (index / columns, index % columns);
        let value = if rows <= columns { vectors[row][column] } else { vectors[column][row] };
        *weight = (gain * value) as f32;
    }
}

/// A standard normal number (Box & Muller 1958, doi:10.1214/aoms/1177706645).
fn gaussian(random: &mut Stream) -> f64 {
    let radius: f64 = 1.0 - random.random::<f64>();
    let angle: f64 = random.random();
    (-2.0 * radius.ln()).sqrt() * (TAU * angle).cos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sonarfleet::random::stream;

    /// Rounding of the weights to single precision.
    const ROUNDING: f64 = 1e-6;

    #[test]
    fn rows_or_columns_are_orthogonal_and_of_the_gains_length() {
        for (rows, columns) in [(3, 7), (7, 3), (5, 5), (1, 4), (4, 1)] {
            let mut weights = vec![0.0; rows * columns];
            orthogonal(&mut weights, columns, 2.0, &mut stream(1, "test/orthogonal", 0));
            let at = |vector: usize, k: usize| {
                let index =
                    if rows <= columns { vector * columns + k } else { k * columns + vector };
                f64::from(weights[index])
            };
            for a in 0..rows.min(columns) {
                for b in 0..rows.min(columns) {
                    let product: f64 = (0..rows.max(columns)).map(|k| at(a, k) * at(b, k)).sum();
                    let expected = if a == b { 4.0 } else { 0.0 };
                    assert!((product - expected).abs() < 4.0 * ROUNDING, "{a} {b}: {product}");
                }
            }
        }
    }
}
