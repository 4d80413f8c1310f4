//! A rectangle of longitudes and latitudes.

use std::fmt;

/// A rectangle of longitudes and latitudes, in degrees. A region may cross the
/// antimeridian: then `west_deg` is greater than `east_deg`, or `east_deg` beyond 180.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// Western edge, degrees east.
    pub west_deg: f64,
    /// Eastern edge, degrees east.
    pub east_deg: f64,
    /// Southern edge, degrees north.
    pub south_deg: f64,
    /// Northern edge, degrees north.
    pub north_deg: f64,
}

impl Region {
    /// Eastward extent in degrees, counted from the western edge, in [0, 360).
    pub fn width_deg(&self) -> f64 {
        (self.east_deg - self.west_deg).rem_euclid(360.0)
    }

    /// Northward extent in degrees.
    pub fn height_deg(&self) -> f64 {
        self.north_deg - self.south_deg
    }

    /// Longitude and latitude of the middle, degrees.
    pub fn centre_deg(&self) -> (f64, f64) {
        (self.west_deg + self.width_deg() / 2.0, f64::midpoint(self.south_deg, self.north_deg))
    }

    /// The region grown by `margin_deg` degrees on each side; latitudes stop at the poles.
    #[must_use]
    pub fn grown(&self, margin_deg: f64) -> Self {
        let west_deg = self.west_deg - margin_deg;
        Self {
            west_deg,
            east_deg: west_deg + (self.width_deg() + 2.0 * margin_deg).min(360.0),
            south_deg: (self.south_deg - margin_deg).max(-90.0),
            north_deg: (self.north_deg + margin_deg).min(90.0),
        }
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} to {}° E, {} to {}° N",
            self.west_deg, self.east_deg, self.south_deg, self.north_deg
        )
    }
}

#[cfg(test)]
mod tests {
    use super::Region;

    #[test]
    fn the_antimeridian_is_no_edge() {
        let fiji = Region { west_deg: 177.0, east_deg: -178.0, south_deg: -19.0, north_deg: -16.0 };
        assert!((fiji.width_deg() - 5.0).abs() < 1e-12);
        assert!((fiji.centre_deg().0 - 179.5).abs() < 1e-12);
        let grown = fiji.grown(1.0);
        assert!((grown.width_deg() - 7.0).abs() < 1e-12);
    }
}
