//! Closed forms: spreading, images, parabolas and circles.

use super::reference::{column, read};
use sonarfleet_acoustics::environment::{
    Boundary, FluidHalfSpace, Interface, InterfaceShape, ProfileLaw, Section, SoundSpeedField,
};
use sonarfleet_acoustics::field::{
    BeamCoordinates, BeamKind, BeamShape, Coherence, LaunchFan, RangeProfiler, Receivers, Source,
    SourceGeometry, TraceSettings, transmission_loss,
};
use sonarfleet_acoustics::model::{Case, Native, Output, PropagationModel, Run};
use sonarfleet_acoustics::ray::trace;
use sonarfleet_acoustics::seawater::Absorption;

/// Lossless water between a surface and a half-space that reflects nothing.
fn open_water(sound_speed: SoundSpeedField, surface: Boundary) -> Section {
    let depth = *sound_speed.depth_m().last().unwrap();
    let speed = *sound_speed.speed_m_s().last().unwrap();
    let matched = Boundary::Fluid(FluidHalfSpace::new(speed, 1.0, 0.0).unwrap());
    let mut section = Section::new(sound_speed, Interface::flat(depth).unwrap(), matched).unwrap();
    section.surface = surface;
    section.absorption = Absorption::None;
    section
}

fn uniform_water(surface: Boundary) -> Section {
    let profile = SoundSpeedField::profile(vec![0.0, 2000.0], vec![1500.0, 1500.0]).unwrap();
    open_water(profile, surface)
}

fn silent_surface() -> Boundary {
    Boundary::Fluid(FluidHalfSpace::new(1500.0, 1.0, 0.0).unwrap())
}

#[test]
fn sound_spreads_spherically_in_a_uniform_sea() {
    let section = uniform_water(silent_surface());
    let source = Source { depth_m: 1000.0, frequency_hz: 1000.0 };
    let fan = LaunchFan::uniform(-70.0, 70.0, 2801).unwrap();
    let receivers =
        Receivers::new(vec![500.0, 1000.0, 2000.0], vec![900.0, 1000.0, 1100.0]).unwrap();
    for shape in [BeamShape::Hat, BeamShape::Gaussian] {
        for coherence in [Coherence::Coherent, Coherence::Incoherent] {
            let field = transmission_loss(
                &section,
                &source,
                &fan,
                &receivers,
                shape,
                coherence,
                &TraceSettings::to_range(3000.0),
            )
            .unwrap();
            for (index, loss) in field.loss_db().iter().enumerate() {
                let (depth, range) =
                    (receivers.depth_m()[index / 3], receivers.range_m()[index % 3]);
                let slant = range.hypot(depth - 1000.0);

                // Gaussians have a least width.
                let tolerance = if shape == BeamShape::Hat { 0.01 } else { 0.1 };
                let exact = 20.0 * slant.log10();
                assert!(
                    (loss - exact).abs() < tolerance,
                    "{shape:?} {range} {depth}: {loss} {exact}"
                );
            }
        }
    }
}

#[test]
fn profiles_of_intensity_spread_spherically() {
    let section = uniform_water(silent_surface());
    let source = Source { depth_m: 1000.0, frequency_hz: 1000.0 };
    let fan = LaunchFan::graded(&[(12.0, 300), (30.0, 200), (70.0, 200)]).unwrap();
    let profiler = RangeProfiler::new(&section, &TraceSettings::to_range(6000.0));
    for depth in [950.0, 1000.0, 1300.0] {
        let profile = profiler.intensity(&source, &fan, depth, 50.0, 100).unwrap();
        for range in [525.0, 1000.0, 3000.0, 4500.0f64] {
            let loss = -10.0 * profile.intensity_at(range).log10();
            let exact = 20.0 * range.hypot(depth - 1000.0).log10();
            assert!((loss - exact).abs() < 0.05, "{depth} m, {range} m: {loss} {exact}");
        }
    }
}

#[test]
fn the_surface_image_interferes_as_lloyd_saw() {
    let section = uniform_water(Boundary::Vacuum);
    let source = Source { depth_m: 36.0, frequency_hz: 220.0 };
    let fan = LaunchFan::uniform(-80.0, 80.0, 6001).unwrap();
    let ranges: Vec<f64> = (5..60).map(|k| f64::from(k) * 50.0).collect();
    let receivers = Receivers::new(ranges, vec![90.0, 180.0]).unwrap();
    let settings = TraceSettings::to_range(3500.0);
    let count = receivers.range_m().len();
    let lloyd = |coherence| {
        transmission_loss(&section, &source, &fan, &receivers, BeamShape::Hat, coherence, &settings)
            .unwrap()
            .loss_db()
    };
    let (coherent, incoherent) = (lloyd(Coherence::Coherent), lloyd(Coherence::Incoherent));
    let wavenumber = std::f64::consts::TAU * 220.0 / 1500.0;
    for index in 0..coherent.len() {
        let (depth, range) =
            (receivers.depth_m()[index / count], receivers.range_m()[index % count]);
        let (direct, image) = (range.hypot(depth - 36.0), range.hypot(depth + 36.0));
        let squared = direct.powi(-2) + image.powi(-2)
            - 2.0 * (wavenumber * (direct - image)).cos() / (direct * image);
        let exact = -10.0 * squared.log10();
        if exact < 80.0 {
            assert!((coherent[index] - exact).abs() < 0.05, "{range} {depth}");
        }
        let exact = -10.0 * (direct.powi(-2) + image.powi(-2)).log10();
        assert!((incoherent[index] - exact).abs() < 0.01, "{range} {depth}");
    }
}

/// Depth of a traced ray at a range, linear between its points.
pub(crate) fn depth_at(ray: &sonarfleet_acoustics::ray::Ray, range: f64) -> Option<f64> {
    ray.points.windows(2).find(|pair| (pair[0].range_m..=pair[1].range_m).contains(&range)).map(
        |pair| {
            let weight = (range - pair[0].range_m) / (pair[1].range_m - pair[0].range_m);
            pair[0].depth_m + weight * (pair[1].depth_m - pair[0].depth_m)
        },
    )
}

#[test]
fn rays_are_parabolas_where_the_squared_index_is_linear() {
    // 1/c² = 1/c₀² (1 + bz): z = z₀ + x tan α + b x² / (4 c₀² p_x²).
    let (speed, b, source_depth) = (1540.0, 7.6e-5, 1100.0);
    let lowest = speed / (1.0 + b * 2800.0f64).sqrt();
    let field = SoundSpeedField::new(
        vec![0.0],
        vec![0.0, 2800.0],
        vec![speed, lowest],
        ProfileLaw::LinearSquaredIndex,
    )
    .unwrap();
    let section = open_water(field, Boundary::Vacuum);
    let source = Source { depth_m: source_depth, frequency_hz: 400.0 };
    for angle in [-60.0, -35.0, -10.0, 0.0, 5.0, 20.0f64] {
        let ray = trace(&section, &source, angle, &TraceSettings::to_range(2500.0)).unwrap();
        let at_source = (1.0 + b * source_depth) / (speed * speed);
        let (sine, cosine) = angle.to_radians().sin_cos();
        let horizontal_squared = at_source * cosine * cosine;
        let curvature = b / (speed * speed) / (4.0 * horizontal_squared);
        let mut range = 0.0;
        while range < 2000.0 {
            let exact = source_depth + range * sine / cosine + curvature * range * range;
            if !(5.0..=2795.0).contains(&exact) {
                break;
            }
            // Chords of the recorded path stay within 0.1 m.
            assert!((depth_at(&ray, range).unwrap() - exact).abs() < 0.11, "{angle}° {range} m");
            range += 100.0;
        }
    }
}

#[test]
fn rays_are_circles_where_the_speed_is_linear() {
    // c = c₀ + gz: radius c/(g cos θ), and between two angles θ of the same ray
    // t = (1/g) ln[tan(π/4 + θ₂/2)/tan(π/4 + θ₁/2)].
    let (gradient, depth) = (0.05, 1600.0);
    let profile =
        SoundSpeedField::profile(vec![0.0, depth], vec![1450.0, 1450.0 + gradient * depth])
            .unwrap();
    let section = open_water(profile, Boundary::Vacuum);
    let source = Source { depth_m: 600.0, frequency_hz: 600.0 };
    let speed = 1450.0 + gradient * source.depth_m;
    for angle in [2.0, 8.0, 14.0f64] {
        let ray = trace(&section, &source, angle, &TraceSettings::to_range(30_000.0)).unwrap();
        let launch = angle.to_radians();
        let radius = speed / (gradient * launch.cos());
        // The ray turns below the source and comes back to its depth.
        let exact_range = 2.0 * radius * launch.sin();
        let exact_time = 2.0 / gradient * (std::f64::consts::FRAC_PI_4 + 0.5 * launch).tan().ln();
        let back = ray
            .points
            .windows(2)
            .find(|pair| pair[0].depth_m > source.depth_m && pair[1].depth_m <= source.depth_m)
            .unwrap();
        let weight =
            (pair_depth(&back[0]) - source.depth_m) / (pair_depth(&back[0]) - pair_depth(&back[1]));
        let range = back[0].range_m + weight * (back[1].range_m - back[0].range_m);
        let time = back[0].time_s + weight * (back[1].time_s - back[0].time_s);
        assert!((range - exact_range).abs() < 1.5, "{angle}°: {range} {exact_range}");
        assert!((time - exact_time).abs() < 1e-3, "{angle}°: {time} {exact_time}");
        let deepest = ray.points.iter().map(pair_depth).fold(0.0, f64::max);
        let exact_deepest = source.depth_m + radius * (1.0 - launch.cos());
        assert!((deepest - exact_deepest).abs() < 0.15, "{angle}°: {deepest} {exact_deepest}");
    }
}

fn pair_depth(point: &sonarfleet_acoustics::ray::RayPoint) -> f64 {
    point.depth_m
}

/// BELLHOP's rays through a profile linear in 1/c².
#[test]
fn rays_are_bellhops() {
    let case = "n2linear_rays";
    let Output::Rays(of_sources) = Native.solve(&read(case)).unwrap() else {
        panic!("rays were expected")
    };
    let rays = &of_sources[0];
    let columns = ["launch_deg", "range_m", "depth_m_aubellhop"].map(|name| column(case, name));
    let mut compared = 0;
    for ((launch, range), depth) in columns[0].iter().zip(&columns[1]).zip(&columns[2]) {
        let ray = rays.iter().find(|ray| (ray.launch_angle_deg - launch).abs() < 1e-6).unwrap();
        if depth.is_nan() || *depth < 5.0 || *depth > 2795.0 {
            continue;
        }
        let Some(ours) = depth_at(ray, *range) else { continue };
        assert!((ours - depth).abs() < 0.5, "{launch}° {range} m: {ours} {depth}");
        compared += 1;
    }
    assert!(compared > 500, "{compared}");
}

/// A concave mirror in the sea floor: in the section's plane, u away from it along a ray
/// that meets it at the grazing angle γ, the tube has the width
/// u + v − 2uv/(R sin γ) per radian v behind it.
#[test]
fn a_curvilinear_floor_focuses_as_a_mirror_of_its_radius() {
    let (source_depth, depth, radius, middle) = (300.0, 1000.0, 1500.0f64, 700.0);
    let nodes: Vec<f64> = (-20..=20).map(|k| middle + 10.0 * f64::from(k)).collect();
    let arc = |x: &f64| depth - radius + (radius * radius - (x - middle).powi(2)).sqrt();
    let floor = Interface::new(nodes.clone(), nodes.iter().map(arc).collect()).unwrap();
    let profile = SoundSpeedField::profile(vec![0.0, depth], vec![1500.0; 2]).unwrap();
    let floor = floor.with_shape(InterfaceShape::Curvilinear);
    let mut section = Section::new(profile, floor, Boundary::Rigid).unwrap();
    section.absorption = Absorption::None;
    // To the middle of the mirror at 45°, and 400 m up again; and to the focus of it.
    let slant = std::f64::consts::SQRT_2;
    for up in [400.0, 250.0] {
        let (u, v) = (slant * middle, slant * up);
        let width = u + v - 2.0 * u * v * slant / radius;
        let range = middle + up;
        let exact = (45f64.to_radians().cos() / (range * width.abs())).sqrt();
        let case = Case {
            title: "mirror".to_owned(),
            frequency_hz: 2000.0,
            section: section.clone(),
            source_depth_m: vec![source_depth],
            geometry: SourceGeometry::Point,
            beam_pattern: None,
            receivers: Receivers::new(vec![range], vec![depth - up]).unwrap(),
            fan: LaunchFan::uniform(40.0, 50.0, 2001).unwrap(),
            beams: BeamKind { shape: BeamShape::Hat, coordinates: BeamCoordinates::RayCentred },
            run: Run::Arrivals,
            settings: TraceSettings::to_range(1500.0),
        };
        let Output::Arrivals(arrivals) = Native.solve(&case).unwrap() else {
            panic!("arrivals were expected")
        };
        let found: f64 = arrivals[0].at[0].iter().map(|arrival| arrival.amplitude).sum();
        assert!((found / exact - 1.0).abs() < 0.01, "{up} m: {found} {exact}");
    }
}
