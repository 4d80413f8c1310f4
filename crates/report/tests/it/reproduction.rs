//! Methods side by side, plausible and degenerate.

use crate::{sample, xml};
use sonarfleet::grid::CellId;
use sonarfleet_report::{ReportError, write_chart, write_layouts, write_scores};
use std::fs;
use std::path::{Path, PathBuf};

/// The SVG that a figure is written as, beside a PNG.
fn svg(write: impl Fn(&Path) -> Result<Vec<PathBuf>, ReportError>) -> String {
    let folder = tempfile::tempdir().unwrap();
    let files = write(&folder.path().join("new/fig-3.1")).unwrap();
    let names: Vec<_> = files.iter().map(|file| file.file_name().unwrap()).collect();
    assert_eq!(names, ["fig-3.1.svg", "fig-3.1.png"]);
    assert_eq!(fs::read(&files[1]).unwrap()[..8], *b"\x89PNG\r\n\x1a\n");
    let svg = fs::read_to_string(&files[0]).unwrap();
    assert_eq!(xml::fault(&svg), None);
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    svg
}

fn assert_says(svg: &str, labels: &[&str]) {
    for label in labels {
        assert!(svg.contains(label), "the figure lacks “{label}”");
    }
}

#[test]
fn layouts_say_what_they_show() {
    let drawn = svg(|stem| write_layouts(&sample::layouts(8, 6), stem));
    let labels = ["(a) Target prior", "(b) Random layout", "(c) Auto", "λ₂ = 0.100 &lt; τ = 0.95"];
    assert_says(&drawn, &labels);
    assert_says(&drawn, &["λ₂ = 0.970 ≥ τ", "12.3", "Cumulative detection P", "East (km)"]);
    svg(|stem| write_layouts(&sample::layouts(2, 1), stem));
}

#[test]
fn layouts_that_do_not_fit_their_grid_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let stem = folder.path().join("layouts");
    let mut far = sample::layouts(4, 4);
    far.layouts[0].cells.push(CellId(16));
    let refused = write_layouts(&far, &stem);
    assert!(matches!(refused, Err(ReportError::Cell { field: "cells", found: 16, .. })));
    let mut short = sample::layouts(4, 4);
    short.layouts[1].detection_probability.pop();
    let refused = write_layouts(&short, &stem);
    assert!(matches!(refused, Err(ReportError::Shape { expected: 16, found: 15, .. })));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn every_run_of_a_chart_has_its_line() {
    let drawn = |runs| svg(|stem| write_chart(&sample::chart(2, runs, 40), stem));
    assert_says(&drawn(3), &["(a) Panel 0", "(b) Panel 1", "PSO as the paper", "paper: 15"]);
    let lines = |runs| drawn(runs).matches("<polyline").count();
    // Two panels of three series; a single run is drawn as its median alone.
    assert_eq!(lines(4), lines(3) + 6);
    assert_eq!(lines(2), lines(1) + 12);
}

#[test]
fn degenerate_charts_draw() {
    for (panels, runs, points) in [(0, 0, 0), (1, 0, 0), (1, 2, 0), (3, 1, 1)] {
        svg(|stem| write_chart(&sample::chart(panels, runs, points), stem));
    }
    let mut empty = sample::chart(1, 2, 5);
    for series in &mut empty.panels[0].series {
        series.median.fill([0.5, f64::NAN]);
    }
    svg(|stem| write_chart(&empty, stem));
}

#[test]
fn scores_show_their_medians() {
    let drawn = svg(|stem| write_scores(&sample::scores(3), stem));
    // R 35.0, 35.4, 35.8; λ₂ 0.97, 0.98, 0.99.
    assert_says(&drawn, &["35.40", "0.980", "(c) Connectivity", "Policy, no training"]);
    let mut lone = sample::scores(1);
    lone.scores.truncate(1);
    lone.scores[0].algebraic_connectivity = f64::INFINITY;
    svg(|stem| write_scores(&lone, stem));
    lone.scores.clear();
    svg(|stem| write_scores(&lone, stem));
}
