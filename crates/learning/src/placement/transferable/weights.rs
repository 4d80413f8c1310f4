//! The policy's weights in files, and those that ship with the program.

use super::network::{HIDDEN, Network, WEIGHTS};
use super::observation::FEATURES;
use super::policy::TransferablePolicy;
use crate::files::FileError;
use crate::files::onnx::{Linear, Notes, PlacementNetwork};
use crate::files::weights::{Precision, Weights};
use std::collections::BTreeMap;
use std::path::Path;

/// What the files of these weights call themselves.
pub const KIND: &str = "placement/transferable";

/// `sonarfleet train placement` made them; the file's header has the whole command.
const SHIPPED: &[u8] = include_bytes!("../../../weights/placement.weights");

impl TransferablePolicy {
    /// The policy that ships with the program.
    ///
    /// # Panics
    /// Never in a program that was built from an undamaged source.
    pub fn shipped() -> Self {
        let network = Network::parse(Path::new("the shipped weights"), SHIPPED);
        Self::new(network.expect("the shipped weights are read in the tests"))
    }
}

impl Network {
    /// Reads weights from a file.
    ///
    /// # Errors
    /// Where the file cannot be read, is no such file, or is of a network of other sizes.
    pub fn load(path: &Path) -> Result<Self, FileError> {
        Self::of(path, Weights::load(path, KIND)?)
    }

    fn parse(path: &Path, bytes: &[u8]) -> Result<Self, FileError> {
        Self::of(path, Weights::parse(path, bytes, KIND)?)
    }

    fn of(path: &Path, weights: Weights) -> Result<Self, FileError> {
        let expected = sizes();
        if weights.sizes == expected && weights.values.len() == WEIGHTS {
            Ok(Self { weights: weights.values })
        } else {
            Err(FileError::OtherSizes { path: path.to_owned(), found: weights.sizes, expected })
        }
    }

    /// Writes the weights with the command and seed that made them.
    ///
    /// # Errors
    /// Where the file cannot be written, or a weight is not finite.
    pub fn save(&self, path: &Path, command: &str, seed: u64) -> Result<(), FileError> {
        let weights = Weights {
            kind: KIND.into(),
            sizes: sizes(),
            command: command.into(),
            seed,
            version: env!("CARGO_PKG_VERSION").into(),
            values: self.weights.clone(),
        };
        weights.save(path, Precision::F32)
    }

    /// The network as ONNX: `features` [batch, candidate, feature] → `logits`
    /// [batch, candidate].
    pub fn to_onnx(&self) -> Vec<u8> {
        let [first, first_bias, second, context, second_bias, output] = self.parts();
        let linear = |inputs, outputs, weights, bias| Linear { inputs, outputs, weights, bias };
        PlacementNetwork {
            first: linear(FEATURES, HIDDEN, first, Some(first_bias)),
            second: linear(HIDDEN, HIDDEN, second, Some(second_bias)),
            context: linear(HIDDEN, HIDDEN, context, None),
            last: linear(HIDDEN, 1, output, None),
        }
        .to_onnx(&Notes {
            description: "Scores candidate cells for the next vehicle of a layout",
            properties: &[],
        })
    }
}

fn sizes() -> BTreeMap<String, usize> {
    BTreeMap::from([("features".into(), FEATURES), ("hidden".into(), HIDDEN)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_weights_are_read() {
        let policy = TransferablePolicy::shipped();
        assert!(policy.network.weights.iter().any(|weight| *weight != 0.0));
    }

    #[test]
    fn weights_are_read_as_they_were_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("policy.weights");
        let network = TransferablePolicy::shipped().network;
        network.save(&path, "a command", 3).unwrap();
        assert_eq!(Network::load(&path).unwrap(), network);
        std::fs::write(&path, b"no weights").unwrap();
        let complaint = Network::load(&path).unwrap_err().to_string();
        assert!(complaint.contains("policy.weights"), "{complaint}");
    }
}
