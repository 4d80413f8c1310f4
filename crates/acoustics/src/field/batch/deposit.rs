use super::lanes::{LANES, Lane, Lanes, Meeting};
use super::tables::{REFERENCE_M_S, Tables};
use crate::field::range_profile::{FASTEST_M_S, REACH, STEEPEST_SECANT, WINDOW_STEPS};
use std::f64::consts::PI;

/// Sums of what passes the receivers' depth, as of
/// [`RangeProfiler`](crate::field::RangeProfiler).
pub(super) struct Deposits {
    depth: f32,
    step: f32,
    steps_per_metre: f32,
    window: f32,
    least_reach: f32,
    /// π/f times the reference speed: least spread for c/c₀ = 1.
    wavelengths: f32,
    /// 0.2 f per metre of path.
    growth: f32,
    absorption: f32,
    pub sums: Vec<f64>,
}

impl Deposits {
    pub(super) fn new(
        frequency_hz: f64,
        absorption_m: f64,
        depth_m: f64,
        step_m: f64,
        count: usize,
    ) -> Self {
        let window = WINDOW_STEPS * step_m;
        let least_reach = REACH * STEEPEST_SECANT * (PI * FASTEST_M_S / frequency_hz + window);
        Self {
            depth: depth_m as f32,
            step: step_m as f32,
            steps_per_metre: step_m.recip() as f32,
            window: window as f32,
            least_reach: least_reach as f32,
            wavelengths: (PI * REFERENCE_M_S / frequency_hz) as f32,
            growth: (0.2 * frequency_hz / REFERENCE_M_S) as f32,
            absorption: absorption_m as f32,
            sums: vec![0.0; count],
        }
    }

    /// Deposits what the rays bring between the beginning of a step and its end
    /// at `sigma`.
    pub(super) fn from_step(
        &mut self,
        lanes: &Lanes,
        tables: &Tables,
        gradient_x: &Lane,
        gradient_z: &Lane,
        sigma: &Lane,
    ) {
        let mut distance = [0.0; LANES];
        for i in 0..LANES {
            distance[i] = self.depth - tables.layers[lanes.layer[i] as usize].middle;
        }
        let mut near = [false; LANES];
        for i in 0..LANES {
            let (t, pz, gz) = (sigma[i], lanes.slowness_z[i], gradient_z[i]);
            let z = lanes.local_z[i];
            let end = z + t * (pz + 0.5 * t * gz);
            let turns = pz * (pz + t * gz) < 0.0;
            let vertex = if turns { z - 0.5 * pz * pz / gz } else { z };
            let (top, bottom) = (z.min(end).min(vertex), z.max(end).max(vertex));
            let away = (top - distance[i]).max(distance[i] - bottom);
            let tube = (lanes.offset_x[i].abs() + lanes.offset_z[i].abs()).max(
                (lanes.offset_x[i] + t * lanes.offset_slowness_x[i]).abs()
                    + (lanes.offset_z[i] + t * lanes.offset_slowness_z[i]).abs(),
            );
            let reach = REACH as f32 * STEEPEST_SECANT as f32 * tube * lanes.beam_width[i];
            near[i] = away <= self.least_reach + reach;
        }
        for i in 0..LANES {
            if near[i] && lanes.met[i] != Meeting::Idle {
                self.from_ray(lanes, i, tables, gradient_x[i], gradient_z[i], sigma[i]);
            }
        }
    }

    fn from_ray(
        &mut self,
        lanes: &Lanes,
        i: usize,
        tables: &Tables,
        gradient_x: f32,
        gradient_z: f32,
        sigma: f32,
    ) {
        let (px, pz) = (lanes.slowness_x[i], lanes.slowness_z[i]);
        let start = tables.columns[lanes.column[i] as usize].middle + lanes.local_x[i];
        let end = start + sigma * (px + 0.5 * sigma * gradient_x);
        let sample = |x: f32| (x * self.steps_per_metre + 0.5).max(0.0) as usize;
        let (first, last) = (sample(start.min(end)), sample(start.max(end)).min(self.sums.len()));
        let middle = tables.layers[lanes.layer[i] as usize].middle;
        let below_start = self.depth - middle - lanes.local_z[i];
        for index in first..last {
            let distance = (index as f32 + 0.5) * self.step - start;
            let root = (px * px + 2.0 * gradient_x * distance).max(0.0).sqrt();
            let t = (2.0 * distance / (px + root.copysign(px))).clamp(0.0, sigma);
            let (sx, sz) = (px + t * gradient_x, pz + t * gradient_z);
            let speed = (sx * sx + sz * sz).sqrt().recip();
            let across = (below_start - t * (pz + 0.5 * t * gradient_z)) * sx * speed;
            let path = lanes.path[i] + t / speed;
            let offset_x = lanes.offset_x[i] + t * lanes.offset_slowness_x[i];
            let offset_z = lanes.offset_z[i] + t * lanes.offset_slowness_z[i];
            let width = (sx * offset_z - sz * offset_x) * speed * lanes.beam_width[i];
            let least = (self.growth * path).min(self.wavelengths * speed);
            let spread = width.abs().max(least);
            let smear = self.window * sz * speed;
            let variance = spread * spread + smear * smear;
            let exponent = across * across / variance;
            if exponent < (REACH * REACH) as f32 {
                let decay = (-0.5 * exponent - self.absorption * path).exp();
                let strength =
                    lanes.beam_weight[i] * speed * lanes.energy[i] * REFERENCE_M_S as f32;
                self.sums[index] += f64::from(strength / variance.sqrt() * decay);
            }
        }
    }
}
