//! Times of CF files: numbers since an epoch.

use super::source::{DataSource, VariableInfo};
use crate::OceanError;
use jiff::Timestamp;
use jiff::civil::{Date, Time};
use jiff::tz::TimeZone;

/// Calendars that agree with UTC's after 1582.
const CALENDARS: [&str; 3] = ["standard", "gregorian", "proleptic_gregorian"];

/// Times are rounded to this fraction of a second: `f64` days resolve no more.
const TICKS_PER_SECOND: f64 = 1000.0;

/// The times that numbers with a CF unit ("hours since 1950-01-01") mean.
pub(crate) fn decode(
    source: &dyn DataSource,
    variable: &VariableInfo,
    values: &[f64],
) -> Result<Vec<Timestamp>, OceanError> {
    let units = variable.text("units").unwrap_or("");
    let calendar = variable.text("calendar").unwrap_or("standard").to_lowercase();
    let error = || OceanError::TimeUnits {
        path: source.path().to_owned(),
        variable: variable.name.clone(),
        units: units.to_owned(),
        calendar: calendar.clone(),
    };
    if !CALENDARS.contains(&calendar.as_str()) {
        return Err(error());
    }
    let (unit_s, epoch) = parse_units(units).ok_or_else(error)?;
    values.iter().map(|&value| at(epoch, value * unit_s).ok_or_else(error)).collect()
}

fn at(epoch: Timestamp, seconds: f64) -> Option<Timestamp> {
    let ticks = (seconds * TICKS_PER_SECOND).round();
    // Beyond ±2⁵³ milliseconds lie only fill values and damage.
    if ticks.is_nan() || ticks.abs() > 9e15 {
        return None;
    }
    epoch.checked_add(jiff::SignedDuration::from_millis(ticks as i64)).ok()
}

/// Length of the unit in seconds, and the epoch, of "unit since date [time [zone]]".
fn parse_units(units: &str) -> Option<(f64, Timestamp)> {
    let (unit, since) = units.split_once(" since ")?;
    let unit_s = match unit.trim().to_lowercase().as_str() {
        "days" | "day" | "d" => 86_400.0,
        "hours" | "hour" | "hrs" | "hr" | "h" => 3_600.0,
        "minutes" | "minute" | "mins" | "min" => 60.0,
        "seconds" | "second" | "secs" | "sec" | "s" => 1.0,
        "milliseconds" | "millisecond" | "msec" | "ms" => 1e-3,
        "microseconds" | "microsecond" => 1e-6,
        "nanoseconds" | "nanosecond" | "ns" => 1e-9,
        _ => return None,
    };
    let since = since.replace("UTC", " ").replace(['T', 'Z'], " ");
    let mut words = since.split_whitespace();
    let mut date = words.next()?.splitn(3, '-').map(str::parse::<i16>);
    let mut next = || date.next()?.ok();
    let (year, month, day) = (next()?, next()?, next()?);
    let date = Date::new(year, i8::try_from(month).ok()?, i8::try_from(day).ok()?).ok()?;
    // Before, the standard calendar is the Julian one.
    if date < Date::constant(1582, 10, 15) {
        return None;
    }
    let time = match words.next() {
        Some(text) => parse_time(text)?,
        None => Time::midnight(),
    };
    if words.next().is_some_and(|zone| !matches!(zone, "+00:00" | "+0000" | "+00" | "0" | "0:00")) {
        return None;
    }
    let epoch = date.to_datetime(time).to_zoned(TimeZone::UTC).ok()?.timestamp();
    Some((unit_s, epoch))
}

/// "hh[:mm[:ss[.f]]]", fractions of a second dropped.
fn parse_time(text: &str) -> Option<Time> {
    let mut parts = text.trim_end_matches("+00:00").split(':');
    let mut next = || match parts.next() {
        Some(part) => part.split('.').next()?.parse::<i8>().ok(),
        None => Some(0),
    };
    Time::new(next()?, next()?, next()?, 0).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(units: &str, value: f64) -> Option<String> {
        let (unit_s, epoch) = parse_units(units)?;
        Some(at(epoch, value * unit_s)?.to_string())
    }

    #[test]
    fn the_units_of_the_dialects() {
        let expected = Some("2025-10-09T06:00:00Z".to_owned());
        for (units, value) in [
            ("hours since 1950-01-01", 664_206.0),
            ("hours since 1950-01-01 00:00:00", 664_206.0),
            ("seconds since 1970-01-01", 1_759_989_600.0),
            ("seconds since 1970-01-01T00:00:00Z", 1_759_989_600.0),
            ("hours since 2000-01-01 00:00:00.0", 225_918.0),
            ("days since 1950-1-1", 27_675.25),
            ("days since 1950-01-01 06:00:00 UTC", 27_675.0),
            ("minutes since 2025-10-09 00:00:00 +00:00", 360.0),
        ] {
            assert_eq!(decoded(units, value), expected, "{units}");
        }
    }

    #[test]
    fn what_is_not_a_time_is_refused() {
        for units in
            ["", "hours", "months since 1950-01-01", "days since 0001-01-01", "days since x"]
        {
            assert_eq!(decoded(units, 1.0), None, "{units}");
        }
        assert_eq!(decoded("days since 1950-01-01", f64::NAN), None);
        assert_eq!(decoded("hours since 1950-01-01", 9.969_21e36), None);
    }
}
