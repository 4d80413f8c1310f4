use crate::field::{ReceiverLayout, Receivers};

/// Receivers in columns of ascending range, and in each by ascending depth.
pub(crate) struct Stations {
    ranges: Vec<f64>,
    /// Where each column begins in `depths`, and where the last ends.
    starts: Vec<usize>,
    depths: Vec<f64>,
    /// The receiver at each depth.
    receivers: Vec<usize>,
}

impl Stations {
    /// All receivers but those at range 0, where there is no field.
    pub(crate) fn new(receivers: &Receivers) -> Self {
        let columns = receivers.range_m().len();
        let mut places: Vec<(f64, f64, usize)> = match receivers.layout() {
            ReceiverLayout::Grid => (0..receivers.count())
                .map(|k| (receivers.range_m()[k % columns], receivers.depth_m()[k / columns], k))
                .collect(),
            ReceiverLayout::Pairs => (receivers.range_m().iter().zip(receivers.depth_m()))
                .enumerate()
                .map(|(k, (&range, &depth))| (range, depth, k))
                .collect(),
        };
        places.retain(|place| place.0 != 0.0);
        places.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let (mut ranges, mut starts) = (Vec::new(), Vec::new());
        for (index, column) in
            places.chunk_by(|a, b| a.0.to_bits() == b.0.to_bits()).scan(0, |next, column| {
                let start = *next;
                *next += column.len();
                Some((start, column))
            })
        {
            starts.push(index);
            ranges.push(column[0].0);
        }
        starts.push(places.len());
        let depths = places.iter().map(|place| place.1).collect();
        let receivers = places.iter().map(|place| place.2).collect();
        Self { ranges, starts, depths, receivers }
    }

    /// The columns at ranges from `near` up to but without `far`.
    pub(super) fn columns(&self, near: f64, far: f64) -> std::ops::Range<usize> {
        let before = |x: f64| self.ranges.partition_point(|&range| range < x);
        before(near)..before(far)
    }

    pub(super) fn range(&self, column: usize) -> f64 {
        self.ranges[column]
    }

    /// Places, within all columns, of a column's receivers between two depths.
    pub(super) fn between(&self, column: usize, top: f64, bottom: f64) -> std::ops::Range<usize> {
        let start = self.starts[column];
        let depths = &self.depths[start..self.starts[column + 1]];
        let first = depths.partition_point(|&depth| depth < top);
        let last = depths.partition_point(|&depth| depth <= bottom);
        start + first..start + last.max(first)
    }

    pub(super) fn depth(&self, place: usize) -> f64 {
        self.depths[place]
    }

    pub(super) fn receiver(&self, place: usize) -> usize {
        self.receivers[place]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn receivers_stand_in_columns() {
        let pairs = Receivers::pairs(vec![20.0, 10.0, 20.0, 0.0], vec![5.0, 1.0, 3.0, 2.0]);
        let stations = Stations::new(&pairs.unwrap());
        assert_eq!(stations.columns(0.0, 100.0), 0..2);
        assert_eq!(stations.columns(10.0, 20.0), 0..1);
        let found: Vec<usize> =
            stations.between(1, 0.0, 4.0).map(|place| stations.receiver(place)).collect();
        assert_eq!(found, [2]);
        let grid = Stations::new(&Receivers::new(vec![1.0, 2.0], vec![30.0, 10.0]).unwrap());
        let all: Vec<usize> =
            grid.between(1, f64::NEG_INFINITY, 50.0).map(|place| grid.receiver(place)).collect();
        assert_eq!(all, [3, 1]);
    }
}
