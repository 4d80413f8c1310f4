use crate::{SMALL, degenerate, sample, xml};
use sonarfleet::grid::CellId;
use sonarfleet_report::{ReportError, write_figures};
use std::fs;
use std::path::Path;

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

#[test]
fn every_figure_is_there_as_svg_and_png_and_nothing_else() {
    let directory = tempfile::tempdir().unwrap();
    let files = write_figures(&sample::record(SMALL), directory.path()).unwrap();

    let names = ["sound_speed", "priors", "routes", "placement_epoch_0", "placement_epoch_1"];
    assert_eq!(files.len(), 2 * names.len());
    for name in names {
        for extension in ["svg", "png"] {
            let file = directory.path().join(name).with_extension(extension);
            assert!(files.contains(&file) && file.is_file(), "{}", file.display());
        }
    }
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), files.len());
}

#[test]
fn svgs_are_well_formed_and_say_what_they_show() {
    let directory = tempfile::tempdir().unwrap();
    write_figures(&sample::record(SMALL), directory.path()).unwrap();
    let expected = [
        ("sound_speed", vec!["East (km)", "Depth (m)", "Sound speed (m/s)", "slice at 200 m"]),
        ("priors", vec!["(b) Epoch 1", "2025-10-09 06:00 UTC", "Target prior P"]),
        ("routes", vec!["Travelled", "Planned", "Current at 200 m", "1 unreachable", "λ₂ = 0.951"]),
        ("placement_epoch_0", vec!["(a) Transmission loss", "(c) Random layout", "λ₂ = 0.951 ≥ τ"]),
    ];
    for (name, labels) in expected {
        let svg = read(&directory.path().join(name).with_extension("svg"));
        assert_eq!(xml::fault(&svg), None, "{name}");
        for label in labels {
            assert!(svg.contains(label), "{name} lacks “{label}”");
        }
        assert!(svg.contains("synthetic ocean, not an observation"), "{name} hides its ocean");
    }
}

#[test]
fn pngs_have_288_dots_per_inch() {
    let directory = tempfile::tempdir().unwrap();
    write_figures(&sample::record(SMALL), directory.path()).unwrap();
    for name in ["sound_speed", "priors", "routes", "placement_epoch_0"] {
        let png = fs::read(directory.path().join(name).with_extension("png")).unwrap();
        assert_eq!(png[..8], *b"\x89PNG\r\n\x1a\n", "{name}");
        let word = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
        // 522 points, four pixels each.
        assert_eq!(word(16), 2088, "{name}");
        assert!((500..=4000).contains(&word(20)), "{name} is {} pixels high", word(20));
        assert!(png.windows(4).any(|chunk| chunk == b"pHYs"), "{name}");
    }
}

#[test]
fn the_same_record_gives_the_same_bytes() {
    let [first, second] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let record = sample::record(SMALL);
    let files = write_figures(&record, first.path()).unwrap();
    write_figures(&record, second.path()).unwrap();
    for file in files {
        let other = second.path().join(file.file_name().unwrap());
        assert!(fs::read(&file).unwrap() == fs::read(other).unwrap(), "{}", file.display());
    }
}

#[test]
fn degenerate_records_draw() {
    for (what, record) in degenerate() {
        let directory = tempfile::tempdir().unwrap();
        let files = write_figures(&record, directory.path())
            .unwrap_or_else(|error| panic!("{what}: {error}"));
        for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "svg")) {
            let svg = read(file);
            assert_eq!(xml::fault(&svg), None, "{what}: {}", file.display());
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{what}: {}", file.display());
        }
    }
}

#[test]
fn further_epochs_continue_on_a_further_figure() {
    let directory = tempfile::tempdir().unwrap();
    let record = sample::record(sample::Size { epochs: 5, ..SMALL });
    write_figures(&record, directory.path()).unwrap();
    assert!(read(&directory.path().join("routes_2.svg")).contains("Epoch 4"));
}

#[test]
fn names_are_escaped() {
    let mut record = sample::record(SMALL);
    record.name = "<script>&\"'".into();
    let directory = tempfile::tempdir().unwrap();
    write_figures(&record, directory.path()).unwrap();
    let svg = read(&directory.path().join("priors.svg"));
    assert_eq!(xml::fault(&svg), None);
    assert!(svg.contains("&lt;script&gt;&amp;") && !svg.contains("<script"));
}

#[test]
fn a_record_that_does_not_fit_its_grid_is_refused_by_name() {
    let directory = tempfile::tempdir().unwrap();
    let mut record = sample::record(SMALL);
    record.epochs[1].prior.pop();
    let error = write_figures(&record, directory.path()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the record's `prior` of epoch 1 has 63 values; its shape asks for 64"
    );

    let mut record = sample::record(SMALL);
    record.epochs[0].routes[0].post = CellId(64);
    let error = write_figures(&record, directory.path()).unwrap_err();
    assert!(matches!(error, ReportError::Cell { field: "routes.post", found: 64, .. }), "{error}");

    let mut record = sample::record(SMALL);
    record.grid.cell_width_m = f64::NAN;
    let error = write_figures(&record, directory.path()).unwrap_err();
    assert!(matches!(error, ReportError::Grid { .. }), "{error}");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0, "nothing is half written");
}

#[test]
fn a_directory_that_is_a_file_is_named_in_the_error() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("taken");
    fs::write(&file, "").unwrap();
    let error = write_figures(&sample::record(SMALL), &file).unwrap_err();
    assert!(matches!(&error, ReportError::Write { path, .. } if *path == file), "{error}");
}
