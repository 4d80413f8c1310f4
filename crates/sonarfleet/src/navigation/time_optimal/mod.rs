//! The time-optimal planner: Zermelo's problem for a whole fleet.
//!
//! One backward sweep gives, for every goal, the least time to go from everywhere at
//! every time (the value function); the matrix of travel times and the optimal
//! headings are read off it.

mod backward_sweep;
mod feet;
mod pilot;
mod value_function;

use super::vehicle::positive;
use super::{
    NavigationError, Pilot, Plan, Planner, TravelTime, TravelTimes, Unreachable, Vehicle, Voyage,
    Waters,
};
use crate::grid::Position;
use backward_sweep::BackwardSweep;
use pilot::ValuePilot;
use rayon::prelude::*;
use value_function::{NodeGrid, ValueFunction};

/// Larger value functions are solved on a coarser grid, bytes.
const MEMORY_LIMIT_BYTES: usize = 512 << 20;

/// Plans with the value function of the Hamilton–Jacobi equation, solved backward
/// from the horizon with the semi-Lagrangian scheme. On currents of 1/12° the
/// defaults give travel times with a median error of about 1 %.
///
/// Time: nodes × steps × headings × goals; memory: 4 bytes × nodes × (steps + 1) ×
/// goals. Domains so large that this exceeds 512 MiB are solved with nodes further
/// apart (and a warning).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeOptimal {
    /// Greatest distance between nodes, m.
    pub spacing_m: f64,
    /// Time step, h. Longer steps interpolate less often, and so blur less.
    pub step_h: f64,
    /// Headings tried at every node.
    pub headings: usize,
    /// Longest travel considered, h.
    pub horizon_h: f64,
}

impl Default for TimeOptimal {
    fn default() -> Self {
        Self { spacing_m: 515.0, step_h: 1.0, headings: 32, horizon_h: super::DEFAULT_HORIZON_H }
    }
}

impl Planner for TimeOptimal {
    fn name(&self) -> &'static str {
        "time-optimal"
    }

    fn prepare<'a>(
        &self,
        waters: Waters<'a>,
        vehicle: Vehicle,
        goals: &[Position],
        departure_h: f64,
    ) -> Result<Box<dyn Plan + 'a>, NavigationError> {
        let voyage = Voyage::new(waters, vehicle, goals, departure_h, self.horizon_h)?;
        positive("the value function's spacing in m", self.spacing_m)?;
        positive("the value function's step in h", self.step_h)?;
        if self.headings < 4 {
            let (quantity, expected) = ("the number of headings", "at least 4");
            let found = self.headings as f64;
            return Err(NavigationError::OutOfRange { quantity, expected, found });
        }

        let steps = (self.horizon_h / self.step_h - 1e-9).ceil().max(1.0);
        let diagonal_m = waters.domain.width_m().hypot(waters.domain.height_m());
        let lost_h = 2.0 * (self.horizon_h + diagonal_m / vehicle.speed_m_h());
        let sweep = BackwardSweep {
            grid: self.grid(&voyage, steps as usize),
            voyage: &voyage,
            step_h: self.horizon_h / steps,
            steps: steps as usize,
            headings: self.headings,
            lost_h: lost_h as f32,
        };
        let value_function = sweep.solve();
        Ok(Box::new(TimeOptimalPlan { voyage, value_function, lost_h, headings: self.headings }))
    }
}

impl TimeOptimal {
    /// Nodes over the voyage's domain, coarser than asked for where memory asks for it.
    fn grid(&self, voyage: &Voyage<'_>, steps: usize) -> NodeGrid {
        let domain = voyage.waters.domain;
        let mut spacing_m = self.spacing_m;
        loop {
            let grid = NodeGrid::over(domain, spacing_m);
            let bytes = ValueFunction::bytes(&grid, steps, voyage.goals.len());
            if bytes <= MEMORY_LIMIT_BYTES || grid.node_count() <= 4 {
                if spacing_m > self.spacing_m {
                    tracing::warn!(
                        asked_m = self.spacing_m,
                        used_m = spacing_m,
                        "value function solved on a coarser grid: the domain is too large"
                    );
                }
                return grid;
            }
            spacing_m *= (bytes as f64 / MEMORY_LIMIT_BYTES as f64).sqrt().max(1.01);
        }
    }
}

/// A solved value function and what it was solved for.
struct TimeOptimalPlan<'a> {
    voyage: Voyage<'a>,
    value_function: ValueFunction,
    /// Value of having lost the vehicle, hours.
    lost_h: f64,
    headings: usize,
}

impl Plan for TimeOptimalPlan<'_> {
    fn voyage(&self) -> &Voyage<'_> {
        &self.voyage
    }

    fn travel_times(&self, starts: &[Position]) -> TravelTimes {
        let goals = self.voyage.goals.len();
        let pairs = (0..starts.len() * goals)
            .into_par_iter()
            .map(|pair| self.travel_time(starts[pair / goals], pair % goals))
            .collect();
        TravelTimes::new(&self.voyage, starts.len(), pairs)
    }

    fn pilot(&self, goal: usize) -> Box<dyn Pilot + '_> {
        Box::new(ValuePilot { plan: self, goal })
    }
}

impl TimeOptimalPlan<'_> {
    fn travel_time(&self, start: Position, goal: usize) -> TravelTime {
        let voyage = &self.voyage;
        let distance_m = start.distance_m(voyage.goals[goal]);
        if let Some(reason) = voyage.forbidden(start, voyage.goals[goal]) {
            return TravelTime::unreachable(reason, distance_m);
        }
        if distance_m <= voyage.vehicle.arrival_radius_m() {
            return TravelTime::reached(0.0);
        }
        let hours = self.steer(goal, start, voyage.departure_h).time_to_go_h;
        if hours <= voyage.horizon_h {
            return TravelTime::reached(hours);
        }
        let remaining_m = (hours - voyage.horizon_h) * voyage.vehicle.speed_m_h();
        let reason = if hours >= self.lost_h {
            Unreachable::SweptAway
        } else {
            Unreachable::OutOfTime { horizon_h: voyage.horizon_h }
        };
        TravelTime::unreachable(reason, (remaining_m).min(distance_m))
    }
}
