//! A family of small synthetic oceans: pure functions of physical parameters, so that
//! hundreds of different waters and sea floors can be made for what must work in all of
//! them. Whoever wants a random one draws the parameters.
//!
//! - [`mod@column`]: the undisturbed water column, from tropical to polar.
//! - [`features`]: eddies, a front and internal waves, which bend it sideways.
//! - [`relief`]: the sea floor.

pub mod column;
pub mod features;
pub mod relief;

pub use column::{Layer, WaterColumn};
pub use features::{Eddy, Front, InternalWave};
pub use relief::{Mount, Relief, Trench};

use super::{BATHYMETRY_NODES_PER_DEGREE, LEVELS_M, START, nodes};
use crate::{Bathymetry, OceanGrid, OceanState, Region};
use std::sync::Arc;

/// Nodes per degree of the ocean grid, four times those of the Copernicus Marine global
/// forecast: 2.3 km, so that the smallest eddies are resolved.
const NODES_PER_DEGREE: f64 = 48.0;

/// Seawater freezes here, °C: nothing is colder.
const FREEZING_C: f64 = -1.9;

/// How far the data reach beyond the region, degrees of latitude: 4.4 km.
const MARGIN_DEG: f64 = 0.04;

/// One ocean of the family at one time: still water, which is heard and not sailed.
#[derive(Debug, Clone, PartialEq)]
pub struct EnsembleOcean {
    /// The region that the data cover, with a margin of 4.4 km.
    pub region: Region,
    /// The undisturbed water column.
    pub column: WaterColumn,
    /// Eddies.
    pub eddies: Vec<Eddy>,
    /// A front.
    pub front: Option<Front>,
    /// Internal waves.
    pub waves: Vec<InternalWave>,
    /// The sea floor.
    pub relief: Relief,
}

impl EnsembleOcean {
    /// Temperature in situ (°C) and practical salinity at a point `x_m` east and `y_m`
    /// north of the region's middle and a depth in metres.
    pub fn water(&self, x_m: f64, y_m: f64, depth_m: f64) -> (f64, f64) {
        let eddies: f64 = self.eddies.iter().map(|eddy| eddy.heave_m(x_m, y_m, depth_m)).sum();
        let waves: f64 = self.waves.iter().map(|wave| wave.heave_m(x_m, y_m, depth_m)).sum();
        let origin_m = (depth_m - eddies - waves).max(0.0);
        let front = self.front.as_ref().map_or([0.0; 2], |front| front.anomaly(x_m, y_m, depth_m));
        let temperature_c = self.column.temperature_c(origin_m) + front[0];
        (temperature_c.max(FREEZING_C), self.column.salinity_psu(origin_m) + front[1])
    }

    /// The waters, on the levels of the Copernicus Marine global forecast; without
    /// currents.
    pub fn state(&self) -> OceanState {
        let area = self.area();
        let grid = OceanGrid {
            longitude_deg: nodes(area.west_deg, area.east_deg, NODES_PER_DEGREE, 0.0),
            latitude_deg: nodes(area.south_deg, area.north_deg, NODES_PER_DEGREE, 0.0),
            depth_m: LEVELS_M.iter().map(|&level| f64::from(level)).collect(),
        };
        let mut temperature_c = vec![f32::NAN; grid.node_count()];
        let mut salinity_psu = temperature_c.clone();
        for (row, &latitude_deg) in grid.latitude_deg.iter().enumerate() {
            for (column, &longitude_deg) in grid.longitude_deg.iter().enumerate() {
                let (x, y) = self.plane_m(longitude_deg, latitude_deg);
                let floor_m = self.relief.depth_m(x, y);
                for (level, &depth_m) in grid.depth_m.iter().enumerate() {
                    if depth_m > floor_m {
                        break;
                    }
                    let (temperature, salinity) = self.water(x, y, depth_m);
                    let node = grid.index(level, row, column);
                    temperature_c[node] = temperature as f32;
                    salinity_psu[node] = salinity as f32;
                }
            }
        }
        OceanState {
            grid: Arc::new(grid),
            time: START,
            temperature_c,
            salinity_psu,
            current_east_m_s: Vec::new(),
            current_north_m_s: Vec::new(),
        }
    }

    /// The depth of the sea on the nodes of GEBCO, whole metres as it gives them.
    pub fn bathymetry(&self) -> Bathymetry {
        let area = self.area();
        let longitude_deg = nodes(area.west_deg, area.east_deg, BATHYMETRY_NODES_PER_DEGREE, 0.5);
        let latitude_deg = nodes(area.south_deg, area.north_deg, BATHYMETRY_NODES_PER_DEGREE, 0.5);
        let mut values_m = Vec::with_capacity(longitude_deg.len() * latitude_deg.len());
        for &latitude in &latitude_deg {
            for &longitude in &longitude_deg {
                let (x, y) = self.plane_m(longitude, latitude);
                values_m.push(self.relief.depth_m(x, y).round() as f32);
            }
        }
        Bathymetry { longitude_deg, latitude_deg, values_m }
    }

    fn area(&self) -> Region {
        let (_, latitude_deg) = self.region.centre_deg();
        self.region.grown(MARGIN_DEG / latitude_deg.to_radians().cos())
    }

    /// Metres east and north of the region's middle on a tangent plane: the coordinates
    /// of the parameters.
    fn plane_m(&self, longitude_deg: f64, latitude_deg: f64) -> (f64, f64) {
        super::plane_about_m(self.region, longitude_deg, latitude_deg)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ocean() -> EnsembleOcean {
        EnsembleOcean {
            region: Region { west_deg: 10.0, east_deg: 10.3, south_deg: 30.0, north_deg: 30.27 },
            column: WaterColumn {
                mixed_layer_m: 50.0,
                deep_temperature_c: 4.0,
                deep_salinity_psu: 34.8,
                layers: vec![
                    Layer { thickness_m: 40.0, temperature_c: 10.0, salinity_psu: -0.5 },
                    Layer { thickness_m: 400.0, temperature_c: 8.0, salinity_psu: 0.4 },
                ],
            },
            eddies: vec![Eddy {
                centre_m: [5_000.0, -2_000.0],
                radius_m: 8_000.0,
                displacement_m: 30.0,
                core_depth_m: 150.0,
            }],
            front: None,
            waves: Vec::new(),
            relief: Relief::flat(700.0),
        }
    }

    #[test]
    fn the_state_is_the_water_down_to_the_floor() {
        let ocean = ocean();
        let state = ocean.state();
        assert!(state.grid.covers(ocean.region.grown(MARGIN_DEG)));
        let (row, column) = (4, 7);
        let (longitude, latitude) =
            (state.grid.longitude_deg[column], state.grid.latitude_deg[row]);
        let (x, y) = ocean.plane_m(longitude, latitude);
        for (level, &depth) in state.grid.depth_m.iter().enumerate() {
            let node = state.grid.index(level, row, column);
            let found = f64::from(state.temperature_c[node]);
            if depth > 700.0 {
                assert!(found.is_nan(), "{depth} m");
            } else {
                let (temperature, _) = ocean.water(x, y, depth);
                assert!((found - temperature).abs() < 1e-5, "{depth} m: {found} {temperature}");
            }
        }
        let bathymetry = ocean.bathymetry();
        assert!(bathymetry.values_m.iter().all(|&depth| (depth - 700.0).abs() < f32::EPSILON));
    }

    /// A warm eddy presses the thermocline down: warmer below, the surface as it was.
    #[test]
    fn a_warm_eddy_warms_the_thermocline_and_not_the_surface() {
        let (with, without) = (ocean(), EnsembleOcean { eddies: Vec::new(), ..ocean() });
        let at = |ocean: &EnsembleOcean, depth| ocean.water(5_000.0, -2_000.0, depth).0;
        assert!((at(&with, 0.0) - at(&without, 0.0)).abs() < 1e-12);
        assert!(at(&with, 120.0) > at(&without, 120.0) + 0.5);
        let far = |ocean: &EnsembleOcean| ocean.water(-40_000.0, 0.0, 120.0).0;
        assert!((far(&with) - far(&without)).abs() < 1e-4);
    }
}
