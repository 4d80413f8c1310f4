//! Damaged files give errors, or values; never a panic.

use crate::dialect;
use sonarfleet_ocean::io::{ForecastRequest, inspect, read_bathymetry, read_forecast};
use sonarfleet_ocean::synthetic::{SyntheticOcean, TITLE};

const MUTATIONS_PER_FILE: u64 = 32;

/// A small linear congruential generator (Knuth's MMIX constants).
struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit
    }
}

/// Truncates, or changes one to eight bytes, more often near the start, where headers are.
fn damaged(bytes: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    if dice.below(4) == 0 {
        bytes.truncate(dice.below(bytes.len()));
        return bytes;
    }
    for _ in 0..=dice.below(8) {
        let reach = if dice.below(2) == 0 { bytes.len() } else { bytes.len().min(4096) };
        let position = dice.below(reach);
        bytes[position] = dice.below(256) as u8;
    }
    bytes
}

#[test]
fn damaged_files_never_panic() {
    let directory = tempfile::tempdir().unwrap();
    let ocean = SyntheticOcean { states: 1, margin_deg: 0.0, ..SyntheticOcean::default() };
    let ours = sonarfleet_ocean::io::write_forecast(&ocean.forecast(), directory.path(), TITLE);
    let mut originals = ours.unwrap();
    originals.extend(
        ["int16.nc", "netcdf3.nc", "cmems_uv.nc", "superblock_v0.nc", "bathymetry_gebco.nc"]
            .map(dialect),
    );
    let request = ForecastRequest { required: &[], region: None, span: None };
    let (mut failed, mut passed) = (0, 0);
    for (i, original) in originals.iter().enumerate() {
        let bytes = std::fs::read(original).unwrap();
        let mut dice = Dice(i as u64 + 1);
        for k in 0..MUTATIONS_PER_FILE {
            let path = directory.path().join(format!("damaged_{i}_{k}.nc"));
            std::fs::write(&path, damaged(&bytes, &mut dice)).unwrap();
            let outcomes = [
                read_forecast(std::slice::from_ref(&path), &request).is_ok(),
                read_bathymetry(&path, None).is_ok(),
                inspect(&path).is_ok(),
            ];
            passed += outcomes.iter().filter(|&&ok| ok).count();
            failed += outcomes.iter().filter(|&&ok| !ok).count();
            std::fs::remove_file(&path).unwrap();
        }
    }
    println!("{failed} errors, {passed} read");
    assert!(failed > 0 && passed > 0);
}
