//! The axes of a variable: which dimension is which, and its nodes in our conventions.

use super::source::{DataSource, Dimension, VariableInfo, read_decoded};
use crate::OceanError;
use std::fmt;

/// What a coordinate measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AxisRole {
    Time,
    Depth,
    Latitude,
    Longitude,
}

impl fmt::Display for AxisRole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Time => "time",
            Self::Depth => "depth",
            Self::Latitude => "latitude",
            Self::Longitude => "longitude",
        })
    }
}

/// An axis in our conventions: ascending, depths positive down, longitudes unwrapped.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    pub(crate) role: AxisRole,
    /// Position of its dimension in the variable; `None` for a scalar coordinate.
    pub(crate) dimension: Option<usize>,
    pub(crate) nodes: Vec<f64>,
    /// Whether the file has the nodes in the opposite order.
    pub(crate) reversed: bool,
}

impl Axis {
    /// Index in the file of a node.
    pub(crate) fn file_index(&self, node: usize) -> usize {
        if self.reversed { self.nodes.len() - 1 - node } else { node }
    }
}

/// What a coordinate variable measures: by standard name, units, then its name.
pub(crate) fn role_of(variable: &VariableInfo) -> Option<AxisRole> {
    match variable.text("standard_name") {
        Some("time") => return Some(AxisRole::Time),
        Some("depth" | "elevation" | "height" | "altitude") => return Some(AxisRole::Depth),
        Some("latitude") => return Some(AxisRole::Latitude),
        Some("longitude") => return Some(AxisRole::Longitude),
        _ => {}
    }
    let units = variable.text("units").unwrap_or("");
    if units.contains(" since ") {
        return Some(AxisRole::Time);
    }
    match units {
        "degrees_north" | "degree_north" | "degreeN" => return Some(AxisRole::Latitude),
        "degrees_east" | "degree_east" | "degreeE" => return Some(AxisRole::Longitude),
        _ => {}
    }
    let name = variable.name.to_lowercase();
    match name.as_str() {
        "time" | "time_counter" | "t" => Some(AxisRole::Time),
        "depth" | "elevation" | "lev" | "level" | "deptht" => Some(AxisRole::Depth),
        "y" => Some(AxisRole::Latitude),
        "x" => Some(AxisRole::Longitude),
        _ if name.contains("lat") => Some(AxisRole::Latitude),
        _ if name.contains("lon") => Some(AxisRole::Longitude),
        _ => None,
    }
}

/// The coordinate variable of a dimension: of its name, or else the only other variable
/// along it alone that is recognised.
fn coordinate_of<'a>(
    source: &'a dyn DataSource,
    dimension: &Dimension,
) -> Option<(&'a VariableInfo, AxisRole)> {
    let along = |variable: &&VariableInfo| variable.dimensions == [dimension.clone()];
    let same_name = source.variable(&dimension.name).filter(along);
    let mut candidates = same_name.into_iter().chain(source.variables().iter().filter(along));
    candidates.find_map(|variable| Some((variable, role_of(variable)?)))
}

/// The coordinate of a role that `variable` has, as its variable and the dimension's
/// position, or as a scalar beside it.
pub(crate) fn find_coordinate<'a>(
    source: &'a dyn DataSource,
    variable: &VariableInfo,
    role: AxisRole,
) -> Option<(&'a VariableInfo, Option<usize>)> {
    for (position, dimension) in variable.dimensions.iter().enumerate() {
        if let Some((coordinate, found)) = coordinate_of(source, dimension)
            && found == role
        {
            return Some((coordinate, Some(position)));
        }
    }
    let scalar = |candidate: &&VariableInfo| {
        let alone =
            candidate.dimensions.iter().all(|d| d.length == 1 && !variable.dimensions.contains(d));
        alone && candidate.dimensions.len() <= 1 && role_of(candidate) == Some(role)
    };
    source.variables().iter().find(scalar).map(|coordinate| (coordinate, None))
}

/// The axis of a role of a variable.
pub(crate) fn axis(
    source: &dyn DataSource,
    variable: &VariableInfo,
    role: AxisRole,
) -> Result<Axis, OceanError> {
    let Some((coordinate, dimension)) = find_coordinate(source, variable, role) else {
        return Err(OceanError::MissingCoordinate {
            path: source.path().to_owned(),
            variable: variable.name.clone(),
            coordinate: role.to_string(),
            dimensions: variable.dimensions.iter().map(|d| d.name.clone()).collect(),
        });
    };
    let mut nodes = read_decoded(source, coordinate, &coordinate.everything())?;
    match role {
        AxisRole::Longitude => unwrap_longitudes(&mut nodes),
        AxisRole::Depth if is_upward(coordinate, &nodes) => {
            for node in &mut nodes {
                *node = -*node;
            }
        }
        _ => {}
    }
    let reversed = nodes.len() > 1 && nodes[0] > nodes[1];
    if reversed {
        nodes.reverse();
    }
    let not_finite = nodes.iter().position(|node| !node.is_finite());
    let not_ascending = nodes.windows(2).position(|pair| pair[0] >= pair[1]).map(|i| i + 1);
    if let Some(index) = not_finite.or(not_ascending) {
        return Err(OceanError::AxisNotMonotonic {
            path: source.path().to_owned(),
            variable: coordinate.name.clone(),
            before: nodes[index.saturating_sub(1)],
            after: nodes[index],
        });
    }
    if nodes.is_empty() {
        return Err(OceanError::EmptyAxis {
            path: source.path().to_owned(),
            variable: coordinate.name.clone(),
        });
    }
    Ok(Axis { role, dimension, nodes, reversed })
}

/// Whether a vertical coordinate counts upwards.
fn is_upward(coordinate: &VariableInfo, nodes: &[f64]) -> bool {
    match coordinate.text("positive") {
        Some(direction) => direction.eq_ignore_ascii_case("up"),
        None => nodes.iter().all(|&node| node <= 0.0) && nodes.iter().any(|&node| node < 0.0),
    }
}

/// Removes jumps by 360° at the antimeridian.
fn unwrap_longitudes(nodes: &mut [f64]) {
    let mut turns = 0.0;
    for i in 1..nodes.len() {
        let step = nodes[i] + turns - nodes[i - 1];
        if step < -180.0 {
            turns += 360.0;
        } else if step > 180.0 {
            turns -= 360.0;
        }
        nodes[i] += turns;
    }
}

#[cfg(test)]
mod tests {
    use super::unwrap_longitudes;

    #[test]
    fn the_antimeridian_is_no_jump() {
        let mut nodes = [178.0, 179.0, -180.0, -179.0];
        unwrap_longitudes(&mut nodes);
        assert_eq!(nodes.map(|node| node as i32), [178, 179, 180, 181]);
        let mut westward = [-179.0, -180.0, 179.0];
        unwrap_longitudes(&mut westward);
        assert_eq!(westward.map(|node| node as i32), [-179, -180, -181]);
    }
}
