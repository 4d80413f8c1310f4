//! Crab-angle compensation: hold the straight line to the goal against the current.

use super::sail::bearing_rad;
use super::{
    NavigationError, Observation, Pilot, Plan, Planner, TravelTimes, Vehicle, Voyage, Waters,
    rollout_travel_times,
};
use crate::grid::Position;

/// Heads so that the measured current across the line to the goal is compensated
/// (the crab angle), or straight across the current where it is too strong for that.
/// Needs no forecast; its travel times are those of sailing through it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crab {
    /// Longest travel considered, hours.
    pub horizon_h: f64,
}

impl Default for Crab {
    fn default() -> Self {
        Self { horizon_h: super::DEFAULT_HORIZON_H }
    }
}

impl Planner for Crab {
    fn name(&self) -> &'static str {
        "crab"
    }

    fn prepare<'a>(
        &self,
        waters: Waters<'a>,
        vehicle: Vehicle,
        goals: &[Position],
        departure_h: f64,
    ) -> Result<Box<dyn Plan + 'a>, NavigationError> {
        Ok(Box::new(CrabPlan {
            voyage: Voyage::new(waters, vehicle, goals, departure_h, self.horizon_h)?,
        }))
    }
}

struct CrabPlan<'a> {
    voyage: Voyage<'a>,
}

impl Plan for CrabPlan<'_> {
    fn voyage(&self) -> &Voyage<'_> {
        &self.voyage
    }

    fn travel_times(&self, starts: &[Position]) -> TravelTimes {
        rollout_travel_times(self, starts)
    }

    fn pilot(&self, goal: usize) -> Box<dyn Pilot + '_> {
        let speed_m_s = self.voyage.vehicle.speed_m_s();
        Box::new(CrabPilot { goal: self.voyage.goals[goal], speed_m_s })
    }
}

struct CrabPilot {
    goal: Position,
    speed_m_s: f64,
}

impl Pilot for CrabPilot {
    fn heading_rad(&mut self, observation: &Observation) -> f64 {
        crab_heading_rad(
            bearing_rad(observation.position, self.goal),
            observation.current_m_s,
            self.speed_m_s,
        )
    }
}

/// The heading that makes good a course (both clockwise from north, radians) in a
/// current [eastward, northward], m/s: sin(ψ − course) = −cross-current / V, at most
/// a right angle.
pub fn crab_heading_rad(course_rad: f64, current_m_s: [f64; 2], speed_m_s: f64) -> f64 {
    let (sin, cos) = course_rad.sin_cos();
    let to_starboard_m_s = current_m_s[0] * cos - current_m_s[1] * sin;
    course_rad - (to_starboard_m_s / speed_m_s).clamp(-1.0, 1.0).asin()
}
