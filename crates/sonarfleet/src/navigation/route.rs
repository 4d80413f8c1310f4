//! Routes as data: where a vehicle went, and how it ended.

use crate::grid::Position;
use crate::record::TrackPoint;
use std::fmt;

/// A point of a route, with what holds from there to the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoutePoint {
    /// Hours since the run's start.
    pub time_h: f64,
    /// Where the vehicle is.
    pub position: Position,
    /// Commanded heading, clockwise from north, radians; at the last point the
    /// heading that led there.
    pub heading_rad: f64,
    /// Current [eastward, northward] at the point, m/s.
    pub current_m_s: [f64; 2],
}

impl RoutePoint {
    /// Speed over ground at this point for a vehicle of this speed through the
    /// water, m/s.
    pub fn speed_over_ground_m_s(&self, speed_through_water_m_s: f64) -> f64 {
        let (east, north) = self.heading_rad.sin_cos();
        let [u, v] = self.current_m_s;
        (u + speed_through_water_m_s * east).hypot(v + speed_through_water_m_s * north)
    }
}

/// The way of one vehicle toward one goal.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// Where it was sent.
    pub goal: Position,
    /// Points at every command and at the end; at least the start.
    pub points: Vec<RoutePoint>,
    /// How it ended.
    pub end: RouteEnd,
    /// Least distance to the goal on the way, m.
    pub closest_approach_m: f64,
}

impl Route {
    /// The last point.
    ///
    /// # Panics
    /// If someone emptied the points.
    pub fn last(&self) -> &RoutePoint {
        self.points.last().expect("a route holds at least its start")
    }

    /// From the first to the last point, hours.
    ///
    /// # Panics
    /// As [`Route::last`].
    pub fn duration_h(&self) -> f64 {
        self.last().time_h - self.points[0].time_h
    }

    /// Whether the vehicle is within the arrival radius of its goal.
    pub fn arrived(&self) -> bool {
        self.end == RouteEnd::Arrived
    }

    /// Why the goal was not reached, in words; none while it still may be.
    pub fn failure(&self) -> Option<String> {
        let closest_km = self.closest_approach_m / 1000.0;
        match self.end {
            RouteEnd::Arrived | RouteEnd::UnderWay => None,
            end => Some(format!("{end}; closest approach {closest_km:.1} km")),
        }
    }

    /// The points as the record of a run holds them.
    pub fn track(&self) -> Vec<TrackPoint> {
        let track_point =
            |point: &RoutePoint| TrackPoint { time_h: point.time_h, position: point.position };
        self.points.iter().map(track_point).collect()
    }
}

/// How a route ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RouteEnd {
    /// Within the arrival radius of the goal.
    Arrived,
    /// The time to follow it was over before it arrived.
    UnderWay,
    /// The goal cannot be reached.
    Unreachable(Unreachable),
    /// It drifted or steered out of the domain of transit.
    LeftDomain,
    /// It ran aground.
    RanAground,
}

impl fmt::Display for RouteEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Arrived => write!(f, "arrived"),
            Self::UnderWay => write!(f, "under way"),
            Self::Unreachable(reason) => write!(f, "unreachable: {reason}"),
            Self::LeftDomain => write!(f, "left the transit domain"),
            Self::RanAground => write!(f, "ran aground"),
        }
    }
}

/// Why a goal cannot be reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unreachable {
    /// The vehicle is where it may not be.
    Start(Obstacle),
    /// The goal is where no vehicle may be.
    Goal(Obstacle),
    /// The currents do not let the vehicle there within the horizon.
    OutOfTime {
        /// The horizon, hours.
        horizon_h: f64,
    },
    /// The currents take the vehicle out of the domain or aground whatever it does.
    SweptAway,
}

impl fmt::Display for Unreachable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start(obstacle) => write!(f, "the vehicle is {obstacle}"),
            Self::Goal(obstacle) => write!(f, "the goal is {obstacle}"),
            Self::OutOfTime { horizon_h } => {
                write!(f, "not within {horizon_h} h against these currents")
            }
            Self::SweptAway => write!(f, "the currents sweep the vehicle out of the domain"),
        }
    }
}

/// Where no vehicle may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Obstacle {
    /// Beyond the wall around the domain of transit.
    OutsideDomain,
    /// On land, or where the water is shallower than the vehicles' depth.
    Land,
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutsideDomain => write!(f, "outside the transit domain"),
            Self::Land => write!(f, "on land or in water shallower than the vehicles' depth"),
        }
    }
}
