use super::scratch::{Scratch, remove};
use crate::bellhop::output::fatal_reason;
use crate::error::AcousticsError;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The programs that run now, by their scratch directories; none may start once they are
/// abandoned.
static RUNNING: Mutex<Running> =
    Mutex::new(Running { children: BTreeMap::new(), abandoned: false });

struct Running {
    children: BTreeMap<PathBuf, Child>,
    abandoned: bool,
}

fn running() -> MutexGuard<'static, Running> {
    // No code panics halfway through a change of it.
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Kills all external programs that this process runs, removes their scratch directories
/// and lets no other start: what to do before a process ends at a signal.
pub fn abandon_all() {
    let mut running = running();
    running.abandoned = true;
    for (directory, child) in &mut running.children {
        // One that has just ended needs no killing.
        let _ = child.kill();
        let _ = child.wait();
        remove(directory);
    }
}

/// Runs a program on the case in a scratch directory and sees whether all went well.
pub(super) fn run(
    program: &Path,
    scratch: &Scratch,
    timeout: Duration,
) -> Result<(), AcousticsError> {
    let directory = scratch.directory();
    let failed =
        |reason: String| AcousticsError::ExternalProgram { program: program.to_owned(), reason };
    let cannot = |error: std::io::Error| failed(format!("it cannot be run ({error})"));
    let said = directory.join("said");
    let errors = directory.join("errors");
    let child = Command::new(program)
        .arg("case")
        .current_dir(directory)
        .stdin(Stdio::null())
        .stdout(File::create(&said).map_err(cannot)?)
        .stderr(File::create(&errors).map_err(cannot)?)
        .spawn()
        .map_err(cannot)?;
    let status = wait(child, directory, timeout).map_err(cannot)?;
    let Some(status) = status else {
        return Err(failed(format!("it was killed after {:.1} s", timeout.as_secs_f64())));
    };
    let text = |path: &Path| {
        let bytes = std::fs::read(path).unwrap_or_default();
        String::from_utf8_lossy(&bytes).into_owned()
    };
    if let Some(reason) = fatal_reason(&text(&directory.join("case.prt"))) {
        return Err(failed(format!("fatal error: {reason}")));
    }
    if !status.success() {
        let errors = text(&errors) + &text(&said);
        let lines: Vec<&str> =
            errors.lines().map(str::trim).filter(|line| !line.is_empty()).take(5).collect();
        return Err(failed(format!("it ended with {status}: {}", lines.join("; "))));
    }
    Ok(())
}

/// Waits until a program ends, or kills it when its time is over.
fn wait(child: Child, directory: &Path, timeout: Duration) -> std::io::Result<Option<ExitStatus>> {
    const LONGEST_NAP: Duration = Duration::from_millis(20);
    let started = Instant::now();
    let key = directory.to_owned();
    {
        let mut running = running();
        running.children.insert(key.clone(), child);
        if running.abandoned {
            drop(running);
            abandon_all();
        }
    }
    let mut nap = Duration::from_millis(1);
    loop {
        let mut running = running();
        let Some(child) = running.children.get_mut(&key) else { return Ok(None) };
        let ended = child.try_wait();
        if matches!(ended, Ok(None)) && started.elapsed() < timeout {
            drop(running);
            std::thread::sleep(nap);
            nap = (2 * nap).min(LONGEST_NAP);
            continue;
        }
        if matches!(ended, Ok(None)) {
            let _ = child.kill();
            let _ = child.wait();
        }
        running.children.remove(&key);
        return ended;
    }
}
