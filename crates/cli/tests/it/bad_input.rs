//! What goes wrong is said: file, key, what was found, what was expected.

use crate::program::{SCENARIO, fail, succeed, write};
use std::fs;
use std::path::Path;

/// Asserts that a run of a scenario fails with all of these words, and leaves nothing.
fn assert_refused(home: &Path, scenario: &str, words: &[&str]) {
    write(home, "bad.toml", scenario);
    let complaint = fail(home, &["run", "bad.toml", "--output", "out"]);
    for word in words {
        assert!(complaint.contains(word), "no {word:?} in: {complaint}");
    }
    assert!(!home.join("out").exists() && !home.join("out.partial").exists(), "{complaint}");
}

/// The test scenario with one text replaced.
fn but(from: &str, to: &str) -> String {
    assert!(SCENARIO.contains(from), "{from}");
    SCENARIO.replacen(from, to, 1)
}

/// The test scenario on files.
fn on_files(states: &str, bathymetry: &str) -> String {
    format!(
        "{SCENARIO}\n[ocean]\nsource = \"files\"\nfiles = [{states}]\nbathymetry = {bathymetry}\n"
    )
}

#[test]
fn scenario_mistakes() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let complaint = fail(home, &["run", "absent.toml"]);
    assert!(complaint.contains("absent.toml"), "{complaint}");

    assert_refused(home, "name = ", &["bad.toml", "line 1"]);
    assert_refused(
        home,
        &but("vehicles = 4", "vehicels = 4"),
        &["bad.toml", "vehicels", "vehicles"],
    );
    let quiet = but("source_level_db = 130.0", "source_level_db = 13.0");
    assert_refused(home, &quiet, &["bad.toml", "sonar.source_level_db", "13", "60 to 260 dB"]);
    let metres = but("transit_margin_km = 3.0", "transit_margin_km = 3000.0");
    assert_refused(home, &metres, &["navigation.transit_margin_km", "3000", "0 to 1000 km"]);
    assert_refused(
        home,
        &but("vehicles = 4", "vehicles = 37"),
        &["fleet.vehicles", "37", "1 to 36"],
    );
    let far = but("[[0.5, 1.0], [0.5, 5.0]]", "[[0.5, 1.0], [0.5, 99.0]]");
    assert_refused(home, &far, &["fleet.entry_line_km", "inside the region"]);
    let unknown = but("evaluations = 5000", "method = \"magic\"");
    assert_refused(home, &unknown, &["placement.method", "magic", "annealing"]);
    let line = but("intercept = 13.0", "intercept = 99.0");
    assert_refused(home, &line, &["prior", "99", "does not cross"]);
    let table = but("quality = \"fast\"", "files = [\"t0.nc\"]");
    assert_refused(home, &table, &["transmission_loss.files", "one per epoch"]);
    let area = format!("{SCENARIO}\n[deployable]\nexclusions = \"area.json\"\n");
    assert_refused(home, &area, &["deployable.exclusions", "area.json", "no such file"]);
    write(home, "area.json", "{\"type\":\"Point\",\"coordinates\":[118.2,21.7]}");
    assert_refused(home, &area, &["area.json", "no polygon"]);
    let everywhere =
        r#"{"type":"Polygon","coordinates":[[[118,21],[119,21],[119,22],[118,22],[118,21]]]}"#;
    write(home, "area.json", everywhere);
    assert_refused(home, &area, &["none of the 36 cells", "200 m"]);
    let corner = r#"{"type":"Polygon","coordinates":[[[118.205,21],[119,21],[119,22],[118.205,22],[118.205,21]]]}"#;
    write(home, "area.json", corner);
    assert_refused(
        home,
        &but("vehicles = 4", "vehicles = 20")
            .replace("[time]", "[deployable]\nexclusions = \"area.json\"\n[time]"),
        &["20 vehicles", "deployable"],
    );
}

#[test]
fn ocean_mistakes() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    succeed(home, &["ocean", "synth", "d", "--scenario", "test.toml", "--quiet"]);
    let states = r#""d/thetao.nc", "d/so.nc", "d/uo_vo.nc""#;
    let floor = r#""d/bathymetry.nc""#;

    assert_refused(home, &on_files(r#""d/gone.nc""#, floor), &["gone.nc", "no such file"]);
    write(home, "d/text.nc", "depth,temperature\n1,2\n");
    assert_refused(home, &on_files(r#""d/text.nc""#, floor), &["text.nc", "NetCDF"]);
    let whole = fs::read(home.join("d/thetao.nc")).unwrap();
    fs::write(home.join("d/half.nc"), &whole[..whole.len() / 2]).unwrap();
    assert_refused(home, &on_files(r#""d/half.nc", "d/so.nc", "d/uo_vo.nc""#, floor), &["half.nc"]);
    let no_currents = on_files(r#""d/thetao.nc", "d/so.nc""#, floor);
    assert_refused(home, &no_currents, &["eastward current", "uo", "thetao.nc"]);
    assert_refused(home, &on_files(states, r#""d/so.nc""#), &["so.nc", "bathymetry", "elevation"]);

    let elsewhere = on_files(states, floor)
        .replace("west_deg = 118.2\neast_deg = 118.26", "west_deg = 10.2\neast_deg = 10.26");
    assert_refused(home, &elsewhere, &["10.", "118"]);
    let later = on_files(states, floor)
        .replace("epochs = 2", "epochs = 2\nstart = \"2031-01-01T00:00:00Z\"");
    assert_refused(home, &later, &["2031-01-01", "2025-10-19"]);
    let deep = on_files(states, floor).replace("vehicles = 4", "vehicles = 4\ndepth_m = 5900.0");
    assert_refused(home, &deep, &["5900"]);
}

#[test]
fn an_output_that_cannot_be_written() {
    let home = tempfile::tempdir().unwrap();
    write(home.path(), "test.toml", SCENARIO);
    write(home.path(), "file", "in the way");
    let complaint = fail(home.path(), &["run", "test.toml", "--output", "file/out"]);
    assert!(complaint.contains("file"), "{complaint}");
    let complaint = fail(home.path(), &["run", "test.toml", "--output", "file"]);
    assert!(complaint.contains("exists already"), "{complaint}");
    let complaint = fail(home.path(), &["run", "test.toml", "--output", "new", "--resume"]);
    assert!(complaint.contains("no unfinished run"), "{complaint}");
}

#[test]
fn files_of_the_other_commands() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "costs.csv", "1,2\n3,x\n");
    assert!(fail(home, &["assign", "costs.csv"]).contains("row 1, column 1"));
    write(home, "costs.csv", "1,\n2,\n");
    assert!(fail(home, &["assign", "costs.csv"]).contains("costs.csv"));
    write(home, "not.npz", "text");
    for command in ["place", "route"] {
        let complaint = fail(home, &[command, "not.npz"]);
        assert!(complaint.contains("not.npz"), "{complaint}");
    }
    let complaint = fail(home, &["place", "not.npz", "--epoch", "2"]);
    assert!(complaint.contains("not.npz") && complaint.contains("epoch 0 only"), "{complaint}");
    write(home, "test.toml", SCENARIO);
    let complaint = fail(home, &["tl", "test.toml", "--output", "tl.txt"]);
    assert!(complaint.contains("tl.txt"), "{complaint}");
    let complaint = fail(home, &["tl", "test.toml", "--output", "tl.nc", "--epoch", "2"]);
    assert!(complaint.contains("epochs 0 to 1"), "{complaint}");
    let complaint = fail(home, &["init", "test.toml"]);
    assert!(complaint.contains("test.toml"), "{complaint}");
    let to_nowhere = ["route", "test.toml", "--from", "1,1km", "--to", "500,1km"];
    let said = succeed(home, &to_nowhere);
    assert!(said.contains("unreachable") && said.contains("outside"), "{said}");
}
