//! Checkpoints: the state of a training, so that a killed one continues and ends
//! bit-identical.
//!
//! Layout: the magic bytes; the layout's number, u32; kind of the state, version of the
//! program and length of the state (postcard: two texts, a varint); the state
//! (postcard); SHA-256 of all that stands before it. Numbers are little-endian.

use super::FileError;
use postcard::take_from_bytes;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::path::Path;

const MAGIC: &[u8; 12] = b"sonarfleet\0\x1a";
const LAYOUT: u32 = 1;
const VERSION: &str = env!("CARGO_PKG_VERSION");
const DIGEST_BYTES: usize = 32;
/// Before the header: magic bytes and layout.
const PREFIX_BYTES: usize = MAGIC.len() + 4;

#[derive(Serialize, Deserialize)]
struct Header<'a> {
    kind: &'a str,
    version: &'a str,
    state_bytes: u64,
}

/// Writes the state of a training, such as `"placement/paper"`, whole or not at all.
/// The state may hold anything that serde derives without `flatten`, `untagged` or
/// skipped fields.
///
/// # Errors
/// Where the file cannot be written, or the state is of a shape that cannot be stored.
pub fn save<S: Serialize>(path: &Path, kind: &str, state: &S) -> Result<(), FileError> {
    let unwritable = |error: postcard::Error| FileError::Unwritable {
        path: path.to_owned(),
        reason: error.to_string(),
    };
    let state = postcard::to_stdvec(state).map_err(unwritable)?;
    let header = Header { kind, version: VERSION, state_bytes: state.len() as u64 };
    let mut bytes = MAGIC.to_vec();
    bytes.extend(LAYOUT.to_le_bytes());
    bytes.extend(postcard::to_stdvec(&header).map_err(unwritable)?);
    bytes.extend(state);
    bytes.extend(Sha256::digest(&bytes));
    super::write_whole(path, &bytes)
}

/// Reads the state of a training of this kind.
///
/// # Errors
/// Where the file cannot be read, is no checkpoint, is truncated or damaged, or was
/// written for another kind or by another version of the program.
pub fn load<S: DeserializeOwned>(path: &Path, kind: &str) -> Result<S, FileError> {
    let file = std::fs::read(path).map_err(FileError::io(path))?;
    let damaged = |reason: &str| FileError::Damaged { path: path.into(), reason: reason.into() };
    let truncated = |expected: usize| FileError::Truncated {
        path: path.to_owned(),
        found: file.len() as u64,
        expected: expected as u64,
    };
    if !file.starts_with(&MAGIC[..file.len().min(MAGIC.len())]) {
        let found = String::from_utf8_lossy(&file[..file.len().min(MAGIC.len())]).into_owned();
        let expected = "a training's checkpoint";
        return Err(FileError::NotSuchAFile { path: path.to_owned(), found, expected });
    }
    let (prefix, rest) =
        file.split_at_checked(PREFIX_BYTES).ok_or_else(|| truncated(PREFIX_BYTES))?;
    let layout = prefix[MAGIC.len()..].iter().rev().fold(0, |all, &b| all << 8 | u32::from(b));
    if layout != LAYOUT {
        let path = path.to_owned();
        return Err(FileError::OtherLayout { path, found: layout, expected: LAYOUT });
    }
    let (header, rest) = take_from_bytes::<Header>(rest).map_err(|error| match error {
        postcard::Error::DeserializeUnexpectedEnd => truncated(file.len() + 1),
        _ => damaged("its header cannot be read"),
    })?;
    let header_end = file.len() - rest.len();
    let whole = usize::try_from(header.state_bytes)
        .ok()
        .and_then(|state| state.checked_add(header_end + DIGEST_BYTES))
        .ok_or_else(|| damaged("its header gives an impossible length"))?;
    if file.len() < whole {
        return Err(truncated(whole));
    }
    if file.len() > whole {
        return Err(damaged(&format!("{} bytes follow its end", file.len() - whole)));
    }
    let (contents, digest) = file.split_at(whole - DIGEST_BYTES);
    if Sha256::digest(contents)[..] != *digest {
        return Err(damaged("its SHA-256 is not that of its contents"));
    }
    if header.kind != kind {
        let (found, expected) = (header.kind.to_owned(), kind.to_owned());
        return Err(FileError::OtherKind { path: path.to_owned(), found, expected });
    }
    if header.version != VERSION {
        let (found, expected) = (header.version.to_owned(), VERSION.to_owned());
        return Err(FileError::OtherVersion { path: path.to_owned(), found, expected });
    }
    match take_from_bytes(&contents[header_end..]) {
        Ok((state, [])) => Ok(state),
        Ok(_) => Err(damaged("its state is longer than this program's")),
        Err(error) => Err(damaged(&format!("its state is not this program's: {error}"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const KIND: &str = "placement/test";

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    struct State {
        update: u64,
        multiplier: f64,
        weights: Vec<f32>,
        name: Option<String>,
    }

    fn state() -> State {
        let weights = vec![1.0, -0.0, f32::MIN_POSITIVE / 2.0, f32::INFINITY];
        State { update: 300, multiplier: 0.1, weights, name: Some("τ".into()) }
    }

    #[test]
    fn what_is_saved_is_loaded_bit_for_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/checkpoint.bin");
        let nan = vec![f32::from_bits(0x7fc0_1234), -0.0];
        save(&path, KIND, &nan).unwrap();
        let back: Vec<f32> = load(&path, KIND).unwrap();
        assert!(back.iter().zip(&nan).all(|(a, b)| a.to_bits() == b.to_bits()));
        save(&path, KIND, &state()).unwrap();
        assert_eq!(load::<State>(&path, KIND).unwrap(), state());
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }

    #[test]
    fn no_change_of_a_byte_and_no_cut_goes_unnoticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.bin");
        save(&path, KIND, &state()).unwrap();
        let whole = fs::read(&path).unwrap();
        for at in 0..whole.len() {
            for flip in [0x01, 0x80, 0xff] {
                let mut changed = whole.clone();
                changed[at] ^= flip;
                fs::write(&path, changed).unwrap();
                assert!(load::<State>(&path, KIND).is_err(), "byte {at} ^ {flip:#x}");
            }
            fs::write(&path, &whole[..at]).unwrap();
            let error = load::<State>(&path, KIND).unwrap_err();
            assert!(matches!(error, FileError::Truncated { .. }), "cut at {at}: {error}");
        }
        fs::write(&path, [&whole[..], b"\n"].concat()).unwrap();
        assert!(matches!(load::<State>(&path, KIND), Err(FileError::Damaged { .. })));
    }

    #[test]
    fn errors_say_what_was_found_and_expected() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c");
        let message = |kind| {
            let text = load::<State>(&path, kind).unwrap_err().to_string();
            text.replace(path.to_str().unwrap(), "PATH")
        };
        assert!(message(KIND).starts_with("PATH: No such file"));
        fs::write(&path, "{\"weights\": []}").unwrap();
        assert_eq!(
            message(KIND),
            r#"PATH: not a training's checkpoint: it begins with "{\"weights\": ""#
        );
        save(&path, KIND, &state()).unwrap();
        assert_eq!(message("pilot"), "PATH: holds `placement/test`, expected `pilot`");
        let mut other = fs::read(&path).unwrap();
        other[MAGIC.len()] = 9;
        fs::write(&path, &other).unwrap();
        assert_eq!(message(KIND), "PATH: layout 9, expected layout 1");
    }

    /// A checkpoint of another version, whole in itself.
    #[test]
    fn another_version_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c");
        save(&path, KIND, &state()).unwrap();
        let mut file = fs::read(&path).unwrap();
        let at = file.windows(VERSION.len()).position(|text| text == VERSION.as_bytes()).unwrap();
        file[at] = b'9';
        let contents = file.len() - DIGEST_BYTES;
        let digest = Sha256::digest(&file[..contents]);
        file[contents..].copy_from_slice(&digest);
        fs::write(&path, file).unwrap();
        let error = load::<State>(&path, KIND).unwrap_err();
        assert!(matches!(error, FileError::OtherVersion { .. }), "{error}");
    }

    #[test]
    fn a_state_of_another_shape_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c");
        save(&path, KIND, &(1_u8, 2_u8)).unwrap();
        assert!(matches!(load::<u8>(&path, KIND), Err(FileError::Damaged { .. })));
        assert!(matches!(load::<(u8, u8, u8)>(&path, KIND), Err(FileError::Damaged { .. })));
    }
}
