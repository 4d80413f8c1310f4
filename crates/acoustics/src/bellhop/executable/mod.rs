//! Programs of the BELLHOP family as propagation models.

mod answer;
mod process;
mod scratch;
mod search;

pub use process::abandon_all;

use super::CaseFiles;
use crate::error::AcousticsError;
use crate::model::{Case, Output, PropagationModel, Run};
use answer::{padded, read_answer};
use process::run;
use scratch::Scratch;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// An external program of the BELLHOP family, run once for every case in a scratch
/// directory of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Executable {
    program: PathBuf,
    timeout: Duration,
    step_m: Option<f64>,
}

impl Executable {
    /// The environment variable that names the program.
    pub const VARIABLE: &'static str = "SONARFLEET_BELLHOP";

    /// Runs take this long at most, unless told otherwise.
    pub const TIMEOUT: Duration = Duration::from_hours(1);

    /// Finds the program: that named by `$SONARFLEET_BELLHOP`, else `bellhop.exe`, then
    /// `bellhop`, in the directories of `$PATH`.
    ///
    /// # Errors
    /// If there is none; the error says what was looked for, and where.
    pub fn find() -> Result<Self, AcousticsError> {
        let path = std::env::var_os("PATH").unwrap_or_default();
        search::find(std::env::var_os(Self::VARIABLE), &path).map(Self::new)
    }

    /// The program at a path.
    pub fn new(program: PathBuf) -> Self {
        Self { program, timeout: Self::TIMEOUT, step_m: None }
    }

    /// The same program, killed when a run takes longer.
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// The same program with another ray step, metres: 0 lets it choose. Without this,
    /// steps are 20 m at most, where the program has converged.
    #[must_use]
    pub fn with_step_m(self, step_m: f64) -> Self {
        Self { step_m: Some(step_m), ..self }
    }

    /// Where the program lies.
    pub fn program(&self) -> &Path {
        &self.program
    }

    /// Runs the program on a case and gives the bytes of the file that it writes.
    fn output_bytes(&self, case: &Case, ending: &str) -> Result<Vec<u8>, AcousticsError> {
        let scratch = Scratch::new()?;
        // Programs of the family fail on long paths: they get a short one.
        let path = scratch.directory().join("case");
        let files = match self.step_m {
            Some(step_m) => CaseFiles::with_step_m(case, &path, step_m)?,
            None => CaseFiles::of(case, &path)?,
        };
        files.save()?;
        run(&self.program, &scratch, self.timeout)?;
        let path = files.path(ending);
        std::fs::read(&path).map_err(|error| {
            let reason = format!("it ended well, but left no case.{ending} ({error})");
            AcousticsError::ExternalProgram { program: self.program.clone(), reason }
        })
    }
}

impl PropagationModel for Executable {
    fn name(&self) -> &'static str {
        "bellhop"
    }

    fn solve(&self, case: &Case) -> Result<Output, AcousticsError> {
        for source in case.sources() {
            source.check(&case.section)?;
        }
        let ending = match case.run {
            Run::Field(_) => "shd",
            Run::Rays | Run::Eigenrays => "ray",
            Run::Arrivals => "arr",
        };
        let bytes = self.output_bytes(&padded(case)?, ending)?;
        read_answer(case, ending, &bytes).map_err(|problem| AcousticsError::ExternalProgram {
            program: self.program.clone(),
            reason: format!("its output cannot be used: {problem}"),
        })
    }
}
