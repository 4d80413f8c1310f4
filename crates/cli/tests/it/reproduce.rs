//! `sonarfleet reproduce`: the paper's numbers beside ours.

use crate::program::{SCENARIO, fail, json, succeed, write};
use std::fs;

/// As short as a training can be: one rollout.
const SHORT: [&str; 6] = ["--input", "test.toml", "--seeds", "2", "--seconds", "0.01"];

#[test]
fn a_figure_comes_with_its_table_and_its_numbers() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    let arguments = [&["reproduce", "fig6", "--output", "new/out"], &SHORT[..]].concat();
    let said = succeed(home, &arguments);
    assert!(said.contains("| what | paper | ours |\n|---|---|---|\n| Fig. 6: "), "{said}");
    assert_eq!(said.matches("| ≈ 85 % |").count(), 2, "{said}");
    let out = home.join("new/out");
    let mut names: Vec<_> =
        fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["fig6.png", "fig6.svg", "reproduce.json"]);

    let found = json(home, &arguments);
    assert_eq!((&found["seeds"], &found["vehicles"]), (&2.into(), &4.into()));
    assert_eq!(found["table"].as_array().unwrap().len(), 2);
    for series in found["figures"]["fig6"]["panels"][0]["series"].as_array().unwrap() {
        assert_eq!(series["runs"].as_array().unwrap().len(), 2);
        // A further vehicle never detects less, and all of them keep everything.
        let kept = series["median"].as_array().unwrap();
        let kept: Vec<f64> = kept.iter().map(|point| point[1].as_f64().unwrap()).collect();
        assert_eq!(kept.len(), 4);
        assert!(kept[0] > 0.0 && kept.is_sorted() && (kept[3] - 100.0).abs() < 1e-9, "{kept:?}");
    }
    let saved = fs::read_to_string(out.join("reproduce.json")).unwrap();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&saved).unwrap(), found);
}

#[test]
fn training_goes_on_in_the_next_epoch_where_there_is_one() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    let arguments = [&["reproduce", "incremental"], &SHORT[..]].concat();
    let found = json(home, &arguments);
    assert_eq!(found["table"].as_array().unwrap().len(), 5);
    for series in found["figures"]["incremental"]["panels"][0]["series"].as_array().unwrap() {
        assert_eq!(series["runs"].as_array().unwrap().len(), 2);
    }
    write(home, "test.toml", &SCENARIO.replace("epochs = 2", "epochs = 1"));
    let complaint = fail(home, &arguments);
    assert!(complaint.contains("epochs 0 to 0"), "{complaint}");
}

#[test]
fn mistakes_are_said_before_anything_is_trained() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "file", "in the way");
    let complaint = fail(home, &["reproduce", "fig8"]);
    assert!(complaint.contains("fig8") && complaint.contains("fig7"), "{complaint}");
    for (option, value) in [("--seeds", "0"), ("--seconds", "0"), ("--seconds", "soon")] {
        let complaint = fail(home, &["reproduce", "fig6", option, value]);
        assert!(complaint.contains(option), "{complaint}");
    }
    write(home, "test.toml", SCENARIO);
    let unwritable = [&["reproduce", "fig6", "--output", "file/out"], &SHORT[..]].concat();
    let complaint = fail(home, &unwritable);
    assert!(complaint.contains("file/out"), "{complaint}");
    for absent in ["absent.npz", "absent.toml"] {
        let complaint = fail(home, &["reproduce", "fig6", "--input", absent]);
        assert!(complaint.contains(absent), "{complaint}");
    }
    assert!(!home.join("sonarfleet-reproduce").exists());
}
