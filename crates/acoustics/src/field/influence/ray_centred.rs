use super::beam::Place;
use super::{ContributionSink, Influence};
use crate::ray::{Pair, Segment};

/// Widths of beams change a little more than their ends show within a segment.
const MARGIN: f64 = 1.1;

impl<S: ContributionSink> Influence<'_, S> {
    /// Deposits on the receivers over which a segment sweeps its normal.
    pub(super) fn sweep_across(&mut self, segment: &Segment) {
        let ends = [0.0, segment.sigma].map(|sigma| Place::new(self.physics, segment, sigma));
        let [first, last] = &ends;
        let widest = self.beam.reach(self.physics, first).max(self.beam.reach(self.physics, last));
        // The segment itself departs from its chord, at a vertex in particular.
        let bend = segment.gradient.dot(segment.gradient).sqrt();
        let reach = MARGIN * widest + bend * segment.sigma * segment.sigma / 8.0;
        let (x0, x1) = (first.position.x, last.position.x);
        let (z0, z1) = (first.position.z, last.position.z);
        let sideways = reach * first.along.z.abs().max(last.along.z.abs());
        for column in self.stations.columns(x0.min(x1) - sideways, x0.max(x1) + sideways) {
            let range = self.stations.range(column);
            let depths = self.stations.between(column, z0.min(z1) - reach, z0.max(z1) + reach);
            for index in depths {
                let receiver = Pair::new(range, self.stations.depth(index));
                let Some(sigma) = foot(segment, receiver) else { continue };
                let place = Place::new(self.physics, segment, sigma);
                let apart = receiver + place.position * -1.0;
                let across = place.along.cross(apart).abs();
                if let Some(contribution) =
                    self.beam.contribution(self.physics, segment, &place, 0.0, across)
                {
                    self.sink.add(self.stations.receiver(index), &contribution);
                }
            }
        }
    }
}

/// The σ at which the normal of the ray passes a point, (R − x)·p = 0, if it does so
/// within the segment.
fn foot(segment: &Segment, point: Pair) -> Option<f64> {
    let apart = |sigma: f64| point + segment.position(sigma) * -1.0;
    let ahead = |sigma: f64| apart(sigma).dot(segment.slowness_at(sigma));
    let (first, last) = (ahead(0.0), ahead(segment.sigma));
    if first < 0.0 || last >= 0.0 {
        return None;
    }
    let mut sigma = segment.sigma * first / (first - last);
    for _ in 0..2 {
        let slowness = segment.slowness_at(sigma);
        let closing = slowness.dot(slowness) - apart(sigma).dot(segment.gradient);
        sigma = (sigma + ahead(sigma) / closing).clamp(0.0, segment.sigma);
    }
    Some(sigma)
}
