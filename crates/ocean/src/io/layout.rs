//! What the dialects call things.

use super::source::{DataSource, VariableInfo};
use crate::Quantity;

/// Names of a quantity's variable, most trusted first, then CF standard names.
struct Names {
    variables: &'static [&'static str],
    standard_names: &'static [&'static str],
}

const POTENTIAL: &str = "sea_water_potential_temperature";

fn names(quantity: Quantity) -> Names {
    match quantity {
        Quantity::Temperature => Names {
            variables: &["thetao", "water_temp", "votemper"],
            standard_names: &[POTENTIAL, "sea_water_temperature"],
        },
        Quantity::Salinity => Names {
            variables: &["so", "salinity", "vosaline"],
            standard_names: &["sea_water_salinity", "sea_water_practical_salinity"],
        },
        Quantity::CurrentEast => Names {
            variables: &["uo", "water_u", "vozocrtx"],
            standard_names: &["eastward_sea_water_velocity"],
        },
        Quantity::CurrentNorth => Names {
            variables: &["vo", "water_v", "vomecrty"],
            standard_names: &["northward_sea_water_velocity"],
        },
    }
}

/// Names of bathymetry variables: GEBCO, ETOPO 2022/ETOPO2/SRTM15, ETOPO5, Copernicus
/// Marine static files, GDAL's name.
const BATHYMETRY_NAMES: [&str; 6] = ["elevation", "z", "topo", "deptho", "bathymetry", "Band1"];
const DEPTH_STANDARD_NAMES: [&str; 4] = [
    "sea_floor_depth_below_geoid",
    "sea_floor_depth_below_sea_level",
    "sea_floor_depth_below_mean_sea_level",
    "sea_floor_depth",
];
const HEIGHT_STANDARD_NAMES: [&str; 3] =
    ["height_above_reference_ellipsoid", "height_above_mean_sea_level", "surface_altitude"];

/// The names a quantity is looked for under.
pub(crate) fn searched_names(quantity: Quantity) -> Vec<String> {
    let names = names(quantity);
    names.variables.iter().chain(names.standard_names).map(|&name| name.to_owned()).collect()
}

/// The variable that holds a quantity.
pub(crate) fn find_quantity(source: &dyn DataSource, quantity: Quantity) -> Option<&VariableInfo> {
    let Names { variables, standard_names } = names(quantity);
    let by_name = variables.iter().find_map(|name| source.variable(name));
    by_name.or_else(|| {
        source.variables().iter().find(|variable| {
            variable.text("standard_name").is_some_and(|name| standard_names.contains(&name))
        })
    })
}

/// How stored numbers become °C, practical salinity or m/s: factor and offset.
pub(crate) fn to_our_units(quantity: Quantity, units: &str) -> (f64, f64) {
    match (quantity, units) {
        (Quantity::Temperature, "K" | "kelvin" | "Kelvin") => (1.0, -273.15),
        (Quantity::CurrentEast | Quantity::CurrentNorth, "cm s-1" | "cm/s" | "cm s**-1") => {
            (0.01, 0.0)
        }
        _ => (1.0, 0.0),
    }
}

/// Whether a temperature is potential temperature: by standard name, else by name.
pub(crate) fn is_potential(variable: &VariableInfo) -> bool {
    match variable.text("standard_name") {
        Some(name) => name == POTENTIAL,
        None => ["thetao", "votemper"].contains(&variable.name.as_str()),
    }
}

/// The names bathymetry is looked for under.
pub(crate) fn searched_bathymetry_names() -> Vec<String> {
    let standard = DEPTH_STANDARD_NAMES.iter().chain(&HEIGHT_STANDARD_NAMES);
    BATHYMETRY_NAMES.iter().chain(standard).map(|&name| name.to_owned()).collect()
}

/// The variable that holds the depth of the sea or the height of the ground.
pub(crate) fn find_bathymetry(source: &dyn DataSource) -> Option<&VariableInfo> {
    let is_map = |variable: &&VariableInfo| variable.dimensions.len() >= 2;
    BATHYMETRY_NAMES.iter().filter_map(|name| source.variable(name)).find(is_map).or_else(|| {
        source.variables().iter().filter(is_map).find(|variable| {
            variable.text("standard_name").is_some_and(|name| {
                DEPTH_STANDARD_NAMES.contains(&name) || HEIGHT_STANDARD_NAMES.contains(&name)
            })
        })
    })
}

/// Whether a bathymetry variable is a depth (positive down), not a height.
pub(crate) fn is_depth(variable: &VariableInfo) -> bool {
    variable.text("positive") == Some("down")
        || variable.text("standard_name").is_some_and(|name| DEPTH_STANDARD_NAMES.contains(&name))
        || variable.name == "deptho"
}

/// What an inspected variable is, in words.
pub(crate) fn role(source: &dyn DataSource, variable: &VariableInfo) -> Option<String> {
    for quantity in Quantity::ALL {
        if find_quantity(source, quantity).is_some_and(|found| found.name == variable.name) {
            let potential = quantity == Quantity::Temperature && is_potential(variable);
            let kind = if potential { "potential " } else { "" };
            return Some(format!("{kind}{quantity}"));
        }
    }
    if find_bathymetry(source).is_some_and(|found| found.name == variable.name) {
        let kind = if is_depth(variable) { "depth, positive down" } else { "height, positive up" };
        return Some(format!("bathymetry ({kind})"));
    }
    None
}
