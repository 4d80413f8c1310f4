//! TensorBoard event files: length-delimited records with masked CRC-32C, each an
//! `Event` message (tensorflow/core/util/event.proto).

use super::FileError;
use super::protobuf::Message;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The CRC-32C (Castagnoli) polynomial, bits reversed.
const POLYNOMIAL: u32 = 0x82f6_3b78;
const TABLE: [u32; 256] = table();
/// What the checksum of a record is masked with.
const MASK_DELTA: u32 = 0xa282_ead8;

/// `SessionLog.START`: what readers have of this step and later ones is void.
const SESSION_START: i64 = 1;

/// An event file that grows by one record per step.
#[derive(Debug)]
pub struct EventFile {
    path: PathBuf,
    file: File,
}

impl EventFile {
    /// Starts `events.out.tfevents.TIME.NAME` in a folder; an older file of that name
    /// is lost. The time is in whole seconds since 1970, and readers put the files of
    /// a folder in the order of their times.
    ///
    /// # Errors
    /// [`FileError::Io`] where it cannot be written.
    pub fn create(folder: &Path, time_s: u64, name: &str) -> Result<Self, FileError> {
        let path = folder.join(Self::name(time_s, name));
        let file = File::create(&path).map_err(FileError::io(&path))?;
        let mut events = Self { path, file };
        let mut version = event(time_s as f64, 0);
        version.text(3, "brain.Event:2");
        events.append(version)?;
        Ok(events)
    }

    /// The name of an event file; ten digits, so that the alphabet's order is that of
    /// the times.
    pub fn name(time_s: u64, name: &str) -> String {
        format!("events.out.tfevents.{time_s:010}.{name}")
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Tells readers that earlier files of the folder hold nothing that counts from
    /// this step on.
    ///
    /// # Errors
    /// [`FileError::Io`] where it cannot be written.
    pub fn restart(&mut self, wall_time_s: f64, step: u64) -> Result<(), FileError> {
        let mut start = event(wall_time_s, step);
        start.nested(7, |session| session.int(1, SESSION_START));
        self.append(start)
    }

    /// Appends scalars of one step.
    ///
    /// # Errors
    /// [`FileError::Io`] where it cannot be written.
    pub fn scalars<'a>(
        &mut self,
        wall_time_s: f64,
        step: u64,
        scalars: impl IntoIterator<Item = (&'a str, f32)>,
    ) -> Result<(), FileError> {
        let mut message = event(wall_time_s, step);
        message.nested(5, |summary| {
            for (tag, value) in scalars {
                summary.nested(1, |scalar| scalar.text(1, tag).float(2, value));
            }
            summary
        });
        self.append(message)
    }

    fn append(&mut self, event: Message) -> Result<(), FileError> {
        self.file.write_all(&record(&event.into_bytes())).map_err(FileError::io(&self.path))
    }
}

fn event(wall_time_s: f64, step: u64) -> Message {
    let mut event = Message::default();
    event.double(1, wall_time_s).int(2, step as i64);
    event
}

/// A record: length, its checksum, data, their checksum.
fn record(data: &[u8]) -> Vec<u8> {
    let length = (data.len() as u64).to_le_bytes();
    let mut record = Vec::with_capacity(data.len() + 16);
    record.extend(length);
    record.extend(masked(crc32c(&length)).to_le_bytes());
    record.extend(data);
    record.extend(masked(crc32c(data)).to_le_bytes());
    record
}

fn masked(checksum: u32) -> u32 {
    checksum.rotate_right(15).wrapping_add(MASK_DELTA)
}

/// CRC-32C (RFC 3720, appendix B.4).
fn crc32c(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| TABLE[usize::from(crc as u8 ^ byte)] ^ (crc >> 8))
}

const fn table() -> [u32; 256] {
    let mut table = [0; 256];
    let mut index = 0;
    while index < 256 {
        let (mut entry, mut bit) = (index as u32, 0);
        while bit < 8 {
            entry = if entry & 1 == 1 { entry >> 1 ^ POLYNOMIAL } else { entry >> 1 };
            bit += 1;
        }
        table[index] = entry;
        index += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The check value of the CRC catalogue, and the test patterns of RFC 3720.
    #[test]
    fn checksums_are_the_published_ones() {
        assert_eq!(crc32c(b"123456789"), 0xe306_9283);
        assert_eq!(crc32c(&[0; 32]), 0x8a91_36aa);
        assert_eq!(crc32c(&[0xff; 32]), 0x62a8_ab43);
        let ascending: Vec<u8> = (0..32).collect();
        assert_eq!(crc32c(&ascending), 0x46dd_794e);
    }

    /// Walks the records with a checksum that is computed bit by bit.
    #[test]
    fn records_are_whole_and_the_first_names_the_version() {
        let bitwise = |bytes: &[u8]| {
            let step = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0x82f6_3b78 } else { crc >> 1 };
            let crc = bytes.iter().fold(u32::MAX, |crc, &byte| {
                (0..8).fold(crc ^ u32::from(byte), |crc, _| step(crc))
            });
            let crc = u64::from(!crc);
            ((crc >> 15 | crc << 17) as u32).wrapping_add(0xa282_ead8)
        };
        let folder = tempfile::tempdir().unwrap();
        let mut events = EventFile::create(folder.path(), 1_700_000_000, "training").unwrap();
        events.scalars(1_700_000_001.5, 4096, [("reward", 31.5), ("entropy", f32::NAN)]).unwrap();
        events.restart(1_700_000_002.0, 4097).unwrap();
        let name = events.path().file_name().unwrap().to_owned();
        assert_eq!(name, "events.out.tfevents.1700000000.training");

        let file = std::fs::read(events.path()).unwrap();
        let (mut rest, mut records) = (&file[..], Vec::new());
        while !rest.is_empty() {
            let length = u64::from_le_bytes(rest[..8].try_into().unwrap()) as usize;
            let checksum = |at: usize| u32::from_le_bytes(rest[at..at + 4].try_into().unwrap());
            assert_eq!(checksum(8), bitwise(&rest[..8]));
            let data = &rest[12..12 + length];
            assert_eq!(checksum(12 + length), bitwise(data));
            records.push(data.to_vec());
            rest = &rest[16 + length..];
        }
        assert_eq!(records.len(), 3);
        assert!(records[0].ends_with(b"\x1a\x0dbrain.Event:2"));
        // Step 4096 as a varint, then the summary.
        assert_eq!(records[1][9..12], [0x10, 0x80, 0x20]);
        assert!(
            records[1].windows(13).any(|window| window == b"\x0a\x06reward\x15\x00\x00\xfc\x41")
        );
    }
}
