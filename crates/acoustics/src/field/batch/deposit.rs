use super::lanes::{LANES, Lane, Lanes, Meeting, larger, smaller};
use super::tables::{REFERENCE_M_S, Tables};
use crate::field::range_profile::{FASTEST_M_S, REACH, WINDOW_STEPS};
use std::f64::consts::PI;

/// Reach in the quick test of a step: a tenth more than in deposits, because
/// slownesses stand for directions there.
const GENEROUS_REACH: f32 = 1.1 * REACH as f32;

/// Rays steeper than 84° may lose the rims of their beams.
const LEAST_FLATNESS: f32 = 0.1;

/// Sums of what passes the receivers' depth, as of
/// [`RangeProfiler`](crate::field::RangeProfiler).
pub(super) struct Deposits {
    depth: f32,
    step: f32,
    steps_per_metre: f32,
    window: f32,
    /// Least spread of a beam where sound is fastest.
    widest_least: f32,
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
        Self {
            depth: depth_m as f32,
            step: step_m as f32,
            steps_per_metre: step_m.recip() as f32,
            window: window as f32,
            widest_least: (PI * FASTEST_M_S / frequency_hz) as f32,
            wavelengths: (PI * REFERENCE_M_S / frequency_hz) as f32,
            growth: (0.2 * frequency_hz / REFERENCE_M_S) as f32,
            absorption: absorption_m as f32,
            sums: vec![0.0; count],
        }
    }

    /// Deposits what the rays bring between the beginning of a step and its end
    /// at `sigma`.
    pub(super) fn take_step(
        &mut self,
        lanes: &Lanes,
        tables: &Tables,
        gradient_x: &Lane,
        gradient_z: &Lane,
        sigma: &Lane,
    ) {
        let (mut distance, mut from) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            distance[i] = self.depth - tables.layers[lanes.layer[i] as usize].middle;
            from[i] = tables.columns[lanes.column[i] as usize].middle + lanes.local_x[i];
        }
        let mut near = [0u32; LANES];
        for i in 0..LANES {
            let (t, pz, gz) = (sigma[i], lanes.slowness_z[i], gradient_z[i]);
            let z = lanes.local_z[i];
            let end = z + t * (pz + 0.5 * t * gz);
            let turns = pz * (pz + t * gz) < 0.0;
            let vertex = if turns { z - 0.5 * pz * pz / gz } else { z };
            let (top, bottom) = (smaller(smaller(z, end), vertex), larger(larger(z, end), vertex));
            let away = larger(top - distance[i], distance[i] - bottom);
            let (px, gx) = (lanes.slowness_x[i], gradient_x[i]);
            let (px_end, pz_end) = (px + t * gx, pz + t * gz);
            let (ox, oz) = (lanes.offset_x[i], lanes.offset_z[i]);
            let ox_end = ox + t * lanes.offset_slowness_x[i];
            let oz_end = oz + t * lanes.offset_slowness_z[i];
            let start_width = (px * oz - pz * ox).abs();
            let end_width = (px_end * oz_end - pz_end * ox_end).abs();
            let width = larger(start_width, end_width) * lanes.beam_width[i];
            let steepest = larger(pz.abs(), pz_end.abs());
            let flattest = larger(smaller(px.abs(), px_end.abs()), LEAST_FLATNESS);
            let reach = GENEROUS_REACH * (self.widest_least + width + self.window * steepest);
            // Most steps are short and pass no sample.
            let to = from[i] + t * (px + 0.5 * t * gx);
            let passed = self.samples_before(from[i]) != self.samples_before(to);
            near[i] = u32::from(away * flattest <= reach) & u32::from(passed);
        }
        for i in 0..LANES {
            if near[i] != 0 && lanes.met[i] != Meeting::Idle {
                self.take_ray(lanes, i, tables, gradient_x[i], gradient_z[i], sigma[i]);
            }
        }
    }

    /// Samples between the source and a range.
    fn samples_before(&self, range: f32) -> i32 {
        // Behind the source, where there are none, rounding towards 0 does no harm.
        (range * self.steps_per_metre + 0.5) as i32
    }

    fn take_ray(
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
        let sample = |x: f32| self.samples_before(x).max(0) as usize;
        let (first, last) = (sample(start.min(end)), sample(start.max(end)).min(self.sums.len()));
        let middle = tables.layers[lanes.layer[i] as usize].middle;
        let below_start = self.depth - middle - lanes.local_z[i];
        for index in first..last {
            let distance = (index as f32 + 0.5) * self.step - start;
            let root = larger(px * px + 2.0 * gradient_x * distance, 0.0).sqrt();
            let t = smaller(larger(2.0 * distance / (px + root.copysign(px)), 0.0), sigma);
            let (sx, sz) = (px + t * gradient_x, pz + t * gradient_z);
            let speed = (sx * sx + sz * sz).sqrt().recip();
            let across = (below_start - t * (pz + 0.5 * t * gradient_z)) * sx * speed;
            let path = lanes.path[i] + t / speed;
            let offset_x = lanes.offset_x[i] + t * lanes.offset_slowness_x[i];
            let offset_z = lanes.offset_z[i] + t * lanes.offset_slowness_z[i];
            let width = (sx * offset_z - sz * offset_x) * speed * lanes.beam_width[i];
            let least = smaller(self.growth * path, self.wavelengths * speed);
            let spread = larger(width.abs(), least);
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
