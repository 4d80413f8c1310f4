//! From the ocean to what sound meets: the waters around a region on a local
//! grid, and vertical sections cut out of them along any bearing.

use crate::fingerprint::Fingerprint;
use crate::grid::Position;
use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::environment::{
    Boundary, Interface, ProfileLaw, Section, SoundSpeedField,
};
use sonarfleet_acoustics::seawater::{Absorption, SoundSpeedEquation};
use sonarfleet_ocean::{Bathymetry, LocalFrame, OceanState, Region};

/// Largest distance between columns of sound speed, metres.
const COLUMN_SPACING_M: f64 = 1000.0;

/// Distance between soundings of the sea floor, metres: half of GEBCO's.
const FLOOR_SPACING_M: f64 = 225.0;

/// The sea floor is nowhere taken shallower than this, metres: on land a sliver
/// of water is left, in which sound dies.
const SHALLOWEST_M: f64 = 1.0;

/// Absorption of sound by the water.
const ABSORPTION: Absorption = Absorption::Thorp;

/// How far behind a source the sea is known, metres: slopes send sound back.
pub const BEHIND_M: f64 = 3000.0;

/// Why no waters could be cut out of an ocean state.
#[derive(Debug, thiserror::Error)]
pub enum WatersError {
    /// The ocean state has no temperature and salinity anywhere around the region.
    #[error("the ocean state at {time} holds no water around the region: no sound speed")]
    NoWater {
        /// Time of the state.
        time: String,
    },
    /// The bathymetry has no value at a point around the region.
    #[error("the bathymetry has no depth at {longitude_deg:.4}° E, {latitude_deg:.4}° N")]
    NoDepth {
        /// Longitude of the point, degrees east.
        longitude_deg: f64,
        /// Latitude of the point, degrees north.
        latitude_deg: f64,
    },
}

/// Regular grid of points in the local frame.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lattice {
    /// Coordinate of the first column and row, metres.
    origin_m: f64,
    east_step_m: f64,
    north_step_m: f64,
    columns: usize,
    rows: usize,
}

/// Where a point lies in a lattice: its four nodes with their weights.
type Corners = [(usize, f64); 4];

impl Lattice {
    /// Covers the region and a margin around it with steps no longer than
    /// `step_m`.
    fn around(frame: &LocalFrame, margin_m: f64, step_m: f64) -> Self {
        let steps = |length_m: f64| ((length_m + 2.0 * margin_m) / step_m).ceil().max(1.0);
        let (east, north) = (steps(frame.width_m()), steps(frame.height_m()));
        Self {
            origin_m: -margin_m,
            east_step_m: (frame.width_m() + 2.0 * margin_m) / east,
            north_step_m: (frame.height_m() + 2.0 * margin_m) / north,
            columns: east as usize + 1,
            rows: north as usize + 1,
        }
    }

    /// All points, row by row from the south-west.
    fn points(self) -> impl Iterator<Item = Position> {
        (0..self.rows * self.columns).map(move |node| {
            let (row, column) = (node / self.columns, node % self.columns);
            Position::new(
                self.origin_m + column as f64 * self.east_step_m,
                self.origin_m + row as f64 * self.north_step_m,
            )
        })
    }

    /// Bilinear weights of a point; beyond the lattice those of its edge.
    fn corners(self, point: Position) -> Corners {
        let place = |coordinate: f64, step: f64, count: usize| {
            let place = ((coordinate - self.origin_m) / step).clamp(0.0, (count - 1) as f64);
            let lower = (place as usize).min(count - 2);
            (lower, place - lower as f64)
        };
        let (column, east) = place(point.east_m, self.east_step_m, self.columns);
        let (row, north) = place(point.north_m, self.north_step_m, self.rows);
        let node = row * self.columns + column;
        [
            (node, (1.0 - east) * (1.0 - north)),
            (node + 1, east * (1.0 - north)),
            (node + self.columns, (1.0 - east) * north),
            (node + self.columns + 1, east * north),
        ]
    }
}

/// The waters of a region and a margin of [`BEHIND_M`] around it at one time, as
/// sound meets them.
#[derive(Debug, Clone)]
pub struct Waters {
    columns: Lattice,
    /// Levels, metres, from the surface to below the deepest floor.
    level_m: Vec<f64>,
    /// [row, column, level], m/s.
    speed_m_s: Vec<f64>,
    soundings: Lattice,
    /// [row, column], metres.
    floor_m: Vec<f64>,
    bottom: Boundary,
}

impl Waters {
    /// Sound speeds of an ocean state on columns at most 1 km apart, over a sea
    /// floor of one kind. Where data end, or on land, the nearest water is taken
    /// to go on.
    ///
    /// # Errors
    /// If the state has no water, or the bathymetry a gap, around the region.
    pub fn new(
        state: &OceanState,
        bathymetry: &Bathymetry,
        frame: &LocalFrame,
        equation: SoundSpeedEquation,
        bottom: Boundary,
    ) -> Result<Self, WatersError> {
        let soundings = Lattice::around(frame, BEHIND_M, FLOOR_SPACING_M);
        let known = bathymetry.span();
        let mut floor_m = Vec::with_capacity(soundings.rows * soundings.columns);
        for point in soundings.points() {
            let (longitude_deg, latitude_deg) = within(known, frame, point);
            let depth = bathymetry.depth_m(longitude_deg, latitude_deg);
            let depth = depth.ok_or(WatersError::NoDepth { longitude_deg, latitude_deg })?;
            floor_m.push(depth.max(SHALLOWEST_M));
        }
        let deepest_m = floor_m.iter().copied().fold(SHALLOWEST_M, f64::max);

        let columns = Lattice::around(frame, BEHIND_M, COLUMN_SPACING_M);
        let level_m = levels(&state.grid.depth_m, deepest_m);
        let known = state.grid.span();
        let mut profiles: Vec<Option<Vec<f64>>> = columns
            .points()
            .map(|point| {
                let (longitude_deg, latitude_deg) = within(known, frame, point);
                profile(state, longitude_deg, latitude_deg, &level_m, equation)
            })
            .collect();
        fill_dry(&mut profiles, columns);
        let speed_m_s: Vec<f64> = profiles.into_iter().flatten().flatten().collect();
        if speed_m_s.is_empty() {
            return Err(WatersError::NoWater { time: state.time.to_string() });
        }
        Ok(Self { columns, level_m, speed_m_s, soundings, floor_m, bottom })
    }

    /// The same waters on as few levels as keep every profile, linear between
    /// levels, within a tolerance in m/s.
    #[must_use]
    pub fn simplified(&self, tolerance_m_s: f64) -> Self {
        let kept = levels_within(&self.level_m, &self.speed_m_s, tolerance_m_s);
        let pick = |profile: &[f64]| -> Vec<f64> { kept.iter().map(|&k| profile[k]).collect() };
        Self {
            level_m: pick(&self.level_m),
            speed_m_s: self.speed_m_s.chunks_exact(self.level_m.len()).flat_map(pick).collect(),
            columns: self.columns,
            soundings: self.soundings,
            floor_m: self.floor_m.clone(),
            bottom: self.bottom.clone(),
        }
    }

    /// Adds to a fingerprint everything that decides what sound meets.
    pub(super) fn add_to(&self, fingerprint: Fingerprint) -> Fingerprint {
        let Self { columns, level_m, speed_m_s, soundings, floor_m, bottom } = self;
        fingerprint
            .text(&format!("{columns:?} {soundings:?} {BEHIND_M} {COLUMN_SPACING_M}"))
            .numbers(level_m)
            .numbers(speed_m_s)
            .numbers(floor_m)
            .text(&format!("{bottom:?} {ABSORPTION:?}"))
    }

    /// Depth of the sea floor at a point, metres.
    pub fn floor_m(&self, point: Position) -> f64 {
        self.soundings.corners(point).iter().map(|&(node, w)| w * self.floor_m[node]).sum()
    }

    /// The section from a point along a bearing, in radians clockwise from north,
    /// from [`BEHIND_M`] behind the point to `length_m` ahead, with a sounding
    /// every `sounding_m`.
    ///
    /// # Errors
    /// Those of the section; none is expected of waters and positive lengths.
    pub fn section(
        &self,
        from: Position,
        bearing_rad: f64,
        length_m: f64,
        sounding_m: f64,
    ) -> Result<Section, AcousticsError> {
        let (sine, cosine) = bearing_rad.sin_cos();
        let at =
            |range: f64| Position::new(from.east_m + range * sine, from.north_m + range * cosine);
        let nodes = |step_m: f64| -> Vec<f64> {
            let count = ((BEHIND_M + length_m) / step_m).ceil().max(1.0) as usize;
            let step = (BEHIND_M + length_m) / count as f64;
            (0..=count).map(|k| k as f64 * step - BEHIND_M).collect()
        };

        let range_m = nodes(COLUMN_SPACING_M);
        let levels = self.level_m.len();
        let mut speed_m_s = Vec::with_capacity(range_m.len() * levels);
        for &range in &range_m {
            let corners = self.columns.corners(at(range));
            let column = |node: usize| &self.speed_m_s[node * levels..(node + 1) * levels];
            let [(a, wa), (b, wb), (c, wc), (d, wd)] = corners;
            let (a, b, c, d) = (column(a), column(b), column(c), column(d));
            speed_m_s.extend((0..levels).map(|k| wa * a[k] + wb * b[k] + wc * c[k] + wd * d[k]));
        }
        let sound_speed = SoundSpeedField::new(
            range_m,
            self.level_m.clone(),
            speed_m_s,
            ProfileLaw::LinearSpeed,
        )?;

        let range_m = nodes(sounding_m);
        let depth_m = range_m.iter().map(|&range| self.floor_m(at(range))).collect();
        let floor = Interface::new(range_m, depth_m)?;
        let mut section = Section::new(sound_speed, floor, self.bottom.clone())?;
        section.absorption = ABSORPTION;
        Ok(section)
    }
}

/// Longitude and latitude of a point, or of the nearest point at which data are
/// known.
fn within(known: Region, frame: &LocalFrame, point: Position) -> (f64, f64) {
    let (mut longitude, latitude) = frame.to_geographic(point.east_m, point.north_m);
    // Grids across the antimeridian go on beyond 180°.
    if longitude < known.west_deg && longitude + 360.0 <= known.east_deg {
        longitude += 360.0;
    }
    (
        longitude.clamp(known.west_deg, known.east_deg),
        latitude.clamp(known.south_deg, known.north_deg),
    )
}

/// The surface, the ocean's levels down to the first below the floor, and one
/// below the floor if they end above it.
fn levels(ocean_m: &[f64], deepest_m: f64) -> Vec<f64> {
    let lowest_m = deepest_m + 1.0;
    let mut level_m = vec![0.0];
    level_m.extend(ocean_m.iter().copied().filter(|&level| level > 0.0 && level < lowest_m));
    level_m.push(lowest_m);
    level_m
}

/// Sound speed of the ocean's column at the levels; temperature and salinity are
/// linear between the ocean's levels and constant beyond them.
fn profile(
    state: &OceanState,
    longitude_deg: f64,
    latitude_deg: f64,
    level_m: &[f64],
    equation: SoundSpeedEquation,
) -> Option<Vec<f64>> {
    let column = state.column(longitude_deg, latitude_deg)?;
    let speed = |&depth: &f64| {
        let below = column.depth_m.partition_point(|&level| level <= depth);
        let upper = below.saturating_sub(1);
        let lower = below.min(column.depth_m.len() - 1);
        let thickness = column.depth_m[lower] - column.depth_m[upper];
        let weight =
            if thickness > 0.0 { (depth - column.depth_m[upper]) / thickness } else { 0.0 };
        let at = |values: &[f64]| values[upper] + weight * (values[lower] - values[upper]);
        let (temperature, salinity) = (at(&column.temperature_c), at(&column.salinity_psu));
        equation.speed_m_s(temperature, salinity, depth, latitude_deg)
    };
    let speeds: Vec<f64> = level_m.iter().map(speed).collect();
    speeds.iter().all(|speed| speed.is_finite()).then_some(speeds)
}

/// Gives every dry column the profile of the nearest wet one (in lattice steps,
/// the first in row order among equals).
fn fill_dry(profiles: &mut [Option<Vec<f64>>], lattice: Lattice) {
    let wet: Vec<usize> = (0..profiles.len()).filter(|&node| profiles[node].is_some()).collect();
    for node in 0..profiles.len() {
        if profiles[node].is_some() {
            continue;
        }
        let distance = |other: &&usize| {
            let rows = (node / lattice.columns).abs_diff(**other / lattice.columns);
            let columns = (node % lattice.columns).abs_diff(**other % lattice.columns);
            rows * rows + columns * columns
        };
        if let Some(&nearest) = wet.iter().min_by_key(distance) {
            let repeated = profiles[nearest].clone();
            profiles[node] = repeated;
        }
    }
}

/// Indices of the levels to keep so that no profile departs by more than the
/// tolerance from straight lines between them (Douglas & Peucker 1973,
/// doi:10.3138/FM57-6770-U75U-7727, over all profiles at once).
fn levels_within(level_m: &[f64], speed_m_s: &[f64], tolerance_m_s: f64) -> Vec<usize> {
    let mut kept = vec![0];
    let mut pending = vec![(0, level_m.len() - 1)];
    while let Some((upper, lower)) = pending.pop() {
        let departure = |k: usize| {
            let weight = (level_m[k] - level_m[upper]) / (level_m[lower] - level_m[upper]);
            speed_m_s
                .chunks_exact(level_m.len())
                .map(|c| (c[upper] + weight * (c[lower] - c[upper]) - c[k]).abs())
                .fold(0.0, f64::max)
        };
        let worst = (upper + 1..lower)
            .map(|k| (k, departure(k)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .filter(|&(_, departure)| departure > tolerance_m_s);
        match worst {
            Some((k, _)) => {
                pending.push((k, lower));
                pending.push((upper, k));
            }
            None => kept.push(lower),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use sonarfleet_acoustics::environment::Seabed;
    use sonarfleet_ocean::synthetic::SyntheticOcean;

    fn waters() -> (Waters, OceanState, Bathymetry, LocalFrame) {
        let ocean = SyntheticOcean { states: 1, ..SyntheticOcean::default() };
        let state = ocean.forecast().states.remove(0);
        let bathymetry = ocean.bathymetry();
        let frame = LocalFrame::new(ocean.region);
        let bottom = Boundary::Fluid(Seabed::Mud.half_space());
        let equation = SoundSpeedEquation::Mackenzie;
        let waters = Waters::new(&state, &bathymetry, &frame, equation, bottom).unwrap();
        (waters, state, bathymetry, frame)
    }

    #[test]
    fn a_section_holds_the_oceans_sound_speed_and_floor() {
        let (waters, state, bathymetry, frame) = waters();
        let from = Position::new(9_000.0, 14_000.0);
        let bearing = 0.7f64;
        let section = waters.section(from, bearing, 12_000.0, 250.0).unwrap();
        for range in [-2000.0, 0.0, 5_300.0, 11_000.0] {
            let east = from.east_m + range * bearing.sin();
            let north = from.north_m + range * bearing.cos();
            let (longitude, latitude) = frame.to_geographic(east, north);
            let column = state.column(longitude, latitude).unwrap();
            for depth in [0.494_025_f64, 109.729_3, 318.127_4] {
                let level = column.depth_m.iter().position(|z| (z - depth).abs() < 0.01).unwrap();
                let depth = column.depth_m[level];
                let expected = SoundSpeedEquation::Mackenzie.speed_m_s(
                    column.temperature_c[level],
                    column.salinity_psu[level],
                    depth,
                    latitude,
                );
                let found = section.sound_speed().speed_at_m_s(range, depth);
                assert!((found - expected).abs() < 0.3, "{range} {depth}: {found} {expected}");
            }
            let floor = bathymetry.depth_m(longitude, latitude).unwrap();
            let found = section.bathymetry().depth_at_m(range);
            assert!((found - floor).abs() < 10.0, "{range}: {found} {floor}");
        }
    }

    #[test]
    fn simplified_profiles_stay_within_their_tolerance() {
        let (waters, ..) = waters();
        let simple = waters.simplified(0.2);
        assert!(simple.level_m.len() < waters.level_m.len());
        let from = Position::new(5_000.0, 5_000.0);
        let [full, few] = [&waters, &simple].map(|w| w.section(from, 1.0, 8_000.0, 500.0).unwrap());
        for depth in (0..1500).step_by(10).map(f64::from) {
            let [a, b] = [&full, &few].map(|s| s.sound_speed().speed_at_m_s(3_000.0, depth));
            assert!((a - b).abs() < 0.2 + 1e-9, "{depth}: {a} {b}");
        }
    }
}
