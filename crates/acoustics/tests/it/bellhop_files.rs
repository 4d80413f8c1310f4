//! Broken and unsupported BELLHOP files are refused with file and line.

use super::reference::folder;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::bellhop::read_case;
use sonarfleet_acoustics::model::Case;
use std::path::PathBuf;

/// Reads the case `pekeris_i` after a change to its text.
fn read_changed(name: &str, change: impl Fn(&str) -> String) -> Result<Case, AcousticsError> {
    let text = std::fs::read_to_string(folder("pekeris_i").join("case.env")).unwrap();
    let path = scratch(name);
    std::fs::write(&path, change(&text)).unwrap();
    let result = read_case(&path);
    std::fs::remove_file(&path).unwrap();
    result
}

fn scratch(name: &str) -> PathBuf {
    let file = format!("sonarfleet-acoustics-{}-{name}.env", std::process::id());
    std::env::temp_dir().join(file)
}

#[test]
fn a_missing_file_is_named() {
    let path = PathBuf::from("/nowhere/case.env");
    let refused = read_case(&path).unwrap_err();
    assert!(matches!(&refused, AcousticsError::Unreadable { path: found, .. } if *found == path));
}

#[test]
fn a_word_in_place_of_a_number_is_shown_with_its_line() {
    let refused = read_changed("word", |text| text.replacen("350", "loud", 1)).unwrap_err();
    assert!(
        matches!(&refused, AcousticsError::Syntax { line: 2, found, .. } if found == "loud"),
        "{refused}"
    );
}

#[test]
fn what_is_not_supported_is_said() {
    for (name, from, to) in
        [("spline", "'CVW ", "'SVW "), ("beams", "'IB'", "'Ib'"), ("grain", "'A' ", "'G' ")]
    {
        let refused = read_changed(name, |text| text.replacen(from, to, 1)).unwrap_err();
        assert!(matches!(refused, AcousticsError::Unsupported { .. }), "{refused}");
    }
}

#[test]
fn a_truncated_file_is_refused() {
    let refused = read_changed("truncated", |text| text[..text.len() / 2].to_owned());
    assert!(refused.is_err());
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]
    #[test]
    fn mutated_files_never_panic(at in 0..248usize, byte in any::<u8>(), length in 0..20usize) {
        let name = format!("mutated-{at}-{byte}-{length}");
        let _ = read_changed(&name, |text| {
            let mut bytes = text.as_bytes().to_vec();
            let at = at.min(bytes.len() - 1);
            let end = (at + length).min(bytes.len());
            bytes.splice(at..end, [byte]);
            String::from_utf8_lossy(&bytes).into_owned()
        });
    }
}
