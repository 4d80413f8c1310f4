use super::beam::Place;
use super::{ContributionSink, Influence};
use crate::ray::Segment;

impl<S: ContributionSink> Influence<'_, S> {
    /// Deposits on the columns of receivers that a segment passes. A receiver below or
    /// above the ray has its foot on the tangent.
    pub(super) fn cross_columns(&mut self, segment: &Segment) {
        // Where the last segment ended, to the last bit: a column is passed once.
        let x0 = self.beam.front_m;
        let x1 = segment.position(segment.sigma).x;
        self.beam.front_m = x1;
        for column in self.stations.columns(x0.min(x1), x0.max(x1)) {
            let distance = self.stations.range(column) - segment.start.x;
            let sigma = segment.sigma_at_distance(distance);
            let place = Place::new(self.physics, segment, sigma);
            let reach = self.beam.vertical_reach(self.physics, &place);
            let depth = place.position.z;
            for index in self.stations.between(column, depth - reach, depth + reach) {
                let below = self.stations.depth(index) - depth;
                let (ahead, across) = (below * place.along.z, (below * place.along.x).abs());
                if let Some(contribution) =
                    self.beam.contribution(self.physics, segment, &place, ahead, across)
                {
                    self.sink.add(self.stations.receiver(index), &contribution);
                }
            }
        }
    }
}
