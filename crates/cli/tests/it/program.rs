//! Running the program under test.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A mission of two epochs that takes a second or two.
pub(crate) const SCENARIO: &str = r#"
name = "Test"
seed = 3
[region]
west_deg = 118.2
east_deg = 118.26
south_deg = 21.70
north_deg = 21.756
columns = 6
rows = 6
[time]
epochs = 2
[fleet]
vehicles = 4
entry_line_km = [[0.5, 1.0], [0.5, 5.0]]
[sonar]
source_level_db = 130.0
[transmission_loss]
quality = "fast"
error_sample = 0
[placement]
evaluations = 5000
[navigation]
transit_margin_km = 3.0
horizon_h = 30.0
[[prior]]
shape = "corridor"
slope = -2.0
intercept = 13.0
total = 4.0
[[prior]]
shape = "blobs"
blobs = [{ centre_km = [2.0, 4.0], width_km = 1.0, total = 3.0 }]
"#;

/// The program, ready for arguments. What it keeps, it keeps in `cache` in its home.
pub(crate) fn sonarfleet(home: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sonarfleet"));
    command.current_dir(home).env("SONARFLEET_CACHE", home.join("cache"));
    command
}

/// Runs the program with arguments.
pub(crate) fn run(home: &Path, arguments: &[&str]) -> Output {
    sonarfleet(home).args(arguments).output().unwrap()
}

/// Runs the program, which must succeed, and gives what it printed.
pub(crate) fn succeed(home: &Path, arguments: &[&str]) -> String {
    let output = run(home, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Runs the program with `--json`, which must succeed, and parses all it printed.
pub(crate) fn json(home: &Path, arguments: &[&str]) -> Value {
    let text = succeed(home, &[arguments, &["--json"]].concat());
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{arguments:?}: {error}: {text}"))
}

/// Runs the program, which must fail without panic, and gives its complaint.
pub(crate) fn fail(home: &Path, arguments: &[&str]) -> String {
    let output = run(home, arguments);
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success(), "{arguments:?} should fail");
    assert!(!complaint.contains("panicked"), "{arguments:?}: {complaint}");
    complaint
}

/// Writes a file into a directory.
pub(crate) fn write(home: &Path, name: &str, text: &str) -> PathBuf {
    let path = home.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

/// The files whose bytes a seed determines.
pub(crate) const RESULTS: [&str; 7] = [
    "metrics.jsonl",
    "epoch-0.nc",
    "epoch-1.nc",
    "routes.geojson",
    "routes.kml",
    "routes.gpx",
    "routes.csv",
];

/// Asserts that two run directories hold the same results, byte for byte.
pub(crate) fn assert_same_results(a: &Path, b: &Path) {
    for name in RESULTS {
        let read = |directory: &Path| std::fs::read(directory.join(name)).unwrap();
        assert!(read(a) == read(b), "{name} differs between {} and {}", a.display(), b.display());
    }
}

/// Waits for something that must come true.
pub(crate) fn wait_for(come: impl Fn() -> bool) {
    let deadline = Instant::now() + Duration::from_mins(2);
    while !come() {
        assert!(Instant::now() < deadline, "it never came");
        sleep(Duration::from_millis(5));
    }
}
