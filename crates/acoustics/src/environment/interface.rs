use crate::error::{AcousticsError, ascending, length, within};

/// How an interface runs between its nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InterfaceShape {
    /// Straight.
    #[default]
    Straight,
    /// Straight for where rays meet it, but smooth for how they are reflected: its
    /// normal turns steadily from node to node, and its curvature focuses sound.
    Curvilinear,
}

/// The line along which the water of a section ends: the sea floor (bathymetry) or
/// the sea surface (altimetry). It is given by nodes, and level beyond the first
/// and the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    range_m: Vec<f64>,
    depth_m: Vec<f64>,
    shape: InterfaceShape,
}

impl Interface {
    /// An interface through nodes at ascending ranges, straight between them; depths in
    /// metres, positive down.
    ///
    /// # Errors
    /// If there is no node, the two differ in length, ranges do not ascend, or a
    /// depth is not finite.
    pub fn new(range_m: Vec<f64>, depth_m: Vec<f64>) -> Result<Self, AcousticsError> {
        within(
            "the number of nodes of an interface",
            "at least 1",
            range_m.len() as f64,
            !range_m.is_empty(),
        )?;
        length("depths of an interface", range_m.len(), depth_m.len())?;
        ascending("ranges of an interface", &range_m)?;
        for &depth in &depth_m {
            within("a depth of an interface", "finite", depth, true)?;
        }
        Ok(Self { range_m, depth_m, shape: InterfaceShape::Straight })
    }

    /// A level interface.
    ///
    /// # Errors
    /// If the depth is not finite.
    pub fn flat(depth_m: f64) -> Result<Self, AcousticsError> {
        Self::new(vec![0.0], vec![depth_m])
    }

    /// The same nodes, with another shape between them.
    #[must_use]
    pub fn with_shape(self, shape: InterfaceShape) -> Self {
        Self { shape, ..self }
    }

    /// How it runs between its nodes.
    pub const fn shape(&self) -> InterfaceShape {
        self.shape
    }

    /// Ranges of the nodes, metres.
    pub fn range_m(&self) -> &[f64] {
        &self.range_m
    }

    /// Depths of the nodes, metres.
    pub fn node_depth_m(&self) -> &[f64] {
        &self.depth_m
    }

    /// Depth at a range, metres, on the straight line between nodes.
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

    /// How the normal turns over the straight piece that holds a range; none where
    /// the interface does not turn between nodes.
    pub(crate) fn bend_at(&self, range_m: f64) -> Option<Bend> {
        let after = self.range_m.partition_point(|&node| node <= range_m);
        if self.shape == InterfaceShape::Straight || after == 0 || after == self.range_m.len() {
            return None;
        }
        // Angle below the horizontal of the piece that ends at a node.
        let piece = |node: usize| {
            let level = node == 0 || node == self.range_m.len();
            let rise = |v: &[f64]| v[node] - v[node - 1];
            if level { 0.0 } else { (rise(&self.depth_m) / rise(&self.range_m)).atan() }
        };
        let tangent = |node: usize| 0.5 * (piece(node) + piece(node + 1));
        let width = self.range_m[after] - self.range_m[after - 1];
        let turning_rad_m = (tangent(after) - tangent(after - 1)) / width;
        let angle_rad = tangent(after - 1) + turning_rad_m * (range_m - self.range_m[after - 1]);
        Some(Bend { angle_rad, turning_rad_m })
    }

    /// The least depth, metres.
    pub fn shallowest_m(&self) -> f64 {
        self.depth_m.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The greatest depth, metres.
    pub fn deepest_m(&self) -> f64 {
        self.depth_m.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The direction of a smooth interface at a place, and how it turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bend {
    /// Angle of its tangent below the horizontal.
    pub angle_rad: f64,
    /// Change of the angle per metre of range.
    pub turning_rad_m: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_is_straight_between_nodes_and_level_beyond() {
        let floor = Interface::new(vec![0.0, 1000.0], vec![100.0, 300.0]).unwrap();
        assert_eq!(floor.depth_at_m(-5.0).to_bits(), 100f64.to_bits());
        assert!((floor.depth_at_m(250.0) - 150.0).abs() < 1e-12);
        assert!((floor.depth_at_m(1000.0) - 300.0).abs() < 1e-12);
        assert!((floor.depth_at_m(1e9) - 300.0).abs() < 1e-12);
        assert!(floor.bend_at(250.0).is_none());
        assert!(matches!(
            Interface::new(vec![0.0, 0.0], vec![1.0, 1.0]),
            Err(AcousticsError::NotAscending { index: 1, .. })
        ));
    }

    #[test]
    fn a_curvilinear_floor_turns_steadily_from_node_to_node() {
        let floor = Interface::new(vec![0.0, 10.0, 20.0], vec![0.0, 10.0, 20.0]).unwrap();
        let floor = floor.with_shape(InterfaceShape::Curvilinear);
        let slope = std::f64::consts::FRAC_PI_4;
        // Level before the first node, a slope of 45° on both sides of the second.
        assert!((floor.bend_at(0.0).unwrap().angle_rad - 0.5 * slope).abs() < 1e-12);
        assert!((floor.bend_at(5.0).unwrap().angle_rad - 0.75 * slope).abs() < 1e-12);
        assert!((floor.bend_at(10.0).unwrap().angle_rad - slope).abs() < 1e-12);
        assert!((floor.bend_at(5.0).unwrap().turning_rad_m - 0.05 * slope).abs() < 1e-12);
        assert!(floor.bend_at(-1.0).is_none() && floor.bend_at(20.0).is_none());
    }
}
