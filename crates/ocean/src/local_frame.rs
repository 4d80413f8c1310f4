//! Local coordinates of a region: metres east and north of its south-west corner.

use crate::Region;
use geographiclib_rs::{DirectGeodesic, Geodesic, InverseGeodesic};

/// Azimuthal equidistant projection about the centre of a region, on the WGS 84
/// ellipsoid: distances and bearings from the centre are those of the geodesic
/// (Karney 2013, doi:10.1007/s00190-012-0578-z). At a distance r from the centre, lengths
/// across the bearing are too long by r²/6R²: 2·10⁻⁶ at 22 km, 10⁻⁵ at 50 km.
///
/// The origin is the south-west corner of the rectangle that is as wide as the region
/// along its middle parallel and as high as its middle meridian. Meridians converge,
/// so a corner of the region lies some metres from the rectangle's corner
/// (15 m for 0.3° at 22° N).
#[derive(Debug, Clone)]
pub struct LocalFrame {
    geodesic: Geodesic,
    region: Region,
    west_m: f64,
    south_m: f64,
    width_m: f64,
    height_m: f64,
}

impl LocalFrame {
    /// The local frame of a region.
    pub fn new(region: Region) -> Self {
        let geodesic = Geodesic::wgs84();
        let (longitude_deg, latitude_deg) = region.centre_deg();
        let distance_m = |longitude, latitude| -> f64 {
            geodesic.inverse(latitude_deg, longitude_deg, latitude, longitude)
        };
        let west_m = distance_m(region.west_deg, latitude_deg);
        let south_m = distance_m(longitude_deg, region.south_deg);
        let north_m = distance_m(longitude_deg, region.north_deg);
        Self {
            geodesic,
            region,
            west_m,
            south_m,
            width_m: 2.0 * west_m,
            height_m: south_m + north_m,
        }
    }

    /// The region this frame belongs to.
    pub fn region(&self) -> Region {
        self.region
    }

    /// Length of the rectangle from west to east, metres.
    pub fn width_m(&self) -> f64 {
        self.width_m
    }

    /// Length of the rectangle from south to north, metres.
    pub fn height_m(&self) -> f64 {
        self.height_m
    }

    /// Metres east and north of the origin, of a longitude and latitude in degrees.
    pub fn to_local(&self, longitude_deg: f64, latitude_deg: f64) -> (f64, f64) {
        let (centre_longitude, centre_latitude) = self.region.centre_deg();
        let (distance_m, azimuth_deg, _, _): (f64, f64, f64, f64) =
            self.geodesic.inverse(centre_latitude, centre_longitude, latitude_deg, longitude_deg);
        let (sin, cos) = azimuth_deg.to_radians().sin_cos();
        (self.west_m + distance_m * sin, self.south_m + distance_m * cos)
    }

    /// Longitude, in [-180, 180], and latitude, in degrees, of a point given in metres
    /// east and north of the origin.
    pub fn to_geographic(&self, east_m: f64, north_m: f64) -> (f64, f64) {
        let (centre_longitude, centre_latitude) = self.region.centre_deg();
        let (x, y) = (east_m - self.west_m, north_m - self.south_m);
        let azimuth_deg = x.atan2(y).to_degrees();
        let (latitude_deg, longitude_deg): (f64, f64) =
            self.geodesic.direct(centre_latitude, centre_longitude, azimuth_deg, x.hypot(y));
        (longitude_deg, latitude_deg)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLOPE: Region =
        Region { west_deg: 118.1, east_deg: 118.4, south_deg: 21.60, north_deg: 21.88 };

    /// WGS 84 lengths of the middle parallel's and meridian's arcs, from the closed
    /// forms a cos φ / √(1 − e² sin² φ) and ∫ a (1 − e²) / (1 − e² sin² φ)^1.5 dφ.
    #[test]
    fn the_rectangle_has_the_size_of_the_region() {
        let frame = LocalFrame::new(SLOPE);
        let (a, e2) = (6_378_137.0_f64, 0.006_694_379_990_14_f64);
        let w = |latitude: f64| 1.0 - e2 * latitude.to_radians().sin().powi(2);
        let parallel = a * 21.74_f64.to_radians().cos() / w(21.74).sqrt() * 0.3_f64.to_radians();
        let mean = [21.60, 21.74, 21.88].map(|latitude| w(latitude).powf(-1.5));
        let meridian =
            a * (1.0 - e2) * (mean[0] + 4.0 * mean[1] + mean[2]) / 6.0 * 0.28_f64.to_radians();
        // The geodesic cuts the parallel's arc: shorter by centimetres.
        assert!((frame.width_m() - parallel).abs() < 0.1, "{} {parallel}", frame.width_m());
        assert!((frame.height_m() - meridian).abs() < 1e-3, "{} {meridian}", frame.height_m());
        assert!((frame.width_m() / 30.0 - 1034.0).abs() < 1.0);
    }

    #[test]
    fn there_and_back_again() {
        let frame = LocalFrame::new(SLOPE);
        for (east_m, north_m) in [(0.0, 0.0), (31_000.0, 0.0), (-9_000.0, 40_000.0)] {
            let (longitude, latitude) = frame.to_geographic(east_m, north_m);
            let (east, north) = frame.to_local(longitude, latitude);
            assert!((east - east_m).abs() < 1e-6 && (north - north_m).abs() < 1e-6);
        }
    }

    #[test]
    fn distances_in_the_frame_are_geodesic_distances() {
        let frame = LocalFrame::new(SLOPE);
        let geodesic = Geodesic::wgs84();
        let corners = [(118.1, 21.60), (118.4, 21.60), (118.1, 21.88), (118.4, 21.88)];
        for (i, &(lon_a, lat_a)) in corners.iter().enumerate() {
            for &(lon_b, lat_b) in &corners[..i] {
                let along: f64 = geodesic.inverse(lat_a, lon_a, lat_b, lon_b);
                let (a, b) = (frame.to_local(lon_a, lat_a), frame.to_local(lon_b, lat_b));
                let flat = (a.0 - b.0).hypot(a.1 - b.1);
                assert!((flat - along).abs() < 0.1, "{flat} {along}");
            }
        }
    }

    #[test]
    fn a_region_across_the_antimeridian_is_continuous() {
        let frame = LocalFrame::new(Region {
            west_deg: 179.8,
            east_deg: -179.8,
            south_deg: -0.2,
            north_deg: 0.2,
        });
        let (before, _) = frame.to_local(179.999, 0.0);
        let (after, _) = frame.to_local(-179.999, 0.0);
        assert!(after > before && after - before < 250.0);
    }
}
