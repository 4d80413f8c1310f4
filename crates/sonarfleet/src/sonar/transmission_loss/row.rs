use super::model::profile_by;
use super::quality::Numerics;
use super::settings::{LARGEST_LOSS_DB, LossTableSettings, TableModel};
use crate::grid::{CellId, Position, SurveillanceGrid};
use crate::sonar::section::Waters;
use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::environment::Section;
use sonarfleet_acoustics::field::{
    FanPart, LaunchFan, RangeProfile, Slice, Source, TraceSettings, batch_intensity,
};
use std::f64::consts::TAU;

/// A target cell is averaged over this many points a side.
const POINTS_A_SIDE: usize = 8;

/// How far behind a source rays are followed, metres: what slopes send back from farther
/// adds less than 0.01 dB.
const HEARD_BEHIND_M: f64 = 1000.0;

/// Widest column of water, metres; sound speed is linear in range over it.
const WIDEST_COLUMN_M: f64 = 3000.0;

/// By what fraction of a beam's width the fans of successive bearings are moved: what a
/// sparse fan does wrong at one bearing, its neighbours even out.
const SHIFTS: [f64; 4] = [-0.125, 0.375, -0.375, 0.125];

/// What is needed to compute the row of any source.
pub(super) struct RowComputer<'a> {
    waters: &'a Waters,
    grid: &'a SurveillanceGrid,
    settings: &'a LossTableSettings,
    numerics: &'a Numerics,
    classes: Vec<Class>,
}

/// Classes of beams that see the same waters.
struct Class {
    /// The fans of four successive bearings.
    fans: [LaunchFan; SHIFTS.len()],
    waters: Waters,
    speed_tolerance_m_s: f64,
}

/// What lies along a bearing.
struct Cut {
    /// As each class of beams sees it.
    sections: Vec<(Section, TraceSettings)>,
    /// Number of range samples.
    count: usize,
}

impl<'a> RowComputer<'a> {
    pub(super) fn new(
        waters: &'a Waters,
        grid: &'a SurveillanceGrid,
        settings: &'a LossTableSettings,
    ) -> Result<Self, AcousticsError> {
        let numerics = &settings.numerics;
        let mut classes: Vec<Class> = Vec::new();
        for (fan, class) in numerics.fans()?.iter().zip(&numerics.beam_classes) {
            let fans = SHIFTS.map(|shift| fan.shifted(shift));
            let speed_tolerance_m_s = class.speed_tolerance_m_s;
            match classes.last_mut() {
                Some(last) if last.speed_tolerance_m_s >= speed_tolerance_m_s => {
                    for (joined, fan) in last.fans.iter_mut().zip(&fans) {
                        *joined = joined.joined(fan);
                    }
                }
                _ => classes.push(Class {
                    fans,
                    waters: waters.simplified(speed_tolerance_m_s),
                    speed_tolerance_m_s,
                }),
            }
        }
        Ok(Self { waters, grid, settings, numerics, classes })
    }

    /// Losses from one cell to all, dB. A source in the ground is heard nowhere.
    pub(super) fn row(&self, source: CellId) -> Result<Vec<f32>, AcousticsError> {
        let centre = self.grid.centre(source);
        if self.waters.floor_m(centre) <= self.settings.fleet_depth_m {
            return Ok(vec![LARGEST_LOSS_DB; self.grid.cell_count()]);
        }
        let slices = self.slices(centre)?;
        let row = self
            .grid
            .cells()
            .map(|target| {
                let intensity = if target == source {
                    self.within_source_cell(&slices)
                } else {
                    self.over_target_cell(&slices, centre, target)
                };
                (-10.0 * intensity.log10()).min(f64::from(LARGEST_LOSS_DB)) as f32
            })
            .collect();
        Ok(row)
    }

    /// Samples of intensity along a bearing: to where the region or the water ends.
    fn sample_count(&self, centre: Position, bearing_rad: f64) -> usize {
        let reach_m = self.grid_reach_m(centre, bearing_rad).min(self.settings.maximum_range_m);
        let reach_m = reach_m.min(self.water_reach_m(centre, bearing_rad, reach_m));
        (reach_m / self.numerics.range_step_m).ceil() as usize
    }

    fn bearing_step_rad(&self) -> f64 {
        TAU / self.numerics.bearings as f64
    }

    /// Intensity along the slices of all bearings; nothing where a slice is too
    /// short to hold a sample.
    fn slices(&self, centre: Position) -> Result<Vec<RangeProfile>, AcousticsError> {
        match &self.settings.model {
            TableModel::Native => self.batch(centre),
            TableModel::Bellhop(program) => (0..self.numerics.bearings)
                .map(|index| {
                    let bearing_rad = index as f64 * self.bearing_step_rad();
                    let count = self.sample_count(centre, bearing_rad);
                    profile_by(program, self.waters, self.settings, centre, bearing_rad, count)
                })
                .collect(),
        }
    }

    /// Our own model traces all slices at once.
    fn batch(&self, centre: Position) -> Result<Vec<RangeProfile>, AcousticsError> {
        let cuts = (0..self.numerics.bearings)
            .map(|index| self.cut(centre, index as f64 * self.bearing_step_rad()))
            .collect::<Result<Vec<_>, _>>()?;
        let slices: Vec<Slice<'_>> = cuts
            .iter()
            .enumerate()
            .map(|(index, cut)| Slice {
                parts: cut
                    .sections
                    .iter()
                    .zip(&self.classes)
                    .map(|((section, settings), class)| FanPart {
                        section,
                        fan: &class.fans[index % SHIFTS.len()],
                        settings,
                    })
                    .collect(),
                count: cut.count,
            })
            .collect();
        let depth_m = self.settings.fleet_depth_m;
        let source = Source { depth_m, frequency_hz: self.settings.frequency_hz };
        batch_intensity(&slices, &source, depth_m, self.numerics.range_step_m)
    }

    /// The sections along a bearing, one for each class.
    fn cut(&self, centre: Position, bearing_rad: f64) -> Result<Cut, AcousticsError> {
        let count = self.sample_count(centre, bearing_rad);
        if count == 0 {
            return Ok(Cut { sections: Vec::new(), count });
        }
        let length_m = count as f64 * self.numerics.range_step_m;
        let sounding_m = self.numerics.sounding_m;
        let sections = self
            .classes
            .iter()
            .map(|class| {
                let section = class.waters.section(centre, bearing_rad, length_m, sounding_m)?;
                let settings = TraceSettings {
                    near_m: -HEARD_BEHIND_M,
                    column_m: WIDEST_COLUMN_M,
                    amplitude_cutoff: self.numerics.amplitude_cutoff,
                    speed_tolerance_m_s: class.speed_tolerance_m_s,
                    ..TraceSettings::to_range(length_m)
                };
                Ok((section, settings))
            })
            .collect::<Result<Vec<(Section, TraceSettings)>, AcousticsError>>()?;
        // Between soundings a slice's floor is straight: it can cut off a source close above
        // the ground, which is then heard nowhere along it.
        let in_ground = |(section, _): &(Section, TraceSettings)| {
            section.bathymetry().depth_at_m(0.0) < self.settings.fleet_depth_m
        };
        if sections.iter().any(in_ground) {
            return Ok(Cut { sections: Vec::new(), count: 0 });
        }
        Ok(Cut { sections, count })
    }

    /// Distance to the edge of the region along a bearing or along its
    /// neighbours, between which it is interpolated, whichever is longest.
    fn grid_reach_m(&self, centre: Position, bearing_rad: f64) -> f64 {
        let (width, height) = (self.grid.width_m(), self.grid.height_m());
        let step = self.bearing_step_rad();
        let along = |bearing: f64| {
            let (sine, cosine) = bearing.sin_cos();
            let until = |from: f64, speed: f64, length: f64| {
                if speed > 0.0 {
                    (length - from) / speed
                } else if speed < 0.0 {
                    -from / speed
                } else {
                    f64::INFINITY
                }
            };
            until(centre.east_m, sine, width).min(until(centre.north_m, cosine, height))
        };
        let mut reach =
            along(bearing_rad).max(along(bearing_rad - step)).max(along(bearing_rad + step));
        for (east, north) in [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)] {
            let (dx, dy) = (east - centre.east_m, north - centre.north_m);
            let turn = (dx.atan2(dy) - bearing_rad + 1.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
            if turn.abs() <= step {
                reach = reach.max(dx.hypot(dy));
            }
        }
        reach
    }

    /// Distance to where the ground comes up to the fleet's depth, if that is nearer than
    /// `longest_m`: land ends a slice.
    fn water_reach_m(&self, centre: Position, bearing_rad: f64, longest_m: f64) -> f64 {
        let (sine, cosine) = bearing_rad.sin_cos();
        let step = self.numerics.range_step_m;
        (1..=(longest_m / step) as usize)
            .map(|k| k as f64 * step)
            .find(|&range| {
                let point =
                    Position::new(centre.east_m + range * sine, centre.north_m + range * cosine);
                self.waters.floor_m(point) <= self.settings.fleet_depth_m
            })
            .unwrap_or(f64::INFINITY)
    }

    /// Mean intensity over a target cell.
    fn over_target_cell(&self, slices: &[RangeProfile], centre: Position, target: CellId) -> f64 {
        let middle = self.grid.centre(target);
        let offset = |index: usize| (index as f64 + 0.5) / POINTS_A_SIDE as f64 - 0.5;
        let mut sum = 0.0;
        for row in 0..POINTS_A_SIDE {
            for column in 0..POINTS_A_SIDE {
                let east = middle.east_m + offset(column) * self.grid.cell_width_m - centre.east_m;
                let north = middle.north_m + offset(row) * self.grid.cell_height_m - centre.north_m;
                sum += self.intensity_at(slices, east, north);
            }
        }
        sum / (POINTS_A_SIDE * POINTS_A_SIDE) as f64
    }

    /// Intensity at a point relative to the source, linear between bearings.
    fn intensity_at(&self, slices: &[RangeProfile], east_m: f64, north_m: f64) -> f64 {
        let range_m = east_m.hypot(north_m);
        if range_m > self.settings.maximum_range_m {
            return 0.0;
        }
        let turn = east_m.atan2(north_m) / TAU;
        let place = if turn < 0.0 { turn + 1.0 } else { turn } * self.numerics.bearings as f64;
        let before = place as usize;
        let weight = place - before as f64;
        let at = |index: usize| slices[index % slices.len()].intensity_at(range_m);
        (1.0 - weight) * at(before) + weight * at(before + 1)
    }

    /// Intensity half a cell away from the source, over all bearings.
    fn within_source_cell(&self, slices: &[RangeProfile]) -> f64 {
        let half_cell_m = 0.25 * (self.grid.cell_width_m + self.grid.cell_height_m);
        slices.iter().map(|slice| slice.intensity_at(half_cell_m)).sum::<f64>()
            / slices.len() as f64
    }
}
