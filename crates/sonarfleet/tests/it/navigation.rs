//! Planners in currents whose answers are known.

use jiff::{SignedDuration, Timestamp};
use sonarfleet::grid::Position;
use sonarfleet::navigation::{
    Crab, CurrentField, NavigationError, Obstacle, Planner, RouteEnd, TimeOptimal, TransitDomain,
    Unreachable, Vehicle, Waters,
};
use sonarfleet_ocean::{Forecast, LocalFrame, OceanGrid, OceanState, Region};
use std::sync::Arc;

const SPEED_M_S: f64 = 0.23;
const RADIUS_M: f64 = 500.0;
const SPEED_M_H: f64 = SPEED_M_S * 3600.0;

/// Relative error of the value function at 500 m: interpolation and 32 headings.
const VALUE_TOLERANCE: f64 = 0.02;

/// Relative excess of a route that follows it with hourly commands.
const ROUTE_TOLERANCE: f64 = 0.004;

fn vehicle() -> Vehicle {
    Vehicle::new(SPEED_M_S, RADIUS_M, 1.0).unwrap()
}

/// A small domain, so that tests take no time.
fn domain() -> TransitDomain {
    TransitDomain::around_region(20_000.0, 20_000.0, 4_000.0).unwrap()
}

fn optimal() -> TimeOptimal {
    TimeOptimal { spacing_m: 500.0, horizon_h: 60.0, ..TimeOptimal::default() }
}

fn planners() -> [Box<dyn Planner>; 2] {
    [Box::new(optimal()), Box::new(Crab { horizon_h: 60.0 })]
}

fn at(east_m: f64, north_m: f64) -> Position {
    Position::new(east_m, north_m)
}

/// A rotating, sheared current.
fn eddy() -> CurrentField {
    let nodes: Vec<f64> = (-3..=12).map(|node| f64::from(node) * 2_000.0).collect();
    let times: Vec<f64> = (0..=10).map(|time| f64::from(time) * 6.0).collect();
    let (mut u, mut v) = (Vec::new(), Vec::new());
    for time in &times {
        for y in &nodes {
            for x in &nodes {
                let (dx, dy) = ((x - 9_000.0) / 6_000.0, (y - 11_000.0) / 6_000.0);
                let swirl = 0.25 * (-(dx * dx + dy * dy) / 2.0).exp();
                let phase = time * 0.19;
                u.push(-swirl * dy + 0.04 * phase.cos());
                v.push(swirl * dx + 0.04 * phase.sin());
            }
        }
    }
    CurrentField::new(nodes.clone(), nodes, times, &u, &v).unwrap()
}

#[test]
fn still_water_is_crossed_in_a_straight_line_at_the_vehicles_speed() {
    let still = CurrentField::uniform(0.0, 0.0).unwrap();
    let waters = Waters { currents: &still, domain: domain() };
    let (from, goal) = (at(1_000.0, 2_000.0), at(16_000.0, 9_000.0));
    let exact_h = (from.distance_m(goal) - RADIUS_M) / SPEED_M_H;
    for planner in planners() {
        let plan = planner.prepare(waters, vehicle(), &[goal], 3.0).unwrap();
        let route = plan.follow(0, from, 3.0, 1e3);
        assert!(route.arrived());
        let excess_m = (route.duration_h() - exact_h) * SPEED_M_H;
        println!("{}: {excess_m:.3} m longer than the line", planner.name());
        let exact = planner.name() == "crab";
        let allowed_m = if exact { 1.0 } else { ROUTE_TOLERANCE * exact_h * SPEED_M_H };
        assert!((-0.01..allowed_m).contains(&excess_m));
        let hours = plan.travel_times(&[from]).pair(0, 0).hours;
        let allowed = if exact { 1e-6 } else { VALUE_TOLERANCE };
        assert!((hours / exact_h - 1.0).abs() < allowed, "{hours} h for {exact_h} h");
    }
}

#[test]
fn a_uniform_current_gives_zermelos_time() {
    let (u, v) = (-0.08, 0.11);
    let uniform = CurrentField::uniform(u, v).unwrap();
    let waters = Waters { currents: &uniform, domain: domain() };
    let (from, goal) = (at(2_000.0, 3_000.0), at(15_000.0, 12_000.0));
    // |g − x − u τ| = r + V τ, by bisection.
    let (gx, gy) = (goal.east_m - from.east_m, goal.north_m - from.north_m);
    let outside = |hours: f64| {
        let seconds = hours * 3600.0;
        (gx - u * seconds).hypot(gy - v * seconds) > RADIUS_M + SPEED_M_S * seconds
    };
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if outside(middle) { low = middle } else { high = middle }
    }
    let plan = optimal().prepare(waters, vehicle(), &[goal], 0.0).unwrap();
    let route = plan.follow(0, from, 0.0, 1e3);
    let ratio = route.duration_h() / low;
    println!("time-optimal: {ratio:.5} of the closed form {low:.3} h");
    assert!(route.arrived() && ratio > 0.9999 && ratio < 1.0 + ROUTE_TOLERANCE, "{ratio}");
    let hours = plan.travel_times(&[from]).pair(0, 0).hours;
    assert!((hours / low - 1.0).abs() < VALUE_TOLERANCE, "{hours} h for {low} h");

    // Crab stays on the line to the goal's centre, which the disc makes a little longer.
    let distance_m = gx.hypot(gy);
    let (along, across) = ((u * gx + v * gy) / distance_m, (u * gy - v * gx) / distance_m);
    let made_good_m_s = along + (SPEED_M_S * SPEED_M_S - across * across).sqrt();
    let line_h = (distance_m - RADIUS_M) / made_good_m_s / 3600.0;
    let plan = Crab::default().prepare(waters, vehicle(), &[goal], 0.0).unwrap();
    let crab_h = plan.follow(0, from, 0.0, 1e3).duration_h();
    println!("crab: {crab_h:.4} h, on the line {line_h:.4} h");
    assert!((crab_h - line_h).abs() * SPEED_M_H < 1.0 && crab_h > low);
}

#[test]
fn value_functions_grow_with_the_distance_and_shrink_along_the_route() {
    let still = CurrentField::uniform(0.0, 0.0).unwrap();
    let waters = Waters { currents: &still, domain: domain() };
    let goal = at(10_000.0, 10_000.0);
    let plan = optimal().prepare(waters, vehicle(), &[goal], 0.0).unwrap();
    for bearing in [0.0, 0.4, 2.1, 4.4_f64] {
        let starts: Vec<Position> = (1..40)
            .map(|step| f64::from(step) * 300.0)
            .map(|r| at(10_000.0 + r * bearing.sin(), 10_000.0 + r * bearing.cos()))
            .collect();
        let hours = plan.travel_times(&starts).hours();
        assert!(hours.is_sorted(), "bearing {bearing}: {hours:?}");
    }

    let currents = eddy();
    let waters = Waters { currents: &currents, domain: domain() };
    let plan = optimal().prepare(waters, vehicle(), &[goal], 0.0).unwrap();
    let route = plan.follow(0, at(1_000.0, 18_000.0), 0.0, 1e3);
    assert!(route.arrived());
    let mut left_h = f64::INFINITY;
    for point in route.points.iter().take_while(|point| point.time_h < route.duration_h() - 1.0) {
        let plan = optimal().prepare(waters, vehicle(), &[goal], point.time_h).unwrap();
        let hours = plan.travel_times(&[point.position]).pair(0, 0).hours;
        assert!(hours < left_h, "{hours} h to go after {left_h} h");
        left_h = hours;
    }
}

#[test]
fn the_optimum_beats_crab_in_an_eddy() {
    let currents = eddy();
    let waters = Waters { currents: &currents, domain: domain() };
    let goals = [at(17_000.0, 16_000.0), at(3_000.0, 6_000.0)];
    let from = at(6_000.0, 16_000.0);
    let [optimal, crab] = planners().map(|planner| {
        let plan = planner.prepare(waters, vehicle(), &goals, 0.0).unwrap();
        [0, 1].map(|goal| plan.follow(goal, from, 0.0, 1e3).duration_h())
    });
    println!("time-optimal {optimal:?} h, crab {crab:?} h");
    assert!(optimal[0] < crab[0] * 1.001 && optimal[1] < crab[1] * 1.001);
    assert!(optimal[0] < 0.98 * crab[0]);
}

#[test]
fn unreachable_goals_say_why() {
    let strong = CurrentField::uniform(-0.26, 0.0).unwrap();
    let waters = Waters { currents: &strong, domain: domain() };
    let goals = [at(19_000.0, 10_000.0), at(60_000.0, 0.0)];
    let short = TimeOptimal { horizon_h: 30.0, ..optimal() };
    let plan = short.prepare(waters, vehicle(), &goals, 0.0).unwrap();
    let starts = [at(18_000.0, 10_000.0), at(-3_900.0, 10_000.0), at(-9_000.0, 0.0)];
    let times = plan.travel_times(&starts);
    let pair = |start, goal| *times.pair(start, goal);

    let upstream = pair(0, 0);
    assert_eq!(upstream.unreachable, Some(Unreachable::OutOfTime { horizon_h: 30.0 }));
    assert!(upstream.hours.is_infinite() && upstream.closest_approach_m > 0.0);
    assert_eq!(pair(1, 0).unreachable, Some(Unreachable::SweptAway));
    let outside = Obstacle::OutsideDomain;
    assert_eq!(pair(0, 1).unreachable, Some(Unreachable::Goal(outside)));
    assert_eq!(pair(2, 0).unreachable, Some(Unreachable::Start(outside)));
    // The assignment still has finite costs, beyond the horizon.
    assert!(times.assignment_costs_h().iter().all(|&cost| cost >= 30.0 && cost.is_finite()));

    let route = plan.follow(0, starts[0], 0.0, 1e3);
    assert_eq!(route.end, RouteEnd::Unreachable(Unreachable::OutOfTime { horizon_h: 30.0 }));
    assert!(route.failure().unwrap().contains("closest approach"));
    assert_eq!(plan.follow(0, starts[1], 0.0, 1e3).end, RouteEnd::LeftDomain);
}

#[test]
fn a_matrix_equals_single_solves_on_any_number_of_threads() {
    let currents = eddy();
    let waters = Waters { currents: &currents, domain: domain() };
    let goals: Vec<Position> = (0..11)
        .map(|goal| at(1_900.0 * f64::from(goal), 19_000.0 - 1_700.0 * f64::from(goal)))
        .collect();
    let starts = [at(500.0, 500.0), at(12_000.0, 9_000.0)];
    for planner in planners() {
        let matrix = |threads: usize, goals: &[Position]| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let plan = planner.prepare(waters, vehicle(), goals, 2.0).unwrap();
                plan.travel_times(&starts).hours()
            })
        };
        let bits = |hours: &[f64]| hours.iter().map(|hours| hours.to_bits()).collect::<Vec<_>>();
        let all = matrix(1, &goals);
        assert_eq!(bits(&all), bits(&matrix(2, &goals)), "{}", planner.name());
        for (index, goal) in goals.iter().enumerate() {
            let single = matrix(1, &[*goal]);
            let column = [all[index], all[goals.len() + index]];
            assert_eq!(bits(&single), bits(&column), "{} goal {index}", planner.name());
        }
    }
}

#[test]
fn a_route_followed_in_parts_is_the_whole_route() {
    let currents = eddy();
    let waters = Waters { currents: &currents, domain: domain() };
    let goal = at(17_000.0, 16_000.0);
    for planner in planners() {
        let plan = planner.prepare(waters, vehicle(), &[goal], 0.0).unwrap();
        let from = at(1_000.0, 2_000.0);
        let whole = plan.follow(0, from, 0.0, 1e3);
        let first = plan.follow(0, from, 0.0, 6.0);
        assert_eq!(first.end, RouteEnd::UnderWay);
        let rest = plan.follow(0, first.last().position, first.last().time_h, 1e3);
        assert!(rest.arrived());
        assert!((rest.last().time_h - whole.last().time_h).abs() < 1e-6, "{}", planner.name());
    }
}

#[test]
fn routes_go_around_land() {
    let nodes: Vec<f64> = (-2..=12).map(|node| f64::from(node) * 2_000.0).collect();
    let count = nodes.len() * nodes.len();
    let still = vec![0.0; count];
    let open = CurrentField::new(nodes.clone(), nodes, vec![0.0], &still, &still).unwrap();
    let wall = |node: Position| (node.east_m - 10_000.0).abs() < 1.0 && node.north_m < 15_000.0;
    let currents = open.closed_where(wall).unwrap();
    let waters = Waters { currents: &currents, domain: domain() };
    let (from, goal) = (at(5_000.0, 10_000.0), at(15_000.0, 10_000.0));
    let plan = optimal().prepare(waters, vehicle(), &[goal, at(10_000.0, 5_000.0)], 0.0).unwrap();
    let route = plan.follow(0, from, 0.0, 1e3);
    assert!(route.arrived(), "{:?}", route.end);
    let northernmost = route.points.iter().map(|point| point.position.north_m).fold(0.0, f64::max);
    assert!(northernmost > 15_000.0);
    let to_land = plan.travel_times(&[from]).pair(0, 1).unreachable;
    assert_eq!(to_land, Some(Unreachable::Goal(Obstacle::Land)));
    let crab = Crab::default().prepare(waters, vehicle(), &[goal], 0.0).unwrap();
    assert_eq!(crab.follow(0, from, 0.0, 1e3).end, RouteEnd::RanAground);
}

#[test]
fn currents_come_from_a_forecast() {
    let start: Timestamp = "2025-10-09T00:00:00Z".parse().unwrap();
    let grid = Arc::new(OceanGrid {
        longitude_deg: vec![118.0, 118.25, 118.5],
        latitude_deg: vec![21.4, 21.7, 22.0],
        depth_m: vec![0.0, 100.0, 300.0],
    });
    let state = |hours: i64| {
        let level = |node: usize| node / 9;
        let east: Vec<f32> =
            (0..27).map(|node| [0.5, 0.3, 0.1][level(node)] + 0.01 * hours as f32).collect();
        OceanState {
            grid: grid.clone(),
            time: start + SignedDuration::from_hours(hours),
            temperature_c: vec![10.0; 27],
            salinity_psu: vec![34.0; 27],
            current_east_m_s: east,
            current_north_m_s: vec![-0.1; 27],
        }
    };
    let forecast = Forecast { states: vec![state(0), state(6)] };
    let region = Region { west_deg: 118.1, east_deg: 118.4, south_deg: 21.6, north_deg: 21.88 };
    let frame = LocalFrame::new(region);
    let domain = TransitDomain::around_region(frame.width_m(), frame.height_m(), 5_000.0).unwrap();
    let run_start = start + SignedDuration::from_hours(3);
    let currents =
        CurrentField::from_forecast(&forecast, &frame, 200.0, domain, run_start).unwrap();
    let [u, v] = currents.velocity_m_s(at(10_000.0, 12_345.0), 0.0);
    assert!((u - 0.23).abs() < 1e-6 && (v + 0.1).abs() < 1e-6, "({u}, {v}) m/s");
    assert_eq!(currents.time_span_h(), (-3.0, 3.0));

    let mut dry = forecast.clone();
    for state in &mut dry.states {
        state.current_east_m_s.fill(f32::NAN);
    }
    let none = CurrentField::from_forecast(&dry, &frame, 200.0, domain, run_start);
    assert!(matches!(none, Err(NavigationError::NoWater { .. })));
    let empty = Forecast { states: Vec::new() };
    let none = CurrentField::from_forecast(&empty, &frame, 200.0, domain, run_start);
    assert!(matches!(none, Err(NavigationError::InvalidAxis { axis: "time", .. })));
}

#[test]
fn impossible_plans_are_refused() {
    let still = CurrentField::uniform(0.0, 0.0).unwrap();
    let waters = Waters { currents: &still, domain: domain() };
    let error = |planner: &dyn Planner, goals: &[Position]| {
        planner.prepare(waters, vehicle(), goals, 0.0).err().map(|error| error.to_string())
    };
    for planner in planners() {
        assert!(error(planner.as_ref(), &[]).unwrap().contains("no goals"));
        let nowhere = [at(0.0, 0.0), at(f64::NAN, 0.0)];
        assert!(error(planner.as_ref(), &nowhere).unwrap().contains("goal 1"));
    }
    let few = TimeOptimal { headings: 2, ..optimal() };
    assert!(error(&few, &[at(0.0, 0.0)]).unwrap().contains("headings"));
}
