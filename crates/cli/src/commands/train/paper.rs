//! The paper's policies, trained on one problem.

use super::logbook::Logbook;
use crate::args::{Preset, TrainPlacementArgs};
use crate::commands::problem::ProblemSource;
use crate::commands::{Manner, print_json, say};
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use serde_json::json;
use sonarfleet::placement::PlacementProblem;
use sonarfleet::placement::mdp::{ExchangeMdp, PlacementMdp};
use sonarfleet_learning::files::{checkpoint, write_whole};
use sonarfleet_learning::placement::paper::{
    PaperPolicy, PaperSettings, PlacementTrainer, PlacementTrainerState, Process,
};

/// Updates where neither their number nor the time is limited.
const UPDATES: usize = 300;

/// What a training goes on from, and what fine-tuning starts from.
#[derive(Serialize, Deserialize)]
#[serde(bound = "S: Serialize + serde::de::DeserializeOwned")]
struct Kept<S> {
    settings: PaperSettings,
    updates: u64,
    policy: PaperPolicy,
    state: PlacementTrainerState<S>,
}

pub(super) fn train(args: &TrainPlacementArgs, process: Process, manner: Manner) -> Result<()> {
    let input = args.input.as_deref().context("name a scenario or an instance to train on")?;
    let source = ProblemSource {
        input: Some(input),
        epoch: args.epoch,
        count: args.count,
        threshold: None,
        loss: None,
        communication_loss: None,
        cache: &args.cache,
    };
    let (problem, _) = source.problem(manner)?;
    let settings = match args.preset {
        Preset::Paper => PaperSettings::paper(),
        Preset::Ours => PaperSettings::ours(),
    };
    match process {
        Process::Sequential => {
            let mdp = || settings.sequential_mdp(&problem);
            train_on(args, "training/placement/sequential-ppo", mdp, &settings, &problem, manner)
        }
        Process::Exchange => {
            let mdp = || ExchangeMdp::new(&problem);
            train_on(args, "training/placement/exchange-ppo", mdp, &settings, &problem, manner)
        }
    }
}

fn train_on<M: PlacementMdp>(
    args: &TrainPlacementArgs,
    kind: &'static str,
    mdp: impl Fn() -> M,
    settings: &PaperSettings,
    problem: &PlacementProblem,
    manner: Manner,
) -> Result<()>
where
    M::State: Serialize + serde::de::DeserializeOwned,
{
    let kept: Option<Kept<M::State>> = Logbook::resumed(args, kind)?;
    let (mut trainer, mut updates) = match (kept, &args.from) {
        (Some(kept), _) => {
            (PlacementTrainer::resume(mdp(), &kept.settings, kept.state)?, kept.updates)
        }
        (None, Some(from)) => {
            let kept: Kept<M::State> = checkpoint::load(from, kind)?;
            (PlacementTrainer::fine_tune(mdp(), settings, &kept.policy, args.seed)?, 0)
        }
        (None, None) => (PlacementTrainer::new(mdp(), settings, args.seed)?, 0),
    };
    let wanted = args.updates.unwrap_or(if args.seconds.is_some() { usize::MAX } else { UPDATES });
    let mut logbook = Logbook::open(args, kind, updates, manner)?;
    let keep = |trainer: &PlacementTrainer<M>, updates| Kept {
        settings: settings.clone(),
        updates,
        policy: trainer.policy(),
        state: trainer.state(),
    };
    while updates < wanted as u64 && !logbook.time_is_up() {
        let done = logbook.used().unwrap_or(updates as f64 / wanted as f64).min(1.0);
        let found = trainer.update(done);
        updates += 1;
        let message = format!(
            "reward {:.2}, J_d {:.2}, λ₂ {:.3}, multiplier {:.1}, KL {:.4}, entropy {:.2}",
            found.mean_return,
            found.detection_utility,
            found.algebraic_connectivity,
            found.multiplier,
            found.approx_kl,
            found.entropy,
        );
        logbook.show((1000.0 * done) as u64, 1000, message);
        let scalars = [
            ("episodes", found.episodes as f64),
            ("reward", found.mean_return),
            ("detection_utility", found.detection_utility),
            ("algebraic_connectivity", found.algebraic_connectivity),
            ("feasible_share", found.feasible),
            ("multiplier", found.multiplier),
            ("entropy", found.entropy),
            ("approx_kl", found.approx_kl),
            ("clip_fraction", found.clip_fraction),
            ("explained_variance", found.explained_variance),
            ("policy_loss", found.policy_loss),
            ("value_loss", found.value_loss),
        ];
        logbook.write(updates, found.steps, &scalars, || keep(&trainer, updates))?;
    }
    logbook.keep(&keep(&trainer, updates))?;
    logbook.close(kind, problem.connectivity_threshold(), args.seed)?;
    let policy = trainer.policy();
    write_whole(&args.output.join("policy.onnx"), &policy.to_onnx())?;

    let decoded = problem.evaluate(&policy.decode(&mdp(), problem.vehicles(), args.seed));
    let sampled = trainer.best_sampled().map(|cells| problem.evaluate(cells));
    if manner.json {
        return print_json(&json!({
            "updates": updates,
            "episodes": trainer.episodes(),
            "decoded": decoded,
            "best_sampled": sampled,
        }));
    }
    say(format_args!("{} after {} episodes", args.output.display(), trainer.episodes()))?;
    for (name, found) in [("decoded", Some(decoded)), ("best sampled", sampled)] {
        let Some(found) = found else { continue };
        let verdict = if found.feasible { "feasible" } else { "INFEASIBLE" };
        let (utility, lambda) = (found.detection_utility, found.algebraic_connectivity);
        say(format_args!("{name}: J_d {utility:.3}, λ₂ {lambda:.4}, {verdict}"))?;
    }
    Ok(())
}
