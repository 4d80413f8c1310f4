//! The optimiser on environments whose best policies and values are known.

use rand::Rng;
use serde::{Deserialize, Serialize};
use sonarfleet::random::Stream;
use sonarfleet_learning::network::{ActorCritic, Mlp, MlpActivations, Output, Recurrent};
use sonarfleet_learning::ppo::{Environment, PpoSettings, Progress, Trainer, Transition};

/// Shows one of two cues, then nothing for some steps, and rewards the action that has
/// the cue's number at the end. A third action is never allowed.
struct Recall {
    delay: usize,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct RecallState {
    cue: usize,
    step: usize,
}

impl Environment for Recall {
    type State = RecallState;
    type Outcome = bool;

    fn observation_len(&self) -> usize {
        3
    }

    fn actions(&self) -> usize {
        3
    }

    fn reset(&self, _episode: u64, random: &mut Stream) -> RecallState {
        RecallState { cue: random.random_range(0..2), step: 0 }
    }

    fn observation(&self, state: &RecallState, observation: &mut [f32]) {
        observation.fill(0.0);
        observation[2] = state.step as f32 / self.delay as f32;
        if state.step == 0 {
            observation[state.cue] = 1.0;
        }
    }

    fn action_mask(&self, _state: &RecallState, mask: &mut [bool]) {
        mask.copy_from_slice(&[true, true, false]);
    }

    fn step(
        &self,
        state: &mut RecallState,
        action: usize,
        _random: &mut Stream,
    ) -> Transition<bool> {
        assert!(action < 2, "a masked action");
        if state.step < self.delay {
            state.step += 1;
            return Transition { reward: 0.0, progress: Progress::Continues };
        }
        let right = action == state.cue;
        Transition { reward: f32::from(u8::from(right)), progress: Progress::Terminated(right) }
    }
}

fn recall_settings() -> PpoSettings {
    PpoSettings {
        num_envs: 16,
        num_steps: 64,
        minibatch_size: 256,
        update_epochs: 4,
        learning_rate: 3e-3,
        ..PpoSettings::paper_placement()
    }
}

/// Share of right answers in the last of some updates.
fn recalled<N: ActorCritic>(network: N, settings: PpoSettings, updates: usize) -> f64 {
    let mut trainer = Trainer::new(Recall { delay: 5 }, network, settings, 1).unwrap();
    let mut share = 0.0;
    for _ in 0..updates {
        share = trainer.update(0.0).mean_return();
    }
    share
}

/// Only memory knows the cue when it is asked for; episodes of 6 steps start and end
/// inside the sequences of 32.
#[test]
fn a_network_with_memory_recalls_what_one_without_cannot() {
    let recurrent = Recurrent { inputs: 3, embedding: 16, units: 16, actions: 3 };
    let settings = PpoSettings { sequence_length: 32, ..recall_settings() };
    let with = recalled(recurrent, settings, 40);
    assert!(with > 0.95, "with memory {with}");
    let without =
        recalled(Mlp { inputs: 3, hidden: vec![16, 16], actions: 3 }, recall_settings(), 40);
    assert!((without - 0.5).abs() < 0.15, "without memory {without}");
}

/// Before the first step of Adam the policy is the one that played: rounding is all
/// that tells them apart, with and without memory.
#[test]
fn the_ratio_is_1_before_the_first_update() {
    fn check<N: ActorCritic>(network: N, settings: PpoSettings) {
        let mut trainer = Trainer::new(Recall { delay: 5 }, network, settings, 1).unwrap();
        for _ in 0..2 {
            let first = trainer.update(0.0).minibatches[0];
            assert!(first.clip_fraction.abs() < 1e-12);
            assert!(first.approx_kl.abs() < 1e-7, "{first:?}");
        }
    }
    check(Mlp { inputs: 3, hidden: vec![16, 16], actions: 3 }, recall_settings());
    check(
        Recurrent { inputs: 3, embedding: 16, units: 16, actions: 3 },
        PpoSettings { sequence_length: 32, ..recall_settings() },
    );
}

/// Rewards every step with 1 and stops after `length` of them.
struct Steady {
    length: u32,
    truncates: bool,
}

impl Environment for Steady {
    type State = u32;
    type Outcome = ();

    fn observation_len(&self) -> usize {
        1
    }

    fn actions(&self) -> usize {
        1
    }

    fn reset(&self, _episode: u64, _random: &mut Stream) -> u32 {
        0
    }

    fn observation(&self, _state: &u32, observation: &mut [f32]) {
        observation[0] = 1.0;
    }

    fn action_mask(&self, _state: &u32, mask: &mut [bool]) {
        mask.fill(true);
    }

    fn step(&self, state: &mut u32, _action: usize, _random: &mut Stream) -> Transition<()> {
        *state += 1;
        let progress = match (*state < self.length, self.truncates) {
            (true, _) => Progress::Continues,
            (false, true) => Progress::Truncated(()),
            (false, false) => Progress::Terminated(()),
        };
        Transition { reward: 1.0, progress }
    }
}

/// With γ = 0.9 a reward of 1 for ever is worth 10. An episode of 4 steps that
/// terminates is worth 1 to 3.439, 2.26 on average; one that is cut off is worth 10.
#[test]
fn returns_go_on_beyond_time_limits_and_not_beyond_ends() {
    let value = |truncates: bool| {
        let network = Mlp { inputs: 1, hidden: vec![8], actions: 1 };
        let settings = PpoSettings {
            num_envs: 4,
            num_steps: 30,
            minibatch_size: 40,
            learning_rate: 1e-2,
            max_grad_norm: 10.0,
            gamma: 0.9,
            ..PpoSettings::paper_placement()
        };
        let environment = Steady { length: 4, truncates };
        let mut trainer = Trainer::new(environment, network, settings, 1).unwrap();
        for _ in 0..60 {
            trainer.update(0.0);
        }
        let mut output = Output::default();
        let network = trainer.network();
        let weights = &trainer.state().weights;
        network.step(weights, &[1.0], &mut [], &mut MlpActivations::default(), &mut output);
        output.values[0]
    };
    let (cut_off, ended) = (value(true), value(false));
    assert!((cut_off - 10.0).abs() < 0.2, "{cut_off}");
    // λ-returns of one value for all four steps lie a little off the true mean.
    assert!((ended - 2.26).abs() < 0.4, "{ended}");
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let network = || Mlp { inputs: 1, hidden: vec![8], actions: 1 };
    let environment = || Steady { length: 4, truncates: false };
    for settings in [
        PpoSettings { num_envs: 0, ..PpoSettings::paper_placement() },
        PpoSettings { sequence_length: 3, ..PpoSettings::paper_placement() },
        PpoSettings { sequence_length: 256, minibatch_size: 64, ..PpoSettings::paper_placement() },
    ] {
        assert!(Trainer::new(environment(), network(), settings, 0).is_err());
    }
}
