//! The placement problem and its solvers on synthetic oceans small enough for
//! brute force, and on one of the size of a real problem.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rand::Rng;
use sonarfleet::grid::{CellId, SurveillanceGrid};
use sonarfleet::placement::annealing::Annealing;
use sonarfleet::placement::bound::upper_bound;
use sonarfleet::placement::compact::best_disc;
use sonarfleet::placement::coverage::Coverage;
use sonarfleet::placement::genetic::Genetic;
use sonarfleet::placement::greedy::{ConnectedGreedy, Greedy};
use sonarfleet::placement::local_search::LocalSearch;
use sonarfleet::placement::network::Network;
use sonarfleet::placement::particle_swarm::ParticleSwarm;
use sonarfleet::placement::population::Start;
use sonarfleet::placement::random::RandomSearch;
use sonarfleet::placement::{
    Budget, Placement, PlacementInput, PlacementProblem, SCORING_MULTIPLIER, Solver,
};
use sonarfleet::random::stream;
use sonarfleet::sonar::detection::{DetectionModel, FalseAlarmProbability, PassiveSonar};
use sonarfleet::sonar::link::{LinkModel, Modem};
use sonarfleet::sonar::noise::NoiseLevel;
use sonarfleet::sonar::prior::TargetPrior;

/// Single precision over a few hundred targets.
const SEARCH_ROUNDING: f64 = 2e-5;

/// Double precision over a few hundred targets.
const ROUNDING: f64 = 1e-11;

/// An ocean in which sound loses 5 dB per cell, more or less.
pub(crate) fn synthetic(side: usize, vehicles: usize, seed: u64) -> PlacementInput {
    let grid =
        SurveillanceGrid { columns: side, rows: side, cell_width_m: 1000.0, cell_height_m: 1000.0 };
    let cells = grid.cell_count();
    let mut random = stream(seed, "test/ocean", 0);
    let mut losses_db = vec![0.0; cells * cells];
    for p in grid.cells() {
        for q in grid.cells() {
            let cells_apart = grid.centre(p).distance_m(grid.centre(q)) / 1000.0;
            losses_db[p.0 * cells + q.0] =
                (55.0 + 5.0 * cells_apart + random.random_range(-1.5..1.5)) as f32;
        }
    }
    let prior = (0..cells).map(|_| random.random_range(0.0..0.5)).collect();
    PlacementInput {
        grid,
        prior: TargetPrior::new(prior).unwrap(),
        detection_loss_db: losses_db,
        communication_loss_db: None,
        sonar: PassiveSonar {
            source_level_db: 130.0,
            noise_level_db: NoiseLevel::Uniform(65.0),
            directivity_index_db: 0.0,
            detection_threshold_db: 0.0,
            model: DetectionModel::MeanShift(FalseAlarmProbability::new(1e-3).unwrap()),
        },
        modem: Modem {
            source_level_db: 138.0,
            noise_level_db: NoiseLevel::Uniform(65.0),
            model: LinkModel::CoherentBpsk { packet_bits: 256 },
        },
        vehicles,
        connectivity_threshold: 0.95,
        deployable: None,
        fixed_sensors: Vec::new(),
    }
}

fn problem(side: usize, vehicles: usize, seed: u64) -> PlacementProblem {
    PlacementProblem::new(&synthetic(side, vehicles, seed)).unwrap()
}

/// All layouts of `vehicles` cells out of `cells`.
fn all_layouts(cells: &[CellId], vehicles: usize) -> Vec<Vec<CellId>> {
    if vehicles == 0 {
        return vec![Vec::new()];
    }
    (0..cells.len())
        .flat_map(|first| {
            all_layouts(&cells[first + 1..], vehicles - 1).into_iter().map(move |mut layout| {
                layout.push(cells[first]);
                layout
            })
        })
        .collect()
}

fn best_feasible(problem: &PlacementProblem) -> Option<f64> {
    all_layouts(problem.deployable(), problem.vehicles())
        .iter()
        .map(|layout| problem.evaluate(layout))
        .filter(|evaluation| evaluation.feasible)
        .map(|evaluation| evaluation.detection_utility)
        .reduce(f64::max)
}

#[test]
fn evaluation_is_the_papers_equations_summed_by_hand() {
    let input = synthetic(3, 3, 1);
    let problem = PlacementProblem::new(&input).unwrap();
    for layout in all_layouts(problem.deployable(), 3) {
        let mut utility = 0.0;
        for target in 0..9 {
            let mut missed_by_all = 1.0;
            for sensor in &layout {
                let snr_db =
                    130.0 - f64::from(input.detection_loss_db[sensor.0 * 9 + target]) - 65.0;
                let shift = (2.0 * 10.0_f64.powf(snr_db / 10.0)).sqrt();
                // Q⁻¹(10⁻³) and Q from tables, not from the code under test.
                let x = 3.090_232_306_167_813 - shift;
                missed_by_all *= 1.0 - 0.5 * libm::erfc(x / 2.0_f64.sqrt());
            }
            utility += input.prior.values()[target] * (1.0 - missed_by_all);
        }
        // λ₂ of three vertices: the smaller root of x² − 2(a + b + c)x + 3(ab + bc + ca).
        let [a, b, c] = [(0, 1), (1, 2), (0, 2)].map(|(i, j)| {
            let success = |p: CellId, q: CellId| {
                let loss_db = f64::from(input.detection_loss_db[p.0 * 9 + q.0]);
                let ratio = 10.0_f64.powf((138.0 - loss_db - 65.0) / 10.0);
                (1.0 - 0.5 * libm::erfc(ratio.sqrt())).powi(256)
            };
            success(layout[i], layout[j]).min(success(layout[j], layout[i]))
        });
        let squares = (a - b).powi(2) + (b - c).powi(2) + (c - a).powi(2);
        let connectivity = a + b + c - (0.5 * squares).sqrt();

        let found = problem.evaluate(&layout);
        assert!((found.detection_utility - utility).abs() < ROUNDING);
        assert!((found.algebraic_connectivity - connectivity).abs() < 1e-9);
        assert_eq!(found.feasible, found.algebraic_connectivity >= 0.95);
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 40,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn coverage_keeps_up_with_any_sequence_of_changes(
        seed in 0_u64..1000,
        changes in prop::collection::vec((any::<bool>(), 0_usize..64), 1..60),
    ) {
        let mut input = synthetic(8, 6, seed);
        input.fixed_sensors = vec![CellId(9), CellId(40)];
        // Loud targets near the sonar are heard with certainty: exact zeros come and go.
        input.sonar.source_level_db = 150.0;
        let problem = PlacementProblem::new(&input).unwrap();
        let mut coverage = Coverage::new(&problem, &[]);
        for (coming, number) in changes {
            let vehicles = coverage.layout().len();
            if coming || vehicles == 0 {
                let expected = coverage.utility_with(CellId(number));
                coverage.insert(number % (vehicles + 1), CellId(number));
                prop_assert!((coverage.utility() - expected).abs() < SEARCH_ROUNDING);
            } else {
                coverage.remove(number % vehicles);
            }
            let full = problem.evaluate(coverage.layout()).detection_utility;
            prop_assert!((coverage.utility() - full).abs() < SEARCH_ROUNDING);
        }
    }

    #[test]
    fn utility_is_monotone_and_submodular(
        seed in 0_u64..1000,
        cells in prop::collection::hash_set(0_usize..36, 4..12),
        kept in 1_usize..4,
    ) {
        let problem = problem(6, 4, seed);
        let cells: Vec<CellId> = cells.into_iter().map(CellId).collect();
        let (added, larger) = cells.split_first().unwrap();
        let smaller = &larger[..kept.min(larger.len() - 1)];
        let utility = |layout: &[CellId]| problem.evaluate(layout).detection_utility;
        let gain = |layout: &[CellId]| utility(&[layout, &[*added]].concat()) - utility(layout);
        prop_assert!(gain(larger) >= -ROUNDING);
        prop_assert!(gain(smaller) >= gain(larger) - ROUNDING);
    }

    #[test]
    fn network_allows_exactly_the_exchanges_that_keep_the_threshold(
        seed in 0_u64..1000,
        exchanges in prop::collection::vec((0_usize..6, 0_usize..36), 1..80),
    ) {
        let mut input = synthetic(6, 6, seed);
        input.fixed_sensors = vec![CellId(14)];
        let problem = PlacementProblem::new(&input).unwrap();
        let mut layout: Vec<CellId> = [8, 9, 13, 15, 20, 21].map(CellId).to_vec();
        let mut network = Network::new(&problem, &layout).expect("the block is connected");
        for (slot, cell) in exchanges {
            let cell = CellId(cell);
            if layout.contains(&cell) || cell == CellId(14) {
                continue;
            }
            let mut changed = layout.clone();
            changed[slot] = cell;
            let connectivity = problem.connectivity(&changed);
            let allowed = network.try_exchange(slot, cell, 0.95);
            prop_assert_eq!(allowed, connectivity >= 0.95, "λ₂ {}", connectivity);
            if allowed {
                layout = changed;
            }
        }
    }
}

#[test]
fn annealing_finds_the_optimum_of_small_problems() {
    for seed in 0..6 {
        let problem = problem(4, 4, seed);
        let optimum = best_feasible(&problem).expect("four neighbours are connected");
        let found = Annealing::default().solve(&problem, Budget::Evaluations(20_000), seed);
        assert!(found.evaluation.feasible);
        assert!(
            (found.evaluation.detection_utility - optimum).abs() < ROUNDING,
            "seed {seed}: {} of {optimum}",
            found.evaluation.detection_utility
        );
    }
}

#[test]
fn populations_find_the_optimum_of_small_problems() {
    for seed in 0..4 {
        let problem = problem(4, 4, seed);
        let optimum = best_feasible(&problem).expect("four neighbours are connected");
        for solver in populations() {
            let found = solver.solve(&problem, Budget::Evaluations(6000), seed).evaluation;
            // A swarm that has contracted does not move on: it comes near.
            let share = if solver.name().starts_with("genetic") { 1.0 - ROUNDING } else { 0.97 };
            assert!(
                found.feasible && found.detection_utility >= share * optimum,
                "{}, seed {seed}: {} of {optimum}",
                solver.name(),
                found.detection_utility
            );
        }
    }
}

#[test]
fn populations_evaluate_no_more_than_the_budget_or_their_iterations_allow() {
    let problem = problem(5, 4, 12);
    for solver in populations() {
        for evaluations in [1, 7, 250] {
            let found = solver.solve(&problem, Budget::Evaluations(evaluations), 1);
            assert_eq!(found.evaluations, evaluations, "{}", solver.name());
        }
        let none = solver.solve(&problem, Budget::Evaluations(0), 1);
        assert_eq!((none.evaluations, none.cells.len()), (1, 4), "{}", solver.name());
        let moment = solver.solve(&problem, Budget::Seconds(1e-9), 1);
        assert!(moment.evaluations <= 100 && moment.cells.len() == 4, "{}", solver.name());
    }
    let budget = Budget::Evaluations(1_000_000);
    let swarm = ParticleSwarm { iterations: Some(7), ..ParticleSwarm::PAPER };
    assert_eq!(swarm.solve(&problem, budget, 1).evaluations, 7 * 30);
    let genetic = Genetic { generations: Some(3), ..Genetic::PAPER };
    assert_eq!(genetic.solve(&problem, budget, 1).evaluations, 3 * 100);
}

#[test]
fn populations_never_lose_to_the_layouts_they_start_with() {
    let problem = problem(12, 10, 13);
    let rank = |layout: &[CellId]| {
        let evaluation = problem.evaluate(layout);
        (evaluation.feasible, evaluation.reward(0.95, SCORING_MULTIPLIER))
    };
    let starts = [Start::Feasible, Start::Feasible, Start::Random, Start::Random];
    for (solver, start) in populations().iter().zip(starts) {
        let count = if solver.name().starts_with("genetic") { 100 } else { 30 };
        let layouts = start.layouts(&problem, count, 3);
        assert_eq!(start.layouts(&problem, 7, 3), layouts[..7], "a smaller population's");
        let best = layouts
            .iter()
            .map(|layout| rank(layout))
            .fold((false, f64::MIN), |a, b| if b > a { b } else { a });
        // Exactly the first generation, then a further one.
        let first = solver.solve(&problem, Budget::Evaluations(count as u64), 3);
        assert_eq!(rank(&first.cells), best, "{}", solver.name());
        let further = solver.solve(&problem, Budget::Evaluations(2 * count as u64), 3);
        assert!(rank(&further.cells) >= best, "{}", solver.name());
    }
}

#[test]
fn where_nothing_is_feasible_populations_return_the_highest_reward() {
    let mut input = synthetic(6, 5, 14);
    input.connectivity_threshold = 4.9; // five vehicles reach 5 at most, with perfect links
    let problem = PlacementProblem::new(&input).unwrap();
    let reward = |layout: &[CellId]| problem.evaluate(layout).reward(4.9, SCORING_MULTIPLIER);
    for solver in populations() {
        let count = if solver.name().starts_with("genetic") { 100 } else { 30 };
        let found = solver.solve(&problem, Budget::Evaluations(count), 5);
        let start = if solver.name().ends_with("paper") { Start::Random } else { Start::Feasible };
        let highest = start
            .layouts(&problem, count as usize, 5)
            .iter()
            .map(|layout| reward(layout))
            .fold(f64::MIN, f64::max);
        assert!(!found.evaluation.feasible && found.history.is_empty());
        assert!((reward(&found.cells) - highest).abs() < ROUNDING, "{}", solver.name());
    }
}

#[test]
fn the_bound_holds_for_every_layout() {
    for seed in 0..10 {
        let mut input = synthetic(4, 3, seed);
        input.fixed_sensors = if seed % 2 == 0 { vec![] } else { vec![CellId(5)] };
        let problem = PlacementProblem::new(&input).unwrap();
        let best = all_layouts(problem.deployable(), 3)
            .iter()
            .map(|layout| problem.evaluate(layout).detection_utility)
            .fold(0.0, f64::max);
        let bound = upper_bound(&problem);
        assert!(bound >= best - ROUNDING, "seed {seed}: {bound} below {best}");
        assert!(bound < 1.25 * best, "seed {seed}: {bound} says little about {best}");
    }
}

fn solvers() -> [Box<dyn Solver>; 9] {
    [
        Box::new(RandomSearch),
        Box::new(Greedy),
        Box::new(ConnectedGreedy),
        Box::new(LocalSearch),
        Box::new(Annealing::default()),
        Box::new(ParticleSwarm::default()),
        Box::new(Genetic::default()),
        Box::new(ParticleSwarm::PAPER),
        Box::new(Genetic::PAPER),
    ]
}

/// Those that improve a population of layouts.
fn populations() -> [Box<dyn Solver>; 4] {
    [
        Box::new(ParticleSwarm::default()),
        Box::new(Genetic::default()),
        Box::new(ParticleSwarm::PAPER),
        Box::new(Genetic::PAPER),
    ]
}

#[test]
fn every_method_respects_the_mask_and_the_fixed_sensors() {
    let mut input = synthetic(12, 10, 3);
    // Land in the east; two sensors in the west.
    input.deployable = Some(input.grid.cells().map(|cell| cell.0 % 12 < 8).collect());
    input.fixed_sensors = vec![CellId(61), CellId(75)];
    let problem = PlacementProblem::new(&input).unwrap();
    for solver in solvers() {
        let found = solver.solve(&problem, Budget::Evaluations(5000), 1);
        let Placement { cells, evaluation, evaluations, history, upper_bound, .. } = &found;
        assert_eq!(cells.len(), 10, "{}", solver.name());
        assert!(cells.is_sorted_by(|a, b| a < b), "one vehicle per cell");
        assert!(cells.iter().all(|cell| cell.0 % 12 < 8 && ![61, 75].contains(&cell.0)));
        assert_eq!(*evaluation, problem.evaluate(cells), "{}", solver.name());
        assert!(evaluation.detection_utility <= *upper_bound);
        assert!(*evaluations > 0);
        assert!(history.is_sorted_by(|a, b| a.0 <= b.0 && a.1 < b.1), "{}", solver.name());
        if evaluation.feasible {
            assert_eq!(history.last(), Some(&(*evaluations, evaluation.detection_utility)));
        }
    }
}

#[test]
fn methods_rank_as_they_should_where_connectivity_binds() {
    let problem = problem(16, 16, 4);
    let solve = |solver: &dyn Solver, evaluations| {
        solver.solve(&problem, Budget::Evaluations(evaluations), 2).evaluation
    };
    let unconstrained = solve(&Greedy, 1);
    let connected = solve(&ConnectedGreedy, 1);
    let local = solve(&LocalSearch, 200_000);
    let annealed = solve(&Annealing::default(), 200_000);
    assert!(!unconstrained.feasible, "connectivity does not bind");
    assert!(connected.feasible && local.feasible && annealed.feasible);
    assert!(local.detection_utility >= connected.detection_utility);
    assert!(annealed.detection_utility >= 0.995 * local.detection_utility);
    assert!(annealed.detection_utility < unconstrained.detection_utility);
}

#[test]
fn the_same_seed_gives_the_same_bits_on_any_number_of_threads() {
    let problem = problem(12, 10, 5);
    for solver in solvers() {
        let [one, two] = [1, 2].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| solver.solve(&problem, Budget::Evaluations(3000), 6))
        });
        assert_eq!(one, two, "{}", solver.name());
    }
}

#[test]
fn runs_differ_by_seed() {
    let problem = problem(12, 10, 5);
    let [_, _, _, _, randomised @ ..] = solvers();
    for solver in randomised {
        let solve = |seed| solver.solve(&problem, Budget::Evaluations(3000), seed).history;
        assert_ne!(solve(1), solve(2), "{}", solver.name());
    }
}

#[test]
fn annealing_repairs_where_no_simple_layout_is_feasible() {
    // Scattered deployable cells, and slightly more connectivity than the best disc has.
    let mut input = synthetic(14, 12, 7);
    let mut random = stream(7, "test/mask", 0);
    input.deployable = Some((0..196).map(|_| random.random::<f64>() < 0.35).collect());
    let problem = PlacementProblem::new(&input).unwrap();
    input.connectivity_threshold = f64::MAX;
    let unreachable = PlacementProblem::new(&input).unwrap();
    input.connectivity_threshold = 1.02 * problem.connectivity(&best_disc(&unreachable));
    let problem = PlacementProblem::new(&input).unwrap();
    assert!(!problem.evaluate(&best_disc(&problem)).feasible);
    assert!(!ConnectedGreedy.solve(&problem, Budget::Evaluations(1), 1).evaluation.feasible);
    let found = Annealing::default().solve(&problem, Budget::Evaluations(40_000), 1);
    assert!(found.evaluation.feasible, "λ₂ {}", found.evaluation.algebraic_connectivity);
}

#[test]
fn a_lone_vehicle_is_always_connected() {
    let problem = problem(5, 1, 8);
    for solver in solvers() {
        let found = solver.solve(&problem, Budget::Evaluations(2000), 1);
        assert!(found.evaluation.feasible, "{}", solver.name());
    }
    let best = best_feasible(&problem).unwrap();
    let found = Annealing::default().solve(&problem, Budget::Evaluations(2000), 1);
    assert!((found.evaluation.detection_utility - best).abs() < ROUNDING);
}

#[test]
fn a_full_grid_leaves_no_choice() {
    let problem = problem(3, 9, 9);
    for solver in solvers() {
        let found = solver.solve(&problem, Budget::Evaluations(500), 1);
        assert_eq!(found.cells, problem.deployable(), "{}", solver.name());
    }
}

#[test]
fn noise_per_cell_deafens_the_noisy_cells() {
    let mut input = synthetic(4, 1, 10);
    input.connectivity_threshold = 0.0;
    let mut levels_db = vec![65.0; 16];
    levels_db[5] = 120.0;
    input.sonar.noise_level_db = NoiseLevel::PerCell(levels_db);
    let problem = PlacementProblem::new(&input).unwrap();
    let utility = |cell| problem.evaluate(&[CellId(cell)]).detection_utility;
    assert!(utility(5) < 0.01 * utility(6), "{} {}", utility(5), utility(6));
}

#[test]
fn impossible_problems_are_refused_with_their_reason() {
    let refused = |change: &dyn Fn(&mut PlacementInput)| {
        let mut input = synthetic(3, 4, 11);
        change(&mut input);
        PlacementProblem::new(&input).unwrap_err().to_string()
    };
    assert_eq!(refused(&|input| input.vehicles = 0), "the fleet has no vehicles to place");
    assert_eq!(
        refused(&|input| {
            input.deployable = Some((0..9).map(|cell| cell < 4).collect());
            input.fixed_sensors = vec![CellId(0)];
        }),
        "4 vehicles cannot be placed on 3 deployable cells, one each"
    );
    assert_eq!(
        refused(&|input| input.detection_loss_db[10] = f32::NAN),
        "`detection_loss_db`: the loss from cell 1 to cell 1 is NaN dB"
    );
    assert_eq!(
        refused(&|input| input.communication_loss_db = Some(vec![60.0; 80])),
        "`communication_loss_db` has 80 values, expected 81 for a grid of 3 × 3 cells"
    );
    assert_eq!(
        refused(&|input| input.deployable = Some(vec![true; 8])),
        "`deployable` has 8 values, expected 9 for a grid of 3 × 3 cells"
    );
    assert_eq!(
        refused(&|input| input.connectivity_threshold = f64::NAN),
        "`connectivity_threshold` is NaN, expected a finite number of at least 0"
    );
    assert_eq!(
        refused(&|input| input.fixed_sensors = vec![CellId(3), CellId(9)]),
        "fixed sensor 1 in cell 9: it lies outside the grid"
    );
    assert_eq!(
        refused(&|input| input.fixed_sensors = vec![CellId(3), CellId(3)]),
        "fixed sensor 1 in cell 3: another one is in the same cell"
    );
    assert_eq!(
        refused(&|input| input.sonar.source_level_db = f64::INFINITY),
        "`source_level_db` is inf, expected a finite number"
    );
}
