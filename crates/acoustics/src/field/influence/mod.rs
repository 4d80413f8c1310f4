//! What a beam leaves on receivers (COA section 3.3): where the beam meets them
//! (`cartesian`, `ray_centred`), how strong it is there (`beam`), and what becomes of
//! it (`sinks`, `arrivals`).

mod arrivals;
mod beam;
mod cartesian;
mod ray_centred;
mod sinks;
mod stations;

pub(crate) use arrivals::ArrivalSink;
pub(crate) use beam::{BeamLaunch, BeamPhysics, Contribution};
pub(crate) use sinks::{ContributionSink, HitSink, IntensitySink, PressureSink};
pub(crate) use stations::Stations;

use self::beam::BeamState;
use super::beam_kind::{BeamCoordinates, BeamKind};
use crate::ray::{Segment, SegmentSink};

/// Gives what the segments of one beam after another bring to receivers to a sink.
pub(crate) struct Influence<'a, S> {
    stations: &'a Stations,
    physics: &'a BeamPhysics<'a>,
    kind: BeamKind,
    beam: BeamState,
    sink: S,
}

impl<'a, S: ContributionSink> Influence<'a, S> {
    pub(crate) fn new(
        stations: &'a Stations,
        physics: &'a BeamPhysics<'a>,
        kind: BeamKind,
        sink: S,
    ) -> Self {
        Self { stations, physics, kind, beam: BeamState::default(), sink }
    }

    /// Begins a beam.
    pub(crate) fn begin(&mut self, launch: BeamLaunch) {
        self.beam = BeamState::new(launch);
    }

    pub(crate) fn into_sink(self) -> S {
        self.sink
    }
}

impl<S: ContributionSink> SegmentSink for Influence<'_, S> {
    fn segment(&mut self, segment: &Segment) {
        self.beam.enter(segment);
        match self.kind.coordinates {
            BeamCoordinates::Cartesian => self.cross_columns(segment),
            BeamCoordinates::RayCentred => self.sweep_across(segment),
        }
        self.beam.leave(segment, self.physics);
    }
}
