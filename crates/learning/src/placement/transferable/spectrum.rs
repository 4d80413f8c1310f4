//! The two lowest eigenpairs of a growing graph's Laplacian above the constant one.

use sonarfleet::sonar::connectivity::ConnectivityTest;

/// λ₂ and λ₃ with their vectors, followed from graph to graph by inverse iteration:
/// good to a few per cent while a layout grows, which is what a policy needs to see
/// where the network is weak.
#[derive(Debug, Clone, Default)]
pub(super) struct Spectrum {
    /// λ₂ and λ₃; equal while there are fewer than three vertices, 0 while there is one.
    pub(super) values: [f64; 2],
    /// Of length 1 each, one value per vertex; 0 where there is no such vector.
    pub(super) vectors: [Vec<f64>; 2],
    test: ConnectivityTest,
}

/// Inverse iteration around −SHIFT: small beside the thresholds that matter, and large
/// enough that a graph in pieces is no obstacle.
const SHIFT: f64 = 0.02;

/// Steps of inverse iteration per added vertex.
const STEPS: usize = 2;

/// Steps of inverse iteration from vectors that know nothing of the graph.
const STEPS_FROM_NOTHING: usize = 8;

impl Spectrum {
    /// Follows the graph after a vertex was added at the end. `weights` are symmetric
    /// with a zero diagonal, [vertex, vertex]; `degrees` are their row sums.
    pub(super) fn follow(&mut self, weights: &[f64], degrees: &[f64]) {
        let n = degrees.len();
        let newest = &weights[(n - 1) * n..];
        let [first, second] = &mut self.vectors;
        first.push(neighbours_mean(newest, first, degrees[n - 1]));
        second.push(neighbours_mean(newest, second, degrees[n - 1]));
        if n < 2 {
            return;
        }
        if n == 2 {
            let half = 0.5_f64.sqrt();
            *first = vec![half, -half];
            self.values = [2.0 * newest[0]; 2];
            return;
        }
        if n == 3 {
            // Any vectors that differ, and from the constant one, lead to the lowest two.
            *second = vec![1.0, 1.0, -2.0];
        }
        self.iterate(STEPS, weights, degrees);
    }

    /// Finds them in a graph of four vertices or more that was not followed.
    pub(super) fn find(&mut self, weights: &[f64], degrees: &[f64]) {
        let n = degrees.len();
        // The ends of a chain apart, and its ends from its middle; then what comes of it.
        let angle = |i: usize| std::f64::consts::PI * (i as f64 + 0.5) / n as f64;
        self.vectors = [1.0, 2.0].map(|k: f64| (0..n).map(|i| (k * angle(i)).cos()).collect());
        self.iterate(STEPS_FROM_NOTHING, weights, degrees);
    }

    fn iterate(&mut self, steps: usize, weights: &[f64], degrees: &[f64]) {
        let [first, second] = &mut self.vectors;
        let connected = self.test.exceeds(weights, degrees, -SHIFT);
        debug_assert!(connected, "a Laplacian has no eigenvalue below 0");
        for _ in 0..steps {
            self.test.sharpen(first);
            self.test.sharpen(second);
            orthogonalise(second, first);
        }
        self.values = separate(first, second, weights, degrees);
    }
}

fn neighbours_mean(links: &[f64], values: &[f64], degree: f64) -> f64 {
    let sum: f64 = links.iter().zip(values).map(|(link, value)| link * value).sum();
    if degree > 0.0 { sum / degree } else { 0.0 }
}

/// Makes `vector` orthogonal to `other` and of length 1.
fn orthogonalise(vector: &mut [f64], other: &[f64]) {
    let along = product(vector, other);
    for (value, other) in vector.iter_mut().zip(other) {
        *value -= along * other;
    }
    // Parallel by accident: any other direction will do.
    if product(vector, vector) < 1e-18 {
        let n = vector.len();
        for (i, value) in vector.iter_mut().enumerate() {
            *value = ((i * i) % n) as f64 / n as f64 - 0.5;
        }
    }
    let length = product(vector, vector).sqrt();
    for value in vector {
        *value /= length;
    }
}

/// Rayleigh–Ritz: turns two orthonormal vectors within their plane so that they
/// diagonalise the Laplacian there; gives the Ritz values, ascending.
fn separate(first: &mut [f64], second: &mut [f64], weights: &[f64], degrees: &[f64]) -> [f64; 2] {
    let n = degrees.len();
    let (mut a, mut b, mut c) = (0.0, 0.0, 0.0);
    for (i, row) in weights.chunks_exact(n).enumerate() {
        let (mut by_first, mut by_second) = (0.0, 0.0);
        for ((link, x), y) in row.iter().zip(first.iter()).zip(second.iter()) {
            by_first += link * x;
            by_second += link * y;
        }
        let (x, y) = (degrees[i] * first[i] - by_first, degrees[i] * second[i] - by_second);
        a += first[i] * x;
        b += second[i] * x;
        c += second[i] * y;
    }
    let (sine, cosine) = (0.5 * (2.0 * b).atan2(a - c)).sin_cos();
    // The eigenvalue of (cos, sin) is the larger one.
    for (x, y) in first.iter_mut().zip(second.iter_mut()) {
        (*x, *y) = (cosine * *y - sine * *x, cosine * *x + sine * *y);
    }
    let (middle, half) = (0.5 * (a + c), (0.5 * (a - c)).hypot(b));
    [(middle - half).max(0.0), middle + half]
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;
    use sonarfleet::random::stream;
    use sonarfleet::sonar::connectivity::algebraic_connectivity;

    /// Where several eigenvalues lie close together, two steps mix their vectors.
    const FOLLOWED: f64 = 0.25;

    /// On average.
    const MEAN_ERROR: f64 = 0.02;

    /// Points dropped in a square with links that fade with distance.
    #[test]
    fn the_lowest_eigenvalue_is_followed_while_a_graph_grows() {
        let (mut errors, mut errors_afresh) = (Vec::new(), Vec::new());
        for seed in 0..20 {
            let mut random = stream(seed, "test/spectrum", 0);
            let points: Vec<[f64; 2]> =
                (0..40).map(|_| [random.random(), random.random()]).collect();
            let link = |i: usize, j: usize| {
                let [dx, dy] = [0, 1].map(|axis| points[i][axis] - points[j][axis]);
                if i == j { 0.0 } else { (-12.0 * (dx * dx + dy * dy)).exp() }
            };
            let mut spectrum = Spectrum::default();
            for n in 1..=40 {
                let weights: Vec<f64> = (0..n * n).map(|k| link(k / n, k % n)).collect();
                let degrees: Vec<f64> =
                    weights.chunks_exact(n).map(|row| row.iter().sum()).collect();
                spectrum.follow(&weights, &degrees);
                if n < 4 {
                    continue;
                }
                let exact = algebraic_connectivity(&weights, n);
                let [second, third] = spectrum.values;
                assert!(second >= exact - 1e-9 && third >= second, "{n}: {second} {exact}");
                assert!(second <= exact * (1.0 + FOLLOWED) + 0.02, "{n}: {second} {exact}");
                errors.push((second - exact) / exact.max(0.1));
                let mut afresh = Spectrum::default();
                afresh.find(&weights, &degrees);
                let [second, third] = afresh.values;
                assert!(second >= exact - 1e-9 && third >= second, "{n}: {second} {exact}");
                errors_afresh.push((second - exact) / exact.max(0.1));
                let [first, other] = &spectrum.vectors;
                assert!(product(first, other).abs() < 1e-9);
            }
        }
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        assert!(mean < MEAN_ERROR, "{mean}");
        let mean = errors_afresh.iter().sum::<f64>() / errors_afresh.len() as f64;
        assert!(mean < MEAN_ERROR, "{mean}, not followed");
    }
}
