//! How a run tells what it is doing.

use crate::record::EpochRecord;
use std::fmt;
use std::time::Instant;

/// The parts of an epoch that take time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Transmission loss between all cells.
    TransmissionLoss,
    /// The same at the frequency of the links, where it is another.
    CommunicationLoss,
    /// Comparison of a sample of sources with `fine` settings.
    LossError,
    /// The same for the table of the links.
    CommunicationLossError,
    /// The target layout.
    Placement,
    /// Travel times of all vehicles to all posts.
    TravelTimes,
    /// Which vehicle takes which post.
    Assignment,
    /// The vehicles move.
    Execution,
}

impl Stage {
    /// Name, as in records.
    pub const fn name(self) -> &'static str {
        match self {
            Self::TransmissionLoss => "transmission loss",
            Self::CommunicationLoss => "communication loss",
            Self::LossError => "loss error",
            Self::CommunicationLossError => "communication loss error",
            Self::Placement => "placement",
            Self::TravelTimes => "travel times",
            Self::Assignment => "assignment",
            Self::Execution => "execution",
        }
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What happens in a run.
#[derive(Debug, Clone, Copy)]
pub enum Event<'a> {
    /// A stage of an epoch begins.
    Started {
        /// Number of the epoch.
        epoch: usize,
        /// The stage.
        stage: Stage,
    },
    /// Part of the present stage is done.
    Progressed {
        /// What is done.
        done: usize,
        /// Of how much.
        total: usize,
    },
    /// The present stage is over.
    Finished {
        /// The stage.
        stage: Stage,
        /// Wall-clock seconds it took.
        seconds: f64,
    },
    /// An epoch is complete.
    Epoch(&'a EpochRecord),
}

/// Whoever wants to know. Called from several threads.
pub type Observer<'a> = dyn Fn(Event<'_>) + Sync + 'a;

/// Times the stages of an epoch and tells an observer of them.
pub(super) struct Clock<'a> {
    epoch: usize,
    observer: &'a Observer<'a>,
    /// Seconds by stage, in order.
    pub(super) seconds: Vec<(String, f64)>,
}

impl<'a> Clock<'a> {
    pub(super) fn new(epoch: usize, observer: &'a Observer<'a>) -> Self {
        Self { epoch, observer, seconds: Vec::new() }
    }

    /// Does the work of a stage, handing it what to report progress to.
    pub(super) fn time<T>(
        &mut self,
        stage: Stage,
        work: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T,
    ) -> T {
        let observer = self.observer;
        observer(Event::Started { epoch: self.epoch, stage });
        let started = Instant::now();
        let result = work(&|done, total| observer(Event::Progressed { done, total }));
        let seconds = started.elapsed().as_secs_f64();
        observer(Event::Finished { stage, seconds });
        self.seconds.push((stage.name().to_owned(), seconds));
        result
    }
}
