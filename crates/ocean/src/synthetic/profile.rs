//! The undisturbed water column of the synthetic ocean: temperatures and salinities of
//! an autumn day over the northern slope of the South China Sea. By Mackenzie's equation
//! they give 1541.5 m/s at the surface, 1541.7 at 47 m, 1538.6 at 78, 1531 at 110,
//! 1515.7 at 186, 1504 at 266, 1493.6 at 454, 1484.1 at the axis of the deep sound
//! channel (1062 m) and 1492 at 1942 m.

/// Depth (m), temperature in situ (°C) and practical salinity of the knots: a mixed
/// layer, the thermocline with the salinity maximum of the tropical water in it, the
/// salinity minimum of the intermediate water, and the deep water.
const KNOTS: [(f64, f64, f64); 17] = [
    (0.0, 28.73, 33.85),
    (30.0, 28.61, 33.87),
    (47.0, 28.42, 33.95),
    (78.0, 26.65, 34.25),
    (110.0, 23.15, 34.50),
    (186.0, 17.09, 34.62),
    (266.0, 13.00, 34.55),
    (454.0, 9.20, 34.42),
    (643.0, 7.11, 34.43),
    (902.0, 5.04, 34.48),
    (1062.0, 4.18, 34.51),
    (1452.0, 3.02, 34.56),
    (1942.0, 2.53, 34.60),
    (2225.0, 2.45, 34.61),
    (2533.0, 2.46, 34.62),
    (4000.0, 2.52, 34.65),
    (5728.0, 2.66, 34.66),
];

/// Temperature in situ, °C, at a depth in metres.
pub fn temperature_c(depth_m: f64) -> f64 {
    monotone_cubic(depth_m, |knot| knot.1)
}

/// Practical salinity at a depth in metres.
pub fn salinity_psu(depth_m: f64) -> f64 {
    monotone_cubic(depth_m, |knot| knot.2)
}

/// Thermal expansion, 1/°C, of the water at a depth: a straight line through its values
/// at the surface pressure, good to 8 % between 2 and 29 °C.
pub fn thermal_expansion_1_c(depth_m: f64) -> f64 {
    0.6e-4 + 0.95e-5 * temperature_c(depth_m)
}

/// The monotone piecewise cubic of Fritsch & Butland (1984, doi:10.1137/0905021) through
/// the knots; constant beyond them.
fn monotone_cubic(depth_m: f64, value: fn(&(f64, f64, f64)) -> f64) -> f64 {
    let last = KNOTS.len() - 1;
    let z = depth_m.clamp(KNOTS[0].0, KNOTS[last].0);
    let i = KNOTS.partition_point(|knot| knot.0 <= z).clamp(1, last) - 1;
    let length = |i: usize| KNOTS[i + 1].0 - KNOTS[i].0;
    let secant = |i: usize| (value(&KNOTS[i + 1]) - value(&KNOTS[i])) / length(i);
    let slope = |i: usize| {
        if i == 0 || i == last {
            return secant(i.min(last - 1));
        }
        let (before, after) = (secant(i - 1), secant(i));
        if before * after <= 0.0 {
            return 0.0;
        }
        let (h, g) = (length(i - 1), length(i));
        let (w1, w2) = (2.0 * g + h, g + 2.0 * h);
        (w1 + w2) / (w1 / before + w2 / after)
    };
    let (h, s) = (length(i), (z - KNOTS[i].0) / length(i));
    let (from, to) = (value(&KNOTS[i]), value(&KNOTS[i + 1]));
    let (m0, m1) = (slope(i) * h, slope(i + 1) * h);
    let s2 = s * s;
    from + s * m0
        + s2 * (3.0 * (to - from) - 2.0 * m0 - m1)
        + s2 * s * (2.0 * (from - to) + m0 + m1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mackenzie (1981), doi:10.1121/1.386920.
    fn mackenzie_m_s(t: f64, s: f64, d: f64) -> f64 {
        1448.96 + 4.591 * t - 5.304e-2 * t * t
            + 2.374e-4 * t * t * t
            + 1.340 * (s - 35.0)
            + 1.630e-2 * d
            + 1.675e-7 * d * d
            - 1.025e-2 * t * (s - 35.0)
            - 7.139e-13 * t * d * d * d
    }

    #[test]
    fn the_sound_speed_is_that_of_the_autumn_profile() {
        let profile = [
            (0.0, 1541.5),
            (47.0, 1541.7),
            (78.0, 1538.6),
            (110.0, 1531.0),
            (186.0, 1515.7),
            (266.0, 1504.0),
            (454.0, 1493.6),
            (1062.0, 1484.1),
            (1942.0, 1492.0),
        ];
        for (depth, expected) in profile {
            let c = mackenzie_m_s(temperature_c(depth), salinity_psu(depth), depth);
            assert!((c - expected).abs() < 0.05, "{depth} m: {c} {expected}");
        }
    }

    #[test]
    fn temperature_falls_down_to_the_deep_water_without_overshoot() {
        for depth in 0..2200 {
            let z = f64::from(depth);
            assert!(temperature_c(z + 1.0) <= temperature_c(z));
        }
    }

    /// TEOS-10's thermal expansion at 0 dbar, by the `gsw` crate.
    #[test]
    fn the_thermal_expansion_is_near_teos_10() {
        const TOLERANCE: f64 = 0.08;
        for depth in [0.0, 78.0, 110.0, 186.0, 266.0, 454.0, 1062.0] {
            let (t, s) = (temperature_c(depth), salinity_psu(depth));
            let exact = gsw::volume::alpha(s * 35.165_04 / 35.0, t, 0.0).unwrap();
            let ours = thermal_expansion_1_c(depth);
            assert!((ours / exact - 1.0).abs() < TOLERANCE, "{depth} m: {ours} {exact}");
        }
    }
}
