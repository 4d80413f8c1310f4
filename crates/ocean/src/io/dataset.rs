//! A data set in memory, and how it becomes a CF-NetCDF file.

use super::attribute::{Attribute, AttributeValue};
use super::source::{DataSource, Dimension, VariableInfo};
use super::whole_file::replace_file;
use crate::OceanError;
use netcdf_writer::{DimensionId, NcFileBuilder, NcFillValueType, NcWriteFormat, NcWriteOptions};
use std::ops::Range;
use std::path::Path;

/// Variables below this many bytes are stored plain: compressing them gains nothing.
const SMALLEST_COMPRESSED: usize = 4096;
const DEFLATE_LEVEL: u8 = 4;

/// A data set in memory: build it, then [`Dataset::write`] it.
///
/// ```
/// use sonarfleet_ocean::io::{Attribute, Dataset, Values, read_field};
///
/// let mut data = Dataset::new("transmission loss of a small example");
/// data.add_dimension("source", 2);
/// data.add_dimension("target", 3);
/// data.add_variable(
///     "transmission_loss",
///     &["source", "target"],
///     Values::F32(vec![60.0, 70.0, 80.0, 61.0, 71.0, f32::NAN]),
///     &[Attribute::text("units", "dB")],
/// );
/// let directory = tempfile::tempdir()?;
/// let path = directory.path().join("tl.nc");
/// data.write(&path)?;
/// let loss = read_field(&path, "transmission_loss")?;
/// assert_eq!(loss.dimensions[1].length, 3);
/// assert_eq!(loss.values[4], 71.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Dataset {
    dimensions: Vec<Dimension>,
    attributes: Vec<Attribute>,
    variables: Vec<VariableInfo>,
    values: Vec<Values>,
}

/// The values of a variable, as they are stored.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// 32-bit floats.
    F32(Vec<f32>),
    /// 64-bit floats.
    F64(Vec<f64>),
    /// 16-bit integers.
    I16(Vec<i16>),
    /// 32-bit integers.
    I32(Vec<i32>),
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::F32(values) => values.len(),
            Self::F64(values) => values.len(),
            Self::I16(values) => values.len(),
            Self::I32(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn get(&self, index: usize) -> f64 {
        match self {
            Self::F32(values) => f64::from(values[index]),
            Self::F64(values) => values[index],
            Self::I16(values) => f64::from(values[index]),
            Self::I32(values) => f64::from(values[index]),
        }
    }

    fn storage(&self) -> &'static str {
        match self {
            Self::F32(_) => "f32",
            Self::F64(_) => "f64",
            Self::I16(_) => "i16",
            Self::I32(_) => "i32",
        }
    }
}

impl Dataset {
    /// An empty data set that follows the CF conventions, version 1.8.
    pub fn new(title: impl Into<String>) -> Self {
        let attributes =
            vec![Attribute::text("Conventions", "CF-1.8"), Attribute::text("title", title)];
        Self { dimensions: Vec::new(), attributes, variables: Vec::new(), values: Vec::new() }
    }

    /// Adds a global attribute.
    pub fn add_attribute(&mut self, attribute: Attribute) {
        self.attributes.push(attribute);
    }

    /// Adds a dimension.
    pub fn add_dimension(&mut self, name: &str, length: usize) {
        self.dimensions.push(Dimension { name: name.to_owned(), length });
    }

    /// Adds a dimension with its coordinate variable of the same name.
    pub fn add_coordinate(&mut self, name: &str, values: Values, attributes: &[Attribute]) {
        self.add_dimension(name, values.len());
        self.add_variable(name, &[name], values, attributes);
    }

    /// Adds a variable, last dimension fastest.
    ///
    /// # Panics
    /// If a dimension has not been added, or the number of values is not the product of
    /// the dimensions' lengths.
    pub fn add_variable(
        &mut self,
        name: &str,
        dimensions: &[&str],
        values: Values,
        attributes: &[Attribute],
    ) {
        let find = |name: &&str| {
            let found = self.dimensions.iter().find(|dimension| dimension.name == **name);
            found.unwrap_or_else(|| panic!("no dimension {name} was added")).clone()
        };
        let found: Vec<Dimension> = dimensions.iter().map(find).collect();
        let expected: usize = found.iter().map(|dimension| dimension.length).product();
        assert_eq!(values.len(), expected, "values of {name}, {dimensions:?}");
        self.variables.push(VariableInfo {
            name: name.to_owned(),
            storage: values.storage().to_owned(),
            dimensions: found,
            attributes: attributes.to_vec(),
        });
        self.values.push(values);
    }

    /// Writes a NetCDF-4 file (deflate and shuffle where it pays), under a temporary name
    /// in the same directory that is then renamed: readers see the old file or the whole
    /// new one.
    ///
    /// # Errors
    /// [`OceanError::Unwritable`] or [`OceanError::Unencodable`].
    pub fn write(&self, path: &Path) -> Result<(), OceanError> {
        let unencodable =
            |source| OceanError::Unencodable { path: path.to_owned(), source: Box::new(source) };
        let builder = self.builder().map_err(unencodable)?;
        let options = NcWriteOptions { format: NcWriteFormat::Nc4 };
        let (_, bytes) = builder.to_vec(options).map_err(unencodable)?;
        replace_file(path, &bytes)
            .map_err(|source| OceanError::Unwritable { path: path.to_owned(), source })
    }

    fn builder(&self) -> netcdf_writer::Result<NcFileBuilder> {
        let mut builder = NcFileBuilder::new();
        let mut ids = Vec::new();
        for dimension in &self.dimensions {
            ids.push(builder.add_dimension(&dimension.name, dimension.length as u64)?);
        }
        for attribute in &self.attributes {
            builder.add_attribute(&attribute.name, encoded(&attribute.value))?;
        }
        for (info, values) in self.variables.iter().zip(&self.values) {
            let position =
                |of: &Dimension| self.dimensions.iter().position(|dimension| dimension == of);
            let dimensions: Vec<_> =
                info.dimensions.iter().filter_map(position).map(|i| ids[i]).collect();
            match values {
                Values::F32(values) => add(&mut builder, info, &dimensions, values)?,
                Values::F64(values) => add(&mut builder, info, &dimensions, values)?,
                Values::I16(values) => add(&mut builder, info, &dimensions, values)?,
                Values::I32(values) => add(&mut builder, info, &dimensions, values)?,
            }
        }
        Ok(builder)
    }
}

/// Adds a variable with its attributes, fill value, compression and values.
fn add<T: StoredNumber>(
    builder: &mut NcFileBuilder,
    info: &VariableInfo,
    dimensions: &[DimensionId],
    values: &[T],
) -> netcdf_writer::Result<()> {
    let id = builder.add_variable::<T>(&info.name, dimensions)?;
    for attribute in &info.attributes {
        match T::from_attribute(&attribute.value) {
            Some(fill) if attribute.name == "_FillValue" => {
                builder.set_variable_fill_value(id, fill)?;
            }
            _ => builder.add_variable_attribute(id, &attribute.name, encoded(&attribute.value))?,
        }
    }
    if size_of_val(values) >= SMALLEST_COMPRESSED && dimensions.len() > 1 {
        let mut chunk: Vec<u64> = info.shape().iter().map(|&length| length as u64).collect();
        if chunk.len() > 2 {
            chunk[0] = 1;
        }
        builder.set_variable_chunking(id, chunk)?;
        builder.set_variable_deflate(id, Some(DEFLATE_LEVEL), true)?;
    }
    builder.write_variable(id, values)
}

/// Numbers that can be values of a variable, and their fill value.
trait StoredNumber: NcFillValueType {
    fn from_attribute(value: &AttributeValue) -> Option<Self>;
}

macro_rules! stored_number {
    ($number:ty, $variant:ident) => {
        impl StoredNumber for $number {
            fn from_attribute(value: &AttributeValue) -> Option<Self> {
                match value {
                    AttributeValue::$variant(values) => values.first().copied(),
                    _ => None,
                }
            }
        }
    };
}

stored_number!(f32, F32);
stored_number!(f64, F64);
stored_number!(i16, I16);
stored_number!(i32, I32);

impl DataSource for Dataset {
    fn path(&self) -> &Path {
        Path::new("data set in memory")
    }

    fn format(&self) -> String {
        "in memory".to_owned()
    }

    fn attributes(&self) -> &[Attribute] {
        &self.attributes
    }

    fn variables(&self) -> &[VariableInfo] {
        &self.variables
    }

    fn read(&self, variable: &str, selection: &[Range<usize>]) -> Result<Vec<f64>, OceanError> {
        let found = self.variables.iter().zip(&self.values).find(|(info, _)| info.name == variable);
        let Some((info, values)) = found else {
            return Err(OceanError::MissingVariable {
                wanted: variable.to_owned(),
                names: vec![variable.to_owned()],
                files: vec![self.path().to_owned()],
            });
        };
        let mut indices = vec![0];
        for (range, dimension) in selection.iter().zip(&info.dimensions) {
            indices = indices
                .iter()
                .flat_map(|&index| range.clone().map(move |i| index * dimension.length + i))
                .collect();
        }
        Ok(indices.into_iter().map(|index| values.get(index)).collect())
    }
}

fn encoded(value: &AttributeValue) -> netcdf_reader::NcAttrValue {
    use netcdf_reader::NcAttrValue;
    match value {
        AttributeValue::Text(text) => NcAttrValue::Chars(text.clone()),
        AttributeValue::F32(values) => NcAttrValue::Floats(values.clone()),
        AttributeValue::F64(values) => NcAttrValue::Doubles(values.clone()),
        AttributeValue::I16(values) => NcAttrValue::Shorts(values.clone()),
        AttributeValue::I32(values) => NcAttrValue::Ints(values.clone()),
    }
}
