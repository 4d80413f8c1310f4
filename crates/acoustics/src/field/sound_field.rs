use crate::complex::Complex;

/// The sound field of a source on a grid of receivers.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Ranges of the receivers, metres.
    pub range_m: Vec<f64>,
    /// Depths of the receivers, metres.
    pub depth_m: Vec<f64>,
    /// Pressure over that at 1 m from the source, [depth, range], or of each pair of
    /// receivers that are no grid; of incoherent fields the root of the intensity,
    /// without a phase.
    pub pressure: Vec<Complex>,
}

impl Field {
    /// Transmission loss, in the order of the pressures, dB re 1 m; infinite where no beam
    /// came.
    pub fn loss_db(&self) -> Vec<f64> {
        self.pressure.iter().map(|p| -20.0 * p.modulus().log10()).collect()
    }
}
