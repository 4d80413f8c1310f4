//! Fingerprints: SHA-256 of what something is made of.

use sha2::{Digest, Sha256};
use std::fmt::Write;

/// Collects the parts of something, in order. Every part is told apart from its
/// neighbours by its length.
#[derive(Debug, Clone, Default)]
pub struct Fingerprint {
    hash: Sha256,
}

impl Fingerprint {
    /// Adds a text.
    #[must_use]
    pub fn text(mut self, text: &str) -> Self {
        self.hash.update((text.len() as u64).to_le_bytes());
        self.hash.update(text);
        self
    }

    /// Adds numbers, bit by bit.
    #[must_use]
    pub fn numbers(mut self, numbers: &[f64]) -> Self {
        self.hash.update((numbers.len() as u64).to_le_bytes());
        for number in numbers {
            self.hash.update(number.to_le_bytes());
        }
        self
    }

    /// The fingerprint: 64 hexadecimal digits.
    pub fn finish(self) -> String {
        hexadecimal(&self.hash.finalize())
    }
}

/// Bytes as hexadecimal digits.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}"); // writing to a String cannot fail
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_do_not_run_into_each_other() {
        let texts = |parts: &[&str]| {
            parts.iter().fold(Fingerprint::default(), |print, part| print.text(part)).finish()
        };
        assert_eq!(texts(&["ab", "c"]), texts(&["ab", "c"]));
        assert_ne!(texts(&["ab", "c"]), texts(&["a", "bc"]));
        let numbers = |parts: &[f64]| Fingerprint::default().numbers(parts).finish();
        assert_ne!(numbers(&[0.0]), numbers(&[-0.0]));
        assert_eq!(numbers(&[]).len(), 64);
    }

    #[test]
    fn the_hash_is_sha_256() {
        // FIPS 180-2, appendix B.1.
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hexadecimal(&Sha256::digest("abc")), expected);
    }
}
