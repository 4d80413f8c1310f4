use super::pressure_dbar;

/// Which equation gives the speed of sound in seawater.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SoundSpeedEquation {
    /// [`mackenzie_m_s`], the equation of depth rather than pressure.
    #[default]
    Mackenzie,
    /// [`del_grosso_m_s`].
    DelGrosso,
    /// [`chen_millero_m_s`], the UNESCO standard.
    ChenMillero,
}

impl SoundSpeedEquation {
    /// Speed of sound, in m/s, from in-situ temperature (ITS-90, °C), practical
    /// salinity, depth (metres, positive down) and latitude (degrees, for the
    /// pressure; Mackenzie's equation does not use it).
    pub fn speed_m_s(
        self,
        temperature_c: f64,
        salinity_psu: f64,
        depth_m: f64,
        latitude_deg: f64,
    ) -> f64 {
        let pressure = || pressure_dbar(depth_m, latitude_deg);
        match self {
            Self::Mackenzie => mackenzie_m_s(temperature_c, salinity_psu, depth_m),
            Self::DelGrosso => del_grosso_m_s(temperature_c, salinity_psu, pressure()),
            Self::ChenMillero => chen_millero_m_s(temperature_c, salinity_psu, pressure()),
        }
    }
}

/// Speed of sound in seawater, in m/s: Mackenzie's nine-term equation
/// (1981, doi:10.1121/1.386920), valid for 2–30 °C, 25–40 ‰, 0–8000 m.
pub fn mackenzie_m_s(temperature_c: f64, salinity_psu: f64, depth_m: f64) -> f64 {
    let (t, s, z) = (temperature_c, salinity_psu - 35.0, depth_m);
    1448.96
        + t * (4.591 + t * (-5.304e-2 + 2.374e-4 * t))
        + 1.340 * s
        + z * (1.630e-2 + 1.675e-7 * z)
        - t * (1.025e-2 * s + 7.139e-13 * z * z * z)
}

/// Speed of sound in seawater, in m/s: Del Grosso (1974,
/// doi:10.1121/1.1903388) with the coefficients of Wong & Zhu (1995,
/// doi:10.1121/1.413048) for ITS-90 temperatures; valid for 0–30 °C, 30–40 ‰,
/// 0–10 000 dbar.
pub fn del_grosso_m_s(temperature_c: f64, salinity_psu: f64, pressure_dbar: f64) -> f64 {
    const DBAR_PER_KG_CM2: f64 = 9.806_65;
    let (t, s, p) = (temperature_c, salinity_psu, pressure_dbar / DBAR_PER_KG_CM2);
    let of_temperature = t * (5.012_285 + t * (-5.511_84e-2 + t * 2.216_49e-4));
    let of_salinity = s * (1.329_530 + s * 1.288_598e-4);
    let of_pressure = p * (0.156_059_2 + p * (2.449_993e-5 - p * 8.833_959e-9));
    let mixed = -1.275_936e-2 * t * s + 6.353_509e-3 * t * p + 2.656_174e-8 * t * t * p * p
        - 1.593_895e-6 * t * p * p
        + 5.222_483e-10 * t * p * p * p
        - 4.383_615e-7 * t * t * t * p
        - 1.616_745e-9 * s * s * p * p
        + 9.688_441e-5 * t * t * s
        + 4.857_614e-6 * t * s * s * p
        - 3.406_824e-4 * t * s * p;
    1402.392 + of_temperature + of_salinity + of_pressure + mixed
}

/// Speed of sound in seawater, in m/s: Chen & Millero (1977,
/// doi:10.1121/1.381646), the UNESCO equation (Fofonoff & Millard 1983, UNESCO
/// technical papers in marine science 44); valid for 0–40 °C, 0–40 ‰,
/// 0–10 000 dbar. Takes ITS-90 temperatures and converts them to the equation's
/// IPTS-68.
pub fn chen_millero_m_s(temperature_c: f64, salinity_psu: f64, pressure_dbar: f64) -> f64 {
    let (t, s, p) = (1.000_24 * temperature_c, salinity_psu, pressure_dbar / 10.0);
    let pure_water = polynomial(
        p,
        &[
            polynomial(t, &[1402.388, 5.037_11, -5.808_52e-2, 3.3420e-4, -1.478_00e-6, 3.1464e-9]),
            polynomial(t, &[0.153_563, 6.8982e-4, -8.1788e-6, 1.3621e-7, -6.1185e-10]),
            polynomial(t, &[3.1260e-5, -1.7107e-6, 2.5974e-8, -2.5335e-10, 1.0405e-12]),
            polynomial(t, &[-9.7729e-9, 3.8504e-10, -2.3643e-12]),
        ],
    );
    let a = polynomial(
        p,
        &[
            polynomial(t, &[1.389, -1.262e-2, 7.164e-5, 2.006e-6, -3.21e-8]),
            polynomial(t, &[9.4742e-5, -1.2580e-5, -6.4885e-8, 1.0507e-8, -2.0122e-10]),
            polynomial(t, &[-3.9064e-7, 9.1041e-9, -1.6002e-10, 7.988e-12]),
            polynomial(t, &[1.100e-10, 6.649e-12, -3.389e-13]),
        ],
    );
    let b = -1.922e-2 - 4.42e-5 * t + (7.3637e-5 + 1.7945e-7 * t) * p;
    let d = 1.727e-3 - 7.9836e-6 * p;
    pure_water + s * (a + b * s.sqrt() + d * s)
}

fn polynomial(x: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mackenzie_meets_its_published_check_value() {
        // Mackenzie (1981): 25 °C, 35 ‰, 1000 m.
        assert!((mackenzie_m_s(25.0, 35.0, 1000.0) - 1550.744).abs() < 5e-4);
    }

    #[test]
    fn chen_millero_meets_the_unesco_check_value() {
        // Fofonoff & Millard (1983): S = 40, t68 = 40 °C, 10 000 dbar.
        let speed = chen_millero_m_s(40.0 / 1.000_24, 40.0, 10_000.0);
        assert!((speed - 1731.995).abs() < 5e-4);
    }

    /// The equations are independent fits: at ordinary oceanic conditions they
    /// differ by what Dushaw et al. (1993) report, under 1 m/s.
    #[test]
    fn the_three_equations_agree_in_the_ocean() {
        for (temperature, salinity, depth) in
            [(28.0, 33.8, 0.0), (15.0, 34.6, 200.0), (4.5, 34.5, 1000.0), (2.4, 34.6, 3000.0)]
        {
            let [mackenzie, del_grosso, chen_millero] = [
                SoundSpeedEquation::Mackenzie,
                SoundSpeedEquation::DelGrosso,
                SoundSpeedEquation::ChenMillero,
            ]
            .map(|equation| equation.speed_m_s(temperature, salinity, depth, 21.7));
            assert!((mackenzie - del_grosso).abs() < 1.0, "{mackenzie} {del_grosso}");
            assert!((chen_millero - del_grosso).abs() < 1.0, "{chen_millero} {del_grosso}");
        }
    }
}
