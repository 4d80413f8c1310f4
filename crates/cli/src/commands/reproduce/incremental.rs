//! Training that goes on from the policy of the last epoch, beside training from scratch.

use super::study::{AUTO, Study, scores};
use super::training::Course;
use super::{Outcome, Row, score};
use crate::args::Preset;
use anyhow::Result;
use sonarfleet::placement::PlacementProblem;
use sonarfleet::record::{ChartRecord, PanelRecord, SeriesRecord, median};
use sonarfleet_learning::placement::paper::{PaperPolicy, PlacementTrainer, Process};
use sonarfleet_learning::placement::transferable::{
    Network, School, Training, TrainingSettings, TransferablePolicy,
};
use sonarfleet_report::write_chart;
use std::path::Path;
use std::time::Instant;

/// Share of the reference that is to be reached.
const GOAL_PERCENT: f64 = 98.0;

/// Updates of the transferable policy between two looks at what it places.
const UPDATES_PER_LOOK: usize = 4;

/// How far a training is.
#[derive(Debug, Clone, Copy)]
struct Look {
    seconds: f64,
    updates: u64,
    /// `J_d` of the best feasible layout so far; 0 while there is none.
    utility: f64,
}

impl Look {
    fn percent(&self, reference: f64) -> f64 {
        100.0 * self.utility / reference
    }
}

pub(super) fn incremental(study: &mut Study<'_>, stem: &Path) -> Result<Outcome> {
    // First, as where there is none, that is to be known before any training.
    let next = study.next_epoch()?;
    let vehicles = study.problem.vehicles();
    let course = Course { process: Process::Sequential, preset: Preset::Ours, vehicles };
    let before = study.trained(course)?;
    let seconds = study.seconds;
    let reference = score::utility(&scores(&study.solve(AUTO, &next)?));

    let mut ways: Vec<(&str, Vec<Vec<Look>>)> = [
        "Sequential PPO, from scratch",
        "Sequential PPO, from the last epoch",
        "Transferable policy, from scratch",
        "Transferable policy, as it ships",
        "Transferable policy, from the last epoch",
    ]
    .map(|name| (name, Vec::new()))
    .to_vec();
    for (seed, trained) in (1..=study.seeds).zip(before.iter()) {
        let _bar = study.bar("Next epoch", seed);
        let from = |network| Training::improving(network, TrainingSettings::fine_tuning(seed));
        let mut tuned = from(TransferablePolicy::shipped().network);
        transferable(&mut tuned, &study.problem, seconds);
        let mut trainings = [
            Training::new(TrainingSettings::one_problem_untaught(seed)),
            from(TransferablePolicy::shipped().network),
            from(tuned.network()),
        ];
        ways[0].1.push(sequential(&next, course, None, seconds, seed)?);
        ways[1].1.push(sequential(&next, course, Some(&trained.policy), seconds, seed)?);
        for (way, training) in ways[2..].iter_mut().zip(&mut trainings) {
            way.1.push(transferable(training, &next, seconds));
        }
    }

    let rows = ways
        .iter()
        .map(|(name, runs)| Row {
            figure: "Section 4",
            what: format!("{name}: to {GOAL_PERCENT} % of {reference:.2}"),
            paper: "incremental updates instead of retraining",
            ours: reached(runs, reference),
        })
        .collect();
    let chart = ChartRecord {
        name: format!("When the ocean and the prior move on from: {}", study.name),
        note: format!(
            "thin: {} seeds; bold: their median; best layout so far against auto's",
            study.seeds
        ),
        version: env!("CARGO_PKG_VERSION").into(),
        panels: vec![PanelRecord {
            title: "Detection utility in the second epoch".into(),
            x_label: "Seconds of training".into(),
            y_label: "Share of the reference (%)".into(),
            level: Some((format!("{GOAL_PERCENT} %"), GOAL_PERCENT)),
            series: ways
                .iter()
                .map(|(name, runs)| series(name, runs, reference, seconds))
                .collect(),
        }],
    };
    write_chart(&chart, stem)?;
    Ok(Outcome { rows, record: serde_json::to_value(chart)? })
}

/// Trains the paper's policy, from that of another epoch where there is one.
fn sequential(
    problem: &PlacementProblem,
    course: Course,
    from: Option<&PaperPolicy>,
    seconds: f64,
    seed: u64,
) -> Result<Vec<Look>> {
    let settings = course.settings();
    let mdp = settings.sequential_mdp(problem);
    let mut trainer = match from {
        Some(policy) => PlacementTrainer::fine_tune(mdp, &settings, policy, seed)?,
        None => PlacementTrainer::new(mdp, &settings, seed)?,
    };
    let started = Instant::now();
    let mut looks = Vec::new();
    let mut elapsed = 0.0;
    while elapsed < seconds {
        let update = trainer.update(elapsed / seconds);
        elapsed = started.elapsed().as_secs_f64();
        let utility = trainer.history().last().map_or(0.0, |&(_, utility)| utility);
        looks.push(Look { seconds: elapsed, updates: update.update, utility });
    }
    Ok(looks)
}

/// Trains the transferable policy on one problem, looking now and then at the best of
/// what it places; the first look is before any training.
fn transferable(training: &mut Training, problem: &PlacementProblem, seconds: f64) -> Vec<Look> {
    let practice = |_| problem.clone();
    let mut school = School::default();
    let started = Instant::now();
    let mut looks: Vec<Look> = Vec::new();
    let mut look = |training: &Training| {
        let best = best_placed(training.network(), problem, training.settings.seed);
        let utility = looks.last().map_or(best, |last| last.utility.max(best));
        let updates = training.updates_done();
        looks.push(Look { seconds: started.elapsed().as_secs_f64(), updates, utility });
    };
    look(training);
    while started.elapsed().as_secs_f64() < seconds {
        let steps = (0..UPDATES_PER_LOOK).map_while(|_| training.step(&practice, &mut school));
        if steps.count() == 0 {
            break;
        }
        look(training);
    }
    looks
}

fn best_placed(network: Network, problem: &PlacementProblem, seed: u64) -> f64 {
    let samples = TransferablePolicy::new(network).samples(problem, seed);
    samples
        .first()
        .filter(|sample| sample.evaluation.feasible)
        .map_or(0.0, |sample| sample.evaluation.detection_utility)
}

/// "12 s and 3 updates (3 of 3 seeds)", medians over the seeds that got there, or how
/// far they came.
fn reached(runs: &[Vec<Look>], reference: f64) -> String {
    let there: Vec<Look> = runs
        .iter()
        .filter_map(|run| run.iter().find(|look| look.percent(reference) >= GOAL_PERCENT))
        .copied()
        .collect();
    let ends = runs.iter().filter_map(|run| run.last());
    let last = median(ends.map(|look| look.percent(reference)).collect());
    if there.is_empty() {
        return format!("not reached: {last:.1} % in the end");
    }
    let seconds = median(there.iter().map(|look| look.seconds).collect());
    let updates = median(there.iter().map(|look| look.updates as f64).collect());
    format!(
        "{seconds:.1} s, {updates:.0} updates ({} of {} seeds; {last:.1} % in the end)",
        there.len(),
        runs.len(),
    )
}

/// The runs in percent of the reference from their first feasible layout on; their
/// median on common times, from when all have one.
fn series(name: &str, runs: &[Vec<Look>], reference: f64, seconds: f64) -> SeriesRecord {
    const TIMES: usize = 120;
    let percent = |look: &Look| look.percent(reference);
    let found: Vec<Vec<Look>> = runs
        .iter()
        .map(|run| run.iter().copied().filter(|look| look.utility > 0.0).collect())
        .collect();
    let at = |time: f64| -> Option<f64> {
        let latest = |run: &Vec<Look>| run.iter().rfind(|look| look.seconds <= time).map(percent);
        Some(median(found.iter().map(latest).collect::<Option<_>>()?))
    };
    let median = (0..=TIMES)
        .map(|k| seconds * k as f64 / TIMES as f64)
        .filter_map(|time| at(time).map(|value| [time, value]))
        .collect();
    let runs = found
        .iter()
        .map(|run| run.iter().map(|look| [look.seconds, percent(look)]).collect())
        .collect();
    SeriesRecord { name: name.into(), runs, median }
}
