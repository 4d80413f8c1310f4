//! The depth of the sea.

use crate::Region;
use crate::axis::{locate, locate_longitude};

/// The depth of the sea on a grid of longitudes and latitudes.
#[derive(Debug, Clone, PartialEq)]
pub struct Bathymetry {
    /// Longitudes, degrees east, ascending; beyond 180 where the grid crosses the
    /// antimeridian.
    pub longitude_deg: Vec<f64>,
    /// Latitudes, degrees north, ascending.
    pub latitude_deg: Vec<f64>,
    /// Depths, metres, positive down, negative on land, [latitude, longitude]; NaN
    /// where the source has no value.
    pub values_m: Vec<f32>,
}

impl Bathymetry {
    /// Depth at a point, metres, positive down, zero or negative on land: bilinear over
    /// those of the four surrounding nodes that have a value.
    ///
    /// `None` outside the grid, and where no surrounding node has a value.
    pub fn depth_m(&self, longitude_deg: f64, latitude_deg: f64) -> Option<f64> {
        let columns = locate_longitude(&self.longitude_deg, longitude_deg)?;
        let rows = locate(&self.latitude_deg, latitude_deg)?;
        let (mut sum, mut weights) = (0.0, 0.0);
        for (row, row_weight) in rows.nodes() {
            for (column, column_weight) in columns.nodes() {
                let value = f64::from(self.values_m[row * self.longitude_deg.len() + column]);
                if !value.is_nan() {
                    sum += row_weight * column_weight * value;
                    weights += row_weight * column_weight;
                }
            }
        }
        (weights > 0.0).then(|| sum / weights)
    }

    /// The rectangle between the first and last nodes.
    pub fn span(&self) -> Region {
        let first = |axis: &[f64]| axis.first().copied().unwrap_or(f64::NAN);
        let last = |axis: &[f64]| axis.last().copied().unwrap_or(f64::NAN);
        Region {
            west_deg: first(&self.longitude_deg),
            east_deg: last(&self.longitude_deg),
            south_deg: first(&self.latitude_deg),
            north_deg: last(&self.latitude_deg),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Bathymetry;

    #[test]
    fn depths_are_bilinear_and_end_at_the_edges() {
        let sea = Bathymetry {
            longitude_deg: vec![0.0, 1.0],
            latitude_deg: vec![0.0, 2.0],
            values_m: vec![100.0, 200.0, 300.0, -40.0],
        };
        let at = |longitude, latitude| sea.depth_m(longitude, latitude);
        assert!((at(0.5, 0.0).unwrap() - 150.0).abs() < 1e-9);
        assert!((at(0.0, 0.5).unwrap() - 150.0).abs() < 1e-9);
        assert!((at(1.0, 2.0).unwrap() + 40.0).abs() < 1e-9);
        assert!((at(360.5, 1.0).unwrap() - 140.0).abs() < 1e-9);
        assert_eq!(at(1.5, 0.0), None);
        assert_eq!(at(0.5, 2.5), None);
    }

    #[test]
    fn missing_nodes_do_not_poison() {
        let sea = Bathymetry {
            longitude_deg: vec![0.0, 1.0],
            latitude_deg: vec![0.0, 1.0],
            values_m: vec![100.0, f32::NAN, 100.0, f32::NAN],
        };
        assert!((sea.depth_m(0.5, 0.5).unwrap() - 100.0).abs() < 1e-9);
        assert_eq!(sea.depth_m(1.0, 0.5), None);
    }
}
