//! Curves of trainings, plausible and degenerate.

use crate::{sample, xml};
use sonarfleet::record::TrainingRecord;
use sonarfleet_report::write_training;
use std::fs;

fn svg(record: &TrainingRecord) -> String {
    let folder = tempfile::tempdir().unwrap();
    let files = write_training(record, folder.path().join("new/tau-0.95")).unwrap();
    let names: Vec<_> = files.iter().map(|file| file.file_name().unwrap()).collect();
    assert_eq!(names, ["tau-0.95.svg", "tau-0.95.png"]);
    assert_eq!(fs::read(&files[1]).unwrap()[..8], *b"\x89PNG\r\n\x1a\n");
    let svg = fs::read_to_string(&files[0]).unwrap();
    assert_eq!(xml::fault(&svg), None);
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    svg
}

#[test]
fn a_curve_says_what_it_shows() {
    let several = svg(&sample::training(3, 40));
    for label in [
        "Sequential PPO on a sample",
        "Detection utility J",
        "Reward R",
        "Required τ = 0.95",
        "Entropy (nats)",
        "Episodes",
        "thin: seeds 1, 2, 3; bold: their median",
        "sonarfleet 0.1.0",
    ] {
        assert!(several.contains(label), "the curve lacks “{label}”");
    }
    assert!(!several.contains("thousands") && svg(&sample::training(1, 300)).contains("thousands"));
}

#[test]
fn every_seed_has_its_line() {
    let lines = |seeds| svg(&sample::training(seeds, 40)).matches("<polyline").count();
    // Six numbers; a single run is drawn as its median alone.
    assert!(lines(4) >= lines(3) + 6);
    assert!(lines(2) >= lines(1) + 12);
}

#[test]
fn degenerate_trainings_draw() {
    let mut records = vec![
        ("no runs", sample::training(0, 0)),
        ("no updates", sample::training(2, 0)),
        ("one update", sample::training(2, 1)),
    ];
    let mut unequal = sample::training(3, 20);
    unequal.runs[1].points.truncate(5);
    records.push(("a run that was stopped", unequal));
    let mut empty = sample::training(2, 20);
    for point in empty.runs.iter_mut().flat_map(|run| &mut run.points) {
        point.reward = f64::NAN;
        point.multiplier = f64::INFINITY;
        point.approx_kl = 0.0;
    }
    records.push(("numbers that are missing or all alike", empty));
    for (what, record) in records {
        assert!(svg(&record).contains("Episodes"), "{what}");
    }
}
