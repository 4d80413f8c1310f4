use super::FanPart;
use crate::ray::{Medium, MediumLimits, Pair};

/// Slowness is given in units of 1/`REFERENCE_M_S`, σ in metres times it: all
/// numbers are then near 1, metres, or metres per radian.
pub(super) const REFERENCE_M_S: f64 = 1500.0;

/// A cell in these units: 1/c² − 1 in the middle, G, and its twist. What is left
/// of 1/c² after taking away 1 is small, so that `f32` resolves it to 10⁻⁹.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub excess: f32,
    pub gradient_x: f32,
    pub gradient_z: f32,
    pub twist: f32,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    pub middle: f32,
    pub half_width: f32,
    pub floor: f32,
    pub slope: f32,
    /// First layer, of all parts, that reaches below the floor.
    pub first_cut: u32,
    /// Index of this column's cell in layer 0 of all parts' layers; may wrap.
    pub cell_base: u32,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Layer {
    pub middle: f32,
    pub half_height: f32,
}

/// First and last column and layer of a part.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Bounds {
    pub first_column: u32,
    pub last_column: u32,
    pub first_layer: u32,
    pub last_layer: u32,
}

/// Where the beams of a part start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    pub bounds: Bounds,
    pub column: u32,
    pub layer: u32,
    pub local_x: f64,
    pub local_z: f64,
    /// c/`REFERENCE_M_S` squared, inverted.
    pub squared_index: f64,
    pub cutoff: f64,
}

/// The media of all parts behind each other.
pub(super) struct Tables {
    media: Vec<Medium>,
    bounds: Vec<Bounds>,
    pub cells: Vec<Cell>,
    pub columns: Vec<Column>,
    pub layers: Vec<Layer>,
}

impl Tables {
    pub(super) fn new(parts: &[FanPart<'_>]) -> Self {
        let mut tables = Self {
            media: Vec::new(),
            bounds: Vec::new(),
            cells: Vec::new(),
            columns: Vec::new(),
            layers: Vec::new(),
        };
        for part in parts {
            tables.append(Medium::new(part.section, &MediumLimits::from(part.settings)));
        }
        tables
    }

    fn append(&mut self, medium: Medium) {
        const SCALE: f64 = REFERENCE_M_S * REFERENCE_M_S;
        let (first_column, first_layer) = (self.columns.len() as u32, self.layers.len() as u32);
        let layer_count = medium.layers.len() as u32;
        let first_cell = self.cells.len() as u32;
        self.columns.extend(medium.columns.iter().enumerate().map(|(index, column)| Column {
            middle: column.middle as f32,
            half_width: column.half_width as f32,
            floor: column.floor as f32,
            slope: column.slope as f32,
            first_cut: first_layer + column.first_cut as u32,
            cell_base: (first_cell + index as u32 * layer_count).wrapping_sub(first_layer),
        }));
        self.layers.extend(medium.layers.iter().map(|layer| Layer {
            middle: layer.middle as f32,
            half_height: layer.half_height as f32,
        }));
        self.cells.extend(medium.cells.iter().map(|cell| Cell {
            excess: (cell.centre * SCALE - 1.0) as f32,
            gradient_x: (cell.gradient.x * SCALE) as f32,
            gradient_z: (cell.gradient.z * SCALE) as f32,
            twist: (cell.twist * SCALE) as f32,
        }));
        self.bounds.push(Bounds {
            first_column,
            last_column: self.columns.len() as u32 - 1,
            first_layer,
            last_layer: self.layers.len() as u32 - 1,
        });
        self.media.push(medium);
    }

    pub(super) fn cell(&self, column: u32, layer: u32) -> Cell {
        self.cells[self.columns[column as usize].cell_base.wrapping_add(layer) as usize]
    }

    /// Where beams from a point start in a part.
    pub(super) fn start(&self, part: usize, point: Pair, cutoff: f64) -> Start {
        let (medium, bounds) = (&self.media[part], self.bounds[part]);
        let (column, layer) = medium.locate(point);
        let local = medium.local(column, layer, point);
        let squared = medium.cell(column, layer).squared_slowness(local);
        Start {
            bounds,
            column: bounds.first_column + column as u32,
            layer: bounds.first_layer + layer as u32,
            local_x: local.x,
            local_z: local.z,
            squared_index: squared * REFERENCE_M_S * REFERENCE_M_S,
            cutoff,
        }
    }
}
