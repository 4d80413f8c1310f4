//! The batch kernel against the scalar reference path.

use sonarfleet_acoustics::environment::{
    Boundary, Interface, ProfileLaw, Seabed, Section, SoundSpeedField,
};
use sonarfleet_acoustics::field::{
    FanPart, LaunchFan, RangeProfile, RangeProfiler, Source, TraceSettings, batch_intensity,
};
use std::f64::consts::TAU;

/// Differences between single and double precision, dB: median and largest.
/// Rays that graze a level part, so single samples differ more than the rest.
const ROUNDING_DB: [f64; 2] = [0.005, 0.3];

/// A slope of hills with a thermocline that deepens with range.
fn hills(seabed: Seabed) -> Section {
    let depth_m = vec![0.0, 40.0, 80.0, 120.0, 200.0, 400.0, 800.0, 1600.0];
    let base = [1541.0, 1541.5, 1538.0, 1530.0, 1515.0, 1495.0, 1485.0, 1488.0];
    let range_m: Vec<f64> = (-4..=20).map(|k| f64::from(k) * 1000.0).collect();
    let speeds = range_m.iter().flat_map(|range| {
        base.iter().enumerate().map(move |(k, c)| c + 3.0 * (range / 9000.0 + k as f64).sin())
    });
    let field =
        SoundSpeedField::new(range_m.clone(), depth_m, speeds.collect(), ProfileLaw::LinearSpeed)
            .unwrap();
    let nodes: Vec<f64> = (-12..=60).map(|k| f64::from(k) * 333.0).collect();
    let floor = nodes.iter().map(|x| 900.0 + x / 50.0 + 60.0 * (TAU * x / 5000.0).sin()).collect();
    let bottom = Boundary::Fluid(seabed.half_space());
    Section::new(field, Interface::new(nodes, floor).unwrap(), bottom).unwrap()
}

fn settings() -> TraceSettings {
    TraceSettings {
        near_m: -3000.0,
        amplitude_cutoff: 0.01,
        speed_tolerance_m_s: 0.05,
        ..TraceSettings::to_range(15_000.0)
    }
}

fn loss_db(profile: &RangeProfile) -> impl Iterator<Item = f64> {
    profile.intensity.iter().map(|intensity| -10.0 * intensity.log10())
}

fn compare(section: &Section, source: &Source, classes: &[LaunchFan]) {
    let settings = settings();
    let mut scalar = RangeProfile { step_m: 100.0, intensity: vec![0.0; 150] };
    for fan in classes {
        let part = RangeProfiler::new(section, &settings)
            .intensity(source, fan, source.depth_m, 100.0, 150)
            .unwrap();
        for (sum, intensity) in scalar.intensity.iter_mut().zip(part.intensity) {
            *sum += intensity;
        }
    }
    let parts: Vec<FanPart<'_>> =
        classes.iter().map(|fan| FanPart { section, fan, settings: &settings }).collect();
    let batch = batch_intensity(&parts, source, source.depth_m, 100.0, 150).unwrap();
    let mut differences: Vec<f64> =
        loss_db(&scalar).zip(loss_db(&batch)).map(|(a, b)| (a - b).abs()).collect();
    differences.sort_by(f64::total_cmp);
    let (median, largest) = (differences[75], differences[149]);
    println!("median {median:.5} dB, largest {largest:.5} dB");
    assert!(median < ROUNDING_DB[0] && largest < ROUNDING_DB[1], "{median} {largest}");
}

#[test]
fn the_batch_is_the_scalar_path_but_for_rounding() {
    for seabed in [Seabed::Mud, Seabed::Sand] {
        for (depth_m, frequency_hz) in [(200.0, 1000.0), (60.0, 300.0)] {
            let fan = LaunchFan::graded(&[(12.0, 400), (25.0, 300), (60.0, 300)]).unwrap();
            compare(&hills(seabed), &Source { depth_m, frequency_hz }, &[fan]);
        }
    }
}

#[test]
fn classes_of_beams_add_up() {
    let classes = [(0.0, 12.0, 402), (12.0, 25.0, 300), (25.0, 60.0, 302)]
        .map(|(inner, outer, count)| LaunchFan::class(inner, outer, count).unwrap());
    let source = Source { depth_m: 200.0, frequency_hz: 1000.0 };
    compare(&hills(Seabed::Mud), &source, &classes);
}
