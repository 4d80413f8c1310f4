//! The current at the vehicles' depth, over space and time.

use super::NavigationError;
use crate::grid::Position;

/// Faster than any ocean current: a field that exceeds it is in wrong units.
const IMPLAUSIBLE_SPEED_M_S: f64 = 10.0;

/// Ascending coordinates of nodes.
#[derive(Debug, Clone, PartialEq)]
struct Axis {
    nodes: Vec<f64>,
    /// One over the mean spacing, from which the search of a cell starts.
    inverse_step: f64,
}

impl Axis {
    fn new(name: &'static str, nodes: Vec<f64>) -> Result<Self, NavigationError> {
        let ascending = nodes.windows(2).all(|pair| pair[0] < pair[1]);
        if nodes.is_empty() || !ascending || nodes.iter().any(|node| !node.is_finite()) {
            let found = match nodes.len() {
                0 => "none".to_owned(),
                count if count <= 6 => format!("{nodes:?}"),
                count => format!("{count} nodes, {:?} …", &nodes[..5]),
            };
            return Err(NavigationError::InvalidAxis { axis: name, found });
        }
        let inverse_step = match nodes.len() {
            1 => 0.0,
            count => (count - 1) as f64 / (nodes[count - 1] - nodes[0]),
        };
        Ok(Self { nodes, inverse_step })
    }

    /// The node below `coordinate` and the fraction of the way to the next one,
    /// clamped to the ends.
    fn locate(&self, coordinate: f64) -> (usize, f64) {
        let last = self.nodes.len() - 1;
        if last == 0 || coordinate <= self.nodes[0] {
            return (0, 0.0);
        }
        if coordinate >= self.nodes[last] {
            return (last - 1, 1.0);
        }
        let guess = (coordinate - self.nodes[0]) * self.inverse_step;
        let mut below = (guess as usize).min(last - 1);
        while self.nodes[below] > coordinate {
            below -= 1;
        }
        while self.nodes[below + 1] <= coordinate {
            below += 1;
        }
        let (low, high) = (self.nodes[below], self.nodes[below + 1]);
        (below, (coordinate - low) / (high - low))
    }

    fn len(&self) -> usize {
        self.nodes.len()
    }
}

/// The horizontal current at the vehicles' depth on a grid of nodes in the local
/// frame, bilinear in space and linear in time. Beyond the nodes and beyond the
/// time span the nearest value holds.
///
/// A node whose current is missing (NaN) at any time is land. A point is land if
/// the node nearest to it is; elsewhere the current is interpolated over the
/// nodes of its cell that are water.
#[derive(Debug, Clone, PartialEq)]
pub struct CurrentField {
    east: Axis,
    north: Axis,
    time: Axis,
    /// [time, north, east], m/s eastward and northward; zero on land.
    velocity_m_s: Vec<[f64; 2]>,
    /// [north, east]; empty where all is water.
    land: Vec<bool>,
}

impl CurrentField {
    /// A field from its nodes: `east_m`, `north_m` (metres in the local frame) and
    /// `time_h` (hours since the run's start), each ascending, and the two
    /// components of the current, [time, north, east], m/s, NaN on land.
    ///
    /// # Errors
    /// An axis that does not ascend, arrays of a wrong size, a current over
    /// 10 m/s, or no water at all.
    pub fn new(
        east_m: Vec<f64>,
        north_m: Vec<f64>,
        time_h: Vec<f64>,
        eastward_m_s: &[f64],
        northward_m_s: &[f64],
    ) -> Result<Self, NavigationError> {
        let east = Axis::new("east", east_m)?;
        let north = Axis::new("north", north_m)?;
        let time = Axis::new("time", time_h)?;
        let nodes = east.len() * north.len();
        let expected = nodes * time.len();
        for (component, values) in [("eastward", eastward_m_s), ("northward", northward_m_s)] {
            if values.len() != expected {
                let found = values.len();
                return Err(NavigationError::WrongShape { component, expected, found });
            }
        }

        let velocity_m_s: Vec<[f64; 2]> =
            eastward_m_s.iter().zip(northward_m_s).map(|(&u, &v)| [u, v]).collect();
        let mut land = vec![false; nodes];
        for (index, [u, v]) in velocity_m_s.iter().enumerate() {
            let speed_m_s = u.hypot(*v);
            if speed_m_s > IMPLAUSIBLE_SPEED_M_S {
                return Err(NavigationError::ImplausibleCurrent {
                    east_m: east.nodes[index % east.len()],
                    north_m: north.nodes[index % nodes / east.len()],
                    time_h: time.nodes[index / nodes],
                    speed_m_s,
                });
            }
            land[index % nodes] |= u.is_nan() || v.is_nan();
        }
        Self { east, north, time, velocity_m_s, land: Vec::new() }.with_land(land)
    }

    /// A current that is the same everywhere and always, m/s.
    ///
    /// # Errors
    /// As [`CurrentField::new`].
    pub fn uniform(eastward_m_s: f64, northward_m_s: f64) -> Result<Self, NavigationError> {
        Self::new(vec![0.0], vec![0.0], vec![0.0], &[eastward_m_s], &[northward_m_s])
    }

    /// The field with further nodes made impassable, for example those over water
    /// that is shallower than the vehicles' depth.
    ///
    /// # Errors
    /// No water is left.
    pub fn closed_where(
        mut self,
        closed: impl Fn(Position) -> bool,
    ) -> Result<Self, NavigationError> {
        let columns = self.east.len();
        let nodes = columns * self.north.len();
        let mut land = std::mem::take(&mut self.land);
        land.resize(nodes, false);
        for (node, dry) in land.iter_mut().enumerate() {
            let (east_m, north_m) =
                (self.east.nodes[node % columns], self.north.nodes[node / columns]);
            *dry |= closed(Position::new(east_m, north_m));
        }
        self.with_land(land)
    }

    /// The field with this land, [north, east].
    fn with_land(mut self, land: Vec<bool>) -> Result<Self, NavigationError> {
        let nodes = land.len();
        if land.iter().all(|&dry| dry) {
            return Err(NavigationError::NoWater { nodes, times: self.time.len() });
        }
        if land.contains(&true) {
            for (index, velocity) in self.velocity_m_s.iter_mut().enumerate() {
                if land[index % nodes] {
                    *velocity = [0.0; 2];
                }
            }
            self.land = land;
        }
        Ok(self)
    }

    /// Whether a point is land.
    pub fn is_land(&self, point: Position) -> bool {
        if self.land.is_empty() {
            return false;
        }
        let (column, right) = self.east.locate(point.east_m);
        let (row, up) = self.north.locate(point.north_m);
        let nearest_column = column + usize::from(right >= 0.5);
        let nearest_row = row + usize::from(up >= 0.5);
        self.land[nearest_row * self.east.len() + nearest_column]
    }

    /// Whether any of the field is land.
    pub fn has_land(&self) -> bool {
        !self.land.is_empty()
    }

    /// The current [eastward, northward] at a point and a time, m/s; zero amid land.
    pub fn velocity_m_s(&self, point: Position, time_h: f64) -> [f64; 2] {
        let (column, right) = self.east.locate(point.east_m);
        let (row, up) = self.north.locate(point.north_m);
        let (step, later) = self.time.locate(time_h);
        let columns = self.east.len();
        let nodes = columns * self.north.len();
        let next_column = (column + 1).min(columns - 1);
        let next_row = (row + 1).min(self.north.len() - 1);
        let corners = [
            row * columns + column,
            row * columns + next_column,
            next_row * columns + column,
            next_row * columns + next_column,
        ];
        let weights =
            [(1.0 - right) * (1.0 - up), right * (1.0 - up), (1.0 - right) * up, right * up];
        let at = |step: usize| {
            let mut sum = [0.0; 2];
            for (corner, weight) in corners.into_iter().zip(weights) {
                let [u, v] = self.velocity_m_s[step * nodes + corner];
                sum[0] += weight * u;
                sum[1] += weight * v;
            }
            sum
        };
        let now = at(step);
        let next = at((step + 1).min(self.time.len() - 1));
        let mut velocity =
            [now[0] + later * (next[0] - now[0]), now[1] + later * (next[1] - now[1])];
        if !self.land.is_empty() {
            let wet: f64 = corners
                .into_iter()
                .zip(weights)
                .filter(|&(corner, _)| !self.land[corner])
                .map(|(_, weight)| weight)
                .sum();
            let scale = if wet > 0.0 { 1.0 / wet } else { 0.0 };
            velocity = velocity.map(|component| component * scale);
        }
        velocity
    }

    /// The greatest speed of the current at any node and time, m/s.
    pub fn greatest_speed_m_s(&self) -> f64 {
        self.velocity_m_s.iter().map(|[u, v]| u.hypot(*v)).fold(0.0, f64::max)
    }

    /// First and last time of the nodes, hours since the run's start.
    pub fn time_span_h(&self) -> (f64, f64) {
        (self.time.nodes[0], self.time.nodes[self.time.len() - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field() -> CurrentField {
        // u = time, v = east/1000 + 10 · north/1000.
        let (mut u, mut v) = (Vec::new(), Vec::new());
        for time in [0.0, 2.0] {
            for north in [0.0, 1.0] {
                for east in [0.0, 1.0, 3.0] {
                    u.push(time);
                    v.push(east / 10.0 + north);
                }
            }
        }
        CurrentField::new(vec![0.0, 1e3, 3e3], vec![0.0, 1e3], vec![0.0, 2.0], &u, &v).unwrap()
    }

    #[test]
    fn interpolates_linearly_and_clamps() {
        let at = |east, north, time| field().velocity_m_s(Position::new(east, north), time);
        let expect = |found: [f64; 2], u: f64, v: f64| {
            assert!((found[0] - u).abs() < 1e-12 && (found[1] - v).abs() < 1e-12, "{found:?}");
        };
        expect(at(2_000.0, 250.0, 0.5), 0.5, 0.45);
        expect(at(-5.0, -5.0, -1.0), 0.0, 0.0);
        expect(at(9e3, 9e3, 9.0), 2.0, 1.3);
    }

    #[test]
    fn land_is_the_surrounding_of_its_node() {
        let nan = f64::NAN;
        let u = [0.2, nan, 0.4, 0.6];
        let field =
            CurrentField::new(vec![0.0, 1e3], vec![0.0, 1e3], vec![0.0], &u, &[0.0, 0.0, 0.0, 0.0])
                .unwrap();
        assert!(field.is_land(Position::new(900.0, 100.0)));
        assert!(!field.is_land(Position::new(400.0, 100.0)));
        let near = field.velocity_m_s(Position::new(500.0, 0.0), 0.0);
        assert!((near[0] - 0.2).abs() < 1e-12, "only the wet corner counts: {near:?}");
    }

    #[test]
    fn nodes_can_be_closed() {
        let shoal = |node: Position| node.east_m > 2_000.0 && node.north_m < 500.0;
        let closed = field().closed_where(shoal).unwrap();
        assert!(closed.is_land(Position::new(2_500.0, 0.0)));
        assert!(!closed.is_land(Position::new(2_500.0, 900.0)));
        assert!(matches!(
            field().closed_where(|_| true),
            Err(NavigationError::NoWater { nodes: 6, times: 2 })
        ));
    }

    #[test]
    fn refuses_what_is_no_current() {
        let one = vec![0.0];
        let new = |u: f64| CurrentField::new(one.clone(), one.clone(), one.clone(), &[u], &[0.0]);
        assert!(matches!(new(f64::NAN), Err(NavigationError::NoWater { nodes: 1, times: 1 })));
        assert!(matches!(new(23.0), Err(NavigationError::ImplausibleCurrent { .. })));
        let axis =
            CurrentField::new(vec![1.0, 1.0], one.clone(), one.clone(), &[0.0; 2], &[0.0; 2]);
        assert!(matches!(axis, Err(NavigationError::InvalidAxis { axis: "east", .. })));
        let shape = CurrentField::new(one.clone(), one.clone(), one, &[0.0], &[]);
        assert!(matches!(shape, Err(NavigationError::WrongShape { component: "northward", .. })));
    }
}
