//! Region, grid, ocean and seabed.

use super::Checker;
use crate::grid::SurveillanceGrid;
use crate::scenario::{
    OceanKind, OceanSource, RegionSection, ScenarioError, ScenarioFile, SeabedSection,
    SoundSpeedName,
};
use sonarfleet_acoustics::environment::{FluidHalfSpace, Seabed};
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::synthetic::SyntheticOcean;
use sonarfleet_ocean::{LocalFrame, Region};

/// Most cells along a side: a transmission-loss table has their fourth power of entries.
const MOST_CELLS_PER_SIDE: usize = 120;
/// Largest cell, metres: the local frame is flat.
const LARGEST_CELL_M: f64 = 10_000.0;

pub(super) fn region(
    checker: &Checker<'_>,
    section: &RegionSection,
) -> Result<Region, ScenarioError> {
    let region = Region {
        west_deg: checker.within("region.west_deg", section.west_deg, (-180.0, 360.0), "°E")?,
        east_deg: checker.within("region.east_deg", section.east_deg, (-180.0, 360.0), "°E")?,
        south_deg: checker.within("region.south_deg", section.south_deg, (-80.0, 80.0), "°N")?,
        north_deg: checker.within("region.north_deg", section.north_deg, (-80.0, 80.0), "°N")?,
    };
    if section.north_deg <= section.south_deg {
        let expected = format!("north of region.south_deg, {}", section.south_deg);
        return Err(checker.wrong("region.north_deg", section.north_deg, expected));
    }
    if !(0.0..=20.0).contains(&region.width_deg()) || region.width_deg() <= 0.0 {
        let expected = format!("up to 20° east of region.west_deg, {}", section.west_deg);
        return Err(checker.wrong("region.east_deg", section.east_deg, expected));
    }
    Ok(region)
}

pub(super) fn grid(
    checker: &Checker<'_>,
    section: &RegionSection,
    frame: &LocalFrame,
) -> Result<SurveillanceGrid, ScenarioError> {
    let range = (1, MOST_CELLS_PER_SIDE);
    let columns = checker.count("region.columns", section.columns, range)?;
    let rows = checker.count("region.rows", section.rows, range)?;
    let cell_width_m = frame.width_m() / columns as f64;
    let cell_height_m = frame.height_m() / rows as f64;
    let cell_size = (50.0, LARGEST_CELL_M);
    checker.within("region.columns", cell_width_m, cell_size, "m from west to east in a cell")?;
    checker.within("region.rows", cell_height_m, cell_size, "m from south to north in a cell")?;
    Ok(SurveillanceGrid { columns, rows, cell_width_m, cell_height_m })
}

pub(super) fn ocean(
    checker: &Checker<'_>,
    file: &ScenarioFile,
    region: Region,
) -> Result<OceanSource, ScenarioError> {
    let section = &file.ocean;
    match section.source {
        OceanKind::Synthetic if !section.files.is_empty() || section.bathymetry.is_some() => {
            Err(checker.wrong("ocean.source", "synthetic, with files named", "\"files\""))
        }
        OceanKind::Synthetic => Ok(OceanSource::Synthetic(SyntheticOcean {
            region,
            start: file.time.start,
            ..SyntheticOcean::default()
        })),
        OceanKind::Files => {
            if section.files.is_empty() {
                return Err(checker.wrong("ocean.files", "empty", "NetCDF files"));
            }
            let Some(bathymetry) = &section.bathymetry else {
                return Err(checker.wrong("ocean.bathymetry", "missing", "a NetCDF file"));
            };
            let states = section
                .files
                .iter()
                .map(|path| checker.existing("ocean.files", path))
                .collect::<Result<_, _>>()?;
            let bathymetry = checker.existing("ocean.bathymetry", bathymetry)?;
            Ok(OceanSource::Files { states, bathymetry })
        }
    }
}

pub(super) const fn sound_speed(name: SoundSpeedName) -> SoundSpeedEquation {
    match name {
        SoundSpeedName::Mackenzie => SoundSpeedEquation::Mackenzie,
        SoundSpeedName::DelGrosso => SoundSpeedEquation::DelGrosso,
        SoundSpeedName::ChenMillero => SoundSpeedEquation::ChenMillero,
    }
}

pub(super) fn seabed(
    checker: &Checker<'_>,
    section: &SeabedSection,
) -> Result<FluidHalfSpace, ScenarioError> {
    let Some(measured) = &section.half_space else {
        let seabed: Seabed = section.sediment.parse().map_err(|_| {
            let known: Vec<_> = Seabed::ALL.iter().map(|seabed| seabed.name()).collect();
            checker.wrong("seabed.sediment", &section.sediment, known.join(", "))
        })?;
        return Ok(seabed.half_space());
    };
    Ok(FluidHalfSpace {
        speed_m_s: checker.within(
            "seabed.half_space.sound_speed_m_s",
            measured.sound_speed_m_s,
            (1000.0, 8000.0),
            "m/s",
        )?,
        density_ratio: checker.within(
            "seabed.half_space.density_g_cm3",
            measured.density_g_cm3,
            (1.0, 5.0),
            "g/cm³",
        )?,
        attenuation_db_wavelength: checker.within(
            "seabed.half_space.attenuation_db_per_wavelength",
            measured.attenuation_db_per_wavelength,
            (0.0, 10.0),
            "dB per wavelength",
        )?,
    })
}
