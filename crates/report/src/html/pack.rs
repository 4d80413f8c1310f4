//! Fields of numbers packed for the page: 16 bits a value, in base 64.

use crate::ticks;
use serde::Serialize;

/// The code of a missing value.
const MISSING: u16 = u16::MAX;
const LAST: f64 = (u16::MAX - 1) as f64;

/// Value k is `low + (high − low) · code / 65534`; code 65535 is a missing value.
#[derive(Serialize)]
pub(super) struct Packed {
    low: f64,
    high: f64,
    /// Codes, little-endian, in base 64.
    codes: String,
}

impl Packed {
    pub(super) fn new(values: impl Iterator<Item = f64> + Clone) -> Self {
        let (low, high) = ticks::range(values.clone()).unwrap_or((0.0, 0.0));
        let span = if high > low { high - low } else { 1.0 };
        let code = |value: f64| {
            if value.is_finite() { ((value - low) / span * LAST).round() as u16 } else { MISSING }
        };
        let bytes: Vec<u8> = values.flat_map(|value| code(value).to_le_bytes()).collect();
        Self { low, high: low + span, codes: base64(&bytes) }
    }
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = chunk.iter().fold(0_u32, |word, &byte| word << 8 | u32::from(byte))
            << (8 * (3 - chunk.len()));
        for digit in 0..4 {
            if digit <= chunk.len() {
                let index = word >> (18 - 6 * digit) & 0x3f;
                text.push(char::from(DIGITS[index as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_rfc_4648() {
        for (plain, text) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(plain.as_bytes()), text);
        }
    }

    #[test]
    fn nothing_but_missing_values_packs() {
        let packed = Packed::new([f64::NAN, f64::INFINITY].into_iter());
        assert_eq!((packed.low, packed.high, packed.codes.as_str()), (0.0, 1.0, "/////w=="));
    }
}
