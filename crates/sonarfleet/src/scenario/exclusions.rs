//! Areas where no vehicle may be placed, from `GeoJSON` polygons.

use geojson::{GeoJson, GeometryValue};

/// A polygon with holes: rings of [longitude, latitude] in degrees, the first one outside.
type Polygon = Vec<Vec<[f64; 2]>>;

/// Polygons on the longitude–latitude plane.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Exclusions {
    polygons: Vec<Polygon>,
}

impl Exclusions {
    /// Reads all polygons of a `GeoJSON` text, wherever they are nested.
    ///
    /// # Errors
    /// Returns what is wrong in words if the text is not `GeoJSON` or has no polygon.
    pub fn parse(text: &str) -> Result<Self, String> {
        let document: GeoJson = text.parse().map_err(|error| format!("not GeoJSON: {error}"))?;
        let mut exclusions = Self::default();
        match document {
            GeoJson::Geometry(geometry) => exclusions.collect(geometry.value),
            GeoJson::Feature(feature) => {
                feature.geometry.into_iter().for_each(|g| exclusions.collect(g.value));
            }
            GeoJson::FeatureCollection(collection) => collection
                .features
                .into_iter()
                .filter_map(|feature| feature.geometry)
                .for_each(|geometry| exclusions.collect(geometry.value)),
        }
        if exclusions.polygons.is_empty() {
            return Err("holds no polygon".into());
        }
        Ok(exclusions)
    }

    fn collect(&mut self, value: GeometryValue) {
        let rings = |polygon: geojson::PolygonType| -> Polygon {
            polygon
                .into_iter()
                .map(|ring| ring.iter().map(|point| [point[0], point[1]]).collect())
                .collect()
        };
        match value {
            GeometryValue::Polygon { coordinates } => self.polygons.push(rings(coordinates)),
            GeometryValue::MultiPolygon { coordinates } => {
                self.polygons.extend(coordinates.into_iter().map(rings));
            }
            GeometryValue::GeometryCollection { geometries } => {
                for geometry in geometries {
                    self.collect(geometry.value);
                }
            }
            _ => {}
        }
    }

    /// Whether a point lies in one of the polygons (even–odd rule, so holes are free).
    pub fn contain(&self, longitude_deg: f64, latitude_deg: f64) -> bool {
        self.polygons.iter().any(|polygon| {
            polygon.iter().filter(|ring| encloses(ring, longitude_deg, latitude_deg)).count() % 2
                == 1
        })
    }
}

/// Even–odd test of a point against one closed ring.
fn encloses(ring: &[[f64; 2]], x: f64, y: f64) -> bool {
    ring.iter()
        .zip(ring.iter().cycle().skip(1))
        .filter(|([x0, y0], [x1, y1])| {
            (*y0 > y) != (*y1 > y) && x < (x1 - x0) * (y - y0) / (y1 - y0) + x0
        })
        .count()
        % 2
        == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE_WITH_HOLE: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature",
        "properties":{},"geometry":{"type":"Polygon","coordinates":[
        [[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[2,1],[2,2],[1,2],[1,1]]]}}]}"#;

    #[test]
    fn a_hole_is_not_excluded() {
        let area = Exclusions::parse(SQUARE_WITH_HOLE).unwrap();
        assert!(area.contain(3.0, 3.0));
        assert!(!area.contain(1.5, 1.5));
        assert!(!area.contain(5.0, 1.0));
    }

    #[test]
    fn says_what_is_wrong() {
        assert!(Exclusions::parse("{").unwrap_err().contains("not GeoJSON"));
        let point = r#"{"type":"Point","coordinates":[1,2]}"#;
        assert!(Exclusions::parse(point).unwrap_err().contains("no polygon"));
    }
}
