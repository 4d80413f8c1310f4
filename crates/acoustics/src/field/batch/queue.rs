use super::Slice;
use super::tables::{Start, Tables};
use crate::decibel::DB_PER_NEPER;
use crate::field::{Beam, LaunchFan, Source};
use crate::ray::Pair;
use std::f64::consts::TAU;

/// Rays are followed at least to where reflections have left this of their
/// intensity.
const LEAST_ENERGY: f64 = 1e-10;

/// A beam, with what is the same in all slices.
#[derive(Debug, Clone, Copy)]
pub(super) struct Launch {
    pub sine: f64,
    pub cosine: f64,
    pub width_rad: f64,
    /// cos α Δα/√(2π).
    pub weight: f64,
}

/// A ray that is about to start.
pub(super) struct Ray {
    pub start: Start,
    pub launch: Launch,
    /// Depth of the receivers less that of the source.
    pub above_receivers: f64,
    pub least_energy: f64,
    /// Intensity absorbed per metre, nepers.
    pub absorption_m: f64,
    pub first_sample: u32,
    pub sample_count: u32,
    pub slice: u32,
    pub slot: u32,
}

/// The beams of all slices, one after the other. Cells are laid out when the
/// first beam of a part is due.
pub(super) struct Queue<'a> {
    slices: &'a [Slice<'a>],
    /// Launches of every fan that occurs.
    fans: Vec<(&'a LaunchFan, Vec<Launch>)>,
    source: &'a Source,
    receiver_depth_m: f64,
    slice: usize,
    part: usize,
    beam: usize,
    first_sample: usize,
    /// Of the part whose beams are due: its fan, its slot, and where they start.
    due: Option<(usize, u32, Start)>,
}

impl<'a> Queue<'a> {
    pub(super) fn new(slices: &'a [Slice<'a>], source: &'a Source, receiver_depth_m: f64) -> Self {
        let mut fans: Vec<(&LaunchFan, Vec<Launch>)> = Vec::new();
        for part in slices.iter().flat_map(|slice| &slice.parts) {
            if !fans.iter().any(|(fan, _)| std::ptr::eq(*fan, part.fan)) {
                fans.push((part.fan, launches(part.fan)));
            }
        }
        Self {
            slices,
            fans,
            source,
            receiver_depth_m,
            slice: 0,
            part: 0,
            beam: 0,
            first_sample: 0,
            due: None,
        }
    }

    /// The next ray; none when all have started.
    pub(super) fn next(&mut self, tables: &mut Tables) -> Option<Ray> {
        loop {
            let slice = self.slices.get(self.slice)?;
            let Some(part) = slice.parts.get(self.part).filter(|_| slice.count > 0 && slice.fits())
            else {
                self.first_sample += slice.count;
                (self.slice, self.part) = (self.slice + 1, 0);
                continue;
            };
            let (fan, slot, start) = if let Some(due) = self.due {
                due
            } else {
                let place = Pair::new(0.0, self.source.depth_m);
                let fan = self.fans.iter().position(|(fan, _)| std::ptr::eq(*fan, part.fan))?;
                let (slot, start) = tables.lay_out(part, place, part.fan.beams().len());
                *self.due.insert((fan, slot, start))
            };
            let Some(&launch) = self.fans[fan].1.get(self.beam) else {
                (self.part, self.beam, self.due) = (self.part + 1, 0, None);
                continue;
            };
            self.beam += 1;
            let absorption_db_km = part.section.absorption.db_km(self.source.frequency_hz);
            return Some(Ray {
                start,
                launch,
                above_receivers: self.receiver_depth_m - self.source.depth_m,
                least_energy: part.settings.amplitude_cutoff.powi(2).max(LEAST_ENERGY),
                absorption_m: 2.0 * absorption_db_km / (1000.0 * DB_PER_NEPER),
                first_sample: self.first_sample as u32,
                sample_count: slice.count as u32,
                slice: self.slice as u32,
                slot,
            });
        }
    }
}

fn launches(fan: &LaunchFan) -> Vec<Launch> {
    let launch = |beam: &Beam| {
        let (sine, cosine) = beam.angle_rad.sin_cos();
        let weight = cosine * beam.width_rad / TAU.sqrt();
        Launch { sine, cosine, width_rad: beam.width_rad, weight }
    };
    fan.beams().iter().map(launch).collect()
}
