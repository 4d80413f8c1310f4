//! Building layouts with the policy.

use super::construction::Construction;
use super::landscape::Landscape;
use super::network::{Activations, Network};
use super::observation::{CANDIDATES, Observation};
use rand::Rng;
use sonarfleet::grid::CellId;
use sonarfleet::random::Stream;

/// What a thread needs to run the policy.
#[derive(Debug, Clone, Default)]
pub(super) struct Workspace {
    pub(super) observation: Observation,
    pub(super) activations: Activations,
}

/// Probabilities of the candidates, and their logarithms.
#[derive(Debug, Clone)]
pub(super) struct Distribution {
    /// 0 beyond the last candidate.
    pub(super) probabilities: [f32; CANDIDATES],
    pub(super) logarithms: [f32; CANDIDATES],
}

impl Distribution {
    /// The softmax of logits over a temperature.
    pub(super) fn new(logits: &[f32], temperature: f32) -> Self {
        let mut distribution =
            Self { probabilities: [0.0; CANDIDATES], logarithms: [0.0; CANDIDATES] };
        let most = logits.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let mut sum = 0.0;
        for (probability, logit) in distribution.probabilities.iter_mut().zip(logits) {
            *probability = ((logit - most) / temperature).exp();
            sum += *probability;
        }
        let logarithm = sum.ln();
        for ((probability, log), logit) in
            distribution.probabilities.iter_mut().zip(&mut distribution.logarithms).zip(logits)
        {
            *probability /= sum;
            *log = (logit - most) / temperature - logarithm;
        }
        distribution
    }

    /// A candidate drawn from it.
    pub(super) fn draw(&self, count: usize, random: &mut Stream) -> usize {
        let mut left: f32 = random.random();
        for (candidate, probability) in self.probabilities[..count].iter().enumerate() {
            left -= probability;
            if left < 0.0 {
                return candidate;
            }
        }
        // Rounding: the last one that can be drawn.
        self.probabilities[..count].iter().rposition(|&p| p > 0.0).unwrap_or(0)
    }

    /// −Σ p·ln p.
    pub(super) fn entropy(&self) -> f32 {
        let terms = self.probabilities.iter().zip(&self.logarithms);
        -terms.map(|(p, log)| if *p > 0.0 { p * log } else { 0.0 }).sum::<f32>()
    }
}

/// How layouts are drawn from the policy.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawing {
    /// τ′: the connectivity to build for.
    pub(super) threshold: f64,
    /// Divides the logits.
    pub(super) temperature: f32,
}

/// Builds a layout from some cells that are taken; `watch` sees each observation with
/// the candidate chosen and the logarithm of its probability.
pub(super) fn build(
    network: &Network,
    landscape: &Landscape,
    begun: &[CellId],
    drawing: Drawing,
    random: &mut Stream,
    workspace: &mut Workspace,
    mut watch: impl FnMut(&Observation, usize, f32),
) -> Vec<CellId> {
    let Workspace { observation, activations } = workspace;
    let mut construction = Construction::begun(landscape, drawing.threshold, begun);
    while !construction.is_complete() {
        construction.observe(observation);
        let count = observation.cells.len();
        network.forward(&observation.features, count, activations);
        let choices = Distribution::new(&activations.logits[..count], drawing.temperature);
        let candidate = choices.draw(count, random);
        watch(observation, candidate, choices.logarithms[candidate]);
        construction.place(observation.cells[candidate]);
    }
    construction.layout()
}
