//! Files: the only place that knows what they call things.
//!
//! Reading goes through [`DataSource`], which a NetCDF file on disk ([`NetcdfFile`]) and
//! a data set in memory ([`Dataset`]) implement. [`read_forecast`] and
//! [`read_bathymetry`] understand the layouts of Copernicus Marine, GLORYS, HYCOM, GEBCO
//! and ETOPO; [`write_forecast`] and [`write_bathymetry`] write the first and the fourth.
//! [`inspect()`] says what a file holds, [`download_request`] how to get the files.
//!
//! Other crates write their own CF-NetCDF files as a [`Dataset`] and read them back with
//! [`read_field`].

mod attribute;
mod bathymetry;
mod coordinates;
mod dataset;
mod forecast;
mod inspect;
mod layout;
mod netcdf_file;
mod request;
mod selection;
mod source;
mod time;
mod whole_file;
mod write;

pub use attribute::{Attribute, AttributeValue};
pub use bathymetry::{bathymetry_from, read_bathymetry};
pub use dataset::{Dataset, Values};
pub use forecast::{ForecastRequest, forecast_from, read_forecast};
pub use inspect::{AxisInspection, Inspection, VariableInspection, inspect};
pub use netcdf_file::NetcdfFile;
pub use request::download_request;
pub use source::{DataSource, Dimension, Field, VariableInfo, read_field};
pub use whole_file::replace_file;
pub use write::{write_bathymetry, write_forecast};
