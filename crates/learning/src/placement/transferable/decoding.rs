//! The best of several layouts, drawn for a connectivity that adapts to what comes out.

use super::episode::{Drawing, Workspace, build};
use super::landscape::Landscape;
use super::network::Network;
use super::revision;
use rand::Rng;
use rayon::prelude::*;
use sonarfleet::grid::CellId;
use sonarfleet::placement::Evaluation;
use sonarfleet::random::{Stream, stream};

/// A complete layout and what it achieves.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The vehicles' cells, in the order of their placement.
    pub layout: Vec<CellId>,
    /// Full evaluation of it.
    pub evaluation: Evaluation,
    /// The connectivity it was built for, in multiples of τ.
    pub aim: f64,
}

/// How the policy's layouts are drawn: a first round over a range of aims τ′, then
/// rounds around the aim whose layouts just reach τ, by a fit of log λ₂ against log τ′;
/// then rounds in which the policy places some vehicles of the best layouts anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decoding {
    /// Layouts of the first round.
    pub probes: usize,
    /// Aims of the first round, in multiples of τ.
    pub range: [f64; 2],
    /// Layouts of each further round.
    pub round: usize,
    /// Further rounds.
    pub rounds: usize,
    /// Layouts of each round of revisions.
    pub revisions: usize,
    /// Rounds of revisions.
    pub revision_rounds: usize,
    /// Divides the logits.
    pub temperature: f32,
}

impl Default for Decoding {
    /// 40 layouts from nothing, and revisions for about as long.
    fn default() -> Self {
        Self {
            probes: 16,
            range: [0.55, 1.7],
            round: 24,
            rounds: 1,
            revisions: 8,
            revision_rounds: 12,
            temperature: 0.6,
        }
    }
}

impl Decoding {
    /// For a search that goes on from the layouts: as much time for layouts from nothing
    /// alone. Revisions of one layout are alike, and where they lead is soon found.
    #[must_use]
    pub const fn diverse(self) -> Self {
        Self { rounds: 2 * self.rounds, revision_rounds: 0, ..self }
    }

    /// Number of layouts drawn.
    pub const fn samples(&self) -> usize {
        self.probes + self.round * self.rounds + self.revisions * self.revision_rounds
    }

    /// The layouts, in the order of their drawing.
    pub(super) fn draw(&self, network: &Network, landscape: &Landscape, seed: u64) -> Vec<Sample> {
        let [low, high] = self.range;
        let probes = self.probes.max(1);
        let between = |i: usize| (i as f64 + 0.5) / probes as f64;
        let aims: Vec<f64> = (0..probes).map(|i| low * (high / low).powf(between(i))).collect();
        let mut samples = self.round(network, landscape, &aims, seed, 0);
        for _ in 0..self.rounds {
            let (aim, spread) = self.fit(&samples, landscape.problem.connectivity_threshold());
            let aims: Vec<f64> = (0..self.round)
                .map(|i| {
                    let at = 2.0 * (i as f64 + 0.5) / self.round as f64 - 1.0;
                    aim * (at * spread).exp()
                })
                .collect();
            let drawn = samples.len() as u64;
            samples.extend(self.round(network, landscape, &aims, seed, drawn));
        }
        for _ in 0..self.revision_rounds {
            let parents = revision::parents(&samples);
            let drawn = samples.len() as u64;
            let revised: Vec<Sample> = (0..self.revisions as u64)
                .into_par_iter()
                .map_init(Workspace::default, |workspace, index| {
                    let mut random = stream(seed, "placement/policy", drawn + index);
                    let parent = parents[random.random_range(0..parents.len())];
                    let kept = revision::kept(&parent.layout, landscape.columns, &mut random);
                    self.sample(network, landscape, &kept, parent.aim, &mut random, workspace)
                })
                .collect();
            samples.extend(revised);
        }
        samples
    }

    fn round(
        &self,
        network: &Network,
        landscape: &Landscape,
        aims: &[f64],
        seed: u64,
        drawn: u64,
    ) -> Vec<Sample> {
        aims.par_iter()
            .enumerate()
            .map_init(Workspace::default, |workspace, (index, &aim)| {
                let mut random = stream(seed, "placement/policy", drawn + index as u64);
                self.sample(network, landscape, &[], aim, &mut random, workspace)
            })
            .collect()
    }

    fn sample(
        &self,
        network: &Network,
        landscape: &Landscape,
        begun: &[CellId],
        aim: f64,
        random: &mut Stream,
        workspace: &mut Workspace,
    ) -> Sample {
        let threshold = aim * landscape.problem.connectivity_threshold();
        let drawing = Drawing { threshold, temperature: self.temperature };
        let layout = build(network, landscape, begun, drawing, random, workspace, |_, _, _| {});
        let evaluation = landscape.problem.evaluate(&layout);
        Sample { layout, evaluation, aim }
    }

    /// The aim whose layouts are expected to just reach τ, and how far around it to
    /// look, both on a logarithmic scale: a line through log λ₂ against log τ′ whose
    /// slope is kept between ½ and 2, since λ₂ is noisy.
    fn fit(&self, samples: &[Sample], threshold: f64) -> (f64, f64) {
        const LEAST: f64 = 0.05;
        const SPREAD: [f64; 2] = [0.05, 0.3];
        let [low, high] = self.range.map(f64::ln);
        let points: Vec<(f64, f64)> = samples
            .iter()
            .map(|sample| (sample.aim.ln(), sample.evaluation.algebraic_connectivity / threshold))
            .filter(|(_, share)| *share > LEAST && share.is_finite())
            .map(|(aim, share)| (aim, share.ln()))
            .collect();
        if points.len() < 3 {
            return ((high - SPREAD[1]).exp(), SPREAD[1]);
        }
        let n = points.len() as f64;
        let mean = |value: fn(&(f64, f64)) -> f64| points.iter().map(value).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
        let variance: f64 = points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
        let slope = (covariance / variance.max(1e-9)).clamp(0.5, 2.0);
        let left = |p: &(f64, f64)| p.1 - y - slope * (p.0 - x);
        let deviation = (points.iter().map(|p| left(p).powi(2)).sum::<f64>() / n).sqrt();
        let spread = (deviation / slope).clamp(SPREAD[0], SPREAD[1]);
        ((x - y / slope).clamp(low - 0.5, high + 0.5).exp(), spread)
    }
}
