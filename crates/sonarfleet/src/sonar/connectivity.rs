//! The communication graph's algebraic connectivity, λ₂, and cheaper tests of
//! whether it reaches a threshold.

use super::eigenvalue::symmetric_eigenvalue;

/// Algebraic connectivity of a graph: the second smallest eigenvalue λ₂ of its
/// Laplacian L = D − W (section 3.2 of the paper; Fiedler 1973,
/// doi:10.21136/CMJ.1973.101168). It is 0 for a disconnected graph; a lone
/// vertex counts as connected beyond any threshold, ∞.
///
/// `weights` are symmetric, [vertex, vertex]; their diagonal is not looked at.
///
/// # Panics
/// Where `weights` is not `vertices` × `vertices`.
pub fn algebraic_connectivity(weights: &[f64], vertices: usize) -> f64 {
    assert_eq!(weights.len(), vertices * vertices, "weights must be [vertex, vertex]");
    if vertices < 2 {
        return f64::INFINITY;
    }
    let mut laplacian: Vec<f64> = weights.iter().map(|weight| -weight).collect();
    for (i, row) in weights.chunks_exact(vertices).enumerate() {
        laplacian[i * vertices + i] = row.iter().sum::<f64>() - row[i];
    }
    // L is positive semidefinite: anything below 0 is rounding.
    symmetric_eigenvalue(&mut laplacian, vertices, 1).max(0.0)
}

/// Cholesky factorisation of L − τI + (τ/n + σ)·11ᵀ, which is positive definite
/// exactly where λ₂ > τ: on the constant vector its eigenvalue is σn > 0, and on
/// its complement it is L − τI. A factorisation costs n³/6 multiplications and
/// stops at the first pivot that is not positive; its inverse amplifies the
/// Fiedler vector by 1/(λ₂ − τ), so that a solve or two find it.
#[derive(Debug, Clone, Default)]
pub struct ConnectivityTest {
    vertices: usize,
    /// The factor's transpose, row by row: `factor[k·n + i]` for i ≥ k.
    factor: Vec<f64>,
}

impl ConnectivityTest {
    /// Whether λ₂ exceeds the threshold τ. Afterwards, if so,
    /// [`ConnectivityTest::sharpen`] may be called.
    ///
    /// `weights` are symmetric with a zero diagonal, [vertex, vertex]; `degrees`
    /// are their row sums.
    ///
    /// # Panics
    /// Where `weights` is not `degrees.len()` squared.
    pub fn exceeds(&mut self, weights: &[f64], degrees: &[f64], threshold: f64) -> bool {
        let n = degrees.len();
        assert_eq!(weights.len(), n * n, "weights must be [vertex, vertex]");
        self.vertices = n;
        // σ of the size of the other eigenvalues keeps the matrix well scaled.
        let shift = threshold / n as f64 + 1.0;
        self.factor.clear();
        self.factor.extend(weights.iter().map(|weight| shift - weight));
        for (i, degree) in degrees.iter().enumerate() {
            self.factor[i * n + i] += degree - threshold;
        }
        for k in 0..n {
            let (head, tail) = self.factor.split_at_mut((k + 1) * n);
            let row = &mut head[k * n + k..];
            if row[0] <= 0.0 {
                return false;
            }
            let scale = row[0].sqrt().recip();
            for value in row.iter_mut() {
                *value *= scale;
            }
            for (below, i) in tail.chunks_exact_mut(n).zip(k + 1..) {
                let multiplier = row[i - k];
                for (value, right) in below[i..].iter_mut().zip(&row[i - k..]) {
                    *value -= multiplier * right;
                }
            }
        }
        true
    }

    /// One step of inverse iteration towards the Fiedler vector, with the factor
    /// of the last graph that passed; the result has length 1 and sums to 0.
    ///
    /// # Panics
    /// Where the vector's length is not the number of that graph's vertices.
    pub fn sharpen(&self, vector: &mut [f64]) {
        let n = self.vertices;
        assert_eq!(vector.len(), n, "one value per vertex");
        for k in 0..n {
            let row = &self.factor[k * n + k..(k + 1) * n];
            let value = vector[k] / row[0];
            vector[k] = value;
            for (below, right) in vector[k + 1..].iter_mut().zip(&row[1..]) {
                *below -= value * right;
            }
        }
        for k in (0..n).rev() {
            let row = &self.factor[k * n + k..(k + 1) * n];
            let known: f64 = row[1..].iter().zip(&vector[k + 1..]).map(|(r, x)| r * x).sum();
            vector[k] = (vector[k] - known) / row[0];
        }
        let mean = vector.iter().sum::<f64>() / n as f64;
        for value in vector.iter_mut() {
            *value -= mean;
        }
        let length = vector.iter().map(|value| value * value).sum::<f64>().sqrt();
        for value in vector.iter_mut() {
            *value /= length;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;
    use rand::Rng;
    use std::f64::consts::PI;

    /// Rounding of a 20 × 20 eigenvalue problem.
    const ROUNDING: f64 = 1e-12;

    fn graph(vertices: usize, mut edge: impl FnMut(usize, usize) -> f64) -> Vec<f64> {
        let mut weights = vec![0.0; vertices * vertices];
        for i in 0..vertices {
            for j in 0..i {
                let weight = edge(i, j);
                weights[i * vertices + j] = weight;
                weights[j * vertices + i] = weight;
            }
        }
        weights
    }

    fn degrees(weights: &[f64], vertices: usize) -> Vec<f64> {
        weights.chunks_exact(vertices).map(|row| row.iter().sum()).collect()
    }

    #[test]
    fn known_graphs_have_their_known_connectivity() {
        for n in [2, 3, 7, 20] {
            let at = |truth: bool| f64::from(u8::from(truth));
            let path = graph(n, |i, j| at(i == j + 1));
            let complete = graph(n, |_, _| 1.0);
            let star = graph(n, |_, j| at(j == 0));
            let expected_path = 2.0 * (1.0 - (PI / n as f64).cos());
            assert!((algebraic_connectivity(&path, n) - expected_path).abs() < ROUNDING);
            assert!((algebraic_connectivity(&complete, n) - n as f64).abs() < ROUNDING * 20.0);
            let expected_star = if n == 2 { 2.0 } else { 1.0 };
            assert!((algebraic_connectivity(&star, n) - expected_star).abs() < ROUNDING);
        }
    }

    #[test]
    fn links_too_weak_to_square_connect_nothing() {
        // One pair hears each other well, everybody else hardly.
        for pair in 0..20 {
            let mut random = stream(9, "test/weak", pair);
            let weak = graph(40, |i, j| {
                let close = i / 2 == j / 2 && i as u64 / 2 == pair;
                if close { 1.0 } else { 10.0_f64.powf(random.random_range(-320.0..-150.0)) }
            });
            let connectivity = algebraic_connectivity(&weak, 40);
            assert!(connectivity < ROUNDING, "pair {pair}: {connectivity}");
        }
    }

    #[test]
    fn disconnected_and_lone_vertices() {
        assert!(
            algebraic_connectivity(&graph(4, |i, j| f64::from(u8::from(i / 2 == j / 2))), 4)
                < ROUNDING
        );
        assert!(algebraic_connectivity(&[0.0], 1) > 1e300);
    }

    fn random_graph(index: u64) -> (usize, Vec<f64>) {
        let mut random = stream(7, "test/graph", index);
        let n = random.random_range(2..25);
        let density = random.random_range(0.1..0.9);
        let mut weights = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..i {
                if random.random::<f64>() < density {
                    let weight: f64 = random.random();
                    weights[i * n + j] = weight;
                    weights[j * n + i] = weight;
                }
            }
        }
        (n, weights)
    }

    #[test]
    fn the_factorisation_agrees_with_the_eigenvalue() {
        let mut test = ConnectivityTest::default();
        for index in 0..300 {
            let (n, weights) = random_graph(index);
            let degrees = degrees(&weights, n);
            let exact = algebraic_connectivity(&weights, n);
            for factor in [0.5, 0.99, 1.01, 2.0] {
                let threshold = (exact * factor).max(1e-6);
                assert_eq!(
                    test.exceeds(&weights, &degrees, threshold),
                    exact > threshold,
                    "graph {index}: λ₂ {exact}, τ {threshold}"
                );
            }
        }
    }

    #[test]
    fn inverse_iteration_finds_the_fiedler_vector() {
        let mut test = ConnectivityTest::default();
        for index in 0..100 {
            let (n, weights) = random_graph(index);
            let degrees = degrees(&weights, n);
            let exact = algebraic_connectivity(&weights, n);
            if exact < 0.1 {
                continue;
            }
            assert!(test.exceeds(&weights, &degrees, 0.999 * exact));
            let mut random = stream(8, "test/vector", index);
            let mut vector: Vec<f64> = (0..n).map(|_| random.random()).collect();
            for _ in 0..20 {
                test.sharpen(&mut vector);
            }
            let quotient: f64 = (0..n * n)
                .map(|k| 0.5 * weights[k] * (vector[k / n] - vector[k % n]).powi(2))
                .sum();
            assert!((quotient - exact).abs() < 1e-6 * exact, "graph {index}: {quotient} {exact}");
        }
    }
}
