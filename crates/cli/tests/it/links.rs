//! Every link alone: files in, files out.

use crate::program::{SCENARIO, json, succeed, write};
use sonarfleet::scenario::ScenarioFile;
use std::fs;

#[test]
fn placement_posts_become_a_matrix_and_an_assignment() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    let layout = json(home, &["place", "test.toml", "--method", "connected-greedy"]);
    assert_eq!(layout["method"], "connected-greedy");
    assert_eq!(layout["cells"].as_array().unwrap().len(), 4);
    write(home, "layout.json", &layout.to_string());
    let matrix = json(
        home,
        &["route", "matrix", "test.toml", "--posts", "layout.json", "--output", "m.npz"],
    );
    let hours = matrix["travel_time_h"].as_array().unwrap();
    assert_eq!((hours.len(), hours[0].as_array().unwrap().len()), (4, 4));
    let said = json(home, &["assign", "m.npz"]);
    assert_eq!(said["certified"], true);
    let mut posts: Vec<u64> =
        said["assignment"].as_array().unwrap().iter().map(|post| post.as_u64().unwrap()).collect();
    posts.sort_unstable();
    assert_eq!(posts, [0, 1, 2, 3]);
    succeed(home, &["route", "matrix", "test.toml", "--posts", "layout.json", "--output", "m.nc"]);
}

#[test]
fn a_route_in_every_format() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    for format in ["geojson", "kml", "gpx", "csv"] {
        let name = format!("route.{format}");
        let arguments =
            ["route", "test.toml", "--from", "1,1km", "--to", "4,5km", "--output", &name];
        succeed(home, &arguments);
        assert!(fs::read_to_string(home.join(&name)).unwrap().contains("118.2"), "{format}");
    }
    for pilot in ["time-optimal", "crab"] {
        let arguments = [
            "route",
            "test.toml",
            "--from",
            "118.21,21.71",
            "--to",
            "118.25,21.75",
            "--pilot",
            pilot,
        ];
        let said = json(home, &arguments);
        assert_eq!(said["pilot"], pilot);
        assert_eq!(said["routes"][0]["arrived"], true);
    }
}

#[test]
fn ocean_files_show_what_they_hold() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    succeed(home, &["ocean", "synth", "d", "--scenario", "test.toml", "--quiet"]);
    let files = ["d/thetao.nc", "d/so.nc", "d/uo_vo.nc"];
    let said = succeed(home, &["ocean", "inspect", files[0], "d/bathymetry.nc"]);
    assert!(said.contains("thetao") && said.contains("elevation") && said.contains("SYNTHETIC"));
    json(home, &["ocean", "inspect", files[2]]);

    let place = ["--longitude", "118.23", "--latitude", "21.73"];
    let csv = succeed(home, &[&["ocean", "profile"], &files[..], &place[..]].concat());
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "depth_m,temperature_c,salinity_psu,sound_speed_m_s,current_east_m_s,current_north_m_s"
    );
    let surface: Vec<f64> =
        lines.next().unwrap().split(',').map(|field| field.parse().unwrap()).collect();
    assert!((1535.0..1547.0).contains(&surface[3]), "{surface:?}");

    let request = succeed(home, &["ocean", "request", "test.toml"]);
    assert!(request.contains("copernicusmarine subset") && request.contains("GEBCO"), "{request}");
}

#[test]
fn the_first_scenario_of_a_newcomer_is_the_embedded_one() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    succeed(home, &["init", "mine.toml"]);
    let mine = ScenarioFile::read(&home.join("mine.toml")).unwrap();
    let mut defaults = ScenarioFile::default();
    defaults.sonar.detection_threshold_db = mine.sonar.detection_threshold_db;
    assert_eq!(mine, defaults, "the embedded scenario shows the defaults");
    let said = succeed(home, &["check", "mine.toml"]);
    assert!(said.contains("can be run") && said.contains("30 × 30"), "{said}");
    assert_eq!(json(home, &["check", "mine.toml"])["usable"], true);
}
