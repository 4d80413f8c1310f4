use super::queue::Ray;
use super::tables::{Cell, Extent, Floor, NOWHERE, Water};
use crate::field::range_profile::BEAM_SPREAD;

/// Rays that are advanced together.
pub(super) const LANES: usize = 64;

/// One number of every ray.
pub(super) type Lane = [f32; LANES];

/// One index of every ray.
pub(super) type Indices = [u32; LANES];

// What a ray meets at the end of a step: indices of a cell's links.
pub(super) const NODE_BEHIND: u32 = 0;
pub(super) const NODE_AHEAD: u32 = 1;
pub(super) const LEVEL_ABOVE: u32 = 2;
pub(super) const LEVEL_BELOW: u32 = 3;
pub(super) const FLOOR: u32 = 4;
pub(super) const CROSSINGS: usize = 5;

/// The rays, a structure of arrays. Units are those of [`Cell`].
#[repr(align(64))]
pub(super) struct Lanes {
    /// From the middle of the cell.
    pub local_x: Lane,
    pub local_z: Lane,
    /// Depth of the receivers less that of the ray.
    pub above_receivers: Lane,
    pub slowness_x: Lane,
    pub slowness_z: Lane,
    /// 1 minus the square of `slowness_x`, kept apart because 1/c² minus that
    /// square is a small difference.
    pub defect: Lane,
    /// δx = ∂x/∂α, and δp.
    pub offset_x: Lane,
    pub offset_z: Lane,
    pub offset_slowness_x: Lane,
    pub offset_slowness_z: Lane,
    pub path: Lane,
    /// Product of squared reflection coefficients, and where it ends the ray.
    pub energy: Lane,
    pub least_energy: Lane,
    /// Δα times `BEAM_SPREAD`, and cos α Δα/(c₀ √(2π)) in m/s of the reference.
    pub beam_width: Lane,
    pub beam_weight: Lane,
    /// Intensity absorbed per metre, nepers.
    pub absorption: Lane,
    /// Samples of the ray's slice: the first of all slices', and how many.
    pub first_sample: Indices,
    pub sample_count: Lane,
    pub slice: Indices,
    pub slot: Indices,
    pub cell: Indices,
    /// What is in `cell`.
    pub here: Surroundings,
}

/// The cells in which the rays are.
#[repr(align(64))]
pub(super) struct Surroundings {
    pub excess: Lane,
    pub gradient_x: Lane,
    pub gradient_z: Lane,
    pub twist: Lane,
    pub half_width: Lane,
    pub half_height: Lane,
    pub middle: Lane,
    pub least_gap: Lane,
    pub floor: Lane,
    pub slope: Lane,
}

/// The same, as read cell by cell.
#[repr(align(64))]
pub(super) struct Rows {
    pub water: [Water; LANES],
    pub extent: [Extent; LANES],
    pub floor: [Floor; LANES],
}

impl Rows {
    pub(super) const NOWHERE: Self = Self {
        water: [Cell::NOWHERE.water; LANES],
        extent: [Cell::NOWHERE.extent; LANES],
        floor: [Cell::NOWHERE.floor; LANES],
    };

    #[inline(always)]
    pub(super) fn read(&mut self, lane: usize, cell: &Cell) {
        self.water[lane] = cell.water;
        self.extent[lane] = cell.extent;
        self.floor[lane] = cell.floor;
    }
}

/// The larger of two numbers. Unlike [`f32::max`] it need not care for NaN, and
/// is one vector instruction.
#[inline(always)]
pub(super) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of two numbers.
#[inline(always)]
pub(super) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The nearest whole number to one that is small, as [`f32::round_ties_even`], which
/// not every processor can do for a vector: of the sum no bits after the point are left.
#[inline(always)]
pub(super) fn nearest(x: f32) -> f32 {
    (x + ROUNDER) - ROUNDER
}

/// 1.5 · 2²³: added to a number up to 2²² either way, it leaves the nearest whole number in
/// the lowest bits.
pub(super) const ROUNDER: f32 = 12_582_912.0;

impl Surroundings {
    const NOWHERE: Self = Self {
        excess: [Cell::NOWHERE.water.excess; LANES],
        gradient_x: [Cell::NOWHERE.water.gradient_x; LANES],
        gradient_z: [Cell::NOWHERE.water.gradient_z; LANES],
        twist: [Cell::NOWHERE.water.twist; LANES],
        half_width: [Cell::NOWHERE.extent.half_width; LANES],
        half_height: [Cell::NOWHERE.extent.half_height; LANES],
        middle: [Cell::NOWHERE.extent.middle; LANES],
        least_gap: [Cell::NOWHERE.extent.least_gap; LANES],
        floor: [Cell::NOWHERE.floor.depth; LANES],
        slope: [Cell::NOWHERE.floor.slope; LANES],
    };

    /// Turns rows into columns.
    #[inline(always)]
    pub(super) fn read_all(&mut self, rows: &Rows) {
        for (i, water) in rows.water.iter().enumerate() {
            self.excess[i] = water.excess;
            self.gradient_x[i] = water.gradient_x;
            self.gradient_z[i] = water.gradient_z;
            self.twist[i] = water.twist;
        }
        for (i, extent) in rows.extent.iter().enumerate() {
            self.half_width[i] = extent.half_width;
            self.half_height[i] = extent.half_height;
            self.middle[i] = extent.middle;
            self.least_gap[i] = extent.least_gap;
        }
        for (i, floor) in rows.floor.iter().enumerate() {
            self.floor[i] = floor.depth;
            self.slope[i] = floor.slope;
        }
    }

    #[inline(always)]
    pub(super) fn read(&mut self, lane: usize, cell: &Cell) {
        self.excess[lane] = cell.water.excess;
        self.gradient_x[lane] = cell.water.gradient_x;
        self.gradient_z[lane] = cell.water.gradient_z;
        self.twist[lane] = cell.water.twist;
        self.half_width[lane] = cell.extent.half_width;
        self.half_height[lane] = cell.extent.half_height;
        self.middle[lane] = cell.extent.middle;
        self.least_gap[lane] = cell.extent.least_gap;
        self.floor[lane] = cell.floor.depth;
        self.slope[lane] = cell.floor.slope;
    }
}

impl Lanes {
    /// Lanes without rays.
    pub(super) fn new(cells: &[Cell]) -> Self {
        let mut lanes = Self {
            local_x: [0.0; LANES],
            local_z: [0.0; LANES],
            above_receivers: [0.0; LANES],
            slowness_x: [1.0; LANES],
            slowness_z: [0.0; LANES],
            defect: [0.0; LANES],
            offset_x: [0.0; LANES],
            offset_z: [0.0; LANES],
            offset_slowness_x: [0.0; LANES],
            offset_slowness_z: [0.0; LANES],
            path: [0.0; LANES],
            energy: [0.0; LANES],
            least_energy: [0.0; LANES],
            beam_width: [0.0; LANES],
            beam_weight: [0.0; LANES],
            absorption: [0.0; LANES],
            first_sample: [0; LANES],
            sample_count: [0.0; LANES],
            slice: [0; LANES],
            slot: [0; LANES],
            cell: [NOWHERE; LANES],
            here: Surroundings::NOWHERE,
        };
        for lane in 0..LANES {
            lanes.empty(lane, cells);
        }
        lanes
    }

    /// Lets a lane go through the motions without a ray: far from all receivers.
    pub(super) fn empty(&mut self, lane: usize, cells: &[Cell]) {
        (self.local_x[lane], self.local_z[lane]) = (0.0, 0.0);
        (self.slowness_x[lane], self.slowness_z[lane]) = (1.0, 0.0);
        (self.offset_x[lane], self.offset_z[lane]) = (0.0, 0.0);
        (self.offset_slowness_x[lane], self.offset_slowness_z[lane]) = (0.0, 0.0);
        (self.defect[lane], self.path[lane]) = (0.0, 0.0);
        (self.energy[lane], self.least_energy[lane]) = (0.0, 0.0);
        self.above_receivers[lane] = 1e9;
        self.sample_count[lane] = 0.0;
        self.cell[lane] = NOWHERE;
        self.here.read(lane, &cells[NOWHERE as usize]);
    }

    /// Takes a ray into that of the narrow cells, of which this is the first, in
    /// whose range it is.
    #[inline(always)]
    pub(super) fn narrow(&mut self, lane: usize, first: u32, cells: &[Cell]) {
        let (middle, x) = (self.here.middle[lane], self.local_x[lane]);
        let mut index = first;
        let mut extent = cells[index as usize].extent;
        // The last one's neighbour ahead is no narrow cell any more.
        let end = middle + self.here.half_width[lane];
        while extent.middle + extent.half_width < smaller(middle + x, end) {
            index += 1;
            extent = cells[index as usize].extent;
        }
        let from_middle = x + (middle - extent.middle);
        self.local_x[lane] = from_middle.clamp(-extent.half_width, extent.half_width);
        self.cell[lane] = index;
        self.here.read(lane, &cells[index as usize]);
    }

    /// Puts a ray into a lane.
    pub(super) fn fill(&mut self, lane: usize, ray: &Ray, cells: &[Cell]) {
        let (start, launch) = (&ray.start, &ray.launch);
        let index = start.squared_index.sqrt();
        let slowness_x = launch.cosine * index;
        self.local_x[lane] = start.local_x as f32;
        self.local_z[lane] = start.local_z as f32;
        self.above_receivers[lane] = ray.above_receivers as f32;
        self.slowness_x[lane] = slowness_x as f32;
        self.slowness_z[lane] = (launch.sine * index) as f32;
        self.defect[lane] = (1.0 - slowness_x * slowness_x) as f32;
        self.offset_x[lane] = 0.0;
        self.offset_z[lane] = 0.0;
        self.offset_slowness_x[lane] = (-launch.sine * index) as f32;
        self.offset_slowness_z[lane] = slowness_x as f32;
        self.path[lane] = 0.0;
        self.energy[lane] = 1.0;
        self.least_energy[lane] = ray.least_energy as f32;
        self.beam_width[lane] = (BEAM_SPREAD * launch.width_rad) as f32;
        self.beam_weight[lane] = (launch.weight * index) as f32;
        self.absorption[lane] = ray.absorption_m as f32;
        self.first_sample[lane] = ray.first_sample;
        self.sample_count[lane] = ray.sample_count as f32;
        self.slice[lane] = ray.slice;
        self.slot[lane] = ray.slot;
        self.cell[lane] = start.cell;
        self.here.read(lane, &cells[start.cell as usize]);
    }
}
