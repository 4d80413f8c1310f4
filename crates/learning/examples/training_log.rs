//! Logs a made-up training that is killed after ten updates and resumed from its
//! checkpoint of the eighth: `training_log DIR`. `scripts/check_training_files.py`
//! compares what TensorBoard reads of it with `metrics.jsonl`.

use sonarfleet_learning::files::{TrainingLog, checkpoint};
use std::error::Error;
use std::path::{Path, PathBuf};

const KIND: &str = "example";

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args_os().nth(1).ok_or("usage: training_log DIR")?.into();
    train(&folder, 0, 10)?;
    let done = checkpoint::load(&folder.join("checkpoint.bin"), KIND)?;
    train(&folder, done, 12)
}

/// Updates from the first that is not done yet, with a checkpoint every fourth.
fn train(folder: &Path, done: u64, last: u64) -> Result<(), Box<dyn Error>> {
    let mut log = TrainingLog::open(folder, done)?;
    for update in done + 1..=last {
        let x = update as f64 / 10.0;
        // The explained variance is not defined before the critic has seen anything.
        let explained = if update == 1 { f64::NAN } else { x.tanh() };
        let scalars = [
            ("reward", 30.0 * x.tanh()),
            ("approx_kl", 0.01 * (-x).exp()),
            ("explained_variance", explained),
        ];
        let rollout = 0.5 + 0.001 * done as f64; // another machine, another pace
        log.write(update, update * 4096, &scalars, &[("rollout", rollout), ("learning", 0.25)])?;
        if update % 4 == 0 {
            checkpoint::save(&folder.join("checkpoint.bin"), KIND, &update)?;
        }
    }
    Ok(())
}
