/// When, and by which of its two faces, a uniformly accelerated coordinate
/// leaves an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Exit {
    /// The σ at which it leaves; infinite if it never does.
    pub sigma: f64,
    /// Whether by the face at the upper end of the coordinate.
    pub by_upper: bool,
}

/// Solves y(σ) = `velocity`·σ + ½·`acceleration`·σ² for the first exit from
/// [−`below`, `above`], both distances ≥ 0.
///
/// The root is 2d/(v + √(v² + 2ad)), free of cancellation, for the face ahead;
/// the face behind is left by only if the face ahead is never reached.
#[inline]
pub(crate) fn exit(velocity: f64, acceleration: f64, below: f64, above: f64) -> Exit {
    let upward = velocity >= 0.0;
    let (speed, push, ahead, behind) = if upward {
        (velocity, acceleration, above, below)
    } else {
        (-velocity, -acceleration, below, above)
    };
    let discriminant = speed * speed + 2.0 * push * ahead;
    if discriminant >= 0.0 {
        let denominator = speed + discriminant.sqrt();
        let sigma = if denominator > 0.0 { 2.0 * ahead / denominator } else { f64::INFINITY };
        if sigma.is_finite() || push >= 0.0 {
            return Exit { sigma, by_upper: upward };
        }
    }
    // Turned back (push < 0) before the face ahead.
    let sigma = (speed + (speed * speed - 2.0 * push * behind).sqrt()) / -push;
    Exit { sigma, by_upper: !upward }
}

/// First σ ≥ 0 at which a gap of `distance` ≥ 0, closed at `closing` speed
/// with acceleration `push`, is nil; infinite if never. A gap that is nil
/// already counts only if it is closing, or after it has opened and closed.
#[inline]
pub(crate) fn contact(closing: f64, push: f64, distance: f64) -> f64 {
    if closing > 0.0 {
        let discriminant = closing * closing + 2.0 * push * distance;
        if discriminant < 0.0 {
            return f64::INFINITY;
        }
        2.0 * distance / (closing + discriminant.sqrt())
    } else if push > 0.0 {
        (-closing + (closing * closing + 2.0 * push * distance).sqrt()) / push
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    #[test]
    fn a_coordinate_at_rest_never_leaves() {
        assert!(exit(0.0, 0.0, 1.0, 1.0).sigma.is_infinite());
        assert!(contact(0.0, 0.0, 1.0).is_infinite());
        assert!(contact(-1.0, 0.0, 0.0).is_infinite());
    }

    proptest! {
    #![proptest_config(ProptestConfig {
        cases: 256,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

        #[test]
        fn the_exit_lies_on_a_face_and_none_is_passed_before(
            v in -1.0..1.0f64, a in -1.0..1.0f64, below in 0.01..1.0f64, above in 0.01..1.0f64,
        ) {
            let Exit { sigma, by_upper } = exit(v, a, below, above);
            prop_assume!(sigma < 1e3);
            let y = |s: f64| v * s + 0.5 * a * s * s;
            let face = if by_upper { above } else { -below };
            prop_assert!((y(sigma) - face).abs() < 1e-8);
            for step in 1..100 {
                let within = y(sigma * f64::from(step) / 100.0);
                prop_assert!(within > -below - 1e-9 && within < above + 1e-9);
            }
        }

        #[test]
        fn a_contact_closes_the_gap(v in -1.0..1.0f64, a in -1.0..1.0f64, d in 0.0..1.0f64) {
            let sigma = contact(v, a, d);
            if sigma.is_finite() && sigma < 1e3 {
                prop_assert!((v * sigma + 0.5 * a * sigma * sigma - d).abs() < 1e-8);
            }
        }
    }
}
