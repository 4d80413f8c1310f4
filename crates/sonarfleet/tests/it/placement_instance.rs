//! Instances in files, good and bad.

use crate::placement::synthetic;
use sonarfleet::npz::{self, NamedArray, Values};
use sonarfleet::placement::instance;
use sonarfleet::placement::{PlacementInput, PlacementProblem};
use std::path::{Path, PathBuf};

const PARAMETERS: &str = r#"{"name": "synthetic", "nx": 4, "ny": 4, "cell_km": 1.0, "G": 3,
    "SL": 130.0, "NL": 65.0, "DI": 0.0, "P_FA": 0.001, "SLc": 138.0, "NLc": 65.0,
    "packet_bits": 256, "tau": 0.95}"#;

fn write(folder: &Path, input: &PlacementInput, parameters: &str, prior: &[usize]) -> PathBuf {
    let path = folder.join("instance.npz");
    let arrays = [
        NamedArray { key: "tl", shape: &[16, 16], values: Values::F32(&input.detection_loss_db) },
        NamedArray { key: "prior", shape: prior, values: Values::F64(input.prior.values()) },
        NamedArray {
            key: "params",
            shape: &[parameters.len()],
            values: Values::Bytes(parameters.as_bytes()),
        },
    ];
    npz::write(&path, &arrays).unwrap();
    path
}

#[test]
fn an_instance_is_read_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let input = synthetic(4, 3, 1);
    let path = write(folder.path(), &input, PARAMETERS, &[4, 4]);
    let read = instance::read(path).unwrap();
    assert_eq!(read.grid, input.grid);
    assert_eq!(read.vehicles, 3);
    let (read, written) =
        (PlacementProblem::new(&read).unwrap(), PlacementProblem::new(&input).unwrap());
    let layout = &written.deployable()[5..8];
    assert_eq!(read.evaluate(layout), written.evaluate(layout));
}

#[test]
fn bad_instances_say_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let input = synthetic(4, 3, 1);
    let refused = |parameters: &str, prior: &[usize]| {
        let path = write(folder.path(), &input, parameters, prior);
        let message = instance::read(&path).unwrap_err().to_string();
        message.replace(path.to_str().unwrap(), "PATH")
    };
    assert_eq!(
        refused(PARAMETERS, &[2, 8]),
        "PATH: array `prior` has shape [2, 8], expected [4, 4]"
    );
    let larger = PARAMETERS.replace(r#""nx": 4"#, r#""nx": 5"#);
    assert_eq!(refused(&larger, &[4, 4]), "PATH: array `prior` has shape [4, 4], expected [4, 5]");
    let incomplete = PARAMETERS.replace(r#""tau": 0.95"#, r#""taw": 0.95"#);
    assert!(refused(&incomplete, &[4, 4]).contains("missing field `tau`"));
    assert!(refused("not JSON", &[4, 4]).starts_with("PATH: array `params` is not the JSON"));
    let loud = PARAMETERS.replace("0.001", "1.001");
    assert_eq!(
        refused(&loud, &[4, 4]),
        "`false_alarm_probability` is 1.001, expected a number within (0, 1)"
    );
    let flat = PARAMETERS.replace(r#""cell_km": 1.0"#, r#""cell_km": 0.0"#);
    assert_eq!(refused(&flat, &[4, 4]), "`cell_km` is 0, expected a positive number");
    let missing = folder.path().join("nowhere.npz");
    assert!(instance::read(&missing).unwrap_err().to_string().contains("nowhere.npz"));
}
