//! The planners against an independent solver's travel times.

use sonarfleet::assignment::{AssignmentObjective, CostMatrix, assign};
use sonarfleet::navigation::{NavigationInstance, Planner, TimeOptimal, Waters};
use sonarfleet::npz::{Archive, NamedArray, Values, write};
use std::path::{Path, PathBuf};

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/navigation_mid/instance.npz")
}

#[test]
fn the_matrix_and_its_assignment_agree_with_the_reference() {
    let instance = NavigationInstance::open(path()).unwrap();
    let reference = Archive::open(path()).unwrap();
    let best_h = reference.f64s_of_shape("T40", &[40, 40]).unwrap().values;
    let lap_sum = reference.f64s("lap_sum").unwrap().values[0];

    let waters = Waters { currents: &instance.currents, domain: instance.domain };
    let vehicle = instance.vehicle(1.0).unwrap();
    let planner = TimeOptimal { horizon_h: instance.horizon_h, ..TimeOptimal::default() };
    let plan = planner.prepare(waters, vehicle, &instance.goals, 0.0).unwrap();
    let times = plan.travel_times(&instance.starts);

    let mut errors: Vec<f64> = times
        .hours()
        .iter()
        .zip(&best_h)
        .filter(|(_, best)| best.is_finite())
        .map(|(hours, best)| (hours - best).abs() / best)
        .collect();
    errors.sort_by(f64::total_cmp);
    let median = errors[errors.len() / 2];

    let costs = CostMatrix::new(40, 40, times.assignment_costs_h()).unwrap();
    let chosen = assign(&costs, AssignmentObjective::Sum).unwrap();
    let truly: f64 = chosen
        .column_of_row
        .iter()
        .enumerate()
        .map(|(row, column)| {
            let column = column.unwrap();
            let best_h = best_h[row * 40 + column];
            // The reference does not reach some posts that can be reached along the wall.
            if best_h.is_finite() {
                return best_h;
            }
            let route = plan.follow(column, instance.starts[row], 0.0, f64::INFINITY);
            assert!(route.arrived());
            route.duration_h()
        })
        .sum();
    let regret = truly / lap_sum - 1.0;
    println!("median error {median:.4}, regret {regret:.5}");
    assert!(median < 0.02, "{median}");
    assert!(regret < 0.001, "{regret}");
}

#[test]
fn followed_routes_take_the_best_known_time() {
    let instance = NavigationInstance::open(path()).unwrap();
    let best_h = Archive::open(path()).unwrap().f64s("T_star").unwrap().values;
    let waters = Waters { currents: &instance.currents, domain: instance.domain };
    let vehicle = instance.vehicle(1.0).unwrap();
    let reachable = instance.trips.iter().zip(best_h).filter(|(_, best)| best.is_finite());
    // Every fourth trip keeps the test short.
    let ratios: Vec<f64> = reachable
        .step_by(4)
        .map(|(trip, best_h)| {
            let goals = [trip.goal];
            let planner = TimeOptimal::default();
            let plan = planner.prepare(waters, vehicle, &goals, trip.departure_h).unwrap();
            let route = plan.follow(0, trip.start, trip.departure_h, f64::INFINITY);
            assert!(route.arrived(), "{trip:?}: {:?}", route.end);
            route.duration_h() / best_h
        })
        .collect();
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    println!("mean ratio to the best known time {mean:.4} over {} trips", ratios.len());
    assert!(mean < 1.01, "{ratios:?}");
}

#[test]
fn damaged_instances_name_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.npz");
    let open = |arrays: &[NamedArray<'_>]| {
        write(&file, arrays).unwrap();
        NavigationInstance::open(&file).unwrap_err().to_string()
    };
    let params = br#"{"auv_speed_m_s": 0.2, "goal_radius_km": 0.5, "transit_margin_km": 5,
        "horizon_h": 100}"#;
    let text = |bytes| NamedArray { key: "params", shape: &[], values: Values::Bytes(bytes) };
    let whole = NamedArray { shape: &[params.len()], ..text(params) };
    let array = |key, shape, values| NamedArray { key, shape, values: Values::F64(values) };
    let axes = [
        array("xs_km", &[2], &[0.0, 30.0]),
        array("ys_km", &[2], &[0.0, 30.0]),
        array("times_h", &[1], &[0.0]),
    ];
    assert!(open(&[]).contains("no array `params`"));
    let no_json = NamedArray { key: "params", shape: &[2], values: Values::Bytes(b"{]") };
    assert!(open(&[no_json]).contains("JSON"));
    let u = array("u", &[1, 2, 2], &[0.1; 4]);
    assert!(open(&[whole, axes[0], axes[1], axes[2], u]).contains("no array `v`"));
    let v = array("v", &[2, 2], &[0.1; 4]);
    assert!(open(&[whole, axes[0], axes[1], axes[2], u, v]).contains("`v` has shape [2, 2]"));
    let dry = [array("u", &[1, 2, 2], &[f64::NAN; 4]), array("v", &[1, 2, 2], &[0.0; 4])];
    let message = open(&[whole, axes[0], axes[1], axes[2], dry[0], dry[1]]);
    assert!(message.contains("no current anywhere"), "{message}");
    std::fs::write(&file, b"PK").unwrap();
    assert!(NavigationInstance::open(&file).is_err());
}
