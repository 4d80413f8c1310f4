use std::path::PathBuf;

/// Why an acoustic environment or a file that describes one cannot be used.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum AcousticsError {
    /// Coordinates that must ascend strictly do not.
    #[error("{quantity} must ascend strictly and be finite: entry {index} is {found}")]
    NotAscending {
        /// Which coordinates.
        quantity: &'static str,
        /// The first entry that does not, from 0.
        index: usize,
        /// Its value.
        found: f64,
    },
    /// Two arrays that belong together differ in size.
    #[error("{quantity}: expected {expected} values, found {found}")]
    Length {
        /// Which values.
        quantity: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number outside its physical range.
    #[error("{quantity} must be {expected}: found {found}")]
    OutOfRange {
        /// Which number.
        quantity: &'static str,
        /// What it may be.
        expected: &'static str,
        /// What it is.
        found: f64,
    },
    /// The sound-speed levels end above the sea floor.
    #[error(
        "the sound-speed levels end at {deepest_level_m} m, above the sea floor at {deepest_floor_m} m"
    )]
    LevelsTooShallow {
        /// Depth of the last level, metres.
        deepest_level_m: f64,
        /// Depth of the sea floor at its deepest, metres.
        deepest_floor_m: f64,
    },
    /// The surface rises above the sound-speed levels.
    #[error(
        "the surface lies at {surface_m} m at the range of {range_m} m, above the first sound-speed level at {first_level_m} m"
    )]
    SurfaceAboveLevels {
        /// Where, metres.
        range_m: f64,
        /// Depth of the surface there, metres.
        surface_m: f64,
        /// Depth of the first level, metres.
        first_level_m: f64,
    },
    /// The surface lies below the sea floor.
    #[error(
        "there is no water at the range of {range_m} m: the surface lies at {surface_m} m, the sea floor at {floor_m} m"
    )]
    NoWater {
        /// Where, metres.
        range_m: f64,
        /// Depth of the surface there, metres.
        surface_m: f64,
        /// Depth of the sea floor there, metres.
        floor_m: f64,
    },
    /// The source is not in the water.
    #[error(
        "the source at {source_depth_m} m is not in the water, which reaches from {surface_m} m to {floor_m} m there"
    )]
    SourceOutsideWater {
        /// Depth of the source, metres.
        source_depth_m: f64,
        /// Depth of the surface, metres.
        surface_m: f64,
        /// Depth of the sea floor at the source, metres.
        floor_m: f64,
    },
    /// A model cannot compute what a case asks for.
    #[error("the {model} model does not compute {what}")]
    NotOffered {
        /// The model.
        model: &'static str,
        /// What is asked for.
        what: &'static str,
    },
    /// A file cannot be opened or read.
    #[error("{}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A file cannot be written.
    #[error("{}: {reason}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A file refers to another, which is not there.
    #[error("{}, line {line}: needs {}, which is not there", path.display(), needed.display())]
    MissingCompanion {
        /// The file that refers.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The file referred to.
        needed: PathBuf,
    },
    /// What a file says makes no sense.
    #[error("{}, line {line}: {problem}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// Why.
        problem: Box<AcousticsError>,
    },
    /// A binary file does not hold what belongs there.
    #[error("{}, byte {byte}: expected {expected}", path.display())]
    Binary {
        /// The file.
        path: PathBuf,
        /// Where, from 0.
        byte: usize,
        /// What belongs there.
        expected: &'static str,
    },
    /// No external program was found.
    #[error("no BELLHOP program found: {searched}. The native model needs no external program")]
    NoExecutable {
        /// What was looked for, and where.
        searched: String,
    },
    /// An external program failed.
    #[error("{}: {reason}", program.display())]
    ExternalProgram {
        /// The program.
        program: PathBuf,
        /// What it did, and what it said.
        reason: String,
    },
    /// A line of a file does not hold what belongs there.
    #[error("{}, line {line}: expected {expected}, found {found:?}", path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What belongs there.
        expected: &'static str,
        /// What is there.
        found: String,
    },
    /// A file asks for something that this crate does not compute.
    #[error("{}, line {line}: {feature} {found:?} is not supported", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What kind of thing is asked for.
        feature: &'static str,
        /// How the file asks for it.
        found: String,
    },
}

/// Checks that coordinates are finite and ascend strictly.
pub(crate) fn ascending(quantity: &'static str, values: &[f64]) -> Result<(), AcousticsError> {
    let mut previous = f64::NEG_INFINITY;
    for (index, &found) in values.iter().enumerate() {
        if !(found.is_finite() && found > previous) {
            return Err(AcousticsError::NotAscending { quantity, index, found });
        }
        previous = found;
    }
    Ok(())
}

/// Checks that there are as many values as there should be.
pub(crate) fn length(
    quantity: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), AcousticsError> {
    if found == expected {
        Ok(())
    } else {
        Err(AcousticsError::Length { quantity, expected, found })
    }
}

/// Checks that a number is finite and in its range.
pub(crate) fn within(
    quantity: &'static str,
    expected: &'static str,
    found: f64,
    good: bool,
) -> Result<(), AcousticsError> {
    if good && found.is_finite() {
        Ok(())
    } else {
        Err(AcousticsError::OutOfRange { quantity, expected, found })
    }
}
