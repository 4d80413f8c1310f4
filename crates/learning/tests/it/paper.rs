//! The paper's placement policies.

use crate::ocean::problem;
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use sonarfleet::grid::CellId;
use sonarfleet::placement::mdp::{ExchangeMdp, LinkMask, PlacementMdp, SequentialMdp};
use sonarfleet::placement::{Budget, Evaluation, PlacementProblem, Solver};
use sonarfleet_learning::placement::paper::{
    PaperPpo, PaperSettings, PlacementTrainer, PlacementTrainerState, PlacementUpdate, Process,
};
use sonarfleet_learning::ppo::PpoSettings;
use std::f64::consts::LN_10;
use std::sync::{Arc, Mutex};

/// Double precision over a few dozen targets, in another order of the vehicles.
const ROUNDING: f64 = 1e-12;

/// Settings for a few cells.
fn toy_settings() -> PaperSettings {
    PaperSettings {
        ppo: PpoSettings {
            num_envs: 32,
            num_steps: 20,
            minibatch_size: 160,
            update_epochs: 6,
            learning_rate: 2e-3,
            final_learning_rate: 3e-4,
            gamma: 1.0,
            ent_coef: 0.2,
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

/// The best layout's evaluation, and the number of layouts.
fn optimum(problem: &PlacementProblem) -> (Evaluation, usize) {
    let all = layouts(problem.grid().cell_count(), problem.vehicles(), 0);
    let best = all.iter().map(|layout| problem.evaluate(layout)).max_by(Evaluation::compare);
    (best.unwrap(), all.len())
}

/// One of N layouts is optimal, so random search has seen it in 9 of 10 runs after
/// N·ln 10 episodes, and after N on average. The policy is trained for N episodes; then
/// its most probable layout must be the optimal one.
#[test]
fn the_policy_learns_the_optimum_in_fewer_episodes_than_random_search_needs() {
    let problem = problem(4, 5, 0.6, 4);
    let (best, count) = optimum(&problem);
    assert!(best.feasible);
    let runs: Vec<(u64, Evaluation)> = (0..10_u64)
        .into_par_iter()
        .map(|seed| {
            let mut trainer =
                PlacementTrainer::sequential(&problem, &toy_settings(), seed).unwrap();
            while trainer.episodes() < count as u64 {
                trainer.update(trainer.episodes() as f64 / count as f64);
            }
            let mdp = trainer.mdp();
            let decoded = trainer.policy().decode(mdp, mdp.decisions(), seed);
            (trainer.episodes(), problem.evaluate(&decoded))
        })
        .collect();
    let random_search = (count as f64 * LN_10) as u64;
    assert!(runs.iter().all(|(episodes, _)| *episodes < random_search));
    let optimal = runs.iter().filter(|(_, found)| {
        found.feasible && (found.detection_utility - best.detection_utility).abs() < ROUNDING
    });
    assert!(optimal.count() >= 9, "{best:?} {runs:?}");
}

fn weights<M: PlacementMdp>(trainer: &PlacementTrainer<M>) -> Vec<u32> {
    trainer.policy().weights.iter().map(|weight| weight.to_bits()).collect()
}

/// A network and minibatches of several tasks each.
fn many_tasks() -> PaperSettings {
    PaperSettings { hidden: vec![128, 128], ..toy_settings() }
}

#[test]
fn one_thread_and_two_learn_the_same_bits() {
    let problem = problem(6, 5, 0.6, 1);
    let learn = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut trainer = PlacementTrainer::sequential(&problem, &many_tasks(), 7).unwrap();
            let updates: Vec<PlacementUpdate> =
                (0..3).map(|update| trainer.update(f64::from(update) / 3.0)).collect();
            (weights(&trainer), updates)
        })
    };
    assert_eq!(learn(1), learn(2));
}

/// Four updates are two, a checkpoint, and two more: for both processes.
#[test]
fn a_resumed_training_goes_on_with_the_same_bits() {
    fn check<M: PlacementMdp>(mdp: impl Fn() -> M) {
        let settings = PaperSettings { warm_up_episodes: 150, ..many_tasks() };
        let mut whole = PlacementTrainer::new(mdp(), &settings, 3).unwrap();
        let updates: Vec<_> = (0..4).map(|_| whole.update(0.5)).collect();

        let mut first = PlacementTrainer::new(mdp(), &settings, 3).unwrap();
        let mut again: Vec<_> = (0..2).map(|_| first.update(0.5)).collect();
        let bytes = postcard::to_stdvec(&first.state()).unwrap();
        drop(first);
        let state: PlacementTrainerState<M::State> = postcard::from_bytes(&bytes).unwrap();
        let mut second = PlacementTrainer::resume(mdp(), &settings, state).unwrap();
        again.extend((0..2).map(|_| second.update(0.5)));

        assert_eq!(again, updates);
        assert_eq!(weights(&second), weights(&whole));
        let bytes = |trainer: &PlacementTrainer<M>| postcard::to_stdvec(&trainer.state()).unwrap();
        assert_eq!(bytes(&second), bytes(&whole));
    }
    // Episodes of 7 steps do not divide the rollouts of 20.
    let problem = problem(5, 7, 0.6, 2);
    check(|| SequentialMdp::new(&problem));
    check(|| {
        let mut mdp = ExchangeMdp::new(&problem);
        mdp.swaps = 3;
        mdp
    });
}

#[test]
fn the_first_episodes_are_rewarded_without_the_constraint() {
    let problem = problem(5, 5, 50.0, 2);
    let first = |warm_up_episodes: u64| {
        let settings = PaperSettings { warm_up_episodes, ..toy_settings() };
        PlacementTrainer::sequential(&problem, &settings, 1).unwrap().update(0.0)
    };
    let (warm, half, cold) = (first(128), first(64), first(0));
    assert_eq!(warm.episodes, 128);
    assert!((warm.mean_return - warm.detection_utility).abs() < 1e-5);
    let penalty = 5.0 * (50.0 - cold.algebraic_connectivity);
    assert!((cold.mean_return - (cold.detection_utility - penalty)).abs() < 1e-4);
    let share = (warm.mean_return - half.mean_return) / (warm.mean_return - cold.mean_return);
    assert!((share - 0.5).abs() < 0.01, "half of the episodes, {share}");
}

/// Equation (11): once per rollout, with the mean of the signed slack.
#[test]
fn the_multiplier_moves_by_the_mean_slack() {
    let problem = problem(5, 5, 0.6, 2);
    let mut trainer = PlacementTrainer::sequential(&problem, &toy_settings(), 1).unwrap();
    for _ in 0..3 {
        let update = trainer.update(0.0);
        let expected = update.multiplier + 0.5 * (0.6 - update.algebraic_connectivity);
        assert!((trainer.multiplier() - expected.max(0.0)).abs() < 1e-12);
    }
}

#[test]
fn fewer_steps_of_a_policy_place_the_first_vehicles() {
    let problem = problem(5, 8, 0.6, 2);
    let trainer = PlacementTrainer::sequential(&problem, &toy_settings(), 1).unwrap();
    let (policy, mdp) = (trainer.policy(), trainer.mdp());
    let whole = policy.decode(mdp, 8, 0);
    assert_eq!(policy.decode(mdp, 5, 0), whole[..5]);
    assert_eq!(policy.sample(mdp, 5, 0, 3), policy.sample(mdp, 8, 0, 3)[..5]);
    assert_ne!(policy.sample(mdp, 8, 0, 0), policy.sample(mdp, 8, 0, 1));
}

/// Both processes learn as solvers: better than the mean of random layouts from the
/// first rollout on, watched, in whole rollouts.
#[test]
fn both_processes_solve() {
    let problem = problem(5, 5, 0.6, 2);
    let ours = PaperSettings {
        link_mask: Some(LinkMask { degree: 1.0, share: 0.5 }),
        initial_detection_weight: 0.2,
        log_shortfall_weight: 3.0,
        ..toy_settings()
    };
    for (process, name) in
        [(Process::Sequential, "sequential-ppo"), (Process::Exchange, "exchange-ppo")]
    {
        let log = Arc::new(Mutex::new(Vec::<PlacementUpdate>::new()));
        let observer = Arc::clone(&log);
        let settings = PaperSettings {
            ppo: PpoSettings { num_steps: 80, minibatch_size: 640, ..ours.ppo.clone() },
            ..ours.clone()
        };
        let method = PaperPpo::new(process, settings).unwrap().observed(Arc::new(
            move |update: &PlacementUpdate, _| observer.lock().unwrap().push(update.clone()),
        ));
        let placement = method.solve(&problem, Budget::Evaluations(1500), 1);
        assert_eq!(placement.method, name);
        assert!(placement.evaluation.feasible);
        assert!(placement.history.is_sorted_by(|a, b| a.0 <= b.0 && a.1 < b.1));
        let log = log.lock().unwrap().clone();
        assert_eq!(log.last().unwrap().episodes + 1, placement.evaluations);
        assert!(placement.evaluations > 1500);
        let (first, last) = (&log[0], &log[log.len() - 1]);
        let worth = |update: &PlacementUpdate| update.feasible * update.detection_utility;
        assert!(worth(last) > worth(first), "{name}: {first:?} {last:?}");
        assert!(placement.evaluation.detection_utility > first.detection_utility);
        assert_eq!(method.solve(&problem, Budget::Evaluations(1500), 1), placement);
    }
}
