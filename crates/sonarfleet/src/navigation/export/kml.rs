//! KML 2.2 with the `gx:Track` extension, which carries times.

use super::Line;
use super::xml::escape;
use std::fmt::Write;

pub(super) fn text(lines: &[Line<'_>]) -> String {
    let mut text = String::from(concat!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n",
        "<kml xmlns=\"http://www.opengis.net/kml/2.2\" ",
        "xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n<Document>\n",
    ));
    for line in lines {
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "<Placemark>\n<name>{}</name>\n<description>{}</description>\n<gx:Track>\n",
            escape(line.name),
            escape(line.status)
        );
        for point in &line.points {
            let _ = writeln!(text, "<when>{}</when>", point.time);
        }
        for point in &line.points {
            let (longitude, latitude) = (point.longitude_deg, point.latitude_deg);
            let _ = writeln!(text, "<gx:coord>{longitude:.6} {latitude:.6} 0</gx:coord>");
        }
        text.push_str("</gx:Track>\n</Placemark>\n");
    }
    text.push_str("</Document>\n</kml>\n");
    text
}
