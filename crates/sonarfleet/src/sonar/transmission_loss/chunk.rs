//! A file of rows: magic, fingerprint of the table, number of rows, number of
//! cells, source cells, losses, SHA-256 of all that; numbers are little-endian.

use crate::fingerprint::hexadecimal;
use crate::grid::CellId;
use sha2::{Digest, Sha256};
use std::io;
use std::path::{Path, PathBuf};

/// Source cells and their rows.
pub(super) type Chunk = Vec<(CellId, Vec<f32>)>;

const MAGIC: &[u8] = b"sonarfleet rows 1\n";
const EXTENSION: &str = "rows";
const CHECKSUM_BYTES: usize = 32;

/// Writes rows into a directory, under a name that their sources decide.
pub(super) fn write(
    directory: &Path,
    fingerprint: &str,
    cells: usize,
    rows: &Chunk,
) -> io::Result<()> {
    let mut bytes = header(fingerprint, rows.len(), cells);
    let sources: Vec<u8> =
        rows.iter().flat_map(|(source, _)| (source.0 as u32).to_le_bytes()).collect();
    bytes.extend(&sources);
    bytes.extend(rows.iter().flat_map(|(_, row)| row.iter().flat_map(|loss| loss.to_le_bytes())));
    let checksum = Sha256::digest(&bytes);
    bytes.extend(checksum);
    let name = &hexadecimal(&Sha256::digest(&sources))[..16];
    // Another run may have tidied the directory away.
    std::fs::create_dir_all(directory)?;
    crate::replace_file(&directory.join(name).with_extension(EXTENSION), &bytes)
}

/// Reads a file of rows; says what is wrong if it is not one of this table, whole
/// and undamaged.
pub(super) fn read(path: &Path, fingerprint: &str, cells: usize) -> Result<Chunk, String> {
    let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
    let whole = bytes.len().checked_sub(CHECKSUM_BYTES).ok_or("truncated")?;
    let (content, checksum) = bytes.split_at(whole);
    if Sha256::digest(content).as_slice() != checksum {
        return Err("damaged: the checksum is not that of the content".into());
    }
    let numbers_at = MAGIC.len() + fingerprint.len() + 8;
    let rest = content.get(numbers_at..).ok_or("truncated")?;
    let count = rest.len() / (4 * (cells + 1));
    if content[..numbers_at] != header(fingerprint, count, cells)[..]
        || rest.len() != 4 * count * (cells + 1)
    {
        return Err("not a file of rows of this table".into());
    }
    let (sources, losses) = rest.split_at(4 * count);
    let word = |bytes: &[u8]| [bytes[0], bytes[1], bytes[2], bytes[3]];
    let rows = sources.chunks_exact(4).zip(losses.chunks_exact(4 * cells)).map(|(source, row)| {
        let source = CellId(u32::from_le_bytes(word(source)) as usize);
        (source, row.chunks_exact(4).map(|loss| f32::from_le_bytes(word(loss))).collect())
    });
    Ok(rows.collect())
}

/// The files of rows in a directory.
pub(super) fn files(directory: &Path) -> impl Iterator<Item = PathBuf> {
    let items = std::fs::read_dir(directory).into_iter().flatten().flatten();
    items
        .map(|item| item.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == EXTENSION))
}

fn header(fingerprint: &str, rows: usize, cells: usize) -> Vec<u8> {
    let counts = [rows as u32, cells as u32].map(u32::to_le_bytes);
    [MAGIC, fingerprint.as_bytes(), &counts[0], &counts[1]].concat()
}
