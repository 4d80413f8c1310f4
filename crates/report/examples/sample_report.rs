//! Draws the figures and the report of a made-up run, the curve of a training, and
//! comparisons of methods:
//! `cargo run -p sonarfleet-report --example sample_report -- DIR`.

#[path = "../tests/sample/mod.rs"]
mod sample;

use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let directory = PathBuf::from(std::env::args_os().nth(1).ok_or("usage: sample_report DIR")?);
    let record = sample::record(sample::FULL);
    for file in sonarfleet_report::write_figures(&record, &directory)? {
        println!("{}", file.display());
    }
    let training = sample::training(5, 118);
    for file in sonarfleet_report::write_training(&training, directory.join("training"))? {
        println!("{}", file.display());
    }
    let comparisons = [
        sonarfleet_report::write_layouts(&sample::layouts(30, 30), directory.join("layouts"))?,
        sonarfleet_report::write_chart(&sample::chart(2, 3, 40), directory.join("chart"))?,
        sonarfleet_report::write_scores(&sample::scores(3), directory.join("scores"))?,
    ];
    for file in comparisons.iter().flatten() {
        println!("{}", file.display());
    }
    let report = directory.join("report.html");
    sonarfleet_report::write_report(&record, &report)?;
    println!("{}", report.display());
    Ok(())
}
