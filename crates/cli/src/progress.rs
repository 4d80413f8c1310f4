//! Progress bars: on a terminal only, on standard error, and only where a
//! stage takes longer than a moment.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use sonarfleet::mission::{Event, Stage};
use std::fmt::Write;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// A bar that counts sources, or a spinner until the first count is known.
pub(crate) struct Progress {
    bar: ProgressBar,
    counts: Mutex<Counts>,
}

/// What the bar stands at.
#[derive(Default)]
struct Counts {
    /// Sources that were there before anything was computed, once known.
    kept: Option<usize>,
    done: usize,
}

impl Progress {
    /// A bar named after its stage. Hidden when asked to be quiet or off a terminal.
    pub(crate) fn new(stage: &str, quiet: bool) -> Self {
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_style(style("{msg} {spinner} {elapsed}"));
        bar.set_message(stage.to_owned());
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar, counts: Mutex::default() }
    }

    /// Reports `done` of `total`. The first report says how many were there before:
    /// the bar counts only the others, so that its rate and its end are those of the
    /// work.
    pub(crate) fn set(&self, done: usize, total: usize) {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = *counts.kept.get_or_insert_with(|| {
            if done > 0 {
                self.bar.set_message(format!("{} ({done} kept)", self.bar.message()));
            }
            self.bar.set_length((total - done) as u64);
            self.bar.set_style(counting());
            done
        });
        // Reports come from several threads: one that was overtaken says nothing new.
        if done > counts.done {
            counts.done = done;
            self.bar.set_position((done - kept) as u64);
        }
    }

    /// What the bar stands at: done and to do, without what was there before.
    #[cfg(test)]
    fn counts(&self) -> (u64, Option<u64>) {
        (self.bar.position(), self.bar.length())
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// The bar of the stage at which a mission is.
pub(crate) struct StageBars {
    quiet: bool,
    bar: Mutex<Option<Progress>>,
}

impl StageBars {
    pub(crate) fn new(quiet: bool) -> Self {
        Self { quiet, bar: Mutex::new(None) }
    }

    /// Follows a mission; `name` names a stage of an epoch.
    pub(crate) fn tell(&self, event: &Event<'_>, name: impl Fn(usize, Stage) -> String) {
        if self.quiet {
            return;
        }
        let mut bar = self.bar.lock().unwrap_or_else(PoisonError::into_inner);
        match *event {
            Event::Started { epoch, stage } => {
                *bar = Some(Progress::new(&name(epoch, stage), false));
            }
            Event::Progressed { done, total } => {
                if let Some(bar) = bar.as_ref() {
                    bar.set(done, total);
                }
            }
            Event::Finished { .. } => *bar = None,
            Event::Epoch(_) => {}
        }
    }
}

/// How a bar that counts looks.
fn counting() -> ProgressStyle {
    let rate = |state: &ProgressState, out: &mut dyn Write| {
        let _ = write!(out, "{:.1} sources/s", state.per_sec()); // a bar has nobody to tell
    };
    style("{msg} [{bar:32}] {pos}/{len} sources, {rate}, ETA {eta}").with_key("rate", rate)
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is a constant")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_there_before_is_not_work() {
        let bar = Progress::new("table", true);
        bar.set(60, 100);
        assert_eq!(bar.counts(), (0, Some(40)));
        bar.set(62, 100);
        bar.set(61, 100); // overtaken
        assert_eq!(bar.counts(), (2, Some(40)));
        bar.set(100, 100);
        assert_eq!(bar.counts(), (40, Some(40)));
    }
}
