//! `GeoJSON`, RFC 7946.

use super::Line;
use serde_json::{Value, json};

pub(super) fn text(lines: &[Line<'_>]) -> String {
    let features: Vec<Value> = lines.iter().map(feature).collect();
    let mut text = json!({ "type": "FeatureCollection", "features": features }).to_string();
    text.push('\n');
    text
}

fn feature(line: &Line<'_>) -> Value {
    let coordinates: Vec<[f64; 2]> =
        line.points.iter().map(|point| [point.longitude_deg, point.latitude_deg]).collect();
    // A line has at least two positions.
    let geometry = match coordinates[..] {
        [] => Value::Null,
        [place] => json!({ "type": "Point", "coordinates": place }),
        _ => json!({ "type": "LineString", "coordinates": coordinates }),
    };
    let times: Vec<String> = line.points.iter().map(|point| point.time.to_string()).collect();
    json!({
        "type": "Feature",
        "geometry": geometry,
        "properties": { "name": line.name, "status": line.status, "times": times },
    })
}
