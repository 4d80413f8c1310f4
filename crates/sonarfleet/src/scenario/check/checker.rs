//! What every check needs: bounds with units, and errors that say where.

use super::ScenarioError;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Checks values of one scenario.
pub(super) struct Checker<'a> {
    /// The scenario's path, for errors.
    pub(super) origin: &'a str,
    /// What its paths are relative to.
    pub(super) home: &'a Path,
}

impl Checker<'_> {
    /// A number within bounds, both included.
    pub(super) fn within(
        &self,
        key: &'static str,
        found: f64,
        (least, most): (f64, f64),
        unit: &str,
    ) -> Result<f64, ScenarioError> {
        if (least..=most).contains(&found) {
            Ok(found)
        } else {
            Err(self.wrong(key, found, format!("{least} to {most} {unit}")))
        }
    }

    /// A count within bounds, both included.
    pub(super) fn count(
        &self,
        key: &'static str,
        found: usize,
        (least, most): (usize, usize),
    ) -> Result<usize, ScenarioError> {
        if (least..=most).contains(&found) {
            Ok(found)
        } else {
            Err(self.wrong(key, found, format!("a number from {least} to {most}")))
        }
    }

    /// A value that does not do.
    pub(super) fn wrong(
        &self,
        key: &'static str,
        found: impl Display,
        expected: impl Display,
    ) -> ScenarioError {
        ScenarioError::Value {
            origin: self.origin.to_owned(),
            key,
            found: found.to_string(),
            expected: expected.to_string(),
        }
    }

    /// A file that does not hold what it should.
    pub(super) fn file(
        &self,
        key: &'static str,
        path: &Path,
        reason: impl Display,
    ) -> ScenarioError {
        ScenarioError::File {
            origin: self.origin.to_owned(),
            key,
            path: path.to_owned(),
            reason: reason.to_string(),
        }
    }

    /// A path of the scenario, resolved, to a file that exists.
    pub(super) fn existing(
        &self,
        key: &'static str,
        path: &Path,
    ) -> Result<PathBuf, ScenarioError> {
        let path = self.home.join(path);
        if path.is_file() { Ok(path) } else { Err(self.file(key, &path, "no such file")) }
    }
}
