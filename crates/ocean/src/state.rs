//! The ocean at one time: temperature, salinity and currents on a grid.

use crate::OceanGrid;
use crate::axis::{clamped, locate, locate_longitude};
use jiff::Timestamp;
use std::fmt;
use std::sync::Arc;

/// What an ocean state may hold at its nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Temperature in situ.
    Temperature,
    /// Practical salinity.
    Salinity,
    /// Eastward current.
    CurrentEast,
    /// Northward current.
    CurrentNorth,
}

impl Quantity {
    /// Everything an ocean state may hold.
    pub const ALL: [Self; 4] =
        [Self::Temperature, Self::Salinity, Self::CurrentEast, Self::CurrentNorth];
    /// What the speed of sound is made of.
    pub const SOUND: [Self; 2] = [Self::Temperature, Self::Salinity];
    /// What moves vehicles.
    pub const CURRENTS: [Self; 2] = [Self::CurrentEast, Self::CurrentNorth];
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Temperature => "temperature",
            Self::Salinity => "salinity",
            Self::CurrentEast => "eastward current",
            Self::CurrentNorth => "northward current",
        })
    }
}

/// The ocean at one time. Arrays are [depth, latitude, longitude], NaN on land and
/// below the bottom; an array is empty where the source did not hold the quantity.
#[derive(Debug, Clone)]
pub struct OceanState {
    /// The nodes.
    pub grid: Arc<OceanGrid>,
    /// When.
    pub time: Timestamp,
    /// Temperature in situ, °C, [depth, latitude, longitude].
    pub temperature_c: Vec<f32>,
    /// Practical salinity, [depth, latitude, longitude].
    pub salinity_psu: Vec<f32>,
    /// Eastward current, m/s, [depth, latitude, longitude].
    pub current_east_m_s: Vec<f32>,
    /// Northward current, m/s, [depth, latitude, longitude].
    pub current_north_m_s: Vec<f32>,
}

/// The ocean over one point, at the levels of its grid. An array is all NaN where the
/// source did not hold the quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Depths, metres, ascending.
    pub depth_m: Vec<f64>,
    /// Temperature in situ, °C.
    pub temperature_c: Vec<f64>,
    /// Practical salinity.
    pub salinity_psu: Vec<f64>,
    /// Eastward current, m/s.
    pub current_east_m_s: Vec<f64>,
    /// Northward current, m/s.
    pub current_north_m_s: Vec<f64>,
}

/// The four nodes around a point, as index within a level and weight.
type Corners = [(usize, f64); 4];

/// Weights below this, summed over the wet corners, say that the point lies on a dry
/// corner: then all wet corners count alike.
const SMALLEST_WEIGHT: f64 = 1e-9;

impl OceanState {
    /// Values of a quantity, [depth, latitude, longitude]; empty where the source did not
    /// hold it.
    pub fn values(&self, quantity: Quantity) -> &[f32] {
        match quantity {
            Quantity::Temperature => &self.temperature_c,
            Quantity::Salinity => &self.salinity_psu,
            Quantity::CurrentEast => &self.current_east_m_s,
            Quantity::CurrentNorth => &self.current_north_m_s,
        }
    }

    /// The column over a point: bilinear over those of the four surrounding nodes that
    /// are wet at the level, so that neither land nor the bottom leaks into the water.
    /// Levels at which none is wet repeat the level above, or the first wet level.
    ///
    /// `None` where all four nodes are land, or the point lies outside the grid.
    pub fn column(&self, longitude_deg: f64, latitude_deg: f64) -> Option<Column> {
        let corners = self.corners(longitude_deg, latitude_deg)?;
        let levels = |quantity| self.interpolate_levels(quantity, &corners);
        let [temperature_c, salinity_psu, current_east_m_s, current_north_m_s] =
            Quantity::ALL.map(levels);
        let all = [&temperature_c, &salinity_psu, &current_east_m_s, &current_north_m_s];
        if all.iter().all(|values| values.iter().all(|value| value.is_nan())) {
            return None;
        }
        let depth_m = self.grid.depth_m.clone();
        Some(Column { depth_m, temperature_c, salinity_psu, current_east_m_s, current_north_m_s })
    }

    /// Eastward and northward current at a point, m/s: horizontally as [`Self::column`],
    /// linear between levels, and that of the first or last level above and below them.
    ///
    /// `None` where all four surrounding nodes are land, where the point lies outside the
    /// grid, or where the source held no currents.
    pub fn current(&self, longitude_deg: f64, latitude_deg: f64, depth_m: f64) -> Option<[f64; 2]> {
        let corners = self.corners(longitude_deg, latitude_deg)?;
        let bracket = clamped(&self.grid.depth_m, depth_m);
        let component = |quantity| {
            let shallow = self.wet_level(quantity, &corners, bracket.lower)?;
            let deep = self.at_level(quantity, &corners, bracket.upper).unwrap_or(shallow);
            Some(shallow + bracket.upper_weight * (deep - shallow))
        };
        Some([component(Quantity::CurrentEast)?, component(Quantity::CurrentNorth)?])
    }

    fn corners(&self, longitude_deg: f64, latitude_deg: f64) -> Option<Corners> {
        let columns = locate_longitude(&self.grid.longitude_deg, longitude_deg)?.nodes();
        let rows = locate(&self.grid.latitude_deg, latitude_deg)?.nodes();
        let corner = |row: (usize, f64), column: (usize, f64)| {
            (self.grid.index(0, row.0, column.0), row.1 * column.1)
        };
        Some([
            corner(rows[0], columns[0]),
            corner(rows[0], columns[1]),
            corner(rows[1], columns[0]),
            corner(rows[1], columns[1]),
        ])
    }

    /// The value at a level from the corners that are wet there.
    fn at_level(&self, quantity: Quantity, corners: &Corners, level: usize) -> Option<f64> {
        let start = level * self.grid.layer_size();
        let layer = self.values(quantity).get(start..start + self.grid.layer_size())?;
        let (mut sum, mut weights, mut plain_sum, mut wet) = (0.0, 0.0, 0.0, 0);
        for &(node, weight) in corners {
            let value = f64::from(layer[node]);
            if value.is_nan() {
                continue;
            }
            sum += weight * value;
            weights += weight;
            plain_sum += value;
            wet += 1;
        }
        if weights > SMALLEST_WEIGHT {
            Some(sum / weights)
        } else {
            (wet > 0).then(|| plain_sum / f64::from(wet))
        }
    }

    /// The value at the deepest wet level not below `level`, or else at the first wet one.
    fn wet_level(&self, quantity: Quantity, corners: &Corners, level: usize) -> Option<f64> {
        (0..=level)
            .rev()
            .chain(level + 1..self.grid.depth_m.len())
            .find_map(|level| self.at_level(quantity, corners, level))
    }

    fn interpolate_levels(&self, quantity: Quantity, corners: &Corners) -> Vec<f64> {
        let mut above = self.wet_level(quantity, corners, 0).unwrap_or(f64::NAN);
        (0..self.grid.depth_m.len())
            .map(|level| {
                above = self.at_level(quantity, corners, level).unwrap_or(above);
                above
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two levels over 3 × 3 nodes; temperature is linear in all coordinates.
    fn state() -> OceanState {
        let grid = OceanGrid {
            longitude_deg: vec![10.0, 11.0, 12.0],
            latitude_deg: vec![-1.0, 0.0, 1.0],
            depth_m: vec![0.0, 100.0],
        };
        let mut temperature_c = Vec::new();
        for depth in &grid.depth_m {
            for latitude in &grid.latitude_deg {
                for longitude in &grid.longitude_deg {
                    temperature_c.push((longitude + 2.0 * latitude - 0.05 * depth) as f32);
                }
            }
        }
        OceanState {
            current_east_m_s: temperature_c.clone(),
            current_north_m_s: temperature_c.iter().map(|t| -t).collect(),
            salinity_psu: Vec::new(),
            temperature_c,
            time: Timestamp::UNIX_EPOCH,
            grid: Arc::new(grid),
        }
    }

    #[test]
    fn linear_fields_come_back_exactly() {
        let state = state();
        let column = state.column(10.25, 0.75).unwrap();
        assert!((column.temperature_c[0] - 11.75).abs() < 1e-5);
        assert!((column.temperature_c[1] - 6.75).abs() < 1e-5);
        assert!(column.salinity_psu.iter().all(|s| s.is_nan()));
        let [east, north] = state.current(10.25 + 360.0, 0.75, 40.0).unwrap();
        assert!((east - 9.75).abs() < 1e-5 && (north + 9.75).abs() < 1e-5);
    }

    #[test]
    fn one_land_corner_does_not_poison() {
        let mut state = state();
        for level in 0..2 {
            let node = state.grid.index(level, 0, 0);
            state.temperature_c[node] = f32::NAN;
        }
        let column = state.column(10.5, -0.5).unwrap();
        // Mean of the corners (11, -1), (10, 0) and (11, 0): 9, 10, 11.
        assert!((column.temperature_c[0] - 10.0).abs() < 1e-5);
        let on_land = state.column(10.0, -1.0).unwrap();
        assert!((on_land.temperature_c[0] - 10.0).abs() < 1e-5);
    }

    #[test]
    fn below_the_bottom_the_level_above_is_repeated() {
        let mut state = state();
        for values in [&mut state.temperature_c, &mut state.current_east_m_s] {
            values[9..].fill(f32::NAN);
        }
        state.current_north_m_s[9..].fill(f32::NAN);
        let column = state.column(11.0, 0.0).unwrap();
        assert!((column.temperature_c[1] - 11.0).abs() < 1e-5);
        let [east, _] = state.current(11.0, 0.0, 90.0).unwrap();
        assert!((east - 11.0).abs() < 1e-5);
    }

    #[test]
    fn land_all_round_and_outside_are_nothing() {
        let mut state = state();
        assert_eq!(state.column(9.0, 0.0), None);
        assert_eq!(state.current(10.0, 1.5, 0.0), None);
        for values in
            [&mut state.temperature_c, &mut state.current_east_m_s, &mut state.current_north_m_s]
        {
            values.fill(f32::NAN);
        }
        assert_eq!(state.column(10.5, 0.5), None);
        assert_eq!(state.current(10.5, 0.5, 0.0), None);
    }
}
