//! Files that are either whole or not there.

use std::fs;
use std::io;
use std::path::Path;

/// Writes a file under a temporary name beside its place and renames it, so that
/// nobody ever sees half of it.
///
/// # Errors
/// If the file cannot be written or renamed; nothing is left behind then.
pub fn write(path: &Path, contents: &[u8]) -> io::Result<()> {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(name);
    fs::write(&temporary, contents).and_then(|()| fs::rename(&temporary, path)).inspect_err(|_| {
        // It may not exist; the first error is the one to tell.
        let _ = fs::remove_file(&temporary);
    })
}
