//! Optimal headings, read off the value function.

use super::TimeOptimalPlan;
use super::backward_sweep::time_to_disc_h;
use super::value_function::WALL_CLEARANCE_M;
use crate::grid::Position;
use crate::navigation::sail::{advance, bearing_rad};
use crate::navigation::vehicle::SECONDS_PER_HOUR;
use crate::navigation::{Observation, Pilot};
use std::f64::consts::TAU;

/// Steps of the golden-section search between two of the plan's headings: 10 divide
/// the interval by 120.
const REFINEMENTS: usize = 10;

/// Ranks headings that come too near the wall.
const METRES_PER_LOST_HOUR: f64 = 1000.0;

/// Where to head, and how long the way is from there.
pub(super) struct Steering {
    pub(super) heading_rad: f64,
    pub(super) time_to_go_h: f64,
}

/// Follows a value function.
pub(super) struct ValuePilot<'a> {
    pub(super) plan: &'a TimeOptimalPlan<'a>,
    pub(super) goal: usize,
}

impl Pilot for ValuePilot<'_> {
    fn heading_rad(&mut self, observation: &Observation) -> f64 {
        self.plan.steer(self.goal, observation.position, observation.time_h).heading_rad
    }
}

impl TimeOptimalPlan<'_> {
    /// The heading that minimises Δt + V(x + (u + V e(ψ)) Δt, t + Δt) over all ψ, or
    /// the straight way into the arrival disc if it is within one step.
    pub(super) fn steer(&self, goal: usize, from: Position, time_h: f64) -> Steering {
        let voyage = &self.voyage;
        let target = voyage.goals[goal];
        let current_m_h =
            voyage.currents().velocity_m_s(from, time_h).map(|part| part * SECONDS_PER_HOUR);
        if let Some(hours) = time_to_disc_h(voyage.vehicle, current_m_h, from, target)
            && hours <= self.value_function.step_h
        {
            let drifted = Position::new(
                from.east_m + current_m_h[0] * hours,
                from.north_m + current_m_h[1] * hours,
            );
            return Steering { heading_rad: bearing_rad(drifted, target), time_to_go_h: hours };
        }

        let cost = |heading_rad: f64| self.time_to_go_h(goal, from, time_h, heading_rad);
        let spacing = TAU / self.headings as f64;
        let (mut best, mut least) = (bearing_rad(from, target), f64::INFINITY);
        for heading in 0..self.headings {
            let heading_rad = heading as f64 * spacing;
            let hours = cost(heading_rad);
            if hours < least {
                (best, least) = (heading_rad, hours);
            }
        }
        let (heading_rad, refined) =
            golden_section(cost, best - spacing, best + spacing, REFINEMENTS);
        if refined < least {
            (best, least) = (heading_rad, refined);
        }
        Steering { heading_rad: best, time_to_go_h: least }
    }

    /// Hours to go if the next step is sailed with this heading.
    fn time_to_go_h(&self, goal: usize, from: Position, time_h: f64, heading_rad: f64) -> f64 {
        let voyage = &self.voyage;
        let step_h = self.value_function.step_h;
        let foot = advance(voyage.currents(), voyage.vehicle, from, time_h, heading_rad, step_h);
        let beyond_m = voyage.waters.domain.beyond_m(foot, WALL_CLEARANCE_M);
        if beyond_m > 0.0 {
            // Lost, but the less the better: near the wall this leads back.
            return self.lost_h + beyond_m / METRES_PER_LOST_HOUR;
        }
        if self.runs_aground(from, foot) {
            return self.lost_h;
        }
        match self.value_function.grid.coordinates(foot) {
            Some((x, y)) => {
                (step_h + self.value_function.at(goal, x, y, time_h + step_h)).min(self.lost_h)
            }
            None => self.lost_h,
        }
    }

    /// Whether a step crosses land, or ends closer to it than the clearance.
    fn runs_aground(&self, from: Position, foot: Position) -> bool {
        let currents = self.voyage.currents();
        if !currents.has_land() {
            return false;
        }
        let on_the_way = |quarter: i32| {
            let fraction = f64::from(quarter) / 4.0;
            currents.is_land(Position::new(
                from.east_m + fraction * (foot.east_m - from.east_m),
                from.north_m + fraction * (foot.north_m - from.north_m),
            ))
        };
        let beside = |(east, north): (f64, f64)| {
            currents.is_land(Position::new(
                foot.east_m + east * WALL_CLEARANCE_M,
                foot.north_m + north * WALL_CLEARANCE_M,
            ))
        };
        (1..=4).any(on_the_way)
            || [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)].into_iter().any(beside)
    }
}

/// Minimum of a function with one valley between two points: where, and its value.
fn golden_section(
    cost: impl Fn(f64) -> f64,
    mut low: f64,
    mut high: f64,
    steps: usize,
) -> (f64, f64) {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let mut left = high - RATIO * (high - low);
    let mut right = low + RATIO * (high - low);
    let (mut at_left, mut at_right) = (cost(left), cost(right));
    for _ in 0..steps {
        if at_left <= at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - RATIO * (high - low);
            at_left = cost(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + RATIO * (high - low);
            at_right = cost(right);
        }
    }
    if at_left <= at_right { (left, at_left) } else { (right, at_right) }
}

#[cfg(test)]
mod tests {
    use super::golden_section;

    #[test]
    fn golden_section_closes_in_on_the_valley() {
        let (at, least) = golden_section(|x| (x - 0.3).powi(2) + 1.0, -1.0, 1.0, 40);
        assert!((at - 0.3).abs() < 1e-6 && (least - 1.0).abs() < 1e-12);
    }
}
