//! The nodes on which an ocean state is given.

use crate::Region;
use crate::axis::{locate, locate_longitude};

/// The nodes of an ocean state: all axes ascending and not empty.
#[derive(Debug, Clone, PartialEq)]
pub struct OceanGrid {
    /// Longitudes, degrees east, ascending; beyond 180 where the grid crosses the
    /// antimeridian.
    pub longitude_deg: Vec<f64>,
    /// Latitudes, degrees north, ascending.
    pub latitude_deg: Vec<f64>,
    /// Depths of the levels, metres, positive down, ascending.
    pub depth_m: Vec<f64>,
}

impl OceanGrid {
    /// Number of nodes, over [depth, latitude, longitude].
    pub fn node_count(&self) -> usize {
        self.depth_m.len() * self.layer_size()
    }

    /// Number of nodes of one level.
    pub fn layer_size(&self) -> usize {
        self.latitude_deg.len() * self.longitude_deg.len()
    }

    /// Index of a node in arrays of shape [depth, latitude, longitude].
    pub fn index(&self, level: usize, row: usize, column: usize) -> usize {
        (level * self.latitude_deg.len() + row) * self.longitude_deg.len() + column
    }

    /// Whether the whole region lies between the first and last nodes.
    pub fn covers(&self, region: Region) -> bool {
        let middle = region.centre_deg().0;
        [region.west_deg, middle, region.east_deg]
            .iter()
            .all(|&longitude| locate_longitude(&self.longitude_deg, longitude).is_some())
            && [region.south_deg, region.north_deg]
                .iter()
                .all(|&latitude| locate(&self.latitude_deg, latitude).is_some())
    }

    /// The rectangle between the first and last nodes.
    pub fn span(&self) -> Region {
        let ends = |axis: &[f64]| {
            (axis.first().copied().unwrap_or(f64::NAN), axis.last().copied().unwrap_or(f64::NAN))
        };
        let (west_deg, east_deg) = ends(&self.longitude_deg);
        let (south_deg, north_deg) = ends(&self.latitude_deg);
        Region { west_deg, east_deg, south_deg, north_deg }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coverage_ends_at_the_last_node() {
        let grid = OceanGrid {
            longitude_deg: vec![350.0, 355.0, 360.0, 365.0],
            latitude_deg: vec![10.0, 11.0],
            depth_m: vec![0.5],
        };
        let region =
            |west_deg, east_deg| Region { west_deg, east_deg, south_deg: 10.0, north_deg: 11.0 };
        assert!(grid.covers(region(-10.0, 5.0)));
        assert!(grid.covers(region(-1.0, 1.0)));
        assert!(!grid.covers(region(-1.0, 6.0)));
        assert!(!grid.covers(region(3.0, -3.0)));
    }
}
