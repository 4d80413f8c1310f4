//! Comma-separated values, quoted as RFC 4180 says.

use super::{Line, Point};
use std::fmt::Write;

const SECONDS_PER_HOUR: f64 = 3600.0;

pub(super) fn text(lines: &[Line<'_>]) -> String {
    let mut text = String::from(
        "route,status,time,time_h,longitude_deg,latitude_deg,east_m,north_m,\
         speed_over_ground_m_s\n",
    );
    for line in lines {
        let (name, status) = (quoted(line.name), quoted(line.status));
        for (index, point) in line.points.iter().enumerate() {
            let speed = speed_over_ground(&line.points, index);
            let position = point.track.position;
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{name},{status},{},{:.4},{:.6},{:.6},{:.1},{:.1},{speed}",
                point.time,
                point.track.time_h,
                point.longitude_deg,
                point.latitude_deg,
                position.east_m,
                position.north_m,
            );
        }
    }
    text
}

/// Mean speed over ground on the leg that ends at a point, on the first leg for the
/// first point; empty for a route of one point.
fn speed_over_ground(points: &[Point], index: usize) -> String {
    let end = index.max(1);
    let Some(to) = points.get(end) else { return String::new() };
    let (from, to) = (points[end - 1].track, to.track);
    let seconds = (to.time_h - from.time_h) * SECONDS_PER_HOUR;
    if seconds > 0.0 {
        format!("{:.4}", from.position.distance_m(to.position) / seconds)
    } else {
        String::new()
    }
}

fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}
