use super::levels::{Level, levels, squared_slowness};
use super::segment::Pair;
use crate::environment::{Bend, ProfileLaw, Section, SoundSpeedField};

/// A section made ready for rays: cells between range nodes and depth levels,
/// with 1/c² bilinear in each.
#[derive(Debug, Clone, Default)]
pub(crate) struct Medium {
    pub columns: Vec<Column>,
    pub layers: Vec<Layer>,
    /// [column, layer]
    pub cells: Vec<Cell>,
}

/// An interval of range, over which surface and sea floor are straight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Column {
    pub middle: f64,
    pub half_width: f64,
    /// Depth of the sea floor at the middle.
    pub floor: f64,
    /// Slope of the sea floor, dz/dx.
    pub slope: f64,
    /// First layer that reaches below the shallowest point of the sea floor.
    pub first_cut: usize,
    /// How a curvilinear sea floor turns, from the middle.
    pub floor_bend: Option<Bend>,
    /// The surface, if it is not the top of the first layer.
    pub roof: Option<Roof>,
}

/// The surface over a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Roof {
    /// Its depth at the middle.
    pub depth: f64,
    /// Its slope, dz/dx.
    pub slope: f64,
    /// Last layer that reaches above its deepest point.
    pub last_cut: usize,
    /// How a curvilinear surface turns, from the middle.
    pub bend: Option<Bend>,
}

/// An interval of depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Layer {
    pub middle: f64,
    pub half_height: f64,
}

/// 1/c² = `centre` + `bow` + 2 (`gradient`·d + `twist`·dx·dz) + `bend`·dz², d from the
/// middle of the cell: the section's, but for its third derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    /// Mean of the corners.
    pub centre: f64,
    pub gradient: Pair,
    pub twist: f64,
    pub bend: f64,
    /// How far the middle lies above the mean of the corners.
    pub bow: f64,
}

impl Cell {
    /// 1/c² at a point, from the middle of the cell.
    pub(crate) fn squared_slowness(&self, from_middle: Pair) -> f64 {
        let Pair { x, z } = from_middle;
        self.centre
            + self.bow
            + 2.0 * (self.gradient.dot(from_middle) + self.twist * x * z)
            + self.bend * z * z
    }

    /// G = ½∇(1/c²) at a point, from the middle of the cell.
    pub(crate) fn gradient_at(&self, from_middle: Pair) -> Pair {
        self.gradient + self.gradient_change(from_middle)
    }

    /// How much G differs between two points of the cell.
    pub(crate) fn gradient_change(&self, apart: Pair) -> Pair {
        Pair::new(self.twist * apart.z, self.twist * apart.x + self.bend * apart.z)
    }

    /// Whether G is the same everywhere.
    pub(crate) fn is_uniform(&self) -> bool {
        self.twist == 0.0 && self.bend == 0.0
    }
}

/// How closely a [`Medium`] follows its section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MediumLimits {
    /// Range of the medium's near end (behind the source), metres.
    pub near_m: f64,
    /// Range of its far end, metres.
    pub far_m: f64,
    /// Depth of its lower end, metres.
    pub deepest_m: f64,
    /// Widest column where the sound speed depends on range, metres.
    pub column_m: f64,
    /// Largest departure from the section's profiles, m/s.
    pub speed_tolerance_m_s: f64,
}

/// Columns of a range-dependent field are not divided into more cells than about this.
const MOST_CELLS: f64 = 4e6;

impl Medium {
    /// Cells of a section between two ranges.
    pub(crate) fn new(section: &Section, limits: &MediumLimits) -> Self {
        let levels = levels(section.sound_speed(), limits.speed_tolerance_m_s, limits.deepest_m);
        let layers: Vec<Layer> = levels
            .windows(2)
            .map(|pair| Layer {
                middle: 0.5 * (pair[0].depth + pair[1].depth),
                half_height: 0.5 * (pair[1].depth - pair[0].depth),
            })
            .collect();
        let least_column_m = (limits.far_m - limits.near_m) * layers.len() as f64 / MOST_CELLS;
        let nodes = range_nodes(section, limits, limits.column_m.max(least_column_m));
        let columns =
            nodes.windows(2).map(|pair| column(section, &layers, pair[0], pair[1])).collect();
        let cells = cells(section, &nodes, &levels, &layers);
        Self { columns, layers, cells }
    }

    pub(crate) fn cell(&self, column: usize, layer: usize) -> &Cell {
        &self.cells[column * self.layers.len() + layer]
    }

    /// The column and layer of a point, the nearest ones if it lies outside.
    pub(crate) fn locate(&self, point: Pair) -> (usize, usize) {
        let column = self.columns.partition_point(|c| c.middle + c.half_width <= point.x);
        let layer = self.layers.partition_point(|l| l.middle + l.half_height <= point.z);
        (column.min(self.columns.len() - 1), layer.min(self.layers.len() - 1))
    }

    /// A point relative to the middle of a cell.
    pub(crate) fn local(&self, column: usize, layer: usize, point: Pair) -> Pair {
        Pair::new(point.x - self.columns[column].middle, point.z - self.layers[layer].middle)
    }
}

/// Ends, nodes of surface and sea floor, sound-speed columns, and what divides wide
/// columns of a range-dependent field.
fn range_nodes(section: &Section, limits: &MediumLimits, column_m: f64) -> Vec<f64> {
    let field = section.sound_speed();
    let depends_on_range = field.range_m().len() > 1;
    let mut nodes = vec![limits.near_m, limits.far_m];
    let inside = |range: &f64| (limits.near_m..limits.far_m).contains(range);
    for interface in section.altimetry.iter().chain([section.bathymetry()]) {
        nodes.extend(interface.range_m().iter().copied().filter(inside));
    }
    if depends_on_range {
        nodes.extend(field.range_m().iter().copied().filter(inside));
    }
    nodes.sort_by(f64::total_cmp);
    // Nodes closer than a micrometre are one.
    nodes.dedup_by(|b, a| *b - *a < 1e-6);
    if !depends_on_range {
        return nodes;
    }
    let mut divided = vec![nodes[0]];
    for pair in nodes.windows(2) {
        let parts = ((pair[1] - pair[0]) / column_m).ceil().max(1.0) as usize;
        let part = |k: usize| pair[0] + (pair[1] - pair[0]) * k as f64 / parts as f64;
        divided.extend((1..parts).map(part));
        divided.push(pair[1]);
    }
    divided
}

/// The column between two ranges.
fn column(section: &Section, layers: &[Layer], x0: f64, x1: f64) -> Column {
    let middle = 0.5 * (x0 + x1);
    let floor = section.bathymetry();
    let (z0, z1) = (floor.depth_at_m(x0), floor.depth_at_m(x1));
    let shallowest = z0.min(z1);
    let roof = section.altimetry.as_ref().map(|surface| {
        let (z0, z1) = (surface.depth_at_m(x0), surface.depth_at_m(x1));
        let deepest = z0.max(z1);
        let reaching = layers.partition_point(|layer| layer.middle - layer.half_height <= deepest);
        Roof {
            depth: 0.5 * (z0 + z1),
            slope: (z1 - z0) / (x1 - x0),
            last_cut: reaching.saturating_sub(1),
            bend: surface.bend_at(middle),
        }
    });
    Column {
        middle,
        half_width: 0.5 * (x1 - x0),
        floor: 0.5 * (z0 + z1),
        slope: (z1 - z0) / (x1 - x0),
        first_cut: layers.partition_point(|layer| layer.middle + layer.half_height < shallowest),
        floor_bend: floor.bend_at(middle),
        roof,
    }
}

/// The cells between range nodes and levels, [column, layer].
fn cells(section: &Section, nodes: &[f64], levels: &[Level], layers: &[Layer]) -> Vec<Cell> {
    let field = section.sound_speed();
    let mut cells = Vec::with_capacity((nodes.len() - 1) * layers.len());
    let mut left = Side::new(field, levels, nodes[0]);
    for pair in nodes.windows(2) {
        let width = pair[1] - pair[0];
        let right = if field.range_m().len() > 1 {
            Side::new(field, levels, pair[1])
        } else {
            left.clone()
        };
        cells.extend(layers.iter().enumerate().map(|(j, layer)| {
            let height = 2.0 * layer.half_height;
            let [a, b] = [left.squared[j], left.squared[j + 1]];
            let [c, d] = [right.squared[j], right.squared[j + 1]];
            let bow = f64::midpoint(left.bow[j], right.bow[j]);
            Cell {
                centre: 0.25 * (a + b + c + d),
                gradient: Pair::new((c + d - a - b) / width, (b + d - a - c) / height) * 0.25,
                twist: 0.5 * (a + d - b - c) / (width * height),
                bend: -bow / (layer.half_height * layer.half_height),
                bow,
            }
        }));
        left = right;
    }
    cells
}

/// A range node: 1/c² at the levels, and how far it lies above linear half-way between.
#[derive(Clone)]
struct Side {
    squared: Vec<f64>,
    bow: Vec<f64>,
}

impl Side {
    fn new(field: &SoundSpeedField, levels: &[Level], range_m: f64) -> Self {
        let squared = squared_slowness(field, levels, range_m);
        let bow = if field.law() == ProfileLaw::LinearSquaredIndex {
            vec![0.0; levels.len() - 1]
        } else {
            let middles: Vec<Level> =
                levels.windows(2).map(|pair| pair[0].halfway(pair[1])).collect();
            squared_slowness(field, &middles, range_m)
                .iter()
                .zip(squared.windows(2))
                .map(|(middle, ends)| middle - f64::midpoint(ends[0], ends[1]))
                .collect()
        };
        Self { squared, bow }
    }
}
