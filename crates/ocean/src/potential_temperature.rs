//! Potential and in-situ temperature.
//!
//! Ocean models carry potential temperature (referred to the surface), sound and
//! instruments feel the temperature in situ. The forecasts this crate reads come from a
//! model with the 1980 equation of state, so its algorithms are the right ones: the
//! adiabatic lapse rate of Bryden (1973) integrated by one Runge–Kutta–Gill step, as in
//! Fofonoff & Millard (1983), *Algorithms for computation of fundamental properties of
//! seawater*, UNESCO technical papers in marine science 44.

/// Sea pressure, dbar, at a depth and latitude (TEOS-10).
pub fn pressure_dbar(depth_m: f64, latitude_deg: f64) -> f64 {
    // The function refuses heights above the sea surface only; depths there count as 0.
    gsw::conversions::p_from_z(-depth_m.max(0.0), latitude_deg, None, None).unwrap_or(0.0)
}

/// Adiabatic lapse rate, °C/dbar (Bryden 1973, doi:10.1016/0011-7471(73)90063-6), valid
/// for 0–30 °C, 30–40, 0–10 000 dbar.
pub fn adiabatic_lapse_rate_c_dbar(
    temperature_c: f64,
    salinity_psu: f64,
    pressure_dbar: f64,
) -> f64 {
    let (t, s, p) = (temperature_c, salinity_psu - 35.0, pressure_dbar);
    (((-2.1687e-16 * t + 1.8676e-14) * t - 4.6206e-13) * p
        + ((2.7759e-12 * t - 1.1351e-10) * s
            + ((-5.4481e-14 * t + 8.733e-12) * t - 6.7795e-10) * t
            + 1.8741e-8))
        * p
        + (-4.2393e-8 * t + 1.8932e-6) * s
        + ((6.6228e-10 * t - 6.836e-8) * t + 8.5258e-6) * t
        + 3.5803e-5
}

/// Temperature, °C, that water of `temperature_c` at `from_dbar` takes when it is moved
/// adiabatically to `to_dbar` (Fofonoff & Millard 1983, section 7).
pub fn moved_adiabatically_c(
    temperature_c: f64,
    salinity_psu: f64,
    from_dbar: f64,
    to_dbar: f64,
) -> f64 {
    const GILL: f64 = 0.292_893_218_813_452_5; // 1 − 1/√2
    let step = to_dbar - from_dbar;
    let increment = |t, p| step * adiabatic_lapse_rate_c_dbar(t, salinity_psu, p);
    let middle = from_dbar + 0.5 * step;

    let k1 = increment(temperature_c, from_dbar);
    let mut t = temperature_c + 0.5 * k1;
    let mut q = k1;
    let k2 = increment(t, middle);
    t += GILL * (k2 - q);
    q = (2.0 * GILL) * k2 + (1.0 - 3.0 * GILL) * q;
    let k3 = increment(t, middle);
    t += (2.0 - GILL) * (k3 - q);
    q = 2.0 * (2.0 - GILL) * k3 + (1.0 - 3.0 * (2.0 - GILL)) * q;
    let k4 = increment(t, to_dbar);
    t + (k4 - 2.0 * q) / 6.0
}

/// Temperature in situ, °C, of water with a potential temperature referred to the
/// surface, at a pressure in dbar.
pub fn in_situ_c(potential_temperature_c: f64, salinity_psu: f64, pressure_dbar: f64) -> f64 {
    moved_adiabatically_c(potential_temperature_c, salinity_psu, 0.0, pressure_dbar)
}

/// Potential temperature, °C, referred to the surface: the inverse of [`in_situ_c`].
pub fn potential_c(temperature_c: f64, salinity_psu: f64, pressure_dbar: f64) -> f64 {
    let mut potential = moved_adiabatically_c(temperature_c, salinity_psu, pressure_dbar, 0.0);
    // The lapse rate hardly depends on temperature: each step gains two digits or more.
    for _ in 0..4 {
        potential += temperature_c - in_situ_c(potential, salinity_psu, pressure_dbar);
    }
    potential
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fofonoff & Millard (1983), sections 6 and 7, in their temperature scale.
    #[test]
    fn published_check_values() {
        let rate = adiabatic_lapse_rate_c_dbar(40.0, 40.0, 10_000.0);
        assert!((rate - 3.255_976e-4).abs() < 5e-11, "{rate}");
        let potential = moved_adiabatically_c(40.0, 40.0, 10_000.0, 0.0);
        assert!((potential - 36.890_73).abs() < 5e-6, "{potential}");
    }

    /// The TEOS-10 toolbox's published values of `gsw_pt0_from_t`, which know a newer
    /// equation of state: 3 mK is the distance between the two standards.
    #[test]
    fn close_to_teos_10() {
        let absolute_salinity = [34.7118, 34.8915, 35.0256, 34.8472, 34.7366, 34.7324];
        let in_situ = [28.7856, 28.4329, 22.8103, 10.2600, 6.8863, 4.4036];
        let pressure = [10.0, 50.0, 125.0, 250.0, 600.0, 1000.0];
        let potential = [
            28.783_196_819_670_632,
            28.420_983_342_398_962,
            22.784_930_399_117_11,
            10.230_523_661_095_73,
            6.829_230_224_409_661,
            4.324_510_571_845_719,
        ];
        for i in 0..6 {
            let practical = absolute_salinity[i] / 35.165_04 * 35.0;
            let ours = potential_c(in_situ[i], practical, pressure[i]);
            assert!((ours - potential[i]).abs() < 3e-3, "{ours} {}", potential[i]);
        }
    }

    /// Saunders' formula agrees with UNESCO's: 10 000 dbar at 30° lie 9712.653 m deep.
    #[test]
    fn pressure_at_a_published_depth() {
        let pressure = pressure_dbar(9712.653, 30.0);
        assert!((pressure - 10_000.0).abs() < 3.0, "{pressure}");
        assert!(pressure_dbar(-1.0, 30.0).abs() < f64::EPSILON);
    }

    #[test]
    fn there_and_back_again() {
        for temperature in [-1.5, 2.4, 10.0, 29.0] {
            for pressure in [0.0, 500.0, 2000.0, 5800.0] {
                let potential = potential_c(temperature, 34.6, pressure);
                let back = in_situ_c(potential, 34.6, pressure);
                assert!((back - temperature).abs() < 1e-10);
            }
        }
    }
}
