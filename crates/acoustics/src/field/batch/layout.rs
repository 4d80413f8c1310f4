use super::FanPart;
use super::lanes::{CROSSINGS, FLOOR, LEVEL_ABOVE, LEVEL_BELOW, NODE_AHEAD, NODE_BEHIND};
use super::tables::{BOTTOMLESS_M, Cell, Extent, Floor, Link, REFERENCE_M_S, Start, Water, Way};
use crate::environment::Interface;
use crate::ray::{Lattice, MediumLimits, Pair};

/// Ends of columns are nodes of the floor as well; soundings closer to them than this, in
/// metres, are left out.
const CLOSEST_SOUNDINGS_M: f64 = 1e-3;

/// Where the cells of one part go, and what they are.
#[derive(Default)]
pub(super) struct Layout {
    /// 1/c² − 1 in units of the reference.
    lattice: Lattice,
    columns: Vec<WideColumn>,
    /// Nodes of the floor: range and depth, those of each column behind each other.
    soundings: Vec<[f64; 2]>,
    pub cell_count: usize,
}

/// Some intervals of range nodes taken together.
#[derive(Debug, Clone, Copy)]
struct WideColumn {
    /// Nodes at its ends.
    near: usize,
    far: usize,
    middle: f64,
    half_width: f64,
    /// Its first and its last sounding.
    first_sounding: usize,
    last_sounding: usize,
    /// Depth in the middle, and slope, of the line over the floor.
    floor: f64,
    slope: f64,
    /// First layer that reaches below that line.
    first_cut: usize,
    /// Layers with water.
    layers: usize,
    /// First cell, and first narrow cell, from the beginning of the slot.
    cell: usize,
    narrow: usize,
}

impl WideColumn {
    /// Straight pieces of its floor.
    fn pieces(&self) -> usize {
        self.last_sounding - self.first_sounding
    }

    /// A single piece is the line over the floor itself.
    fn has_narrow_cells(&self) -> bool {
        self.pieces() > 1
    }

    fn narrow_cell(&self, layer: usize, piece: usize) -> usize {
        self.narrow + (layer - self.first_cut) * self.pieces() + piece
    }
}

impl Layout {
    /// Decides which intervals to take together and where cells go.
    pub(super) fn plan(&mut self, part: &FanPart<'_>) {
        self.lattice = Lattice::new(part.section, &MediumLimits::from(part.settings));
        for squared in &mut self.lattice.squared_slowness {
            *squared = *squared * REFERENCE_M_S * REFERENCE_M_S - 1.0;
        }
        self.columns.clear();
        self.soundings.clear();
        let (mut near, mut cell) = (0, 0);
        while near + 1 < self.lattice.node_m.len() {
            let far = self.reach(near, part);
            let mut column = self.wide_column(near, far, part.section.bathymetry());
            column.cell = cell;
            cell += column.layers;
            self.columns.push(column);
            near = far;
        }
        for column in &mut self.columns {
            column.narrow = cell;
            if column.has_narrow_cells() {
                cell += (column.layers - column.first_cut) * column.pieces();
            }
        }
        self.cell_count = cell;
    }

    fn corner(&self, node: usize, level: usize) -> f64 {
        self.lattice.squared_slowness[node * self.lattice.level_m.len() + level]
    }

    fn layer_count(&self) -> usize {
        self.lattice.level_m.len() - 1
    }

    fn layer_middle(&self, layer: usize) -> f64 {
        f64::midpoint(self.lattice.level_m[layer], self.lattice.level_m[layer + 1])
    }

    fn half_height(&self, layer: usize) -> f64 {
        0.5 * (self.lattice.level_m[layer + 1] - self.lattice.level_m[layer])
    }

    /// The farthest node up to which intervals may be taken together from `near` on:
    /// within the greatest width, and with water that is linear in range at all levels.
    fn reach(&self, near: usize, part: &FanPart<'_>) -> usize {
        let tolerance = 2.0 * part.settings.speed_tolerance_m_s / REFERENCE_M_S;
        let node_m = &self.lattice.node_m;
        let farthest = node_m[near] + 1.001 * part.settings.column_m;
        let within = node_m[near + 1..].partition_point(|&node| node <= farthest);
        let mut count = within.max(1);
        while count > 1 {
            let far = near + count;
            let linear = (near + 1..far).all(|inner| {
                let weight = (node_m[inner] - node_m[near]) / (node_m[far] - node_m[near]);
                (0..=self.layer_count()).all(|level| {
                    let (a, b) = (self.corner(near, level), self.corner(far, level));
                    (a + weight * (b - a) - self.corner(inner, level)).abs() <= tolerance
                })
            });
            if linear {
                break;
            }
            count = count.div_ceil(2);
        }
        near + count
    }

    /// A column with a line over its floor: parallel to the chord, as high as the highest
    /// sounding demands.
    fn wide_column(&mut self, near: usize, far: usize, floor: &Interface) -> WideColumn {
        let (x0, x1) = (self.lattice.node_m[near], self.lattice.node_m[far]);
        let first_sounding = self.soundings.len();
        self.soundings.push([x0, floor.depth_at_m(x0)]);
        let after = floor.range_m().partition_point(|&x| x <= x0 + CLOSEST_SOUNDINGS_M);
        let nodes = floor.range_m()[after..].iter().zip(&floor.node_depth_m()[after..]);
        let inside = nodes.take_while(|(x, _)| **x < x1 - CLOSEST_SOUNDINGS_M);
        self.soundings.extend(inside.map(|(&x, &depth)| [x, depth]));
        let last_sounding = self.soundings.len();
        self.soundings.push([x1, floor.depth_at_m(x1)]);

        let soundings = &self.soundings[first_sounding..];
        let (z0, z1) = (soundings[0][1], soundings[soundings.len() - 1][1]);
        let slope = (z1 - z0) / (x1 - x0);
        let (mut rise, mut deepest) = (0.0f64, z0);
        for &[x, depth] in soundings {
            rise = rise.max(z0 + slope * (x - x0) - depth);
            deepest = deepest.max(depth);
        }
        let shallowest = z0.min(z1) - rise;
        let levels = &self.lattice.level_m;
        let below = |depth: f64| levels[1..].partition_point(|&level| level < depth);
        let layers = (below(deepest) + 1).min(self.layer_count());
        WideColumn {
            near,
            far,
            middle: f64::midpoint(x0, x1),
            half_width: 0.5 * (x1 - x0),
            first_sounding,
            last_sounding,
            floor: f64::midpoint(z0, z1) - rise,
            slope,
            first_cut: below(shallowest).min(layers),
            layers,
            cell: 0,
            narrow: 0,
        }
    }

    /// Writes the cells; `first_cell` is the place of the first of them among those of
    /// all parts.
    pub(super) fn write(&self, first_cell: u32, cells: &mut [Cell]) {
        for (index, column) in self.columns.iter().enumerate() {
            for layer in 0..column.layers {
                let cell = self.wide_cell(index, layer, first_cell);
                cells[column.cell + layer] = cell;
                if layer >= column.first_cut && column.has_narrow_cells() {
                    for piece in 0..column.pieces() {
                        cells[column.narrow_cell(layer, piece)] =
                            self.narrow_cell(column, layer, piece, &cell, first_cell);
                    }
                }
            }
        }
    }

    fn wide_cell(&self, index: usize, layer: usize, first_cell: u32) -> Cell {
        let column = &self.columns[index];
        let half_height = self.half_height(layer);
        let (width, height) = (2.0 * column.half_width, 2.0 * half_height);
        let [a, b] = [0, 1].map(|k| self.corner(column.near, layer + k));
        let [c, d] = [0, 1].map(|k| self.corner(column.far, layer + k));
        let cut = layer >= column.first_cut;
        let depth = (column.floor - self.layer_middle(layer)) as f32;
        let floor = Floor { depth, slope: column.slope as f32 };
        Cell {
            water: Water {
                excess: (0.25 * (a + b + c + d)) as f32,
                gradient_x: (0.25 * (c + d - a - b) / width) as f32,
                gradient_z: (0.25 * (b + d - a - c) / height) as f32,
                twist: (0.5 * (a + d - b - c) / (width * height)) as f32,
            },
            extent: Extent {
                half_width: column.half_width as f32,
                half_height: half_height as f32,
                middle: column.middle as f32,
                least_gap: if cut && column.has_narrow_cells() { 0.0 } else { -BOTTOMLESS_M },
            },
            floor: if cut { floor } else { Cell::NOWHERE.floor },
            links: self.wide_links(index, layer, first_cell),
        }
    }

    /// The water of a wide cell over one piece of its floor.
    fn narrow_cell(
        &self,
        column: &WideColumn,
        layer: usize,
        piece: usize,
        wide: &Cell,
        first_cell: u32,
    ) -> Cell {
        let place = column.first_sounding + piece;
        let ([x0, z0], [x1, z1]) = (self.soundings[place], self.soundings[place + 1]);
        let middle = f64::midpoint(x0, x1);
        let shift = (middle - column.middle) as f32;
        let depth = (f64::midpoint(z0, z1) - self.layer_middle(layer)) as f32;
        let water = wide.water;
        Cell {
            water: Water {
                excess: water.excess + 2.0 * water.gradient_x * shift,
                gradient_z: water.gradient_z + water.twist * shift,
                ..water
            },
            extent: Extent {
                half_width: (0.5 * (x1 - x0)) as f32,
                middle: middle as f32,
                least_gap: -BOTTOMLESS_M,
                ..wide.extent
            },
            floor: Floor { depth, slope: ((z1 - z0) / (x1 - x0)) as f32 },
            links: narrow_links(column, layer, piece, wide.links, first_cell),
        }
    }

    fn wide_links(&self, index: usize, layer: usize, first_cell: u32) -> [Link; CROSSINGS] {
        let column = &self.columns[index];
        let cell = |column: &WideColumn, layer: usize| {
            Way::Cell(first_cell + (column.cell + layer) as u32)
        };
        let floor = if layer >= column.first_cut && column.has_narrow_cells() {
            Way::Narrow(first_cell + column.narrow_cell(layer, 0) as u32)
        } else {
            Way::Floor
        };
        // Where a neighbour has no water, the floor comes in between.
        let beside = |neighbour: Option<&WideColumn>| match neighbour {
            None => Way::End,
            Some(next) if layer < next.layers => cell(next, layer),
            Some(_) => floor,
        };
        let mut ways = [Way::End; CROSSINGS];
        ways[NODE_BEHIND as usize] = beside(index.checked_sub(1).map(|k| &self.columns[k]));
        ways[NODE_AHEAD as usize] = beside(self.columns.get(index + 1));
        ways[LEVEL_ABOVE as usize] =
            if layer == 0 { Way::Surface } else { cell(column, layer - 1) };
        ways[LEVEL_BELOW as usize] =
            if layer + 1 < column.layers { cell(column, layer + 1) } else { floor };
        ways[FLOOR as usize] = floor;
        ways.map(Link::new)
    }

    /// Where beams from a point start.
    pub(super) fn start(&self, point: Pair, first_cell: u32) -> Start {
        let ends = |column: &WideColumn| column.middle + column.half_width <= point.x;
        let column = &self.columns[self.columns.partition_point(ends).min(self.columns.len() - 1)];
        let above = self.lattice.level_m[1..].partition_point(|&level| level <= point.z);
        let layer = above.min(column.layers - 1);
        let (x, z) = (point.x - column.middle, point.z - self.layer_middle(layer));
        let (right, down) =
            (0.5 + 0.5 * x / column.half_width, 0.5 + 0.5 * z / self.half_height(layer));
        let at = |node: usize| {
            let [upper, lower] = [0, 1].map(|k| self.corner(node, layer + k));
            upper + down * (lower - upper)
        };
        Start {
            cell: first_cell + (column.cell + layer) as u32,
            local_x: x,
            local_z: z,
            squared_index: 1.0 + at(column.near) + right * (at(column.far) - at(column.near)),
        }
    }
}

/// Within the wide cell its pieces lead to each other, out of it to where it
/// leads.
fn narrow_links(
    column: &WideColumn,
    layer: usize,
    piece: usize,
    wide: [Link; CROSSINGS],
    first_cell: u32,
) -> [Link; CROSSINGS] {
    let floor = Link::new(Way::Floor);
    let mut links =
        wide.map(|link| if matches!(link.way(), Way::Narrow(_)) { floor } else { link });
    let beside = |piece| Link::new(Way::Cell(first_cell + column.narrow_cell(layer, piece) as u32));
    if piece > 0 {
        links[NODE_BEHIND as usize] = beside(piece - 1);
    }
    if piece + 1 < column.pieces() {
        links[NODE_AHEAD as usize] = beside(piece + 1);
    }
    links
}
