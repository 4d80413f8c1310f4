//! `sonarfleet route`: through the currents, one way, all pairs of an instance, or the matrix.

use super::Manner;
use crate::args::{Place, RouteArgs, RouteCommand};
use anyhow::{Context, Result, bail, ensure};
use jiff::Timestamp;
use serde_json::{Value, json};
use sonarfleet::grid::{CellId, Position};
use sonarfleet::mission::Theatre;
use sonarfleet::navigation::{
    CurrentField, NamedRoute, NavigationInstance, Plan, Planner, Route, TimeOptimal, TransitDomain,
    TravelTimes, Trip, Vehicle, Waters, write_matrix, write_routes,
};
use sonarfleet::scenario::{PlannerName, Scenario};
use sonarfleet_ocean::{LocalFrame, Region};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Time between commands where the input does not say it, hours.
const COMMAND_INTERVAL_H: f64 = 1.0;

pub(crate) fn route(args: &RouteArgs, manner: Manner) -> Result<()> {
    match (&args.command, &args.input) {
        (Some(RouteCommand::Matrix { input, output, depart, pilot, posts }), _) => {
            let sea = Sea::open(input, pilot.as_deref())?;
            matrix(&sea, *depart, posts.as_deref(), output.as_deref(), manner)
        }
        (None, Some(input)) => routes(&Sea::open(input, args.pilot.as_deref())?, args, manner),
        (None, None) => bail!("expected a scenario (.toml) or a navigation instance (.npz)"),
    }
}

/// What a route needs, from a scenario or an instance.
struct Sea {
    input: PathBuf,
    currents: CurrentField,
    domain: TransitDomain,
    vehicle: Vehicle,
    planner: Box<dyn Planner>,
    horizon_h: f64,
    frame: LocalFrame,
    start: Timestamp,
    trips: Vec<Trip>,
    fleet: Vec<Position>,
    posts: Vec<Position>,
    grid: Option<sonarfleet::grid::SurveillanceGrid>,
}

impl Sea {
    fn open(input: &Path, pilot: Option<&str>) -> Result<Self> {
        if input.extension().is_some_and(|extension| extension == "npz") {
            Self::of_instance(input, pilot)
        } else {
            Self::of_scenario(input, pilot)
        }
    }

    fn of_instance(input: &Path, pilot: Option<&str>) -> Result<Self> {
        let instance = NavigationInstance::open(input)?;
        let (longitude, latitude) = instance.origin_deg.unwrap_or((0.0, 0.0));
        // A region that is a point: its frame has its origin there.
        let origin = Region {
            west_deg: longitude,
            east_deg: longitude,
            south_deg: latitude,
            north_deg: latitude,
        };
        let horizon_h = instance.horizon_h;
        let time_optimal = TimeOptimal { horizon_h, ..TimeOptimal::default() };
        Ok(Self {
            input: input.to_owned(),
            vehicle: instance.vehicle(COMMAND_INTERVAL_H)?,
            currents: instance.currents,
            domain: instance.domain,
            planner: planner(pilot.unwrap_or("time-optimal"), time_optimal)?,
            horizon_h,
            frame: LocalFrame::new(origin),
            start: Timestamp::UNIX_EPOCH,
            trips: instance.trips,
            fleet: instance.starts,
            posts: instance.goals,
            grid: None,
        })
    }

    fn of_scenario(input: &Path, pilot: Option<&str>) -> Result<Self> {
        let scenario = Scenario::read(input)?;
        let theatre = Theatre::of(&scenario)?;
        Ok(Self {
            input: input.to_owned(),
            currents: theatre.currents,
            domain: scenario.domain,
            vehicle: scenario.vehicle,
            planner: match pilot {
                Some(name) => planner(name, scenario.time_optimal)?,
                None => scenario.planner(),
            },
            horizon_h: scenario.time_optimal.horizon_h,
            frame: scenario.frame.clone(),
            start: scenario.start,
            trips: Vec::new(),
            fleet: scenario.fleet.clone(),
            posts: Vec::new(),
            grid: Some(scenario.grid),
        })
    }

    fn plan(&self, goals: &[Position], departure_h: f64) -> Result<Box<dyn Plan + '_>> {
        let waters = Waters { currents: &self.currents, domain: self.domain };
        Ok(self.planner.prepare(waters, self.vehicle, goals, departure_h)?)
    }

    fn position(&self, place: Place) -> Position {
        match place {
            Place::Kilometres(east, north) => Position::new(east * 1000.0, north * 1000.0),
            Place::Degrees(longitude, latitude) => {
                let (east_m, north_m) = self.frame.to_local(longitude, latitude);
                Position::new(east_m, north_m)
            }
        }
    }
}

/// The planner of a name, as scenarios call it.
fn planner(name: &str, time_optimal: TimeOptimal) -> Result<Box<dyn Planner>> {
    match serde_json::from_value::<PlannerName>(json!(name)) {
        Ok(known) => Ok(known.planner(time_optimal)),
        Err(error) => bail!("--pilot: {error}"),
    }
}

fn routes(sea: &Sea, args: &RouteArgs, manner: Manner) -> Result<()> {
    let trips = match (args.from, args.to) {
        (Some(from), Some(to)) => vec![Trip {
            start: sea.position(from),
            goal: sea.position(to),
            departure_h: args.depart,
        }],
        _ => sea.trips.clone(),
    };
    ensure!(!trips.is_empty(), "{}: holds no pairs; give --from and --to", sea.input.display());
    let mut sailed = Vec::with_capacity(trips.len());
    for trip in &trips {
        let plan = sea.plan(&[trip.goal], trip.departure_h)?;
        let route = plan.follow(0, trip.start, trip.departure_h, f64::INFINITY);
        let expected_h = plan.travel_times(&[trip.start]).pair(0, 0).hours;
        sailed.push((*trip, expected_h, route));
    }
    if let Some(path) = &args.output {
        let names: Vec<String> = (1..=sailed.len()).map(|k| format!("route {k}")).collect();
        let statuses: Vec<String> = sailed.iter().map(|(.., route)| status(route)).collect();
        let tracks: Vec<_> = sailed.iter().map(|(.., route)| route.track()).collect();
        let named: Vec<NamedRoute<'_>> = names
            .iter()
            .zip(&statuses)
            .zip(&tracks)
            .map(|((name, status), points)| NamedRoute { name, status, points })
            .collect();
        write_routes(path, &named, &sea.frame, sea.start)?;
    }
    if manner.json {
        let routes: Vec<Value> = sailed
            .iter()
            .map(|(trip, expected_h, route)| route_json(sea, trip, *expected_h, route))
            .collect();
        return super::print_json(&json!({ "pilot": sea.planner.name(), "routes": routes }));
    }
    for (_, expected_h, route) in &sailed {
        let [from, to] = [route.points[0].position, route.goal].map(kilometres);
        super::say(format_args!(
            "{from} → {to}: {} after {:.2} h (expected {expected_h:.2} h)",
            status(route),
            route.duration_h(),
        ))?;
    }
    Ok(())
}

fn status(route: &Route) -> String {
    route.failure().unwrap_or_else(|| route.end.to_string())
}

fn kilometres(position: Position) -> String {
    format!("({:.2}, {:.2}) km", position.east_m / 1000.0, position.north_m / 1000.0)
}

fn route_json(sea: &Sea, trip: &Trip, expected_h: f64, route: &Route) -> Value {
    let degrees = |position: Position| {
        let (longitude, latitude) = sea.frame.to_geographic(position.east_m, position.north_m);
        json!([longitude, latitude])
    };
    let points: Vec<Value> = route
        .points
        .iter()
        .map(|point| {
            let [u, v] = point.current_m_s;
            json!({
                "time_h": point.time_h,
                "east_km": point.position.east_m / 1000.0,
                "north_km": point.position.north_m / 1000.0,
                "degrees": degrees(point.position),
                "heading_deg": point.heading_rad.to_degrees().rem_euclid(360.0),
                "current_east_m_s": u,
                "current_north_m_s": v,
                "speed_over_ground_m_s": point.speed_over_ground_m_s(sea.vehicle.speed_m_s()),
            })
        })
        .collect();
    json!({
        "from_km": [trip.start.east_m / 1000.0, trip.start.north_m / 1000.0],
        "to_km": [trip.goal.east_m / 1000.0, trip.goal.north_m / 1000.0],
        "depart_h": trip.departure_h,
        "arrived": route.arrived(),
        "status": status(route),
        "travel_time_h": route.arrived().then(|| route.duration_h()),
        "expected_travel_time_h": expected_h,
        "closest_approach_km": route.closest_approach_m / 1000.0,
        "points": points,
    })
}

fn matrix(
    sea: &Sea,
    depart_h: f64,
    posts: Option<&Path>,
    output: Option<&Path>,
    manner: Manner,
) -> Result<()> {
    let goals = match posts {
        Some(path) => read_posts(path, sea)?,
        None => sea.posts.clone(),
    };
    ensure!(
        !goals.is_empty() && !sea.fleet.is_empty(),
        "{}: has no posts; give --posts with the output of `sonarfleet place --json`",
        sea.input.display()
    );
    let started = Instant::now();
    let travel = sea.plan(&goals, depart_h)?.travel_times(&sea.fleet);
    let seconds = started.elapsed().as_secs_f64();
    if let Some(path) = output {
        write_matrix(path, &travel)?;
    }
    let reachable: Vec<f64> = travel.hours().into_iter().filter(|h| h.is_finite()).collect();
    if manner.json {
        return super::print_json(&matrix_json(sea, &travel, seconds));
    }
    super::say(format_args!(
        "{} × {} travel times in {seconds:.2} s: {} reachable, mean {:.2} h, largest {:.2} h \
         (horizon {} h)",
        travel.starts(),
        travel.goals(),
        reachable.len(),
        reachable.iter().sum::<f64>() / reachable.len() as f64,
        reachable.iter().copied().fold(f64::NAN, f64::max),
        sea.horizon_h,
    ))?;
    Ok(())
}

fn matrix_json(sea: &Sea, travel: &TravelTimes, seconds: f64) -> Value {
    // JSON has no infinity: an unreachable post is null.
    let hours = travel.hours();
    let rows: Vec<Vec<Option<f64>>> = hours
        .chunks(travel.goals())
        .map(|row| row.iter().map(|&h| h.is_finite().then_some(h)).collect())
        .collect();
    json!({ "pilot": sea.planner.name(), "travel_time_h": rows, "seconds": seconds })
}

/// The cells of a placement, as `sonarfleet place --json` prints it, as positions.
fn read_posts(path: &Path, sea: &Sea) -> Result<Vec<Position>> {
    let name = path.display();
    let Some(grid) = sea.grid else {
        bail!("--posts goes with a scenario; {} has its own posts", sea.input.display())
    };
    let text = std::fs::read_to_string(path).with_context(|| format!("{name}"))?;
    let placement: Value = serde_json::from_str(&text).with_context(|| format!("{name}"))?;
    let cells: Vec<CellId> = serde_json::from_value(placement["cells"].clone())
        .with_context(|| format!("{name}: `cells` is not a list of cell numbers"))?;
    if let Some(cell) = cells.iter().find(|cell| cell.0 >= grid.cell_count()) {
        bail!("{name}: cell {} is not one of the scenario's {}", cell.0, grid.cell_count());
    }
    Ok(cells.into_iter().map(|cell| grid.centre(cell)).collect())
}
