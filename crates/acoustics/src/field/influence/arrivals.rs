use super::{Contribution, ContributionSink};
use crate::field::Arrival;

/// Neighbouring beams bring the same arrival to a receiver if their phases there differ
/// by less than this, radians.
const SAME_PHASE_RAD: f64 = 0.5;

/// Collects arrivals: what consecutive beams bring to a receiver by the same number of
/// bounces and caustics, and almost in phase, is one.
pub(crate) struct ArrivalSink {
    angular_frequency: f64,
    at: Vec<Vec<Cluster>>,
}

/// What a run of consecutive beams brings.
#[derive(Debug, Clone, Copy)]
struct Cluster {
    first_beam: usize,
    last_beam: usize,
    first_delay_s: f64,
    last_delay_s: f64,
    /// Its sums weigh by amplitude.
    amplitude: f64,
    delay_sum: f64,
    absorption_sum: f64,
    launch_angle_sum: f64,
    arrival_angle_sum: f64,
    phase_rad: f64,
    surface_bounces: u32,
    bottom_bounces: u32,
}

impl Cluster {
    fn new(c: &Contribution) -> Self {
        let amplitude = c.amplitude * c.weight;
        let arrival_angle = c.slowness.z.atan2(c.slowness.x);
        Self {
            first_beam: c.beam.index,
            last_beam: c.beam.index,
            first_delay_s: c.time_s,
            last_delay_s: c.time_s,
            amplitude,
            delay_sum: amplitude * c.time_s,
            absorption_sum: amplitude * c.absorption_nepers,
            launch_angle_sum: amplitude * c.beam.angle_rad,
            arrival_angle_sum: amplitude * arrival_angle,
            phase_rad: c.phase_rad,
            surface_bounces: c.surface_bounces,
            bottom_bounces: c.bottom_bounces,
        }
    }

    fn is_followed_by(&self, next: &Self, angular_frequency: f64) -> bool {
        let apart = angular_frequency * (next.first_delay_s - self.last_delay_s);
        next.first_beam <= self.last_beam + 1
            && apart.abs() < SAME_PHASE_RAD
            && (next.phase_rad - self.phase_rad).abs() < SAME_PHASE_RAD
            && (next.surface_bounces, next.bottom_bounces)
                == (self.surface_bounces, self.bottom_bounces)
    }

    fn absorb(&mut self, next: &Self) {
        self.last_beam = next.last_beam;
        self.last_delay_s = next.last_delay_s;
        self.amplitude += next.amplitude;
        self.delay_sum += next.delay_sum;
        self.absorption_sum += next.absorption_sum;
        self.launch_angle_sum += next.launch_angle_sum;
        self.arrival_angle_sum += next.arrival_angle_sum;
    }

    fn arrival(&self, spreading: f64) -> Arrival {
        let mean = |sum: f64| sum / self.amplitude;
        Arrival {
            amplitude: self.amplitude * spreading,
            phase_rad: self.phase_rad,
            delay_s: mean(self.delay_sum),
            absorption_nepers: mean(self.absorption_sum),
            launch_angle_deg: mean(self.launch_angle_sum).to_degrees(),
            arrival_angle_deg: mean(self.arrival_angle_sum).to_degrees(),
            surface_bounces: self.surface_bounces,
            bottom_bounces: self.bottom_bounces,
        }
    }
}

impl ArrivalSink {
    pub(crate) fn new(receivers: usize, angular_frequency: f64) -> Self {
        Self { angular_frequency, at: vec![Vec::new(); receivers] }
    }

    fn add_cluster(&mut self, receiver: usize, next: &Cluster) {
        let frequency = self.angular_frequency;
        let arrivals = &mut self.at[receiver];
        match arrivals.iter_mut().rev().find(|last| last.is_followed_by(next, frequency)) {
            Some(last) => last.absorb(next),
            None => arrivals.push(*next),
        }
    }

    /// The arrivals at each receiver by ascending delay; `spreading` is the factor of
    /// amplitude that is still missing at a receiver.
    pub(crate) fn into_arrivals(self, spreading: impl Fn(usize) -> f64) -> Vec<Vec<Arrival>> {
        let sorted = |(receiver, clusters): (usize, Vec<Cluster>)| {
            let heard = clusters.iter().filter(|cluster| cluster.amplitude > 0.0);
            let mut arrivals: Vec<Arrival> =
                heard.map(|cluster| cluster.arrival(spreading(receiver))).collect();
            arrivals.sort_by(|a, b| a.delay_s.total_cmp(&b.delay_s));
            arrivals
        };
        self.at.into_iter().enumerate().map(sorted).collect()
    }
}

impl ContributionSink for ArrivalSink {
    fn add(&mut self, receiver: usize, contribution: &Contribution) {
        self.add_cluster(receiver, &Cluster::new(contribution));
    }

    fn join(&mut self, next: Self) {
        for (receiver, clusters) in next.at.iter().enumerate() {
            for cluster in clusters {
                self.add_cluster(receiver, cluster);
            }
        }
    }
}
