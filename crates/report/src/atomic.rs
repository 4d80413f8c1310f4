//! Files that are either whole or not there.

use crate::error::{ReportError, Result};
use std::ffi::OsString;
use std::fs;
use std::path::Path;

/// Writes a file under a temporary name beside its place and renames it, so
/// that a reader never sees half of it.
pub(crate) fn write(path: &Path, contents: &[u8]) -> Result<()> {
    let failed = |source| ReportError::Write { path: path.to_owned(), source };
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(name);
    fs::write(&temporary, contents).and_then(|()| fs::rename(&temporary, path)).map_err(|source| {
        // The temporary file may not exist; the first error is the one to tell.
        let _ = fs::remove_file(&temporary);
        failed(source)
    })
}
