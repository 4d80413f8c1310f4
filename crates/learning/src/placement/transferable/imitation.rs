//! Stage 1: learning from annealed layouts, without reinforcement.

use super::construction::Construction;
use super::episode::{Distribution, Workspace};
use super::landscape::Landscape;
use super::network::Network;
use super::observation::CANDIDATES;
use super::update::{Aim, Lesson};
use rand::Rng;
use sonarfleet::grid::CellId;
use sonarfleet::random::Stream;

/// Share of the target that is uniform over the layout's remaining cells; the rest is
/// the policy's own distribution over them.
const UNIFORM_SHARE: f32 = 0.3;

/// Lessons from building a known layout: at every step the target is the layout's
/// cells that are left. They are placed in random order with probability
/// 1 − `own_order`, else in an order that the policy itself prefers: a layout is a set,
/// and its best order is the policy's to find.
pub(super) fn lessons(
    network: &Network,
    landscape: &Landscape,
    layout: &[CellId],
    own_order: f64,
    random: &mut Stream,
    workspace: &mut Workspace,
) -> Vec<Lesson> {
    let Workspace { observation, activations } = workspace;
    let threshold = landscape.problem.connectivity_threshold();
    let mut construction = Construction::new(landscape, threshold);
    let mut left: Vec<u32> = layout.iter().map(|cell| cell.0 as u32).collect();
    let by_policy = random.random::<f64>() < own_order;
    let mut lessons = Vec::with_capacity(left.len());
    while !left.is_empty() {
        construction.observe(observation);
        let count = observation.cells.len();
        network.forward(&observation.features, count, activations);
        let choices = Distribution::new(&activations.logits[..count], 1.0);
        let wanted: Vec<usize> =
            (0..count).filter(|&candidate| left.contains(&observation.cells[candidate])).collect();
        if wanted.is_empty() {
            let next = left.swap_remove(random.random_range(0..left.len()));
            construction.place(next);
            continue;
        }
        let mass: f32 = wanted.iter().map(|&c| choices.probabilities[c]).sum();
        let uniform = 1.0 / wanted.len() as f32;
        let own = |c: usize| if mass > 0.0 { choices.probabilities[c] / mass } else { uniform };
        let target: Vec<(usize, f32)> = wanted
            .iter()
            .map(|&c| (c, UNIFORM_SHARE * uniform + (1.0 - UNIFORM_SHARE) * own(c)))
            .collect();
        let mut restricted = [0.0; CANDIDATES];
        for &c in &wanted {
            restricted[c] = if by_policy { own(c) } else { uniform };
        }
        let next = observation.cells[draw(&restricted, &wanted, random)];
        lessons.push(Lesson::new(observation, Aim::Imitate(target)));
        left.retain(|&cell| cell != next);
        construction.place(next);
    }
    lessons
}

fn draw(probabilities: &[f32], among: &[usize], random: &mut Stream) -> usize {
    let mut left: f32 = random.random();
    for &candidate in among {
        left -= probabilities[candidate];
        if left < 0.0 {
            return candidate;
        }
    }
    among[among.len() - 1]
}
