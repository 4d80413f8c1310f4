//! Files that are either whole or not there.

use std::io;
use std::path::Path;

/// Writes a file under a temporary name beside its place and renames it, so that
/// nobody ever sees half of it: readers find the old file or the whole new one.
///
/// # Errors
/// If the file cannot be written or renamed; nothing new is left behind then.
pub fn replace_file(path: &Path, contents: &[u8]) -> io::Result<()> {
    let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?.to_string_lossy();
    let partial = path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
    std::fs::write(&partial, contents).and_then(|()| std::fs::rename(&partial, path)).inspect_err(
        |_| {
            // The error that matters is the one of writing.
            let _ = std::fs::remove_file(&partial);
        },
    )
}
