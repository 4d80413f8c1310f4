//! A vehicle in moving water: dx/dt = u(x, t) + V·e(ψ).

use super::{
    CurrentField, Observation, Obstacle, Pilot, Route, RouteEnd, RoutePoint, Unreachable, Vehicle,
    Waters, vehicle::SECONDS_PER_HOUR,
};
use crate::grid::Position;

/// Longest integration step, hours.
pub const LONGEST_STEP_H: f64 = 0.25;

/// Times closer than this are the same, hours.
const TIME_TOLERANCE_H: f64 = 1e-9;

/// Sails from a place toward a goal with the pilot's headings, one per command
/// interval, until `until_h` at the latest (hours since the run's start).
///
/// Between commands the way is integrated with the midpoint rule in equal steps of
/// at most 0.25 h. A vehicle arrives where a step first enters the disc around the
/// goal, with the time in proportion along the step; it fails where a step ends
/// outside the domain or on land.
pub fn sail(
    waters: Waters<'_>,
    vehicle: Vehicle,
    pilot: &mut dyn Pilot,
    goal: Position,
    from: Position,
    start_h: f64,
    until_h: f64,
) -> Route {
    let mut position = from;
    let mut time_h = start_h;
    let mut heading_rad = bearing_rad(from, goal);
    let mut closest_approach_m = from.distance_m(goal);
    let mut points = Vec::new();

    let mut end = if let Some(obstacle) = waters.obstacle(from) {
        Some(RouteEnd::Unreachable(Unreachable::Start(obstacle)))
    } else if closest_approach_m <= vehicle.arrival_radius_m() {
        Some(RouteEnd::Arrived)
    } else {
        waters.obstacle(goal).map(|obstacle| RouteEnd::Unreachable(Unreachable::Goal(obstacle)))
    };

    while end.is_none() && time_h < until_h - TIME_TOLERANCE_H {
        let current_m_s = waters.currents.velocity_m_s(position, time_h);
        heading_rad = pilot.heading_rad(&Observation { time_h, position, current_m_s });
        points.push(RoutePoint { time_h, position, heading_rad, current_m_s });

        let command_end_h = (time_h + vehicle.command_interval_h()).min(until_h);
        let steps = ((command_end_h - time_h) / LONGEST_STEP_H - TIME_TOLERANCE_H).ceil().max(1.0);
        let step_h = (command_end_h - time_h) / steps;
        let command_start_h = time_h;
        for step in 1..=steps as usize {
            let next = advance(waters.currents, vehicle, position, time_h, heading_rad, step_h);
            let approach = Approach::of_segment(position, next, goal, vehicle.arrival_radius_m());
            closest_approach_m = closest_approach_m.min(approach.distance_m);
            if let Some(fraction) = approach.entry {
                position = between(position, next, fraction);
                time_h += fraction * step_h;
                end = Some(RouteEnd::Arrived);
                break;
            }
            position = next;
            time_h = command_start_h + step as f64 * step_h;
            end = waters.obstacle(next).map(|obstacle| match obstacle {
                Obstacle::OutsideDomain => RouteEnd::LeftDomain,
                Obstacle::Land => RouteEnd::RanAground,
            });
            if end.is_some() {
                break;
            }
        }
    }

    let current_m_s = waters.currents.velocity_m_s(position, time_h);
    points.push(RoutePoint { time_h, position, heading_rad, current_m_s });
    Route { goal, points, end: end.unwrap_or(RouteEnd::UnderWay), closest_approach_m }
}

/// Bearing from one point to another, clockwise from north, radians.
pub(super) fn bearing_rad(from: Position, to: Position) -> f64 {
    (to.east_m - from.east_m).atan2(to.north_m - from.north_m)
}

/// One step of the midpoint rule (second order) with a constant heading.
pub(super) fn advance(
    currents: &CurrentField,
    vehicle: Vehicle,
    from: Position,
    time_h: f64,
    heading_rad: f64,
    step_h: f64,
) -> Position {
    let (east, north) = heading_rad.sin_cos();
    let moved = |velocity_m_s: [f64; 2], hours: f64| {
        let seconds = hours * SECONDS_PER_HOUR;
        Position::new(
            from.east_m + (velocity_m_s[0] + vehicle.speed_m_s() * east) * seconds,
            from.north_m + (velocity_m_s[1] + vehicle.speed_m_s() * north) * seconds,
        )
    };
    let half_h = step_h / 2.0;
    let middle = moved(currents.velocity_m_s(from, time_h), half_h);
    moved(currents.velocity_m_s(middle, time_h + half_h), step_h)
}

/// The point a fraction of the way from one point to another.
fn between(from: Position, to: Position, fraction: f64) -> Position {
    Position::new(
        from.east_m + fraction * (to.east_m - from.east_m),
        from.north_m + fraction * (to.north_m - from.north_m),
    )
}

/// How a straight segment passes a goal.
struct Approach {
    /// Least distance to the goal, m.
    distance_m: f64,
    /// Fraction of the segment at which it enters the disc around the goal.
    entry: Option<f64>,
}

impl Approach {
    fn of_segment(from: Position, to: Position, goal: Position, radius_m: f64) -> Self {
        let (dx, dy) = (to.east_m - from.east_m, to.north_m - from.north_m);
        let (gx, gy) = (goal.east_m - from.east_m, goal.north_m - from.north_m);
        let length2 = dx * dx + dy * dy;
        let along = gx * dx + gy * dy;
        let nearest = if length2 > 0.0 { (along / length2).clamp(0.0, 1.0) } else { 0.0 };
        let distance_m = between(from, to, nearest).distance_m(goal);
        // |s·d − g|² = r², the first root; the segment starts outside the disc.
        let discriminant = along * along - length2 * (gx * gx + gy * gy - radius_m * radius_m);
        let entry = (distance_m <= radius_m && length2 > 0.0)
            .then(|| ((along - discriminant.max(0.0).sqrt()) / length2).clamp(0.0, 1.0));
        Self { distance_m, entry }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigation::TransitDomain;

    struct Fixed(f64);
    impl Pilot for Fixed {
        fn heading_rad(&mut self, _: &Observation) -> f64 {
            self.0
        }
    }

    fn vehicle() -> Vehicle {
        Vehicle::new(0.23, 500.0, 1.0).unwrap()
    }

    fn domain() -> TransitDomain {
        TransitDomain::around_region(30_000.0, 30_000.0, 10_000.0).unwrap()
    }

    #[test]
    fn the_integrator_is_of_second_order() {
        // Solid rotation, u = ω k × x, which bilinear interpolation holds exactly.
        let (omega, half_m) = (2e-5, 40_000.0);
        let nodes = vec![-half_m, half_m];
        let u: Vec<f64> = [-half_m, half_m].iter().flat_map(|y| [-omega * y; 2]).collect();
        let v: Vec<f64> = [0, 1].iter().flat_map(|_| [-omega * half_m, omega * half_m]).collect();
        let currents = CurrentField::new(nodes.clone(), nodes, vec![0.0], &u, &v).unwrap();
        let still = Vehicle::new(1e-9, 500.0, 1.0).unwrap();
        let start = Position::new(5_000.0, 0.0);
        let hours = 8.0;
        let error_m = |steps: u32| {
            let step_h = hours / f64::from(steps);
            let end =
                (0..steps).fold(start, |at, _| advance(&currents, still, at, 0.0, 0.0, step_h));
            let angle = omega * hours * SECONDS_PER_HOUR;
            end.distance_m(Position::new(5_000.0 * angle.cos(), 5_000.0 * angle.sin()))
        };
        let ratio = error_m(8) / error_m(16);
        assert!((3.7..4.3).contains(&ratio), "halving the step divides the error by {ratio}");
        assert!(error_m(32) < 1.0, "{} m after 8 h at the longest step", error_m(32));
    }

    #[test]
    fn arrival_is_the_entry_of_a_segment_into_the_disc() {
        let still = CurrentField::uniform(0.0, 0.0).unwrap();
        let waters = Waters { currents: &still, domain: domain() };
        let (from, goal) = (Position::new(0.0, 0.0), Position::new(0.0, 3_000.0));
        let route = sail(waters, vehicle(), &mut Fixed(0.0), goal, from, 2.0, 50.0);
        assert_eq!(route.end, RouteEnd::Arrived);
        assert!((route.last().position.north_m - 2_500.0).abs() < 1e-6);
        assert!((route.duration_h() - 2_500.0 / 828.0).abs() < 1e-9);
        // A pass at 400 m counts even though no step ends inside the disc.
        let fast = Vehicle::new(2.0, 500.0, 1.0).unwrap();
        let beside = Position::new(400.0, 900.0);
        let route = sail(waters, fast, &mut Fixed(0.0), beside, from, 0.0, 50.0);
        assert_eq!(route.end, RouteEnd::Arrived);
        assert!((route.last().position.distance_m(beside) - 500.0).abs() < 1e-6);
    }

    #[test]
    fn a_route_ends_at_the_wall_on_land_or_when_time_is_over() {
        let drift = CurrentField::uniform(-0.5, 0.0).unwrap();
        let waters = Waters { currents: &drift, domain: domain() };
        let (from, goal) = (Position::new(0.0, 0.0), Position::new(20_000.0, 0.0));
        let east = std::f64::consts::FRAC_PI_2;
        let swept = sail(waters, vehicle(), &mut Fixed(east), goal, from, 0.0, 100.0);
        assert_eq!(swept.end, RouteEnd::LeftDomain);
        assert!((swept.closest_approach_m - 20_000.0).abs() < 1e-9);
        assert!(swept.failure().unwrap().contains("20.0 km"));

        let under_way = sail(waters, vehicle(), &mut Fixed(east), goal, from, 0.0, 6.5);
        assert_eq!(under_way.end, RouteEnd::UnderWay);
        assert_eq!(under_way.points.len(), 8);
        assert!((under_way.last().time_h - 6.5).abs() < 1e-9);

        let nodes = vec![0.0, 10_000.0, 20_000.0];
        let u = [0.0, f64::NAN, 0.0];
        let island = CurrentField::new(nodes, vec![0.0], vec![0.0], &u, &[0.0; 3]).unwrap();
        let waters = Waters { currents: &island, domain: domain() };
        let aground = sail(waters, vehicle(), &mut Fixed(east), goal, from, 0.0, 100.0);
        assert_eq!(aground.end, RouteEnd::RanAground);
        let ashore = Position::new(10_000.0, 0.0);
        let to_land = sail(waters, vehicle(), &mut Fixed(east), ashore, from, 0.0, 9.0);
        assert_eq!(to_land.end, RouteEnd::Unreachable(Unreachable::Goal(Obstacle::Land)));
    }
}
