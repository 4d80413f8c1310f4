use crate::error::AcousticsError;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

const PREFIX: &str = "sonarfleet-bellhop-";

/// Directories of dead processes are left alone for so long: they may be about to be
/// locked.
const SETTLING: Duration = Duration::from_secs(60);

/// A directory that goes when this does. What killed processes leave behind goes when
/// the next process makes one: a lock beside each directory, which the system releases
/// however a process ends, tells the living from the dead.
#[derive(Debug)]
pub(super) struct Scratch {
    directory: PathBuf,
    /// Held locked as long as the directory is in use.
    _lock: File,
}

impl Scratch {
    /// A new, empty directory.
    pub(super) fn new() -> Result<Self, AcousticsError> {
        static TIDIED: Once = Once::new();
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let parent = std::env::temp_dir();
        TIDIED.call_once(|| tidy(&parent));
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let directory = parent.join(format!("{PREFIX}{}-{number}", std::process::id()));
        let unwritable = |error: std::io::Error| AcousticsError::Unwritable {
            path: directory.clone(),
            reason: error.to_string(),
        };
        let lock = File::create(lock_of(&directory)).map_err(unwritable)?;
        lock.lock().map_err(unwritable)?;
        // A dead process may have had our number.
        let _ = std::fs::remove_dir_all(&directory);
        std::fs::create_dir(&directory).map_err(unwritable)?;
        Ok(Self { directory, _lock: lock })
    }

    pub(super) fn directory(&self) -> &Path {
        &self.directory
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        remove(&self.directory);
    }
}

fn lock_of(directory: &Path) -> PathBuf {
    directory.with_added_extension("lock")
}

/// Removes a scratch directory and its lock. What cannot be removed stays for the next
/// process.
pub(super) fn remove(directory: &Path) {
    let _ = std::fs::remove_dir_all(directory);
    let _ = std::fs::remove_file(lock_of(directory));
}

/// Removes what dead processes left behind.
fn tidy(parent: &Path) {
    let Ok(entries) = std::fs::read_dir(parent) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with(PREFIX) && name.ends_with(".lock") && is_dead(&path) {
            remove(&path.with_extension(""));
        }
    }
}

fn is_dead(lock: &Path) -> bool {
    let Ok(file) = File::open(lock) else { return false };
    let age = file.metadata().and_then(|about| about.modified()).map(|then| then.elapsed());
    let settled = age.is_ok_and(|age| age.is_ok_and(|age| age > SETTLING));
    settled && file.try_lock().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directories_of_the_dead_go_and_others_stay() {
        let parent = std::env::temp_dir().join(format!("tidy-test-{}", std::process::id()));
        let make = |name: &str, hours: u64| {
            let directory = parent.join(format!("{PREFIX}{name}"));
            std::fs::create_dir_all(&directory).unwrap();
            let lock = File::create(lock_of(&directory)).unwrap();
            let then = std::time::SystemTime::now() - Duration::from_secs(3600 * hours);
            lock.set_modified(then).unwrap();
            (directory, lock)
        };
        let (dead, lock) = make("1-0", 1);
        drop(lock);
        let (young, lock) = make("2-0", 0);
        drop(lock);
        let (living, held) = make("3-0", 1);
        held.lock().unwrap();
        tidy(&parent);
        assert!(!dead.exists() && !lock_of(&dead).exists());
        assert!(young.exists() && living.exists());
        std::fs::remove_dir_all(&parent).unwrap();
    }
}
