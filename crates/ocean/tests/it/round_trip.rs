//! What is written is read back.

use jiff::SignedDuration;
use sonarfleet_ocean::io::{
    Attribute, AttributeValue, Dataset, ForecastRequest, Values, inspect, read_bathymetry,
    read_field, read_forecast, write_bathymetry, write_forecast,
};
use sonarfleet_ocean::synthetic::{REGION, START, SyntheticOcean, TITLE};
use sonarfleet_ocean::{OceanError, Quantity};

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// The embedded ocean and the one read from its files are the same to the bit: the
/// default run and the run from files cannot differ.
#[test]
fn the_synthetic_ocean_comes_back_bit_for_bit() {
    let ocean = SyntheticOcean { states: 3, ..SyntheticOcean::default() };
    let forecast = ocean.forecast();
    let directory = tempfile::tempdir().unwrap();
    let files = write_forecast(&forecast, directory.path(), TITLE).unwrap();
    let names: Vec<_> = files.iter().map(|path| path.file_name().unwrap()).collect();
    assert_eq!(names, ["thetao.nc", "so.nc", "uo_vo.nc"]);

    let request = ForecastRequest {
        required: &Quantity::ALL,
        region: Some(REGION),
        span: Some((START, START + SignedDuration::from_hours(12))),
    };
    let back = read_forecast(&files, &request).unwrap();
    assert_eq!(back.states.len(), 3);
    for (ours, theirs) in forecast.states.iter().zip(&back.states) {
        assert_eq!(ours.time, theirs.time);
        assert_eq!(ours.grid, theirs.grid);
        for quantity in Quantity::ALL {
            assert_eq!(bits(ours.values(quantity)), bits(theirs.values(quantity)), "{quantity}");
        }
    }

    let path = directory.path().join("gebco.nc");
    let sea = ocean.bathymetry();
    write_bathymetry(&sea, &path, TITLE).unwrap();
    assert_eq!(read_bathymetry(&path, None).unwrap(), sea);
    assert!(inspect(&path).unwrap().title.unwrap().contains("SYNTHETIC"));
    let left_over = std::fs::read_dir(directory.path()).unwrap().count();
    assert_eq!(left_over, 4, "temporary files are renamed away");
}

/// A state whose temperatures are not conversions of `f32` potential temperatures comes
/// back within one unit in the last place of them.
#[test]
fn other_temperatures_come_back_within_rounding() {
    const LARGEST_DIFFERENCE_C: f32 = 2e-6;
    let mut forecast = SyntheticOcean { states: 1, ..SyntheticOcean::default() }.forecast();
    for (i, value) in forecast.states[0].temperature_c.iter_mut().enumerate() {
        *value += (i % 101) as f32 * 1.234_567e-4;
    }
    let directory = tempfile::tempdir().unwrap();
    let files = write_forecast(&forecast, directory.path(), TITLE).unwrap();
    let request = ForecastRequest { required: &Quantity::SOUND, region: None, span: None };
    let back = read_forecast(&files, &request).unwrap();
    let pairs = forecast.states[0].temperature_c.iter().zip(&back.states[0].temperature_c);
    let worst = pairs.filter(|(a, _)| !a.is_nan()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    println!("largest difference {worst} °C");
    assert!(worst <= LARGEST_DIFFERENCE_C, "{worst}");
}

#[test]
fn any_data_set_can_be_written_and_read() {
    let mut data = Dataset::new("a small record");
    data.add_attribute(Attribute::number("seed", 7.0));
    data.add_coordinate("cell", Values::I32((0..50).collect()), &[]);
    data.add_coordinate("time", Values::F64(vec![0.0, 6.0]), &[Attribute::text("units", "h")]);
    let loss: Vec<f32> =
        (0..2500).map(|i| if i % 51 == 0 { f32::NAN } else { i as f32 / 8.0 }).collect();
    data.add_dimension("target", 50);
    let fill =
        Attribute { name: "_FillValue".to_owned(), value: AttributeValue::F32(vec![f32::NAN]) };
    data.add_variable("loss", &["cell", "target"], Values::F32(loss.clone()), &[fill]);
    data.add_variable(
        "frequency",
        &[],
        Values::F64(vec![1000.0]),
        &[Attribute::text("units", "Hz")],
    );
    data.add_variable("flag", &["time"], Values::I16(vec![1, 0]), &[]);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("record.nc");
    data.write(&path).unwrap();
    // Writing again replaces the file.
    data.write(&path).unwrap();

    let back = read_field(&path, "loss").unwrap();
    assert_eq!(back.dimensions.iter().map(|d| d.length).collect::<Vec<_>>(), [50, 50]);
    let found: Vec<f32> = back.values.iter().map(|&value| value as f32).collect();
    assert_eq!(bits(&found), bits(&loss));
    let frequency = read_field(&path, "frequency").unwrap();
    assert!(frequency.dimensions.is_empty());
    assert_eq!(frequency.values, [1000.0]);
    assert_eq!(frequency.attributes[0], Attribute::text("units", "Hz"));
    assert_eq!(read_field(&path, "flag").unwrap().values, [1.0, 0.0]);
    assert!(matches!(read_field(&path, "tl"), Err(OceanError::MissingVariable { .. })));
}

#[test]
fn a_directory_that_is_not_there_is_an_error_and_leaves_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("missing").join("record.nc");
    let error = Dataset::new("nothing").write(&path).unwrap_err();
    assert!(matches!(error, OceanError::Unwritable { .. }), "{error:?}");
    assert!(error.to_string().contains("record.nc"));
}
