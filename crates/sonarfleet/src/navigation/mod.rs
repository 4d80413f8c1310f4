//! Travel through moving water: currents, vehicles, planners, travel times, routes.

mod crab;
mod current_field;
mod error;
mod export;
mod forecast_currents;
mod instance;
mod matrix_file;
mod planner;
mod route;
mod sail;
mod time_optimal;
mod travel_times;
mod vehicle;

pub use crab::{Crab, crab_heading_rad};
pub use current_field::CurrentField;
pub use error::NavigationError;
pub use export::{NamedRoute, RouteFormat, write_routes};
pub use instance::{NavigationInstance, Trip};
pub use matrix_file::write_matrix;
pub use planner::{Observation, Pilot, Plan, Planner, Voyage, rollout_travel_times};
pub use route::{Obstacle, Route, RouteEnd, RoutePoint, Unreachable};
pub use sail::{LONGEST_STEP_H, sail};
pub use time_optimal::TimeOptimal;
pub use travel_times::{TravelTime, TravelTimes};
pub use vehicle::{TransitDomain, Vehicle, Waters};

/// Longest travel that planners consider unless told otherwise, hours.
pub const DEFAULT_HORIZON_H: f64 = 120.0;
