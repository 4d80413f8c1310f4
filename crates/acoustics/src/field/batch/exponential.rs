use super::lanes::ROUNDER;

/// e^x for x ≤ 0 to 3·10⁻⁷ of itself, 0 below −87; without branches, so that loops over it
/// become vector instructions.
#[inline(always)]
pub(super) fn exponential(x: f32) -> f32 {
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    let clamped = if x > -87.0 { x } else { -87.0 };
    let shifted = clamped * std::f32::consts::LOG2_E + ROUNDER;
    let power = shifted - ROUNDER;
    let r = clamped - power * LN_2_HIGH - power * LN_2_LOW;
    // Taylor's series on |r| ≤ ½ ln 2, the last terms adjusted to the interval.
    let series = 0.166_666_66 + r * (0.041_666_7 + r * (0.008_333_6 + r * 0.001_392_8));
    let mantissa = 1.0 + r * (1.0 + r * (0.5 + r * series));
    let exponent = shifted.to_bits().wrapping_shl(23);
    let value = f32::from_bits(mantissa.to_bits().wrapping_add(exponent));
    if x > -87.0 { value } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_exponential() {
        for step in 0..200_000 {
            let x = -87.0 * step as f32 / 200_000.0;
            let exact = f64::from(x).exp();
            let error = (f64::from(exponential(x)) - exact).abs() / exact;
            assert!(error < 3e-7, "e^{x}: {error}");
        }
        assert_eq!(exponential(-90.0).to_bits(), 0.0f32.to_bits());
        assert_eq!(exponential(0.0).to_bits(), 1.0f32.to_bits());
    }
}
