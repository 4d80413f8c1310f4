use super::segment::Pair;
use crate::environment::{ProfileLaw, Section};

/// A section made ready for rays: cells between range nodes and depth levels,
/// with 1/c² bilinear in each.
#[derive(Debug, Clone, Default)]
pub(crate) struct Medium {
    pub columns: Vec<Column>,
    pub layers: Vec<Layer>,
    /// [column, layer]
    pub cells: Vec<Cell>,
}

/// An interval of range, over which the sea floor is straight.
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
}

/// An interval of depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Layer {
    pub middle: f64,
    pub half_height: f64,
}

/// 1/c² = `centre` + 2 (`gradient`·d + `twist`·dx·dz), d from the middle of
/// the cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    pub centre: f64,
    pub gradient: Pair,
    pub twist: f64,
}

impl Cell {
    /// 1/c² at a point, from the middle of the cell.
    pub(crate) fn squared_slowness(&self, from_middle: Pair) -> f64 {
        self.centre
            + 2.0 * (self.gradient.dot(from_middle) + self.twist * from_middle.x * from_middle.z)
    }

    /// G = ½∇(1/c²) at a point, from the middle of the cell.
    pub(crate) fn gradient_at(&self, from_middle: Pair) -> Pair {
        self.gradient + self.gradient_change(from_middle)
    }

    /// How much G differs between two points of the cell.
    pub(crate) fn gradient_change(&self, apart: Pair) -> Pair {
        Pair::new(apart.z, apart.x) * self.twist
    }
}

/// How closely a [`Medium`] follows its section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MediumLimits {
    /// Range of the medium's near end (behind the source), metres.
    pub near_m: f64,
    /// Range of its far end, metres.
    pub far_m: f64,
    /// Widest column where the sound speed depends on range, metres.
    pub column_m: f64,
    /// Largest departure from a profile that is linear in speed, m/s.
    pub speed_tolerance_m_s: f64,
}

impl Medium {
    /// Cells of a section between two ranges.
    pub(crate) fn new(section: &Section, limits: &MediumLimits) -> Self {
        let nodes = range_nodes(section, limits);
        let field = section.sound_speed();
        let levels = refined_levels(section, limits.speed_tolerance_m_s);
        let layers: Vec<Layer> = levels
            .windows(2)
            .map(|pair| Layer {
                middle: 0.5 * (pair[0].depth + pair[1].depth),
                half_height: 0.5 * (pair[1].depth - pair[0].depth),
            })
            .collect();

        let mut columns = Vec::with_capacity(nodes.len() - 1);
        let mut cells = Vec::with_capacity((nodes.len() - 1) * layers.len());
        let mut profile = Vec::new();
        let mut left = Vec::new();
        let mut right = Vec::new();
        squared_slowness(section, &levels, nodes[0], &mut profile, &mut left);
        for pair in nodes.windows(2) {
            let (x0, x1) = (pair[0], pair[1]);
            if field.range_m().len() > 1 {
                squared_slowness(section, &levels, x1, &mut profile, &mut right);
            } else {
                right.clone_from(&left);
            }
            let (z0, z1) =
                (section.bathymetry().depth_at_m(x0), section.bathymetry().depth_at_m(x1));
            let shallowest = z0.min(z1);
            columns.push(Column {
                middle: 0.5 * (x0 + x1),
                half_width: 0.5 * (x1 - x0),
                floor: 0.5 * (z0 + z1),
                slope: (z1 - z0) / (x1 - x0),
                first_cut: layers
                    .partition_point(|layer| layer.middle + layer.half_height < shallowest),
            });
            for (j, layer) in layers.iter().enumerate() {
                let (width, height) = (x1 - x0, 2.0 * layer.half_height);
                let [a, b, c, d] = [left[j], left[j + 1], right[j], right[j + 1]];
                let centre = 0.25 * (a + b + c + d);
                let gradient = Pair::new((c + d - a - b) / width, (b + d - a - c) / height) * 0.25;
                let twist = 0.5 * (a + d - b - c) / (width * height);
                cells.push(Cell { centre, gradient, twist });
            }
            std::mem::swap(&mut left, &mut right);
        }
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

/// A level of the medium: its depth, and where it lies between two levels of the
/// section's profile.
struct Level {
    depth: f64,
    above: usize,
    fraction: f64,
}

/// Ends, bathymetry nodes, sound-speed columns, and what divides wide columns
/// of a range-dependent field.
fn range_nodes(section: &Section, limits: &MediumLimits) -> Vec<f64> {
    let field = section.sound_speed();
    let depends_on_range = field.range_m().len() > 1;
    let mut nodes = vec![limits.near_m, limits.far_m];
    let inside = |range: &f64| (limits.near_m..limits.far_m).contains(range);
    nodes.extend(section.bathymetry().range_m().iter().copied().filter(inside));
    if depends_on_range {
        nodes.extend(field.range_m().iter().copied().filter(inside));
    }
    nodes.sort_by(f64::total_cmp);
    // Nodes closer than a millimetre are one.
    nodes.dedup_by(|b, a| *b - *a < 1e-3);
    if !depends_on_range {
        return nodes;
    }
    let mut divided = vec![nodes[0]];
    for pair in nodes.windows(2) {
        let parts = ((pair[1] - pair[0]) / limits.column_m).ceil().max(1.0) as usize;
        let part = |k: usize| pair[0] + (pair[1] - pair[0]) * k as f64 / parts as f64;
        divided.extend((1..parts).map(part));
        divided.push(pair[1]);
    }
    divided
}

/// The section's levels, and what divides layers in which linear 1/c² would
/// depart from linear c by more than the tolerance: the sagitta is 3(Δc)²/8c.
fn refined_levels(section: &Section, tolerance: f64) -> Vec<Level> {
    let field = section.sound_speed();
    let depth = field.depth_m();
    let mut levels = vec![Level { depth: depth[0], above: 0, fraction: 0.0 }];
    for above in 0..depth.len() - 1 {
        let parts = match field.law() {
            ProfileLaw::LinearSquaredIndex => 1,
            ProfileLaw::LinearSpeed => field
                .speed_m_s()
                .chunks_exact(depth.len())
                .map(|profile| {
                    let (upper, lower) = (profile[above], profile[above + 1]);
                    let largest_step = (8.0 / 3.0 * tolerance * upper).sqrt();
                    ((lower - upper).abs() / largest_step).ceil().max(1.0) as usize
                })
                .max()
                .unwrap_or(1),
        };
        for part in 1..=parts {
            let fraction = part as f64 / parts as f64;
            let step = depth[above + 1] - depth[above];
            levels.push(Level { depth: depth[above] + fraction * step, above, fraction });
        }
    }
    levels
}

/// 1/c² at the levels of the medium at one range, written to `squared`.
fn squared_slowness(
    section: &Section,
    levels: &[Level],
    range_m: f64,
    profile: &mut Vec<f64>,
    squared: &mut Vec<f64>,
) {
    let field = section.sound_speed();
    field.profile_at(range_m, profile);
    squared.clear();
    squared.extend(levels.iter().map(|level| {
        let (upper, lower) = (profile[level.above], profile[level.above + 1]);
        field.law().between(upper, lower, level.fraction).powi(-2)
    }));
}
