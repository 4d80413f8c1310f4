use super::Contribution;
use crate::complex::Complex;

/// What is done with the contributions of beams to receivers.
pub(crate) trait ContributionSink: Sized {
    /// Takes what a beam brings to a receiver. Beams come in the order of the fan.
    fn add(&mut self, receiver: usize, contribution: &Contribution);

    /// Takes what the beams that follow have brought.
    fn join(&mut self, next: Self);
}

/// Adds up pressures.
pub(crate) struct PressureSink {
    pub angular_frequency: f64,
    pub sums: Vec<Complex>,
}

impl ContributionSink for PressureSink {
    fn add(&mut self, receiver: usize, c: &Contribution) {
        let amplitude = c.amplitude * c.weight * (-c.absorption_nepers).exp();
        self.sums[receiver] +=
            Complex::from_polar(amplitude, c.phase_rad - self.angular_frequency * c.time_s);
    }

    fn join(&mut self, next: Self) {
        for (sum, more) in self.sums.iter_mut().zip(next.sums) {
            *sum += more;
        }
    }
}

/// Adds up intensities.
pub(crate) struct IntensitySink {
    pub sums: Vec<f64>,
}

impl ContributionSink for IntensitySink {
    fn add(&mut self, receiver: usize, c: &Contribution) {
        self.sums[receiver] +=
            c.amplitude * c.amplitude * c.weight * (-2.0 * c.absorption_nepers).exp();
    }

    fn join(&mut self, next: Self) {
        for (sum, more) in self.sums.iter_mut().zip(next.sums) {
            *sum += more;
        }
    }
}

/// Notes which beams pass a receiver, and how long a way they have gone there.
#[derive(Default)]
pub(crate) struct HitSink {
    /// Place in the fan, and path in metres.
    pub hits: Vec<(usize, f64)>,
}

impl ContributionSink for HitSink {
    fn add(&mut self, _: usize, c: &Contribution) {
        self.hits.push((c.beam.index, c.path_m));
    }

    fn join(&mut self, next: Self) {
        self.hits.extend(next.hits);
    }
}
