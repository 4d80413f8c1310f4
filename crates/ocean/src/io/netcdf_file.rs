//! NetCDF files on disk: classic (CDF-1, 2, 5) and NetCDF-4.

use super::attribute::{Attribute, AttributeValue};
use super::source::{DataSource, Dimension, VariableInfo};
use crate::OceanError;
use netcdf_reader::{NcAttrValue, NcAttribute, NcFile, NcFormat, NcOpenOptions, NcSliceInfo};
use netcdf_reader::{NcSliceInfoElem, NcType};
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Largest part of a variable read at once, in bytes, so that a damaged header cannot
/// ask for all memory; all levels of a global 1/12° field at one time fit.
const LARGEST_READ: usize = 1 << 31;

/// An open NetCDF file.
pub struct NetcdfFile {
    path: PathBuf,
    file: NcFile,
    attributes: Vec<Attribute>,
    variables: Vec<VariableInfo>,
}

impl std::fmt::Debug for NetcdfFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("NetcdfFile").field("path", &self.path).finish_non_exhaustive()
    }
}

impl NetcdfFile {
    /// Opens a file and reads its header.
    ///
    /// # Errors
    /// [`OceanError::Unreadable`], [`OceanError::NotNetcdf`] or [`OceanError::Damaged`].
    pub fn open(path: &Path) -> Result<Self, OceanError> {
        check_signature(path)?;
        let options = NcOpenOptions { max_read_bytes: LARGEST_READ, ..NcOpenOptions::default() };
        let damaged = |source| OceanError::Damaged {
            path: path.to_owned(),
            part: "header".to_owned(),
            source: Box::new(source),
        };
        let file = NcFile::open_with_options(path, options).map_err(damaged)?;
        let attributes = file.global_attributes().map_err(damaged)?;
        let attributes = attributes.iter().filter_map(attribute).collect();
        let mut variables = Vec::new();
        for variable in file.variables().map_err(damaged)? {
            let dimensions = variable.dimensions().iter().map(|dimension| Dimension {
                name: dimension.name.clone(),
                length: usize::try_from(dimension.size).unwrap_or(usize::MAX),
            });
            variables.push(VariableInfo {
                name: variable.name().to_owned(),
                storage: storage(variable.dtype()).to_owned(),
                dimensions: dimensions.collect(),
                attributes: variable.attributes().iter().filter_map(attribute).collect(),
            });
        }
        Ok(Self { path: path.to_owned(), file, attributes, variables })
    }
}

impl DataSource for NetcdfFile {
    fn path(&self) -> &Path {
        &self.path
    }

    fn format(&self) -> String {
        match self.file.format() {
            NcFormat::Classic => "NetCDF-3 classic",
            NcFormat::Offset64 => "NetCDF-3 64-bit offset",
            NcFormat::Cdf5 => "NetCDF-3 64-bit data (CDF-5)",
            NcFormat::Nc4 => "NetCDF-4",
            NcFormat::Nc4Classic => "NetCDF-4 classic model",
        }
        .to_owned()
    }

    fn attributes(&self) -> &[Attribute] {
        &self.attributes
    }

    fn variables(&self) -> &[VariableInfo] {
        &self.variables
    }

    fn read(&self, variable: &str, selection: &[Range<usize>]) -> Result<Vec<f64>, OceanError> {
        let values = if selection.is_empty() {
            self.file.read_variable_as_f64(variable)
        } else {
            let selections = selection
                .iter()
                .map(|range| NcSliceInfoElem::Slice {
                    start: range.start as u64,
                    end: range.end as u64,
                    step: 1,
                })
                .collect();
            self.file.read_variable_slice_as_f64(variable, &NcSliceInfo { selections })
        };
        let damaged = |source| OceanError::Damaged {
            path: self.path.clone(),
            part: format!("variable {variable}"),
            source: Box::new(source),
        };
        let values: Vec<f64> = values.map_err(damaged)?.iter().copied().collect();
        let expected = selection.iter().map(Range::len).product();
        if values.len() != expected {
            let found = format!("{} values where {expected} were expected", values.len());
            return Err(damaged(netcdf_reader::Error::InvalidData(found)));
        }
        Ok(values)
    }
}

/// Tells files that are not NetCDF from damaged ones, by their first bytes.
fn check_signature(path: &Path) -> Result<(), OceanError> {
    let unreadable = |source| OceanError::Unreadable { path: path.to_owned(), source };
    let mut file = std::fs::File::open(path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.is_dir() {
        return Err(unreadable(std::io::ErrorKind::IsADirectory.into()));
    }
    let mut start = Vec::new();
    file.by_ref().take(8).read_to_end(&mut start).map_err(unreadable)?;
    let classic = start.starts_with(b"CDF");
    let hdf5 = start.starts_with(b"\x89HDF\r\n\x1a\n");
    // HDF5 allows a user block of 512 · 2ⁿ bytes before its signature; the reader looks there.
    let user_block = file.metadata().map_err(unreadable)?.len() > 512;
    if classic || hdf5 {
        return Ok(());
    }
    if user_block && NcFile::open(path).is_ok() {
        return Ok(());
    }
    let found = if start.is_empty() {
        "an empty file".to_owned()
    } else {
        format!("a file that starts with \"{}\"", start.escape_ascii())
    };
    Err(OceanError::NotNetcdf { path: path.to_owned(), found })
}

fn storage(dtype: &NcType) -> &'static str {
    match dtype {
        NcType::Byte => "i8",
        NcType::Char => "char",
        NcType::Short => "i16",
        NcType::Int => "i32",
        NcType::Float => "f32",
        NcType::Double => "f64",
        NcType::UByte => "u8",
        NcType::UShort => "u16",
        NcType::UInt => "u32",
        NcType::Int64 => "i64",
        NcType::UInt64 => "u64",
        NcType::String => "string",
        _ => "user-defined",
    }
}

fn attribute(attribute: &NcAttribute) -> Option<Attribute> {
    let value = match &attribute.value {
        NcAttrValue::Chars(text) => AttributeValue::Text(text.clone()),
        NcAttrValue::Strings(texts) => AttributeValue::Text(texts.join(", ")),
        NcAttrValue::Floats(values) => AttributeValue::F32(values.clone()),
        NcAttrValue::Shorts(values) => AttributeValue::I16(values.clone()),
        NcAttrValue::Ints(values) => AttributeValue::I32(values.clone()),
        other => AttributeValue::F64(other.as_f64_vec()?),
    };
    Some(Attribute { name: attribute.name.clone(), value })
}
