//! The travel-time matrix.

use super::{Unreachable, Voyage};

/// Expected travel of one vehicle to one post.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TravelTime {
    /// Hours from departure to arrival; infinite if unreachable.
    pub hours: f64,
    /// Why it is unreachable, if it is.
    pub unreachable: Option<Unreachable>,
    /// How near it can come: 0 if reachable, else the distance from the goal that
    /// remains, m.
    pub closest_approach_m: f64,
}

impl TravelTime {
    /// A post that is reached.
    pub const fn reached(hours: f64) -> Self {
        Self { hours, unreachable: None, closest_approach_m: 0.0 }
    }

    /// A post that is not.
    pub const fn unreachable(reason: Unreachable, closest_approach_m: f64) -> Self {
        Self { hours: f64::INFINITY, unreachable: Some(reason), closest_approach_m }
    }
}

/// Expected travel times of a fleet to its posts, all leaving at the same time.
#[derive(Debug, Clone, PartialEq)]
pub struct TravelTimes {
    starts: usize,
    goals: usize,
    horizon_h: f64,
    speed_m_h: f64,
    /// [start, goal]
    pairs: Vec<TravelTime>,
}

impl TravelTimes {
    /// A matrix from its entries, [start, goal], of a voyage.
    ///
    /// # Panics
    /// If there are not `starts` × goals entries.
    pub fn new(voyage: &Voyage<'_>, starts: usize, pairs: Vec<TravelTime>) -> Self {
        let goals = voyage.goals.len();
        assert_eq!(pairs.len(), starts * goals, "one entry per pair");
        let speed_m_h = voyage.vehicle.speed_m_h();
        Self { starts, goals, horizon_h: voyage.horizon_h, speed_m_h, pairs }
    }

    /// Number of starts.
    pub const fn starts(&self) -> usize {
        self.starts
    }

    /// Number of goals.
    pub const fn goals(&self) -> usize {
        self.goals
    }

    /// One pair.
    ///
    /// # Panics
    /// If there is no such start or goal.
    pub fn pair(&self, start: usize, goal: usize) -> &TravelTime {
        assert!(goal < self.goals, "goal {goal} of {}", self.goals);
        &self.pairs[start * self.goals + goal]
    }

    /// All travel times, [start, goal], hours; infinite where unreachable.
    pub fn hours(&self) -> Vec<f64> {
        self.pairs.iter().map(|pair| pair.hours).collect()
    }

    /// How near each start comes to each goal, [start, goal], metres; 0 where it
    /// arrives.
    pub fn closest_approaches_m(&self) -> Vec<f64> {
        self.pairs.iter().map(|pair| pair.closest_approach_m).collect()
    }

    /// Costs for the assignment, [start, goal], hours: the travel time, and for an
    /// unreachable post the horizon plus the time that the remaining distance takes
    /// in still water, so that an assignment always exists and brings every vehicle
    /// as near as it gets.
    pub fn assignment_costs_h(&self) -> Vec<f64> {
        let cost = |pair: &TravelTime| match pair.unreachable {
            None => pair.hours,
            Some(_) => self.horizon_h + pair.closest_approach_m / self.speed_m_h,
        };
        self.pairs.iter().map(cost).collect()
    }
}
