//! Acoustic links between vehicles: from levels to the probability that a packet
//! arrives (Eqs. 7–9 of the paper).

use super::SonarError;
use super::curve::ProbabilityCurve;
use super::detection::power_ratio;
use super::error::checked;
use super::gaussian::tail_probability;
use super::noise::NoiseLevel;
use crate::grid::CellId;

/// How the success of a packet depends on the signal-to-noise ratio (per bit).
#[derive(Debug, Clone, PartialEq)]
pub enum LinkModel {
    /// Coherent binary phase-shift keying in white Gaussian noise, Eq. (8)
    /// (Proakis, *Digital Communications*, 2001, section 5.2).
    CoherentBpsk {
        /// Packet length L, bits.
        packet_bits: u32,
    },
    /// Non-coherent binary frequency-shift keying under Rayleigh fading: a bit is
    /// wrong with probability 1/(2 + snr), snr the mean over the fading (Proakis,
    /// *Digital Communications*, 2001, section 14.3); bits fade independently.
    NoncoherentFskRayleigh {
        /// Packet length L, bits.
        packet_bits: u32,
    },
    /// A measured curve of whole packets.
    Tabulated(ProbabilityCurve),
}

impl LinkModel {
    /// Probability that a packet arrives at a signal-to-noise ratio, in dB.
    pub fn packet_success(&self, snr_db: f64) -> f64 {
        match self {
            Self::CoherentBpsk { packet_bits } => {
                let bit_error = tail_probability((2.0 * power_ratio(snr_db)).sqrt()); // Eq. (8)
                all_bits_right(bit_error, *packet_bits)
            }
            Self::NoncoherentFskRayleigh { packet_bits } => {
                all_bits_right(1.0 / (2.0 + power_ratio(snr_db)), *packet_bits)
            }
            Self::Tabulated(curve) => curve.at(snr_db),
        }
    }
}

/// (1 − BER)^L, without the loss of digits that 1 − BER would bring.
fn all_bits_right(bit_error_rate: f64, packet_bits: u32) -> f64 {
    (f64::from(packet_bits) * (-bit_error_rate).ln_1p()).exp() // Eq. (9)
}

/// The modem's terms besides transmission loss.
#[derive(Debug, Clone, PartialEq)]
pub struct Modem {
    /// Source level of the modem, `SL_c`, dB re 1 µPa at 1 m.
    pub source_level_db: f64,
    /// Effective noise level at the receiving modem, `NL_c`, dB re 1 µPa.
    pub noise_level_db: NoiseLevel,
    /// From signal-to-noise ratio to packet success.
    pub model: LinkModel,
}

impl Modem {
    /// Checks the levels against a grid of `cells` cells.
    ///
    /// # Errors
    /// Where a level is not finite, a packet has no bits, or the noise is not
    /// given for every cell.
    pub fn check(&self, cells: usize) -> Result<(), SonarError> {
        checked("source_level_db", self.source_level_db, "a finite number", f64::is_finite)?;
        if let LinkModel::CoherentBpsk { packet_bits }
        | LinkModel::NoncoherentFskRayleigh { packet_bits } = self.model
        {
            checked("packet_bits", f64::from(packet_bits), "at least 1", |bits| bits >= 1.0)?;
        }
        self.noise_level_db.check(cells)
    }

    /// Signal-to-noise ratio at a modem in `receiver`, dB, behind a loss in dB.
    pub fn snr_db(&self, receiver: CellId, loss_db: f64) -> f64 {
        self.source_level_db - loss_db - self.noise_level_db.at_db(receiver) // Eq. (7)
    }

    /// Weights of the links between all cells, `w_pq` = min(`p_pq`, `p_qp`): what
    /// the worse direction achieves. The losses are [transmitter, receiver], dB;
    /// the result is symmetric, [cell, cell], with a diagonal of 0.
    ///
    /// # Panics
    /// Where the table is not `cells` × `cells`.
    pub fn link_weights(&self, cells: usize, losses_db: &[f32]) -> Vec<f64> {
        assert_eq!(losses_db.len(), cells * cells, "losses must be [transmitter, receiver]");
        let success = |p: usize, q: usize| {
            let loss_db = f64::from(losses_db[p * cells + q]);
            self.model.packet_success(self.snr_db(CellId(q), loss_db))
        };
        let mut weights = vec![0.0; cells * cells];
        for p in 0..cells {
            for q in 0..p {
                let weight = success(p, q).min(success(q, p));
                weights[p * cells + q] = weight;
                weights[q * cells + p] = weight;
            }
        }
        weights
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bpsk_at_its_landmarks() {
        // BER at 9.587903 dB is 1e-5 (√(2 snr) = Q⁻¹(1e-5) = 4.264890794).
        let snr_db = 10.0 * (4.264_890_793_922_825_f64.powi(2) / 2.0).log10();
        let one_bit = LinkModel::CoherentBpsk { packet_bits: 1 };
        assert!((one_bit.packet_success(snr_db) - (1.0 - 1e-5)).abs() < 1e-14);
        let packet = LinkModel::CoherentBpsk { packet_bits: 256 };
        assert!((packet.packet_success(snr_db) - (1.0 - 1e-5_f64).powi(256)).abs() < 1e-12);
        assert!((one_bit.packet_success(f64::NEG_INFINITY) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn fading_fsk_at_its_landmarks() {
        let model = LinkModel::NoncoherentFskRayleigh { packet_bits: 2 };
        // snr 8: one bit in ten is wrong.
        assert!((model.packet_success(10.0 * 8.0_f64.log10()) - 0.81).abs() < 1e-14);
    }

    #[test]
    fn the_worse_direction_counts() {
        let modem = Modem {
            source_level_db: 145.0,
            noise_level_db: NoiseLevel::PerCell(vec![63.0, 60.0]),
            model: LinkModel::CoherentBpsk { packet_bits: 256 },
        };
        assert!(modem.check(2).is_ok());
        let weights = modem.link_weights(2, &[50.0, 77.0, 74.0, 50.0]);
        // 0 → 1: 145 − 77 − 60 = 8 dB; 1 → 0: 145 − 74 − 63 = 8 dB: the same here.
        let expected = modem.model.packet_success(8.0);
        assert_eq!(weights, [0.0, expected, expected, 0.0]);
        let weights = modem.link_weights(2, &[50.0, 78.0, 74.0, 50.0]);
        let expected = modem.model.packet_success(7.0);
        assert_eq!(weights, [0.0, expected, expected, 0.0]);
    }

    #[test]
    fn an_empty_packet_is_refused() {
        let modem = Modem {
            source_level_db: 145.0,
            noise_level_db: NoiseLevel::Uniform(63.0),
            model: LinkModel::CoherentBpsk { packet_bits: 0 },
        };
        assert_eq!(
            modem.check(1).unwrap_err().to_string(),
            "`packet_bits` is 0, expected at least 1"
        );
    }
}
