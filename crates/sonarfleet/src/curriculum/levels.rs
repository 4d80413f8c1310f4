//! Source levels by chance, such that targets are heard and packets arrive over a few
//! cells.

use super::LossCurve;
use super::chance::{between, happens, log_between, weighted};
use crate::grid::{CellId, SurveillanceGrid};
use crate::random::Stream;
use crate::sonar::SonarError;
use crate::sonar::connectivity::algebraic_connectivity;
use crate::sonar::detection::{DetectionModel, FalseAlarmProbability, PassiveSonar};
use crate::sonar::link::{LinkModel, Modem};
use crate::sonar::noise::NoiseLevel;

/// Detection radius, shortest and longest, cells: where in the median half of the
/// targets are heard.
pub(super) const DETECTION_CELLS: [f64; 2] = [1.0, 5.0];

/// Longest link radius, cells: where in the median half of the packets arrive.
pub(super) const LONGEST_LINK_CELLS: f64 = 5.0;

/// The paper's noise level, dB re 1 µPa.
const NOISE_DB: f64 = 63.0;

/// A sonar whose detection radius is in range; none where the losses do not allow it.
pub(super) fn sonar(
    random: &mut Stream,
    curve: &LossCurve,
    grid: &SurveillanceGrid,
) -> Result<Option<PassiveSonar>, SonarError> {
    let false_alarms = if happens(random, 0.8) { 1e-3 } else { log_between(random, 1e-4, 1e-2) };
    let false_alarms = FalseAlarmProbability::new(false_alarms)?;
    let model = match weighted(random, &[(0.92, 0), (0.05, 1), (0.03, 2)]) {
        0 => DetectionModel::MeanShift(false_alarms),
        1 => DetectionModel::RayleighEnergy(false_alarms),
        _ => DetectionModel::Threshold,
    };
    let noise_db = if happens(random, 0.6) { NOISE_DB } else { between(random, 55.0, 80.0) };
    let noise_level_db = if happens(random, 0.08) {
        NoiseLevel::PerCell(uneven_db(random, noise_db, grid))
    } else {
        NoiseLevel::Uniform(noise_db)
    };
    let directivity_index_db = if happens(random, 0.1) { between(random, 0.0, 12.0) } else { 0.0 };
    let detection_threshold_db =
        if happens(random, 0.1) { between(random, 0.0, 10.0) } else { 0.0 };

    let [shortest, longest] = DETECTION_CELLS;
    let faintest_db = curve.least_beyond_db(longest);
    let loudest_db = curve.loss_db(shortest);
    if !faintest_db.is_finite() || loudest_db >= faintest_db {
        return Ok(None);
    }
    // Half of the targets are as loud as any that fits; where there is a shadow this makes
    // many radii end at its edge, as they do.
    let loss_db = if happens(random, 0.5) {
        curve.loss_db(between(random, shortest, longest)).clamp(loudest_db, faintest_db)
    } else {
        between(random, loudest_db, faintest_db)
    };
    let half_db = crossing(-60.0, 60.0, |snr_db| model.probability(snr_db) >= 0.5);
    Ok(Some(PassiveSonar {
        source_level_db: loss_db + noise_db + half_db + detection_threshold_db
            - directivity_index_db,
        noise_level_db,
        directivity_index_db,
        detection_threshold_db,
        model,
    }))
}

/// A level in every cell that grows from one side of the region to the other, by up to
/// 8 dB.
pub(super) fn uneven_db(random: &mut Stream, middle_db: f64, grid: &SurveillanceGrid) -> Vec<f64> {
    let [east_db, north_db] = [0, 1].map(|_| between(random, -4.0, 4.0));
    grid.cells()
        .map(|cell| grid.centre(cell))
        .map(|centre| {
            middle_db
                + east_db * (centre.east_m / grid.width_m() - 0.5)
                + north_db * (centre.north_m / grid.height_m() - 0.5)
        })
        .collect()
}

/// Losses between vehicles.
pub(super) struct Links<'a> {
    /// Loss between all cells, [transmitter, receiver], dB.
    pub(super) loss_db: &'a [f32],
    /// Their median over distance.
    pub(super) curve: LossCurve,
}

/// A modem with which one of the layouts reaches the threshold τ, while its link radius
/// stays in range; none where the losses do not allow it.
pub(super) fn modem(
    random: &mut Stream,
    links: &Links,
    layouts: &[Vec<CellId>],
    connectivity_threshold: f64,
) -> Option<Modem> {
    let bits = [(0.1, 128), (0.45, 256), (0.15, 512), (0.3, 1024)];
    let packet_bits = weighted(random, &bits);
    let model = if happens(random, 0.93) {
        LinkModel::CoherentBpsk { packet_bits }
    } else {
        LinkModel::NoncoherentFskRayleigh { packet_bits }
    };
    let noise_db = if happens(random, 0.7) { NOISE_DB } else { between(random, 55.0, 80.0) };
    let half_db = crossing(-20.0, 80.0, |snr_db| model.packet_success(snr_db) >= 0.5);
    let with = |loss_db: f64| Modem {
        source_level_db: loss_db + noise_db + half_db,
        noise_level_db: NoiseLevel::Uniform(noise_db),
        model: model.clone(),
    };
    let connected = |loss_db: f64| {
        let modem = with(loss_db);
        layouts
            .iter()
            .any(|cells| connectivity(&modem, links.loss_db, cells) >= connectivity_threshold)
    };
    /// A disc is connected with so much to spare, dB.
    const SPARE_DB: f64 = 0.2;
    let faintest_db = links.curve.least_beyond_db(LONGEST_LINK_CELLS);
    if !(faintest_db.is_finite() && connected(faintest_db)) {
        return None;
    }
    let least_db = (crossing(30.0, faintest_db, connected) + SPARE_DB).min(faintest_db);
    // Half of the fleets can hardly spread out.
    let loss_db = if happens(random, 0.5) {
        (least_db + between(random, 0.0, 6.0)).min(faintest_db)
    } else {
        between(random, least_db, faintest_db)
    };
    Some(with(loss_db))
}

/// λ₂ of some cells.
fn connectivity(modem: &Modem, loss_db: &[f32], stations: &[CellId]) -> f64 {
    let cells = loss_db.len().isqrt();
    let arrives = |p: CellId, q: CellId| {
        let loss_db = f64::from(loss_db[p.0 * cells + q.0]);
        modem.model.packet_success(modem.snr_db(q, loss_db))
    };
    let count = stations.len();
    let mut weights = vec![0.0; count * count];
    for (i, &p) in stations.iter().enumerate() {
        for (j, &q) in stations[..i].iter().enumerate() {
            let weight = arrives(p, q).min(arrives(q, p));
            weights[i * count + j] = weight;
            weights[j * count + i] = weight;
        }
    }
    algebraic_connectivity(&weights, count)
}

/// Where something that never stops being true becomes true, to a hundredth, from above;
/// `high` where it does so nowhere below.
fn crossing(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    while high - low > 0.01 {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_targets_are_heard_at_the_crossing() {
        let model = DetectionModel::MeanShift(FalseAlarmProbability::new(1e-3).unwrap());
        let half_db = crossing(-60.0, 60.0, |snr_db| model.probability(snr_db) >= 0.5);
        // √(2 snr) = Q⁻¹(0.001).
        let exact_db = 10.0 * (3.090_232_306_167_813_f64.powi(2) / 2.0).log10();
        assert!((0.0..=0.01).contains(&(half_db - exact_db)), "{half_db} {exact_db}");
    }
}
