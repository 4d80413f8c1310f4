//! What ocean and bathymetry files contain: temperature, salinity and currents over
//! time, the depth of the sea, and the local east–north coordinates of a region.
//!
//! Conventions: longitudes and latitudes in degrees (east and north positive), depths
//! in metres, positive down, currents in m/s towards east and north, temperatures in
//! situ in °C (ITS-90), salinities on the practical scale, times in UTC.
//!
//! This crate knows files and the sea; it knows nothing of sound, vehicles or learning.
//! The names that files use (`thetao`, `water_u`, …) appear only in [`io`].
//!
//! ```
//! use jiff::SignedDuration;
//! use sonarfleet_ocean::LocalFrame;
//! use sonarfleet_ocean::synthetic::{REGION, START, SyntheticOcean};
//!
//! let ocean = SyntheticOcean { states: 2, ..SyntheticOcean::default() };
//! let (forecast, bathymetry) = (ocean.forecast(), ocean.bathymetry());
//! let state = forecast.at(START + SignedDuration::from_hours(3))?;
//! let frame = LocalFrame::new(REGION);
//! let (longitude_deg, latitude_deg) = frame.to_geographic(10_000.0, 5_000.0);
//! let column = state.column(longitude_deg, latitude_deg).expect("open sea");
//! assert!((column.temperature_c[0] - 28.7).abs() < 0.2);
//! let [east_m_s, north_m_s] = state.current(longitude_deg, latitude_deg, 200.0).expect("open sea");
//! assert!(east_m_s.hypot(north_m_s) < 0.35);
//! assert!(bathymetry.depth_m(longitude_deg, latitude_deg).expect("inside the data") > 800.0);
//! # Ok::<(), sonarfleet_ocean::OceanError>(())
//! ```

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
