use super::Executable;
use crate::error::AcousticsError;
use std::ffi::OsString;
use std::path::PathBuf;

/// By what names the program is looked for on the path.
const NAMES: [&str; 2] = ["bellhop.exe", "bellhop"];

/// The program that a variable names, or the first on a path.
pub(super) fn find(
    named: Option<OsString>,
    path: Option<OsString>,
) -> Result<PathBuf, AcousticsError> {
    let variable = Executable::VARIABLE;
    if let Some(program) = named.filter(|program| !program.is_empty()).map(PathBuf::from) {
        if program.is_file() {
            // Runs have other working directories.
            return Ok(std::path::absolute(&program).unwrap_or(program));
        }
        let searched = format!("${variable} is {}, which is no file", program.display());
        return Err(AcousticsError::NoExecutable { searched });
    }
    let directories: Vec<PathBuf> =
        path.iter().flat_map(|path| std::env::split_paths(path)).collect();
    let programs =
        NAMES.iter().flat_map(|name| directories.iter().map(move |directory| directory.join(name)));
    let found = programs.filter(|program| program.is_absolute()).find(|program| program.is_file());
    found.ok_or_else(|| {
        let directories: Vec<String> =
            directories.iter().map(|directory| directory.display().to_string()).collect();
        let searched = format!(
            "${variable} is not set, and neither {} lies in a directory of $PATH ({})",
            NAMES.join(" nor "),
            directories.join(", "),
        );
        AcousticsError::NoExecutable { searched }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_looked_for_is_said() {
        let complaint = find(Some("/nowhere/bellhop.exe".into()), None).unwrap_err().to_string();
        assert!(complaint.contains("$SONARFLEET_BELLHOP is /nowhere/bellhop.exe"), "{complaint}");
        assert!(complaint.contains("native model needs no external program"), "{complaint}");
        let complaint = find(None, Some("/nowhere:/nor/here".into())).unwrap_err().to_string();
        for part in ["not set", "bellhop.exe nor bellhop", "/nowhere, /nor/here"] {
            assert!(complaint.contains(part), "{complaint}");
        }
    }
}
