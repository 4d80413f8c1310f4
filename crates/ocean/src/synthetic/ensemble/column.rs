//! The undisturbed water column of an ensemble ocean: a mixed layer over layers in which
//! temperature and salinity go over, each at its own depth scale, into those of the deep.
//!
//! T(z) = T∞ + Σᵢ ΔTᵢ·F((z − h)/Hᵢ), and S(z) alike, with the mixed layer's depth h and
//! F(s) = e^(−s²/(1 + s)) below it, 1 above: level at the mixed layer, exponential far below.
//! A thin layer with ΔT > 0 is a seasonal thermocline, a thick one the permanent one; ΔT < 0
//! puts cold water on top of warmer, as in winter at high latitudes.

/// Water that goes over into the deep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Depth scale H, metres.
    pub thickness_m: f64,
    /// What it adds to the temperature of the mixed layer, ΔT, °C.
    pub temperature_c: f64,
    /// What it adds to the salinity of the mixed layer, ΔS.
    pub salinity_psu: f64,
}

/// Temperature and salinity over depth.
#[derive(Debug, Clone, PartialEq)]
pub struct WaterColumn {
    /// Depth of the mixed layer h, metres.
    pub mixed_layer_m: f64,
    /// Temperature in situ far down, °C.
    pub deep_temperature_c: f64,
    /// Practical salinity far down.
    pub deep_salinity_psu: f64,
    /// What lies between the mixed layer and the deep.
    pub layers: Vec<Layer>,
}

impl WaterColumn {
    /// Temperature in situ, °C, at a depth in metres.
    pub fn temperature_c(&self, depth_m: f64) -> f64 {
        self.deep_temperature_c + self.sum(depth_m, |layer| layer.temperature_c)
    }

    /// Practical salinity at a depth in metres.
    pub fn salinity_psu(&self, depth_m: f64) -> f64 {
        self.deep_salinity_psu + self.sum(depth_m, |layer| layer.salinity_psu)
    }

    fn sum(&self, depth_m: f64, part: impl Fn(&Layer) -> f64) -> f64 {
        let below_m = (depth_m - self.mixed_layer_m).max(0.0);
        let share = |layer: &Layer| {
            let s = below_m / layer.thickness_m;
            (-s * s / (1.0 + s)).exp()
        };
        self.layers.iter().map(|layer| share(layer) * part(layer)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_column_is_mixed_above_and_deep_below() {
        let column = WaterColumn {
            mixed_layer_m: 60.0,
            deep_temperature_c: 3.0,
            deep_salinity_psu: 34.7,
            layers: vec![
                Layer { thickness_m: 30.0, temperature_c: 8.0, salinity_psu: -1.0 },
                Layer { thickness_m: 300.0, temperature_c: 9.0, salinity_psu: 0.5 },
            ],
        };
        for depth in [0.0, 30.0, 60.0] {
            assert!((column.temperature_c(depth) - 20.0).abs() < 1e-12);
            assert!((column.salinity_psu(depth) - 34.2).abs() < 1e-12);
        }
        // One depth scale below the mixed layer a layer has e^(−1/2) of its temperature.
        let thin = 8.0 * (-0.5_f64).exp();
        let thick = 9.0 * (-0.01_f64 / 1.1).exp();
        assert!((column.temperature_c(90.0) - (3.0 + thin + thick)).abs() < 1e-12);
        assert!((column.temperature_c(6_000.0) - 3.0).abs() < 1e-6);
        for depth in 0..3_000 {
            let z = f64::from(depth);
            assert!(column.temperature_c(z + 1.0) <= column.temperature_c(z));
        }
    }
}
