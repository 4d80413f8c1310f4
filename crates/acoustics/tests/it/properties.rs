//! Symmetries and conservation laws.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::environment::{
    Boundary, Interface, InterfaceShape, ProfileLaw, Seabed, Section, SoundSpeedField,
};
use sonarfleet_acoustics::field::{
    BeamCoordinates, BeamKind, BeamShape, Coherence, LaunchFan, RangeProfiler, Receivers, Source,
    SourceGeometry, TraceSettings, transmission_loss,
};
use sonarfleet_acoustics::model::{Case, Native, Output, PropagationModel, Run};
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

/// In water that depends on depth only, sound finds its way back as it came: from point to
/// point, phases included.
#[test]
fn source_and_receiver_may_be_exchanged() {
    let section = slope(vec![(0.0, 1000.0)], vec![(0.0, [1530.0, 1505.0, 1490.0])]);
    let fan = LaunchFan::uniform(-80.0, 80.0, 16_001).unwrap();
    let loss = |from: f64, to: f64, coherence| {
        let source = Source { depth_m: from, frequency_hz: 300.0 };
        let ranges = vec![1500.0, 2200.0, 3000.0, 4500.0];
        let receivers = Receivers::new(ranges, vec![to]).unwrap();
        transmission_loss(
            &section,
            &source,
            &fan,
            &receivers,
            BeamShape::Hat,
            coherence,
            &TraceSettings::to_range(5000.0),
        )
        .unwrap()
        .loss_db()
    };
    for coherence in [Coherence::Incoherent, Coherence::Coherent] {
        let there = loss(100.0, 400.0, coherence);
        for (there, back) in there.iter().zip(loss(400.0, 100.0, coherence)) {
            assert!((there - back).abs() < 0.02, "{coherence:?}: {there} {back}");
        }
    }
}

/// The same bits on one thread and on four.
#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let floor = vec![(-2000.0, 600.0), (1000.0, 500.0), (5000.0, 900.0)];
    let columns = vec![(0.0, [1530.0, 1505.0, 1490.0]), (5000.0, [1525.0, 1510.0, 1490.0])];
    let mut case = Case {
        title: "threads".to_owned(),
        frequency_hz: 400.0,
        section: slope(floor, columns),
        source_depth_m: vec![60.0, 300.0],
        geometry: SourceGeometry::Point,
        beam_pattern: None,
        receivers: Receivers::new(vec![700.0, 1300.0, 4400.0], vec![50.0, 250.0]).unwrap(),
        fan: LaunchFan::uniform(-60.0, 60.0, 401).unwrap(),
        beams: BeamKind { shape: BeamShape::Gaussian, coordinates: BeamCoordinates::Cartesian },
        run: Run::Field(Coherence::Coherent),
        settings: TraceSettings::to_range(5000.0),
    };
    for run in [
        Run::Field(Coherence::Coherent),
        Run::Field(Coherence::Incoherent),
        Run::Arrivals,
        Run::Eigenrays,
    ] {
        case.run = run;
        let [one, four] = [1, 4].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Native.solve(&case)).unwrap()
        });
        assert_eq!(one, four, "{run:?}");
    }
}

/// Eigenrays end where their beams touch the receiver.
#[test]
fn eigenrays_end_near_a_receiver() {
    let section = slope(vec![(0.0, 600.0)], vec![(0.0, [1500.0, 1500.0, 1500.0])]);
    let (range, depth) = (2000.0, 250.0);
    let case = Case {
        title: "eigenrays".to_owned(),
        frequency_hz: 400.0,
        section,
        source_depth_m: vec![100.0],
        geometry: SourceGeometry::Point,
        beam_pattern: None,
        receivers: Receivers::new(vec![range], vec![depth]).unwrap(),
        fan: LaunchFan::uniform(-60.0, 60.0, 1201).unwrap(),
        beams: BeamKind { shape: BeamShape::Hat, coordinates: BeamCoordinates::RayCentred },
        run: Run::Eigenrays,
        settings: TraceSettings::to_range(2500.0),
    };
    let Output::Rays(rays) = Native.solve(&case).unwrap() else { panic!("rays were expected") };
    // Direct, and one and more reflections; two beams touch the receiver in each.
    assert!(rays[0].len() >= 8, "{}", rays[0].len());
    for ray in &rays[0] {
        let end = ray.points.last().unwrap();
        let apart = (end.range_m - range).hypot(end.depth_m - depth);
        assert!(apart < 20.0, "{}°: {apart} m", ray.launch_angle_deg);
    }
}

/// A wedge that closes at both ends, under waves.
fn lens(waves: f64, shape: InterfaceShape) -> Section {
    let nodes: Vec<f64> = (0..=40).map(|k| f64::from(k) * 50.0 - 1000.0).collect();
    let surface = nodes.iter().map(|x| 20.0 + waves * (x / 60.0).sin()).collect();
    let floor = nodes.iter().map(|x| 20.0 + waves + 0.3 * (1000.0 - x.abs())).collect();
    let speeds = [1530.0, 1505.0, 1490.0];
    let mut section = slope(vec![(0.0, 900.0)], vec![(-500.0, speeds), (900.0, [1500.0; 3])]);
    let floor = Interface::new(nodes.clone(), floor).unwrap().with_shape(shape);
    let sound_speed = section.sound_speed().clone();
    let bottom = Boundary::Fluid(Seabed::Mud.half_space());
    section = Section::new(sound_speed, floor, bottom).unwrap();
    section.altimetry = Some(Interface::new(nodes, surface).unwrap().with_shape(shape));
    section
}

/// The surface may not rise above the levels, nor fall below the floor.
#[test]
fn interfaces_that_cross_are_refused() {
    let mut section = lens(0.0, InterfaceShape::Straight);
    let source = Source { depth_m: 100.0, frequency_hz: 1000.0 };
    let settings = TraceSettings::to_range(1500.0);
    assert!(trace(&section, &source, 10.0, &settings).is_ok());
    section.altimetry = Some(Interface::new(vec![0.0, 900.0], vec![10.0, 100.0]).unwrap());
    let refused = trace(&section, &source, 10.0, &settings);
    assert!(matches!(refused, Err(AcousticsError::NoWater { .. })), "{refused:?}");
    section.altimetry = Some(Interface::flat(-1.0).unwrap());
    let refused = trace(&section, &source, 10.0, &settings);
    assert!(matches!(refused, Err(AcousticsError::SurfaceAboveLevels { .. })), "{refused:?}");
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

    /// Between waves and a floor that meet in corners, too.
    #[test]
    fn rays_stay_between_waves_and_floor(
        angle in prop_oneof![-180.0..180.0f64, Just(0.0), Just(90.0), Just(-90.0), Just(17.0)],
        source_depth in prop_oneof![30.0..300.0f64, Just(20.0), Just(320.0)],
        waves in prop_oneof![Just(0.0), 0.0..8.0f64],
        curved in any::<bool>(),
    ) {
        let shape =
            if curved { InterfaceShape::Curvilinear } else { InterfaceShape::Straight };
        let section = lens(waves, shape);
        let source = Source { depth_m: source_depth, frequency_hz: 1000.0 };
        let settings = TraceSettings::to_range(1400.0);
        let ray = trace(&section, &source, angle, &settings).unwrap();
        prop_assert!(ray.points.len() < 200_000, "{}", ray.points.len());
        for point in &ray.points {
            let floor = section.bathymetry().depth_at_m(point.range_m);
            let surface = section.surface_at_m(point.range_m);
            prop_assert!(point.depth_m > surface - 1e-6 && point.depth_m < floor + 1e-6, "{point:?}");
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
