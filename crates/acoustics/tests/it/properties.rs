//! Symmetries and conservation laws.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use sonarfleet_acoustics::environment::{
    Boundary, Interface, ProfileLaw, Seabed, Section, SoundSpeedField,
};
use sonarfleet_acoustics::field::{
    BeamShape, Coherence, LaunchFan, RangeProfiler, Receivers, Source, TraceSettings,
    transmission_loss,
};
use sonarfleet_acoustics::ray::{RayEnd, trace};
use sonarfleet_acoustics::seawater::Absorption;

fn slope(floor: Vec<(f64, f64)>, columns: Vec<(f64, [f64; 3])>) -> Section {
    let (range, depth) = floor.into_iter().unzip();
    let (at, speeds): (Vec<f64>, Vec<[f64; 3]>) = columns.into_iter().unzip();
    let field = SoundSpeedField::new(
        at,
        vec![0.0, 150.0, 1000.0],
        speeds.concat(),
        ProfileLaw::LinearSquaredIndex,
    )
    .unwrap();
    let bottom = Boundary::Fluid(Seabed::Sand.half_space());
    Section::new(field, Interface::new(range, depth).unwrap(), bottom).unwrap()
}

#[test]
fn a_level_inserted_in_a_profile_changes_nothing() {
    let coarse = vec![0.0, 1000.0];
    let speeds = [1540.0, 1490.0f64];
    let middle = f64::midpoint(speeds[0].powi(-2), speeds[1].powi(-2)).powf(-0.5);
    let field = |depth: Vec<f64>, speed: Vec<f64>| {
        let law = ProfileLaw::LinearSquaredIndex;
        let field = SoundSpeedField::new(vec![0.0], depth, speed, law).unwrap();
        let bottom = Boundary::Fluid(Seabed::Silt.half_space());
        Section::new(field, Interface::flat(1000.0).unwrap(), bottom).unwrap()
    };
    let sections = [
        field(coarse, speeds.to_vec()),
        field(vec![0.0, 500.0, 1000.0], vec![speeds[0], middle, speeds[1]]),
    ];
    let source = Source { depth_m: 200.0, frequency_hz: 500.0 };
    let fan = LaunchFan::uniform(-60.0, 60.0, 1201).unwrap();
    let [one, two] = sections.map(|section| {
        RangeProfiler::new(&section, &TraceSettings::to_range(10_000.0))
            .intensity(&source, &fan, 200.0, 100.0, 80)
            .unwrap()
    });
    for (a, b) in one.intensity.iter().zip(&two.intensity) {
        // Tails of beams are cut off segment by segment.
        assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
    }
}

/// Sound through a cylinder around the source is what the fan sends out: in an
/// ideal guide, between a free surface and a rigid floor, nothing is lost.
#[test]
fn an_ideal_guide_conserves_energy() {
    let depth = 200.0;
    let profile = SoundSpeedField::profile(vec![0.0, depth], vec![1500.0, 1500.0]).unwrap();
    let mut section =
        Section::new(profile, Interface::flat(depth).unwrap(), Boundary::Rigid).unwrap();
    section.absorption = Absorption::None;
    let source = Source { depth_m: 80.0, frequency_hz: 2000.0 };
    let limit = 40.0f64;
    let fan = LaunchFan::uniform(-limit, limit, 2001).unwrap();
    let depths: Vec<f64> = (0..200).map(|k| f64::from(k) + 0.5).collect();
    let receivers = Receivers::new(vec![700.0, 1500.0, 3000.0], depths).unwrap();
    let field = transmission_loss(
        &section,
        &source,
        &fan,
        &receivers,
        BeamShape::Hat,
        Coherence::Incoherent,
        &TraceSettings::to_range(4000.0),
    )
    .unwrap();
    for (index, range) in receivers.range_m().iter().enumerate() {
        // ∫ I dz · r = ∫ cos α · A²/(dz/dα …) dα: each beam brings Δα cos α/cos α.
        let sum: f64 =
            field.pressure.iter().skip(index).step_by(3).map(|p| p.squared_modulus()).sum();
        let sent = 2.0 * limit.to_radians();
        assert!((sum * range / sent - 1.0).abs() < 0.02, "{range}: {} {sent}", sum * range);
    }
}

/// In water that depends on depth only, sound finds its way back as it came.
#[test]
fn source_and_receiver_may_be_exchanged() {
    let section = slope(vec![(0.0, 1000.0)], vec![(0.0, [1530.0, 1505.0, 1490.0])]);
    let fan = LaunchFan::uniform(-80.0, 80.0, 8001).unwrap();
    let loss = |from: f64, to: f64| {
        let source = Source { depth_m: from, frequency_hz: 1000.0 };
        let ranges = vec![1500.0, 3000.0, 4500.0];
        let receivers = Receivers::new(ranges, vec![to]).unwrap();
        transmission_loss(
            &section,
            &source,
            &fan,
            &receivers,
            BeamShape::Gaussian,
            Coherence::Incoherent,
            &TraceSettings::to_range(5000.0),
        )
        .unwrap()
        .loss_db()
    };
    for (there, back) in loss(100.0, 400.0).iter().zip(loss(400.0, 100.0)) {
        assert!((there - back).abs() < 0.3, "{there} {back}");
    }
}

/// Upward refraction presses this ray against the surface.
#[test]
fn a_ray_along_the_surface_ends() {
    let floor = vec![(-1000.0, 300.0), (2000.0, 300.0)];
    let speeds = [1480.0, 1528.0, 1480.0];
    let section = slope(floor, vec![(0.0, speeds), (2000.0, speeds)]);
    let source = Source { depth_m: 0.0, frequency_hz: 1000.0 };
    let ray = trace(&section, &source, 0.0, &TraceSettings::to_range(3000.0)).unwrap();
    assert_eq!(ray.end, RayEnd::LeftDomain);
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 200,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    /// A ray in a mirrored section, launched the other way, is mirrored.
    #[test]
    fn rays_are_symmetric_in_mirrored_sections(
        angle in -85.0..85.0f64,
        source_depth in 1.0..500.0f64,
        depths in prop::array::uniform4(500.0..1000.0f64),
        speeds in prop::array::uniform3(1480.0..1540.0f64),
    ) {
        let columns = vec![
            (-4000.0, speeds),
            (4000.0, [speeds[1], speeds[2], speeds[0]]),
        ];
        let floor: Vec<(f64, f64)> =
            [-5000.0, -1000.0, 1200.0, 5000.0].into_iter().zip(depths).collect();
        let mirrored = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
            points.iter().rev().map(|(x, z)| (-x, *z)).collect()
        };
        let mirrored_columns: Vec<(f64, [f64; 3])> =
            columns.iter().rev().map(|(x, c)| (-x, *c)).collect();
        let there = slope(floor.clone(), columns);
        let back = slope(mirrored(&floor), mirrored_columns);
        let source = Source { depth_m: source_depth, frequency_hz: 1000.0 };
        let settings = TraceSettings::to_range(5000.0);
        let one = trace(&there, &source, angle, &settings).unwrap();
        let two = trace(&back, &source, 180.0 - angle, &settings).unwrap();
        // Reflections off slopes magnify rounding: the first bounces are enough.
        for (a, b) in one.points.iter().zip(&two.points).take(60) {
            prop_assert!((a.range_m + b.range_m).abs() < 1e-3, "{a:?} {b:?}");
            prop_assert!((a.depth_m - b.depth_m).abs() < 1e-3, "{a:?} {b:?}");
        }
    }

    /// Whatever the geometry, grazing, vertical or into a vertex, a ray stays in
    /// the water and ends.
    #[test]
    fn rays_stay_in_the_water_and_end(
        angle in prop_oneof![-90.0..90.0f64, Just(0.0), Just(90.0), Just(-90.0), Just(45.0)],
        source_depth in prop_oneof![0.0..300.0f64, Just(0.0), Just(150.0), Just(300.0)],
        depths in prop::array::uniform4(prop_oneof![300.0..1000.0f64, Just(300.0), Just(1000.0)]),
        speeds in prop::array::uniform3(prop_oneof![1480.0..1540.0f64, Just(1500.0)]),
    ) {
        let floor: Vec<(f64, f64)> =
            [-1000.0, 0.0, 1000.0, 2000.0].into_iter().zip(depths).collect();
        let section = slope(floor, vec![(0.0, speeds), (2000.0, [speeds[2], 1500.0, speeds[0]])]);
        let source = Source { depth_m: source_depth, frequency_hz: 1000.0 };
        let ray = trace(&section, &source, angle, &TraceSettings::to_range(3000.0)).unwrap();
        prop_assert_ne!(ray.end, RayEnd::TooLong);
        for point in &ray.points {
            let floor = section.bathymetry().depth_at_m(point.range_m);
            prop_assert!(point.depth_m > -1e-6 && point.depth_m < floor + 1e-6, "{point:?}");
        }
    }
}
