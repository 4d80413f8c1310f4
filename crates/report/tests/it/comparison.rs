//! Methods side by side, plausible and degenerate.

use crate::xml;
use sonarfleet::placement::comparison::{Comparison, Trial};
use sonarfleet_report::write_comparison;
use std::fs;

fn trial(method: &str, seed: u64, detection_utility: f64, feasible: bool) -> Trial {
    Trial {
        method: method.into(),
        seed,
        detection_utility,
        algebraic_connectivity: if feasible { 0.96 } else { 0.1 },
        reward: detection_utility - if feasible { 0.0 } else { 25.5 },
        feasible,
        evaluations: 60_000,
        seconds: 2.0,
    }
}

fn comparison(problem: &str, trials: Vec<Trial>) -> Comparison {
    let (connectivity_threshold, vehicles, upper_bound) = (0.95, 40, 41.4);
    Comparison { problem: problem.into(), connectivity_threshold, vehicles, upper_bound, trials }
}

fn trials() -> Vec<Trial> {
    vec![
        trial("random", 1, 15.1, false),
        trial("annealing", 1, 35.8, true),
        trial("genetic", 1, 35.2, true),
        trial("random", 2, 14.2, false),
        trial("annealing", 2, 36.1, true),
        trial("genetic", 2, 38.9, false),
    ]
}

fn svg(comparisons: &[Comparison]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let stem = folder.path().join("new/methods");
    let files = write_comparison(comparisons, "seeds 1 to 2", stem).unwrap();
    assert_eq!(fs::read(&files[1]).unwrap()[..8], *b"\x89PNG\r\n\x1a\n");
    let svg = fs::read_to_string(&files[0]).unwrap();
    assert_eq!(xml::fault(&svg), None);
    assert!(!svg.contains("NaN") && !svg.contains("inf\""));
    svg
}

#[test]
fn the_figure_says_what_it_shows() {
    let svg = svg(&[comparison("front", trials()), comparison("eddy", trials())]);
    for label in [
        "annealing",
        "genetic",
        "random",
        "(a) front",
        "(b) eddy",
        "τ = 0.95, 40 vehicles",
        "Detection utility J",
        "Feasible",
        "Infeasible",
        "Upper bound",
        "seeds 1 to 2",
    ] {
        assert!(svg.contains(label), "the figure lacks “{label}”");
    }
}

#[test]
fn every_trial_has_its_mark() {
    let discs = |comparisons: &[Comparison]| svg(comparisons).matches("<circle").count();
    let mut more = trials();
    more.extend([trial("annealing", 3, 36.0, true), trial("genetic", 3, 35.0, true)]);
    // A disc and the white one around it.
    assert_eq!(discs(&[comparison("p", more)]), discs(&[comparison("p", trials())]) + 4);
}

#[test]
fn degenerate_comparisons_draw() {
    let same = || trial("annealing", 1, 41.4, true);
    for (what, comparisons) in [
        ("nothing", vec![]),
        ("no trials", vec![comparison("p", vec![])]),
        ("one value", vec![comparison("p", vec![same(), same()])]),
        ("nothing feasible", vec![comparison("p", vec![trial("random", 1, 15.0, false)])]),
        (
            "two rows of panels",
            (0..6).map(|_| comparison("long name ".repeat(9).as_str(), trials())).collect(),
        ),
    ] {
        assert!(svg(&comparisons).len() > 100, "{what}");
    }
}
