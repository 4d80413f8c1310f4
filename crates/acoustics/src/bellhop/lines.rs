use crate::error::AcousticsError;
use std::path::{Path, PathBuf};

/// Reads values as Fortran's list-directed input does: separated by blanks or
/// commas, over as many lines as it takes; a slash ends a record early and
/// leaves the rest as it was.
pub(crate) struct Lines {
    path: PathBuf,
    text: Vec<String>,
    next: usize,
}

impl Lines {
    pub(crate) fn open(path: &Path) -> Result<Self, AcousticsError> {
        let bytes = std::fs::read(path).map_err(|error| AcousticsError::Unreadable {
            path: path.to_owned(),
            reason: error.to_string(),
        })?;
        let text = String::from_utf8_lossy(&bytes);
        let text = text.lines().map(str::to_owned).collect();
        Ok(Self { path: path.to_owned(), text, next: 0 })
    }

    /// The error that the line just read does not hold `expected`.
    pub(crate) fn syntax(&self, expected: &'static str) -> AcousticsError {
        let found = self.next.checked_sub(1).and_then(|index| self.text.get(index));
        AcousticsError::Syntax {
            path: self.path.clone(),
            line: self.next,
            expected,
            found: found.cloned().unwrap_or_default(),
        }
    }

    /// The error that the line just read asks for something not supported.
    pub(crate) fn unsupported(
        &self,
        feature: &'static str,
        found: &impl ToString,
    ) -> AcousticsError {
        AcousticsError::Unsupported {
            path: self.path.clone(),
            line: self.next,
            feature,
            found: found.to_string(),
        }
    }

    /// The next line that is not blank.
    fn line(&mut self, expected: &'static str) -> Result<String, AcousticsError> {
        while let Some(line) = self.text.get(self.next) {
            self.next += 1;
            if !line.trim().is_empty() {
                return Ok(line.clone());
            }
        }
        self.next = self.text.len() + 1;
        Err(self.syntax(expected))
    }

    /// A quoted text and what follows it on its line.
    pub(crate) fn text(
        &mut self,
        expected: &'static str,
    ) -> Result<(String, String), AcousticsError> {
        let line = self.line(expected)?;
        let trimmed = line.trim_start();
        let quote = trimmed.chars().next().filter(|c| matches!(c, '\'' | '"'));
        let parts = quote.and_then(|quote| trimmed[1..].split_once(quote));
        let (text, rest) = parts.ok_or_else(|| self.syntax(expected))?;
        Ok((text.to_owned(), rest.to_owned()))
    }

    /// One record of values, which take the place of those in `values` until a
    /// slash; without one, lines are read until all are replaced.
    pub(crate) fn record(
        &mut self,
        expected: &'static str,
        values: &mut [f64],
    ) -> Result<(), AcousticsError> {
        self.values(expected, values).map(|_| ())
    }

    /// As [`Lines::record`], returning how many values there were.
    pub(crate) fn values(
        &mut self,
        expected: &'static str,
        values: &mut [f64],
    ) -> Result<usize, AcousticsError> {
        let mut count = 0;
        while count < values.len() {
            let line = self.line(expected)?;
            let line = line.split('!').next().unwrap_or_default();
            for token in line.replace(',', " ").split_whitespace() {
                let (number, ended) = match token.split_once('/') {
                    Some((number, _)) => (number, true),
                    None => (token, false),
                };
                if !number.is_empty() {
                    values[count] = fortran_number(number).ok_or_else(|| self.syntax(expected))?;
                    count += 1;
                }
                if ended || count == values.len() {
                    return Ok(count);
                }
            }
        }
        Ok(count)
    }

    /// One number.
    pub(crate) fn number(&mut self, expected: &'static str) -> Result<f64, AcousticsError> {
        let mut value = [f64::NAN];
        self.record(expected, &mut value)?;
        if value[0].is_nan() { Err(self.syntax(expected)) } else { Ok(value[0]) }
    }

    /// One count, at most a million.
    pub(crate) fn count(&mut self, expected: &'static str) -> Result<usize, AcousticsError> {
        let value = self.number(expected)?;
        if (0.0..=1e6).contains(&value) && value.fract() == 0.0 {
            Ok(value as usize)
        } else {
            Err(self.syntax(expected))
        }
    }

    /// A count and as many values; two values and a slash stand for equal steps
    /// between them.
    pub(crate) fn vector(
        &mut self,
        expected_count: &'static str,
        expected: &'static str,
    ) -> Result<Vec<f64>, AcousticsError> {
        let count = self.count(expected_count)?;
        let mut values = vec![f64::NAN; count];
        let found = self.values(expected, &mut values)?;
        if found == 2 && count > 2 {
            let (first, last) = (values[0], values[1]);
            let step = (last - first) / (count - 1) as f64;
            return Ok((0..count).map(|k| first + k as f64 * step).collect());
        }
        if found == 1 {
            let only = values[0];
            values.fill(only);
        } else if found < count {
            return Err(self.syntax(expected));
        }
        Ok(values)
    }
}

/// A number as Fortran writes it (exponents may be `d`).
fn fortran_number(token: &str) -> Option<f64> {
    let value: f64 = token.replace(['d', 'D'], "e").parse().ok()?;
    value.is_finite().then_some(value)
}
