//! Tables of transmission loss: shards, directions, frequencies, and what is kept.

use crate::program::{
    SCENARIO, assert_same_results, fail, json, run, sonarfleet, succeed, wait_for, write,
};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// Writes a table and gives the file's bytes; what is kept is not looked at.
fn table(home: &Path, arguments: &[&str], output: &str) -> Vec<u8> {
    let common = ["--output", output, "--quiet", "--no-cache"];
    succeed(home, &[&["tl"], arguments, &common].concat());
    fs::read(home.join(output)).unwrap()
}

fn merged(home: &Path, parts: &[&str], output: &str) -> Vec<u8> {
    succeed(home, &[&["tl", "merge"], parts, &["--output", output, "--quiet"]].concat());
    fs::read(home.join(output)).unwrap()
}

/// The test scenario with more in one of its sections.
fn with(section: &str, more: &str) -> String {
    let head = format!("[{section}]\n");
    if SCENARIO.contains(&head) {
        SCENARIO.replacen(&head, &format!("{head}{more}\n"), 1)
    } else {
        format!("{SCENARIO}\n{head}{more}\n")
    }
}

/// The files of rows that are kept.
fn kept_files(home: &Path) -> Vec<PathBuf> {
    let directories = fs::read_dir(home.join("cache/transmission-loss")).into_iter().flatten();
    let files = directories.flat_map(|entry| fs::read_dir(entry.unwrap().path()).unwrap());
    let mut files: Vec<PathBuf> = files
        .map(|file| file.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "rows"))
        .collect();
    files.sort();
    files
}

#[test]
fn shards_merge_into_the_whole_in_either_direction() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "one.toml", SCENARIO);
    write(home, "both.toml", &with("transmission_loss", "directions = \"both\""));
    for scenario in ["one.toml", "both.toml"] {
        let whole = table(home, &[scenario], "whole.nc");
        for (shard, part) in [("1/3", "c.nc"), ("2/3", "a.nc"), ("3/3", "b.nc")] {
            table(home, &[scenario, "--shard", shard], part);
        }
        assert!(merged(home, &["a.nc", "b.nc", "c.nc"], "merged.nc") == whole, "{scenario}");
        assert!(merged(home, &["merged.nc"], "again.nc") == whole, "{scenario}");
    }

    // Placements on tables in files are those on computed ones, both ways symmetric.
    let place = |scenario: &str, extra: &[&str]| {
        let mut said = json(home, &[&["place", scenario], extra].concat());
        said["seconds"].take();
        said
    };
    for scenario in ["one.toml", "both.toml"] {
        for file in ["whole.nc", "whole.npz"] {
            table(home, &[scenario], file);
            assert_eq!(place(scenario, &[]), place(scenario, &["--loss", file]));
        }
    }
    assert_ne!(place("one.toml", &[])["history"], place("both.toml", &[])["history"]);
}

#[test]
fn parts_that_are_no_partition_are_refused() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    write(home, "sand.toml", &with("seabed", "sediment = \"sand\""));
    write(home, "deep.toml", &with("fleet", "depth_m = 210.0"));
    write(home, "both.toml", &with("transmission_loss", "directions = \"both\""));
    write(home, "loud.toml", &with("communications", "frequency_hz = 9000.0"));
    table(home, &["test.toml", "--shard", "1/2"], "a.nc");
    table(home, &["test.toml", "--shard", "2/2"], "b.nc");
    let refused = |parts: &[&str], words: &[&str]| {
        let output = ["--output", "merged.nc"];
        let complaint = fail(home, &[&["tl", "merge"], parts, &output].concat());
        for word in words {
            assert!(complaint.contains(word), "no {word:?} in: {complaint}");
        }
        assert!(!home.join("merged.nc").exists());
    };
    refused(&["a.nc"], &["gap", "18 of 36", "source cell 1"]);
    refused(&["a.nc", "b.nc", "a.nc"], &["a.nc", "overlap", "source cell 0"]);
    table(home, &["test.toml", "--shard", "2/3"], "third.nc");
    refused(&["a.nc", "b.nc", "third.nc"], &["third.nc", "overlap", "source cell 1"]);
    for (arguments, words) in [
        (&["sand.toml"][..], &["fingerprint", "sea floor"][..]),
        (&["deep.toml"], &["fleet_depth_m", "210", "200"]),
        (&["both.toml"], &["directions", "both", "one"]),
        (&["test.toml", "--quality", "standard"], &["quality", "standard", "fast"]),
        (&["test.toml", "--epoch", "1"], &["time", "T06:00:00Z", "T00:00:00Z"]),
        (&["loud.toml", "--use", "communication"], &["frequency_hz", "9000", "1000"]),
    ] {
        table(home, &[arguments, &["--shard", "2/2"]].concat(), "other.nc");
        refused(&["a.nc", "other.nc"], words);
        refused(&["a.nc", "other.nc"], &["a.nc and other.nc", "different tables"]);
    }
}

#[test]
fn a_killed_table_goes_on_where_it_stopped() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    let whole = table(home, &["test.toml", "--quality", "standard"], "whole.nc");
    let arguments = ["tl", "test.toml", "--quality", "standard", "--output", "killed.nc"];
    let mut killed = sonarfleet(home)
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    wait_for(|| !kept_files(home).is_empty());
    killed.kill().unwrap();
    killed.wait().unwrap();

    let said = json(home, &arguments);
    assert!(said["sources_from_cache"].as_u64().unwrap() >= 16, "{said}");
    assert!(fs::read(home.join("killed.nc")).unwrap() == whole);
    // And what is whole is not computed again.
    assert_eq!(json(home, &arguments)["sources_from_cache"], 36);
    assert!(fs::read(home.join("killed.nc")).unwrap() == whole);
    let said = succeed(home, &arguments);
    assert!(said.contains("36 rows of them from the cache"), "{said}");
}

#[test]
fn what_is_kept_changes_no_result() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let sampled = SCENARIO.replace("error_sample = 0", "error_sample = 2");
    write(home, "test.toml", &sampled);
    succeed(home, &["run", "test.toml", "--quiet", "--no-cache", "--output", "without"]);
    assert!(!home.join("cache").exists());
    for output in ["cold", "warm"] {
        succeed(home, &["run", "test.toml", "--quiet", "--output", output]);
        assert_same_results(&home.join("without"), &home.join(output));
    }
    let log = |run: &str| fs::read_to_string(home.join(run).join("run.log")).unwrap();
    assert!(log("cold").contains("from_cache=0") && !log("cold").contains("from_cache=36"));
    assert!(log("warm").contains("from_cache=36") && !log("warm").contains("from_cache=0"));
}

#[test]
fn a_cache_that_is_damaged_or_out_of_reach_is_warned_of() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", SCENARIO);
    let whole = table(home, &["test.toml"], "whole.nc");
    let arguments = ["tl", "test.toml", "--output", "tl.nc"];
    let warned = |cache: Option<&str>| {
        let mut program = sonarfleet(home);
        if let Some(cache) = cache {
            program.env("SONARFLEET_CACHE", home.join(cache));
        }
        let output = program.args(arguments).output().unwrap();
        assert!(output.status.success());
        assert!(fs::read(home.join("tl.nc")).unwrap() == whole);
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(warned(None), "");
    let damaged = kept_files(home).remove(0);
    let length = fs::metadata(&damaged).unwrap().len();
    fs::File::options().write(true).open(&damaged).unwrap().set_len(length / 2).unwrap();
    let said = warned(None);
    assert!(said.contains("WARN") && said.contains("computed again"), "{said}");
    assert!(said.contains(damaged.file_name().unwrap().to_str().unwrap()), "{said}");
    assert_eq!(warned(None), "");
    write(home, "file", "in the way");
    let said = warned(Some("file"));
    assert!(said.contains("WARN") && said.contains("cannot be kept"), "{said}");
}

#[test]
fn links_at_a_frequency_of_their_own() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "one.toml", SCENARIO);
    let same = "frequency_hz = 1000.0";
    write(home, "same.toml", &with("communications", same));
    let own = "frequency_hz = 12000.0\nsource_level_db = 160.0";
    let two = with("communications", own);
    write(home, "two.toml", &two);
    let metrics = |scenario: &str, output: &str| -> Vec<Value> {
        succeed(home, &["run", scenario, "--quiet", "--output", output]);
        let text = fs::read_to_string(home.join(output).join("metrics.jsonl")).unwrap();
        text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    };
    let one = metrics("one.toml", "one");
    assert_eq!(one, metrics("same.toml", "same"), "the same frequency is the same table");
    assert!(one[0]["communication_loss"].is_null());

    let computed = metrics("two.toml", "two");
    for epoch in &computed {
        assert_eq!(epoch["transmission_loss"]["frequency_hz"], 1000.0);
        assert_eq!(epoch["communication_loss"]["frequency_hz"], 12000.0);
        assert_ne!(epoch["communication_loss"]["beams"], 0);
    }
    let timings = fs::read_to_string(home.join("two/timings.jsonl")).unwrap();
    assert!(timings.contains("communication loss"), "{timings}");

    // The same from files: both tables, or the links' alone.
    for epoch in ["0", "1"] {
        table(home, &["two.toml", "--epoch", epoch], &format!("d{epoch}.nc"));
        let arguments = ["two.toml", "--epoch", epoch, "--use", "communication"];
        table(home, &arguments, &format!("c{epoch}.npz"));
    }
    let files = |keys: &str| {
        let section = "[transmission_loss]\n";
        two.replacen(section, &format!("{section}{keys}\n"), 1)
    };
    let communication = "communication_files = [\"c0.npz\", \"c1.npz\"]";
    write(home, "links.toml", &files(communication));
    write(home, "all.toml", &files(&format!("{communication}\nfiles = [\"d0.nc\", \"d1.nc\"]")));
    for (scenario, output) in [("links.toml", "links"), ("all.toml", "all")] {
        for (given, computed) in metrics(scenario, output).iter().zip(&computed) {
            for key in ["detection_utility", "algebraic_connectivity", "placement_history"] {
                assert_eq!(given[key], computed[key], "{scenario}: {key}");
            }
            assert_eq!(given["communication_loss"]["beams"], 0);
        }
    }
    let place = |extra: &[&str]| json(home, &[&["place", "two.toml"], extra].concat());
    let given = place(&["--loss", "d0.nc", "--communication-loss", "c0.npz"]);
    assert_eq!(given["history"], place(&[])["history"]);
    let swapped = place(&["--communication-loss", "d0.nc"]);
    assert_ne!(given["algebraic_connectivity"], swapped["algebraic_connectivity"]);

    let said = succeed(home, &["check", "two.toml"]);
    assert!(said.contains("detection at 1000 Hz") && said.contains("links at 12000 Hz"), "{said}");
    let said = succeed(home, &["check", "one.toml"]);
    assert!(said.contains("links by the same tables"), "{said}");
    write(home, "bad.toml", &with("communications", "frequency_hz = 1.0"));
    let complaint = fail(home, &["check", "bad.toml"]);
    assert!(complaint.contains("communications.frequency_hz"), "{complaint}");
    write(home, "bad.toml", &files("communication_files = [\"c0.npz\"]"));
    let complaint = fail(home, &["check", "bad.toml"]);
    assert!(complaint.contains("communication_files") && complaint.contains("2: one per epoch"));
}

#[test]
fn sea_floors_are_listed_with_their_sources() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let help = succeed(home, &["check", "--help"]);
    for words in ["clay", "TR 9407", "limestone", "COA Table 1.3", "5250 m/s"] {
        assert!(help.contains(words), "no {words:?} in: {help}");
    }
    write(home, "sand.toml", &with("seabed", "sediment = \"sand\""));
    let said = succeed(home, &["check", "sand.toml"]);
    assert!(said.contains("sand (COA Table 1.3, sand): 1650 m/s"), "{said}");
    write(home, "bad.toml", &with("seabed", "sediment = \"granite\""));
    let said = run(home, &["check", "bad.toml"]);
    let complaint = String::from_utf8(said.stderr).unwrap();
    assert!(complaint.contains("granite") && complaint.contains("limestone"), "{complaint}");
}

#[test]
fn a_model_that_is_not_installed_is_looked_for_and_named() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    write(home, "test.toml", &with("transmission_loss", "model = \"bellhop\""));
    let mut program = sonarfleet(home);
    program.env_remove("SONARFLEET_BELLHOP").env("PATH", home).args(["check", "test.toml"]);
    let complaint = String::from_utf8(program.output().unwrap().stderr).unwrap();
    for words in ["transmission_loss.model", "native", "SONARFLEET_BELLHOP"] {
        assert!(complaint.contains(words), "no {words:?} in: {complaint}");
    }
}
