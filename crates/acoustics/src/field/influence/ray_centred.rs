use super::beam::Place;
use super::{ContributionSink, Influence};
use crate::ray::{Pair, Segment};

/// Widths of beams change a little more than their ends show within a segment.
const MARGIN: f64 = 1.1;

impl<S: ContributionSink> Influence<'_, S> {
    /// Deposits on the receivers over which a segment sweeps its normal.
    pub(super) fn sweep_across(&mut self, segment: &Segment) {
        let ends = [0.0, segment.sigma].map(|sigma| Place::new(self.medley, segment, sigma));
        let reach =
            MARGIN * ends.iter().map(|end| self.beam.reach(self.medley, end)).fold(0.0, f64::max);
        let (x, z) =
            (ends.each_ref().map(|end| end.position.x), ends.each_ref().map(|end| end.position.z));
        let steepest = ends.iter().map(|end| end.along.z.abs()).fold(0.0, f64::max);
        let sideways = reach * steepest;
        let columns = self.stations.columns(x[0].min(x[1]) - sideways, x[0].max(x[1]) + sideways);
        for column in columns {
            let range = self.stations.range(column);
            let depths =
                self.stations.between(column, z[0].min(z[1]) - reach, z[0].max(z[1]) + reach);
            for index in depths {
                let receiver = Pair::new(range, self.stations.depth(index));
                let Some(sigma) = foot(segment, receiver) else { continue };
                let place = Place::new(self.medley, segment, sigma);
                let apart = receiver + place.position * -1.0;
                let across = place.along.cross(apart).abs();
                if let Some(contribution) =
                    self.beam.contribution(self.medley, segment, &place, 0.0, across)
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
