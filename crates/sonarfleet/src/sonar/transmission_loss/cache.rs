//! Rows that have been computed before, kept in files.

use super::chunk::{self, Chunk};
use super::settings::LossTableSettings;
use crate::fingerprint::Fingerprint;
use crate::grid::{CellId, SurveillanceGrid};
use crate::sonar::section::Waters;
use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};

/// Version of the way from waters and settings to rows. It is raised with every
/// change that moves a loss; a test holds rows of this version.
pub(crate) const TABLE_VERSION: u32 = 3;

/// Rows are written when so many are waiting, or when the last were written so
/// long ago: a killed program loses no more than that.
const ROWS_IN_CHUNK: usize = 16;
const LONGEST_WAIT: Duration = Duration::from_secs(5);

/// File in an entry whose time says when the entry was last used.
const LAST_USED: &str = "used";

/// A directory of computed rows. An entry in it, itself a directory, is named
/// after the SHA-256 of everything that decides its rows ([`table_fingerprint`]), so
/// that what is found in it is what would be computed, bit for bit. Rows are
/// written while a table is computed: a killed computation goes on where it
/// stopped. Files are checked by their checksums; what is damaged is computed
/// again. Where the directory cannot be written, rows are just not kept.
///
/// When an entry has grown, those that were used longest ago are removed until
/// the rest takes up no more than the limit.
#[derive(Debug, Clone)]
pub struct LossCache {
    directory: PathBuf,
    limit_bytes: u64,
}

impl LossCache {
    /// What all entries together may take up, unless said otherwise: 2 GB.
    pub const LIMIT_BYTES: u64 = 2_000_000_000;

    /// The cache in a directory, which need not exist yet.
    pub fn new(directory: impl Into<PathBuf>) -> Self {
        Self { directory: directory.into(), limit_bytes: Self::LIMIT_BYTES }
    }

    /// The same cache with another limit, in bytes.
    #[must_use]
    pub fn limited_to(self, limit_bytes: u64) -> Self {
        Self { limit_bytes, ..self }
    }

    /// Where the entries are.
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// Opens an entry and reads its rows.
    pub(super) fn open(&self, fingerprint: String, cells: usize) -> Entry<'_> {
        let directory = self.directory.join(&fingerprint);
        let usable = fs::create_dir_all(&directory)
            .and_then(|()| crate::replace_file(&directory.join(LAST_USED), b""))
            .inspect_err(|error| {
                tracing::warn!("{}: rows cannot be kept: {error}", directory.display());
            })
            .is_ok();
        let mut kept = HashMap::new();
        for path in chunk::files(&directory) {
            match chunk::read(&path, &fingerprint, cells) {
                Ok(chunk) => kept.extend(chunk),
                Err(reason) => {
                    tracing::warn!("{}: {reason}; its rows are computed again", path.display());
                    // Another one is written in its place; until then it does no harm.
                    let _ = fs::remove_file(&path);
                }
            }
        }
        let pending = Pending { rows: Vec::new(), usable, written: Instant::now() };
        Entry { cache: self, fingerprint, directory, cells, kept, pending: Mutex::new(pending) }
    }

    /// Removes the entries that were used longest ago, but not one, until the rest
    /// is within the limit.
    fn trim(&self, but: &Path) -> io::Result<()> {
        let mut entries = Vec::new();
        for item in fs::read_dir(&self.directory)? {
            let path = item?.path();
            if is_entry(&path) {
                entries.push((last_use(&path), size_bytes(&path)?, path));
            }
        }
        entries.sort();
        let mut total: u64 = entries.iter().map(|(_, bytes, _)| bytes).sum();
        for (_, bytes, path) in entries {
            if total <= self.limit_bytes {
                break;
            }
            if path != but {
                tracing::info!("{}: removed, so that the cache stays small", path.display());
                fs::remove_dir_all(&path)?;
                total -= bytes;
            }
        }
        Ok(())
    }
}

/// SHA-256 of everything that decides the rows of a table: sound speeds, sea
/// floor, seabed and absorption; grid, frequency, depth, range and numerics; the
/// version of the computation. 64 hexadecimal digits.
pub fn table_fingerprint(
    waters: &Waters,
    grid: &SurveillanceGrid,
    settings: &LossTableSettings,
) -> String {
    let version = format!("rows {TABLE_VERSION} of sonarfleet {}", env!("CARGO_PKG_VERSION"));
    let LossTableSettings { frequency_hz, fleet_depth_m, maximum_range_m, numerics, model } =
        settings;
    // `{:?}` says numbers with as many digits as tell them apart.
    waters
        .add_to(Fingerprint::default().text(&version))
        .text(&format!("{grid:?}"))
        .numbers(&[*frequency_hz, *fleet_depth_m, *maximum_range_m])
        .text(&format!("{numerics:?}"))
        .text(&model.identity())
        .finish()
}

/// The rows of one table.
pub(super) struct Entry<'a> {
    cache: &'a LossCache,
    fingerprint: String,
    directory: PathBuf,
    cells: usize,
    kept: HashMap<CellId, Vec<f32>>,
    pending: Mutex<Pending>,
}

/// Rows that wait to be written.
struct Pending {
    rows: Chunk,
    /// Whether writing has worked so far.
    usable: bool,
    written: Instant,
}

impl Entry<'_> {
    /// Where the rows are.
    pub(super) fn directory(&self) -> &Path {
        &self.directory
    }

    /// The row of a source, if it was there when the entry was opened.
    pub(super) fn row(&self, source: CellId) -> Option<&[f32]> {
        self.kept.get(&source).map(Vec::as_slice)
    }

    /// Keeps a row that has been computed.
    pub(super) fn keep(&self, source: CellId, row: &[f32]) {
        let full = {
            let mut pending = self.pending.lock().unwrap_or_else(PoisonError::into_inner);
            if !pending.usable {
                return;
            }
            pending.rows.push((source, row.to_vec()));
            let due =
                pending.rows.len() >= ROWS_IN_CHUNK || pending.written.elapsed() >= LONGEST_WAIT;
            if !due {
                return;
            }
            pending.written = Instant::now();
            std::mem::take(&mut pending.rows)
        };
        self.write(full);
    }

    /// Writes what still waits, and keeps the cache small.
    pub(super) fn close(self) {
        let rest = {
            let mut pending = self.pending.lock().unwrap_or_else(PoisonError::into_inner);
            if !pending.usable {
                return;
            }
            std::mem::take(&mut pending.rows)
        };
        if !rest.is_empty() {
            self.write(rest);
        }
        if let Err(error) = self.cache.trim(&self.directory) {
            tracing::warn!("{}: cannot be tidied: {error}", self.cache.directory.display());
        }
    }

    fn write(&self, mut rows: Chunk) {
        rows.sort_by_key(|(source, _)| *source);
        if let Err(error) = chunk::write(&self.directory, &self.fingerprint, self.cells, &rows) {
            let mut pending = self.pending.lock().unwrap_or_else(PoisonError::into_inner);
            if pending.usable {
                tracing::warn!("{}: rows cannot be kept: {error}", self.directory.display());
            }
            pending.usable = false;
        }
    }
}

/// Whether a path is an entry's: nothing else may ever be removed.
fn is_entry(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    name.len() == 64 && name.bytes().all(|byte| byte.is_ascii_hexdigit()) && path.is_dir()
}

fn last_use(entry: &Path) -> SystemTime {
    let file = fs::metadata(entry.join(LAST_USED));
    file.and_then(|data| data.modified()).unwrap_or(SystemTime::UNIX_EPOCH)
}

fn size_bytes(entry: &Path) -> io::Result<u64> {
    fs::read_dir(entry)?.map(|item| Ok(item?.metadata()?.len())).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: usize = 3;

    fn name(letter: char) -> String {
        letter.to_string().repeat(64)
    }

    fn row(source: usize) -> Vec<f32> {
        (0..CELLS).map(|target| (10 * source + target) as f32 + 0.125).collect()
    }

    fn keep(cache: &LossCache, fingerprint: &str, sources: std::ops::Range<usize>) {
        let entry = cache.open(fingerprint.to_owned(), CELLS);
        for source in sources {
            entry.keep(CellId(source), &row(source));
        }
        entry.close();
    }

    #[test]
    fn rows_come_back_in_their_own_entry_only() {
        let home = tempfile::tempdir().unwrap();
        let cache = LossCache::new(home.path().join("not/there/yet"));
        keep(&cache, &name('a'), 0..2);
        let entry = cache.open(name('a'), CELLS);
        assert_eq!(entry.row(CellId(1)), Some(&row(1)[..]));
        assert_eq!(entry.row(CellId(2)), None);
        assert_eq!(cache.open(name('b'), CELLS).row(CellId(1)), None);
    }

    #[test]
    fn rows_are_there_before_the_end() {
        let home = tempfile::tempdir().unwrap();
        let cache = LossCache::new(home.path());
        let entry = cache.open(name('a'), CELLS);
        for source in 0..=ROWS_IN_CHUNK {
            entry.keep(CellId(source % CELLS), &row(source % CELLS));
        }
        // The entry is dropped as by a kill: what waited is lost.
        drop(entry);
        assert_eq!(chunk::files(&home.path().join(name('a'))).count(), 1);
    }

    #[test]
    fn damaged_files_are_noticed_and_replaced() {
        let home = tempfile::tempdir().unwrap();
        let cache = LossCache::new(home.path());
        keep(&cache, &name('a'), 0..3);
        let file = chunk::files(&home.path().join(name('a'))).next().unwrap();
        let whole = fs::read(&file).unwrap();
        for damaged in [
            whole[..whole.len() / 2].to_vec(),
            whole[..whole.len() - 1].to_vec(),
            Vec::new(),
            b"rows".to_vec(),
            whole.iter().enumerate().map(|(k, b)| if k == 120 { b ^ 1 } else { *b }).collect(),
            [&whole[..], b"more"].concat(),
        ] {
            fs::write(&file, damaged).unwrap();
            let entry = cache.open(name('a'), CELLS);
            assert_eq!(entry.row(CellId(0)), None);
            assert!(!file.exists());
        }
        // A file of another entry, or of another grid, is damage too.
        fs::create_dir_all(home.path().join(name('b'))).unwrap();
        fs::write(home.path().join(name('b')).join(file.file_name().unwrap()), &whole).unwrap();
        assert_eq!(cache.open(name('b'), CELLS).row(CellId(0)), None);
        fs::write(&file, &whole).unwrap();
        assert_eq!(cache.open(name('a'), CELLS + 1).row(CellId(0)), None);
        fs::write(&file, &whole).unwrap();
        assert_eq!(cache.open(name('a'), CELLS).row(CellId(0)), Some(&row(0)[..]));
    }

    #[test]
    fn the_entries_used_longest_ago_go_first_and_nothing_else_goes() {
        let home = tempfile::tempdir().unwrap();
        fs::write(home.path().join("notes.txt"), "kept").unwrap();
        fs::create_dir(home.path().join("other")).unwrap();
        let cache = LossCache::new(home.path());
        for (letter, hours_ago) in [('a', 3), ('b', 1), ('c', 2)] {
            keep(&cache, &name(letter), 0..3);
            let used = fs::File::options()
                .write(true)
                .open(home.path().join(name(letter)).join(LAST_USED))
                .unwrap();
            used.set_modified(SystemTime::now() - Duration::from_hours(hours_ago)).unwrap();
        }
        let entry_bytes = size_bytes(&home.path().join(name('a'))).unwrap();
        keep(&cache.clone().limited_to(2 * entry_bytes), &name('d'), 0..3);
        let there = |name: &str| home.path().join(name).exists();
        assert_eq!(['a', 'b', 'c', 'd'].map(|l| there(&name(l))), [false, true, false, true]);
        assert!(there("notes.txt") && there("other"));
        keep(&cache.limited_to(0), &name('d'), 3..3);
        assert_eq!(['b', 'd'].map(|l| there(&name(l))), [false, true], "the present one stays");
    }

    #[test]
    fn a_directory_that_cannot_be_written_is_no_reason_to_stop() {
        let home = tempfile::tempdir().unwrap();
        let file = home.path().join("in the way");
        fs::write(&file, "").unwrap();
        keep(&LossCache::new(&file), &name('a'), 0..3);
        assert!(file.is_file());
    }
}
