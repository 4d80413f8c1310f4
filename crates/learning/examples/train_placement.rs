//! Trains a policy of the paper on an instance and prints every update:
//! `train_placement INSTANCE.npz sequential|exchange paper|ours|SETTINGS.json EPISODES [SEED]`.

use sonarfleet::placement::{Budget, PlacementProblem, Solver, instance};
use sonarfleet_learning::placement::paper::{PaperPpo, PaperSettings, Process};
use std::sync::Arc;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, process, preset, episodes, rest @ ..] = &arguments[..] else {
        panic!(
            "expected INSTANCE.npz sequential|exchange paper|ours|SETTINGS.json EPISODES [SEED]"
        );
    };
    let problem =
        PlacementProblem::new(&instance::read(path).expect("an instance")).expect("valid");
    let process = if process == "exchange" { Process::Exchange } else { Process::Sequential };
    let settings = match &preset[..] {
        "paper" => PaperSettings::paper(),
        "ours" => PaperSettings::ours(),
        path => {
            let text = std::fs::read_to_string(path).expect("a settings file");
            serde_json::from_str(&text).expect("settings")
        }
    };
    let seed = rest.first().map_or(0, |seed| seed.parse().expect("a seed"));
    let method = PaperPpo::new(process, settings).expect("settings").observed(Arc::new(
        |update, elapsed| {
            println!(
                "{:4} {:6.1} s  {:6} episodes  R {:8.2}  J_d {:6.2}  l2 {:6.3}  feasible {:4.2}  multiplier {:6.2}  H {:5.2}  kl {:6.4}  clip {:5.3}  ev {:6.3}",
                update.update,
                elapsed.as_secs_f64(),
                update.episodes,
                update.mean_return,
                update.detection_utility,
                update.algebraic_connectivity,
                update.feasible,
                update.multiplier,
                update.entropy,
                update.approx_kl,
                update.clip_fraction,
                update.explained_variance,
            );
        },
    ));
    let budget = Budget::Evaluations(episodes.parse().expect("a number of episodes"));
    let placement = method.solve(&problem, budget, seed);
    println!("{:?} after {} episodes", placement.evaluation, placement.evaluations);
}
