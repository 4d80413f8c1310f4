//! Travel-time matrices as files.

use super::{NavigationError, TravelTimes};
use crate::npz::{self, NamedArray};
use sonarfleet_ocean::io::{Attribute, Dataset, Values};
use std::path::Path;

/// Writes `travel_time_h` [vehicle, post], hours, infinite where unreachable, as
/// `.npz` or `.nc` by the file's extension. An `.npz` also holds
/// `closest_approach_m`, what remains to an unreachable post, and `cost`, the costs in
/// hours that an assignment uses: finite everywhere.
///
/// # Errors
/// If the extension is neither, or the file cannot be written.
pub fn write_matrix(path: &Path, travel: &TravelTimes) -> Result<(), NavigationError> {
    let (hours, costs_h) = (travel.hours(), travel.assignment_costs_h());
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("npz") => {
            let shape = &[travel.starts(), travel.goals()];
            let array = |key, values| NamedArray { key, shape, values: npz::Values::F64(values) };
            let closest_m = travel.closest_approaches_m();
            let arrays = [
                array("travel_time_h", &hours),
                array("closest_approach_m", &closest_m),
                array("cost", &costs_h),
            ];
            Ok(npz::write(path, &arrays)?)
        }
        Some("nc") => {
            let mut file = Dataset::new("Travel times of vehicles to posts");
            file.add_attribute(Attribute::number("sonarfleet_format", crate::FILE_FORMAT));
            file.add_dimension("vehicle", travel.starts());
            file.add_dimension("post", travel.goals());
            let attributes = [
                Attribute::text("units", "h"),
                Attribute::text("long_name", "least travel time; infinite where unreachable"),
            ];
            let shape = &["vehicle", "post"];
            file.add_variable("travel_time_h", shape, Values::F64(hours), &attributes);
            Ok(file.write(path)?)
        }
        _ => Err(NavigationError::UnknownMatrixFormat { path: path.to_owned() }),
    }
}
