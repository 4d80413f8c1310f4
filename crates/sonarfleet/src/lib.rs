//! Where a fleet of vehicles with passive sonar should listen, and how it gets
//! there through the currents, epoch after epoch.
//!
//! One-way data flow: ocean → transmission loss → detection and links →
//! placement → travel times → assignment → routes → record. `placement` uses
//! `sonar`; `navigation` and `assignment` know neither; only `mission` sees all.
//!
//! Conventions, everywhere: lengths in metres, depth positive down, x east and
//! y north of the region's south-west corner, headings clockwise from north,
//! levels in dB re 1 µPa (sources at 1 m).

pub mod assignment;
pub mod curriculum;
pub mod fingerprint;
pub mod grid;
pub mod mission;
pub mod navigation;
pub mod npz;
pub mod placement;
pub mod random;
pub mod record;
pub mod scenario;
pub mod sonar;

pub use sonarfleet_ocean::io::replace_file;

/// Version of the names and meanings in the files we write (`sonarfleet_format`).
pub const FILE_FORMAT: f64 = 1.0;
