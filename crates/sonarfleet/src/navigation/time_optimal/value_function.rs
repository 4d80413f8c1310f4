//! Time-to-go functions of a set of goals on a grid of nodes and times.

use crate::grid::Position;
use crate::navigation::TransitDomain;

/// Goals are stored in groups of this many, so that loops over them vectorise.
const LANE_GROUP: usize = 8;

/// Plans keep this far inside the wall, so that what a step of the plan neglects
/// (a few metres) takes no vehicle across it.
pub(super) const WALL_CLEARANCE_M: f64 = 100.0;

/// Equally spaced nodes over a domain, edges included.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NodeGrid {
    pub(super) origin: Position,
    pub(super) spacing_east_m: f64,
    pub(super) spacing_north_m: f64,
    pub(super) columns: usize,
    pub(super) rows: usize,
}

impl NodeGrid {
    /// Nodes at most `spacing_m` apart.
    pub(super) fn over(domain: TransitDomain, spacing_m: f64) -> Self {
        let cells = |extent_m: f64| (extent_m / spacing_m - 1e-9).ceil().max(1.0);
        let (columns, rows) = (cells(domain.width_m()), cells(domain.height_m()));
        let spacing_east_m = domain.width_m() / columns;
        let spacing_north_m = domain.height_m() / rows;
        Self {
            origin: domain.south_west(),
            spacing_east_m,
            spacing_north_m,
            columns: columns as usize + 1,
            rows: rows as usize + 1,
        }
    }

    pub(super) fn node_count(&self) -> usize {
        self.columns * self.rows
    }

    pub(super) fn node(&self, column: usize, row: usize) -> Position {
        Position::new(
            self.origin.east_m + column as f64 * self.spacing_east_m,
            self.origin.north_m + row as f64 * self.spacing_north_m,
        )
    }

    /// Coordinates of a point, counted in nodes; none outside the grid.
    pub(super) fn coordinates(&self, point: Position) -> Option<(f64, f64)> {
        let x = (point.east_m - self.origin.east_m) / self.spacing_east_m;
        let y = (point.north_m - self.origin.north_m) / self.spacing_north_m;
        self.holds(x, y).then_some((x, y))
    }

    /// Whether coordinates counted in nodes lie in the grid, up to rounding.
    pub(super) fn holds(&self, x: f64, y: f64) -> bool {
        const ROUNDING: f64 = 1e-9;
        let inside = |at: f64, nodes: usize| at >= -ROUNDING && at <= (nodes - 1) as f64 + ROUNDING;
        inside(x, self.columns) && inside(y, self.rows)
    }

    /// The part of the grid that lies [`WALL_CLEARANCE_M`] inside the wall.
    pub(super) fn clear_of_wall(&self) -> ClearWater {
        let east_nodes = (WALL_CLEARANCE_M / self.spacing_east_m) as f32;
        let north_nodes = (WALL_CLEARANCE_M / self.spacing_north_m) as f32;
        ClearWater {
            west: east_nodes,
            east: (self.columns - 1) as f32 - east_nodes,
            south: north_nodes,
            north: (self.rows - 1) as f32 - north_nodes,
        }
    }

    /// The cell that holds a point of the grid and the bilinear weights of its
    /// corners: south-west, south-east, north-west, north-east.
    #[inline]
    pub(super) fn stencil(&self, x: f32, y: f32) -> Stencil {
        // Through i32, to and from which floats convert fastest.
        let column = (x as i32).min(self.columns as i32 - 2);
        let row = (y as i32).min(self.rows as i32 - 2);
        let right = x - column as f32;
        let up = y - row as f32;
        let north_east = right * up;
        let south_east = right - north_east;
        let north_west = up - north_east;
        let south_west = 1.0 - right - north_west;
        Stencil {
            node: row as usize * self.columns + column as usize,
            weights: [south_west, south_east, north_west, north_east],
        }
    }
}

/// Bounds counted in nodes.
#[derive(Debug, Clone, Copy)]
pub(super) struct ClearWater {
    pub(super) west: f32,
    pub(super) east: f32,
    pub(super) south: f32,
    pub(super) north: f32,
}

/// Four nodes of a cell and their weights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stencil {
    /// The south-west node.
    pub(super) node: usize,
    pub(super) weights: [f32; 4],
}

/// Hours to go to each goal from every node and time.
#[derive(Debug, Clone)]
pub(super) struct ValueFunction {
    pub(super) grid: NodeGrid,
    pub(super) departure_h: f64,
    pub(super) step_h: f64,
    /// Time steps; there is one layer more.
    pub(super) steps: usize,
    /// Values per node: goals, filled up to whole groups.
    pub(super) lanes: usize,
    /// [layer, row, column, lane], hours.
    pub(super) hours: Vec<f32>,
}

impl ValueFunction {
    pub(super) const fn lanes_for(goals: usize) -> usize {
        goals.next_multiple_of(LANE_GROUP)
    }

    /// Memory of a value function, bytes.
    pub(super) fn bytes(grid: &NodeGrid, steps: usize, goals: usize) -> usize {
        let values = (steps + 1) * grid.node_count() * Self::lanes_for(goals);
        values * size_of::<f32>()
    }

    /// Hours to go from a point of the grid, coordinates counted in nodes, at a
    /// time: bilinear in space, linear in time, clamped to the layers.
    pub(super) fn at(&self, goal: usize, x: f64, y: f64, time_h: f64) -> f64 {
        let stencil = self.grid.stencil(x as f32, y as f32);
        let since = ((time_h - self.departure_h) / self.step_h).clamp(0.0, self.steps as f64);
        // Layers of whole steps are hit exactly, in spite of rounding.
        let below = ((since + 1e-9) as usize).min(self.steps);
        let later = since - below as f64;
        let now = self.in_layer(goal, stencil, below);
        if later <= 1e-9 || below == self.steps {
            return now;
        }
        now + later * (self.in_layer(goal, stencil, below + 1) - now)
    }

    fn in_layer(&self, goal: usize, stencil: Stencil, layer: usize) -> f64 {
        let columns = self.grid.columns;
        let node = layer * self.grid.node_count() + stencil.node;
        let corners = [node, node + 1, node + columns, node + columns + 1];
        let value = |node: usize| self.hours[node * self.lanes + goal];
        let sum: f32 = corners
            .into_iter()
            .zip(stencil.weights)
            .map(|(node, weight)| weight * value(node))
            .sum();
        f64::from(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_cover_the_domain_to_its_edges() {
        let domain = TransitDomain::around_region(30_900.0, 30_900.0, 10_300.0).unwrap();
        let grid = NodeGrid::over(domain, 515.0);
        assert_eq!((grid.columns, grid.rows), (101, 101));
        let corner = grid.coordinates(domain.north_east()).unwrap();
        assert!((corner.0 - 100.0).abs() < 1e-9 && (corner.1 - 100.0).abs() < 1e-9);
        assert!(grid.coordinates(Position::new(-10_301.0, 0.0)).is_none());
        let last = grid.stencil(100.0, 100.0);
        assert_eq!(last.node, 99 * 101 + 99);
        assert!((last.weights[3] - 1.0).abs() < 1e-6);
    }
}
