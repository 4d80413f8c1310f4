//! `sonarfleet bellhop`: files in, files out, and what is told when it fails.

use super::program::{fail, json, run, succeed};
use std::path::{Path, PathBuf};

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../acoustics/tests/data")
}

/// A directory with the files of a case.
fn home(case: &str) -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    for ending in ["env", "bty", "ssp", "ati", "trc", "brc", "sbp"] {
        let from = data().join(case).with_extension(ending);
        if from.is_file() {
            std::fs::copy(&from, home.path().join(from.file_name().unwrap())).unwrap();
        }
    }
    home
}

#[test]
fn each_run_type_writes_its_file_beside_the_case_or_into_a_directory() {
    for (name, ending) in [("spline", "shd"), ("arrivals", "arr"), ("rays", "ray")] {
        let home = home(&format!("features/{name}"));
        // Without the ending, as bellhop.exe takes it.
        let said = succeed(home.path(), &["bellhop", name]);
        assert!(said.contains(&format!("{name}.{ending}")), "{said}");
        let beside = std::fs::read(home.path().join(format!("{name}.{ending}"))).unwrap();
        let printed = std::fs::read_to_string(home.path().join(format!("{name}.prt"))).unwrap();
        assert!(printed.contains(name) && !printed.contains("FATAL"), "{printed}");

        let file = format!("{name}.env");
        let about = json(home.path(), &["bellhop", &file, "--output", "out", "--threads", "1"]);
        assert_eq!(about["model"], "native");
        let there = home.path().join("out").join(format!("{name}.{ending}"));
        assert!(std::fs::read(there).unwrap() == beside, "{name} depends on threads");
    }
}

#[test]
fn a_field_is_no_way_from_itself() {
    let home = home("features/pairs");
    succeed(home.path(), &["bellhop", "pairs"]);
    let about = json(home.path(), &["bellhop", "pairs", "--compare", "pairs.shd"]);
    assert_eq!(about["differences"]["compared"], 80);
    assert!(about["differences"]["max_db"].as_f64().unwrap() < 1e-4);
}

#[test]
fn failures_leave_a_fatal_error_and_no_results() {
    let home = home("features/spline");
    let path = home.path().join("spline.env");
    let text = std::fs::read_to_string(&path).unwrap().replace("'IB'", "'IC'");
    std::fs::write(&path, text).unwrap();
    let complaint = fail(home.path(), &["bellhop", "spline.env"]);
    assert!(complaint.contains("spline.env, line 19"), "{complaint}");
    let printed = std::fs::read_to_string(home.path().join("spline.prt")).unwrap();
    assert!(printed.contains("*** FATAL ERROR ***") && printed.contains("line 19"), "{printed}");
    assert!(!home.path().join("spline.shd").exists());
}

#[test]
fn what_is_missing_is_named() {
    let home = home("features/rays");
    assert!(fail(home.path(), &["bellhop", "nothing"]).contains("nothing.env"));
    let complaint = fail(home.path(), &["bellhop", "rays", "--compare", "other.shd"]);
    assert!(complaint.contains("for fields"), "{complaint}");
    let mut command = super::program::sonarfleet(home.path());
    command.args(["bellhop", "rays", "--model", "bellhop"]);
    let output = command.env_remove("SONARFLEET_BELLHOP").env("PATH", "/nowhere").output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    for part in ["$SONARFLEET_BELLHOP is not set", "bellhop.exe nor bellhop", "/nowhere"] {
        assert!(!output.status.success() && complaint.contains(part), "{complaint}");
    }
}

/// A signal ends the external program too, and its scratch directory goes.
#[cfg(unix)]
#[test]
fn a_signal_ends_the_external_program_too() {
    use std::os::unix::fs::PermissionsExt;
    use std::time::{Duration, Instant};

    let home = home("features/rays");
    let fake = home.path().join("bellhop.sh");
    std::fs::write(&fake, "#!/bin/sh\necho \"$$ $PWD\" > \"$WITNESS\"\nexec sleep 600\n").unwrap();
    std::fs::set_permissions(&fake, PermissionsExt::from_mode(0o755)).unwrap();
    let witness = home.path().join("witness");
    let mut child = super::program::sonarfleet(home.path())
        .args(["bellhop", "rays", "--model", "bellhop"])
        .env("SONARFLEET_BELLHOP", &fake)
        .env("WITNESS", &witness)
        .spawn()
        .unwrap();
    let deadline = Instant::now() + Duration::from_mins(1);
    let seen = loop {
        match std::fs::read_to_string(&witness) {
            Ok(text) if text.ends_with('\n') => break text,
            _ if Instant::now() > deadline => panic!("the program did not start"),
            _ => std::thread::sleep(Duration::from_millis(20)),
        }
    };
    let (process, directory) = seen.trim().split_once(' ').unwrap();
    assert!(Path::new(directory).is_dir());
    let kill = |arguments: &[&str]| {
        std::process::Command::new("kill").args(arguments).status().unwrap().success()
    };
    assert!(kill(&["-TERM", &child.id().to_string()]));
    assert!(!child.wait().unwrap().success());
    assert!(!Path::new(directory).exists(), "{directory} is left");
    assert!(!kill(&["-0", process]), "the program still runs");
}

#[test]
fn the_help_has_examples() {
    let home = tempfile::tempdir().unwrap();
    let help = run(home.path(), &["bellhop", "--help"]);
    let help = String::from_utf8_lossy(&help.stdout).into_owned();
    assert!(help.contains("sonarfleet bellhop munk.env") && help.contains("--compare"), "{help}");
}
