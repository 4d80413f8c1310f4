//! `bench acoustics`: our slices and tables beside the real BELLHOP's.

use super::differences::Differences;
use super::effort::Effort;
use super::slices::{self, Slice};
use crate::args::BenchAcousticsArgs;
use crate::commands::{self, Manner};
use crate::progress::Progress;
use anyhow::{Result, bail};
use rayon::prelude::*;
use serde::Serialize;
use sonarfleet::grid::CellId;
use sonarfleet::mission::Theatre;
use sonarfleet::scenario::Scenario;
use sonarfleet::sonar::section::Waters;
use sonarfleet::sonar::transmission_loss::{LossTableSettings, Quality, TableModel, compute_rows};
use sonarfleet_acoustics::bellhop::Executable;
use sonarfleet_acoustics::environment::{Boundary, FluidHalfSpace, Seabed};
use sonarfleet_acoustics::field::{
    FanPart, RangeProfile, RangeProfiler, Slice as BatchSlice, Source, TraceSettings,
    batch_intensity,
};
use sonarfleet_acoustics::model::{Output, PropagationModel};

/// Beams of a slice where both programs do the same.
const BEAMS: usize = 1200;

/// How closely our rays follow speeds between the levels of a profile, m/s.
const SPEED_TOLERANCE_M_S: f64 = 0.05;

/// Beams of the reference, which our scalar path computes in double precision.
const REFERENCE_BEAMS: usize = 4800;

/// Ray step of BELLHOP, metres: what its users take for tables, and its own choice in
/// water of 1000 m.
const BELLHOP_STEP_M: f64 = 100.0;

/// Bearings of a table as the paper's authors run BELLHOP.
const BEARINGS: usize = 72;

/// Rounds in which the programs take turns.
const ROUNDS: usize = 3;

/// Times that we compute what BELLHOP computes once: ours is too short to time.
const REPEATS: usize = 10;

/// What is measured over one kind of sea floor.
#[derive(Debug, Serialize)]
struct Report {
    bottom: &'static str,
    slices: usize,
    mean_length_km: f64,
    like_for_like: LikeForLike,
    tables: Vec<Table>,
}

/// The same slices, 1200 beams, nothing shortened.
#[derive(Debug, Serialize)]
struct LikeForLike {
    bellhop_cpu_ms: f64,
    native_cpu_ms: f64,
    ratio: f64,
    bellhop_from_reference: Differences,
    native_from_reference: Differences,
    native_from_bellhop: Differences,
}

/// A whole table against BELLHOP on every slice of it.
#[derive(Debug, Serialize)]
struct Table {
    quality: &'static str,
    bearings: usize,
    beams: usize,
    seconds: f64,
    cpu_s: f64,
    bellhop_cpu_s: f64,
    ratio: f64,
    from_fine: Differences,
}

pub(super) fn bench(args: &BenchAcousticsArgs, manner: Manner) -> Result<()> {
    let scenario = commands::scenario(args.scenario.as_deref())?;
    let bellhop = Executable::find()?.with_step_m(BELLHOP_STEP_M);
    commands::abandon_programs_on_interrupt()?;
    let theatre = Theatre::of(&scenario)?;
    let state = theatre.forecast.at(scenario.instant(scenario.epochs[0].snapshot_h))?;
    let firm = FluidHalfSpace::new(1600.0, 1.7, 0.5)?;
    let mut reports = Vec::new();
    for (bottom, half_space) in [("firm", firm), ("mud", Seabed::Mud.half_space())] {
        let waters = Waters::new(
            &state,
            &theatre.bathymetry,
            &scenario.frame,
            scenario.sound_speed,
            Boundary::Fluid(half_space),
        )?;
        let bench = Bench { scenario: &scenario, waters, bellhop: &bellhop, args, manner };
        reports.push(bench.over(bottom)?);
    }
    if manner.json {
        return commands::print_json(&serde_json::json!({
            "bellhop": bellhop.name(),
            "threads": rayon::current_num_threads(),
            "bottoms": reports,
        }));
    }
    print(&reports)
}

struct Bench<'a> {
    scenario: &'a Scenario,
    waters: Waters,
    bellhop: &'a Executable,
    args: &'a BenchAcousticsArgs,
    manner: Manner,
}

impl Bench<'_> {
    fn over(&self, bottom: &'static str) -> Result<Report> {
        let (grid, depth_m) = (&self.scenario.grid, self.scenario.fleet_depth_m);
        let slices = slices::sample(&self.waters, grid, depth_m, self.args.slices)?;
        if slices.is_empty() {
            bail!("the region has no cell from which a slice of 3 km fits");
        }
        let like_for_like = self.like_for_like(bottom, &slices)?;
        let tables = [Quality::Fast, Quality::Standard]
            .map(|quality| self.table(bottom, quality, like_for_like.bellhop_cpu_ms));
        Ok(Report {
            bottom,
            slices: slices.len(),
            mean_length_km: slices.iter().map(Slice::length_m).sum::<f64>()
                / (1000.0 * slices.len() as f64),
            like_for_like,
            tables: tables.into_iter().collect::<Result<_>>()?,
        })
    }

    fn source(&self) -> Source {
        Source { depth_m: self.scenario.fleet_depth_m, frequency_hz: self.scenario.frequency_hz }
    }

    /// Lets both programs take turns on the slices, each with all threads.
    fn like_for_like(&self, bottom: &str, slices: &[Slice]) -> Result<LikeForLike> {
        let bar = Progress::new(&format!("slices over {bottom}"), !self.manner.talkative());
        let (mut bellhop_s, mut native_s) = (Vec::new(), Vec::new());
        let (mut theirs, mut ours) = (Vec::new(), Vec::new());
        for round in 0..ROUNDS {
            bar.set(2 * round, 2 * ROUNDS + 1);
            let (losses, effort) = Effort::of(|| all(slices, |slice| self.by_bellhop(slice)));
            theirs = losses?;
            bellhop_s.push(effort.cpu_s);
            bar.set(2 * round + 1, 2 * ROUNDS + 1);
            let (losses, effort) = Effort::of(|| {
                let once = || self.by_batch(slices);
                (1..REPEATS).try_for_each(|_| once().map(drop)).and_then(|()| once())
            });
            ours = losses?;
            native_s.push(effort.cpu_s / REPEATS as f64);
        }
        bar.set(2 * ROUNDS, 2 * ROUNDS + 1);
        let reference = all(slices, |slice| self.by_scalar(slice))?;
        let cpu_ms = |seconds: Vec<f64>| 1000.0 * median(seconds) / slices.len() as f64;
        let (bellhop_cpu_ms, native_cpu_ms) = (cpu_ms(bellhop_s), cpu_ms(native_s));
        let between = |losses: &[Vec<f64>], reference: &[Vec<f64>]| {
            let pairs = losses.iter().flatten().zip(reference.iter().flatten());
            Differences::between(pairs.map(|(loss, reference)| (*loss, *reference)))
        };
        Ok(LikeForLike {
            bellhop_cpu_ms,
            native_cpu_ms,
            ratio: bellhop_cpu_ms / native_cpu_ms,
            bellhop_from_reference: between(&theirs, &reference),
            native_from_reference: between(&ours, &reference),
            native_from_bellhop: between(&ours, &theirs),
        })
    }

    fn by_bellhop(&self, slice: &Slice) -> Result<Vec<f64>> {
        let Source { depth_m, frequency_hz } = self.source();
        let case = slice.case(frequency_hz, depth_m, BEAMS)?;
        let Output::Fields(fields) = self.bellhop.solve(&case)? else {
            bail!("{} gave no field", self.bellhop.name());
        };
        let pressure = fields.first().map(|field| field.pressure.as_slice()).unwrap_or_default();
        let intensity: Vec<f64> = pressure.iter().map(|p| p.squared_modulus()).collect();
        Ok(slices::cell_losses_db(&intensity).collect())
    }

    /// All slices in one batch a thread, as those around a source are.
    fn by_batch(&self, slices: &[Slice]) -> Result<Vec<Vec<f64>>> {
        let (fan, source) = (slices::fan(BEAMS)?, self.source());
        let of_thread = |slices: &[Slice]| -> Result<Vec<Vec<f64>>> {
            let settings: Vec<TraceSettings> =
                slices.iter().map(|slice| slice.settings(SPEED_TOLERANCE_M_S)).collect();
            let batch: Vec<BatchSlice<'_>> = slices
                .iter()
                .zip(&settings)
                .map(|(slice, settings)| BatchSlice {
                    parts: vec![FanPart { section: &slice.section, fan: &fan, settings }],
                    count: slice.count,
                })
                .collect();
            let profiles = batch_intensity(&batch, &source, source.depth_m, slices::STEP_M)?;
            let losses =
                |profile: &RangeProfile| slices::cell_losses_db(&profile.intensity).collect();
            Ok(profiles.iter().map(losses).collect())
        };
        let share = slices.len().div_ceil(rayon::current_num_threads());
        let shares = slices.par_chunks(share).map(of_thread).collect::<Result<Vec<_>>>()?;
        Ok(shares.concat())
    }

    fn by_scalar(&self, slice: &Slice) -> Result<Vec<f64>> {
        let profiler = RangeProfiler::new(&slice.section, &slice.settings(1e-4));
        let (source, fan) = (self.source(), slices::fan(REFERENCE_BEAMS)?);
        let profile =
            profiler.intensity(&source, &fan, source.depth_m, slices::STEP_M, slice.count)?;
        Ok(slices::cell_losses_db(&profile.intensity).collect())
    }

    /// Rows of some sources, from which the time of the whole table follows.
    fn table(&self, bottom: &str, quality: Quality, bellhop_cpu_ms: f64) -> Result<Table> {
        let grid = &self.scenario.grid;
        let cells = grid.cell_count();
        let spread = |count: usize| -> Vec<CellId> {
            let count = count.min(cells);
            (0..count).map(|k| CellId((2 * k + 1) * cells / (2 * count))).collect()
        };
        let settings = |quality: Quality| LossTableSettings {
            frequency_hz: self.scenario.frequency_hz,
            fleet_depth_m: self.scenario.fleet_depth_m,
            maximum_range_m: self.scenario.maximum_range_m.unwrap_or(f64::INFINITY),
            numerics: quality.numerics(),
            model: TableModel::Native,
        };
        let title = format!("{} table over {bottom}", quality.name());
        let bar = Progress::new(&title, !self.manner.talkative());
        let sources = spread(self.args.sources);
        let (rows, effort) = Effort::of(|| {
            compute_rows(&self.waters, grid, &settings(quality), &sources, &|k, n| bar.set(k, n))
        });
        rows?;
        let whole = cells as f64 / sources.len() as f64;

        let compared = spread(self.args.compared);
        let rows =
            |quality| compute_rows(&self.waters, grid, &settings(quality), &compared, &|_, _| {});
        let (rows, fine) = (rows(quality)?, rows(Quality::Fine)?);
        let pairs = rows.iter().flatten().zip(fine.iter().flatten());
        let numerics = quality.numerics();
        let bellhop_cpu_s = (cells * BEARINGS) as f64 * bellhop_cpu_ms / 1000.0;
        let cpu_s = effort.cpu_s * whole;
        Ok(Table {
            quality: quality.name(),
            bearings: numerics.bearings,
            beams: numerics.beam_count(),
            seconds: effort.wall_s * whole,
            cpu_s,
            bellhop_cpu_s,
            ratio: bellhop_cpu_s / cpu_s,
            from_fine: Differences::between(
                pairs.map(|(loss, fine)| (f64::from(*loss), f64::from(*fine))),
            ),
        })
    }
}

/// The losses of all slices, on all threads.
fn all(
    slices: &[Slice],
    losses_db: impl Fn(&Slice) -> Result<Vec<f64>> + Send + Sync,
) -> Result<Vec<Vec<f64>>> {
    slices.par_iter().map(losses_db).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn print(reports: &[Report]) -> Result<()> {
    commands::say(format_args!(
        "Differences: median/p90/p99 dB of averages over a kilometre, for losses under 90 dB.\n"
    ))?;
    commands::say(format_args!(
        "One slice, {BEAMS} beams, nothing shortened (processor time, {} threads each):\n\n\
         {:<6} {:>10} {:>12} {:>12} {:>7}  {:>16} {:>16} {:>16}",
        rayon::current_num_threads(),
        "bottom",
        "slices",
        "BELLHOP",
        "sonarfleet",
        "ratio",
        "BELLHOP error",
        "sonarfleet error",
        "difference",
    ))?;
    for report in reports {
        let l = &report.like_for_like;
        commands::say(format_args!(
            "{:<6} {:>2}×{:>4.1} km {:>9.2} ms {:>9.2} ms {:>6.1}×  {:>16} {:>16} {:>16}",
            report.bottom,
            report.slices,
            report.mean_length_km,
            l.bellhop_cpu_ms,
            l.native_cpu_ms,
            l.ratio,
            l.bellhop_from_reference.to_string(),
            l.native_from_reference.to_string(),
            l.native_from_bellhop.to_string(),
        ))?;
    }
    commands::say(format_args!(
        "\nA whole table, against BELLHOP on {BEARINGS} slices around every cell:\n\n\
         {:<6} {:<9} {:>16} {:>13} {:>12} {:>7} {:>9}  {:>16}",
        "bottom",
        "quality",
        "bearings × beams",
        "BELLHOP, CPU",
        "ours, CPU",
        "ratio",
        "seconds",
        "from fine",
    ))?;
    for report in reports {
        for t in &report.tables {
            commands::say(format_args!(
                "{:<6} {:<9} {:>16} {:>11.0} s {:>10.1} s {:>6.0}× {:>9.1}  {:>16}",
                report.bottom,
                t.quality,
                format!("{} × {}", t.bearings, t.beams),
                t.bellhop_cpu_s,
                t.cpu_s,
                t.ratio,
                t.seconds,
                t.from_fine.to_string(),
            ))?;
        }
    }
    Ok(())
}
