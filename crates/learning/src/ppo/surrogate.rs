//! The objective of proximal policy optimisation.

/// A term of the objective at one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surrogate {
    /// min(rA, clip(r, 1 − ε, 1 + ε)A).
    pub(crate) value: f32,
    /// Its slope along the logarithm of the action's probability: 0 where the clipped
    /// branch is the smaller.
    pub(crate) slope: f32,
}

/// The clipped surrogate, Equation (12) (Schulman et al. 2017, arXiv:1707.06347), of a
/// ratio r of new to old probability and an advantage A.
#[expect(
    clippy::inline_always,
    reason = "only what is inlined into the dispatched function is compiled for wide vectors"
)]
#[inline(always)]
pub(crate) fn clipped_surrogate(ratio: f32, advantage: f32, clip_coef: f32) -> Surrogate {
    let clipped = ratio.clamp(1.0 - clip_coef, 1.0 + clip_coef);
    let (plain, bounded) = (ratio * advantage, clipped * advantage);
    // Eq. (12)
    Surrogate { value: plain.min(bounded), slope: if plain <= bounded { plain } else { 0.0 } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_beyond_the_clip_range_gain_nothing_more() {
        let at = |ratio, advantage| clipped_surrogate(ratio, advantage, 0.2);
        let expect = |found: Surrogate, value: f32, slope: f32| {
            assert!((found.value - value).abs() < 1e-6 && (found.slope - slope).abs() < 1e-6);
        };
        expect(at(1.0, 2.0), 2.0, 2.0);
        expect(at(1.5, 2.0), 2.4, 0.0);
        expect(at(0.5, 2.0), 1.0, 1.0);
        expect(at(0.5, -2.0), -1.6, 0.0);
        expect(at(1.5, -2.0), -3.0, -3.0);
    }
}
