//! The contract between whoever plans routes and whoever sails them.

use super::{
    CurrentField, NavigationError, Route, RouteEnd, TravelTime, TravelTimes, Unreachable, Vehicle,
    Waters, sail,
};
use crate::grid::Position;
use rayon::prelude::*;

/// A way of planning: from what is known of the currents to headings.
///
/// Planning has three stages, so that a planner that solves for everything at once,
/// one that searches a path, and one that learned to react all fit: a [`Planner`]
/// holds settings; its [`Plan`] what was computed for a set of goals from one
/// departure; a [`Pilot`] the memory of one vehicle on its way.
pub trait Planner: Send + Sync {
    /// Name, as in scenarios and records.
    fn name(&self) -> &'static str;

    /// Plans for all goals at once, leaving at `departure_h` (hours since the run's
    /// start), through `waters` as they are forecast.
    ///
    /// # Errors
    /// No goals, or a goal without finite coordinates. Goals that cannot be reached
    /// are no errors: see [`Plan::travel_times`].
    fn prepare<'a>(
        &self,
        waters: Waters<'a>,
        vehicle: Vehicle,
        goals: &[Position],
        departure_h: f64,
    ) -> Result<Box<dyn Plan + 'a>, NavigationError>;
}

/// A plan for a set of goals.
pub trait Plan: Send + Sync {
    /// The currents, domain, vehicle, goals and times it was made for.
    fn voyage(&self) -> &Voyage<'_>;

    /// Expected travel times from each start, leaving at the plan's departure, to
    /// each goal: [start, goal].
    fn travel_times(&self, starts: &[Position]) -> TravelTimes;

    /// A pilot for one vehicle bound for one goal.
    fn pilot(&self, goal: usize) -> Box<dyn Pilot + '_>;

    /// Follows the plan from a place toward a goal, through the waters it was made
    /// for, from `start_h` until `until_h` or the plan's horizon, whichever is
    /// first. To go on later, follow again from where the route ended: up to the
    /// horizon this gives the planned remainder.
    fn follow(&self, goal: usize, from: Position, start_h: f64, until_h: f64) -> Route {
        let voyage = self.voyage();
        let mut pilot = self.pilot(goal);
        let until_h = until_h.min(voyage.deadline_h());
        let target = voyage.goals[goal];
        let mut route =
            sail(voyage.waters, voyage.vehicle, pilot.as_mut(), target, from, start_h, until_h);
        if route.end == RouteEnd::UnderWay && until_h >= voyage.deadline_h() {
            let horizon_h = voyage.horizon_h;
            route.end = RouteEnd::Unreachable(Unreachable::OutOfTime { horizon_h });
        }
        route
    }
}

/// Steers one vehicle; may remember what it has seen.
pub trait Pilot {
    /// The heading to hold until the next command, clockwise from north, radians.
    fn heading_rad(&mut self, observation: &Observation) -> f64;
}

/// What a vehicle knows of itself when it asks for a command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    /// Hours since the run's start.
    pub time_h: f64,
    /// Where it is.
    pub position: Position,
    /// The current it measures there, [eastward, northward], m/s.
    pub current_m_s: [f64; 2],
}

/// What a plan is made for.
#[derive(Debug, Clone)]
pub struct Voyage<'a> {
    /// The currents as forecast, and the domain.
    pub waters: Waters<'a>,
    /// What moves.
    pub vehicle: Vehicle,
    /// Where to.
    pub goals: Vec<Position>,
    /// Departure, hours since the run's start.
    pub departure_h: f64,
    /// Longest travel considered, hours.
    pub horizon_h: f64,
}

impl<'a> Voyage<'a> {
    /// A checked voyage.
    ///
    /// # Errors
    /// No goals, a goal without finite coordinates, or a horizon that is not positive.
    pub fn new(
        waters: Waters<'a>,
        vehicle: Vehicle,
        goals: &[Position],
        departure_h: f64,
        horizon_h: f64,
    ) -> Result<Self, NavigationError> {
        if goals.is_empty() {
            return Err(NavigationError::NoGoals);
        }
        let invalid = |goal: &Position| !(goal.east_m.is_finite() && goal.north_m.is_finite());
        if let Some(goal) = goals.iter().position(invalid) {
            let Position { east_m, north_m } = goals[goal];
            return Err(NavigationError::InvalidGoal { goal, east_m, north_m });
        }
        super::vehicle::positive("the horizon in h", horizon_h)?;
        if !departure_h.is_finite() {
            let (quantity, expected) = ("the departure in h", "finite");
            return Err(NavigationError::OutOfRange { quantity, expected, found: departure_h });
        }
        Ok(Self { waters, vehicle, goals: goals.to_vec(), departure_h, horizon_h })
    }

    /// The currents as forecast.
    pub const fn currents(&self) -> &'a CurrentField {
        self.waters.currents
    }

    /// The end of the horizon, hours since the run's start.
    pub const fn deadline_h(&self) -> f64 {
        self.departure_h + self.horizon_h
    }

    /// Why the goal cannot be reached from the start whatever the currents are, if
    /// one of them lies where no vehicle may be.
    pub fn forbidden(&self, start: Position, goal: Position) -> Option<Unreachable> {
        let at_goal = || self.waters.obstacle(goal).map(Unreachable::Goal);
        self.waters.obstacle(start).map(Unreachable::Start).or_else(at_goal)
    }
}

/// Travel times found by sailing every pair, for plans that hold no value function.
pub fn rollout_travel_times(plan: &dyn Plan, starts: &[Position]) -> TravelTimes {
    let voyage = plan.voyage();
    let goals = voyage.goals.len();
    let travel_time = |pair: usize| {
        let (start, goal) = (starts[pair / goals], pair % goals);
        let route = plan.follow(goal, start, voyage.departure_h, voyage.deadline_h());
        let closest_approach_m = route.closest_approach_m;
        let unreachable = match route.end {
            RouteEnd::Arrived => {
                return TravelTime::reached(route.duration_h());
            }
            RouteEnd::Unreachable(reason) => reason,
            RouteEnd::UnderWay => Unreachable::OutOfTime { horizon_h: voyage.horizon_h },
            RouteEnd::LeftDomain | RouteEnd::RanAground => Unreachable::SweptAway,
        };
        TravelTime::unreachable(unreachable, closest_approach_m)
    };
    let pairs = (0..starts.len() * goals).into_par_iter().map(travel_time).collect();
    TravelTimes::new(voyage, starts.len(), pairs)
}
