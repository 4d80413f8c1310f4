//! The run directory: `DIR.partial` while the run goes on, `DIR` once it is whole,
//! so that a part can never pass for a whole.

use super::RecordError;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A run directory in the making.
#[derive(Debug)]
pub struct RunDirectory {
    partial: PathBuf,
    whole: PathBuf,
}

impl RunDirectory {
    /// Starts a new run directory.
    ///
    /// # Errors
    /// If the directory exists, an unfinished run is in the way, or it cannot be created.
    pub fn create(whole: &Path) -> Result<Self, RecordError> {
        let directory = Self::at(whole)?;
        if let Some(parent) = directory.partial.parent() {
            fs::create_dir_all(parent).map_err(RecordError::io(parent))?;
        }
        fs::create_dir(&directory.partial).map_err(|source| match source.kind() {
            ErrorKind::AlreadyExists => RecordError::Unfinished { path: directory.partial.clone() },
            _ => RecordError::Io { path: directory.partial.clone(), source },
        })?;
        Ok(directory)
    }

    /// Continues a run directory that was left unfinished.
    ///
    /// # Errors
    /// If there is none, or the whole one exists already.
    pub fn resume(whole: &Path) -> Result<Self, RecordError> {
        let directory = Self::at(whole)?;
        if directory.partial.is_dir() {
            Ok(directory)
        } else {
            Err(RecordError::NothingToResume { path: directory.partial })
        }
    }

    fn at(whole: &Path) -> Result<Self, RecordError> {
        if whole.exists() {
            return Err(RecordError::Exists { path: whole.to_owned() });
        }
        let mut name = whole.file_name().unwrap_or_default().to_owned();
        name.push(".partial");
        Ok(Self { partial: whole.with_file_name(name), whole: whole.to_owned() })
    }

    /// Where the files go while the run goes on.
    pub fn path(&self) -> &Path {
        &self.partial
    }

    /// Gives the finished run its name.
    ///
    /// # Errors
    /// If the directory cannot be renamed.
    pub fn finish(self) -> Result<PathBuf, RecordError> {
        fs::rename(&self.partial, &self.whole).map_err(RecordError::io(&self.whole))?;
        Ok(self.whole)
    }

    /// Removes what was begun.
    ///
    /// # Errors
    /// If the directory cannot be removed.
    pub fn discard(self) -> Result<(), RecordError> {
        fs::remove_dir_all(&self.partial).map_err(RecordError::io(&self.partial))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_never_has_the_name_of_a_whole() {
        let home = tempfile::tempdir().unwrap();
        let whole = home.path().join("out");
        assert!(matches!(RunDirectory::resume(&whole), Err(RecordError::NothingToResume { .. })));

        let started = RunDirectory::create(&whole).unwrap();
        fs::write(started.path().join("file"), "kept").unwrap();
        assert!(!whole.exists());
        assert!(matches!(RunDirectory::create(&whole), Err(RecordError::Unfinished { .. })));

        let resumed = RunDirectory::resume(&whole).unwrap();
        assert_eq!(resumed.finish().unwrap(), whole);
        assert_eq!(fs::read_to_string(whole.join("file")).unwrap(), "kept");
        assert!(matches!(RunDirectory::create(&whole), Err(RecordError::Exists { .. })));
    }

    #[test]
    fn discarding_leaves_nothing() {
        let home = tempfile::tempdir().unwrap();
        RunDirectory::create(&home.path().join("out")).unwrap().discard().unwrap();
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
    }
}
