//! IEEE 754 half precision: sign, 5 bits of exponent, 10 of significand.

/// The largest finite half-precision number.
pub(crate) const LARGEST: f32 = 65_504.0;

/// The nearest half-precision number, ties to even; what is too large becomes infinite.
pub(crate) fn from_f32(value: f32) -> u16 {
    let bits = value.to_bits();
    let sign = (bits >> 16) as u16 & 0x8000;
    if value.is_nan() {
        return sign | 0x7e00;
    }
    let magnitude = value.abs();
    // Numbers below 2⁻¹⁴ are multiples of 2⁻²⁴; from there on 13 bits are dropped.
    let rounded = if magnitude < (-14_f32).exp2() {
        (f64::from(magnitude) * 24_f64.exp2()).round_ties_even() as u32
    } else {
        let bits = magnitude.to_bits();
        let odd = bits >> 13 & 1;
        let rebased = bits - ((127 - 15) << 23);
        (rebased + 0xfff + odd) >> 13
    };
    sign | rounded.min(0x7c00) as u16
}

/// The number that half-precision bits stand for.
pub(crate) fn to_f32(bits: u16) -> f32 {
    let (exponent, significand) = (i32::from(bits >> 10 & 0x1f), f32::from(bits & 0x3ff));
    let magnitude = match exponent {
        0 => significand * (-24_f32).exp2(),
        31 if significand == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        _ => (1024.0 + significand) * ((exponent - 25) as f32).exp2(),
    };
    if bits & 0x8000 == 0 { magnitude } else { -magnitude }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every finite half is its own nearest, and midpoints go to the even neighbour.
    #[test]
    fn every_half_survives_and_midpoints_go_to_even() {
        for bits in 0..0x7c00_u16 {
            let value = to_f32(bits);
            assert_eq!(from_f32(value), bits);
            assert_eq!(from_f32(-value), bits | 0x8000);
            if bits + 1 < 0x7c00 {
                let middle = f32::midpoint(value, to_f32(bits + 1)); // exact in f32
                assert_eq!(from_f32(middle), bits + (bits & 1), "{middle}");
                assert_eq!(from_f32(middle.next_up()), bits + 1);
                assert_eq!(from_f32(middle.next_down()), bits);
            }
        }
    }

    /// Values of the standard's table of interchange formats.
    #[test]
    fn landmarks_are_where_the_standard_puts_them() {
        let landmarks = [
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x7bff, LARGEST),
            (0x0400, 6.103_515_6e-5),
            (0x0001, 5.960_464_5e-8),
            (0x3555, 0.333_251_95),
        ];
        for (bits, value) in landmarks {
            assert_eq!(from_f32(value), bits);
            assert_eq!(to_f32(bits).to_bits(), value.to_bits());
        }
        assert_eq!(from_f32(65_520.0), 0x7c00);
        assert_eq!(from_f32(65_519.99), 0x7bff);
        assert_eq!(from_f32(f32::INFINITY), 0x7c00);
        assert!(to_f32(from_f32(f32::NAN)).is_nan() && to_f32(0xfc00) == f32::NEG_INFINITY);
    }
}
