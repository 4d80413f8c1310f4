//! The right tail of the standard normal distribution, Q, and its inverse.

/// Q(x): probability that a standard normal variable exceeds x.
pub fn tail_probability(x: f64) -> f64 {
    0.5 * libm::erfc(x * std::f64::consts::FRAC_1_SQRT_2)
}

/// Q⁻¹(p): the value that a standard normal variable exceeds with probability
/// `p`; ±∞ at 0 and 1, NaN outside [0, 1].
///
/// Newton's method on ln Q. As ln Q is concave and the start lies to the right
/// of the root (Q(x) ≤ e^(−x²/2)/2 for x ≥ 0), the iterates fall towards the root.
pub fn inverse_tail_probability(p: f64) -> f64 {
    if p > 0.5 {
        return -inverse_tail_probability(1.0 - p);
    }
    if p == 0.0 {
        return f64::INFINITY;
    }
    let mut x = (-2.0 * (2.0 * p).ln()).max(0.0).sqrt();
    loop {
        let q = tail_probability(x);
        let density = (-0.5 * x * x).exp() / (2.0 * std::f64::consts::PI).sqrt();
        let step = q * (q / p).ln() / density;
        x += step;
        if step.is_nan() || step >= -f64::EPSILON * x.abs().max(1.0) {
            return x;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the published digits allow.
    const PUBLISHED: f64 = 1e-9;

    #[test]
    fn tail_matches_published_values() {
        // Abramowitz & Stegun, table 26.1: 1 − P(x).
        for (x, q) in [
            (0.0, 0.5),
            (1.0, 0.158_655_253_931_457),
            (2.0, 0.022_750_131_948_179),
            (3.0, 0.001_349_898_031_630),
            (-1.0, 0.841_344_746_068_543),
        ] {
            assert!((tail_probability(x) - q).abs() < PUBLISHED * 1e-3, "Q({x})");
        }
    }

    #[test]
    fn inverse_matches_published_values() {
        // Quantiles of the normal distribution as tabulated, e.g. in NIST's handbook.
        for (p, x) in [
            (0.5, 0.0),
            (0.1, 1.281_551_565_545),
            (0.05, 1.644_853_626_951),
            (0.025, 1.959_963_984_540),
            (0.01, 2.326_347_874_041),
            (0.001, 3.090_232_306_168),
            (1e-6, 4.753_424_308_823),
            (0.9, -1.281_551_565_545),
        ] {
            assert!((inverse_tail_probability(p) - x).abs() < PUBLISHED, "Q⁻¹({p})");
        }
    }

    #[test]
    fn inverse_undoes_the_tail() {
        for step in -80..=360 {
            let x = f64::from(step) * 0.1;
            let back = inverse_tail_probability(tail_probability(x));
            // Left of 0 the tail is near 1 and its last digit limits x.
            let tolerance = if x < 0.0 { 1e-16 * (0.5 * x * x).exp() * 10.0 } else { 0.0 } + 1e-12;
            assert!((back - x).abs() < tolerance, "{x} came back as {back}");
        }
    }

    #[test]
    fn inverse_at_the_ends() {
        assert!(inverse_tail_probability(0.0) > 1e300);
        assert!(inverse_tail_probability(1.0) < -1e300);
        assert!(inverse_tail_probability(-0.1).is_nan());
        assert!(inverse_tail_probability(1.1).is_nan());
        assert!(inverse_tail_probability(f64::NAN).is_nan());
    }
}
