//! Environment steps per second, updates included, of sequential PPO with the paper's
//! settings (Table 1): `ppo_throughput INSTANCE.npz UPDATES [DUMP.npz]` prints a JSON
//! object. With a third argument the problem's tables are written there first, for
//! `scripts/compare_ppo.py`, which runs this beside another implementation.

use sonarfleet::npz::{self, NamedArray, Values};
use sonarfleet::placement::mdp::PlacementMdp;
use sonarfleet::placement::{PlacementProblem, instance};
use sonarfleet_learning::placement::paper::{PaperSettings, PlacementTrainer};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, updates, rest @ ..] = &arguments[..] else {
        return Err("expected INSTANCE.npz UPDATES [DUMP.npz]".into());
    };
    let problem = PlacementProblem::new(&instance::read(path)?)?;
    if let Some(path) = rest.first() {
        dump(&problem, path)?;
    }
    let settings = PaperSettings::paper();
    let mut trainer = PlacementTrainer::sequential(&problem, &settings, 0)?;
    let updates: u64 = updates.parse()?;
    // The first update allocates.
    trainer.update(0.0);
    let (start, cpu_start) = (Instant::now(), cpu_seconds());
    for _ in 0..updates {
        trainer.update(0.0);
    }
    let (seconds, cpu_seconds) = (start.elapsed().as_secs_f64(), cpu_seconds() - cpu_start);
    let steps = updates * settings.ppo.rollout_size() as u64;
    let weights = trainer.policy().weights.len();
    println!(
        "{{\"steps\": {steps}, \"seconds\": {seconds:.3}, \"cpu_seconds\": {cpu_seconds:.3}, \
         \"weights\": {weights}, \"decisions\": {}}}",
        trainer.mdp().decisions()
    );
    Ok(())
}

/// Processor time of this process, all threads, in seconds: what `/proc` says, in ticks
/// of 10 ms; 0 where there is none.
fn cpu_seconds() -> f64 {
    let status = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // User and system time are the 12th and 13th field after the command's name.
    let fields = status.rsplit(')').next().unwrap_or_default().split_whitespace();
    fields.skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// Writes detection probabilities and link weights, [cell, cell], the prior, [cell],
/// and (number of vehicles, τ).
fn dump(problem: &PlacementProblem, path: &str) -> Result<(), npz::NpzError> {
    let cells = problem.grid().cell_count();
    let all = || problem.grid().cells();
    let detection: Vec<f64> = all().flat_map(|cell| problem.detection(cell).to_vec()).collect();
    let links: Vec<f64> = all().flat_map(|cell| problem.links(cell).to_vec()).collect();
    let parameters = [problem.vehicles() as f64, problem.connectivity_threshold()];
    let array = |key, shape, values| NamedArray { key, shape, values: Values::F64(values) };
    npz::write(
        path,
        &[
            array("detection", &[cells, cells], &detection),
            array("links", &[cells, cells], &links),
            array("prior", &[cells], problem.prior().values()),
            array("parameters", &[2], &parameters),
        ],
    )
}
