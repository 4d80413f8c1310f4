/// Absorption of sound by the water, per distance travelled.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Absorption {
    /// Lossless water.
    None,
    /// [`thorp_db_km`].
    #[default]
    Thorp,
    /// [`francois_garrison_db_km`] of one representative water.
    FrancoisGarrison {
        /// Temperature, °C.
        temperature_c: f64,
        /// Practical salinity.
        salinity_psu: f64,
        /// Acidity.
        ph: f64,
        /// Depth, metres, positive down.
        depth_m: f64,
    },
}

impl Absorption {
    /// Absorption at a frequency in Hz, in dB/km.
    pub fn db_km(self, frequency_hz: f64) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Thorp => thorp_db_km(frequency_hz),
            Self::FrancoisGarrison { temperature_c, salinity_psu, ph, depth_m } => {
                francois_garrison_db_km(frequency_hz, temperature_c, salinity_psu, ph, depth_m)
            }
        }
    }
}

/// Absorption of seawater, in dB/km: Thorp's formula (1967,
/// doi:10.1121/1.1910566) in the form of *Computational Ocean Acoustics*
/// (Jensen et al., Eq. 1.47), made for water near 4 °C and 1000 m, 0.1–50 khz.
pub fn thorp_db_km(frequency_hz: f64) -> f64 {
    let f2 = (frequency_hz / 1000.0).powi(2);
    3.3e-3 + 0.11 * f2 / (1.0 + f2) + 44.0 * f2 / (4100.0 + f2) + 3e-4 * f2
}

/// Absorption of seawater, in dB/km: Francois & Garrison (1982,
/// doi:10.1121/1.388673), the sum of boric acid, magnesium sulphate and pure
/// water; valid for −2–22 °C, 30–35 ‰, 0–3500 m, 0.4–1000 khz.
pub fn francois_garrison_db_km(
    frequency_hz: f64,
    temperature_c: f64,
    salinity_psu: f64,
    ph: f64,
    depth_m: f64,
) -> f64 {
    let (f, t, s, z) = (frequency_hz / 1000.0, temperature_c, salinity_psu, depth_m);
    let kelvin = 273.0 + t;
    let c = 1412.0 + 3.21 * t + 1.19 * s + 0.0167 * z;

    let boric_strength = 8.86 / c * 10f64.powf(0.78 * ph - 5.0);
    let boric_khz = 2.8 * (s / 35.0).sqrt() * 10f64.powf(4.0 - 1245.0 / kelvin);
    let boric = boric_strength * boric_khz * f * f / (boric_khz.powi(2) + f * f);

    let sulphate_strength = 21.44 * s / c * (1.0 + 0.025 * t);
    let sulphate_pressure = 1.0 - 1.37e-4 * z + 6.2e-9 * z * z;
    let sulphate_khz = 8.17 * 10f64.powf(8.0 - 1990.0 / kelvin) / (1.0 + 0.0018 * (s - 35.0));
    let sulphate = sulphate_strength * sulphate_pressure * sulphate_khz * f * f
        / (sulphate_khz.powi(2) + f * f);

    let water_strength = if t <= 20.0 {
        4.937e-4 + t * (-2.59e-5 + t * (9.11e-7 - 1.50e-8 * t))
    } else {
        3.964e-4 + t * (-1.146e-5 + t * (1.45e-7 - 6.5e-10 * t))
    };
    let water_pressure = 1.0 - 3.83e-5 * z + 4.9e-10 * z * z;
    let water = water_strength * water_pressure * f * f;

    boric + sulphate + water
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The simplification of Ainslie & `McColm` (1998, doi:10.1121/1.421258), which its
    /// authors give as within 10 % of Francois & Garrison in the ocean.
    fn ainslie_mccolm_db_km(f: f64, t: f64, s: f64, ph: f64, z_km: f64) -> f64 {
        let f1 = 0.78 * (s / 35.0).sqrt() * (t / 26.0).exp();
        let f2 = 42.0 * (t / 17.0).exp();
        0.106 * f1 * f * f / (f1 * f1 + f * f) * ((ph - 8.0) / 0.56).exp()
            + 0.52 * (1.0 + t / 43.0) * (s / 35.0) * f2 * f * f / (f2 * f2 + f * f)
                * (-z_km / 6.0).exp()
            + 0.000_49 * f * f * (-(t / 27.0 + z_km / 17.0)).exp()
    }

    #[test]
    fn francois_garrison_agrees_with_an_independent_simplification() {
        for (f, t, s, ph, z) in [
            (1.0, 4.0, 35.0, 8.0, 1000.0),
            (10.0, 10.0, 35.0, 8.0, 50.0),
            (50.0, 15.0, 34.0, 8.0, 200.0),
            (25.0, 22.0, 34.0, 8.1, 0.0),
            (200.0, 8.0, 33.0, 7.9, 100.0),
        ] {
            let ours = francois_garrison_db_km(f * 1000.0, t, s, ph, z);
            let theirs = ainslie_mccolm_db_km(f, t, s, ph, z / 1000.0);
            assert!((ours / theirs - 1.0).abs() < 0.10, "{f} kHz: {ours} against {theirs} dB/km");
        }
    }

    #[test]
    fn thorp_meets_the_values_read_off_the_published_curve() {
        // COA Fig. 1.20: about 0.07 dB/km at 1 kHz and 1 dB/km at 10 kHz.
        assert!((thorp_db_km(1000.0) - 0.0693).abs() < 1e-3);
        assert!((thorp_db_km(10_000.0) - 1.19).abs() < 1e-2);
    }
}
