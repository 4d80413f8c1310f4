//! Progress bars: on a terminal only, on standard error, and only where a
//! stage takes longer than a moment.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::Duration;

/// A bar that counts, or a spinner until the first count is known.
pub(crate) struct Progress {
    bar: ProgressBar,
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
        Self { bar }
    }

    /// Reports `done` of `total`.
    pub(crate) fn set(&self, done: usize, total: usize) {
        if self.bar.length().is_none() {
            self.bar.set_length(total as u64);
            self.bar.set_style(style("{msg} [{bar:32}] {pos}/{len} {per_sec} ETA {eta}"));
        }
        self.bar.set_position(done as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is a constant")
}
