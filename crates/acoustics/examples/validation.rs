//! How far our fields are from those of real programs and from closed forms, case by
//! case of `tests/data`, as the Markdown table of `docs/validation.md`.
//!
//!     cargo run --release -p sonarfleet-acoustics --example validation

use sonarfleet_acoustics::bellhop::read_case;
use sonarfleet_acoustics::field::Field;
use sonarfleet_acoustics::model::{Native, Output, PropagationModel};
use std::path::{Path, PathBuf};

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Where the real BELLHOP's loss is above this, nothing is compared, dB.
const COMPARED_LOSS_DB: f64 = 90.0;

const BELLHOP: &str = "tl_db_aubellhop";

fn main() -> Outcome<()> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let mut folders: Vec<PathBuf> =
        std::fs::read_dir(data)?.map(|entry| Ok(entry?.path())).collect::<Outcome<_>>()?;
    folders.sort();
    println!(
        "| case | ours − BELLHOP | Toolbox 2023 − BELLHOP | cxx − BELLHOP | ours − exact | BELLHOP − exact |"
    );
    println!("|---|---|---|---|---|---|");
    for folder in folders {
        if let Some(row) = row(&folder)? {
            println!("{row}");
        }
    }
    Ok(())
}

/// The row of a case that is a field with a table of losses.
fn row(folder: &Path) -> Outcome<Option<String>> {
    let Ok(text) = std::fs::read_to_string(folder.join("case.csv")) else { return Ok(None) };
    let Output::Fields(fields) = Native.solve(&read_case(&folder.join("case.env"))?)? else {
        return Ok(None);
    };
    let Some(theirs) = column(&text, BELLHOP) else { return Ok(None) };
    let ours: Vec<f64> = fields.iter().flat_map(Field::loss_db).collect();
    if ours.len() != theirs.len() {
        return Err(
            format!("{}: {} losses for {}", folder.display(), ours.len(), theirs.len()).into()
        );
    }
    let from_bellhop = |name: &str| {
        column(&text, name).map_or(String::new(), |other| apart(&other, &theirs, &theirs))
    };
    let from_exact = |losses: &[f64]| {
        let exact = column(&text, "tl_db_analytic");
        exact.map_or(String::new(), |exact| apart(losses, &exact, &theirs))
    };
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    Ok(Some(format!(
        "| `{name}` | {} | {} | {} | {} | {} |",
        apart(&ours, &theirs, &theirs),
        from_bellhop("tl_db_at2023"),
        from_bellhop("tl_db_bellhopcxx"),
        from_exact(&ours),
        from_exact(&theirs),
    )))
}

/// A column of a case's table, if it has one of this name.
fn column(text: &str, name: &str) -> Option<Vec<f64>> {
    let mut rows = text.lines();
    let index = rows.next()?.split(',').position(|header| header == name)?;
    rows.map(|row| row.split(',').nth(index)?.parse().ok()).collect()
}

/// Median / 90th percentile / 99th percentile / largest difference, dB.
fn apart(losses: &[f64], reference: &[f64], theirs: &[f64]) -> String {
    let mut all: Vec<f64> = losses
        .iter()
        .zip(reference)
        .zip(theirs)
        .filter(|(_, bellhop)| **bellhop < COMPARED_LOSS_DB)
        .map(|((a, b), _)| (a - b).abs())
        .filter(|difference| difference.is_finite())
        .collect();
    all.sort_by(f64::total_cmp);
    let Some(last) = all.len().checked_sub(1) else { return String::new() };
    let [a, b, c, d] = [0.5, 0.9, 0.99, 1.0].map(|q| all[(last as f64 * q) as usize]);
    format!("{a:.3} / {b:.3} / {c:.2} / {d:.2}")
}
