use super::exponential::exponential;
use super::lanes::{LANES, Lane, Lanes, larger, nearest, smaller};
use super::step::Step;
use super::tables::REFERENCE_M_S;
use crate::field::range_profile::{FASTEST_M_S, REACH, WINDOW_STEPS};
use std::f64::consts::PI;

/// Reach in the quick test of a step: a tenth more than in deposits, because
/// slownesses stand for directions there.
const GENEROUS_REACH: f32 = 1.1 * REACH as f32;

/// Rays steeper than 84° may lose the rims of their beams.
const LEAST_FLATNESS: f32 = 0.1;

/// Steps that descend by less are taken as level, metres.
const LEAST_DESCENT_M: f32 = 1e-3;

/// Passages that are evaluated together.
const PASSAGES: usize = 128;

/// Rays that pass a range sample near the receivers' depth: a structure of arrays
/// of what their deposits depend on.
#[repr(align(64))]
struct Passages {
    slowness_x: [f32; PASSAGES],
    slowness_z: [f32; PASSAGES],
    gradient_x: [f32; PASSAGES],
    gradient_z: [f32; PASSAGES],
    offset_x: [f32; PASSAGES],
    offset_z: [f32; PASSAGES],
    offset_slowness_x: [f32; PASSAGES],
    offset_slowness_z: [f32; PASSAGES],
    above_receivers: [f32; PASSAGES],
    path: [f32; PASSAGES],
    beam_width: [f32; PASSAGES],
    strength: [f32; PASSAGES],
    absorption: [f32; PASSAGES],
    /// From the beginning of the step to the sample.
    distance: [f32; PASSAGES],
    sample: [u32; PASSAGES],
    count: usize,
}

/// Sums of what passes the receivers' depth, as of
/// [`RangeProfiler`](crate::field::RangeProfiler).
pub(super) struct Deposits {
    step: f32,
    steps_per_metre: f32,
    window: f32,
    /// Least spread of a beam where sound is fastest.
    widest_least: f32,
    /// π/f times the reference speed: least spread for c/c₀ = 1.
    wavelengths: f32,
    /// 0.2 f per metre of path.
    growth: f32,
    passages: Passages,
    pub sums: Vec<f64>,
}

impl Deposits {
    pub(super) fn new(frequency_hz: f64, step_m: f64, count: usize) -> Self {
        let window = WINDOW_STEPS * step_m;
        let zero = [0.0; PASSAGES];
        Self {
            step: step_m as f32,
            steps_per_metre: step_m.recip() as f32,
            window: window as f32,
            widest_least: (PI * FASTEST_M_S / frequency_hz) as f32,
            wavelengths: (PI * REFERENCE_M_S / frequency_hz) as f32,
            growth: (0.2 * frequency_hz / REFERENCE_M_S) as f32,
            passages: Passages {
                slowness_x: [1.0; PASSAGES],
                slowness_z: zero,
                gradient_x: zero,
                gradient_z: zero,
                offset_x: zero,
                offset_z: zero,
                offset_slowness_x: zero,
                offset_slowness_z: zero,
                above_receivers: zero,
                path: zero,
                beam_width: zero,
                strength: zero,
                absorption: zero,
                distance: zero,
                sample: [0; PASSAGES],
                count: 0,
            },
            sums: vec![0.0; count],
        }
    }

    /// Notes what rays bring to samples between the beginning of a step and its end.
    #[inline(always)]
    pub(super) fn take_step(&mut self, lanes: &Lanes, step: &Step) {
        // First and last sample that is passed near the receivers' depth.
        let (mut from, mut to): (Lane, Lane) = ([0.0; LANES], [0.0; LANES]);
        let mut near = [0u32; LANES];
        for i in 0..LANES {
            let (t, gz) = (step.sigma[i], step.gradient_z[i]);
            let (px, pz) = (lanes.slowness_x[i], lanes.slowness_z[i]);
            let (px_end, pz_end) = (px + t * step.gradient_x[i], pz + t * gz);

            let (ox, oz) = (lanes.offset_x[i], lanes.offset_z[i]);
            let ox_end = ox + t * lanes.offset_slowness_x[i];
            let oz_end = oz + t * lanes.offset_slowness_z[i];
            let start_width = (px * oz - pz * ox).abs();
            let end_width = (px_end * oz_end - pz_end * ox_end).abs();
            let width = larger(start_width, end_width) * lanes.beam_width[i];
            let steepest = larger(pz.abs(), pz_end.abs());
            let flattest = larger(smaller(px.abs(), px_end.abs()), LEAST_FLATNESS);
            let reach = GENEROUS_REACH * (self.widest_least + width + self.window * steepest);

            // The path lies within t² |G|/8 of its chord, and the beam reaches so far up
            // and down: over a part of the chord it comes to the receivers' depth.
            let height = reach / flattest + 0.125 * t * t * gz.abs();
            let x = lanes.here.middle[i] + lanes.local_x[i];
            let x_end = x + 0.5 * t * (px + px_end);
            let above = lanes.above_receivers[i];
            let descent = 0.5 * t * (pz + pz_end);
            let inverse = (x_end - x) / larger(descent.abs(), LEAST_DESCENT_M).copysign(descent);
            let (entry, exit) = (x + (above - height) * inverse, x + (above + height) * inverse);
            let start = larger(smaller(x, x_end), smaller(entry, exit));
            let end = smaller(larger(x, x_end), larger(entry, exit));
            // As many samples as whole steps, rounded, lie between the source and x.
            let samples = |x: f32| {
                let count = nearest(x * self.steps_per_metre);
                smaller(larger(count, 0.0), lanes.sample_count[i])
            };
            (from[i], to[i]) = (samples(start), samples(end));
            near[i] = u32::from(from[i] < to[i]);
        }
        let mut list = [0u8; LANES];
        let mut count = 0;
        for (i, &near) in near.iter().enumerate() {
            list[count % LANES] = i as u8;
            count += near as usize;
        }
        for &i in &list[..count] {
            let i = usize::from(i) % LANES;
            let start = lanes.here.middle[i] + lanes.local_x[i];
            for sample in from[i] as i32..to[i] as i32 {
                self.note(lanes, i, step, sample, (sample as f32 + 0.5) * self.step - start);
            }
        }
    }

    #[inline(always)]
    fn note(&mut self, lanes: &Lanes, i: usize, step: &Step, sample: i32, distance: f32) {
        if self.passages.count == PASSAGES {
            self.evaluate();
        }
        let p = &mut self.passages;
        let n = p.count % PASSAGES;
        p.slowness_x[n] = lanes.slowness_x[i];
        p.slowness_z[n] = lanes.slowness_z[i];
        p.gradient_x[n] = step.gradient_x[i];
        p.gradient_z[n] = step.gradient_z[i];
        p.offset_x[n] = lanes.offset_x[i];
        p.offset_z[n] = lanes.offset_z[i];
        p.offset_slowness_x[n] = lanes.offset_slowness_x[i];
        p.offset_slowness_z[n] = lanes.offset_slowness_z[i];
        p.above_receivers[n] = lanes.above_receivers[i];
        p.path[n] = lanes.path[i];
        p.beam_width[n] = lanes.beam_width[i];
        p.strength[n] = lanes.beam_weight[i] * lanes.energy[i];
        p.absorption[n] = lanes.absorption[i];
        p.distance[n] = distance;
        p.sample[n] = lanes.first_sample[i] + sample as u32;
        p.count += 1;
    }

    /// Adds what the passages noted so far bring.
    #[inline(always)]
    pub(super) fn evaluate(&mut self) {
        let p = &self.passages;
        let mut brought = [0.0f32; PASSAGES];
        for (i, brought) in brought.iter_mut().enumerate() {
            let (px, pz) = (p.slowness_x[i], p.slowness_z[i]);
            let (gx, gz) = (p.gradient_x[i], p.gradient_z[i]);
            let root = larger(px * px + 2.0 * gx * p.distance[i], 0.0).sqrt();
            let t = larger(2.0 * p.distance[i] / (px + root.copysign(px)), 0.0);
            let (sx, sz) = (px + t * gx, pz + t * gz);
            let slowness = (sx * sx + sz * sz).sqrt();
            let speed = 1.0 / slowness;
            let across = (p.above_receivers[i] - t * (pz + 0.5 * t * gz)) * sx * speed;
            let path = p.path[i] + t * slowness;
            let offset_x = p.offset_x[i] + t * p.offset_slowness_x[i];
            let offset_z = p.offset_z[i] + t * p.offset_slowness_z[i];
            let width = (sx * offset_z - sz * offset_x) * speed * p.beam_width[i];
            let least = smaller(self.growth * path, self.wavelengths * speed);
            let spread = larger(width.abs(), least);
            let smear = self.window * sz * speed;
            let sharpness = 1.0 / (spread * spread + smear * smear);
            let exponent = across * across * sharpness;
            let decay = exponential(-0.5 * exponent - p.absorption[i] * path);
            let peak = p.strength[i] * speed * sharpness.sqrt();
            *brought = if exponent < (REACH * REACH) as f32 { peak * decay } else { 0.0 };
        }
        for (&sample, &brought) in p.sample[..p.count].iter().zip(&brought) {
            self.sums[sample as usize] += f64::from(brought);
        }
        self.passages.count = 0;
    }
}
