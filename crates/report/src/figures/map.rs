//! Maps of the region: axes in kilometres, cells, sensors, bathymetry.

use crate::canvas::{Canvas, Frame, Point, Stroke};
use crate::colour::{INK, Rgb, WHITE};
use crate::contour::contour;
use crate::plot::{Axes, Scale};
use crate::ticks;
use sonarfleet::grid::{CellId, Position, SurveillanceGrid};
use sonarfleet::record::{LayoutsRecord, RunRecord};

pub(super) const M_PER_KM: f64 = 1000.0;
pub(super) const EAST: &str = "East (km)";
pub(super) const NORTH: &str = "North (km)";

/// What maps show of a region, whatever their fields.
#[derive(Clone, Copy)]
pub(super) struct Region<'a> {
    grid: SurveillanceGrid,
    blocked_cells: &'a [CellId],
    fixed_sensors: &'a [CellId],
    /// [row, column]; empty where it is not known.
    cell_depth_m: &'a [f32],
}

impl<'a> From<&'a RunRecord> for Region<'a> {
    fn from(record: &'a RunRecord) -> Self {
        Self {
            grid: record.grid,
            blocked_cells: &record.blocked_cells,
            fixed_sensors: &record.fixed_sensors,
            cell_depth_m: &record.cell_depth_m,
        }
    }
}

impl<'a> From<&'a LayoutsRecord> for Region<'a> {
    fn from(record: &'a LayoutsRecord) -> Self {
        Self {
            grid: record.grid,
            blocked_cells: &record.blocked_cells,
            fixed_sensors: &record.fixed_sensors,
            cell_depth_m: &[],
        }
    }
}

/// A map of the region and `margin_m` around it.
pub(super) struct Map<'a> {
    pub(super) axes: Axes,
    region: Region<'a>,
}

impl<'a> Map<'a> {
    /// The largest map of equal aspect in a box, at the box's top, centred across.
    pub(super) fn new(region: impl Into<Region<'a>>, margin_m: f64, room: Frame) -> Self {
        let region = region.into();
        let margin = margin_m / M_PER_KM;
        let width = region.grid.width_m() / M_PER_KM + 2.0 * margin;
        let height = region.grid.height_m() / M_PER_KM + 2.0 * margin;
        let scale = (room.width / width).min(room.height / height);
        let frame = Frame::new(
            room.x + (room.width - width * scale) / 2.0,
            room.y,
            width * scale,
            height * scale,
        );
        let axes = Axes { frame, x: [-margin, width - margin], y: [-margin, height - margin] };
        Self { axes, region }
    }

    /// Height of a map `width` points wide, at most `limit`.
    pub(super) fn height(
        region: impl Into<Region<'a>>,
        margin_m: f64,
        width: f64,
        limit: f64,
    ) -> f64 {
        let grid = region.into().grid;
        let (east, north) = (grid.width_m(), grid.height_m());
        (width * (north + 2.0 * margin_m) / (east + 2.0 * margin_m)).min(limit)
    }

    pub(super) fn at(&self, position: Position) -> Point {
        self.axes.at(position.east_m / M_PER_KM, position.north_m / M_PER_KM)
    }

    /// A field of the surveillance grid, [row, column].
    pub(super) fn field(&self, canvas: &mut Canvas, value: impl Fn(CellId) -> f64, scale: Scale) {
        let grid = self.region.grid;
        let edges = |count: usize, step: f64| -> Vec<f64> {
            (0..=count).map(|k| k as f64 * step / M_PER_KM).collect()
        };
        let (x, y) = (edges(grid.columns, grid.cell_width_m), edges(grid.rows, grid.cell_height_m));
        let cell = |column, row| value(CellId(row * grid.columns + column));
        self.axes.cells(canvas, [&x, &y], cell, scale);
    }

    /// Hatches the cells where no vehicle may be placed.
    pub(super) fn blocked(&self, canvas: &mut Canvas) {
        let grid = self.region.grid;
        for &cell in self.region.blocked_cells {
            let (column, row) = grid.column_row(cell);
            let span = |index: usize, step: f64| {
                [index as f64, index as f64 + 1.0].map(|k| k * step / M_PER_KM)
            };
            let (x, y) = (span(column, grid.cell_width_m), span(row, grid.cell_height_m));
            self.axes.hatched(canvas, x, y);
        }
    }

    /// White circles with dark rims at cells' centres; diamonds for fixed sensors.
    pub(super) fn sensors(&self, canvas: &mut Canvas, layout: &[CellId]) {
        for &cell in layout {
            ring(canvas, self.at(self.region.grid.centre(cell)), WHITE);
        }
        for &cell in self.region.fixed_sensors {
            diamond(canvas, self.at(self.region.grid.centre(cell)), 3.2, WHITE);
        }
    }

    /// Contours of the water depth through the cells' centres.
    pub(super) fn bathymetry(&self, canvas: &mut Canvas, stroke: Stroke) {
        let grid = self.region.grid;
        let depth = |column, row| f64::from(self.region.cell_depth_m[row * grid.columns + column]);
        for level in self.depth_levels() {
            for segment in contour(grid.columns, grid.rows, depth, level) {
                let points = segment.map(|[column, row]| {
                    self.at(Position::new(
                        (column + 0.5) * grid.cell_width_m,
                        (row + 0.5) * grid.cell_height_m,
                    ))
                });
                canvas.clipped_line(&points, self.axes.frame, stroke);
            }
        }
    }

    /// Depths of the contours, metres: round, about six.
    pub(super) fn depth_levels(&self) -> Vec<f64> {
        let depths = self.region.cell_depth_m.iter().map(|&depth| f64::from(depth));
        ticks::range(depths).map_or_else(Vec::new, |(low, high)| ticks::ticks(low, high, 6))
    }
}

/// A sensor: a circle of a colour between two dark ones, visible on any ground.
pub(super) fn ring(canvas: &mut Canvas, at: Point, colour: Rgb) {
    canvas.circle(at, 2.7, Stroke::new(INK, 1.9));
    canvas.circle(at, 2.7, Stroke::new(colour, 1.1));
}

/// A diamond with a dark rim.
pub(super) fn diamond(canvas: &mut Canvas, [x, y]: Point, radius: f64, fill: Rgb) {
    let corners = |r: f64| vec![[x, y - r], [x + r, y], [x, y + r], [x - r, y]];
    canvas.polygon(corners(radius + 0.7), INK);
    canvas.polygon(corners(radius - 0.3), fill);
}
