/// Pressure below the surface, in decibars: Saunders (1981,
/// doi:10.1175/1520-0485(1981)011<0573:PCODTP>2.0.CO;2).
///
/// `depth_m` is positive down; valid over the oceans' depths to 0.1 dbar.
pub fn pressure_dbar(depth_m: f64, latitude_deg: f64) -> f64 {
    let sine = latitude_deg.to_radians().sin();
    let c1 = 1.0 - (5.92e-3 + 5.25e-3 * sine * sine);
    (c1 - (c1 * c1 - 8.84e-6 * depth_m).sqrt()) / 4.42e-6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_check_value_is_met() {
        // Saunders (1981): 7321.45 m at 30° is 7500 dbar.
        assert!((pressure_dbar(7321.45, 30.0) - 7500.0).abs() < 0.01);
        assert!(pressure_dbar(0.0, 45.0).abs() < f64::EPSILON);
    }
}
