use super::FanPart;
use super::lanes::{CROSSINGS, FLOOR, LEVEL_ABOVE, LEVEL_BELOW, NODE_AHEAD, NODE_BEHIND};
use crate::ray::{Medium, MediumLimits, Pair};

/// Slowness is given in units of 1/`REFERENCE_M_S`, σ in metres times it: all
/// numbers are then near 1, metres, or metres per radian.
pub(super) const REFERENCE_M_S: f64 = 1500.0;

/// Depth of a floor that no ray meets, metres below the middle of the cell.
const BOTTOMLESS_M: f32 = 1e9;

/// The cell of lanes without a ray: it leads nowhere but to itself.
pub(super) const NOWHERE: u32 = 0;

/// What a ray does that meets one of the five ends of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// Goes on in a neighbour, across their common face.
    Cell(u32),
    /// Has come below the line over the floor: goes on, from where it is, in one of
    /// the narrow cells of which this is the first.
    Narrow(u32),
    /// Reflects at the surface.
    Surface,
    /// Reflects at the floor.
    Floor,
    /// Leaves the section.
    End,
}

/// A [`Way`] in 32 bits: cells are below `FIRST_EVENT`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Link(u32);

/// Links from here on are not to neighbours.
pub(super) const FIRST_EVENT: u32 = 1 << 30;
const SURFACE: u32 = FIRST_EVENT;
const FLOOR_BELOW: u32 = FIRST_EVENT + 1;
const END: u32 = FIRST_EVENT + 2;
const FIRST_NARROW: u32 = 1 << 31;

impl Link {
    pub(super) const NONE: Self = Self(NOWHERE);

    fn new(way: Way) -> Self {
        Self(match way {
            Way::Cell(cell) => cell,
            Way::Narrow(cell) => FIRST_NARROW + cell,
            Way::Surface => SURFACE,
            Way::Floor => FLOOR_BELOW,
            Way::End => END,
        })
    }

    /// The neighbour that it leads to, or what happens instead, from `FIRST_EVENT`.
    pub(super) const fn number(self) -> u32 {
        self.0
    }

    pub(super) const fn way(self) -> Way {
        match self.0 {
            SURFACE => Way::Surface,
            FLOOR_BELOW => Way::Floor,
            END => Way::End,
            FIRST_NARROW.. => Way::Narrow(self.0 - FIRST_NARROW),
            cell => Way::Cell(cell),
        }
    }
}

/// A cell in these units: 1/c² − 1 in the middle, G, and its twist. What is left
/// of 1/c² after taking away 1 is small, so that `f32` resolves it to 10⁻⁹.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Cell {
    pub water: Water,
    pub extent: Extent,
    pub floor: Floor,
    /// By what is met.
    pub links: [Link; CROSSINGS],
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Water {
    pub excess: f32,
    pub gradient_x: f32,
    pub gradient_z: f32,
    pub twist: f32,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pub half_width: f32,
    pub half_height: f32,
    /// Range of the middle.
    pub middle: f32,
    /// Gap to the floor under which it is met, whichever way the ray goes: 0 at a
    /// line over the floor, never at the floor itself.
    pub least_gap: f32,
}

/// The floor, or the line over it: depth below the middle of the cell, and slope.
#[derive(Debug, Clone, Copy)]
pub(super) struct Floor {
    pub depth: f32,
    pub slope: f32,
}

impl Cell {
    pub(super) const NOWHERE: Self = Self {
        water: Water { excess: 0.0, gradient_x: 0.0, gradient_z: 0.0, twist: 0.0 },
        extent: Extent { half_width: 1.0, half_height: 1.0, middle: 0.0, least_gap: -BOTTOMLESS_M },
        floor: Floor { depth: BOTTOMLESS_M, slope: 0.0 },
        links: [Link(NOWHERE); CROSSINGS],
    };
}

/// Where the beams of a part start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    pub cell: u32,
    pub local_x: f64,
    pub local_z: f64,
    /// c/`REFERENCE_M_S` squared, inverted.
    pub squared_index: f64,
}

/// A stretch of the arena that holds the cells of one part.
struct Slot {
    first: usize,
    capacity: usize,
    /// Rays that are in it or will be.
    rays: usize,
}

/// The cells of the parts whose rays are under way, made from [`Medium`]s.
///
/// Cells are as wide as the water allows; above the sea floor each is closed by a
/// straight line over which no sounding rises. A ray that comes below that line
/// passes to narrow cells of one sounding interval each.
pub(super) struct Tables {
    pub cells: Vec<Cell>,
    slots: Vec<Slot>,
    building: Building,
}

impl Tables {
    pub(super) fn new() -> Self {
        Self { cells: vec![Cell::NOWHERE], slots: Vec::new(), building: Building::default() }
    }

    /// Lays out the cells of a part for a number of rays from a point; the slot
    /// is free again when as many have been released.
    pub(super) fn lay_out(
        &mut self,
        part: &FanPart<'_>,
        source: Pair,
        rays: usize,
    ) -> (u32, Start) {
        let medium = Medium::new(part.section, &MediumLimits::from(part.settings));
        self.building.plan(&medium, part);
        let slot = self.slot_for(self.building.cell_count);
        self.slots[slot].rays = rays;
        let first = self.slots[slot].first;
        let cells = &mut self.cells[first..first + self.building.cell_count];
        self.building.write(&medium, first as u32, cells);
        (slot as u32, self.building.start(&medium, source, first as u32))
    }

    /// One ray of a slot has ended.
    pub(super) fn release(&mut self, slot: u32) {
        self.slots[slot as usize].rays -= 1;
    }

    fn slot_for(&mut self, count: usize) -> usize {
        let free = |slot: &Slot| slot.rays == 0 && slot.capacity >= count;
        if let Some(slot) = self.slots.iter().position(free) {
            return slot;
        }
        // Parts that come later may be somewhat larger.
        let (first, capacity) = (self.cells.len(), count + count / 4);
        self.cells.resize(first + capacity, Cell::NOWHERE);
        self.slots.push(Slot { first, capacity, rays: 0 });
        self.slots.len() - 1
    }
}

/// Some columns of a medium taken together.
#[derive(Debug, Clone, Copy)]
struct WideColumn {
    /// First column, and the one after the last.
    first: usize,
    end: usize,
    middle: f64,
    half_width: f64,
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
    /// Columns within, if their floor has more than one piece: else it needs no
    /// narrow cells.
    fn pieces(&self) -> usize {
        self.end - self.first
    }

    fn has_narrow_cells(&self) -> bool {
        self.pieces() > 1
    }

    fn narrow_cell(&self, layer: usize, piece: usize) -> usize {
        self.narrow + (layer - self.first_cut) * self.pieces() + piece
    }
}

/// Workspace for laying out one medium.
#[derive(Default)]
struct Building {
    /// [node, level]: 1/c² − 1 in units of the reference.
    corners: Vec<f64>,
    columns: Vec<WideColumn>,
    levels: usize,
    cell_count: usize,
}

impl Building {
    /// Decides which columns to take together and where cells go.
    fn plan(&mut self, medium: &Medium, part: &FanPart<'_>) {
        self.read_corners(medium);
        let tolerance = 2.0 * part.settings.speed_tolerance_m_s / REFERENCE_M_S;
        self.columns.clear();
        let (mut first, mut cell) = (0, 0);
        while first < medium.columns.len() {
            let end = self.reach(medium, first, part.settings.column_m, tolerance);
            let mut column = wide_column(medium, first, end);
            column.cell = cell;
            cell += column.layers;
            self.columns.push(column);
            first = end;
        }
        for column in &mut self.columns {
            column.narrow = cell;
            if column.has_narrow_cells() {
                cell += (column.layers - column.first_cut) * column.pieces();
            }
        }
        self.cell_count = cell;
    }

    fn read_corners(&mut self, medium: &Medium) {
        const SCALE: f64 = REFERENCE_M_S * REFERENCE_M_S;
        self.levels = medium.layers.len() + 1;
        self.corners.clear();
        let last = medium.columns.len() - 1;
        for node in 0..=medium.columns.len() {
            let (column, side) = if node > last { (last, 1.0) } else { (node, -1.0) };
            let x = side * medium.columns[column].half_width;
            let mut corner = |layer: usize, side: f64| {
                let from_middle = Pair::new(x, side * medium.layers[layer].half_height);
                let squared = medium.cell(column, layer).squared_slowness(from_middle);
                self.corners.push(squared * SCALE - 1.0);
            };
            for layer in 0..medium.layers.len() {
                corner(layer, -1.0);
            }
            corner(medium.layers.len() - 1, 1.0);
        }
    }

    fn corner(&self, node: usize, level: usize) -> f64 {
        self.corners[node * self.levels + level]
    }

    /// The end of the columns that may be taken together from `first` on: within
    /// the greatest width, and with water that is linear in range at all levels.
    fn reach(&self, medium: &Medium, first: usize, widest_m: f64, tolerance: f64) -> usize {
        let left = |index: usize| medium.columns[index].middle - medium.columns[index].half_width;
        let right = |index: usize| medium.columns[index].middle + medium.columns[index].half_width;
        let near = left(first);
        let farthest = near + 1.001 * widest_m;
        let within =
            medium.columns[first..].partition_point(|c| c.middle + c.half_width <= farthest);
        let mut count = within.max(1);
        while count > 1 {
            let (node, far) = (first + count, right(first + count - 1));
            let linear = (first + 1..node).all(|inner| {
                let weight = (left(inner) - near) / (far - near);
                (0..self.levels).all(|level| {
                    let (a, b) = (self.corner(first, level), self.corner(node, level));
                    (a + weight * (b - a) - self.corner(inner, level)).abs() <= tolerance
                })
            });
            if linear {
                break;
            }
            count = count.div_ceil(2);
        }
        first + count
    }

    fn write(&self, medium: &Medium, first_cell: u32, cells: &mut [Cell]) {
        for (index, column) in self.columns.iter().enumerate() {
            for layer in 0..column.layers {
                let links = self.wide_links(index, layer, first_cell);
                let cut = layer >= column.first_cut;
                let narrow = cut && column.has_narrow_cells();
                let half_height = medium.layers[layer].half_height;
                let mut cell = Cell {
                    water: self.water(column, layer, half_height),
                    extent: Extent {
                        half_width: column.half_width as f32,
                        half_height: half_height as f32,
                        middle: column.middle as f32,
                        least_gap: if narrow { 0.0 } else { -BOTTOMLESS_M },
                    },
                    links,
                    ..Cell::NOWHERE
                };
                if cut {
                    let depth = (column.floor - medium.layers[layer].middle) as f32;
                    cell.floor = Floor { depth, slope: column.slope as f32 };
                }
                cells[column.cell + layer] = cell;
                if narrow {
                    for piece in 0..column.pieces() {
                        let place = column.narrow_cell(layer, piece);
                        let links = narrow_links(column, layer, piece, links, first_cell);
                        let over = &medium.columns[column.first + piece];
                        let depth = (over.floor - medium.layers[layer].middle) as f32;
                        let shift = (over.middle - column.middle) as f32;
                        let water = cell.water;
                        cells[place] = Cell {
                            water: Water {
                                excess: water.excess + 2.0 * water.gradient_x * shift,
                                gradient_z: water.gradient_z + water.twist * shift,
                                ..water
                            },
                            extent: Extent {
                                half_width: over.half_width as f32,
                                middle: over.middle as f32,
                                least_gap: -BOTTOMLESS_M,
                                ..cell.extent
                            },
                            floor: Floor { depth, slope: over.slope as f32 },
                            links,
                        };
                    }
                }
            }
        }
    }

    fn water(&self, column: &WideColumn, layer: usize, half_height: f64) -> Water {
        let (width, height) = (2.0 * column.half_width, 2.0 * half_height);
        let [a, b] = [0, 1].map(|k| self.corner(column.first, layer + k));
        let [c, d] = [0, 1].map(|k| self.corner(column.end, layer + k));
        Water {
            excess: (0.25 * (a + b + c + d)) as f32,
            gradient_x: (0.25 * (c + d - a - b) / width) as f32,
            gradient_z: (0.25 * (b + d - a - c) / height) as f32,
            twist: (0.5 * (a + d - b - c) / (width * height)) as f32,
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
    fn start(&self, medium: &Medium, point: Pair, first_cell: u32) -> Start {
        let (column, layer) = medium.locate(point);
        let index = self.columns.partition_point(|wide| wide.end <= column);
        let wide = &self.columns[index];
        let local = medium.local(column, layer, point);
        let squared = medium.cell(column, layer).squared_slowness(local);
        Start {
            cell: first_cell + (wide.cell + layer.min(wide.layers - 1)) as u32,
            local_x: point.x - wide.middle,
            local_z: local.z,
            squared_index: squared * REFERENCE_M_S * REFERENCE_M_S,
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

/// Columns from `first` to before `end` as one, with a line over their floor:
/// parallel to the chord, as high as the highest sounding demands.
fn wide_column(medium: &Medium, first: usize, end: usize) -> WideColumn {
    let columns = &medium.columns[first..end];
    let (head, tail) = (&columns[0], &columns[columns.len() - 1]);
    let (near, far) = (head.middle - head.half_width, tail.middle + tail.half_width);
    let floor_near = head.floor - head.slope * head.half_width;
    let floor_far = tail.floor + tail.slope * tail.half_width;
    let slope = (floor_far - floor_near) / (far - near);
    let (mut rise, mut deepest) = (0.0f64, floor_near);
    for column in columns {
        let (x, depth) =
            (column.middle + column.half_width, column.floor + column.slope * column.half_width);
        rise = rise.max(floor_near + slope * (x - near) - depth);
        deepest = deepest.max(depth);
    }
    let middle = 0.5 * (near + far);
    let floor = 0.5 * (floor_near + floor_far) - rise;
    let half_width = 0.5 * (far - near);
    let shallowest = floor - slope.abs() * half_width;
    let layers =
        medium.layers.partition_point(|layer| layer.middle - layer.half_height < deepest).max(1);
    let first_cut = medium
        .layers
        .partition_point(|layer| layer.middle + layer.half_height < shallowest)
        .min(layers);
    WideColumn {
        first,
        end,
        middle,
        half_width,
        floor,
        slope,
        first_cut,
        layers,
        cell: 0,
        narrow: 0,
    }
}
