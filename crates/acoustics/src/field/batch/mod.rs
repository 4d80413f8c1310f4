//! The fast path of tables of transmission loss: 64 rays at a time.
//!
//! The same parabolas from cell to cell as in [`crate::ray`], and the same
//! deposits as in [`super::RangeProfiler`], which is the reference. Rays lie in
//! structures of arrays of `f32`, so that the arithmetic of a step compiles to
//! vector instructions; see `docs/acoustics-kernel.md`.

mod deposit;
mod lanes;
mod step;
mod tables;

use self::deposit::Deposits;
use self::lanes::{LANES, Lanes};
use self::tables::Tables;
use super::fan::LaunchFan;
use super::range_profile::RangeProfile;
use super::settings::{Source, TraceSettings};
use super::transmission_loss::DB_PER_NEPER;
use crate::environment::Section;
use crate::error::{AcousticsError, within};
use crate::ray::Pair;
use std::f64::consts::TAU;

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

/// More steps than any sensible slice needs, per beam: the batch ends.
const MOST_STEPS_PER_BEAM: usize = 20_000;

/// The incoherent intensity at one depth in `count` steps of `step_m` from the
/// source, summed over the parts of a fan, as of
/// [`RangeProfiler`](super::RangeProfiler) but several times faster. Boundaries
/// are those of the first part.
///
/// # Errors
/// If the source is not in the water of a part or the step is not positive.
pub fn batch_intensity(
    parts: &[FanPart<'_>],
    source: &Source,
    receiver_depth_m: f64,
    step_m: f64,
    count: usize,
) -> Result<RangeProfile, AcousticsError> {
    within("the step of a range profile", "positive", step_m, step_m > 0.0)?;
    let mut profile = RangeProfile { step_m, intensity: vec![0.0; count] };
    let Some(first) = parts.first() else { return Ok(profile) };
    for part in parts {
        source.check(part.section)?;
    }
    let tables = Tables::new(parts);
    let absorption_db_km = first.section.absorption.db_km(source.frequency_hz);
    let mut deposits = Deposits::new(
        source.frequency_hz,
        2.0 * absorption_db_km / (1000.0 * DB_PER_NEPER),
        receiver_depth_m,
        step_m,
        count,
    );
    let boundaries = [&first.section.surface, &first.section.bottom];

    let mut queue = parts.iter().enumerate().flat_map(|(index, part)| {
        let place = Pair::new(0.0, source.depth_m);
        let speed = part.section.sound_speed().speed_at_m_s(0.0, source.depth_m);
        let start = tables.start(index, place, part.settings.amplitude_cutoff);
        part.fan.beams().iter().map(move |beam| {
            let weight = beam.angle_rad.cos() * beam.width_rad / (speed * TAU.sqrt());
            (start, *beam, weight)
        })
    });
    let mut lanes = Lanes::default();
    for lane in 0..LANES {
        lanes.refill(lane, &tables, queue.next());
    }
    let beams: usize = parts.iter().map(|part| part.fan.beams().len()).sum();
    for _ in 0..MOST_STEPS_PER_BEAM * beams {
        if lanes.idle() {
            break;
        }
        step::advance(&mut lanes, &tables, &mut deposits);
        for lane in 0..LANES {
            if step::meet(&mut lanes, lane, &tables, boundaries) {
                lanes.refill(lane, &tables, queue.next());
            }
        }
    }
    for (k, (intensity, sum)) in profile.intensity.iter_mut().zip(&deposits.sums).enumerate() {
        *intensity = sum / ((k as f64 + 0.5) * step_m);
    }
    Ok(profile)
}
