//! `sonarfleet bench placement`, beside `sonarfleet place`.

use crate::program::{SCENARIO, fail, json, succeed, write};
use serde_json::json;

#[test]
fn a_comparison_holds_what_place_finds() {
    let home = tempfile::tempdir().unwrap();
    write(home.path(), "test.toml", SCENARIO);
    let arguments = [
        ["bench", "placement", "test.toml", "--method", "annealing,genetic", "--seeds", "2"],
        ["--samples", "600", "--threshold", "0.5,0.95", "--figure", "out/methods.svg", "--quiet"],
    ];
    let said = json(home.path(), &arguments.concat());
    let problems = said["problems"].as_array().unwrap();
    assert_eq!(problems.len(), 2);
    for (problem, threshold) in problems.iter().zip([0.5, 0.95]) {
        assert_eq!(problem["problem"], "test");
        assert_eq!(problem["connectivity_threshold"], threshold);
        let names = problem["methods"].as_array().unwrap().iter().map(|m| &m["method"]);
        assert_eq!(names.collect::<Vec<_>>(), ["annealing", "genetic"]);
        assert_eq!(problem["trials"].as_array().unwrap().len(), 4);
        for trial in problem["trials"].as_array().unwrap() {
            let [method, seed, threshold] = [
                trial["method"].as_str().unwrap().to_owned(),
                trial["seed"].to_string(),
                threshold.to_string(),
            ];
            let arguments = [
                ["place", "test.toml", "--method", &method, "--seed", &seed],
                ["--samples", "600", "--threshold", &threshold, "--epoch", "0"],
            ];
            let placed = json(home.path(), &arguments.concat());
            for key in ["detection_utility", "algebraic_connectivity", "feasible", "evaluations"] {
                assert_eq!(trial[key], placed[key], "{method}, {key}");
            }
            assert_eq!(problem["upper_bound"], placed["upper_bound"]);
        }
    }
    for name in ["out/methods.svg", "out/methods.png"] {
        assert!(home.path().join(name).is_file(), "{name}");
    }
    assert_eq!(said["samples"], json!(600));
}

#[test]
fn a_comparison_prints_a_row_per_method() {
    let home = tempfile::tempdir().unwrap();
    write(home.path(), "test.toml", SCENARIO);
    let arguments = ["bench", "placement", "test.toml", "--method", "random", "--method", "greedy"];
    let table = succeed(home.path(), &[&arguments[..], &["--seconds", "0.01"]].concat());
    for text in ["test: 4 vehicles", "\nrandom ", "\ngreedy ", "/3"] {
        assert!(table.contains(text), "{text} is not in {table}");
    }
    let complaint = fail(home.path(), &["bench", "placement", "test.toml", "--method", "magic"]);
    assert!(complaint.contains("`magic` is no placement method"), "{complaint}");
}
