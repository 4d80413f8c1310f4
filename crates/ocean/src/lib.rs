//! What ocean and bathymetry files contain: temperature, salinity and currents over
//! time, the depth of the sea, and the local east–north coordinates of a region.
//!
//! Conventions: longitudes and latitudes in degrees (east and north positive), depths
//! in metres, positive down, currents in m/s towards east and north, temperatures in
//! situ in °C (ITS-90), salinities on the practical scale, times in UTC.
//!
//! This crate knows files and the sea; it knows nothing of sound, vehicles or learning.
//! The names that files use (`thetao`, `water_u`, …) appear only in [`io`].

mod axis;
mod bathymetry;
mod error;
mod forecast;
mod grid;
pub mod io;
mod local_frame;
pub mod potential_temperature;
mod region;
mod state;
pub mod synthetic;

pub use bathymetry::Bathymetry;
pub use error::OceanError;
pub use forecast::Forecast;
pub use grid::OceanGrid;
pub use local_frame::LocalFrame;
pub use region::Region;
pub use state::{Column, OceanState, Quantity};
