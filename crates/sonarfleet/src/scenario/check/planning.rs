//! Domain, epochs with their priors, transmission loss, solver, planner, objective.

use super::{Checker, M_PER_KM};
use crate::assignment::AssignmentObjective;
use crate::grid::{Position, SurveillanceGrid};
use crate::navigation::{TimeOptimal, TransitDomain};
use crate::npz::Archive;
use crate::placement::Method;
use crate::scenario::{
    AssignmentSection, BlobSection, EpochPlan, ModelName, NavigationSection, ObjectiveName,
    PlacementSection, PriorSection, QualityName, ScenarioError, ScenarioFile,
    TransmissionLossSection,
};
use crate::sonar::prior::{GaussianBlob, TargetPrior};
use crate::sonar::transmission_loss::{Quality, TableModel};
use sonarfleet_acoustics::bellhop::Executable;
use std::path::PathBuf;

pub(super) fn domain(
    checker: &Checker<'_>,
    section: &NavigationSection,
    grid: &SurveillanceGrid,
) -> Result<TransitDomain, ScenarioError> {
    let key = "navigation.transit_margin_km";
    let margin_km = checker.within(key, section.transit_margin_km, (0.0, 1000.0), "km")?;
    TransitDomain::around_region(grid.width_m(), grid.height_m(), margin_km * M_PER_KM)
        .map_err(|error| checker.wrong(key, margin_km, error))
}

pub(super) fn epochs(
    checker: &Checker<'_>,
    file: &ScenarioFile,
    grid: &SurveillanceGrid,
) -> Result<Vec<EpochPlan>, ScenarioError> {
    let count = checker.count("time.epochs", file.time.epochs, (1, 1000))?;
    let epoch_h = checker.within("time.epoch_h", file.time.epoch_h, (0.1, 240.0), "h")?;
    let snapshots = &file.time.snapshot_h;
    one_per_epoch(checker, "time.snapshot_h", snapshots.len(), count)?;
    let detection =
        tables(checker, "transmission_loss.files", &file.transmission_loss.files, count)?;
    let communication = tables(
        checker,
        "transmission_loss.communication_files",
        &file.transmission_loss.communication_files,
        count,
    )?;
    let priors = file
        .prior
        .iter()
        .map(|section| prior(checker, section, grid))
        .collect::<Result<Vec<_>, _>>()?;
    let Some(last) = priors.last() else {
        return Err(checker.wrong("prior", "empty", "at least one target prior"));
    };
    (0..count)
        .map(|epoch| {
            let start_h = epoch as f64 * epoch_h;
            Ok(EpochPlan {
                start_h,
                snapshot_h: snapshots.get(epoch).copied().unwrap_or(start_h),
                prior: priors.get(epoch).unwrap_or(last).clone(),
                loss_file: detection.get(epoch).cloned(),
                communication_loss_file: communication.get(epoch).cloned(),
            })
        })
        .collect()
}

/// Files of tables, none or one per epoch.
fn tables(
    checker: &Checker<'_>,
    key: &'static str,
    files: &[PathBuf],
    epochs: usize,
) -> Result<Vec<PathBuf>, ScenarioError> {
    one_per_epoch(checker, key, files.len(), epochs)?;
    files.iter().map(|path| checker.existing(key, path)).collect()
}

fn one_per_epoch(
    checker: &Checker<'_>,
    key: &'static str,
    found: usize,
    epochs: usize,
) -> Result<(), ScenarioError> {
    if found == 0 || found == epochs {
        return Ok(());
    }
    Err(checker.wrong(key, format!("{found} entries"), format!("none, or {epochs}: one per epoch")))
}

fn prior(
    checker: &Checker<'_>,
    section: &PriorSection,
    grid: &SurveillanceGrid,
) -> Result<TargetPrior, ScenarioError> {
    let wrong = |error| checker.wrong("prior", error, "a usable target prior");
    match section {
        PriorSection::Corridor(corridor) => {
            TargetPrior::line_corridor(corridor, grid).map_err(wrong)
        }
        PriorSection::Blobs { blobs } => {
            let blobs: Vec<_> = blobs.iter().map(blob).collect();
            TargetPrior::gaussian_blobs(&blobs, grid).map_err(wrong)
        }
        PriorSection::File { path } => {
            let path = checker.existing("prior.path", path)?;
            let array = Archive::open(&path)
                .and_then(|archive| archive.f64s("prior"))
                .map_err(|error| checker.file("prior.path", &path, error))?;
            if array.shape != [grid.rows, grid.columns] {
                let reason = format!(
                    "`prior` has shape {:?}, expected [{}, {}] (rows, columns)",
                    array.shape, grid.rows, grid.columns
                );
                return Err(checker.file("prior.path", &path, reason));
            }
            TargetPrior::new(array.values).map_err(|error| checker.file("prior.path", &path, error))
        }
    }
}

fn blob(section: &BlobSection) -> GaussianBlob {
    let [east_km, north_km] = section.centre_km;
    GaussianBlob {
        centre: Position::new(east_km * M_PER_KM, north_km * M_PER_KM),
        east_width_m: section.width_km * M_PER_KM,
        north_width_m: section.width_km * M_PER_KM,
        total: section.total,
    }
}

pub(super) fn maximum_range_m(
    checker: &Checker<'_>,
    section: &TransmissionLossSection,
) -> Result<Option<f64>, ScenarioError> {
    let key = "transmission_loss.maximum_range_km";
    let bounds = (1.0, 1000.0);
    let metres = |range_km| Ok(checker.within(key, range_km, bounds, "km")? * M_PER_KM);
    section.maximum_range_km.map(metres).transpose()
}

pub(super) const fn quality(name: QualityName) -> Quality {
    match name {
        QualityName::Fast => Quality::Fast,
        QualityName::Standard => Quality::Standard,
        QualityName::Fine => Quality::Fine,
    }
}

/// The model of a name; an external program must be there.
pub(super) fn loss_model(
    checker: &Checker<'_>,
    name: ModelName,
) -> Result<TableModel, ScenarioError> {
    match name {
        ModelName::Native => Ok(TableModel::Native),
        ModelName::Bellhop => Executable::find().map(TableModel::Bellhop).map_err(|error| {
            let expected = format!("\"native\", or a program to run: {error}");
            checker.wrong("transmission_loss.model", "\"bellhop\"", expected)
        }),
    }
}

pub(super) fn method(
    checker: &Checker<'_>,
    section: &PlacementSection,
) -> Result<Method, ScenarioError> {
    section
        .method
        .parse()
        .map_err(|error| checker.wrong("placement.method", &section.method, error))
}

pub(super) fn time_optimal(
    checker: &Checker<'_>,
    section: &NavigationSection,
) -> Result<TimeOptimal, ScenarioError> {
    Ok(TimeOptimal {
        spacing_m: checker.within(
            "navigation.spacing_m",
            section.spacing_m,
            (50.0, 10_000.0),
            "m",
        )?,
        step_h: checker.within("navigation.step_h", section.step_h, (0.05, 6.0), "h")?,
        headings: checker.count("navigation.headings", section.headings, (4, 360))?,
        horizon_h: checker.within("navigation.horizon_h", section.horizon_h, (1.0, 1000.0), "h")?,
    })
}

pub(super) fn objective(
    checker: &Checker<'_>,
    section: &AssignmentSection,
) -> Result<AssignmentObjective, ScenarioError> {
    Ok(match section.objective {
        ObjectiveName::Sum => AssignmentObjective::Sum,
        ObjectiveName::Bottleneck => AssignmentObjective::BottleneckThenSum,
        ObjectiveName::Power => AssignmentObjective::Power(checker.within(
            "assignment.exponent",
            section.exponent,
            (1.0, 10.0),
            "(an exponent)",
        )?),
    })
}
