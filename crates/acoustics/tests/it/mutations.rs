//! Ten thousand damaged inputs: no panic, no hang, no giant allocation, and an error that
//! names file and line.

use super::reference::folder;
use sonarfleet_acoustics::bellhop::{ArrivalsFile, CaseFiles, RayFile, ShadeFile, output_file};
use sonarfleet_acoustics::field::LaunchFan;
use sonarfleet_acoustics::model::{Case, Native, Output, PropagationModel};
use std::path::Path;
use std::time::{Duration, Instant};

const ENDINGS: [&str; 7] = ["env", "bty", "ssp", "ati", "brc", "trc", "sbp"];

/// What takes the place of numbers.
const NASTY: [&str; 24] = [
    "nan",
    "inf",
    "-1",
    "1e308",
    "-1e308",
    "1e-308",
    "0",
    "-0.0",
    "1000000000000",
    "99999999",
    "1e9",
    "4294967296",
    "x",
    "'",
    "/",
    ",",
    "!",
    "''",
    "7*",
    "999999999999*1.5",
    "1e999",
    "-90",
    "3",
    "1 2 3",
];

/// What numbers are multiplied by.
const FACTORS: [f64; 10] = [-1.0, 0.01, 0.3, 0.9, 0.999, 1.001, 1.1, 3.0, 100.0, 1e6];

/// A damaged input is read, and solved with few beams, in less time than this: a hundred
/// times what it takes, for busy machines.
const LONGEST: Duration = Duration::from_secs(30);

/// `SplitMix64` (Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }
}

fn damaged(text: &str, dice: &mut Dice) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    if lines.is_empty() {
        return text.to_owned();
    }
    let at = dice.below(lines.len());
    match dice.below(12) {
        0 => {
            lines.remove(at);
        }
        1 => lines.insert(at, lines[at].clone()),
        2 => {
            let other = dice.below(lines.len());
            lines.swap(at, other);
        }
        3 => {
            let mut bytes = text.as_bytes().to_vec();
            let at = dice.below(bytes.len());
            bytes[at] = dice.next() as u8;
            return String::from_utf8_lossy(&bytes).into_owned();
        }
        4 => {
            return String::from_utf8_lossy(&text.as_bytes()[..dice.below(text.len())])
                .into_owned();
        }
        _ => {
            let mut tokens: Vec<&str> = lines[at].split_whitespace().collect();
            if tokens.is_empty() {
                return text.to_owned();
            }
            let token = dice.below(tokens.len());
            let factor = FACTORS[dice.below(FACTORS.len())];
            let number = tokens[token].parse().map(|number: f64| (number * factor).to_string());
            let changed = number.unwrap_or_default();
            let nasty = dice.below(2) == 0 || changed.is_empty();
            tokens[token] = if nasty { NASTY[dice.below(NASTY.len())] } else { &changed };
            lines[at] = tokens.join(" ");
        }
    }
    lines.join("\n")
}

fn seeds() -> Vec<CaseFiles> {
    let features = folder("features");
    let mut paths: Vec<_> = std::fs::read_dir(features)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "env"))
        .collect();
    paths.sort();
    let references = ["scs_cb", "brc_table", "wedge", "munk_ib", "pekeris_i", "free_hat"];
    paths.extend(references.map(|case| folder(case).join("case.env")));
    paths.iter().map(|path| CaseFiles::load(path).unwrap()).collect()
}

/// The case with few beams and few receivers.
fn light(case: Case) -> Option<Case> {
    let beams = case.fan.beams();
    let every = beams.len().div_ceil(4);
    let angles: Vec<f64> =
        beams.iter().step_by(every).map(|beam| beam.angle_rad.to_degrees()).collect();
    let small = case.receivers.count() * case.source_depth_m.len() <= 2000;
    small.then(|| Case { fan: LaunchFan::at(&angles).unwrap(), ..case })
}

#[test]
fn damaged_inputs_are_refused_with_file_and_line_or_solved() {
    let seeds = seeds();
    let mut dice = Dice(7);
    let (mut refused, mut solved) = (0, 0);
    for _ in 0..10_000 {
        let files = &seeds[dice.below(seeds.len())];
        let present: Vec<&str> =
            ENDINGS.into_iter().filter(|ending| files.text(ending).is_some()).collect();
        let ending = present[dice.below(present.len())];
        let mut text = files.text(ending).unwrap().to_owned();
        for _ in 0..=dice.below(2) {
            text = damaged(&text, &mut dice);
        }
        let started = Instant::now();
        match files.clone().with(ending, text.clone()).read() {
            Err(error) => {
                refused += 1;
                let complaint = error.to_string();
                let place = complaint.split(", line ").collect::<Vec<_>>();
                let names_file = ENDINGS.iter().any(|ending| place[0].ends_with(ending));
                assert!(names_file && place.len() > 1, "{complaint}\n{text}");
            }
            Ok(reading) => {
                if let Some(case) = light(reading.case) {
                    let solution = std::panic::catch_unwind(|| Native.solve(&case));
                    let solution = solution.ok();
                    let solution =
                        solution.unwrap_or_else(|| panic!("the panic above is about\n{text}"));
                    solution.unwrap_or_else(|error| panic!("{error}\n{text}"));
                    solved += 1;
                }
            }
        }
        let took = started.elapsed();
        assert!(took < LONGEST, "{took:?} for\n{text}");
    }
    assert!(refused > 3000 && solved > 1000, "{refused} refused, {solved} solved");
}

/// Outputs of small cases, as files.
fn outputs() -> Vec<(&'static str, Vec<u8>, Case)> {
    ["arrivals", "arrivals_binary", "rays", "pairs", "across"]
        .into_iter()
        .map(|name| {
            let files = CaseFiles::load(&folder("features").join(name)).unwrap();
            let reading = files.read().unwrap();
            let case = light(reading.case).unwrap();
            let output = Native.solve(&case).unwrap();
            let binary = reading.binary_arrivals;
            let (ending, bytes) = output_file(&case, &output, binary, "test");
            (ending, bytes, case)
        })
        .collect()
}

#[test]
fn damaged_outputs_are_refused_with_their_place_or_read() {
    let outputs = outputs();
    let mut dice = Dice(11);
    for _ in 0..5000 {
        let (ending, bytes, case) = &outputs[dice.below(outputs.len())];
        let mut bytes = bytes.clone();
        for _ in 0..=dice.below(3) {
            // The beginning holds what counts.
            let end = if dice.below(2) == 0 { bytes.len() } else { bytes.len().min(3000) };
            let at = dice.below(end);
            match dice.below(4) {
                0 => bytes.truncate(at),
                1 => {
                    bytes.remove(at);
                }
                2 => bytes[at] = dice.next() as u8,
                _ => {
                    let word = [i32::MAX, -1, 0, 1, 1_000_000][dice.below(5)].to_le_bytes();
                    let end = bytes.len().min(at / 4 * 4 + 4);
                    bytes.splice(at / 4 * 4..end, word);
                }
            }
            if bytes.is_empty() {
                bytes.push(0);
            }
        }
        let path = Path::new("case").with_extension(ending);
        let problem = match *ending {
            "shd" => ShadeFile::from_bytes(&path, &bytes).err(),
            "arr" => ArrivalsFile::from_bytes(&path, &bytes, case.receivers.layout()).err(),
            _ => RayFile::from_text(&path, &String::from_utf8_lossy(&bytes)).err(),
        };
        if let Some(problem) = problem.map(|problem| problem.to_string()) {
            let place = problem.contains(", line ") || problem.contains(", byte ");
            assert!(problem.starts_with("case.") && place, "{problem}");
        }
    }
}

/// What is written is read as it was, to the precision of the file.
#[test]
fn outputs_read_as_they_were_written() {
    for name in ["arrivals", "arrivals_binary", "rays", "eigenrays", "pairs", "across"] {
        let files = CaseFiles::load(&folder("features").join(name)).unwrap();
        let reading = files.read().unwrap();
        let case = reading.case;
        let output = Native.solve(&case).unwrap();
        let (ending, bytes) = output_file(&case, &output, reading.binary_arrivals, "test");
        let path = Path::new("case").with_extension(ending);
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * (1.0 + a.abs());
        match (&output, ending) {
            (Output::Fields(fields), "shd") => {
                let file = ShadeFile::from_bytes(&path, &bytes).unwrap();
                assert_eq!(file.title, format!("test- {}", case.title));
                assert_eq!(file.to_bytes(), bytes);
                assert_eq!(file.fields.len(), fields.len());
                for (ours, theirs) in fields.iter().zip(&file.fields) {
                    assert_eq!(ours.pressure.len(), theirs.pressure.len());
                    for (a, b) in ours.pressure.iter().zip(&theirs.pressure) {
                        assert!(close(a.re, b.re) && close(a.im, b.im));
                    }
                }
            }
            (Output::Arrivals(arrivals), "arr") => {
                let layout = case.receivers.layout();
                let file = ArrivalsFile::from_bytes(&path, &bytes, layout).unwrap();
                for (ours, theirs) in arrivals.iter().zip(&file.arrivals) {
                    for (a, b) in ours.at.iter().flatten().zip(theirs.at.iter().flatten()) {
                        assert!(close(a.amplitude, b.amplitude) && close(a.delay_s, b.delay_s));
                        assert!(close(a.phase_rad, b.phase_rad));
                        assert!(close(a.absorption_nepers, b.absorption_nepers));
                        assert!(close(a.launch_angle_deg, b.launch_angle_deg));
                        assert_eq!(
                            (a.surface_bounces, a.bottom_bounces),
                            (b.surface_bounces, b.bottom_bounces)
                        );
                    }
                    let counts = |a: &sonarfleet_acoustics::field::Arrivals| -> Vec<usize> {
                        a.at.iter().map(Vec::len).collect()
                    };
                    assert_eq!(counts(ours), counts(theirs));
                }
            }
            (Output::Rays(rays), "ray") => {
                let text = String::from_utf8(bytes).unwrap();
                let file = RayFile::from_text(&path, &text).unwrap();
                let rays: Vec<_> = rays.iter().flatten().collect();
                assert_eq!(rays.len(), file.rays.len());
                for (ours, theirs) in rays.iter().zip(&file.rays) {
                    assert_eq!(ours.points.len(), theirs.points_m.len());
                    for (a, b) in ours.points.iter().zip(&theirs.points_m) {
                        assert!(close(a.range_m, b[0]) && close(a.depth_m, b[1]));
                    }
                }
            }
            (_, other) => panic!("{name} gave .{other}"),
        }
    }
}
