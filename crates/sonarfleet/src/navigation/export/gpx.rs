//! GPX 1.1.

use super::Line;
use super::xml::escape;
use std::fmt::Write;

pub(super) fn text(lines: &[Line<'_>]) -> String {
    let mut text = String::from(concat!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n",
        "<gpx version=\"1.1\" creator=\"sonarfleet\" ",
        "xmlns=\"http://www.topografix.com/GPX/1/1\">\n",
    ));
    for line in lines {
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "<trk>\n<name>{}</name>\n<desc>{}</desc>\n<trkseg>\n",
            escape(line.name),
            escape(line.status)
        );
        for point in &line.points {
            let _ = writeln!(
                text,
                "<trkpt lat=\"{:.6}\" lon=\"{:.6}\"><time>{}</time></trkpt>",
                point.latitude_deg, point.longitude_deg, point.time
            );
        }
        text.push_str("</trkseg>\n</trk>\n");
    }
    text.push_str("</gpx>\n");
    text
}
