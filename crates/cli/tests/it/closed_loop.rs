//! `sonarfleet run`: whole runs, their results and their reproducibility.

use crate::program::{
    SCENARIO, assert_same_results, fail, json, sonarfleet, succeed, wait_for, write,
};
use std::process::Stdio;

#[test]
fn a_seed_gives_the_same_bytes_on_one_thread_and_on_two() {
    let home = tempfile::tempdir().unwrap();
    write(home.path(), "test.toml", SCENARIO);
    for threads in ["1", "2"] {
        let arguments = ["run", "test.toml", "--quiet", "--output", threads, "--threads", threads];
        succeed(home.path(), &[&arguments[..], &["--no-cache"]].concat());
    }
    assert_same_results(&home.path().join("1"), &home.path().join("2"));
}

#[test]
fn a_run_says_what_came_of_it_and_leaves_everything_promised() {
    let home = tempfile::tempdir().unwrap();
    write(home.path(), "test.toml", SCENARIO);
    let said = json(home.path(), &["run", "test.toml", "--output", "out", "--seed", "11"]);
    let epochs = said["epochs"].as_array().unwrap();
    assert_eq!(epochs.len(), 2);
    for epoch in epochs {
        assert_eq!(epoch["feasible"], true);
        let utility = epoch["detection_utility"].as_f64().unwrap();
        assert!(utility > epoch["random_detection_utility"].as_f64().unwrap());
        assert!(utility <= epoch["upper_bound"].as_f64().unwrap());
        assert!(epoch["seconds"]["transmission loss"].as_f64().unwrap() > 0.0);
    }
    let out = home.path().join("out");
    for name in [
        "scenario.toml",
        "run.json",
        "metrics.jsonl",
        "timings.jsonl",
        "epoch-0.nc",
        "epoch-1.nc",
        "routes.geojson",
        "report.html",
        "figures/routes.png",
    ] {
        assert!(out.join(name).is_file(), "{name}");
    }
    assert!(!out.join("checkpoint.bin").exists());
    assert!(!home.path().join("out.partial").exists());

    // The resolved scenario is a scenario, and gives the same run.
    let resolved = out.join("scenario.toml");
    let again = ["run", resolved.to_str().unwrap(), "--quiet", "--output", "again"];
    succeed(home.path(), &again);
    assert_same_results(&out, &home.path().join("again"));
}

#[test]
fn another_method_than_the_scenarios_may_place_the_fleet() {
    let home = tempfile::tempdir().unwrap();
    write(home.path(), "test.toml", SCENARIO);
    let run = ["run", "test.toml", "--output", "out", "--method"];
    let said = json(home.path(), &[&run[..], &["connected-greedy"]].concat());
    for epoch in said["epochs"].as_array().unwrap() {
        assert_eq!(epoch["feasible"], true);
        assert_eq!(epoch["placement_parts"].as_array().map_or(0, Vec::len), 0, "one part only");
    }
    let resolved = std::fs::read_to_string(home.path().join("out/scenario.toml")).unwrap();
    assert!(resolved.contains("method = \"connected-greedy\""), "{resolved}");
    let complaint = fail(home.path(), &[&run[..], &["guessing"]].concat());
    assert!(complaint.contains("guessing") && complaint.contains("annealing"), "{complaint}");
}

#[test]
fn a_killed_run_resumes_and_ends_as_if_never_killed() {
    let home = tempfile::tempdir().unwrap();
    write(home.path(), "test.toml", SCENARIO);
    let quietly = ["--quiet", "--no-cache"];
    succeed(home.path(), &[&["run", "test.toml", "--output", "whole"], &quietly[..]].concat());

    let mut killed = sonarfleet(home.path())
        .args(["run", "test.toml", "--output", "killed"])
        .args(quietly)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let checkpoint = home.path().join("killed.partial/checkpoint.bin");
    wait_for(|| checkpoint.exists());
    killed.kill().unwrap();
    killed.wait().unwrap();
    // It may have been faster than us; then there is nothing to resume.
    if !home.path().join("killed").exists() {
        let resume = ["run", "test.toml", "--output", "killed", "--resume"];
        succeed(home.path(), &[&resume, &quietly[..]].concat());
    }
    assert_same_results(&home.path().join("whole"), &home.path().join("killed"));
}

#[test]
fn files_of_the_synthetic_ocean_give_the_embedded_results() {
    let home = tempfile::tempdir().unwrap();
    write(home.path(), "test.toml", SCENARIO);
    succeed(home.path(), &["ocean", "synth", "d", "--scenario", "test.toml", "--quiet"]);
    let files = "[ocean]\nsource = \"files\"\n\
        files = [\"d/thetao.nc\", \"d/so.nc\", \"d/uo_vo.nc\"]\nbathymetry = \"d/bathymetry.nc\"\n";
    write(home.path(), "files.toml", &format!("{SCENARIO}\n{files}"));
    let metrics = |scenario: &str, output: &str| {
        succeed(home.path(), &["run", scenario, "--quiet", "--no-cache", "--output", output]);
        std::fs::read_to_string(home.path().join(output).join("metrics.jsonl")).unwrap()
    };
    assert_eq!(metrics("test.toml", "synthetic"), metrics("files.toml", "files"));
}
