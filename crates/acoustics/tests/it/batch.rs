//! The batch kernel against the scalar reference path.

use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::environment::{
    AttenuationProfile, Boundary, Interface, InterfaceShape, ProfileLaw, Seabed, Section,
    SoundSpeedField,
};
use sonarfleet_acoustics::field::{
    FanPart, LaunchFan, RangeProfile, RangeProfiler, Slice, Source, TraceSettings, batch_intensity,
};
use sonarfleet_acoustics::model::{Native, ProfileRequest, PropagationModel};
use std::f64::consts::TAU;

/// Differences between single and double precision, dB: median and largest.
/// Rays that graze a level part, so single samples differ more than the rest.
const ROUNDING_DB: [f64; 2] = [0.005, 0.3];

/// The same where the batch takes intervals of bathymetry together, so that steps through
/// water that depends on range are longer.
const LONGER_STEPS_DB: [f64; 2] = [0.01, 1.0];

const STEP_M: f64 = 100.0;

/// A slope of hills with a thermocline that deepens with range.
fn hills(seabed: Seabed) -> Section {
    let depth_m = vec![0.0, 40.0, 80.0, 120.0, 200.0, 400.0, 800.0, 1600.0];
    let base = [1541.0, 1541.5, 1538.0, 1530.0, 1515.0, 1495.0, 1485.0, 1488.0];
    let range_m: Vec<f64> = (-4..=20).map(|k| f64::from(k) * 1000.0).collect();
    let speeds = range_m.iter().flat_map(|range| {
        base.iter().enumerate().map(move |(k, c)| c + 3.0 * (range / 9000.0 + 0.2 * k as f64).sin())
    });
    let field =
        SoundSpeedField::new(range_m.clone(), depth_m, speeds.collect(), ProfileLaw::LinearSpeed)
            .unwrap();
    let nodes: Vec<f64> = (-12..=60).map(|k| f64::from(k) * 333.0).collect();
    let floor = nodes.iter().map(|x| 900.0 + x / 50.0 + 60.0 * (TAU * x / 5000.0).sin()).collect();
    let bottom = Boundary::Fluid(seabed.half_space());
    Section::new(field, Interface::new(nodes, floor).unwrap(), bottom).unwrap()
}

/// Columns no wider than the intervals of the bathymetry, as the scalar path has them.
fn settings() -> TraceSettings {
    TraceSettings {
        near_m: -3000.0,
        amplitude_cutoff: 0.01,
        speed_tolerance_m_s: 0.05,
        column_m: 334.0,
        ..TraceSettings::to_range(15_000.0)
    }
}

fn loss_db(profile: &RangeProfile) -> impl Iterator<Item = f64> {
    profile.intensity.iter().map(|intensity| -10.0 * intensity.log10())
}

fn scalar(slice: &Slice<'_>, source: &Source) -> RangeProfile {
    let mut sum = RangeProfile { step_m: STEP_M, intensity: vec![0.0; slice.count] };
    for part in &slice.parts {
        let profile = RangeProfiler::new(part.section, part.settings)
            .intensity(source, part.fan, source.depth_m, STEP_M, slice.count)
            .unwrap();
        for (sum, intensity) in sum.intensity.iter_mut().zip(profile.intensity) {
            *sum += intensity;
        }
    }
    sum
}

fn compare(found: &RangeProfile, expected: &RangeProfile, tolerance_db: [f64; 2]) {
    let mut differences: Vec<f64> =
        loss_db(found).zip(loss_db(expected)).map(|(a, b)| (a - b).abs()).collect();
    differences.sort_by(f64::total_cmp);
    let (median, largest) = (differences[differences.len() / 2], differences.last().unwrap());
    println!("median {median:.5} dB, largest {largest:.5} dB");
    assert!(median < tolerance_db[0] && *largest < tolerance_db[1], "{median} {largest}");
}

#[test]
fn the_batch_is_the_scalar_path_but_for_rounding() {
    let fan = LaunchFan::graded(&[(12.0, 400), (25.0, 300), (60.0, 300)]).unwrap();
    for seabed in [Seabed::Mud, Seabed::Sand] {
        let section = hills(seabed);
        for (depth_m, frequency_hz) in [(200.0, 1000.0), (60.0, 300.0)] {
            let source = Source { depth_m, frequency_hz };
            let part = FanPart { section: &section, fan: &fan, settings: &settings() };
            let slice = Slice { parts: vec![part], count: 150 };
            let expected = scalar(&slice, &source);
            let found = batch_intensity(&[slice], &source, depth_m, STEP_M).unwrap();
            compare(&found[0], &expected, ROUNDING_DB);
        }
    }
}

#[test]
fn wider_columns_are_as_good() {
    let fan = LaunchFan::graded(&[(12.0, 400), (25.0, 300), (60.0, 300)]).unwrap();
    let narrow = settings();
    let wide = TraceSettings { column_m: 1000.0, ..narrow };
    let source = Source { depth_m: 200.0, frequency_hz: 1000.0 };
    for seabed in [Seabed::Mud, Seabed::Sand] {
        let section = hills(seabed);
        let slice = |settings| Slice {
            parts: vec![FanPart { section: &section, fan: &fan, settings }],
            count: 150,
        };
        let expected = scalar(&slice(&narrow), &source);
        let found = batch_intensity(&[slice(&wide)], &source, 200.0, STEP_M).unwrap();
        compare(&found[0], &expected, LONGER_STEPS_DB);
    }
}

/// Slices of several parts, of different lengths, some empty, share a queue.
#[test]
fn slices_keep_apart_and_parts_add_up() {
    let classes = [(0.0, 12.0, 202), (12.0, 25.0, 150), (25.0, 60.0, 152)]
        .map(|(inner, outer, count)| LaunchFan::class(inner, outer, count).unwrap());
    let source = Source { depth_m: 200.0, frequency_hz: 1000.0 };
    let (mud, sand, settings) = (hills(Seabed::Mud), hills(Seabed::Sand), settings());
    let slice = |section, count| Slice {
        parts: classes.iter().map(|fan| FanPart { section, fan, settings: &settings }).collect(),
        count,
    };
    let slices =
        [slice(&mud, 150), slice(&sand, 0), slice(&sand, 100), Slice::default(), slice(&mud, 40)];
    let found = batch_intensity(&slices, &source, source.depth_m, STEP_M).unwrap();
    assert_eq!(found.len(), slices.len());
    for (found, slice) in found.iter().zip(&slices) {
        assert_eq!(found.intensity.len(), slice.count);
        if slice.count > 0 {
            compare(found, &scalar(slice, &source), ROUNDING_DB);
        }
    }
    assert!(batch_intensity(&[], &source, 200.0, STEP_M).unwrap().is_empty());
}

#[test]
fn what_the_batch_cannot_do_the_scalar_path_does() {
    let section = hills(Seabed::Sand);
    let floor = section.bathymetry().clone().with_shape(InterfaceShape::Curvilinear);
    let bottom = section.bottom.clone();
    let curved = Section::new(section.sound_speed().clone(), floor, bottom).unwrap();
    let fan = LaunchFan::uniform(-30.0, 30.0, 100).unwrap();
    let part = FanPart { section: &curved, fan: &fan, settings: &settings() };
    let slice = Slice { parts: vec![part], count: 150 };
    let source = Source { depth_m: 200.0, frequency_hz: 1000.0 };
    let expected = scalar(&slice, &source);
    let found = batch_intensity(&[slice], &source, 200.0, STEP_M).unwrap();
    assert_eq!(found, [expected]);
}

#[test]
fn bad_input_is_refused() {
    let section = hills(Seabed::Sand);
    let fan = LaunchFan::uniform(-30.0, 30.0, 100).unwrap();
    let part = FanPart { section: &section, fan: &fan, settings: &settings() };
    let slice = [Slice { parts: vec![part], count: 150 }];
    let source = Source { depth_m: 200.0, frequency_hz: 1000.0 };
    assert!(batch_intensity(&slice, &source, 200.0, 0.0).is_err());
    let buried = Source { depth_m: 1500.0, ..source };
    assert!(batch_intensity(&slice, &buried, 200.0, STEP_M).is_err());
}

#[test]
fn attenuation_by_level_is_refused_by_the_batch_and_answered_by_the_model() {
    let lossy = |db_wavelength: f64| {
        let mut section = hills(Seabed::Mud);
        let levels = AttenuationProfile::new(vec![0.0, 1600.0], vec![db_wavelength; 2]);
        section.attenuation = Some(levels.unwrap());
        section
    };
    let section = lossy(0.001);
    let (source, settings) = (Source { depth_m: 100.0, frequency_hz: 1000.0 }, settings());
    let fan = LaunchFan::uniform(-30.0, 30.0, 121).unwrap();
    let part = FanPart { section: &section, fan: &fan, settings: &settings };
    let slice = Slice { parts: vec![part], count: 20 };
    let refused = batch_intensity(&[slice], &source, 100.0, STEP_M);
    assert!(matches!(refused, Err(AcousticsError::NotOffered { .. })), "{refused:?}");

    let profile = |section: &Section| {
        let request = ProfileRequest {
            section,
            source,
            fan: &fan,
            settings: &settings,
            receiver_depth_m: 100.0,
            step_m: STEP_M,
            count: 20,
        };
        Native.intensity_profile(&request).unwrap()
    };
    let without = lossy(0.0);
    // 0.001 dB per wavelength of 1.5 m are 0.6 dB over a kilometre.
    let lost_db = 10.0
        * (profile(&without).intensity_at(1000.0) / profile(&section).intensity_at(1000.0)).log10();
    assert!((0.5..1.0).contains(&lost_db), "{lost_db}");
}
