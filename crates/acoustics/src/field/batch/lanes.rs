use super::tables::{Bounds, Start, Tables};
use crate::field::Beam;

/// Rays that are advanced together.
pub(super) const LANES: usize = 64;

/// One number of every ray.
pub(super) type Lane = [f32; LANES];

/// The rays, a structure of arrays. Units are those of [`Tables`].
pub(super) struct Lanes {
    /// From the middle of the cell.
    pub local_x: Lane,
    pub local_z: Lane,
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
    /// Δα, and cos α Δα/(c₀ √(2π)).
    pub beam_width: Lane,
    pub beam_weight: Lane,
    pub column: [u32; LANES],
    pub layer: [u32; LANES],
    pub bounds: [Bounds; LANES],
    /// What the last step met.
    pub met: [Meeting; LANES],
}

/// The larger of two numbers. Unlike [`f32::max`] it need not care for NaN, and
/// is one vector instruction.
pub(super) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of two numbers.
pub(super) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// What a ray meets at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Meeting {
    /// The lane is empty.
    #[default]
    Idle,
    NodeBehind,
    NodeAhead,
    LevelAbove,
    LevelBelow,
    Floor,
}

impl Default for Lanes {
    fn default() -> Self {
        let zero = [0.0; LANES];
        Self {
            local_x: zero,
            local_z: zero,
            slowness_x: [1.0; LANES],
            slowness_z: [1.0; LANES],
            defect: zero,
            offset_x: zero,
            offset_z: zero,
            offset_slowness_x: zero,
            offset_slowness_z: zero,
            path: zero,
            energy: zero,
            least_energy: zero,
            beam_width: zero,
            beam_weight: zero,
            column: [0; LANES],
            layer: [0; LANES],
            bounds: [Bounds::default(); LANES],
            met: [Meeting::Idle; LANES],
        }
    }
}

impl Lanes {
    /// Whether no ray is left.
    pub(super) fn idle(&self) -> bool {
        self.met.iter().all(|met| *met == Meeting::Idle)
    }

    /// Puts the next ray, if there is one, into a lane.
    pub(super) fn refill(
        &mut self,
        lane: usize,
        tables: &Tables,
        next: Option<(Start, Beam, f64)>,
    ) {
        let Some((start, beam, weight)) = next else {
            self.met[lane] = Meeting::Idle;
            // An empty lane goes through the motions in the first cell.
            (self.column[lane], self.layer[lane]) = (0, 0);
            (self.local_x[lane], self.local_z[lane]) = (0.0, 0.0);
            (self.slowness_x[lane], self.slowness_z[lane]) = (1.0, 1.0);
            (self.energy[lane], self.beam_weight[lane]) = (0.0, 0.0);
            return;
        };
        debug_assert!((start.layer as usize) < tables.layers.len());
        let (sine, cosine) = beam.angle_rad.sin_cos();
        let index = start.squared_index.sqrt();
        let slowness_x = cosine * index;
        self.local_x[lane] = start.local_x as f32;
        self.local_z[lane] = start.local_z as f32;
        self.slowness_x[lane] = slowness_x as f32;
        self.slowness_z[lane] = (sine * index) as f32;
        self.defect[lane] = (1.0 - slowness_x * slowness_x) as f32;
        self.offset_x[lane] = 0.0;
        self.offset_z[lane] = 0.0;
        self.offset_slowness_x[lane] = (-sine * index) as f32;
        self.offset_slowness_z[lane] = (cosine * index) as f32;
        self.path[lane] = 0.0;
        self.energy[lane] = 1.0;
        self.least_energy[lane] = (start.cutoff * start.cutoff).max(1e-10) as f32;
        self.beam_width[lane] = beam.width_rad as f32;
        self.beam_weight[lane] = weight as f32;
        self.column[lane] = start.column;
        self.layer[lane] = start.layer;
        self.bounds[lane] = start.bounds;
        // Anything but idle: the first step tells what is met.
        self.met[lane] = Meeting::Floor;
    }
}
