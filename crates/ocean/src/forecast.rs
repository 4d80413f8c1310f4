//! The ocean over time.

use crate::{OceanError, OceanState, Quantity};
use jiff::Timestamp;

/// Ocean states over time, on one grid, times ascending.
#[derive(Debug, Clone)]
pub struct Forecast {
    /// The states; not empty, times strictly ascending.
    pub states: Vec<OceanState>,
}

impl Forecast {
    /// First and last time.
    ///
    /// # Errors
    /// [`OceanError::NoTimeSteps`] if the forecast is empty.
    pub fn span(&self) -> Result<(Timestamp, Timestamp), OceanError> {
        match (self.states.first(), self.states.last()) {
            (Some(first), Some(last)) => Ok((first.time, last.time)),
            _ => Err(OceanError::NoTimeSteps { files: Vec::new() }),
        }
    }

    /// The ocean at a time, linear between the states before and after. A node that is
    /// land in one of them is land in the result.
    ///
    /// # Errors
    /// [`OceanError::TimeOutsideData`] before the first or after the last state.
    pub fn at(&self, time: Timestamp) -> Result<OceanState, OceanError> {
        let (start, end) = self.span()?;
        if time < start || time > end {
            return Err(OceanError::TimeOutsideData { asked: time, start, end });
        }
        let after = self.states.partition_point(|state| state.time < time);
        let later = &self.states[after];
        if later.time == time {
            return Ok(later.clone());
        }
        let earlier = &self.states[after - 1];
        let seconds = |from: Timestamp, to: Timestamp| to.duration_since(from).as_secs_f64();
        let weight = seconds(earlier.time, time) / seconds(earlier.time, later.time);
        let blend = |quantity| -> Vec<f32> {
            let (a, b) = (earlier.values(quantity), later.values(quantity));
            let mix =
                |a: f32, b: f32| (f64::from(a) * (1.0 - weight) + f64::from(b) * weight) as f32;
            a.iter().zip(b).map(|(&a, &b)| mix(a, b)).collect()
        };
        Ok(OceanState {
            grid: earlier.grid.clone(),
            time,
            temperature_c: blend(Quantity::Temperature),
            salinity_psu: blend(Quantity::Salinity),
            current_east_m_s: blend(Quantity::CurrentEast),
            current_north_m_s: blend(Quantity::CurrentNorth),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::OceanGrid;
    use std::sync::Arc;

    fn forecast() -> Forecast {
        let grid = Arc::new(OceanGrid {
            longitude_deg: vec![0.0],
            latitude_deg: vec![0.0],
            depth_m: vec![0.0, 1.0],
        });
        let state = |hour: i64, value: f32| OceanState {
            grid: grid.clone(),
            time: Timestamp::from_second(hour * 3600).unwrap(),
            temperature_c: vec![value, f32::NAN],
            salinity_psu: Vec::new(),
            current_east_m_s: Vec::new(),
            current_north_m_s: Vec::new(),
        };
        Forecast { states: vec![state(0, 1.0), state(6, 4.0), state(18, 10.0)] }
    }

    #[test]
    fn time_is_interpolated_linearly() {
        let forecast = forecast();
        for (hour, expected) in [(0, 1.0), (2, 2.0), (6, 4.0), (12, 7.0), (18, 10.0)] {
            let state = forecast.at(Timestamp::from_second(hour * 3600).unwrap()).unwrap();
            assert!((state.temperature_c[0] - expected).abs() < 1e-6);
            assert!(state.temperature_c[1].is_nan());
            assert!(state.salinity_psu.is_empty());
        }
    }

    #[test]
    fn outside_the_span_is_an_error() {
        for second in [-1, 18 * 3600 + 1] {
            let asked = Timestamp::from_second(second).unwrap();
            assert!(matches!(forecast().at(asked), Err(OceanError::TimeOutsideData { .. })));
        }
        let empty = Forecast { states: Vec::new() };
        assert!(matches!(empty.span(), Err(OceanError::NoTimeSteps { .. })));
    }
}
