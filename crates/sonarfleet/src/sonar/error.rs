//! What can be wrong with the sonar's, the links' or the prior's numbers.

/// A number that no detection model, link model or prior can work with.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SonarError {
    /// A number lies outside the range where it makes sense.
    #[error("`{name}` is {found}, expected {expected}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// The value found.
        found: f64,
        /// The range, in words.
        expected: &'static str,
    },
    /// One value of an array lies outside the range where it makes sense.
    #[error("`{name}`: value {index} is {found}, expected {expected}")]
    ElementOutOfRange {
        /// Name of the array.
        name: &'static str,
        /// Index of the value.
        index: usize,
        /// The value found.
        found: f64,
        /// The range, in words.
        expected: &'static str,
    },
    /// An array has the wrong number of values.
    #[error("`{name}` has {found} values, expected {expected}")]
    WrongLength {
        /// Name of the array.
        name: &'static str,
        /// Number of values found.
        found: usize,
        /// What was expected, in words.
        expected: String,
    },
    /// The corridor's line does not cross the region.
    #[error("the line y = {slope} x + {intercept} does not cross the region [0, 10] × [0, 10]")]
    LineOutsideRegion {
        /// Slope of the line.
        slope: f64,
        /// Intercept of the line.
        intercept: f64,
    },
    /// The prior is zero everywhere, so no layout is better than another.
    #[error("the target prior is zero in every cell")]
    EmptyPrior,
}

/// `value` where it passes the test, the error with its name where not.
pub(crate) fn checked(
    name: &'static str,
    value: f64,
    expected: &'static str,
    test: impl Fn(f64) -> bool,
) -> Result<f64, SonarError> {
    if test(value) {
        Ok(value)
    } else {
        Err(SonarError::OutOfRange { name, found: value, expected })
    }
}
