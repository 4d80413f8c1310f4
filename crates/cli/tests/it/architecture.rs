//! The allowed edges: between crates, and between the rooms of `sonarfleet`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Which crate may depend on which.
const CRATES: [(&str, &[&str]); 6] = [
    ("ocean", &[]),
    ("acoustics", &[]),
    ("sonarfleet", &["sonarfleet-acoustics", "sonarfleet-ocean"]),
    ("learning", &["sonarfleet"]),
    ("report", &["sonarfleet"]),
    (
        "cli",
        &[
            "sonarfleet",
            "sonarfleet-acoustics",
            "sonarfleet-learning",
            "sonarfleet-ocean",
            "sonarfleet-report",
        ],
    ),
];

/// Which room of `sonarfleet` may use which.
const ROOMS: [(&str, &[&str]); 10] = [
    ("fingerprint", &[]),
    ("grid", &[]),
    ("npz", &[]),
    ("sonar", &["fingerprint", "grid", "npz", "random"]),
    ("placement", &["grid", "npz", "random", "sonar"]),
    ("curriculum", &["fingerprint", "grid", "npz", "placement", "random", "sonar"]),
    ("navigation", &["grid", "npz", "random", "record"]),
    ("assignment", &["npz", "random"]),
    ("record", &["fingerprint", "grid"]),
    ("scenario", &["assignment", "grid", "navigation", "npz", "placement", "sonar"]),
];

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn crates_depend_one_way() {
    for (name, allowed) in CRATES {
        let manifest = workspace().join("crates").join(name).join("Cargo.toml");
        let text = fs::read_to_string(&manifest).unwrap();
        let dependencies = text.split("[dev-dependencies]").next().unwrap();
        let used: BTreeSet<&str> = dependencies
            .lines()
            .filter_map(|line| line.strip_suffix(".workspace = true"))
            .filter(|dependency| dependency.starts_with("sonarfleet"))
            .collect();
        assert_eq!(used, allowed.iter().copied().collect(), "crate {name}");
    }
}

#[test]
fn rooms_use_each_other_one_way() {
    let source = workspace().join("crates/sonarfleet/src");
    for (room, allowed) in ROOMS {
        for file in rust_files(&source, room) {
            let text = fs::read_to_string(&file).unwrap();
            for used in
                text.lines().filter(|line| !line.trim().starts_with("//")).flat_map(rooms_in)
            {
                assert!(
                    used == room || allowed.contains(&used.as_str()),
                    "{} uses crate::{used}, which {room} may not know",
                    file.display()
                );
            }
        }
    }
}

/// The files of a room: `room.rs`, or all under `room/`.
fn rust_files(source: &Path, room: &str) -> Vec<PathBuf> {
    let single = source.join(room).with_extension("rs");
    let mut files: Vec<PathBuf> = single.exists().then_some(single).into_iter().collect();
    let mut folders: Vec<PathBuf> = vec![source.join(room)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    assert!(!files.is_empty(), "there is no room {room}");
    files
}

/// The rooms that a line names as `crate::room`.
fn rooms_in(line: &str) -> impl Iterator<Item = String> + '_ {
    let name = |(at, found): (usize, &str)| -> String {
        let rest = line[at + found.len()..].chars();
        rest.take_while(|c| c.is_ascii_lowercase() || *c == '_').collect()
    };
    // What stands at the root itself is no room.
    line.match_indices("crate::")
        .map(name)
        .filter(|room| !room.is_empty() && room != "replace_file")
}
