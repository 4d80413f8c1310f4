use super::read::{Reading, read_texts};
use super::write::write_texts;
use crate::error::AcousticsError;
use crate::model::Case;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The endings of files that `.env` files may refer to.
pub(crate) const COMPANIONS: [&str; 6] = ["ssp", "bty", "ati", "brc", "trc", "sbp"];

/// The input files of a case, as texts in memory: `CASE.env`, and the files beside it
/// that it refers to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CaseFiles {
    /// Their common path, without an ending.
    root: PathBuf,
    /// By ending.
    texts: BTreeMap<String, String>,
}

impl CaseFiles {
    /// Files of a common path (`CASE` or `CASE.env`) that hold nothing yet.
    pub fn new(path: &Path) -> Self {
        Self { root: root_of(path), texts: BTreeMap::new() }
    }

    /// Loads `CASE.env` and what lies beside it, given as `CASE` or `CASE.env`.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn load(path: &Path) -> Result<Self, AcousticsError> {
        let mut files = Self::new(path);
        for ending in std::iter::once("env").chain(COMPANIONS) {
            let path = files.path(ending);
            match std::fs::read(&path) {
                Ok(bytes) => {
                    let text = String::from_utf8_lossy(&bytes).into_owned();
                    files.texts.insert(ending.to_owned(), text);
                }
                Err(error) if ending != "env" && error.kind() == std::io::ErrorKind::NotFound => {}
                Err(error) => {
                    return Err(AcousticsError::Unreadable { path, reason: error.to_string() });
                }
            }
        }
        Ok(files)
    }

    /// The files of a case, as a program of the BELLHOP family would read them.
    ///
    /// Boxes of the family are as long behind the source as ahead of it, and its files
    /// know neither cut-offs nor tolerances: of the [`TraceSettings`], only the further
    /// of both ends and the greatest depth are kept. The step, which the native model
    /// does not have, is a thousandth of the range, from 1 to 20 m.
    ///
    /// [`TraceSettings`]: crate::field::TraceSettings
    ///
    /// # Errors
    /// If the files cannot express the case: sound speeds over range that are not
    /// linear in depth, attenuations at other levels than the sound speed's, or
    /// directions of unequal distances in a run that adds beams up.
    pub fn of(case: &Case, path: &Path) -> Result<Self, AcousticsError> {
        let far_m = case.settings.far_m.max(-case.settings.near_m);
        Self::with_step_m(case, path, (far_m / 1000.0).clamp(1.0, 20.0))
    }

    /// As [`CaseFiles::of`] with a ray step in metres; 0 lets the program choose.
    ///
    /// # Errors
    /// As [`CaseFiles::of`].
    pub fn with_step_m(case: &Case, path: &Path, step_m: f64) -> Result<Self, AcousticsError> {
        let texts = write_texts(case, step_m)?;
        Ok(texts
            .into_iter()
            .fold(Self::new(path), |files, (ending, text)| files.with(ending, text)))
    }

    /// The same files with another text in place of that of one ending (`"env"`,
    /// `"bty"`, …).
    #[must_use]
    pub fn with(mut self, ending: &str, text: impl Into<String>) -> Self {
        self.texts.insert(ending.to_owned(), text.into());
        self
    }

    /// The text of the file of an ending.
    pub fn text(&self, ending: &str) -> Option<&str> {
        self.texts.get(ending).map(String::as_str)
    }

    /// The path of the file of an ending.
    pub fn path(&self, ending: &str) -> PathBuf {
        let mut path = self.root.clone().into_os_string();
        path.push(".");
        path.push(ending);
        path.into()
    }

    /// Understands the files.
    ///
    /// # Errors
    /// If a file is missing, a line does not hold what belongs there or asks for
    /// something that is not supported, or the environment makes no sense. Errors name
    /// the file and the line.
    pub fn read(&self) -> Result<Reading, AcousticsError> {
        read_texts(self)
    }

    /// Writes the files into the place that their path names.
    ///
    /// # Errors
    /// If one cannot be written.
    pub fn save(&self) -> Result<(), AcousticsError> {
        self.texts.iter().try_for_each(|(ending, text)| {
            let path = self.path(ending);
            std::fs::write(&path, text)
                .map_err(|error| AcousticsError::Unwritable { path, reason: error.to_string() })
        })
    }
}

/// `CASE` of `CASE.env` and of `CASE`.
fn root_of(path: &Path) -> PathBuf {
    let is_env = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("env"));
    if is_env { path.with_extension("") } else { path.to_owned() }
}
