//! What holds for all points and times.

use jiff::SignedDuration;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use sonarfleet_ocean::synthetic::{REGION, START, SyntheticOcean};
use sonarfleet_ocean::{Forecast, LocalFrame, OceanState, Region};
use std::sync::LazyLock;

static FORECAST: LazyLock<Forecast> =
    LazyLock::new(|| SyntheticOcean { states: 3, ..SyntheticOcean::default() }.forecast());

fn bounds(values: &[f32]) -> (f64, f64) {
    let finite = || values.iter().copied().filter(|value| !value.is_nan());
    (finite().fold(f32::MAX, f32::min).into(), finite().fold(f32::MIN, f32::max).into())
}

fn state_at(minutes: i64) -> OceanState {
    FORECAST.at(START + SignedDuration::from_mins(minutes)).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 256,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    /// Interpolation is an average: never outside the values it is made from, and never
    /// missing inside the data, however deep.
    #[test]
    fn columns_stay_within_the_data(
        longitude in 117.75..118.75_f64,
        latitude in 21.26..22.22_f64,
        minutes in 0..=720_i64,
    ) {
        let state = state_at(minutes);
        let column = state.column(longitude, latitude).unwrap();
        for (values, all) in [
            (&column.temperature_c, &state.temperature_c),
            (&column.salinity_psu, &state.salinity_psu),
            (&column.current_east_m_s, &state.current_east_m_s),
        ] {
            let (lowest, highest) = bounds(all);
            for value in values {
                prop_assert!((lowest - 1e-6..=highest + 1e-6).contains(value), "{value}");
            }
        }
    }

    /// The current at a level is that of the column there, and longitudes wrap.
    #[test]
    fn currents_agree_with_columns(
        longitude in 117.75..118.75_f64,
        latitude in 21.26..22.22_f64,
        level in 0..43_usize,
    ) {
        let state = &FORECAST.states[1];
        let column = state.column(longitude, latitude).unwrap();
        let depth = state.grid.depth_m[level];
        let [east, north] = state.current(longitude - 360.0, latitude, depth).unwrap();
        prop_assert!((east - column.current_east_m_s[level]).abs() < 1e-9);
        prop_assert!((north - column.current_north_m_s[level]).abs() < 1e-9);
    }

    /// Going to the local frame and back changes nothing, anywhere on Earth.
    #[test]
    fn local_frames_invert(
        west_deg in -180.0..180.0_f64,
        south_deg in -80.0..79.0_f64,
        width in 0.05..2.0_f64,
        x in -0.2..1.2_f64,
        y in -0.2..1.2_f64,
    ) {
        let region = Region {
            west_deg,
            east_deg: west_deg + width,
            south_deg,
            north_deg: south_deg + 0.5,
        };
        let frame = LocalFrame::new(region);
        let (east, north) = (x * frame.width_m(), y * frame.height_m());
        let (longitude, latitude) = frame.to_geographic(east, north);
        let (back_east, back_north) = frame.to_local(longitude, latitude);
        prop_assert!((back_east - east).abs() < 1e-5, "{back_east} {east}");
        prop_assert!((back_north - north).abs() < 1e-5, "{back_north} {north}");
    }
}

/// The same ocean is there whatever part of it is asked for.
#[test]
fn the_synthetic_ocean_does_not_depend_on_the_region_asked_for() {
    let wide =
        SyntheticOcean { states: 1, margin_deg: 0.5, ..SyntheticOcean::default() }.forecast();
    let (a, b) = (&FORECAST.states[0], &wide.states[0]);
    for (longitude, latitude) in [(118.1, 21.6), (118.25, 21.74), (118.4, 21.88)] {
        assert!(a.grid.covers(REGION));
        assert_eq!(a.column(longitude, latitude), b.column(longitude, latitude));
    }
}
