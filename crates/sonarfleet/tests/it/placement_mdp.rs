//! The placement processes, played at random.

use crate::placement::synthetic;
use rand::Rng;
use sonarfleet::grid::CellId;
use sonarfleet::placement::PlacementProblem;
use sonarfleet::placement::mdp::{
    ExchangeMdp, LinkMask, PlacementMdp, SequentialMdp, TerminalReward,
};
use sonarfleet::random::stream;

fn problem(vehicles: usize) -> PlacementProblem {
    let mut input = synthetic(6, vehicles, 1);
    input.deployable = Some((0..36).map(|cell| cell % 5 != 0).collect());
    input.fixed_sensors = vec![CellId(7)];
    PlacementProblem::new(&input).unwrap()
}

/// Plays an episode of random actions and checks every step.
fn play<M: PlacementMdp>(mdp: &M, index: u64, mut each: impl FnMut(&M::State, &[bool])) {
    let problem = mdp.problem();
    let mut random = stream(1, "test/mdp", index);
    let mut state = mdp.reset(&mut random);
    let mut mask = vec![false; 36];
    for decision in 1..=mdp.decisions() {
        mdp.action_mask(&state, &mut mask);
        each(&state, &mask);
        let allowed: Vec<usize> = (0..36).filter(|&cell| mask[cell]).collect();
        let action = allowed[random.random_range(0..allowed.len())];
        let step = mdp.step(&mut state, CellId(action));
        assert_eq!(step.end.is_some(), decision == mdp.decisions());
        let Some(evaluation) = step.end else {
            assert!(step.reward.abs() < 1e-15);
            continue;
        };
        let layout = mdp.layout(&state);
        assert_eq!(layout.len(), problem.vehicles());
        assert!(layout.iter().all(|cell| problem.deployable().contains(cell)));
        let mut distinct = layout.to_vec();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), layout.len());
        assert_eq!(evaluation, problem.evaluate(layout));
        let expected = evaluation.reward(problem.connectivity_threshold(), 7.0);
        assert!((step.reward - expected).abs() < 1e-12);
    }
}

#[test]
fn the_sequential_process_places_every_vehicle_in_a_cell_of_its_own() {
    let problem = problem(6);
    let mut mdp = SequentialMdp::new(&problem);
    mdp.reward = TerminalReward::paper(7.0);
    for index in 0..20 {
        play(&mdp, index, |state, mask| {
            let mut observation = vec![9.0; 36];
            mdp.observation(state, &mut observation);
            for (cell, (&occupied, &allowed)) in observation.iter().zip(mask).enumerate() {
                let placed = mdp.layout(state).contains(&CellId(cell));
                assert_eq!(occupied.to_bits(), f32::from(u8::from(placed)).to_bits());
                assert_eq!(allowed, !placed && problem.deployable().contains(&CellId(cell)));
            }
        });
    }
}

#[test]
fn the_exchange_process_lifts_and_drops() {
    let problem = problem(6);
    let mut mdp = ExchangeMdp::new(&problem);
    mdp.reward = TerminalReward::paper(7.0);
    for index in 0..20 {
        let mut decision = 0;
        play(&mdp, index, |state, mask| {
            let mut observation = vec![9.0; 36];
            mdp.observation(state, &mut observation);
            let count = |value: f32| {
                observation.iter().filter(|found| found.to_bits() == value.to_bits()).count()
            };
            let lifting = decision % 2 == 0;
            assert_eq!((count(1.0), count(-1.0)), if lifting { (6, 0) } else { (5, 1) });
            let allowed = mask.iter().filter(|&&allowed| allowed).count();
            assert_eq!(allowed, if lifting { 6 } else { problem.deployable().len() - 6 });
            decision += 1;
        });
        assert_eq!(decision, 80);
    }
}

/// Where there is nowhere else to go, a vehicle may come back.
#[test]
fn a_full_grid_can_still_be_exchanged() {
    let deployable = problem(6).deployable().len();
    let problem = problem(deployable);
    let mut mdp = ExchangeMdp::new(&problem);
    mdp.reward = TerminalReward::paper(7.0);
    play(&mdp, 0, |_, _| ());
}

/// The sum of links, counted again: never below what is asked for where a cell has it.
#[test]
fn the_link_mask_leaves_cells_that_hear_the_placed_ones() {
    let problem = problem(6);
    let link_mask = LinkMask { degree: 1.5, share: 0.8 };
    let mut mdp = SequentialMdp::new(&problem);
    mdp.reward = TerminalReward::paper(7.0);
    mdp.link_mask = Some(link_mask);
    for index in 0..20 {
        play(&mdp, index, |state, mask| {
            let placed = mdp.layout(state);
            let degree = |cell: CellId| -> f64 {
                placed.iter().chain(problem.fixed_sensors()).map(|&q| problem.link(cell, q)).sum()
            };
            let free: Vec<CellId> = problem
                .deployable()
                .iter()
                .copied()
                .filter(|cell| !placed.contains(cell))
                .collect();
            let best = free.iter().map(|&cell| degree(cell)).fold(0.0, f64::max);
            let least = 1.5_f64.min(0.8 * (placed.len() + 1) as f64).min(best);
            for cell in free {
                // Sums in another order differ by rounding.
                if (degree(cell) - least).abs() > 1e-9 {
                    assert_eq!(mask[cell.0], degree(cell) > least);
                }
            }
            assert!(mask.contains(&true));
        });
    }
}

#[test]
#[should_panic(expected = "is not free")]
fn an_occupied_cell_is_refused() {
    let problem = problem(6);
    let mdp = SequentialMdp::new(&problem);
    let mut state = mdp.reset(&mut stream(1, "test/mdp", 0));
    mdp.step(&mut state, CellId(1));
    mdp.step(&mut state, CellId(1));
}
