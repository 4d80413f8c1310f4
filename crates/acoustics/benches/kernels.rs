//! What the pieces of a table of transmission loss cost: `cargo bench -p sonarfleet-acoustics`.

use divan::{Bencher, black_box};
use sonarfleet_acoustics::environment::{
    Boundary, FluidHalfSpace, Interface, ProfileLaw, Section, SoundSpeedField,
};
use sonarfleet_acoustics::field::{
    FanPart, LaunchFan, RangeProfiler, Slice, Source, TraceSettings, batch_intensity,
};
use sonarfleet_acoustics::seawater::mackenzie_m_s;
use std::f64::consts::TAU;

const SOURCE: Source = Source { depth_m: 200.0, frequency_hz: 1000.0 };
const LENGTH_M: f64 = 13_000.0;
const STEP_M: f64 = 100.0;
const COUNT: usize = 130;

fn main() {
    divan::main();
}

/// An autumn profile of the South China Sea that changes slowly with range, on `levels`
/// levels, over a rough slope of a firm fluid.
fn slope(levels: usize) -> Section {
    let profile = [
        (0.0, 1541.5),
        (47.0, 1541.7),
        (78.0, 1538.6),
        (110.0, 1531.0),
        (186.0, 1515.7),
        (266.0, 1504.0),
        (454.0, 1493.6),
        (1062.0, 1484.1),
        (2000.0, 1492.3),
    ];
    // Levels are densest near the surface, as those of ocean models.
    let level = |k: usize| 2000.0 * (k as f64 / (levels - 1) as f64).powi(3);
    let depth_m: Vec<f64> = (0..levels).map(level).collect();
    let speed = |depth: f64| {
        let below = profile.partition_point(|node| node.0 < depth).clamp(1, profile.len() - 1);
        let ((z0, c0), (z1, c1)) = (profile[below - 1], profile[below]);
        c0 + (c1 - c0) * (depth - z0) / (z1 - z0)
    };
    let range_m: Vec<f64> = (-3..=13).map(|k| f64::from(k) * 1000.0).collect();
    let speeds = range_m
        .iter()
        .flat_map(|x| depth_m.iter().map(move |&z| speed(z) + (x / 8000.0).sin()))
        .collect();
    let field =
        SoundSpeedField::new(range_m.clone(), depth_m.clone(), speeds, ProfileLaw::LinearSpeed)
            .unwrap();
    let nodes: Vec<f64> = (-12..=52).map(|k| f64::from(k) * 250.0).collect();
    let floor = nodes.iter().map(|x| 1300.0 + x / 40.0 + 30.0 * (TAU * x / 3000.0).sin());
    let floor = Interface::new(nodes.clone(), floor.collect()).unwrap();
    let firm = FluidHalfSpace::new(1600.0, 1.7, 0.5).unwrap();
    Section::new(field, floor, Boundary::Fluid(firm)).unwrap()
}

fn settings(speed_tolerance_m_s: f64) -> TraceSettings {
    TraceSettings { near_m: -3000.0, speed_tolerance_m_s, ..TraceSettings::to_range(LENGTH_M) }
}

/// 1200 beams, nothing shortened, by the scalar path.
#[divan::bench]
fn slice_of_1200_beams_scalar(bencher: Bencher<'_, '_>) {
    let (section, settings) = (slope(42), settings(0.05));
    let fan = LaunchFan::uniform(-60.0, 60.0, 1200).unwrap();
    bencher.bench(|| {
        let profiler = RangeProfiler::new(&section, &settings);
        profiler.intensity(&SOURCE, &fan, SOURCE.depth_m, STEP_M, COUNT).unwrap()
    });
}

/// The same by the batch.
#[divan::bench]
fn slice_of_1200_beams_batch(bencher: Bencher<'_, '_>) {
    let (section, settings) = (slope(42), settings(0.05));
    let fan = LaunchFan::uniform(-60.0, 60.0, 1200).unwrap();
    bencher.bench(|| batch(&section, &fan, &settings));
}

/// A slice of a table: 270 beams of three classes, each with its own profile.
#[divan::bench]
fn slice_of_a_table(bencher: Bencher<'_, '_>) {
    let classes = [(25, 0.0, 14.0, 120, 0.1), (15, 14.0, 25.0, 80, 0.5), (9, 25.0, 55.0, 70, 2.0)]
        .map(|(levels, inner, outer, beams, tolerance)| {
            let fan = LaunchFan::class(inner, outer, beams).unwrap();
            let settings = TraceSettings { amplitude_cutoff: 0.02, ..settings(tolerance) };
            (slope(levels), fan, settings)
        });
    bencher.bench(|| {
        let parts = classes
            .iter()
            .map(|(section, fan, settings)| FanPart { section, fan, settings })
            .collect();
        let slice = Slice { parts, count: COUNT };
        batch_intensity(&[slice], &SOURCE, SOURCE.depth_m, STEP_M).unwrap()
    });
}

/// Beams so wide that all reach the receivers everywhere, in plain water: deposits.
#[divan::bench]
fn dense_deposits(bencher: Bencher<'_, '_>) {
    let field = SoundSpeedField::profile(vec![0.0, 2000.0], vec![1500.0, 1500.0]).unwrap();
    let section = Section::new(field, Interface::flat(2000.0).unwrap(), Boundary::Rigid).unwrap();
    let fan = LaunchFan::uniform(-10.0, 10.0, 12).unwrap();
    let settings = settings(0.05);
    bencher.bench(|| batch(&section, &fan, &settings));
}

#[divan::bench]
fn sound_speed(bencher: Bencher<'_, '_>) {
    bencher.bench(|| mackenzie_m_s(black_box(12.0), black_box(34.5), black_box(300.0)));
}

fn batch(section: &Section, fan: &LaunchFan, settings: &TraceSettings) -> f64 {
    let slice = Slice { parts: vec![FanPart { section, fan, settings }], count: COUNT };
    let profiles = batch_intensity(&[slice], &SOURCE, SOURCE.depth_m, STEP_M).unwrap();
    profiles[0].intensity.iter().sum()
}
