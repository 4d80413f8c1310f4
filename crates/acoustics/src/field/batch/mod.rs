//! The fast path of tables of transmission loss: 64 rays at a time.
//!
//! The same parabolas from cell to cell as in [`crate::ray`], and the same
//! deposits as in [`super::RangeProfiler`], which is the reference. Rays lie in
//! structures of arrays of `f32`, so that the arithmetic of a step compiles to
//! vector instructions; see `docs/acoustics-kernel.md`.
#![expect(
    clippy::inline_always,
    reason = "only what is inlined into the dispatched function is compiled for wide vectors"
)]

mod deposit;
mod exponential;
mod lanes;
mod layout;
mod queue;
mod reflect;
mod step;
mod tables;

use self::deposit::Deposits;
use self::lanes::{LANES, Lanes};
use self::queue::Queue;
use self::reflect::Reflector;
use self::tables::{Tables, Way};
use super::fan::LaunchFan;
use super::range_profile::{RangeProfile, RangeProfiler, refuse_attenuation};
use super::settings::{Source, TraceSettings};
use crate::environment::{InterfaceShape, Section};
use crate::error::{AcousticsError, within};
use pulp::{Arch, Simd, WithSimd};

/// Beams that see one section. Several parts make up a fan: steep beams may
/// see a simpler section than shallow ones.
#[derive(Debug, Clone, Copy)]
pub struct FanPart<'a> {
    /// What the beams meet.
    pub section: &'a Section,
    /// The beams.
    pub fan: &'a LaunchFan,
    /// How far and how closely they are followed.
    pub settings: &'a TraceSettings,
}

/// A vertical slice: one bearing of a source.
#[derive(Debug, Clone, Default)]
pub struct Slice<'a> {
    /// The fan, in parts.
    pub parts: Vec<FanPart<'a>>,
    /// Number of range samples.
    pub count: usize,
}

/// More steps than any sensible slice needs, per beam: the batch ends.
const MOST_STEPS_PER_BEAM: usize = 20_000;

/// The incoherent intensity of every slice at one depth in steps of `step_m` from
/// the source, summed over the parts of its fan, as of
/// [`RangeProfiler`](super::RangeProfiler) but many times faster. The bits of the
/// result do not depend on the processor. Boundaries of a slice are those of its
/// first part.
///
/// # Errors
/// If the source is not in the water of a part, the step is not positive, or a section
/// has attenuation given by level.
pub fn batch_intensity(
    slices: &[Slice<'_>],
    source: &Source,
    receiver_depth_m: f64,
    step_m: f64,
) -> Result<Vec<RangeProfile>, AcousticsError> {
    intensity_on(Arch::new(), slices, source, receiver_depth_m, step_m)
}

fn intensity_on(
    arch: Arch,
    slices: &[Slice<'_>],
    source: &Source,
    receiver_depth_m: f64,
    step_m: f64,
) -> Result<Vec<RangeProfile>, AcousticsError> {
    within("the step of a range profile", "positive", step_m, step_m > 0.0)?;
    for part in slices.iter().flat_map(|slice| &slice.parts) {
        source.check(part.section)?;
        refuse_attenuation(part.section)?;
    }
    let reflectors: Vec<Reflector<'_>> = slices.iter().map(Reflector::new).collect();
    let samples = slices.iter().map(|slice| slice.count).sum();
    let sums = arch.dispatch(Batch {
        queue: Queue::new(slices, source, receiver_depth_m),
        reflectors: &reflectors,
        deposits: Deposits::new(source.frequency_hz, step_m, samples),
    });
    let mut first = 0;
    let profile = |slice: &Slice<'_>| {
        let sums = &sums[first..first + slice.count];
        first += slice.count;
        if !slice.fits() {
            return slice.scalar_intensity(source, receiver_depth_m, step_m);
        }
        let intensity = (0..).zip(sums).map(|(k, sum)| sum / ((f64::from(k) + 0.5) * step_m));
        Ok(RangeProfile { step_m, intensity: intensity.collect() })
    };
    slices.iter().map(profile).collect()
}

impl Slice<'_> {
    /// Whether the batch can trace its rays: the surface is level, and the floor
    /// straight between its nodes. Else the scalar path does.
    fn fits(&self) -> bool {
        self.parts.iter().all(|part| {
            part.section.altimetry.is_none()
                && part.section.bathymetry().shape() == InterfaceShape::Straight
        })
    }

    fn scalar_intensity(
        &self,
        source: &Source,
        receiver_depth_m: f64,
        step_m: f64,
    ) -> Result<RangeProfile, AcousticsError> {
        let mut sum = RangeProfile { step_m, intensity: vec![0.0; self.count] };
        for part in &self.parts {
            let profiler = RangeProfiler::new(part.section, part.settings);
            let profile =
                profiler.intensity(source, part.fan, receiver_depth_m, step_m, self.count)?;
            for (sum, intensity) in sum.intensity.iter_mut().zip(profile.intensity) {
                *sum += intensity;
            }
        }
        Ok(sum)
    }
}

/// All rays of some slices.
struct Batch<'a> {
    queue: Queue<'a>,
    reflectors: &'a [Reflector<'a>],
    deposits: Deposits,
}

impl WithSimd for Batch<'_> {
    type Output = Vec<f64>;

    /// Traces the rays; what they leave on the samples.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<f64> {
        let Self { mut queue, reflectors, mut deposits } = self;
        let mut tables = Tables::new();
        let mut lanes = Lanes::new(&tables.cells);
        let mut under_way = 0;
        let mut started = 0usize;
        for lane in 0..LANES {
            if let Some(ray) = queue.next(&mut tables) {
                lanes.fill(lane, &ray, &tables.cells);
                under_way += 1;
                started += 1;
            }
        }
        let mut steps = 0;
        while under_way > 0 && steps < MOST_STEPS_PER_BEAM * started {
            steps += 1;
            let events = step::advance(&mut lanes, &tables.cells, &mut deposits);
            for (lane, way) in events.iter() {
                let boundaries = &reflectors[lanes.slice[lane] as usize];
                match way {
                    Way::Cell(_) => {}
                    Way::Narrow(first) => lanes.narrow(lane, first, &tables.cells),
                    Way::Surface => boundaries.off_surface(&mut lanes, lane),
                    Way::Floor => boundaries.off_floor(&mut lanes, lane),
                    Way::End => lanes.energy[lane] = 0.0,
                }
                if lanes.energy[lane] < lanes.least_energy[lane] {
                    tables.release(lanes.slot[lane]);
                    if let Some(ray) = queue.next(&mut tables) {
                        lanes.fill(lane, &ray, &tables.cells);
                        started += 1;
                    } else {
                        lanes.empty(lane, &tables.cells);
                        under_way -= 1;
                    }
                }
            }
        }
        deposits.evaluate();
        deposits.sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::environment::{Boundary, Interface, Seabed, SoundSpeedField};

    #[test]
    fn every_processor_gives_the_same_bits() {
        let field =
            SoundSpeedField::profile(vec![0.0, 90.0, 600.0], vec![1540.0, 1530.0, 1490.0]).unwrap();
        let nodes: Vec<f64> = (-8..=40).map(|k| f64::from(k) * 250.0).collect();
        let floor = nodes.iter().map(|x| 300.0 + 40.0 * (x / 700.0).sin()).collect();
        let floor = Interface::new(nodes, floor).unwrap();
        let bottom = Boundary::Fluid(Seabed::Sand.half_space());
        let section = Section::new(field, floor, bottom).unwrap();
        let fan = LaunchFan::uniform(-60.0, 60.0, 300).unwrap();
        let settings = TraceSettings { near_m: -2000.0, ..TraceSettings::to_range(10_000.0) };
        let part = FanPart { section: &section, fan: &fan, settings: &settings };
        let slices = [100, 0, 50].map(|count| Slice { parts: vec![part], count });
        let source = Source { depth_m: 80.0, frequency_hz: 1000.0 };
        let on = |arch| intensity_on(arch, &slices, &source, 120.0, 100.0).unwrap();
        assert_eq!(on(Arch::Scalar), on(Arch::new()));
    }
}
