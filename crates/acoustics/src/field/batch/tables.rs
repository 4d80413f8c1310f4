use super::FanPart;
use super::lanes::CROSSINGS;
use super::layout::Layout;
use crate::ray::Pair;

/// Slowness is given in units of 1/`REFERENCE_M_S`, σ in metres times it: all
/// numbers are then near 1, metres, or metres per radian.
pub(super) const REFERENCE_M_S: f64 = 1500.0;

/// Depth of a floor that no ray meets, metres below the middle of the cell.
pub(super) const BOTTOMLESS_M: f32 = 1e9;

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

    pub(super) fn new(way: Way) -> Self {
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

/// The cells of the parts whose rays are under way.
///
/// Cells are as wide as the water allows; above the sea floor each is closed by a
/// straight line over which no sounding rises. A ray that comes below that line
/// passes to narrow cells of one sounding interval each.
pub(super) struct Tables {
    pub cells: Vec<Cell>,
    slots: Vec<Slot>,
    layout: Layout,
}

impl Tables {
    pub(super) fn new() -> Self {
        Self { cells: vec![Cell::NOWHERE], slots: Vec::new(), layout: Layout::default() }
    }

    /// Lays out the cells of a part for a number of rays from a point; the slot
    /// is free again when as many have been released.
    pub(super) fn lay_out(
        &mut self,
        part: &FanPart<'_>,
        source: Pair,
        rays: usize,
    ) -> (u32, Start) {
        self.layout.plan(part);
        let slot = self.slot_for(self.layout.cell_count);
        self.slots[slot].rays = rays;
        let first = self.slots[slot].first;
        let cells = &mut self.cells[first..first + self.layout.cell_count];
        self.layout.write(first as u32, cells);
        (slot as u32, self.layout.start(source, first as u32))
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
