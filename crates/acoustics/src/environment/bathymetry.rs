use crate::error::{AcousticsError, ascending, length, within};

/// The sea floor along a section: straight between its nodes, level beyond the
/// first and the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Bathymetry {
    range_m: Vec<f64>,
    depth_m: Vec<f64>,
}

impl Bathymetry {
    /// A sea floor through nodes at ascending ranges; depths in metres, positive
    /// down.
    ///
    /// # Errors
    /// If there is no node, the two differ in length, ranges do not ascend, or a
    /// depth is not finite.
    pub fn new(range_m: Vec<f64>, depth_m: Vec<f64>) -> Result<Self, AcousticsError> {
        within(
            "the number of bathymetry nodes",
            "at least 1",
            range_m.len() as f64,
            !range_m.is_empty(),
        )?;
        length("bathymetry depths", range_m.len(), depth_m.len())?;
        ascending("bathymetry ranges", &range_m)?;
        for &depth in &depth_m {
            within("a depth of the sea floor", "finite", depth, true)?;
        }
        Ok(Self { range_m, depth_m })
    }

    /// A level sea floor.
    ///
    /// # Errors
    /// If the depth is not finite.
    pub fn flat(depth_m: f64) -> Result<Self, AcousticsError> {
        Self::new(vec![0.0], vec![depth_m])
    }

    /// Ranges of the nodes, metres.
    pub fn range_m(&self) -> &[f64] {
        &self.range_m
    }

    /// Depths of the nodes, metres.
    pub fn node_depth_m(&self) -> &[f64] {
        &self.depth_m
    }

    /// Depth of the sea floor at a range, metres.
    pub fn depth_at_m(&self, range_m: f64) -> f64 {
        let after = self.range_m.partition_point(|&node| node <= range_m);
        if after == 0 {
            return self.depth_m[0];
        }
        if after == self.range_m.len() {
            return self.depth_m[after - 1];
        }
        let (r0, r1) = (self.range_m[after - 1], self.range_m[after]);
        let weight = (range_m - r0) / (r1 - r0);
        self.depth_m[after - 1] + weight * (self.depth_m[after] - self.depth_m[after - 1])
    }

    /// The greatest depth of the sea floor, metres.
    pub fn deepest_m(&self) -> f64 {
        self.depth_m.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_is_straight_between_nodes_and_level_beyond() {
        let floor = Bathymetry::new(vec![0.0, 1000.0], vec![100.0, 300.0]).unwrap();
        assert_eq!(floor.depth_at_m(-5.0).to_bits(), 100f64.to_bits());
        assert!((floor.depth_at_m(250.0) - 150.0).abs() < 1e-12);
        assert!((floor.depth_at_m(1000.0) - 300.0).abs() < 1e-12);
        assert!((floor.depth_at_m(1e9) - 300.0).abs() < 1e-12);
        assert!(matches!(
            Bathymetry::new(vec![0.0, 0.0], vec![1.0, 1.0]),
            Err(AcousticsError::NotAscending { index: 1, .. })
        ));
    }
}
