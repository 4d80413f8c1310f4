//! BELLHOP files: what is read, what is refused with file and line, and what comes back
//! when a case is written.

use super::reference::folder;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::bellhop::{CaseFiles, read_case};
use sonarfleet_acoustics::environment::{
    AttenuationProfile, Boundary, ElasticHalfSpace, FluidHalfSpace, Interface, InterfaceShape,
    ProfileLaw, ReflectionTable, Section, SoundSpeedField,
};
use sonarfleet_acoustics::field::{
    BeamCoordinates, BeamKind, BeamPattern, BeamShape, Coherence, LaunchFan, ReceiverLayout,
    Receivers, SourceGeometry, TraceSettings,
};
use sonarfleet_acoustics::model::{Case, Run};
use sonarfleet_acoustics::seawater::Absorption;
use std::path::{Path, PathBuf};

/// The files of `pekeris_i` after a change to the text of `case.env`.
fn changed(from: &str, to: &str) -> CaseFiles {
    let files = CaseFiles::load(&folder("pekeris_i").join("case.env")).unwrap();
    let text = files.text("env").unwrap().to_owned();
    assert!(text.contains(from), "{from:?} is not in\n{text}");
    files.with("env", text.replacen(from, to, 1))
}

fn refusal(from: &str, to: &str) -> String {
    changed(from, to).read().unwrap_err().to_string()
}

#[test]
fn a_missing_file_is_named() {
    let path = PathBuf::from("/nowhere/case.env");
    let refused = read_case(&path).unwrap_err();
    assert!(matches!(&refused, AcousticsError::Unreadable { path: found, .. } if *found == path));
}

#[test]
fn a_case_may_be_named_without_its_ending() {
    let named = folder("pekeris_i").join("case");
    assert_eq!(read_case(&named).unwrap(), read_case(&named.with_extension("env")).unwrap());
}

#[test]
fn refusals_name_file_line_what_was_found_and_what_was_expected() {
    for (from, to, parts) in [
        ("350", "loud", &["line 2", "a frequency in Hz", "loud"][..]),
        ("350", "-350", &["line 2", "positive", "-350"]),
        ("'CVW '", "'AVW '", &["line 4", "C, N, P, S, Q", "\"A\""]),
        ("'CVW '", "'CVm '", &["line 4", "N, F, M, W, Q, L", "\"m\""]),
        ("'CVW '", "'CVWB'", &["line 4", "biological"]),
        ("'CVW '", "'CXW '", &["line 4", "V, R, A, F", "\"X\""]),
        ("'CVW '", "'QVW '", &["line 4", "case.ssp", "not there"]),
        ("'A' ", "'G' ", &["V, R, A, F", "\"G\""]),
        ("'A' ", "'A~' ", &["case.bty", "not there"]),
        ("\n30 /", "\n150 /", &["line 11", "the source at 150 m is not in the water"]),
        ("10 141.0", "10 0.0", &["the depth of the box", "below the surface"]),
        ("8.300000", "nan", &["a range in km", "nan"]),
        ("'IB'", "'IC'", &["G, ^, g, B, b", "\"C\""]),
        ("'IB'", "'XB'", &["C, S, I, R, E, A, a", "\"X\""]),
        ("'IB'", "'IB*'", &["case.sbp", "not there"]),
        ("'IB'", "'IB  I'", &["receiver depths", "expected 160", "found 4"]),
        ("'IB'", "'IB   3'", &["dimensions", "\"3\""]),
        ("\n160\n", "\n1000000000000\n", &["million", "1000000000000"]),
        ("\n160\n", "\n16.5\n", &["the number of receiver ranges", "16.5"]),
    ] {
        let complaint = refusal(from, to);
        for part in parts.iter().chain(&["case.env, line "]) {
            assert!(complaint.contains(part), "{to:?}: {complaint:?} lacks {part:?}");
        }
    }
}

#[test]
fn a_truncated_file_is_refused() {
    let files = CaseFiles::load(&folder("pekeris_i").join("case.env")).unwrap();
    let text = files.text("env").unwrap();
    let half = text[..text.len() / 2].to_owned();
    let complaint = files.with("env", half).read().unwrap_err().to_string();
    assert!(complaint.contains("the end of the file"), "{complaint}");
}

/// Everything that a case may hold, in Fortran's less usual forms.
const DRESSED: &str = "'a ''dressed'' case' ! with an apostrophe's comment\r\n\
    1.5D3\t! Hz\r\n\
    1 /\r\n\
    SAWF~ \r\n\
    0.0, 3000. 400 1.2 , 0.1 0.2 / above\r\n\
    10.0 35 8.0\r\n  50\r\n\
    0 0.0 200\r\n\
    10 1500. 0 1.0 2*0.3 /\r\n\
    50,1490.,,,0.2/\r\n\
    \r\n\
    120 1485 /\r\n\
    200 1+3 /\r\n\
    'F*' 0.0\r\n\
    2\r\n 20 80.5 /\r\n\
    5\r\n 50 30 40 20 60 /\r\n\
    5 ! ranges\r\n 0 4 /\r\n\
    'Sg*XI'\r\n\
    5\r\n -20 -10 0 5 \r\n 20 /\r\n\
    10 500 5.0\r\n";

#[test]
fn everything_a_case_may_hold_is_read() {
    let files = CaseFiles::new(Path::new("dressed"))
        .with("env", DRESSED)
        .with("ati", "'CS'\n2\n-5 10\n5 12.5\n")
        .with("bty", "'LL'\n2\n-5 190 1700 0 1.5 0.5 0\n5 150 1700 0 1.5 0.5 0\n")
        .with("brc", "2\n0 1 180\n90 0.5 0\n")
        .with("sbp", "2\n-90 0\n90 -6\n");
    let reading = files.read().unwrap();
    let case = &reading.case;
    assert_eq!(reading.notes, ["dressed.env, line 18: the values are sorted"]);
    assert_eq!(case.title, "a 'dressed' case");
    assert_eq!(case.section.sound_speed().law(), ProfileLaw::CubicSpline);
    assert_eq!(case.section.sound_speed().speed_m_s(), [1500.0, 1490.0, 1485.0, 1000.0]);
    let Boundary::Elastic(ice) = case.section.surface else { panic!("ice was expected") };
    assert_eq!((ice.compressional.speed_m_s, ice.shear_speed_m_s), (3000.0, 400.0));
    assert!(
        matches!(case.section.absorption, Absorption::FrancoisGarrison { ph, .. } if (ph - 8.0).abs() < 1e-12)
    );
    let attenuation = case.section.attenuation.as_ref().unwrap();
    assert_eq!(attenuation.db_wavelength(), [0.3, 0.2, 0.2, 0.2]);
    let altimetry = case.section.altimetry.as_ref().unwrap();
    assert_eq!(altimetry.shape(), InterfaceShape::Curvilinear);
    assert_eq!(altimetry.node_depth_m(), [10.0, 12.5]);
    assert_eq!(case.section.bathymetry().range_m(), [-5000.0, 5000.0]);
    assert_eq!(case.source_depth_m, [20.0, 80.5]);
    assert_eq!(case.receivers.layout(), ReceiverLayout::Pairs);
    assert_eq!(case.receivers.depth_m(), [20.0, 30.0, 40.0, 50.0, 60.0]);
    assert_eq!(case.receivers.range_m(), [0.0, 1000.0, 2000.0, 3000.0, 4000.0]);
    assert_eq!(case.run, Run::Field(Coherence::SemiCoherent));
    let kind = BeamKind { shape: BeamShape::Hat, coordinates: BeamCoordinates::RayCentred };
    assert_eq!((case.beams, case.geometry), (kind, SourceGeometry::Line));
    assert_eq!(case.fan, LaunchFan::at(&[-20.0, -10.0, 0.0, 5.0, 20.0]).unwrap());
    assert_eq!(case.settings, TraceSettings::fine(5000.0));
    assert_eq!(case.beam_pattern.as_ref().unwrap().level_db(), [0.0, -6.0]);
}

/// 0.5 dB per wavelength of 1500 m/s at 350 Hz, in every unit.
#[test]
fn attenuations_may_have_any_unit() {
    let wavelength_m = 1600.0 / 350.0;
    let nepers = 8.685_889_638_065_037;
    for (unit, value) in [
        ('W', 0.5),
        ('M', 0.5 / wavelength_m),
        ('F', 0.5 / wavelength_m / 0.35),
        ('N', 0.5 / wavelength_m / nepers),
        ('Q', std::f64::consts::PI * nepers / 0.5),
        ('L', 0.5 / (std::f64::consts::TAU * nepers)),
    ] {
        let text = changed("'CVW '", &format!("'CV{unit} '")).text("env").unwrap().to_owned();
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let at = lines.iter().position(|line| line.starts_with("'A'")).unwrap() + 1;
        lines[at] = format!("100 1600 0 1.5 {value} /");
        let files = CaseFiles::new(Path::new("case")).with("env", lines.join("\n"));
        let Boundary::Fluid(bottom) = files.read().unwrap().case.section.bottom else {
            panic!("a fluid was expected")
        };
        let found = bottom.attenuation_db_wavelength;
        assert!((found - 0.5).abs() < 1e-12, "{unit}: {found}");
    }
}

/// Numbers of beams that the real program chose (bottom at 100 m).
#[test]
fn zero_beams_are_as_many_as_the_real_program_takes() {
    let beams = |frequency: &str, range_km: &str, run: &str| {
        let text = format!(
            "'x'\n{frequency}\n1\n'CVW'\n0 0 100\n0 1500 /\n100 1500 /\n'R' 0\n1\n30 /\n\
             1\n40 /\n2\n0.01 {range_km} /\n'{run}G'\n0\n-20 20 /\n0 101 3.5\n"
        );
        let files = CaseFiles::new(Path::new("x")).with("env", text);
        files.read().unwrap().case.fan.beams().len()
    };
    assert_eq!(beams("50", "3", "C"), 942);
    assert_eq!(beams("2000", "3", "C"), 1200);
    assert_eq!(beams("20000", "0.2", "I"), 800);
    assert_eq!(beams("2000", "0.2", "A"), 300);
    assert_eq!(beams("350", "3", "E"), 942);
    assert_eq!(beams("350", "3", "R"), 50);
}

fn ascending(count: usize, low: f64, high: f64) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.01..1.0f64, count).prop_map(move |gaps| {
        let total: f64 = gaps.iter().sum();
        let mut at = low;
        gaps.iter()
            .map(|gap| {
                at += gap / total * (high - low);
                at
            })
            .collect()
    })
}

fn boundary() -> impl Strategy<Value = Boundary> {
    let fluid = || {
        (1400.0..3000.0f64, 1.0..3.0f64, 0.0..1.0f64)
            .prop_map(|(speed, density, loss)| FluidHalfSpace::new(speed, density, loss).unwrap())
    };
    prop_oneof![
        Just(Boundary::Vacuum),
        Just(Boundary::Rigid),
        fluid().prop_map(Boundary::Fluid),
        (fluid(), 100.0..1000.0f64, 0.0..1.0f64).prop_map(|(fluid, speed, loss)| {
            Boundary::Elastic(ElasticHalfSpace::new(fluid, speed, loss).unwrap())
        }),
        (ascending(4, 0.0, 90.0), prop::collection::vec(0.0..1.0f64, 4)).prop_map(
            |(angles, moduli)| {
                let phases: Vec<f64> = moduli.iter().map(|r| 180.0 * r).collect();
                Boundary::Table(ReflectionTable::new(angles, moduli, &phases).unwrap())
            }
        ),
    ]
}

fn section() -> impl Strategy<Value = Section> {
    let laws = prop::sample::select(vec![
        ProfileLaw::LinearSpeed,
        ProfileLaw::LinearSquaredIndex,
        ProfileLaw::CubicSpline,
        ProfileLaw::MonotoneCubic,
    ]);
    let absorption = prop::sample::select(vec![
        Absorption::None,
        Absorption::Thorp,
        Absorption::FrancoisGarrison {
            temperature_c: 10.0,
            salinity_psu: 34.5,
            ph: 7.9,
            depth_m: 20.0,
        },
    ]);
    let shape = |smooth| {
        if smooth { InterfaceShape::Curvilinear } else { InterfaceShape::Straight }
    };
    (
        (1..4usize, laws, ascending(5, 20.0, 1000.0), prop::collection::vec(1450.0..1550.0f64, 18)),
        (ascending(4, -9e3, 9e3), prop::collection::vec(500.0..900.0f64, 4), any::<[bool; 4]>()),
        (boundary(), boundary(), absorption, prop::collection::vec(0.0..0.1f64, 6)),
    )
        .prop_map(move |(field, floor, around)| {
            let (columns, law, lower_levels, speeds) = field;
            let levels = [vec![20.0], lower_levels].concat();
            let law = if columns == 1 { law } else { ProfileLaw::LinearSpeed };
            let ranges = [0.0, 2500.0, 7100.0][..columns].to_vec();
            let speeds = speeds[..6 * columns].to_vec();
            let field = SoundSpeedField::new(ranges, levels.clone(), speeds, law).unwrap();
            let (nodes, depths, [smooth, wavy, flat, lossy]) = floor;
            let (surface, bottom, absorption, losses) = around;
            let waves = depths.iter().map(|depth| levels[0] + depth / 100.0).collect();
            let waves = Interface::new(nodes.clone(), waves).unwrap().with_shape(shape(wavy));
            let floor = if flat {
                Interface::flat(levels[5]).unwrap()
            } else {
                Interface::new(nodes, depths).unwrap().with_shape(shape(smooth))
            };
            let mut section = Section::new(field, floor, bottom).unwrap();
            section.surface = surface;
            section.altimetry = wavy.then_some(waves);
            section.absorption = absorption;
            section.attenuation = lossy.then(|| AttenuationProfile::new(levels, losses).unwrap());
            section
        })
}

fn case() -> impl Strategy<Value = Case> {
    let runs = prop::sample::select(vec![
        Run::Field(Coherence::Coherent),
        Run::Field(Coherence::SemiCoherent),
        Run::Field(Coherence::Incoherent),
        Run::Rays,
        Run::Eigenrays,
        Run::Arrivals,
    ]);
    (section(), runs, any::<[bool; 4]>(), 20.0..5000.0f64, ascending(5, 0.0, 9e3), 2..300usize)
        .prop_map(
            |(section, run, [gaussian, centred, line, pairs], frequency_hz, range_m, beams)| {
                let depth_m: Vec<f64> = range_m.iter().map(|range| 400.0 + range / 100.0).collect();
                let receivers = if pairs { Receivers::pairs } else { Receivers::new };
                let shape = if gaussian { BeamShape::Gaussian } else { BeamShape::Hat };
                let coordinates =
                    if centred { BeamCoordinates::RayCentred } else { BeamCoordinates::Cartesian };
                let uneven = LaunchFan::at(&[-50.0, -3.0, 0.1, 77.7]).unwrap();
                let geometry = if line { SourceGeometry::Line } else { SourceGeometry::Point };
                Case {
                    title: "it's a case".to_owned(),
                    frequency_hz,
                    section,
                    source_depth_m: vec![100.0, 333.3],
                    geometry,
                    beam_pattern: line
                        .then(|| BeamPattern::new(vec![-9.0, 0.3], vec![0.0, -3.1]).unwrap()),
                    receivers: receivers(range_m, depth_m).unwrap(),
                    fan: if run == Run::Rays {
                        uneven
                    } else {
                        LaunchFan::uniform(-60.3, 45.1, beams).unwrap()
                    },
                    beams: BeamKind { shape, coordinates },
                    run,
                    settings: TraceSettings::fine(9100.0),
                }
            },
        )
}

/// The words of a text with its numbers apart.
fn words_and_numbers(text: &str) -> (String, Vec<f64>) {
    let (mut words, mut numbers) = (String::new(), Vec::new());
    for token in text.split([' ', ',', ':', '[', ']', '(', ')', '}', '\n']) {
        match token.parse() {
            Ok(number) => numbers.push(number),
            Err(_) => words += token,
        }
    }
    (words, numbers)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]
    /// Units (km, degrees) cost a last digit.
    #[test]
    fn a_case_that_is_written_reads_as_itself(case in case()) {
        let files = CaseFiles::of(&case, Path::new("case")).unwrap();
        let reading = files.read().unwrap();
        prop_assert_eq!(&reading.notes, &Vec::<String>::new());
        let (words, numbers) = words_and_numbers(&format!("{case:?}"));
        let (words_again, numbers_again) = words_and_numbers(&format!("{:?}", reading.case));
        prop_assert_eq!(words, words_again);
        for (a, b) in numbers.iter().zip(&numbers_again) {
            prop_assert!((a - b).abs() <= 1e-11 * (1.0 + a.abs()) || a.to_bits() == b.to_bits(), "{} {}", a, b);
        }
    }
}
