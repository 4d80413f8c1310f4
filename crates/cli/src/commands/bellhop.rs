//! `sonarfleet bellhop`: a case of the BELLHOP family, run natively or by an external
//! program, and how far two fields are apart.

use super::Manner;
use crate::args::{BellhopArgs, ModelName};
use crate::progress::Progress;
use anyhow::{Context, Result, bail, ensure};
use serde_json::{Value, json};
use sonarfleet_acoustics::bellhop::{
    CaseFiles, Executable, Reading, ShadeFile, fatal_text, output_file, print_text,
};
use sonarfleet_acoustics::field::Field;
use sonarfleet_acoustics::model::{Native, Output, PropagationModel, Run};
use sonarfleet_ocean::io::replace_file;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

pub(crate) fn bellhop(args: &BellhopArgs, manner: Manner) -> Result<()> {
    let target = Target::of(args)?;
    let done = solve(args, &target, manner);
    if let Err(error) = &done {
        // Scripts look for fatal errors in this file. The error is told in any case.
        let text = fatal_text("sonarfleet", &format!("{error:#}"));
        let _ = replace_file(&target.path("prt"), text.as_bytes());
    }
    done
}

/// Where results go: beside the case, or into a directory.
struct Target(PathBuf);

impl Target {
    fn of(args: &BellhopArgs) -> Result<Self> {
        let env = CaseFiles::new(&args.case).path("env");
        ensure!(env.is_file(), "{} is not there", env.display());
        let Some(directory) = &args.output else { return Ok(Self(env)) };
        std::fs::create_dir_all(directory)
            .with_context(|| format!("cannot create {}", directory.display()))?;
        Ok(Self(directory.join(env.file_name().context("a case has a name")?)))
    }

    fn path(&self, ending: &str) -> PathBuf {
        self.0.with_extension(ending)
    }
}

fn solve(args: &BellhopArgs, target: &Target, manner: Manner) -> Result<()> {
    let Reading { case, binary_arrivals, notes } = CaseFiles::load(&args.case)?.read()?;
    if !manner.quiet {
        for note in &notes {
            eprintln!("note: {note}");
        }
    }
    ensure!(
        args.compare.is_none() || matches!(case.run, Run::Field(_)),
        "--compare is for fields (.shd), but the run type of the case asks for others"
    );
    let model = model(args)?;
    let bar = Progress::new(&format!("{} model", model.name()), !manner.talkative());
    let started = Instant::now();
    let output = model.solve(&case)?;
    let seconds = started.elapsed().as_secs_f64();
    drop(bar);

    let program = match args.model {
        ModelName::Native => "sonarfleet",
        ModelName::Bellhop => "BELLHOP by sonarfleet",
    };
    let (ending, contents) = output_file(&case, &output, binary_arrivals, program);
    let path = target.path(ending);
    for (path, contents) in [
        (&path, &contents[..]),
        (&target.path("prt"), print_text(program, &case, &notes, seconds).as_bytes()),
    ] {
        replace_file(path, contents).with_context(|| format!("cannot write {}", path.display()))?;
    }

    let differences = args.compare.as_deref().map(|other| compare(&output, other)).transpose()?;
    if manner.json {
        return super::print_json(&json!({
            "output": path,
            "model": model.name(),
            "title": case.title,
            "sources": case.source_depth_m.len(),
            "receivers": case.receivers.count(),
            "beams": case.fan.beams().len(),
            "seconds": seconds,
            "notes": notes,
            "differences": differences.as_ref().map(Differences::json),
        }));
    }
    if !manner.quiet {
        super::say(format_args!(
            "{}: {} model, {} sources, {} receivers, {} beams in {seconds:.2} s",
            path.display(),
            model.name(),
            case.source_depth_m.len(),
            case.receivers.count(),
            case.fan.beams().len(),
        ))?;
        if let (Some(differences), Some(other)) = (differences, &args.compare) {
            super::say(format_args!("against {}: {}", other.display(), differences.text()))?;
        }
    }
    Ok(())
}

fn model(args: &BellhopArgs) -> Result<Box<dyn PropagationModel>> {
    Ok(match args.model {
        ModelName::Native => Box::new(Native),
        ModelName::Bellhop => {
            let executable = Executable::find()?;
            super::abandon_programs_on_interrupt()?;
            Box::new(
                executable.with_timeout(
                    Duration::try_from_secs_f64(args.timeout).unwrap_or(Duration::MAX),
                ),
            )
        }
    })
}

/// How far the losses of two fields are apart, where both are heard.
struct Differences {
    compared: usize,
    /// Receivers that only one of both fields reaches.
    one_sided: usize,
    /// Median, 90th and 99th percentile and maximum of |ours − theirs|, dB.
    percentiles_db: [f64; 4],
}

/// Fainter receivers are not compared, dB: real programs drop beams there.
const FAINTEST_DB: f64 = 300.0;

fn compare(output: &Output, other: &Path) -> Result<Differences> {
    let Output::Fields(ours) = output else { bail!("the model gave no fields") };
    let bytes = std::fs::read(other).with_context(|| format!("cannot read {}", other.display()))?;
    let theirs = ShadeFile::from_bytes(other, &bytes)?.fields;
    let shapes = |fields: &[Field]| fields.iter().map(|f| f.pressure.len()).collect::<Vec<_>>();
    ensure!(
        shapes(ours) == shapes(&theirs),
        "{} has other sources or receivers than the case",
        other.display()
    );
    let losses = |fields: &[Field]| fields.iter().flat_map(Field::loss_db).collect::<Vec<_>>();
    let (mut apart, mut one_sided) = (Vec::new(), 0);
    for (a, b) in losses(ours).into_iter().zip(losses(&theirs)) {
        match (a < FAINTEST_DB, b < FAINTEST_DB) {
            (true, true) => apart.push((a - b).abs()),
            (false, false) => {}
            _ => one_sided += 1,
        }
    }
    apart.sort_by(f64::total_cmp);
    let percentile = |part: f64| {
        let index = (part * apart.len() as f64) as usize;
        apart.get(index.min(apart.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
    };
    let percentiles_db = [0.5, 0.9, 0.99, 1.0].map(percentile);
    Ok(Differences { compared: apart.len(), one_sided, percentiles_db })
}

impl Differences {
    fn json(&self) -> Value {
        let [median, p90, p99, max] = self.percentiles_db;
        json!({
            "compared": self.compared,
            "one_sided": self.one_sided,
            "median_db": median,
            "p90_db": p90,
            "p99_db": p99,
            "max_db": max,
        })
    }

    fn text(&self) -> String {
        let [median, p90, p99, max] = self.percentiles_db;
        format!(
            "median {median:.3}, p90 {p90:.3}, p99 {p99:.3}, max {max:.3} dB \
             over {} receivers, {} heard in one only",
            self.compared, self.one_sided
        )
    }
}
