//! The native engine against real BELLHOP programs and closed forms
//! (`tests/data/README.md`).

use sonarfleet_acoustics::bellhop::{ArrivalsFile, read_case};
use sonarfleet_acoustics::field::Arrival;
use sonarfleet_acoustics::model::{Case, Native, Output, PropagationModel};
use sonarfleet_acoustics::ray::Ray;
use std::path::PathBuf;

pub(crate) fn folder(case: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(case)
}

pub(crate) fn read(case: &str) -> Case {
    read_case(&folder(case).join("case.env")).unwrap()
}

/// A column of a case's table by name.
pub(crate) fn column(case: &str, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(folder(case).join("case.csv")).unwrap();
    let mut rows = text.lines();
    let index = rows.next().unwrap().split(',').position(|header| header == name).unwrap();
    rows.map(|row| row.split(',').nth(index).unwrap().parse().unwrap()).collect()
}

/// Median, 90th and 99th percentile of absolute differences, dB.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Differences([f64; 3]);

impl Differences {
    /// Where the reference is a loss under 90 dB.
    fn between(ours: &[f64], reference: &[f64]) -> Self {
        assert_eq!(ours.len(), reference.len());
        let mut all: Vec<f64> = ours
            .iter()
            .zip(reference)
            .filter(|(_, reference)| **reference < 90.0)
            .map(|(ours, reference)| (ours - reference).abs())
            .collect();
        assert!(all.len() > 150);
        all.sort_by(f64::total_cmp);
        Self([0.5, 0.9, 0.99].map(|q| all[((all.len() - 1) as f64 * q) as usize]))
    }

    fn within(self, limits: [f64; 3]) -> bool {
        self.0.iter().zip(limits).all(|(difference, limit)| *difference <= limit)
    }
}

fn loss_db(case: &str) -> Vec<f64> {
    let Output::Fields(fields) = Native.solve(&read(case)).unwrap() else {
        panic!("a field was expected")
    };
    fields[0].loss_db()
}

/// What two correct programs may differ by in incoherent fields under 90 dB.
const INCOHERENT_DB: [f64; 3] = [0.05, 0.25, 0.7];

/// Coherent fields where sound has gone through few beams.
const COHERENT_DB: [f64; 3] = [0.05, 0.25, 0.7];

/// Coherent fields over rough floors or in range-dependent water, where real
/// programs differ from each other, and with the length of their steps, by up to 0.07, 0.4
/// and 1.7 dB: nulls move with micrometres of geometry.
const COHERENT_ROUGH_DB: [f64; 3] = [0.08, 0.35, 0.8];

/// How much farther from a closed form than the real program a field may be, in
/// the median.
const ANALYTIC_EXCESS_DB: f64 = 0.01;

fn check(case: &str, limits: [f64; 3]) {
    check_against("tl_db_aubellhop", case, limits);
}

fn check_against(program: &str, case: &str, limits: [f64; 3]) {
    let found = Differences::between(&loss_db(case), &column(case, program));
    println!("{case}: {:.4?}", found.0);
    assert!(found.within(limits), "{case}: {:?} exceeds {limits:?}", found.0);
}

#[test]
fn incoherent_fields_are_bellhops() {
    for case in [
        "scs_ib",
        "scs_direct",
        "munk_ib",
        "pekeris_i",
        "n2linear_i",
        "clinear",
        "scs_iraycen",
        "curvilinear_floor",
        "curvilinear_surface",
        "line_source",
        "elastic",
        "attenuation",
        "francois_garrison",
        "backscatter",
    ] {
        check(case, INCOHERENT_DB);
    }
}

#[test]
fn semi_coherent_fields_are_bellhops() {
    check("scs_semi", INCOHERENT_DB);
    check("beam_pattern", INCOHERENT_DB);
}

#[test]
fn coherent_fields_are_bellhops() {
    for case in [
        "free_hat",
        "free_gauss",
        "free_raycen",
        "lloyd",
        "lloyd_hat",
        "n2linear_b",
        "spline",
        "monotone_cubic",
        "pekeris_c",
        "munk_cb",
        "munk_cg",
        "wedge",
        "brc_table",
    ] {
        check(case, COHERENT_DB);
    }
    check("scs_cb", COHERENT_ROUGH_DB);
    // Receivers stand on the nodes of the sea floor, where this program counts beams as it
    // should.
    check_against("tl_db_at2023", "seamount", COHERENT_ROUGH_DB);
}

#[test]
fn fields_are_as_near_to_closed_forms_as_bellhops() {
    for case in
        ["free_hat", "free_gauss", "free_raycen", "lloyd", "lloyd_hat", "n2linear_i", "clinear"]
    {
        let exact = column(case, "tl_db_analytic");
        let ours = Differences::between(&loss_db(case), &exact);
        let theirs = Differences::between(&column(case, "tl_db_aubellhop"), &exact);
        println!("{case}: ours {:.4?}, BELLHOP {:.4?}", ours.0, theirs.0);
        assert!(ours.0[0] <= theirs.0[0] + ANALYTIC_EXCESS_DB, "{case}");
    }
}

/// What arrives together with an arrival: amplitude, and the means that it weighs of delay,
/// launch and arrival angle. Programs may take two beams for one arrival or for two.
fn together(arrivals: &[Arrival], with: &Arrival) -> [f64; 4] {
    let together = arrivals.iter().filter(|one| {
        (one.surface_bounces, one.bottom_bounces) == (with.surface_bounces, with.bottom_bounces)
            && (one.delay_s - with.delay_s).abs() < 1.5e-4
            && (one.launch_angle_deg - with.launch_angle_deg).abs() < 0.1
            && (one.phase_rad - with.phase_rad).abs() < 0.05
    });
    let mut sums = together.fold([0.0; 4], |sums, one| {
        let a = one.amplitude;
        [
            sums[0] + a,
            sums[1] + a * one.delay_s,
            sums[2] + a * one.launch_angle_deg,
            sums[3] + a * one.arrival_angle_deg,
        ]
    });
    for k in 1..4 {
        sums[k] /= sums[0];
    }
    sums
}

/// BELLHOP's arrivals over a slope that are not weak have their like among ours.
#[test]
fn arrivals_are_bellhops() {
    let case = read("scs_arr");
    let Output::Arrivals(of_sources) = Native.solve(&case).unwrap() else {
        panic!("arrivals were expected")
    };
    let path = folder("scs_arr").join("case.arr");
    let bytes = std::fs::read(&path).unwrap();
    let file = ArrivalsFile::from_bytes(&path, &bytes, case.receivers.layout()).unwrap();
    let (mut compared, mut counted) = (0, [0usize; 2]);
    for (ours, theirs) in of_sources[0].at.iter().zip(&file.arrivals[0].at) {
        counted[0] += ours.len();
        counted[1] += theirs.len();
        let strongest = theirs.iter().map(|arrival| arrival.amplitude).fold(0.0, f64::max);
        for arrival in theirs.iter().filter(|one| one.amplitude > 0.05 * strongest) {
            let (a, b) = (together(ours, arrival), together(theirs, arrival));
            let close = (20.0 * (a[0] / b[0]).log10()).abs() < 0.1
                && (a[1] - b[1]).abs() < 5e-5
                && (a[2] - b[2]).abs() < 0.01
                && (a[3] - b[3]).abs() < 0.1;
            assert!(close, "{arrival:?}: {a:?}, BELLHOP {b:?}");
            compared += 1;
        }
    }
    println!("{compared} compared of {counted:?}");
    assert!(compared > 40);
    assert!(counted[0].abs_diff(counted[1]) <= 3, "{counted:?}");
}

/// Rays over a slope in range-dependent water.
#[test]
fn rays_over_a_slope_are_bellhops() {
    let Output::Rays(of_sources) = Native.solve(&read("scs_rays")).unwrap() else {
        panic!("rays were expected")
    };
    let [launch, range, depth] =
        ["launch_deg", "range_m", "depth_m_aubellhop"].map(|name| column("scs_rays", name));
    let mut compared = 0;
    for ((launch, range), depth) in launch.iter().zip(&range).zip(&depth) {
        let same = |ray: &&Ray| (ray.launch_angle_deg - launch).abs() < 1e-6;
        let ray = of_sources[0].iter().find(same).unwrap();
        let Some(ours) = super::analytic::depth_at(ray, *range) else { continue };
        // Bounces magnify what steps of 20 m leave out.
        let tolerance_m = if *range < 10_000.0 { 0.12 } else { 0.5 };
        assert!((ours - depth).abs() < tolerance_m, "{launch}° {range} m: {ours} {depth}");
        compared += 1;
    }
    assert!(compared > 2000, "{compared}");
}
