//! What moves, and where it may.

use super::{CurrentField, NavigationError};
use crate::grid::Position;

/// Seconds in an hour: speeds are in m/s, times in hours.
pub(super) const SECONDS_PER_HOUR: f64 = 3600.0;

/// A vehicle that keeps its speed through the water and steers by commanded
/// headings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vehicle {
    speed_m_s: f64,
    arrival_radius_m: f64,
    command_interval_h: f64,
}

impl Vehicle {
    /// A vehicle with its speed through the water (m/s), the distance at which it
    /// has arrived (m), and the time between two commands (h).
    ///
    /// # Errors
    /// A number that is not finite and positive.
    pub fn new(
        speed_m_s: f64,
        arrival_radius_m: f64,
        command_interval_h: f64,
    ) -> Result<Self, NavigationError> {
        for (quantity, found) in [
            ("the vehicle's speed in m/s", speed_m_s),
            ("the arrival radius in m", arrival_radius_m),
            ("the command interval in h", command_interval_h),
        ] {
            positive(quantity, found)?;
        }
        Ok(Self { speed_m_s, arrival_radius_m, command_interval_h })
    }

    /// Speed through the water, m/s.
    pub const fn speed_m_s(&self) -> f64 {
        self.speed_m_s
    }

    /// Speed through the water, m/h.
    pub(super) const fn speed_m_h(&self) -> f64 {
        self.speed_m_s * SECONDS_PER_HOUR
    }

    /// Distance from the goal at which the vehicle has arrived, m.
    pub const fn arrival_radius_m(&self) -> f64 {
        self.arrival_radius_m
    }

    /// Time between two commands, h.
    pub const fn command_interval_h(&self) -> f64 {
        self.command_interval_h
    }

    /// Hours to the arrival disc around a point `distance_m` away in still water.
    pub fn still_water_time_h(&self, distance_m: f64) -> f64 {
        (distance_m - self.arrival_radius_m).max(0.0) / self.speed_m_h()
    }
}

/// The rectangle in which vehicles may transit: the region and a margin around it.
/// Its edge is a hard wall: a route that crosses it has failed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransitDomain {
    south_west: Position,
    north_east: Position,
}

impl TransitDomain {
    /// A region of the given size with a margin on all sides, all in metres.
    ///
    /// # Errors
    /// A size that is not positive, or a negative margin.
    pub fn around_region(
        width_m: f64,
        height_m: f64,
        margin_m: f64,
    ) -> Result<Self, NavigationError> {
        positive("the region's width in m", width_m)?;
        positive("the region's height in m", height_m)?;
        if !(margin_m.is_finite() && margin_m >= 0.0) {
            let quantity = "the transit margin in m";
            let expected = "finite and not negative";
            return Err(NavigationError::OutOfRange { quantity, expected, found: margin_m });
        }
        Ok(Self {
            south_west: Position::new(-margin_m, -margin_m),
            north_east: Position::new(width_m + margin_m, height_m + margin_m),
        })
    }

    /// South-west corner.
    pub const fn south_west(&self) -> Position {
        self.south_west
    }

    /// North-east corner.
    pub const fn north_east(&self) -> Position {
        self.north_east
    }

    /// Extent from west to east, m.
    pub const fn width_m(&self) -> f64 {
        self.north_east.east_m - self.south_west.east_m
    }

    /// Extent from south to north, m.
    pub const fn height_m(&self) -> f64 {
        self.north_east.north_m - self.south_west.north_m
    }

    /// How far a point is beyond the rectangle that lies `clearance_m` inside this
    /// one, m; 0 inside it.
    pub(super) fn beyond_m(&self, point: Position, clearance_m: f64) -> f64 {
        let beyond = |at: f64, low: f64, high: f64| {
            (low + clearance_m - at).max(at - (high - clearance_m)).max(0.0)
        };
        let east_m = beyond(point.east_m, self.south_west.east_m, self.north_east.east_m);
        let north_m = beyond(point.north_m, self.south_west.north_m, self.north_east.north_m);
        east_m.hypot(north_m)
    }

    /// Whether a point is inside.
    pub fn contains(&self, point: Position) -> bool {
        (self.south_west.east_m..=self.north_east.east_m).contains(&point.east_m)
            && (self.south_west.north_m..=self.north_east.north_m).contains(&point.north_m)
    }
}

/// Where vehicles move: the current and the domain of transit.
#[derive(Debug, Clone, Copy)]
pub struct Waters<'a> {
    /// The current at the vehicles' depth.
    pub currents: &'a CurrentField,
    /// Where transit is allowed.
    pub domain: TransitDomain,
}

impl Waters<'_> {
    /// Why a vehicle cannot be at a point, if it cannot.
    pub(super) fn obstacle(&self, point: Position) -> Option<super::Obstacle> {
        if !self.domain.contains(point) {
            Some(super::Obstacle::OutsideDomain)
        } else if self.currents.is_land(point) {
            Some(super::Obstacle::Land)
        } else {
            None
        }
    }
}

/// Refuses a number that is not finite and positive.
pub(super) fn positive(quantity: &'static str, found: f64) -> Result<(), NavigationError> {
    if found.is_finite() && found > 0.0 {
        Ok(())
    } else {
        let expected = "finite and positive";
        Err(NavigationError::OutOfRange { quantity, expected, found })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_vehicles_and_domains_are_refused() {
        for (speed, radius, interval) in
            [(0.0, 500.0, 1.0), (0.23, f64::NAN, 1.0), (0.23, 500.0, -1.0)]
        {
            assert!(Vehicle::new(speed, radius, interval).is_err());
        }
        assert!(TransitDomain::around_region(1e3, 0.0, 0.0).is_err());
        assert!(TransitDomain::around_region(1e3, 1e3, -1.0).is_err());
    }

    #[test]
    fn the_domain_is_the_region_and_its_margin() {
        let domain = TransitDomain::around_region(30_000.0, 20_000.0, 10_000.0).unwrap();
        assert!(domain.contains(Position::new(-10_000.0, 30_000.0)));
        assert!(!domain.contains(Position::new(0.0, 30_000.1)));
        assert!((domain.width_m() - 50_000.0).abs() < 1e-9);
    }
}
