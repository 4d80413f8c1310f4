//! Routes for charts, GIS and spreadsheets.

mod csv;
mod geojson;
mod gpx;
mod kml;
mod xml;

use super::NavigationError;
use crate::record::TrackPoint;
use jiff::{SignedDuration, Timestamp};
use sonarfleet_ocean::LocalFrame;
use std::path::Path;

/// A route to be written: its name, how it stands ("arrived", "under way", …), and
/// its points, at least one.
#[derive(Debug, Clone, Copy)]
pub struct NamedRoute<'a> {
    /// Name, for example "vehicle 7".
    pub name: &'a str,
    /// How it stands, in words.
    pub status: &'a str,
    /// The points, in order of time.
    pub points: &'a [TrackPoint],
}

/// A file format for routes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RouteFormat {
    /// `GeoJSON` (RFC 7946): a line per route, times in its properties.
    GeoJson,
    /// KML 2.2: a track with times per route.
    Kml,
    /// GPX 1.1: a track with times per route.
    Gpx,
    /// Comma-separated values: a row per point.
    Csv,
}

impl RouteFormat {
    /// The format of a file by its extension.
    ///
    /// # Errors
    /// An extension that is none of `.geojson`, `.kml`, `.gpx` and `.csv`.
    pub fn of_path(path: &Path) -> Result<Self, NavigationError> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("geojson" | "json") => Ok(Self::GeoJson),
            Some("kml") => Ok(Self::Kml),
            Some("gpx") => Ok(Self::Gpx),
            Some("csv") => Ok(Self::Csv),
            _ => Err(NavigationError::UnknownRouteFormat {
                path: path.to_path_buf(),
                known: ".geojson, .kml, .gpx, .csv",
            }),
        }
    }

    /// The text of a file that holds these routes. `run_start` is the time of hour 0.
    ///
    /// # Errors
    /// A time outside the calendar.
    pub fn text(
        self,
        routes: &[NamedRoute<'_>],
        frame: &LocalFrame,
        run_start: Timestamp,
    ) -> Result<String, NavigationError> {
        let lines: Vec<Line<'_>> = routes
            .iter()
            .map(|route| Line::new(route, frame, run_start))
            .collect::<Result<_, _>>()?;
        Ok(match self {
            Self::GeoJson => geojson::text(&lines),
            Self::Kml => kml::text(&lines),
            Self::Gpx => gpx::text(&lines),
            Self::Csv => csv::text(&lines),
        })
    }
}

/// Writes routes in the format that the file's extension names.
///
/// # Errors
/// An unknown extension, a time outside the calendar, or a file that cannot be written.
pub fn write_routes(
    path: impl AsRef<Path>,
    routes: &[NamedRoute<'_>],
    frame: &LocalFrame,
    run_start: Timestamp,
) -> Result<(), NavigationError> {
    let path = path.as_ref();
    let text = RouteFormat::of_path(path)?.text(routes, frame, run_start)?;
    crate::replace_file(path, text.as_bytes())
        .map_err(|source| NavigationError::Write { path: path.to_path_buf(), source })
}

/// A route in geographic coordinates and calendar time.
struct Line<'a> {
    name: &'a str,
    status: &'a str,
    points: Vec<Point>,
}

struct Point {
    /// To the second.
    time: Timestamp,
    longitude_deg: f64,
    latitude_deg: f64,
    track: TrackPoint,
}

impl<'a> Line<'a> {
    fn new(
        route: &NamedRoute<'a>,
        frame: &LocalFrame,
        run_start: Timestamp,
    ) -> Result<Self, NavigationError> {
        let point = |&track: &TrackPoint| {
            let (longitude_deg, latitude_deg) =
                frame.to_geographic(track.position.east_m, track.position.north_m);
            let time = calendar_time(run_start, track.time_h)?;
            Ok(Point { time, longitude_deg, latitude_deg, track })
        };
        let points = route.points.iter().map(point).collect::<Result<_, NavigationError>>()?;
        Ok(Self { name: route.name, status: route.status, points })
    }
}

/// The calendar time some hours after the run's start, to the second.
fn calendar_time(run_start: Timestamp, hours: f64) -> Result<Timestamp, NavigationError> {
    const SECONDS_PER_HOUR: f64 = 3600.0;
    let seconds = (hours * SECONDS_PER_HOUR).round();
    let no_date = NavigationError::NoDate { start: run_start, hours };
    if !seconds.is_finite() {
        return Err(no_date);
    }
    run_start.checked_add(SignedDuration::from_secs(seconds as i64)).map_err(|_| no_date)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Position;
    use sonarfleet_ocean::Region;

    fn frame() -> LocalFrame {
        LocalFrame::new(Region {
            west_deg: 118.1,
            east_deg: 118.4,
            south_deg: 21.6,
            north_deg: 21.88,
        })
    }

    fn text(format: RouteFormat) -> String {
        let at = |time_h, east_m| TrackPoint { time_h, position: Position::new(east_m, 0.0) };
        let points = [at(0.0, 0.0), at(1.0, 828.0), at(1.5, 1242.0)];
        let odd = r#"<7> & "seven", it's"#;
        let routes = [
            NamedRoute { name: odd, status: "arrived", points: &points },
            NamedRoute { name: "8", status: "under way", points: &points[..1] },
        ];
        format.text(&routes, &frame(), "2025-10-09T00:00:00Z".parse().unwrap()).unwrap()
    }

    #[test]
    fn geojson_reads_back() {
        let json: serde_json::Value = serde_json::from_str(&text(RouteFormat::GeoJson)).unwrap();
        assert_eq!(json["type"], "FeatureCollection");
        let first = &json["features"][0];
        assert_eq!(first["properties"]["name"], r#"<7> & "seven", it's"#);
        assert_eq!(first["properties"]["times"][2], "2025-10-09T01:30:00Z");
        assert_eq!(first["geometry"]["type"], "LineString");
        let [longitude, latitude] = [0, 1].map(|i| first["geometry"]["coordinates"][0][i].as_f64());
        assert!((longitude.unwrap() - 118.1).abs() < 1e-3);
        assert!((latitude.unwrap() - 21.6).abs() < 1e-3);
        assert_eq!(json["features"][1]["geometry"]["type"], "Point");
    }

    #[test]
    fn xml_is_escaped_and_balanced() {
        for format in [RouteFormat::Kml, RouteFormat::Gpx] {
            let text = text(format);
            assert!(text.contains("&lt;7&gt; &amp; &quot;seven&quot;, it&apos;s"), "{text}");
            assert!(text.contains("2025-10-09T01:30:00Z"));
            let mut open = Vec::new();
            for tag in text.split('<').skip(1).map(|tag| tag.split('>').next().unwrap()) {
                if let Some(name) = tag.strip_prefix('/') {
                    assert_eq!(open.pop(), Some(name), "{text}");
                } else if !tag.ends_with('/') && !tag.starts_with('?') {
                    open.push(tag.split(' ').next().unwrap());
                }
            }
            assert!(open.is_empty(), "{open:?} not closed in {text}");
        }
    }

    #[test]
    fn csv_has_a_row_per_point() {
        let text = text(RouteFormat::Csv);
        let rows: Vec<&str> = text.lines().collect();
        assert_eq!(rows.len(), 5);
        assert!(rows[0].starts_with("route,status,time,time_h,longitude_deg,latitude_deg"));
        assert!(
            rows[1].starts_with(
                r#""<7> & ""seven"", it's",arrived,2025-10-09T00:00:00Z,0.0000,118.1"#
            )
        );
        assert!(rows[2].ends_with(",828.0,0.0,0.2300"), "{}", rows[2]);
        assert!(rows[4].ends_with(",0.0,0.0,"), "one point has no speed: {}", rows[4]);
    }

    #[test]
    fn what_cannot_be_written_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let start: Timestamp = "2025-10-09T00:00:00Z".parse().unwrap();
        let write = |name: &str| write_routes(folder.path().join(name), &[], &frame(), start);
        assert!(matches!(write("a.shp"), Err(NavigationError::UnknownRouteFormat { .. })));
        assert!(matches!(write("no/where.kml"), Err(NavigationError::Write { .. })));
        let late = TrackPoint { time_h: 1e9, position: Position::new(0.0, 0.0) };
        let route = NamedRoute { name: "late", status: "under way", points: &[late] };
        let text = RouteFormat::Csv.text(&[route], &frame(), start);
        assert!(matches!(text, Err(NavigationError::NoDate { .. })));
    }
}
