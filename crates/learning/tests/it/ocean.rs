//! Synthetic placement problems.

use rand::Rng;
use sonarfleet::grid::SurveillanceGrid;
use sonarfleet::placement::{PlacementInput, PlacementProblem};
use sonarfleet::random::stream;
use sonarfleet::sonar::detection::{DetectionModel, FalseAlarmProbability, PassiveSonar};
use sonarfleet::sonar::link::{LinkModel, Modem};
use sonarfleet::sonar::noise::NoiseLevel;
use sonarfleet::sonar::prior::TargetPrior;

/// An ocean in which sound loses about 5 dB per cell.
pub(crate) fn problem(
    side: usize,
    vehicles: usize,
    connectivity_threshold: f64,
    seed: u64,
) -> PlacementProblem {
    let grid =
        SurveillanceGrid { columns: side, rows: side, cell_width_m: 1000.0, cell_height_m: 1000.0 };
    let cells = grid.cell_count();
    let mut random = stream(seed, "test/ocean", 0);
    let mut losses_db = vec![0.0; cells * cells];
    for p in grid.cells() {
        for q in grid.cells() {
            let cells_apart = grid.centre(p).distance_m(grid.centre(q)) / 1000.0;
            losses_db[p.0 * cells + q.0] =
                (55.0 + 5.0 * cells_apart + random.random_range(-1.5..1.5)) as f32;
        }
    }
    let prior = (0..cells).map(|_| random.random_range(0.0..1.0)).collect();
    PlacementProblem::new(&PlacementInput {
        grid,
        prior: TargetPrior::new(prior).unwrap(),
        detection_loss_db: losses_db,
        communication_loss_db: None,
        sonar: PassiveSonar {
            source_level_db: 130.0,
            noise_level_db: NoiseLevel::Uniform(65.0),
            directivity_index_db: 0.0,
            detection_threshold_db: 0.0,
            model: DetectionModel::MeanShift(FalseAlarmProbability::new(1e-3).unwrap()),
        },
        modem: Modem {
            source_level_db: 134.0,
            noise_level_db: NoiseLevel::Uniform(65.0),
            model: LinkModel::CoherentBpsk { packet_bits: 256 },
        },
        vehicles,
        connectivity_threshold,
        deployable: None,
        fixed_sensors: Vec::new(),
    })
    .unwrap()
}
