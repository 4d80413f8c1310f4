//! The paper's placement policies.

use crate::ocean::problem;
use rand::Rng;
use sonarfleet::grid::CellId;
use sonarfleet::placement::mdp::{ExchangeMdp, LinkMask, PlacementMdp, SequentialMdp};
use sonarfleet::placement::{Budget, Evaluation, PlacementProblem, Solver};
use sonarfleet::random::stream;
use sonarfleet_learning::placement::paper::{
    PaperPpo, PaperSettings, PlacementTrainer, PlacementTrainerState, Process,
};
use sonarfleet_learning::ppo::PpoSettings;
use std::sync::{Arc, Mutex};

/// Settings for a few cells.
fn toy_settings() -> PaperSettings {
    PaperSettings {
        ppo: PpoSettings {
            num_envs: 16,
            num_steps: 20,
            minibatch_size: 80,
            update_epochs: 4,
            learning_rate: 3e-3,
            final_learning_rate: 3e-4,
            gamma: 1.0,
            final_ent_coef: 0.0,
            ..PpoSettings::paper_placement()
        },
        hidden: vec![64, 64],
        ..PaperSettings::paper()
    }
}

/// Every layout of so many cells out of those from `first` on.
fn layouts(cells: usize, vehicles: usize, first: usize) -> Vec<Vec<CellId>> {
    if vehicles == 0 {
        return vec![Vec::new()];
    }
    (first..cells)
        .flat_map(|cell| {
            layouts(cells, vehicles - 1, cell + 1).into_iter().map(move |mut layout| {
                layout.push(CellId(cell));
                layout
            })
        })
        .collect()
}

fn optimum(problem: &PlacementProblem) -> (Evaluation, usize) {
    let all = layouts(problem.grid().cell_count(), problem.vehicles(), 0);
    let best = all.iter().map(|layout| problem.evaluate(layout)).max_by(Evaluation::compare);
    (best.unwrap(), all.len())
}

/// Out of so many layouts exactly one is optimal, so random search sees it after that
/// many episodes on average. The policy is trained for half as many, and then its most
/// probable layout must be the optimal one.
#[test]
fn the_policy_learns_the_optimum_in_fewer_episodes_than_random_search_needs() {
    let problem = problem(4, 5, 0.6, 3);
    let (best, count) = optimum(&problem);
    assert!(best.feasible);
    let mut optimal = 0;
    for seed in 0..10 {
        let mut trainer = PlacementTrainer::sequential(&problem, &toy_settings(), seed).unwrap();
        let episodes = count as u64 / 2;
        while trainer.episodes() < episodes {
            trainer.update(trainer.episodes() as f64 / episodes as f64);
        }
        let mdp = trainer.mdp();
        let decoded = problem.evaluate(&trainer.policy().decode(mdp, mdp.decisions(), seed));
        println!("seed {seed}: {decoded:?}, best {best:?}");
        optimal += usize::from(decoded.compare(&best).is_eq());
    }
    assert!(optimal >= 9, "{optimal} of 10");
}
