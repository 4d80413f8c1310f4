//! The closed loop: the paper's six steps (section 2.2) are six calls, epoch
//! after epoch.

mod acoustics;
mod environment;
mod error;
mod excerpts;
mod findings;
mod loss;
mod outcome;
mod stage;
mod theatre;

pub use acoustics::Acoustics;
pub use environment::{Environment, input};
pub use error::MissionError;
pub use findings::findings;
pub use loss::EpochLoss;
pub use stage::{Event, Observer, Stage};
pub use theatre::Theatre;

use crate::assignment::{CostMatrix, assign};
use crate::grid::Position;
use crate::navigation::{Plan, Planner, Route, RouteEnd, TravelTimes, Waters};
use crate::placement::{Budget, Placement, Solver};
use crate::record::EpochRecord;
use crate::scenario::Scenario;
use crate::sonar::transmission_loss::LossCache;
use outcome::{Movement, Outcome};
use stage::Clock;

/// A scenario in its theatre, with the methods that place and steer the fleet.
pub struct Mission<'a> {
    /// What is to be done.
    pub scenario: &'a Scenario,
    /// Where.
    pub theatre: &'a Theatre,
    /// How posts are chosen.
    pub solver: &'a dyn Solver,
    /// How travel is planned.
    pub planner: &'a dyn Planner,
    /// Where computed transmission loss is kept; nowhere if none.
    pub loss_cache: Option<&'a LossCache>,
}

impl Mission<'_> {
    /// Runs one epoch from where the vehicles are; gives its record, and where they
    /// are when it ends.
    ///
    /// # Errors
    /// If the ocean does not hold what is needed, or no layout exists. Posts that
    /// cannot be reached are data of the record, not errors.
    pub fn run_epoch(
        &self,
        epoch: usize,
        fleet: &[Position],
        observer: &Observer<'_>,
    ) -> Result<(EpochRecord, Vec<Position>), MissionError> {
        let mut clock = Clock::new(epoch, observer);
        let environment = self.update_environment(epoch, &mut clock)?; // step 1
        let placement = self.place(epoch, &environment, &mut clock); // step 2
        let (plan, travel) = self.plan_travel(epoch, &placement, fleet, &mut clock)?; // step 3
        let posts = self.assign(&travel, &mut clock)?; // step 4
        let movement = self.execute(epoch, plan.as_ref(), &posts, fleet, &mut clock); // step 5
        let moved: Vec<Position> =
            movement.travelled.iter().map(|route| route.last().position).collect();
        let outcome = Outcome { placement, travel, posts, movement };
        let record = self.update_knowledge(epoch, &environment, &outcome, [fleet, &moved], clock); // step 6
        observer(Event::Epoch(&record));
        Ok((record, moved))
    }

    /// Step 1: ocean state, transmission loss and target prior of an epoch.
    fn update_environment(
        &self,
        epoch: usize,
        clock: &mut Clock<'_>,
    ) -> Result<Environment, MissionError> {
        let mut environment =
            Environment::timed(self.scenario, self.theatre, epoch, self.loss_cache, clock)?;
        if self.scenario.file.transmission_loss.error_sample > 0 {
            environment.estimate_loss_error(self.scenario, self.theatre, self.loss_cache, clock)?;
        }
        Ok(environment)
    }

    /// Step 2: the target layout.
    fn place(&self, epoch: usize, environment: &Environment, clock: &mut Clock<'_>) -> Placement {
        let budget = Budget::Evaluations(self.scenario.file.placement.evaluations);
        let seed = self.scenario.seed_of(epoch);
        clock.time(Stage::Placement, |_| self.solver.solve(&environment.problem, budget, seed))
    }

    /// Step 3: travel times of all vehicles to all posts through the forecast currents.
    fn plan_travel(
        &self,
        epoch: usize,
        placement: &Placement,
        fleet: &[Position],
        clock: &mut Clock<'_>,
    ) -> Result<(Box<dyn Plan + '_>, TravelTimes), MissionError> {
        let waters = Waters { currents: &self.theatre.currents, domain: self.scenario.domain };
        let posts: Vec<Position> =
            placement.cells.iter().map(|&cell| self.scenario.grid.centre(cell)).collect();
        let departure_h = self.scenario.epochs[epoch].start_h;
        clock.time(Stage::TravelTimes, |_| {
            let plan = self.planner.prepare(waters, self.scenario.vehicle, &posts, departure_h)?;
            let travel = plan.travel_times(fleet);
            Ok((plan, travel))
        })
    }

    /// Step 4: the post of each vehicle, an index into the placement's cells.
    fn assign(
        &self,
        travel: &TravelTimes,
        clock: &mut Clock<'_>,
    ) -> Result<Vec<usize>, MissionError> {
        let costs = CostMatrix::new(travel.starts(), travel.goals(), travel.assignment_costs_h())?;
        let assignment =
            clock.time(Stage::Assignment, |_| assign(&costs, self.scenario.objective))?;
        let posts = assignment.column_of_row.into_iter();
        Ok(posts.map(|post| post.expect("as many posts as vehicles")).collect())
    }

    /// Step 5: the vehicles follow their plans until the epoch ends. One that has
    /// arrived holds its post; one that has not goes on from where it is next epoch.
    fn execute(
        &self,
        epoch: usize,
        plan: &dyn Plan,
        posts: &[usize],
        fleet: &[Position],
        clock: &mut Clock<'_>,
    ) -> Movement {
        let start_h = self.scenario.epochs[epoch].start_h;
        let end_h = start_h + self.scenario.epoch_h;
        clock.time(Stage::Execution, |_| {
            let travelled: Vec<Route> = posts
                .iter()
                .zip(fleet)
                .map(|(&post, &from)| plan.follow(post, from, start_h, end_h))
                .collect();
            let remaining = posts
                .iter()
                .zip(&travelled)
                .map(|(&post, route)| {
                    (route.end == RouteEnd::UnderWay)
                        .then(|| plan.follow(post, route.last().position, end_h, f64::INFINITY))
                })
                .collect();
            Movement { travelled, remaining }
        })
    }
}
