//! The policy that serves any problem.

use crate::ocean::problem;
use rayon::ThreadPoolBuilder;
use sonarfleet::placement::annealing::Annealing;
use sonarfleet::placement::{Budget, PlacementProblem, Solver};
use sonarfleet_learning::files::checkpoint;
use sonarfleet_learning::placement::transferable::{
    Progress, School, Training, TrainingSettings, TransferablePolicy,
};

/// Small enough for a test, with both stages.
fn short() -> TrainingSettings {
    TrainingSettings {
        seed: 3,
        taught: 3,
        teacher_evaluations: 2000,
        imitation_updates: 3,
        imitation_episodes: 2,
        updates: 3,
        groups: 2,
        rollouts: 4,
        ..TrainingSettings::default()
    }
}

fn practice(index: u64) -> PlacementProblem {
    problem(9, 8, 0.5, index)
}

/// All steps of a training; after each of `stops` steps it goes through a file.
fn trained(stops: &[usize]) -> (Training, Vec<Progress>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint.bin");
    let mut training = Training::new(short());
    let (mut school, mut told) = (School::default(), Vec::new());
    while let Some(progress) = training.step(&practice, &mut school) {
        told.push(progress);
        if stops.contains(&told.len()) {
            checkpoint::save(&path, "test", &training).unwrap();
            training = checkpoint::load(&path, "test").unwrap();
            school = School::default();
        }
    }
    (training, told)
}

#[test]
fn a_training_that_was_stopped_ends_as_one_that_was_not() {
    let (whole, told) = trained(&[]);
    assert_eq!(told.len(), 1 + 3 + 3);
    let (resumed, again) = trained(&[1, 2, 5]);
    assert_eq!(whole, resumed);
    assert_eq!(told, again);
}

#[test]
fn training_and_decoding_do_not_depend_on_threads() {
    let policy = TransferablePolicy::shipped();
    let problem = problem(12, 12, 0.8, 5);
    let [one, two] = [1, 2].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| (trained(&[]), policy.samples(&problem, 4)))
    });
    assert_eq!(one, two);
}

#[test]
fn layouts_keep_to_the_problem() {
    let policy = TransferablePolicy::shipped();
    for seed in 0..4 {
        let problem = problem(8 + seed as usize, 6 + 5 * seed as usize, 0.7, seed);
        let samples = policy.samples(&problem, seed);
        assert_eq!(samples.len(), policy.decoding.samples());
        for sample in &samples {
            let mut cells = sample.layout.clone();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells.len(), problem.vehicles());
            assert!(cells.iter().all(|cell| problem.deployable().contains(cell)));
            assert_eq!(sample.evaluation, problem.evaluate(&sample.layout));
        }
        let best = &samples[0].evaluation;
        assert!(samples.iter().all(|sample| sample.evaluation.compare(best).is_le()));
    }
}

/// On oceans unlike those it was trained on, and without any search.
#[test]
fn the_shipped_policy_is_near_what_annealing_finds() {
    const LEAST_SHARE: f64 = 0.95;
    let policy = TransferablePolicy::shipped();
    for seed in 0..4 {
        let problem = problem(14, 16, 0.8, 20 + seed);
        let placed = policy.solve(&problem, Budget::Evaluations(64), 1);
        let annealed = Annealing::default().solve(&problem, Budget::Evaluations(200_000), 1);
        assert!(placed.evaluation.feasible, "{:?}", placed.evaluation);
        let share = placed.evaluation.detection_utility / annealed.evaluation.detection_utility;
        assert!(share >= LEAST_SHARE, "problem {seed}: {share}");
    }
}
