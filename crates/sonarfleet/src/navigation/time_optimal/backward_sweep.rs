//! The semi-Lagrangian solution of the Hamilton–Jacobi equation, backward in time,
//! for all goals at once.

use super::feet::{Feet, Motion};
use super::value_function::{NodeGrid, Stencil, ValueFunction};
use crate::grid::Position;
use crate::navigation::vehicle::SECONDS_PER_HOUR;
use crate::navigation::{Vehicle, Voyage};
use rayon::prelude::*;

/// What to solve for, and how finely.
pub(super) struct BackwardSweep<'a> {
    pub(super) voyage: &'a Voyage<'a>,
    pub(super) grid: NodeGrid,
    pub(super) step_h: f64,
    pub(super) steps: usize,
    pub(super) headings: usize,
    /// Value of having lost the vehicle, hours.
    pub(super) lost_h: f32,
}

/// A goal near enough to a node to be reached within one step.
struct Capture {
    column: usize,
    goal: usize,
}

impl BackwardSweep<'_> {
    /// Value of each node and goal, from the horizon back to the departure:
    /// V(x, t) = min over ψ of Δt + V(x + (u + V e(ψ)) Δt, t + Δt).
    ///
    /// At the horizon V is the time that the remaining distance takes in still
    /// water. Beyond the wall and on land it is `lost_h`. Where a goal is reached
    /// within the step, V is the time to its disc in the locally uniform current.
    /// Every node is a sum in a fixed order, so that the bits do not depend on the
    /// number of threads.
    pub(super) fn solve(&self) -> ValueFunction {
        let nodes = self.grid.node_count();
        let lanes = ValueFunction::lanes_for(self.voyage.goals.len());
        let land = self.land();
        let captures = self.captures();
        let directions = Feet::new(self.headings);
        let mut hours = vec![0.0; (self.steps + 1) * nodes * lanes];
        self.set_horizon(&mut hours[self.steps * nodes * lanes..], lanes, &land);

        for step in (0..self.steps).rev() {
            let motions = self.motions(self.voyage.departure_h + step as f64 * self.step_h);
            let (earlier, later) = hours.split_at_mut((step + 1) * nodes * lanes);
            let later = &later[..nodes * lanes];
            earlier[step * nodes * lanes..]
                .par_chunks_mut(self.grid.columns * lanes)
                .enumerate()
                .for_each_init(
                    || directions.clone(),
                    |feet, (row, values)| {
                        self.relax_row(row, values, later, &motions, &land, feet);
                        self.capture(row, values, lanes, &motions, &captures[row]);
                    },
                );
        }
        ValueFunction {
            grid: self.grid.clone(),
            departure_h: self.voyage.departure_h,
            step_h: self.step_h,
            steps: self.steps,
            lanes,
            hours,
        }
    }

    /// Which nodes are land; empty where all is water.
    fn land(&self) -> Vec<bool> {
        let currents = self.voyage.currents();
        if !currents.has_land() {
            return Vec::new();
        }
        self.all_nodes().map(|node| currents.is_land(node)).collect()
    }

    fn all_nodes(&self) -> impl Iterator<Item = Position> {
        let grid = &self.grid;
        (0..grid.node_count()).map(|node| grid.node(node % grid.columns, node / grid.columns))
    }

    fn set_horizon(&self, values: &mut [f32], lanes: usize, land: &[bool]) {
        let vehicle = self.voyage.vehicle;
        for (index, node) in self.all_nodes().enumerate() {
            for (goal, position) in self.voyage.goals.iter().enumerate() {
                values[index * lanes + goal] = if land.get(index) == Some(&true) {
                    self.lost_h
                } else {
                    vehicle.still_water_time_h(node.distance_m(*position)) as f32
                };
            }
        }
    }

    /// For each row, nodes from which a goal may be within one step.
    fn captures(&self) -> Vec<Vec<Capture>> {
        let vehicle = self.voyage.vehicle;
        let greatest_m_s = vehicle.speed_m_s() + self.voyage.currents().greatest_speed_m_s();
        let reach_m = vehicle.arrival_radius_m() + greatest_m_s * SECONDS_PER_HOUR * self.step_h;
        let mut captures: Vec<Vec<Capture>> = (0..self.grid.rows).map(|_| Vec::new()).collect();
        for (index, node) in self.all_nodes().enumerate() {
            let (column, row) = (index % self.grid.columns, index / self.grid.columns);
            for (goal, position) in self.voyage.goals.iter().enumerate() {
                if node.distance_m(*position) <= reach_m {
                    captures[row].push(Capture { column, goal });
                }
            }
        }
        captures
    }

    /// How vehicles move from each node in the step that begins at `time_h`.
    fn motions(&self, time_h: f64) -> Vec<Motion> {
        let currents = self.voyage.currents();
        let half_h = self.step_h / 2.0;
        let velocity: Vec<[f64; 2]> =
            self.all_nodes().map(|node| currents.velocity_m_s(node, time_h + half_h)).collect();
        let (columns, rows) = (self.grid.columns, self.grid.rows);
        let seconds = self.step_h * SECONDS_PER_HOUR;
        let motion = |node: usize| {
            let (column, row) = (node % columns, node / columns);
            let slope = |below: usize, above: usize, spacing_m: f64, count: usize| {
                let run_m = spacing_m * count as f64;
                [0, 1].map(|part| (velocity[above][part] - velocity[below][part]) / run_m)
            };
            let (west, east) = (column.saturating_sub(1), (column + 1).min(columns - 1));
            let (south, north) = (row.saturating_sub(1), (row + 1).min(rows - 1));
            let dx = slope(
                row * columns + west,
                row * columns + east,
                self.grid.spacing_east_m,
                east - west,
            );
            let dy = slope(
                south * columns + column,
                north * columns + column,
                self.grid.spacing_north_m,
                north - south,
            );
            let [u, v] = velocity[node];
            let half_s = seconds / 2.0;
            let through_water_m = seconds * self.voyage.vehicle.speed_m_s();
            let spacing_m = [self.grid.spacing_east_m, self.grid.spacing_north_m];
            let drift = [0, 1].map(|part| {
                let mean_m_s = velocity[node][part] + half_s * (dx[part] * u + dy[part] * v);
                (seconds * mean_m_s / spacing_m[part]) as f32
            });
            let steering =
                [[1.0 + half_s * dx[0], half_s * dy[0]], [half_s * dx[1], 1.0 + half_s * dy[1]]];
            let scaled = |part: usize| {
                steering[part].map(|factor| (through_water_m * factor / spacing_m[part]) as f32)
            };
            Motion { drift, steering: [scaled(0), scaled(1)] }
        };
        (0..self.grid.node_count()).map(motion).collect()
    }

    /// One step back in time for the nodes of one row.
    fn relax_row(
        &self,
        row: usize,
        values: &mut [f32],
        later: &[f32],
        motions: &[Motion],
        land: &[bool],
        feet: &mut Feet,
    ) {
        let columns = self.grid.columns;
        let lanes = values.len() / columns;
        let step_h = self.step_h as f32;
        for (column, best) in values.chunks_exact_mut(lanes).enumerate() {
            best.fill(self.lost_h - step_h);
            let node = row * columns + column;
            if land.get(node) != Some(&true) {
                let mut pairs =
                    feet.of(&self.grid, column, row, &motions[node], land).chunks_exact(2);
                for pair in &mut pairs {
                    keep_better(best, later, [pair[0], pair[1]], columns);
                }
                if let [odd] = *pairs.remainder() {
                    keep_better(best, later, [odd, odd], columns);
                }
            }
            for hours in best {
                *hours += step_h;
            }
        }
    }

    /// Exact times from the nodes of one row to goals within one step.
    fn capture(
        &self,
        row: usize,
        values: &mut [f32],
        lanes: usize,
        motions: &[Motion],
        captures: &[Capture],
    ) {
        for &Capture { column, goal } in captures {
            let value = &mut values[column * lanes + goal];
            let [east, north] = motions[row * self.grid.columns + column].drift.map(f64::from);
            let current_m_h = [
                east * self.grid.spacing_east_m / self.step_h,
                north * self.grid.spacing_north_m / self.step_h,
            ];
            let from = self.grid.node(column, row);
            let goal = self.voyage.goals[goal];
            if let Some(hours) = time_to_disc_h(self.voyage.vehicle, current_m_h, from, goal)
                && hours <= self.step_h
                && *value < self.lost_h
            {
                *value = hours as f32;
            }
        }
    }
}

/// best ← min(best, Σ w · later) over two feet, for all goals.
#[inline]
fn keep_better(best: &mut [f32], later: &[f32], feet: [Stencil; 2], columns: usize) {
    let lanes = best.len();
    let corners = |foot: Stencil| {
        let row = |node: usize| later[node * lanes..][..2 * lanes].split_at(lanes);
        [row(foot.node), row(foot.node + columns)]
    };
    let [one, two] = feet.map(corners);
    let ((a0, a1), (a2, a3)) = (one[0], one[1]);
    let ((b0, b1), (b2, b3)) = (two[0], two[1]);
    let [v0, v1, v2, v3] = feet[0].weights;
    let [w0, w1, w2, w3] = feet[1].weights;
    for lane in 0..lanes {
        let a = (v0 * a0[lane] + v1 * a1[lane]) + (v2 * a2[lane] + v3 * a3[lane]);
        let b = (w0 * b0[lane] + w1 * b1[lane]) + (w2 * b2[lane] + w3 * b3[lane]);
        let better = if a < b { a } else { b };
        best[lane] = if better < best[lane] { better } else { best[lane] };
    }
}

/// Least time to the disc around a goal in a uniform current (m/h): the first τ with
/// |g − x − u τ| = r + V τ, Zermelo's problem with a straight solution. None if the
/// current is too strong.
pub(super) fn time_to_disc_h(
    vehicle: Vehicle,
    current_m_h: [f64; 2],
    from: Position,
    goal: Position,
) -> Option<f64> {
    let (gx, gy) = (goal.east_m - from.east_m, goal.north_m - from.north_m);
    let (radius, speed) = (vehicle.arrival_radius_m(), vehicle.speed_m_h());
    let [u, v] = current_m_h;
    // c + 2 b τ + a τ² ≤ 0 inside the reachable set; c > 0 outside the disc.
    let c = gx * gx + gy * gy - radius * radius;
    if c <= 0.0 {
        return Some(0.0);
    }
    let b = -(gx * u + gy * v) - radius * speed;
    let a = u * u + v * v - speed * speed;
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    // The smallest positive root, without cancellation.
    let root = discriminant.sqrt();
    let tau = if b < 0.0 { c / (-b + root) } else { (-b - root) / a };
    (tau >= 0.0 && tau.is_finite()).then_some(tau)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_disc_is_reached_when_zermelo_says() {
        let vehicle = Vehicle::new(0.25, 500.0, 1.0).unwrap();
        let here = Position::new(0.0, 0.0);
        let to = |east: f64, u: f64, v: f64| {
            let current_m_h = [u * SECONDS_PER_HOUR, v * SECONDS_PER_HOUR];
            time_to_disc_h(vehicle, current_m_h, here, Position::new(east, 0.0))
        };
        assert!((to(1_400.0, 0.0, 0.0).unwrap() - 1.0).abs() < 1e-12);
        assert!((to(2_120.0, 0.2, 0.0).unwrap() - 1.0).abs() < 1e-12);
        assert!(to(2_120.0, -0.3, 0.0).is_none());
        assert!((to(-2_480.0, -0.3, 0.0).unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(to(300.0, -0.3, 0.0), Some(0.0));
        // Across: the disc's near edge grows at V while the centre drifts by v.
        let across = to(3_000.0, 0.0, 0.15).unwrap();
        let reach = 500.0 + 900.0 * across;
        assert!((3_000.0_f64.hypot(540.0 * across) - reach).abs() < 1e-6);
    }
}
