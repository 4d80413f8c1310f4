use super::quality::Numerics;
use super::settings::{LossTableSettings, dense_beams};
use crate::grid::Position;
use crate::sonar::section::{BEHIND_M, Waters};
use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::field::{LaunchFan, RangeProfile, Source, TraceSettings};
use sonarfleet_acoustics::model::{ProfileRequest, PropagationModel};

/// Intensity along one slice of `count` range steps, by any propagation model: all
/// beams as dense as those of the densest class, sound speeds as they are.
pub(super) fn profile_by(
    model: &dyn PropagationModel,
    waters: &Waters,
    settings: &LossTableSettings,
    from: Position,
    bearing_rad: f64,
    count: usize,
) -> Result<RangeProfile, AcousticsError> {
    let numerics = &settings.numerics;
    let step_m = numerics.range_step_m;
    if count == 0 {
        return Ok(RangeProfile { step_m, intensity: Vec::new() });
    }
    let length_m = count as f64 * step_m;
    let section = waters.section(from, bearing_rad, length_m, numerics.sounding_m)?;
    if section.bathymetry().depth_at_m(0.0) < settings.fleet_depth_m {
        return Ok(RangeProfile { step_m, intensity: Vec::new() });
    }
    let trace = TraceSettings {
        near_m: -BEHIND_M,
        amplitude_cutoff: numerics.amplitude_cutoff,
        ..TraceSettings::to_range(length_m)
    };
    model.intensity_profile(&ProfileRequest {
        section: &section,
        source: Source { depth_m: settings.fleet_depth_m, frequency_hz: settings.frequency_hz },
        fan: &dense_fan(numerics)?,
        settings: &trace,
        receiver_depth_m: settings.fleet_depth_m,
        step_m,
        count,
    })
}

/// A fan over all classes, everywhere as dense as the densest.
fn dense_fan(numerics: &Numerics) -> Result<LaunchFan, AcousticsError> {
    let (limit_deg, beams) = dense_beams(numerics);
    LaunchFan::uniform(-limit_deg, limit_deg, beams)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::CellId;
    use crate::grid::SurveillanceGrid;
    use crate::sonar::transmission_loss::{Quality, TableModel, compute_rows};
    use sonarfleet_acoustics::bellhop::Executable;
    use sonarfleet_acoustics::environment::{Boundary, Seabed};
    use sonarfleet_acoustics::model::Native;
    use sonarfleet_acoustics::seawater::SoundSpeedEquation;
    use sonarfleet_ocean::LocalFrame;
    use sonarfleet_ocean::synthetic::SyntheticOcean;

    fn setting() -> (Waters, SurveillanceGrid, LossTableSettings) {
        let ocean = SyntheticOcean { states: 1, ..SyntheticOcean::default() };
        let frame = LocalFrame::new(ocean.region);
        let waters = Waters::new(
            &ocean.forecast().states[0],
            &ocean.bathymetry(),
            &frame,
            SoundSpeedEquation::Mackenzie,
            Boundary::Fluid(Seabed::Mud.half_space()),
        )
        .unwrap();
        let grid = SurveillanceGrid {
            columns: 30,
            rows: 30,
            cell_width_m: frame.width_m() / 30.0,
            cell_height_m: frame.height_m() / 30.0,
        };
        let settings = LossTableSettings {
            frequency_hz: 1000.0,
            fleet_depth_m: 200.0,
            maximum_range_m: f64::INFINITY,
            numerics: Quality::Standard.numerics(),
            model: TableModel::Native,
        };
        (waters, grid, settings)
    }

    /// Along the middle row of cells, the scalar model through the trait agrees with the
    /// cells of the table within what interpolation between bearings and averaging over
    /// cells leave.
    #[test]
    fn a_slice_by_a_model_is_near_the_table() {
        const TOLERANCE_DB: f64 = 1.5;
        let (waters, grid, settings) = setting();
        let source = CellId(450);
        let row = compute_rows(&waters, &grid, &settings, &[source], &|_, _| {}).unwrap().remove(0);
        let east_rad = std::f64::consts::FRAC_PI_2;
        let from = grid.centre(source);
        let profile = profile_by(&Native, &waters, &settings, from, east_rad, 240).unwrap();
        for column in 2..20 {
            let target = CellId(source.0 + column);
            let range_m = grid.centre(target).distance_m(from);
            let half_m = 0.5 * grid.cell_width_m;
            let samples: Vec<f64> = (0..20)
                .map(|k| range_m + half_m * (f64::from(k) / 9.5 - 1.0))
                .map(|range_m| profile.intensity_at(range_m))
                .collect();
            let mean = samples.iter().sum::<f64>() / samples.len() as f64;
            let difference_db = -10.0 * mean.log10() - f64::from(row[target.0]);
            println!("{column} cells: {difference_db:.2} dB");
            assert!(difference_db.abs() < TOLERANCE_DB, "{column} cells: {difference_db}");
        }
    }

    #[test]
    fn the_fan_is_as_dense_as_its_densest_class() {
        let (.., settings) = setting();
        let fan = dense_fan(&settings.numerics).unwrap();
        let spacing_deg = 10.0 / 80.0; // of the class from 9° to 14°
        let beams = fan.beams();
        assert_eq!(beams.len(), (110.0_f64 / spacing_deg).round() as usize + 1);
        assert!((beams[0].angle_rad.to_degrees() + 55.0).abs() < 1e-9);
    }

    #[test]
    fn a_program_that_is_not_there_is_named() {
        let (waters, grid, mut settings) = setting();
        let home = tempfile::tempdir().unwrap();
        settings.model = TableModel::Bellhop(Executable::new(home.path().join("no-bellhop")));
        let refused = compute_rows(&waters, &grid, &settings, &[CellId(450)], &|_, _| {});
        let complaint = format!("{:#}", refused.unwrap_err());
        assert!(complaint.contains("cell 450") && complaint.contains("no-bellhop"), "{complaint}");
        assert_ne!(settings.model.identity(), TableModel::Native.identity());
    }
}
