//! Rows of transmission loss that are kept between computations.

use sonarfleet::grid::{CellId, SurveillanceGrid};
use sonarfleet::sonar::section::Waters;
use sonarfleet::sonar::transmission_loss::{
    BeamClass, LossCache, LossTableSettings, Numerics, Quality, TableModel, compute_rows,
    rows_with_cache, table_fingerprint,
};
use sonarfleet_acoustics::bellhop::Executable;
use sonarfleet_acoustics::environment::{Boundary, Seabed};
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::synthetic::SyntheticOcean;
use sonarfleet_ocean::{Bathymetry, LocalFrame, OceanState, Region};
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

const REGION: Region =
    Region { west_deg: 118.23, east_deg: 118.27, south_deg: 21.72, north_deg: 21.757 };

/// What a table is made of.
#[derive(Clone)]
struct Ingredients {
    state: OceanState,
    bathymetry: Bathymetry,
    region: Region,
    equation: SoundSpeedEquation,
    bottom: Boundary,
    grid: SurveillanceGrid,
    settings: LossTableSettings,
}

impl Ingredients {
    fn new() -> Self {
        let ocean = SyntheticOcean { region: REGION, states: 1, ..SyntheticOcean::default() };
        let frame = LocalFrame::new(REGION);
        Self {
            state: ocean.forecast().states.remove(0),
            bathymetry: ocean.bathymetry(),
            region: REGION,
            equation: SoundSpeedEquation::Mackenzie,
            bottom: Boundary::Fluid(Seabed::Mud.half_space()),
            grid: SurveillanceGrid {
                columns: 4,
                rows: 4,
                cell_width_m: frame.width_m() / 4.0,
                cell_height_m: frame.height_m() / 4.0,
            },
            settings: LossTableSettings {
                frequency_hz: 1000.0,
                fleet_depth_m: 200.0,
                maximum_range_m: f64::INFINITY,
                numerics: Quality::Fast.numerics(),
                model: TableModel::Native,
            },
        }
    }

    fn waters(&self) -> Waters {
        let frame = LocalFrame::new(self.region);
        Waters::new(&self.state, &self.bathymetry, &frame, self.equation, self.bottom.clone())
            .unwrap()
    }

    fn fingerprint(&self) -> String {
        table_fingerprint(&self.waters(), &self.grid, &self.settings)
    }

    fn rows(&self, sources: &[CellId]) -> Vec<Vec<f32>> {
        compute_rows(&self.waters(), &self.grid, &self.settings, sources, &|_, _| {}).unwrap()
    }

    /// Rows with a cache, and how many came from it.
    fn cached(&self, sources: &[CellId], cache: &Path) -> (Vec<Vec<f32>>, usize) {
        let cache = LossCache::new(cache);
        let told = Mutex::new(Vec::new());
        let progress = |done, total| told.lock().unwrap().push((done, total));
        let rows = rows_with_cache(
            &self.waters(),
            &self.grid,
            &self.settings,
            sources,
            Some(&cache),
            &progress,
        )
        .unwrap();
        let told = told.into_inner().unwrap();
        assert_eq!(told[0], (rows.from_cache, sources.len()), "what was there is told first");
        assert_eq!(told.len(), 1 + sources.len() - rows.from_cache);
        (rows.rows, rows.from_cache)
    }
}

/// Everything that decides a row has a share in the fingerprint.
#[test]
fn every_ingredient_changes_the_fingerprint() {
    type Change = fn(&mut Ingredients);
    let changes: [(&str, Change); 23] = [
        ("temperature", |i| {
            i.state.temperature_c.iter_mut().for_each(|t| *t += 1e-3);
        }),
        ("salinity", |i| {
            i.state.salinity_psu.iter_mut().for_each(|s| *s += 1e-3);
        }),
        ("water depth", |i| i.bathymetry.values_m.iter_mut().for_each(|z| *z -= 0.01)),
        ("place", |i| {
            i.region.south_deg += 0.001;
            i.region.north_deg += 0.001;
        }),
        ("sound speed", |i| i.equation = SoundSpeedEquation::DelGrosso),
        ("seabed", |i| i.bottom = Boundary::Fluid(Seabed::Silt.half_space())),
        ("kind of seabed", |i| i.bottom = Boundary::Rigid),
        ("attenuation of the seabed", |i| {
            let mut half_space = Seabed::Mud.half_space();
            half_space.attenuation_db_wavelength += 1e-9;
            i.bottom = Boundary::Fluid(half_space);
        }),
        ("columns", |i| i.grid.columns = 5),
        ("rows", |i| i.grid.rows = 5),
        ("cell width", |i| i.grid.cell_width_m += 1e-6),
        ("cell height", |i| i.grid.cell_height_m += 1e-6),
        ("frequency", |i| i.settings.frequency_hz = 1000.5),
        ("depth", |i| i.settings.fleet_depth_m = 201.0),
        ("range", |i| i.settings.maximum_range_m = 50_000.0),
        ("bearings", |i| i.settings.numerics.bearings += 1),
        ("amplitude", |i| i.settings.numerics.amplitude_cutoff *= 2.0),
        ("soundings", |i| i.settings.numerics.sounding_m += 1.0),
        ("range step", |i| i.settings.numerics.range_step_m += 1.0),
        ("beams", |i| i.settings.numerics.beam_classes[0].beams += 2),
        ("angles", |i| i.settings.numerics.beam_classes[1].limit_deg += 0.5),
        ("model", |i| {
            i.settings.model = TableModel::Bellhop(Executable::new("bellhop.exe".into()));
        }),
        ("tolerance", |i| i.settings.numerics.beam_classes[2].speed_tolerance_m_s += 0.1),
    ];
    let same = Ingredients::new();
    let mut seen = HashSet::from([same.fingerprint()]);
    assert_eq!(same.fingerprint(), Ingredients::new().fingerprint());
    for (name, change) in changes {
        let mut other = same.clone();
        change(&mut other);
        assert!(seen.insert(other.fingerprint()), "{name} does not change the fingerprint");
    }
}

#[test]
fn rows_from_the_cache_are_the_computed_ones_bit_for_bit() {
    let home = tempfile::tempdir().unwrap();
    let cache = home.path();
    let ingredients = Ingredients::new();
    let all: Vec<CellId> = ingredients.grid.cells().collect();
    let whole = ingredients.rows(&all);

    // A shard first, then all: what the shard has computed is not computed again.
    let odd: Vec<CellId> = all.iter().copied().skip(1).step_by(2).collect();
    let (rows, from_cache) = ingredients.cached(&odd, cache);
    assert_eq!((rows, from_cache), (odd.iter().map(|n| whole[n.0].clone()).collect(), 0));
    assert_eq!(ingredients.cached(&all, cache), (whole.clone(), 8));
    assert_eq!(ingredients.cached(&all, cache), (whole.clone(), 16));

    // Other numbers have rows of their own.
    let mut other = ingredients.clone();
    other.settings.frequency_hz = 4000.0;
    let (rows, from_cache) = other.cached(&odd[..1], cache);
    assert_eq!(from_cache, 0);
    assert_ne!(rows[0], whole[1]);
    assert_eq!(fs::read_dir(cache).unwrap().count(), 2);

    // A file that was cut off as by a full disk is computed again, and the others not.
    let entry = cache.join(ingredients.fingerprint());
    let file = row_files(&entry).pop().unwrap();
    let content = fs::read(&file).unwrap();
    fs::write(&file, &content[..content.len() - 100]).unwrap();
    let (rows, from_cache) = ingredients.cached(&all, cache);
    assert_eq!(rows, whole);
    assert_eq!(from_cache, 8);
    assert_eq!(ingredients.cached(&all, cache), (whole, 16));
}

fn row_files(entry: &Path) -> Vec<PathBuf> {
    let files = fs::read_dir(entry).unwrap().map(|item| item.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|extension| extension == "rows")).collect()
}

/// Losses of version 3 of the computation from cell 5, dB. If they move, rows kept
/// by earlier programs are no longer those that would be computed: raise
/// `TABLE_VERSION` in `transmission_loss/cache.rs` and put the new losses here.
#[test]
fn rows_of_another_version_have_another_name() {
    /// Much less than a row's accuracy, and more than mathematics libraries differ by.
    const TOLERANCE_DB: f32 = 1e-3;
    #[rustfmt::skip]
    const EXPECTED_DB: [f32; 16] = [
        60.2344, 57.0094, 60.2280, 65.1567,
        57.0754, 52.1404, 57.0807, 63.6484,
        60.2179, 57.0127, 60.2108, 65.1063,
        64.9704, 63.4797, 64.9779, 70.6018,
    ];
    let class =
        |limit_deg, beams, speed_tolerance_m_s| BeamClass { limit_deg, beams, speed_tolerance_m_s };
    let mut ingredients = Ingredients::new();
    ingredients.settings.numerics = Numerics {
        bearings: 36,
        beam_classes: vec![class(12.0, 120, 0.1), class(25.0, 80, 0.5), class(55.0, 30, 2.0)],
        amplitude_cutoff: 0.01,
        sounding_m: 250.0,
        range_step_m: 200.0,
    };
    let row = ingredients.rows(&[CellId(5)]).remove(0);
    for (found, expected) in row.iter().zip(EXPECTED_DB) {
        assert!((found - expected).abs() < TOLERANCE_DB, "raise TABLE_VERSION: {row:?}");
    }
}
