//! Which nodes of a file are read.

use super::coordinates::Axis;
use super::source::{DataSource, VariableInfo};
use crate::axis::TOLERANCE;
use crate::{OceanError, OceanGrid, Region};
use std::ops::Range;

/// Nodes kept beyond the region on each side, where the file has them.
const NODES_AROUND: usize = 4;

/// The nodes of an axis that are read: indices of its nodes, and their coordinates,
/// ascending. Longitudes that wrap round a global axis are not contiguous.
pub(crate) struct Selected {
    pub(crate) axis: Axis,
    pub(crate) nodes: Vec<usize>,
    pub(crate) coordinates: Vec<f64>,
}

impl Selected {
    pub(crate) fn all(axis: Axis) -> Self {
        let nodes = (0..axis.nodes.len()).collect();
        Self { nodes, coordinates: axis.nodes.clone(), axis }
    }

    /// The smallest range in the file that holds all selected nodes.
    pub(crate) fn file_range(&self) -> Range<usize> {
        let indices = || self.nodes.iter().map(|&node| self.axis.file_index(node));
        indices().min().unwrap_or(0)..indices().max().map_or(0, |last| last + 1)
    }

    /// Where each node's values lie in an array of the shape of `selection`.
    pub(crate) fn offsets(&self, selection: &[Range<usize>]) -> Vec<usize> {
        let Some(position) = self.axis.dimension else { return vec![0; self.nodes.len()] };
        let stride: usize = selection[position + 1..].iter().map(Range::len).product();
        let start = selection[position].start;
        self.nodes.iter().map(|&node| (self.axis.file_index(node) - start) * stride).collect()
    }
}

/// The nodes around a region, and [`NODES_AROUND`] more where there are.
pub(crate) fn select_region(
    source: &dyn DataSource,
    latitude: Axis,
    longitude: Axis,
    region: Option<Region>,
) -> Result<(Selected, Selected), OceanError> {
    let Some(region) = region else {
        return Ok((Selected::all(latitude), Selected::all(longitude)));
    };
    let grid = OceanGrid {
        longitude_deg: longitude.nodes.clone(),
        latitude_deg: latitude.nodes.clone(),
        depth_m: Vec::new(),
    };
    if !grid.covers(region) {
        return Err(OceanError::RegionOutsideData {
            path: source.path().to_owned(),
            asked: region,
            span: grid.span(),
        });
    }
    let rows = around(&latitude.nodes, region.south_deg, region.north_deg);
    let rows = Selected {
        coordinates: latitude.nodes[rows.clone()].to_vec(),
        nodes: rows.collect(),
        axis: latitude,
    };
    let count = longitude.nodes.len();
    let (first, last) = (longitude.nodes[0], longitude.nodes[count - 1]);
    let west = first - TOLERANCE + (region.west_deg - first + TOLERANCE).rem_euclid(360.0);
    let is_global = first + 360.0 - last < 1.5 * (last - first) / (count.max(2) - 1) as f64;
    // A global axis laid out three times has any region in one piece, wherever it wraps.
    let turns: &[f64] = if is_global { &[-360.0, 0.0, 360.0] } else { &[0.0] };
    let laid_out: Vec<f64> =
        turns.iter().flat_map(|turn| longitude.nodes.iter().map(move |node| node + turn)).collect();
    let columns = around(&laid_out, west, west + region.width_deg());
    let columns = columns.start..columns.end.min(columns.start + count);
    let columns = Selected {
        coordinates: laid_out[columns.clone()].to_vec(),
        nodes: columns.map(|column| column % count).collect(),
        axis: longitude,
    };
    Ok((rows, columns))
}

/// Indices of the nodes of an ascending axis from `from` to `to`, with those around.
fn around(nodes: &[f64], from: f64, to: f64) -> Range<usize> {
    let first = nodes.partition_point(|&node| node <= from);
    let last = nodes.partition_point(|&node| node < to);
    first.saturating_sub(1 + NODES_AROUND)..(last + 1 + NODES_AROUND).min(nodes.len())
}

/// Refuses a variable with a dimension, of more than one index, at none of the known
/// positions.
pub(crate) fn refuse_unknown_dimensions(
    source: &dyn DataSource,
    variable: &VariableInfo,
    known: &[Option<usize>],
) -> Result<(), OceanError> {
    for (position, dimension) in variable.dimensions.iter().enumerate() {
        if dimension.length != 1 && !known.contains(&Some(position)) {
            return Err(OceanError::UnknownDimension {
                path: source.path().to_owned(),
                variable: variable.name.clone(),
                dimension: dimension.name.clone(),
                length: dimension.length,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::Dataset;
    use super::super::coordinates::AxisRole;
    use super::*;

    fn selected(longitudes: Vec<f64>, region: (f64, f64)) -> Result<Vec<f64>, OceanError> {
        let axis = |role, nodes| Axis { role, dimension: Some(0), nodes, reversed: false };
        let region =
            Region { west_deg: region.0, east_deg: region.1, south_deg: 0.0, north_deg: 1.0 };
        let (rows, columns) = select_region(
            &Dataset::new("test"),
            axis(AxisRole::Latitude, (-20..20).map(f64::from).collect()),
            axis(AxisRole::Longitude, longitudes),
            Some(region),
        )?;
        assert_eq!(rows.coordinates, (-4..=5).map(f64::from).collect::<Vec<_>>());
        let original = columns.nodes.iter().zip(&columns.coordinates);
        assert!(original.clone().count() > 0);
        Ok(columns.coordinates)
    }

    #[test]
    fn four_nodes_are_kept_around_the_region() {
        let degrees = |from: i32, to: i32| (from..to).map(f64::from).collect::<Vec<_>>();
        assert_eq!(selected(degrees(100, 140), (118.1, 118.4)).unwrap(), degrees(114, 124));
        assert_eq!(selected(degrees(116, 121), (118.1, 118.4)).unwrap(), degrees(116, 121));
        // 0–360 and a region in the west, and one across Greenwich.
        assert_eq!(selected(degrees(0, 360), (-17.5, -16.5)).unwrap(), degrees(338, 349));
        assert_eq!(selected(degrees(0, 360), (-1.5, 1.5)).unwrap(), degrees(354, 367));
        assert!(matches!(
            selected(degrees(100, 118), (118.1, 118.4)),
            Err(OceanError::RegionOutsideData { .. })
        ));
    }
}
