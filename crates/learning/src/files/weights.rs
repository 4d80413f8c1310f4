//! Weights that ship with the program: small, self-describing, made to be embedded.
//!
//! Layout: the magic bytes; length of the header, u32; the header, JSON; the weights,
//! `f16` or `f32`; SHA-256 of all that stands before it. Numbers are little-endian.

use super::{FileError, half};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

const MAGIC: &[u8; 20] = b"sonarfleet weights 1";
/// Before the header: magic bytes and the header's length.
const PREFIX_BYTES: usize = MAGIC.len() + 4;
const DIGEST_BYTES: usize = 32;

/// How weights are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// Half precision: two bytes, relative error below 2⁻¹¹ from 6·10⁻⁵ to 65504.
    F16,
    /// Single precision: four bytes, exact.
    F32,
}

impl Precision {
    const fn bytes(self) -> usize {
        match self {
            Self::F16 => 2,
            Self::F32 => 4,
        }
    }
}

/// The weights of a network, with what made them.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights {
    /// Which network they are of, such as `placement/transferable`.
    pub kind: String,
    /// The network's sizes by name, such as `features` and `hidden`.
    pub sizes: BTreeMap<String, usize>,
    /// The command that trained them.
    pub command: String,
    /// The seed of the training.
    pub seed: u64,
    /// Version of the program that trained them.
    pub version: String,
    /// All weights, in the network's order.
    pub values: Vec<f32>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    kind: String,
    sizes: BTreeMap<String, usize>,
    command: String,
    seed: u64,
    version: String,
    precision: Precision,
    count: usize,
}

impl Weights {
    /// Writes the weights, whole or not at all.
    ///
    /// # Errors
    /// Where the file cannot be written, or a weight is not finite or too large for
    /// half precision.
    pub fn save(&self, path: &Path, precision: Precision) -> Result<(), FileError> {
        let largest = match precision {
            Precision::F16 => half::LARGEST,
            Precision::F32 => f32::MAX,
        };
        let out_of_range = |value: &f32| !value.is_finite() || value.abs() > largest;
        if let Some(index) = self.values.iter().position(out_of_range) {
            let reason = format!("weight {index} is {}, beyond ±{largest:e}", self.values[index]);
            return Err(FileError::Unwritable { path: path.to_owned(), reason });
        }
        let stored: Vec<u8> = match precision {
            Precision::F16 => {
                self.values.iter().flat_map(|&value| half::from_f32(value).to_le_bytes()).collect()
            }
            Precision::F32 => self.values.iter().flat_map(|value| value.to_le_bytes()).collect(),
        };
        let header = Header {
            kind: self.kind.clone(),
            sizes: self.sizes.clone(),
            command: self.command.clone(),
            seed: self.seed,
            version: self.version.clone(),
            precision,
            count: self.values.len(),
        };
        let header = serde_json::to_vec(&header).map_err(|error| FileError::Unwritable {
            path: path.to_owned(),
            reason: error.to_string(),
        })?;
        let mut bytes = MAGIC.to_vec();
        bytes.extend((header.len() as u32).to_le_bytes());
        bytes.extend(header);
        bytes.extend(stored);
        bytes.extend(Sha256::digest(&bytes));
        super::write_whole(path, &bytes)
    }

    /// Reads weights of this kind from a file.
    ///
    /// # Errors
    /// As [`Weights::parse`], and where the file cannot be read.
    pub fn load(path: &Path, kind: &str) -> Result<Self, FileError> {
        let bytes = std::fs::read(path).map_err(FileError::io(path))?;
        Self::parse(path, &bytes, kind)
    }

    /// Reads weights of this kind from bytes, such as those of `include_bytes!`; the
    /// path is what errors name.
    ///
    /// # Errors
    /// Where the bytes are no weights, or of another kind, truncated or damaged.
    pub fn parse(path: impl AsRef<Path>, bytes: &[u8], kind: &str) -> Result<Self, FileError> {
        let path = path.as_ref();
        let damaged = |reason: String| FileError::Damaged { path: path.to_owned(), reason };
        let truncated = |expected: usize| FileError::Truncated {
            path: path.to_owned(),
            found: bytes.len() as u64,
            expected: expected as u64,
        };
        let magic = &bytes[..bytes.len().min(MAGIC.len())];
        if !MAGIC.starts_with(magic) {
            let found = String::from_utf8_lossy(magic).into_owned();
            let expected = "weights, layout 1";
            return Err(FileError::NotSuchAFile { path: path.to_owned(), found, expected });
        }
        let (prefix, rest) =
            bytes.split_at_checked(PREFIX_BYTES).ok_or_else(|| truncated(PREFIX_BYTES))?;
        let length =
            prefix[MAGIC.len()..].iter().rev().fold(0, |all, &b| all << 8 | usize::from(b));
        let (header, _) =
            rest.split_at_checked(length).ok_or_else(|| truncated(PREFIX_BYTES + length))?;
        let header: Header = serde_json::from_slice(header)
            .map_err(|error| damaged(format!("its header cannot be read: {error}")))?;
        let start = PREFIX_BYTES + length;
        let whole = header
            .count
            .checked_mul(header.precision.bytes())
            .and_then(|stored| stored.checked_add(start + DIGEST_BYTES))
            .ok_or_else(|| damaged("its header gives an impossible length".into()))?;
        if bytes.len() < whole {
            return Err(truncated(whole));
        }
        if bytes.len() > whole {
            return Err(damaged(format!("{} bytes follow its end", bytes.len() - whole)));
        }
        let (contents, digest) = bytes.split_at(whole - DIGEST_BYTES);
        if Sha256::digest(contents)[..] != *digest {
            return Err(damaged("its SHA-256 is not that of its contents".into()));
        }
        if header.kind != kind {
            let (found, expected) = (header.kind, kind.to_owned());
            return Err(FileError::OtherKind { path: path.to_owned(), found, expected });
        }
        let stored = &contents[start..];
        let values = match header.precision {
            Precision::F16 => stored
                .as_chunks()
                .0
                .iter()
                .map(|&bytes| half::to_f32(u16::from_le_bytes(bytes)))
                .collect(),
            Precision::F32 => {
                stored.as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect()
            }
        };
        let Header { kind, sizes, command, seed, version, .. } = header;
        Ok(Self { kind, sizes, command, seed, version, values })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn weights() -> Weights {
        Weights {
            kind: "placement/test".into(),
            sizes: [("features".to_owned(), 2), ("hidden".to_owned(), 3)].into(),
            command: "sonarfleet train placement --policy transferable".into(),
            seed: 7,
            version: "0.1.0".into(),
            values: vec![0.1, -1.0, 3.25e-3, 0.0, 1e-6, 65_504.0],
        }
    }

    #[test]
    fn single_precision_is_exact_and_half_is_near() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("w");
        let original = weights();
        original.save(&path, Precision::F32).unwrap();
        assert_eq!(Weights::load(&path, "placement/test").unwrap(), original);
        original.save(&path, Precision::F16).unwrap();
        let near = Weights::load(&path, "placement/test").unwrap();
        assert_eq!(near.sizes, original.sizes);
        // Half an ulp: 2⁻¹¹ relative, or 2⁻²⁵ where halves are subnormal.
        for (near, value) in near.values.iter().zip(&original.values) {
            assert!((near - value).abs() <= (value.abs() / 2048.0).max(3e-8), "{near} {value}");
        }
    }

    #[test]
    fn no_weight_is_lost_silently() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("w");
        let mut large = weights();
        large.values[2] = 1e5;
        let error = large.save(&path, Precision::F16).unwrap_err().to_string();
        assert!(error.contains("weight 2 is 100000"), "{error}");
        large.save(&path, Precision::F32).unwrap();
        large.values[2] = f32::NAN;
        assert!(large.save(&path, Precision::F32).is_err());
    }

    #[test]
    fn no_change_of_a_byte_and_no_cut_goes_unnoticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("w");
        weights().save(&path, Precision::F16).unwrap();
        let whole = fs::read(&path).unwrap();
        let kind = "placement/test";
        for at in 0..whole.len() {
            for flip in [0x01, 0x80, 0xff] {
                let mut changed = whole.clone();
                changed[at] ^= flip;
                let read = Weights::parse("w", &changed, kind);
                assert!(read.is_err(), "byte {at} ^ {flip:#x}");
            }
            let error = Weights::parse("w", &whole[..at], kind).unwrap_err();
            assert!(matches!(error, FileError::Truncated { .. }), "cut at {at}: {error}");
        }
    }

    #[test]
    fn errors_say_what_was_found_and_expected() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("w");
        weights().save(&path, Precision::F16).unwrap();
        let whole = fs::read(&path).unwrap();
        let message =
            |bytes: &[u8], kind| Weights::parse("w", bytes, kind).unwrap_err().to_string();
        assert_eq!(message(&whole, "pilot"), "w: holds `placement/test`, expected `pilot`");
        let cut = &whole[..whole.len() - 1];
        let (found, all) = (cut.len(), whole.len());
        assert_eq!(message(cut, "pilot"), format!("w: ends after {found} bytes, expected {all}"));
        assert!(
            message(b"PK\x03\x04", "pilot")
                .starts_with("w: not weights, layout 1: it begins with \"PK")
        );
    }
}
