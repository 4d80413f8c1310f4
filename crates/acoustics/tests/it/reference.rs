//! The native engine against real BELLHOP programs and closed forms
//! (`tests/data/README.md`).

use sonarfleet_acoustics::bellhop::read_case;
use sonarfleet_acoustics::model::{Case, Native, Output, PropagationModel};
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
        assert!(all.len() > 200);
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
/// programs differ from each other by up to 0.06, 0.4 and 1.7 dB: nulls move
/// with micrometres of geometry.
const COHERENT_ROUGH_DB: [f64; 3] = [0.25, 1.0, 2.5];

/// How much farther from a closed form than the real program a field may be, in
/// the median.
const ANALYTIC_EXCESS_DB: f64 = 0.01;

fn check(case: &str, limits: [f64; 3]) {
    let found = Differences::between(&loss_db(case), &column(case, "tl_db_aubellhop"));
    println!("{case}: {:.4?}", found.0);
    assert!(found.within(limits), "{case}: {:?} exceeds {limits:?}", found.0);
}

#[test]
fn incoherent_fields_are_bellhops() {
    for case in ["scs_ib", "scs_direct", "munk_ib", "pekeris_i", "n2linear_i", "clinear"] {
        check(case, INCOHERENT_DB);
    }
}

#[test]
fn semi_coherent_fields_are_bellhops() {
    check("scs_semi", INCOHERENT_DB);
}

#[test]
fn coherent_fields_are_bellhops() {
    for case in [
        "free_hat",
        "free_gauss",
        "lloyd",
        "lloyd_hat",
        "n2linear_b",
        "pekeris_c",
        "munk_cb",
        "munk_cg",
        "wedge",
        "brc_table",
    ] {
        check(case, COHERENT_DB);
    }
    for case in ["seamount", "scs_cb"] {
        check(case, COHERENT_ROUGH_DB);
    }
}

#[test]
fn fields_are_as_near_to_closed_forms_as_bellhops() {
    for case in ["free_hat", "free_gauss", "lloyd", "lloyd_hat", "n2linear_i", "clinear"] {
        let exact = column(case, "tl_db_analytic");
        let ours = Differences::between(&loss_db(case), &exact);
        let theirs = Differences::between(&column(case, "tl_db_aubellhop"), &exact);
        println!("{case}: ours {:.4?}, BELLHOP {:.4?}", ours.0, theirs.0);
        assert!(ours.0[0] <= theirs.0[0] + ANALYTIC_EXCESS_DB, "{case}");
    }
}
