//! What the readers need of a file.

use super::NetcdfFile;
use super::attribute::{Attribute, AttributeValue, find};
use crate::OceanError;
use std::ops::Range;
use std::path::Path;

/// A named dimension.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dimension {
    /// Its name.
    pub name: String,
    /// Number of indices.
    pub length: usize,
}

/// A variable, without its values.
#[derive(Debug, Clone, PartialEq)]
pub struct VariableInfo {
    /// Its name.
    pub name: String,
    /// How its values are stored ("f32", "i16", …).
    pub storage: String,
    /// Its dimensions, slowest first.
    pub dimensions: Vec<Dimension>,
    /// Its attributes.
    pub attributes: Vec<Attribute>,
}

/// Something that holds named variables with dimensions and attributes.
///
/// Implementations report values as stored: missing values, scale and offset are
/// applied by the readers of this module, in one place, by the same rules for all.
pub trait DataSource {
    /// The file, for messages.
    fn path(&self) -> &Path;

    /// The file format, for people.
    fn format(&self) -> String;

    /// Attributes of the whole.
    fn attributes(&self) -> &[Attribute];

    /// All variables.
    fn variables(&self) -> &[VariableInfo];

    /// The stored values of a part of a variable: one range of indices per dimension,
    /// result in the order of the dimensions, last one fastest.
    ///
    /// # Errors
    /// [`OceanError::Damaged`] if the values cannot be had.
    fn read(&self, variable: &str, selection: &[Range<usize>]) -> Result<Vec<f64>, OceanError>;

    /// The variable of a name.
    fn variable(&self, name: &str) -> Option<&VariableInfo> {
        self.variables().iter().find(|variable| variable.name == name)
    }
}

impl VariableInfo {
    /// An attribute that is text.
    pub fn text(&self, name: &str) -> Option<&str> {
        find(&self.attributes, name).and_then(AttributeValue::as_text)
    }

    /// An attribute that is a number.
    pub fn number(&self, name: &str) -> Option<f64> {
        find(&self.attributes, name).and_then(AttributeValue::as_number)
    }

    /// Lengths of the dimensions.
    pub fn shape(&self) -> Vec<usize> {
        self.dimensions.iter().map(|dimension| dimension.length).collect()
    }

    /// The selection of everything.
    pub fn everything(&self) -> Vec<Range<usize>> {
        self.dimensions.iter().map(|dimension| 0..dimension.length).collect()
    }

    /// From stored values to what they mean: `_FillValue` and `missing_value` become NaN,
    /// then `scale_factor` and `add_offset` apply. `valid_min` and `valid_max` are left
    /// alone: packed files often give them in the wrong unit.
    pub(crate) fn decode(&self, values: &mut [f64]) {
        let missing: Vec<f64> = ["_FillValue", "missing_value"]
            .iter()
            .filter_map(|name| self.number(name))
            .filter(|value| !value.is_nan())
            .collect();
        let scale = self.number("scale_factor").unwrap_or(1.0);
        let offset = self.number("add_offset").unwrap_or(0.0);
        for value in values {
            if missing.iter().any(|&fill| is_fill(*value, fill)) {
                *value = f64::NAN;
            } else {
                *value = *value * scale + offset;
            }
        }
    }
}

/// Whether a stored value is the fill value. The large one of floats is at times given
/// in another precision than the values'.
fn is_fill(value: f64, fill: f64) -> bool {
    let rounding = if fill.abs() > 1e30 { 1e-6 * fill.abs() } else { 0.0 };
    (value - fill).abs() <= rounding
}

/// A variable with its values, decoded.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Its dimensions, slowest first.
    pub dimensions: Vec<Dimension>,
    /// Its attributes.
    pub attributes: Vec<Attribute>,
    /// Its values, last dimension fastest; NaN where missing.
    pub values: Vec<f64>,
}

/// Reads one variable of a NetCDF file, with missing values as NaN, and scale and offset
/// applied.
///
/// # Errors
/// The file is missing, not NetCDF or damaged, or does not hold the variable.
pub fn read_field(path: &Path, variable: &str) -> Result<Field, OceanError> {
    let file = NetcdfFile::open(path)?;
    let info = file.variable(variable).ok_or_else(|| OceanError::MissingVariable {
        wanted: variable.to_owned(),
        names: vec![variable.to_owned()],
        files: vec![path.to_owned()],
    })?;
    let values = read_decoded(&file, info, &info.everything())?;
    Ok(Field { dimensions: info.dimensions.clone(), attributes: info.attributes.clone(), values })
}

/// Reads and decodes a part of a variable.
pub(crate) fn read_decoded(
    source: &dyn DataSource,
    variable: &VariableInfo,
    selection: &[Range<usize>],
) -> Result<Vec<f64>, OceanError> {
    let mut values = source.read(&variable.name, selection)?;
    variable.decode(&mut values);
    Ok(values)
}
